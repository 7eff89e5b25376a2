"""The conditions at one point of the gains, exactly."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from symctrl.bounds import Statement, bound
from symctrl.collect import Collector
from symctrl.decide.decision import decide
from symctrl.decide.definiteness import decide_matrix
from symctrl.domains.boxes import Box, Boxes
from symctrl.domains.domain import Unsupported
from symctrl.expr import lift
from symctrl.gains.conditions import Condition
from symctrl.gains.definite import FAILS, HOLDS, OPEN, leaves, smallest_eigenvalue
from symctrl.gains.requirement import DEGREE, Cases, Requirement, outputs, state, tight
from symctrl.verdict import Outcome

if TYPE_CHECKING:
    from symctrl.study import Study

WORDS = {HOLDS: "feasible", FAILS: "infeasible", OPEN: "undecided"}


@dataclass(frozen=True)
class Answer:
    """margin: a lower bound of the slack, in the condition's own unit; None where there is none."""

    condition: Condition
    state: int
    margin: Fraction | None
    witness: Mapping[str, Any] | None
    certificates: tuple[Mapping[str, Any], ...]
    reason: str = ""

    def as_json(self) -> dict[str, Any]:
        return {
            "id": self.condition.id,
            "statement": self.condition.statement,
            "latex": self.condition.latex,
            "from": self.condition.source,
            "of_theorem": self.condition.of_theorem,
            "verdict": WORDS[self.state],
            "margin": None if self.margin is None else str(self.margin),
            "witness": self.witness,
            "reason": self.reason,
            "certificates": list(self.certificates),
        }


def answer(study: Study, condition: Condition, gains: Mapping[str, Fraction], cases: Cases) -> Answer:
    """The condition at a point."""
    missing = [name for name in condition.names if name not in gains and name not in cases]
    if missing:
        reason = f"{', '.join(missing)} has no value; give one with --set {missing[0]}=VALUE"
        return Answer(condition, OPEN, None, None, (), reason)
    states = [_state(one, gains, cases) for one in condition.requirements]
    found = min(states)
    margins = [m for one in condition.requirements if (m := _margin(one, gains, cases)) is not None]
    margin = min(margins) if len(margins) == len(condition.requirements) else None
    if found == FAILS:
        wrong = condition.requirements[states.index(FAILS)]
        return Answer(condition, found, margin, _witness(wrong, gains, cases), ())
    if found == OPEN:
        return Answer(condition, found, margin, None, (), _why_open(condition, cases))
    proofs = [_certificate(study, one, gains, cases) for one in condition.requirements]
    return Answer(condition, found, margin, None, tuple(p for p in proofs if p is not None))


def _why_open(condition: Condition, cases: Cases) -> str:
    wide = [n for n in condition.names if n in cases and cases[n].ranges and _is_wide(cases, n)]
    return f"it depends on where in its bounds {wide[0]} lies" if wide else "the enclosure contains zero"


def _is_wide(cases: Cases, name: str) -> bool:
    return any(high is None or high > low for low, high in cases[name].ranges)


def boxes_at(gains: Mapping[str, Fraction], domain: Boxes) -> dict[str, Box]:
    return {name: domain.between(value, value) for name, value in gains.items()}


def _state(one: Requirement, gains: Mapping[str, Fraction], cases: Cases) -> int:
    for domain in (Boxes(exact=True), Boxes()):
        try:
            return int(state(one, boxes_at(gains, domain), cases, domain)[0])
        except Unsupported:
            continue
    return OPEN


def _hull(one: Requirement, gains: Mapping[str, Fraction], cases: Cases) -> dict[str, Box]:
    domain = Boxes(exact=True)
    hull = {n: domain.between(*cases[n].hull) for n in one.names if n in cases}
    return {**boxes_at(gains, domain), **hull}


def _margin(one: Requirement, gains: Mapping[str, Fraction], cases: Cases) -> Fraction | None:
    """The least value of a bound, or a bound of the smallest eigenvalue, over all cases."""
    domain = Boxes(exact=True)
    try:
        if one.kind in ("positive", "nonnegative"):
            return min(Fraction(box.low[0]) for box in tight(one, _hull(one, gains, cases), domain))
        if one.kind.startswith("positive_"):
            return min(smallest_eigenvalue(rows) for rows in _matrices(one, _hull(one, gains, cases)))
    except Unsupported:
        return None
    return None


def _matrices(one: Requirement, values: Mapping[str, Box]) -> list[list[list[tuple[Fraction, Fraction]]]]:
    assert one.problem.claim.matrix is not None
    found = leaves(one.problem.claim.matrix, outputs(one, values, Boxes(exact=True)))
    return [[[(Fraction(b.low[0]), Fraction(b.high[0])) for b in row] for row in rows] for rows in found]


def _witness(one: Requirement, gains: Mapping[str, Fraction], cases: Cases) -> dict[str, Any]:
    """The values at which it fails: of the gains that it reads, and of a case in which it does."""
    made = {name: str(gains[name]) for name in one.names if name in gains}
    read = [name for name in one.names if name in cases]
    for name in read:
        low, high = next((r for r in reversed(cases[name].ranges) if r), cases[name].hull)
        made[name] = str(low) if high == low else f">= {low}"
    if one.kind.startswith("positive_") and not read:
        for rows in _matrices(one, _hull(one, gains, cases)):
            x = decide_matrix([[low for low, _ in row] for row in rows]).witness
            if x is not None:
                made["x"] = [str(v) for v in x]  # type: ignore[assignment]
    return made


def _certificate(
    study: Study, one: Requirement, gains: Mapping[str, Fraction], cases: Cases
) -> Mapping[str, Any] | None:
    """A certificate of the requirement at the point, for all values of its cases; None if there is none."""
    if DEGREE in one.names:
        return None
    values = dict(gains)
    given: list[Statement] = []
    for name in one.names:
        if name in cases:
            low, high = cases[name].hull
            if low == high:
                values[name] = low
            else:
                symbol = study.symbols[name].expr
                given += [bound(symbol >= lift(low)), bound(symbol <= lift(high))]
    problem = Collector(study, values).problem(one.statement, one.problem.id, given)
    verdict = decide(problem)
    return verdict.certificate if verdict.outcome is Outcome.PROVED else None
