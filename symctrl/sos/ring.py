"""Polynomials over Q in named variables: python-flint's, and what they are in a certificate."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from math import lcm
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly_ctx

Poly = Any  # fmpq_mpoly
Ring = Any  # fmpq_mpoly_ctx
Monomial = tuple[int, ...]


def ring(names: Sequence[str]) -> Ring:
    """The polynomials over Q in the variables of these names."""
    return fmpq_mpoly_ctx.get(tuple(names), Ordering.degrevlex)


def to_fmpq(value: Fraction | int) -> Any:
    """A number for python-flint."""
    return fmpq(value.numerator, value.denominator)


def to_fraction(value: Any) -> Fraction:
    """A number of python-flint as a Fraction."""
    return Fraction(int(value.p), int(value.q))


def from_terms(over: Ring, terms: Mapping[Monomial, Fraction | int]) -> Poly:
    """The polynomial with these coefficients."""
    return over.from_dict({m: to_fmpq(c) for m, c in terms.items() if c})


def monomial(over: Ring, exponents: Monomial, coefficient: int = 1) -> Poly:
    """One term."""
    return over.from_dict({tuple(exponents): coefficient})


def terms(p: Poly) -> dict[Monomial, Fraction]:
    """The coefficients by exponents."""
    return {tuple(map(int, m)): to_fraction(c) for m, c in p.to_dict().items()}


def denominator(p: Poly) -> int:
    """The least d > 0 that makes the coefficients of d p integers."""
    return lcm(*(int(c.q) for c in p.coeffs()))


def degree(p: Poly) -> int:
    """The total degree; 0 of a constant, the zero polynomial among them."""
    return max((int(sum(m)) for m in p.monoms()), default=0)


def flat(exponents: Iterable[int]) -> list[int]:
    """A monomial as it stands in a certificate: [variable, exponent, ..]."""
    return [a for k, e in enumerate(exponents) if e for a in (k, int(e))]


def rational_terms(p: Poly) -> list[list[Any]]:
    """A polynomial as it stands in a statement."""
    return sorted(([str(to_fraction(c)), flat(m)] for m, c in p.to_dict().items()), key=_second)


def integer_terms(p: Poly) -> list[list[Any]]:
    """A polynomial with integer coefficients as it stands in a basis."""
    return sorted(([int(c.p), flat(m)] for m, c in p.to_dict().items()), key=_second)


def _second(pair: list[Any]) -> Any:
    return pair[1]


def value_at(p: Poly, point: Sequence[Fraction]) -> Fraction:
    """p at the point, exactly."""
    return to_fraction(p(*map(to_fmpq, point)))
