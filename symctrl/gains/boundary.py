"""The exact edge of the feasible gains as a formula, where a condition can be solved for a gain."""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from fractions import Fraction
from typing import TYPE_CHECKING

from symctrl.collect import Collector
from symctrl.decide.session import Session, exactly
from symctrl.domains.domain import Unsupported
from symctrl.domains.field import Exact, Poly
from symctrl.fleet import EIGENVALUE
from symctrl.gains.conditions import Condition, is_gain
from symctrl.gains.requirement import DEGREE, Case, Cases, Requirement

if TYPE_CHECKING:
    from symctrl.study import Study

Solution = tuple[str, str]
Powers = tuple[tuple[int, int], ...]  # (generator, exponent), increasing
Terms = Mapping[Powers, Fraction]


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
    """The edge is where the bound's value is zero."""
    wanted = [n for n in gains if n in one.names]
    if DEGREE in one.names or not wanted or len(set(one.names) - {EIGENVALUE}) < 2:
        return None
    problem = Collector(study).problem(one.statement, one.problem.id)
    try:
        solved = exactly(problem, lambda session: _solved(study, session, cases, wanted))
    except Unsupported:
        return None
    return None if solved is None else " = ".join(solved)


def _solved(study: Study, session: Session, cases: Cases, wanted: Sequence[str]) -> Solution | None:
    """A bound of one value that is affine in a gain, solved for it."""
    values, field = session.claim(), session.domain.field
    if len(values) != 1:
        return None
    signed, p = (_terms(q, field.size) for q in (session.carrier(values[0]), _numerator(session, values[0])))
    read = {k for powers in (*signed, *p) for k, _ in powers}
    if any(field.generators[k].kind != "free" for k in read):
        return None
    names = [g.name for g in field.generators]
    positive = {k for k, name in enumerate(names) if name in cases or is_gain(study, name)}
    for k in sorted(read):
        if names[k] in cases and not _is_chosen(cases[names[k]]):
            certain = _divides_not(session, values[0], k) and _is_signed(signed, k, positive)
            end = _end(signed, k, cases[names[k]]) if certain else None
            if end is None:
                return None
            p = _at(p, k, end)
    for gain in wanted:
        solved = _affine(p, names, names.index(gain)) if gain in names else None
        if solved is not None:
            return gain, solved
    return None


def _numerator(session: Session, value: Exact) -> Poly:
    return session.domain.together(value)[0]


def _divides_not(session: Session, value: Exact, k: int) -> bool:
    """Does the value divide by nothing in which the generator occurs?"""
    field = session.domain.field
    factors = [field.factors[f] for f, _ in session.domain.together(value)[1]]
    return all(k not in field.occurring(factor) for factor in factors)


def _is_signed(p: Terms, k: int, positive: Set[int]) -> bool:
    """Has each term in which generator k occurs the sign of its coefficient, where some are not negative?"""
    return all(g in positive or e % 2 == 0 for powers in p if k in dict(powers) for g, e in powers)


def _terms(p: Poly, size: int) -> Terms:
    made = {}
    for exponents, c in p.terms():
        powers = tuple((k, int(exponents[size - 1 - k])) for k in range(size) if exponents[size - 1 - k])
        made[powers] = Fraction(int(c.p), int(c.q))
    return made


def _is_chosen(case: Case) -> bool:
    """Is it a gain, or a bound of eigenvalues, of which the best value is not known? It stays a letter."""
    low, high = case.hull
    return low == high and case.ranges[0] not in ((low, None), (low, low))


def _end(signed: Terms, k: int, case: Case) -> Fraction | None:
    """The value of a case at which the bound is decided, for positive gains, if that is known exactly.

    The bound is least at the largest value if its derivative is nowhere positive, and at the least one if it
    is nowhere negative. signed: a polynomial that has its sign.
    """
    low, high = case.hull
    signs = {c > 0 for powers, c in signed.items() if k in dict(powers)}
    if low == high or not signs:
        return high
    if len(signs) > 1:
        return None
    end = low if signs == {True} else high
    return end if (end, end) in case.ranges else None


def _at(p: Terms, k: int, value: Fraction) -> Terms:
    made: dict[Powers, Fraction] = {}
    for powers, c in p.items():
        rest = tuple((g, e) for g, e in powers if g != k)
        made[rest] = made.get(rest, Fraction(0)) + c * value ** dict(powers).get(k, 0)
    return {powers: c for powers, c in made.items() if c}


def _affine(p: Terms, names: Sequence[str], k: int) -> str | None:
    slope: dict[Powers, Fraction] = {}
    rest: dict[Powers, Fraction] = {}
    for powers, c in p.items():
        e = dict(powers).get(k, 0)
        if e > 1:
            return None
        into = slope if e == 1 else rest
        into[tuple(pair for pair in powers if pair[0] != k)] = c
    if not slope or not rest:
        return None
    if len(slope) == 1 and () in slope:
        return _text({m: -c / slope[()] for m, c in rest.items()}, names)
    first = next(iter(slope.values()))
    over, under = {m: -c / first for m, c in rest.items()}, {m: c / first for m, c in slope.items()}
    return f"{_bracketed(over, names, '+ ')}/{_bracketed(under, names, '+ *')}"


def _bracketed(p: Terms, names: Sequence[str], signs: str) -> str:
    """In brackets where one of the signs is in it."""
    text = _text(p, names)
    return f"({text})" if any(sign in text for sign in signs.split()) or " - " in text else text


def _text(p: Terms, names: Sequence[str]) -> str:
    """What is added first, then what is taken away."""
    terms = []
    for powers, c in sorted(p.items(), key=lambda term: term[1] < 0):
        factors = [f"{names[g]}^{e}" if e > 1 else names[g] for g, e in powers]
        number = [str(abs(c))] if abs(c) != 1 or not factors else []
        terms.append(("- " if c < 0 else "+ ") + "*".join(number + factors))
    text = " ".join(terms)
    return "-" + text[2:] if text.startswith("- ") else text[2:]
