"""A sign by squares as the author wrote them: set aside before the rest is looked at, or as candidates."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

from symctrl.decide.session import Session
from symctrl.domains.field import Exact, Poly, coefficient

MAX_SHARES = 6  # multiples of one square that are tried
Entry = dict[str, Any]


def written(session: Session) -> list[Poly]:
    """The sums that are squared in what was evaluated, in normal form."""
    forms = [session.domain.field.normal(s) for s in session.domain.squared]
    return [s for k, s in enumerate(forms) if len(s) > 1 and s not in forms[:k]]


def set_aside(session: Session, p: Poly, prove: Callable[[Exact], Entry | None]) -> Entry | None:
    """The entry of c s^2 and of what is left of p, which is shorter, for a square s^2 that is written."""
    for square in written(session):
        for c, rest in _shares(session, p, square):
            entry = prove(session.domain.polynomial(rest))
            if entry is not None and "terms" in entry:
                times = entry.get("times", [])
                json = session.domain.field.json
                number, factors = (str(coefficient(c)), []) if c.is_constant() else ("1", [json(c)])
                term = [number, [*factors, *times], [json(square)]]
                return entry | {"terms": [term, *entry["terms"]]}
    return None


def _shares(session: Session, p: Poly, square: Poly) -> Iterator[tuple[Poly, Poly]]:
    """Positive monomials c with which p - c s^2 is shorter than p, and that."""
    field, signs = session.domain.field, session.domain.signs
    whole = field.normal(square * square)
    tried: list[Poly] = []
    for (m, a), (n, b) in product(p.terms(), whole.terms()):
        powers = tuple(int(x) - int(y) for x, y in zip(m, n, strict=True))
        if min(powers) < 0 or a / b <= 0:
            continue
        c = field.context.from_dict({powers: a / b})
        if c in tried or signs.of(c) != "positive":
            continue
        tried.append(c)
        rest = p - c * whole
        if len(rest) < len(p):
            yield c, rest
        if len(tried) >= MAX_SHARES:
            return
