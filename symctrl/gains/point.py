"""The conditions at one point of the gains, exactly."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from symctrl.bounds import Statement, bound
from symctrl.collect import Collector
from symctrl.decide.decision import decide
from symctrl.decide.definiteness import decide_matrix
from symctrl.domains.boxes import Box, Boxes
from symctrl.domains.domain import Unsupported
from symctrl.domains.interval import IntervalDomain, ball, bounds
from symctrl.expr import lift
from symctrl.gains.conditions import Condition
from symctrl.gains.definite import FAILS, HOLDS, OPEN, leaves, smallest_eigenvalue
from symctrl.gains.requirement import (
    DEGREE,
    Case,
    Cases,
    Interval,
    Requirement,
    choices,
    in_ranges,
    outputs,
    sign,
    state,
    tight,
)
from symctrl.verdict import Outcome, Verdict

if TYPE_CHECKING:
    from symctrl.study import Study

Pair = tuple[Any, Any]

STATES = {Outcome.PROVED: HOLDS, Outcome.REFUTED: FAILS}
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
    each = [_decided(study, one, gains, cases) for one in condition.requirements]
    found = min(one.state for one in each)
    margins = [m for one in condition.requirements if (m := _margin(one, gains, cases)) is not None]
    margin = min(margins) if len(margins) == len(condition.requirements) else None
    if found == FAILS:
        wrong = next(one.of for one in each if one.state == FAILS)
        return Answer(condition, found, margin, _witness(wrong, gains, cases), ())
    if found == OPEN:
        open_ = next(one for one in each if one.state == OPEN)
        return Answer(condition, found, margin, None, (), _why_open(open_, cases))
    return Answer(condition, found, margin, None, tuple(c for one in each if (c := one.certificate())))


@dataclass(frozen=True)
class _At:
    """What is known of one requirement at a point."""

    of: Requirement
    state: int
    verdict: Callable[[], Verdict | None]
    reason: str = ""

    def certificate(self) -> Mapping[str, Any] | None:
        found = self.verdict()
        return found.certificate if found is not None and found.outcome is Outcome.PROVED else None


def _decided(study: Study, one: Requirement, gains: Mapping[str, Fraction], cases: Cases) -> _At:
    """By boxes; where these do not know an operation by balls, and else as a claim is decided."""
    asked = cache(lambda: _verdict(study, one, gains, cases))
    reason = ""
    for domain in (Boxes(exact=True), Boxes()):
        try:
            found = int(state(one, boxes_at(gains, domain), cases, domain)[0])
        except Unsupported as error:
            reason = str(error)
            continue
        if found != OPEN or any(_is_wide(cases, name) for name in one.names):
            return _At(one, found, asked)
        reason = reason or "the enclosure of its value contains zero"
    free = any(name in cases and _is_free(cases[name]) for name in one.names)
    found = _by_balls(one, gains, cases)
    verdict = asked() if found == OPEN else None
    if verdict is not None and verdict.outcome in STATES and not verdict.conditions:
        found = STATES[verdict.outcome]
    return _At(one, OPEN if free and found == FAILS else found, asked, reason)


def _by_balls(one: Requirement, gains: Mapping[str, Fraction], cases: Cases) -> int:
    """The state over the hull of the cases, with the functions that balls know and boxes do not."""
    if one.kind.startswith("positive_"):
        return OPEN
    domain = IntervalDomain()
    with domain.working():
        values = {name: ball(value, value) for name, value in gains.items()}
        values |= {name: ball(*cases[name].hull) for name in one.names if name in cases}
        try:
            made = [bounds(x) for x in outputs(one, values, domain)]
        except Unsupported:
            return OPEN
    if None in made:
        return OPEN
    exact = Boxes(exact=True)
    return min(int(sign(one.kind, exact.between(*ends))[0]) for ends in made if ends is not None)


def _why_open(one: _At, cases: Cases) -> str:
    wide = [name for name in one.of.names if _is_wide(cases, name)]
    if one.reason or not wide:
        return one.reason
    if wide[0] == DEGREE or cases[wide[0]].ranges[-1][1] is not None:
        return f"it depends on where in its bounds {wide[0]} lies"
    return f"it does not hold with the {wide[0]} that was chosen, {cases[wide[0]].hull[1]}"


def _is_free(case: Case) -> bool:
    """Is what is true of some value in the hull not true of the case, which may have another?"""
    low, high = case.hull
    return low < high or case.ranges != ((low, high),)


def _is_wide(cases: Cases, name: str) -> bool:
    return name in cases and any(high is None or high > low for low, high in cases[name].ranges)


def boxes_at(gains: Mapping[str, Fraction], domain: Boxes) -> dict[str, Box]:
    return {name: domain.between(value, value) for name, value in gains.items()}


def _margin(one: Requirement, gains: Mapping[str, Fraction], cases: Cases) -> Fraction | None:
    """The least value of a bound, or a bound of the smallest eigenvalue, over all cases."""
    for domain in (Boxes(exact=True), Boxes()):
        hull = {n: domain.between(*cases[n].hull) for n in one.names if n in cases}
        values = {**boxes_at(gains, domain), **hull}
        try:
            if one.kind in ("positive", "nonnegative"):
                lows = [box.low[0] for box in tight(one, values, domain)]
                return min(map(Fraction, lows)) if all(map(_is_finite, lows)) else None
            if one.kind.startswith("positive_"):
                return _smallest(one, values, domain)
        except Unsupported:
            continue
    return None


def _smallest(one: Requirement, values: Mapping[str, Box], domain: Boxes) -> Fraction | None:
    found = []
    for rows in _matrices(one, values, domain):
        if not all(_is_finite(x) for row in rows for pair in row for x in pair):
            return None
        exact = [[(Fraction(low), Fraction(high)) for low, high in row] for row in rows]
        found.append(smallest_eigenvalue(exact))
    return min(found)


def _is_finite(end: Any) -> bool:
    return isinstance(end, Fraction) or bool(np.isfinite(end))


def _matrices(one: Requirement, values: Mapping[str, Box], domain: Boxes) -> list[list[list[Pair]]]:
    """The ends of the entries; those below the diagonal are those above it."""
    assert one.problem.claim.matrix is not None
    found = leaves(one.problem.claim.matrix, outputs(one, values, domain))
    ends = [[[(box.low[0], box.high[0]) for box in row] for row in rows] for rows in found]
    return [
        [[rows[min(r, c)][max(r, c)] for c in range(len(rows))] for r in range(len(rows))] for rows in ends
    ]


def _witness(one: Requirement, gains: Mapping[str, Fraction], cases: Cases) -> dict[str, Any]:
    """The values at which it fails: of the gains that it reads, and of cases in which it does."""
    made: dict[str, Any] = {name: str(gains[name]) for name in one.names if name in gains}
    for name, (low, high) in _failing(one, gains, cases).items():
        made[name] = str(low) if high == low else f">= {low}" if high is None else f"[{low}, {high}]"
    if one.kind.startswith("positive_") and not any(name in cases for name in one.names):
        domain = Boxes(exact=True)
        try:
            for rows in _matrices(one, boxes_at(gains, domain), domain):
                x = decide_matrix([[low for low, _ in row] for row in rows]).witness
                if x is not None:
                    made["x"] = [str(v) for v in x]
        except Unsupported:
            return made
    return made


def _failing(one: Requirement, gains: Mapping[str, Fraction], cases: Cases) -> Mapping[str, Interval]:
    """Ranges of the cases in which it fails."""
    for domain in (Boxes(exact=True), Boxes()):
        for ranges in choices(one, cases):
            try:
                if in_ranges(one, boxes_at(gains, domain), ranges, domain)[0] == FAILS:
                    return ranges
            except Unsupported:
                continue
    return {}


def _verdict(study: Study, one: Requirement, gains: Mapping[str, Fraction], cases: Cases) -> Verdict | None:
    """The requirement at the point, for all values of its cases, as a claim; None if it cannot be made."""
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
    return decide(Collector(study, values).problem(one.statement, one.problem.id, given))
