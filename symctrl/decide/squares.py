"""A sign by squares: a polynomial of degree two by its exact LDLᵀ, or one symbol after another completed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

from symctrl.decide.coefficients import coefficient_of
from symctrl.decide.definiteness import decide_matrix
from symctrl.decide.factors import Term
from symctrl.decide.session import Session
from symctrl.domains.field import Poly, coefficient


def as_squares(session: Session, p: Poly) -> list[Term] | None:
    """p as a quadratic form in 1 and its symbols, if its exact LDLᵀ has no negative pivot."""
    field = session.domain.field
    if p.total_degree() > 2:
        return None
    variables = sorted(field.occurring(p))
    basis = [field.polynomial(1), *(field.variable(k) for k in variables)]
    leaf = decide_matrix(_gram(session, p, variables)).leaf
    if leaf is None or "ldl" not in leaf:
        return None
    lower, diagonal = leaf["ldl"]["lower"], leaf["ldl"]["diagonal"]
    return [
        [str(d), [], [field.json(_combined(session, basis[k:], [row[k] for row in lower[k:]]))]]
        for k, d in enumerate(diagonal)
        if Fraction(d)
    ]


def _gram(session: Session, p: Poly, variables: Sequence[int]) -> list[list[Fraction]]:
    """The symmetric matrix of p as a form in 1 and the variables."""
    field = session.domain.field
    size = len(variables) + 1
    gram = [[Fraction(0)] * size for _ in range(size)]
    place = {k: n + 1 for n, k in enumerate(variables)}
    for exponents, c in p.terms():
        at = [place[field.size - 1 - v] for v, e in enumerate(exponents) for _ in range(int(e))]
        i, j = [*at, 0, 0][:2]
        number = Fraction(int(c.p), int(c.q))
        gram[i][j] += number / 2
        gram[j][i] += number / 2
    return gram


def _combined(session: Session, basis: Sequence[Poly], weights: Sequence[Any]) -> Poly:
    """The sum of the polynomials times rational weights."""
    field = session.domain.field
    total = field.polynomial(0)
    for polynomial, weight in zip(basis, map(Fraction, weights), strict=True):
        if weight:
            total = total + polynomial * field.polynomial(weight).leading_coefficient()
    return total


def completed(session: Session, p: Poly) -> Iterator[tuple[Term, Poly]]:
    """A completed square a (x + b)^2, with a known to be positive, as a term, and the rest without x.

    Of a form that is not negative any such square can come first: the first that there is decides, so that
    there is at most one.
    """
    field = session.domain.field
    for k, a, b, _ in _quadratic(session, p):
        half, rest = divmod(b, 2 * a)
        if not rest.is_zero():
            continue
        square = field.variable(k) + half
        number, factors = (str(coefficient(a)), []) if a.is_constant() else ("1", [field.json(a)])
        yield [number, factors, [field.json(square)]], p - a * square * square
        return


def completed_with_multiplier(session: Session, p: Poly) -> tuple[Poly, Term, Poly] | None:
    """4 a (a x^2 + b x + c) = (2 a x + b)^2 + (4 a c - b^2), with a known to be positive.

    4 a, the square as a term, and the rest. The first such symbol whose square cannot be completed without a
    multiplier decides.
    """
    field = session.domain.field
    for k, a, b, c in _quadratic(session, p):
        if not divmod(b, 2 * a)[1].is_zero():
            square = 2 * a * field.variable(k) + b
            return 4 * a, ["1", [], [field.json(square)]], 4 * a * c - b * b
    return None


def _quadratic(session: Session, p: Poly) -> Iterator[tuple[int, Poly, Poly, Poly]]:
    """The symbols x of unknown sign with p = a x^2 + b x + c and a known to be positive: x, a, b, c."""
    field, signs = session.domain.field, session.domain.signs
    for k in sorted(field.occurring(p)) if not p.is_zero() else ():
        if signs.generator.get(k) is not None or field.generators[k].kind != "free":
            continue
        a, b, c = (coefficient_of(field, p, {k: power}) for power in (2, 1, 0))
        if not a.is_zero() and p.degrees()[field.size - 1 - k] == 2 and signs.of(a) == "positive":
            yield k, a, b, c
