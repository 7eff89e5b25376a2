"""Studies of a few lines and the problems that their claims make."""

from __future__ import annotations

from typing import Any

from symctrl.bounds import bound
from symctrl.collect import Collector
from symctrl.expr import Comparison
from symctrl.problem import Problem
from symctrl.statements import Statement
from symctrl.study import Study
from symctrl.vectors import cross


def problem(
    study: Study, claim: Statement | Comparison, *hypotheses: Statement | Comparison, **more: Any
) -> Problem:
    """The problem of one claim under hypotheses."""
    return Collector(study).problem(_claimed(claim), "claim", [_claimed(h) for h in hypotheses], **more)


def _claimed(claim: Statement | Comparison) -> Statement:
    return bound(claim) if isinstance(claim, Comparison) else claim


def body() -> tuple[Study, Any, Any]:
    """A unit quaternion that turns with w."""
    study = Study("body")
    q, w = study.unit_quaternion("q"), study.state("w", 3)
    study.motion(q.vector, (q.scalar * w + cross(q.vector, w)) / 2)
    study.motion(q.scalar, -q.vector.T @ w / 2)
    return study, q, w
