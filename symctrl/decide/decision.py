"""One problem, one verdict: a proof that the kernel accepts, a witness that it accepts, or what was tried."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

from symctrl.certify import certificate
from symctrl.decide import bound, definite, equation
from symctrl.decide.attempt import Attempt
from symctrl.decide.solve import NoPoint
from symctrl.domains.domain import Unsupported
from symctrl.domains.opaque import NowhereDefined
from symctrl.domains.tangent import NotDifferentiable
from symctrl.evaluate import NoRate
from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.check import check_text, needed_conditions
from symctrl.problem import Problem
from symctrl.reach import closings
from symctrl.verdict import Condition, Outcome, Verdict

Decider = Callable[[Problem], Attempt]

DECIDERS: Mapping[str, Decider] = {
    "equal": equation.attempt,
    "conforms": lambda problem: Attempt(proof={"kind": "conforms"}, method="conforms"),
    "nonnegative": bound.attempt,
    "positive": bound.attempt,
    "positive_definite": definite.attempt,
    "positive_semidefinite": definite.attempt,
}


PROVERS: Mapping[str, Callable[[Problem], dict[str, Any] | None]] = {
    "equal": equation.proof,
    "nonnegative": bound.proof,
    "positive": bound.proof,
    "positive_definite": definite.proof,
    "positive_semidefinite": definite.proof,
}

NOT_ACCEPTED = "the kernel does not accept what was found"


def decide(problem: Problem) -> Verdict:
    """The verdict of one problem: first with its definitions closed, then, if that proves nothing, with all
    opened.

    A proof or a witness that the kernel does not accept is none.
    """
    for simpler in closings(problem):
        found = _decide(simpler)
        if found.outcome is Outcome.PROVED and not found.conditions:
            return found
    return _decide(problem)


def _decide(problem: Problem) -> Verdict:
    try:
        found = DECIDERS[problem.claim.kind](problem)
    except NowhereDefined as error:
        return Verdict(Outcome.ILL_FORMED, str(error))
    except NoRate as error:
        return Verdict(Outcome.ILL_FORMED, str(error))
    except (Unsupported, NotDifferentiable) as error:
        return Verdict(Outcome.UNDECIDED, str(error), "exact domain")
    except NoPoint as error:
        return Verdict(Outcome.UNDECIDED, f"not proved, and {error}")
    if found.proof is not None:
        return _proved(problem, found)
    if found.witness is not None:
        return _refuted(problem, found)
    return Verdict(Outcome.UNDECIDED, found.reason, found.method, residual=found.residual)


def _proved(problem: Problem, found: Attempt) -> Verdict:
    """The certificate, with the conditions that the kernel finds that its proof needs."""
    assert found.proof is not None
    draft = certificate(problem.statement(), found.proof)
    try:
        conditions = needed_conditions(json.dumps(draft))
    except (Invalid, Declined) as error:
        return _not_accepted("proof", str(error))
    if not conditions:  # then the kernel has just verified this very certificate
        return Verdict(Outcome.PROVED, found.reason, found.method, (), draft)
    made = certificate(problem.statement([{"kind": c.kind, "of": c.of} for c in conditions]), found.proof)
    answer = check_text(json.dumps(made))
    if answer.status != "valid":
        return _not_accepted("proof", answer.reason)
    kept = tuple(Condition(c.kind, c.of) for c in conditions)
    return Verdict(Outcome.PROVED, found.reason, found.method, kept, made)


def _refuted(problem: Problem, found: Attempt) -> Verdict:
    """The certificate of a refutation, which the kernel must accept."""
    assert found.witness is not None
    made = certificate(problem.statement(), found.witness.proof(problem))
    answer = check_text(json.dumps(made))
    if answer.status != "valid":
        return _not_accepted("witness", answer.reason)
    shown = found.witness.values_json(problem)
    return Verdict(Outcome.REFUTED, found.witness.says, "exact witness", (), made, shown, found.residual)


def _not_accepted(what: str, why: str) -> Verdict:
    return Verdict(Outcome.UNDECIDED, f"{NOT_ACCEPTED}: a {what} was found, but {why}", "exact domain")
