"""Quadratic forms of assumed definite matrices that occur in a polynomial: x'Px, with x read off P's part."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from symctrl.decide.session import Session
from symctrl.domains.field import Poly, coefficient


def forms_in(session: Session, p: Poly) -> Iterator[tuple[dict[str, Any], Poly]]:
    """For each assumed definite matrix of plain symbols: the factor of a term, and its value."""
    field, domain = session.domain.field, session.domain
    for k, assumption in enumerate(session.problem.given):
        n = assumption.size
        if n < 2 or not assumption.kind.startswith("positive_"):
            continue
        rows = [
            [_symbol(session, session.at(assumption.of[r + n * c], {"i": "i"})) for c in range(n)]
            for r in range(n)
        ]
        if any(entry is None for row in rows for entry in row):
            continue
        x = _vector(session, p, [[e for e in row if e is not None] for row in rows])
        if x is None:
            continue
        total = field.polynomial(0)
        for r in range(n):
            for c in range(n):
                entry = rows[r][c]
                assert entry is not None
                total = total + x[r] * field.variable(entry) * x[c]
        yield {"given": k, "vector": [field.json(domain.field.normal(e)) for e in x]}, field.normal(total)


def _symbol(session: Session, value: Any) -> int | None:
    field = session.domain.field
    if set(value) != {()} or len(value[()]) != 1:
        return None
    occurring = field.occurring(value[()])
    if len(occurring) != 1:
        return None
    (k,) = occurring
    return k if value[()] == field.variable(k) else None


def _vector(session: Session, p: Poly, rows: list[list[int]]) -> list[Poly] | None:
    """x with the diagonal entries' coefficients as its squares and the others' as its products, up to a
    factor.
    """
    n = len(rows)
    squares = [_square_root(session, _linear(session, p, rows[r][r])) for r in range(n)]
    if None in squares or all(s is not None and s.is_zero() for s in squares):
        return None
    x = [s for s in squares if s is not None]
    first = next(r for r in range(n) if not x[r].is_zero())
    for r in range(first + 1, n):
        mixed = _linear(session, p, rows[first][r])
        if not mixed.is_zero() and mixed.leading_coefficient() * (x[first] * x[r]).leading_coefficient() < 0:
            x[r] = -x[r]
    return x


def _linear(session: Session, p: Poly, k: int) -> Poly:
    """The coefficient of a generator that occurs linearly."""
    field = session.domain.field
    column = field.size - 1 - k
    kept = {
        tuple(0 if v == column else int(x) for v, x in enumerate(e)): c
        for e, c in p.terms()
        if e[column] == 1
    }
    return field.context.from_dict(kept)


def _square_root(session: Session, p: Poly) -> Poly | None:
    """A polynomial whose square is p up to a positive number, and up to factors that are known to be
    positive.
    """
    field = session.domain.field
    if p.is_zero():
        return p
    number, pairs = p.factor()
    if coefficient(field.polynomial(1) * number) <= 0:
        return None
    root = field.polynomial(1)
    for f, e in pairs:
        if e % 2 and session.domain.signs.of(f) != "positive":
            return None
        root = root * f ** (int(e) // 2)
    return root
