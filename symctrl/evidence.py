"""Second evidence and negative twins: what stands beside a verdict and never makes one.

Every equation is also evaluated in floating point at random admissible points, with its rates; the residual
is relative to the largest intermediate value. The twins of an equation are the claims in which one addend as
written is missing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np

from symctrl.collect import Collector
from symctrl.decide.identity import vanishes
from symctrl.decide.place import Place, evaluation
from symctrl.decide.points import points
from symctrl.decide.session import Session, exactly
from symctrl.decide.solve import NoPoint
from symctrl.domains.domain import Unsupported
from symctrl.domains.floating import FloatDomain
from symctrl.domains.fraction import FractionDomain, NoExactValue
from symctrl.domains.opaque import NowhereDefined
from symctrl.evaluate import Environment
from symctrl.expr import Expr, terms
from symctrl.problem import Meaning, Problem, split
from symctrl.records import Rate
from symctrl.rows import Numeric, Twins
from symctrl.statements import Conforms, Equal
from symctrl.text import text

if TYPE_CHECKING:
    from symctrl.study import Study

SAMPLES = 12
POINTS = 4
RATES = 2
STEP = 1e-5
ROUND_OFF = 1e-10
DIFFERENCE_TOLERANCE = 1e-5
TOLERANCE = 1e-9


def point_known(problems: Sequence[Problem]) -> bool:
    """Is a point known for each problem at which all its assumptions hold? Else they may contradict."""
    try:
        return all(next(points(problem)) is not None for problem in problems)
    except (NoPoint, Unsupported):
        return False


def numeric(problem: Problem) -> Numeric | None:
    """The largest relative residual of an equation at random admissible points; None where none is found.

    Beside left minus right, each rate is compared with a central difference along the motion.
    """
    worst, count = 0.0, 0
    try:
        for place in islice(points(problem, seed=2), SAMPLES):
            residual = max(
                _residual(problem, place), _rate_residual(problem, place) if count < RATES else 0.0
            )
            if np.isfinite(residual):
                worst = max(worst, residual)
                count += 1
    except (NoPoint, Unsupported, ValueError):
        return Numeric(count, worst) if count else None
    return Numeric(count, worst)


def _residual(problem: Problem, place: Place) -> float:
    domain = FloatDomain()
    outputs = evaluation(problem, place, domain).outputs(problem.claim.listing, place.binding)
    half = len(outputs) // 2
    difference = max(abs(float(a) - float(b)) for a, b in zip(outputs[:half], outputs[half:], strict=True))
    scale = float(np.max(domain.largest))
    return difference / scale if scale else difference


def _rate_residual(problem: Problem, place: Place) -> float:
    """How far the rates are from central differences, beyond the error that these show: 0 if they agree."""
    worst = 0.0
    for name, meaning in problem.names.items():
        if meaning.is_ != "rate" or meaning.of is None:
            continue
        here = FloatDomain()
        at = evaluation(problem, place, here)
        binding = {"i": place.binding["i"]} if place.edges else {}
        rate = float(at.name(name.replace(".*", f".{binding.get('i', '')}", 1), 0, None))
        coarse, fine = (_difference(problem, place, at, meaning, binding, step) for step in (STEP, STEP / 4))
        allowed = (
            10 * abs(coarse - fine)
            + DIFFERENCE_TOLERANCE * (1 + abs(rate))
            + ROUND_OFF * float(np.max(here.largest))
        )
        error = abs(rate - fine)
        worst = max(worst, error / (abs(rate) + abs(fine)) if error > allowed else 0.0)
    return worst


def _difference(
    problem: Problem, place: Place, at: Environment, meaning: Meaning, binding: dict[str, str], step: float
) -> float:
    """The central difference along the motion of what a rate is the rate of."""
    assert meaning.of is not None
    ends = [
        float(evaluation(problem, moved, FloatDomain()).output(meaning.of, binding, 0, meaning.law))
        for moved in (_moved(problem, place, at, meaning.law, side * step) for side in (1, -1))
    ]
    return (ends[0] - ends[1]) / (2 * step)


def _moved(problem: Problem, place: Place, at: Environment, law: str | None, step: float) -> Place:
    """The place with every state moved along its rate."""
    values = dict(place.values)
    for name, value in place.values.items():
        base, node, index = split(name)
        of = problem.motion.get(f"{base}.*{index}" if place.edges and node else name)
        if of is not None:
            rate = float(at.output(of, {"i": node} if node else {}, 0, law))
            if np.isfinite(rate):
                values[name] = value + Fraction(step * rate)
    return Place(values, place.edges)


TURNED = {">=": "<=", "<=": ">=", ">": "<=", "<": ">="}


def twins(study: Study, claim: Equal, id_: str) -> Twins:
    """One twin for each addend as written on the sides that the author typed, and one for the sides being the
    same.
    """
    addends = [
        t for side in (claim.left, claim.right) if not _is_rate(side) for t in terms(side) if not _is_zero(t)
    ]
    if len(addends) == 1 and not any(map(_is_rate, (claim.left, claim.right))) and _is_zero(claim.right):
        addends = []
    still_true, failed = [], []
    for t in addends:
        try:
            if _vanishes(Collector(study).problem(Conforms(t), id_)):
                still_true.append(f"without {text(t)}")
        except Exception as error:
            failed.append(f"without {text(t)}: {type(error).__name__}: {error}")
    problem = Collector(study).problem(claim, id_)
    outputs = problem.listings["claim"].outputs
    half = len(outputs) // 2
    if outputs[:half] == outputs[half:]:
        still_true.append("both sides are the same graph: nothing is claimed")
    return Twins(len(addends) + 1, tuple(still_true), tuple(failed))


def reversed_twins(problems: Sequence[Problem]) -> Twins | None:
    """One twin for each bound or definiteness: with the sign reversed it must fail somewhere."""
    signed = [p for p in problems if p.claim.kind not in ("equal", "conforms")]
    if not signed:
        return None
    still_true, failed = [], []
    for p in signed:
        try:
            if not _reversed_fails(p):
                still_true.append(f"reversed: {_reversed(p)}")
        except Exception as error:
            failed.append(f"reversed: {_reversed(p)}: {type(error).__name__}: {error}")
    return Twins(len(signed), tuple(dict.fromkeys(still_true)), tuple(dict.fromkeys(failed)))


def _reversed(problem: Problem) -> str:
    """The twin in words: the bound the other way round, the matrix with its sign turned."""
    words = problem.text.split(" ")
    if problem.claim.matrix is not None:
        return f"{problem.text}, of minus the matrix"
    return " ".join(TURNED.get(word, word) for word in words)


def _reversed_fails(problem: Problem) -> bool:
    """Is some entry (of a matrix: on the diagonal of a block) positive at an admissible point?"""
    at = _diagonal(problem.claim.matrix) if problem.claim.matrix is not None else None
    try:
        for place in islice(points(problem), SAMPLES):
            outputs = evaluation(problem, place, FloatDomain()).outputs(problem.claim.listing, place.binding)
            chosen = outputs if at is None else [outputs[k] for k in at]
            if any(float(entry) > 0 for entry in chosen):
                return True
    except (NoPoint, Unsupported, ZeroDivisionError):
        return False
    return False


def _diagonal(tree: Mapping[str, Any]) -> list[int]:
    """Positions of the diagonal entries of a tree's leaves."""
    if "entries" in tree:
        return [row[r] for r, row in enumerate(tree["entries"])]
    if "blocks" in tree:
        return [k for block in tree["blocks"] for k in _diagonal(block)]
    return _diagonal(tree["congruence"] if "congruence" in tree else tree["kron_identity"])


def _vanishes(problem: Problem) -> bool:
    """Is every entry zero on the domain? A few points say no; only the exact domain says yes."""
    try:
        for place in islice(points(problem), POINTS):
            if any(
                evaluation(problem, place, FractionDomain()).outputs(problem.claim.listing, place.binding)
            ):
                return False
    except (NoPoint, NoExactValue, ZeroDivisionError):
        pass

    def work(session: Session) -> bool:
        return all(vanishes(session, value) for value in session.claim())

    try:
        return exactly(problem, work)
    except (Unsupported, NowhereDefined):
        return False


def _is_rate(side: Expr) -> bool:
    return side.op == "deferred" and isinstance(side.args[0], Rate)


def _is_zero(term: Expr) -> bool:
    return all(isinstance(entry, Fraction) and entry == 0 for entry in term.entries)
