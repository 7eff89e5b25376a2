"""The exact edge of the feasible gains as a formula, where a condition can be solved for a gain."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from symctrl.collect import Collector
from symctrl.decide.session import Session, exactly
from symctrl.domains.domain import Unsupported
from symctrl.domains.field import Poly
from symctrl.gains.conditions import Condition
from symctrl.gains.requirement import Cases, Requirement

if TYPE_CHECKING:
    from symctrl.study import Study

Solution = tuple[str, str]


def boundary(study: Study, deciding: Sequence[Condition], cases: Cases, gains: Sequence[str]) -> str | None:
    """`gain = formula` for each condition that has such an edge; gains: those that it is solved for, the
    first that occurs in the first place. None where there is none.
    """
    found: dict[str, None] = {}
    for condition in deciding:
        for one in condition.requirements:
            if one.kind in ("positive", "nonnegative"):
                text = _of(study, one, cases, gains)
                if text is not None:
                    found[text] = None
    return "; ".join(found) or None


def _of(study: Study, one: Requirement, cases: Cases, gains: Sequence[str]) -> str | None:
    """The edge is where the bound's value is zero. A case is at the end that decides, if its ends are one."""
    known = {n: cases[n].hull[1] for n in one.names if n in cases and _is_known(cases, n)}
    open_ = [n for n in one.names if n in cases and n not in known]
    wanted = [n for n in gains if n in one.names]
    if open_ or not wanted or len([n for n in one.names if n not in cases]) < 2:
        return None
    problem = Collector(study, known).problem(one.statement, one.problem.id)
    try:
        solved = exactly(problem, lambda session: _solved(session, wanted))
    except Unsupported:
        return None
    return None if solved is None else " = ".join(solved)


def _is_known(cases: Cases, name: str) -> bool:
    """Has the case one value, or is its least admissible value known exactly?"""
    low, high = cases[name].hull
    tops = [upper if upper is not None else lower for lower, upper in cases[name].ranges]
    return bool(tops) and tops[-1] == high and (low == high or cases[name].ranges[-1][0] == high)


def _solved(session: Session, wanted: Sequence[str]) -> Solution | None:
    """A bound of one value that is affine in a gain, solved for it."""
    values = session.claim()
    if len(values) != 1:
        return None
    p, names = session.carrier(values[0]), [g.name for g in session.domain.field.generators]
    for gain in wanted:
        if gain in names:
            solved = _affine(session, p, names, names.index(gain))
            if solved is not None:
                return gain, solved
    return None


def _affine(session: Session, p: Poly, names: Sequence[str], k: int) -> str | None:
    size = session.domain.field.size
    slope: dict[tuple[int, ...], Fraction] = {}
    rest: dict[tuple[int, ...], Fraction] = {}
    for exponents, c in p.terms():
        powers = [int(exponents[size - 1 - g]) for g in range(len(names))]
        if powers[k] > 1:
            return None
        into = slope if powers[k] == 1 else rest
        powers[k] = 0
        into[tuple(powers)] = Fraction(int(c.p), int(c.q))
    if not slope or not rest:
        return None
    if len(slope) == 1 and not any(next(iter(slope))):
        by = next(iter(slope.values()))
        return _text({m: -c / by for m, c in rest.items()}, names)
    over = _text({m: -c for m, c in rest.items()}, names)
    return f"({over})/({_text(slope, names)})"


def _text(p: Mapping[tuple[int, ...], Fraction], names: Sequence[str]) -> str:
    terms = []
    for powers, c in p.items():
        factors = [f"{names[g]}^{e}" if e > 1 else names[g] for g, e in enumerate(powers) if e]
        number = [str(abs(c))] if abs(c) != 1 or not factors else []
        terms.append(("- " if c < 0 else "+ ") + "*".join(number + factors))
    text = " ".join(terms)
    return "-" + text[2:] if text.startswith("- ") else text[2:]
