"""Quadratic forms of matrices that are assumed to be definite: the factor x'Px of a term, and its value."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from symctrl.decide.coefficients import coefficient_of, generator_of
from symctrl.decide.factors import Term
from symctrl.decide.session import Session
from symctrl.domains.field import Exact, Poly, coefficient

Form = tuple[dict[str, Any], Poly]  # the factor of a term, and its value


def form_of(session: Session, matrix: Sequence[Exact], x: Sequence[Exact]) -> Form | None:
    """x'Px for a matrix (column by column) that is assumed to be definite; None where no assumption is of it,
    or where a denominator occurs.
    """
    domain = session.domain
    for k, values in _assumed(session):
        if len(values) != len(x) ** 2 or not all(
            domain.is_zero(domain.sub_(a, b)) for a, b in zip(matrix, values, strict=True)
        ):
            continue
        exact = [domain.simplified(value) for value in (_product(session, values, x), *x)]
        if all(set(value) <= {()} for value in exact):
            total, *vector = [value.get((), domain.field.polynomial(0)) for value in exact]
            return {"given": k, "vector": [domain.field.json(e) for e in vector]}, total
    return None


def forms_in(session: Session, p: Poly) -> Iterator[Form]:
    """The forms that occur in a polynomial, of each assumed matrix of plain symbols: x is read off from what
    stands beside the entries.
    """
    field = session.domain.field
    for k, values in _assumed(session):
        entries = [entry for value in values if (entry := generator_of(field, value)) is not None]
        if len(values) == 1 or len(entries) < len(values):
            continue
        n = session.problem.given[k].size
        rows = [entries[r::n] for r in range(n)]
        x = _vector(session, p, rows)
        if x is None:
            continue
        total = field.polynomial(0)
        for r, row in enumerate(rows):
            for c, entry in enumerate(row):
                total = total + x[r] * field.variable(entry) * x[c]
        yield {"given": k, "vector": [field.json(field.normal(e)) for e in x]}, field.normal(total)


def without_forms(session: Session, p: Poly) -> Iterator[tuple[Term, Poly]]:
    """A positive multiple of a form of several entries as a term, and what of p is left without these."""
    field = session.domain.field
    for factor, value in forms_in(session, p):
        c = dict(p.to_dict()).get(tuple(value.monomial(0)), 0) / value.leading_coefficient()
        rest = p - value * c
        entries = field.occurring(value) - field.occurring(rest)
        if c > 0 and len(entries) > 1:
            yield [str(c), [factor], []], rest


def _assumed(session: Session) -> Iterator[tuple[int, list[Exact]]]:
    """The matrices that are assumed to be definite: the assumption's index, the entries column by column."""
    for k, assumption in enumerate(session.problem.given):
        if assumption.kind.startswith("positive_"):
            yield k, [session.at(of, {"i": "i"}) for of in assumption.of]


def _product(session: Session, matrix: Sequence[Exact], x: Sequence[Exact]) -> Exact:
    domain, n = session.domain, len(x)
    total: Exact = {}
    for r in range(n):
        for c in range(n):
            total = domain.add_(total, domain.mul_(domain.mul_(x[r], matrix[r + n * c]), x[c]))
    return total


def _vector(session: Session, p: Poly, rows: list[list[int]]) -> list[Poly] | None:
    """x with the diagonal entries' coefficients as its squares and the others' as its products, up to a
    factor.
    """
    field, n = session.domain.field, len(rows)
    squares = [_square_root(session, coefficient_of(field, p, {rows[r][r]: 1})) for r in range(n)]
    x = [s for s in squares if s is not None]
    if len(x) < n or all(s.is_zero() for s in x):
        return None
    first = next(r for r in range(n) if not x[r].is_zero())
    for r in range(first + 1, n):
        mixed = coefficient_of(field, p, {rows[first][r]: 1})
        if not mixed.is_zero() and mixed.leading_coefficient() * (x[first] * x[r]).leading_coefficient() < 0:
            x[r] = -x[r]
    return x


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
