"""A sign by cases: where the argument of an absolute value is not negative, and where it is not positive.

A saturation, a minimum and a dead zone are sums of absolute values, so that in each case only polynomials
are left.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from symctrl.decide.session import Session
from symctrl.domains.field import Exact, Poly

MAX_SIZES = 3  # absolute values that are told apart by cases
MAX_SYMBOLS = 8  # of a polynomial that is shown by cases
Entry = dict[str, Any]


def by_cases(session: Session, value: Exact, prove: Callable[[Exact], Entry | None]) -> Entry | None:
    """The entry of a proof that shows the value by the first absolute value in it, in both cases; None where
    one is not shown.
    """
    field = session.domain.field
    p = field.normal(session.carrier(value))
    if p.is_zero():
        return None
    sizes = _sizes(session, p)
    few = len(sizes) <= MAX_SIZES and len(field.occurring(p)) <= MAX_SYMBOLS
    if not sizes or not few or session.totals:
        return None
    k, cases = min(sizes), []
    for side in (1, -1):
        b = field.generators[k].argument * side
        with supposing(session, k, b) as possible:
            entry = prove(session.domain.polynomial(field.normal(p))) if possible else None
        if possible and entry is None:
            return None
        cases.append(entry)
    return {"by": k, "cases": cases}


def _sizes(session: Session, p: Poly) -> set[int]:
    """The absolute values in a polynomial, and those that these are made of, that no case has decided."""
    field = session.domain.field
    found, todo = set(), field.occurring(p)
    while todo:
        k = todo.pop()
        g = field.generators[k]
        if g.kind == "abs" and k not in session.cases:
            found.add(k)
        if g.kind in ("abs", "sign"):
            todo |= field.made_of(k)
    return found


@contextmanager
def supposing(session: Session, k: int, b: Poly) -> Iterator[bool]:
    """Inside, generator k = |b| is b, which is not negative; False where that never is."""
    field, signs = session.domain.field, session.domain.signs
    kept = field.kept(), dict(signs.generator), list(signs.facts)
    field.add_relation(field.variable(k) - b)
    session.cases[k] = b
    possible = signs.suppose(b)
    try:
        yield possible
    finally:
        del session.cases[k]
        field.restore(kept[0])
        signs.generator, signs.facts = kept[1], kept[2]
