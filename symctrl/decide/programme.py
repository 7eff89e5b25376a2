"""A sign by a linear programme: candidates are assumptions, their products and monomials, times squares.

The programme is solved in floating point and chooses among the candidates; their weights are then solved for
exactly.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, combinations_with_replacement
from math import isqrt
from typing import Any

import flint
import numpy as np

from symctrl.decide.factors import Term
from symctrl.decide.forms import Form, forms_in
from symctrl.decide.session import Session
from symctrl.domains.beside import not_negative, pairs_of_one_sign
from symctrl.domains.field import Poly

MAX_CANDIDATES = 1500
MAX_MONOMIALS = 8000
MAX_PRODUCTS = 25
MAX_PAIRED = 8  # symbols whose sums and differences are tried
MAX_TRIPLED = 8  # assumptions whose products of three are tried
TINY = 1e-9
Row = tuple[Any, ...]  # a monomial by its exponents
Column = Mapping[Row, Any]  # coefficients
Product = tuple[Poly, tuple[Any, ...]]  # its value, and its factors as in a term


@dataclass(frozen=True)
class Candidate:
    """A nonnegative polynomial: the product of assumptions (by index) or known polynomials, times squares."""

    value: Poly
    given: tuple[Any, ...]
    squares: tuple[Poly, ...]


def by_programme(
    session: Session, p: Poly, strict: bool, candidates: Sequence[Candidate]
) -> list[Term] | None:
    """The terms of p as a sum of positive multiples of candidates; None where none is found."""
    if not candidates:
        return None
    columns = [_by_monomial(candidate.value) for candidate in candidates]
    sure = [_is_sure(session, candidate) for candidate in candidates]
    used = weights_of(columns, _by_monomial(p), [-1.0 if strict and s else 1e-3 for s in sure])
    if used is None:
        return None
    if strict and not any(sure[n] for n, _ in used):
        return None
    json = session.domain.field.json
    return [
        [str(w), list(candidates[n].given), [json(square) for square in candidates[n].squares]]
        for n, w in used
    ]


def weights_of(
    columns: Sequence[Column], target: Column, cost: Sequence[float]
) -> list[tuple[int, Fraction]] | None:
    """Exact positive weights with which columns add up to the target, by number; None where none do."""
    rows = {row: n for n, row in enumerate({row: None for column in (*columns, target) for row in column})}
    if not columns or len(rows) > MAX_MONOMIALS:
        return None
    chosen = _chosen(rows, columns, target, cost)
    weights = None if chosen is None else _exact_weights([columns[n] for n in chosen], target)
    if chosen is None or weights is None or any(w < 0 for w in weights):
        return None
    return [(n, w) for n, w in zip(chosen, weights, strict=True) if w]


def _by_monomial(p: Poly) -> Column:
    return {tuple(map(int, e)): c for e, c in p.terms()}


def _floats(rows: Mapping[Row, int], columns: Sequence[Column]) -> Any:
    """The columns side by side in floating point."""
    matrix = np.zeros((len(rows), len(columns)))
    for n, column in enumerate(columns):
        for row, c in column.items():
            matrix[rows[row], n] = float(Fraction(int(c.p), int(c.q)))
    return matrix


def _chosen(
    rows: Mapping[Row, int], columns: Sequence[Column], target: Column, cost: Sequence[float]
) -> list[int] | None:
    """The columns that add up to the target about, at the least cost; None where none do."""
    from scipy.optimize import linprog

    matrix, right = _floats(rows, columns), _floats(rows, [target])[:, 0]
    widths = np.maximum(np.abs(matrix).max(axis=0), 1e-300)
    height = max(float(np.abs(right).max()), 1e-300)
    answer = linprog(
        cost, A_eq=matrix / widths, b_eq=right / height, bounds=[(0, 1e6)] * len(columns), method="highs"
    )
    return [n for n in range(len(columns)) if answer.x[n] > TINY] if answer.status == 0 else None


def _exact_weights(columns: Sequence[Column], target: Column) -> list[Fraction] | None:
    """The exact solution of sum w_n column_n = target, if there is one."""
    if not columns:
        return [] if not target else None
    rows = list({m: None for column in (*columns, target) for m in column})
    system = flint.fmpq_mat(
        len(rows), len(columns) + 1, [c.get(m, flint.fmpq(0)) for m in rows for c in (*columns, target)]
    )
    reduced, rank = system.rref()
    weights = [Fraction(0)] * len(columns)
    for r in range(rank):
        pivot = next(c for c in range(len(columns) + 1) if reduced[r, c] != 0)
        if pivot == len(columns):
            return None
        last = reduced[r, len(columns)]
        weights[pivot] = Fraction(int(last.p), int(last.q))
    return weights


def _is_sure(session: Session, candidate: Candidate) -> bool:
    """Is it certainly positive: a product of assumptions that something is positive?"""
    given = session.problem.given
    return not candidate.squares and all(
        isinstance(g, int) and given[g].kind == "positive" for g in candidate.given
    )


# Candidates


def candidates(
    session: Session, p: Poly, squares: Sequence[Poly], forms: Sequence[Form], wide: bool
) -> list[Candidate]:
    """The author's forms and squares with every product of assumptions first, then monomials and their pairs.

    wide: all products by themselves before any square, and squares with a constant in them.
    """
    products = _products(session)
    low = p.total_degree() + 2
    found = [
        Candidate(session.domain.field.normal(product * value), (*given, form), ())
        for form, value in [*forms, *(forms_in(session, p) if wide else ())]
        for product, given in products
    ]
    if wide:
        alone = [(q, given) for q, given in products if q.total_degree() <= low]
        found += [Candidate(session.domain.field.normal(q), given, ()) for q, given in alone]
    found += [
        Candidate(session.domain.field.normal(product * square * square), given, (square,))
        for square in squares
        for product, given in products
    ]
    for candidate in _times_squares(session, p, products, wide):
        found.append(candidate)
        if len(found) >= MAX_CANDIDATES:
            break
    return found


def _times_squares(session: Session, p: Poly, products: Sequence[Product], wide: bool) -> Iterator[Candidate]:
    """Each product times each square of no higher degree than p's."""
    one, low = session.domain.field.polynomial(1), p.total_degree() + (2 if wide else 0)
    own = _squares(session, p, wide)
    for product, given in products:
        for square in own:
            if product.total_degree() + 2 * square.total_degree() <= low:
                value = session.domain.field.normal(product * square * square)
                yield Candidate(value, given, () if square == one else (square,))


def _products(session: Session) -> list[Product]:
    """1, what is known not to be negative, and products of two and, where it is little, of three."""
    facts: list[Product] = [(q, (k,)) for k, q in _facts(session)]
    pairs = combinations_with_replacement(facts, 2)
    triples = combinations(facts, 3) if len(facts) <= MAX_TRIPLED else ()
    return [
        (session.domain.field.polynomial(1), ()),
        *facts,
        *((a * b, (*x, *y)) for (a, x), (b, y) in pairs),
        *((a * b * c, (*x, *y, *z)) for (a, x), (b, y), (c, z) in triples),
    ]


def _facts(session: Session) -> Iterator[tuple[Any, Poly]]:
    """The nonnegative assumptions at node i, by index; then symbols of its neighbour and opaque generators
    that are not negative, by POLY.
    """
    field, known = session.domain.field, session.domain.signs.generator
    for k, assumption in enumerate(session.problem.given):
        if assumption.kind in ("positive", "nonnegative"):
            yield k, session.carrier(session.at(assumption.of[0], {"i": "i"}))
    for b in session.cases.values():
        if not (supposed := field.normal(b)).is_constant():
            yield field.json(supposed), supposed
    yield from ((field.json(p), p) for p in _implied(session))
    for k, g in enumerate(field.generators):
        if k in session.cases:
            continue
        of_neighbour = g.kind == "free" and ".j" in g.name and known.get(k) in ("positive", "nonnegative")
        if of_neighbour or g.kind in ("root", "abs", "exp", "power"):
            yield field.json(field.variable(k)), field.variable(k)
        for beside in _beside(session, k):
            yield field.json(beside), beside


def _implied(session: Session) -> Iterator[Poly]:
    """Factors of what is known not to be negative whose sign is known by it; c |b| - r for c^2 b^2 - r^2."""
    field, signs = session.domain.field, session.domain.signs
    sizes = [(field.variable(k), g.argument) for k, g in enumerate(field.generators) if g.kind == "abs"]
    for fact, kind in signs.facts:
        _, pairs = fact.factor() if kind != "nonzero" and len(fact) > 1 else (1, [])
        factors = [f for f, e in pairs if e % 2]
        if len(factors) < 2:
            continue
        found = [side * f for f in factors if len(f) > 1 for side in (1, -1)]
        if len(factors) == 2:
            f, g = factors
            for m, b in sizes:
                for side in (1, -1):
                    c, rest = divmod(f + side * g, 2 * b)
                    r = (f - side * g) / 2
                    if rest.is_zero() and not c.is_zero():
                        found += [u * c * m + v * r for u in (1, -1) for v in (1, -1)]
        yield from (p for p in found if signs.of(p) in ("positive", "nonnegative"))


def _beside(session: Session, k: int) -> list[Poly]:
    """What the definition of a generator shows not to be negative."""
    field = session.domain.field
    products = (u * v for u, v in pairs_of_one_sign(field, k))
    found = [p for p, _ in not_negative(field, k)] + [
        p for q in products if not (p := field.normal(q)).is_zero()
    ]
    return found + [a for a in inside_logarithm(session, k) if len(a) > 1]


def inside_logarithm(session: Session, k: int) -> list[Poly]:
    """The argument of a logarithm, where it is a positive polynomial."""
    g = session.domain.field.generators[k]
    inside = g.argument[0] if g.kind == "function" and g.name == "log" else {}
    return [a for a in inside.values() if set(inside) == {()} and session.domain.signs.of(a) == "positive"]


def _squares(session: Session, p: Poly, wide: bool) -> list[Poly]:
    """Monomials whose squares may occur, their sums and differences in pairs; if wide, without the symbols of
    known sign where there are many, and in pairs with 1.
    """
    one = session.domain.field.polynomial(1)
    variables = _bases(session, p, wide)
    ends = [one, *variables] if wide else variables
    few = len(variables) <= MAX_PAIRED
    pairs = [a + s * b for a, b in combinations(ends, 2) for s in (1, -1)] if few else []
    products = [a * b for a, b in combinations_with_replacement(variables, 2)] if p.total_degree() > 3 else []
    minors = [a - b for a, b in combinations(products, 2)] if len(products) <= MAX_PRODUCTS else []
    return [one, *variables, *pairs, *(_edges(session, variables) if wide else []), *products, *minors]


def _edges(session: Session, variables: Sequence[Poly]) -> list[Poly]:
    """x - r and x + r for symbols x with c - x^2 - .. >= 0 assumed, and the root r of a rational c."""
    found = []
    for fact, _ in session.domain.signs.facts:
        c = fact.to_dict().get((0,) * session.domain.field.size, 0)
        root = Fraction(isqrt(int(c.p)), isqrt(int(c.q))) if c > 0 else Fraction(0)
        if root and root * root == Fraction(int(c.p), int(c.q)):
            r = session.domain.field.polynomial(root)
            inside = [x for x in variables if fact.to_dict().get(tuple((x * x).monomial(0)), 0) < 0]
            found += [x + side * r for x in inside for side in (1, -1) if root != 1]
    return found


def _bases(session: Session, p: Poly, wide: bool) -> list[Poly]:
    """The symbols of p and of the relations that speak of these, and all opaque generators."""
    field = session.domain.field
    opaque = {k for k, g in enumerate(field.generators) if g.kind not in ("free", "sum")}
    near = [field.occurring(r) for r in field.relations if field.occurring(r) & field.occurring(p)]
    occurring = field.occurring(p).union(opaque, *near)
    spoken = [
        field.occurring(f) for f, _ in session.domain.signs.facts if field.occurring(f) & field.occurring(p)
    ]
    if wide and len(more := occurring.union(*spoken)) <= MAX_PAIRED:
        occurring = more
    if wide and len(occurring) > MAX_PAIRED:
        occurring -= {k for k, sign in session.domain.signs.generator.items() if sign == "positive"}
    return [field.variable(k) for k in sorted(occurring)]
