"""Polynomials over Q in a certificate about a polynomial: their form, and arithmetic that knows its bounds.

Soundness-critical. Last reviewed 2026-11-24.

Relies on no theorem. A monomial x^2 y is packed into one integer, 16 bits a variable, so that a product of
monomials is a sum; every degree is checked before it can exceed these bits.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import lcm
from typing import Any

from symctrl.kernel.certificate import Declined, Invalid, rational, typed

MAX_DEGREE = 1000  # of a polynomial that is written down
MAX_TERMS = 200_000  # of a polynomial
MAX_BITS = 10**9  # of a polynomial over its common denominator
MAX_PRODUCTS = 5 * 10**7  # of two terms, in words of 512 bits

_BITS = 16  # of an exponent in a packed monomial; degrees are kept below 2^15
_LARGEST = (1 << 15) - 1

Poly = dict[int, int]  # packed monomial: coefficient, none of them zero


@dataclass(frozen=True, slots=True)
class Rational:
    """terms / denominator, of total degree at most `degree`."""

    terms: Poly
    denominator: int
    degree: int


def _monomial(value: Any, n: int, where: str) -> tuple[int, int]:
    """(packed, degree) of [variable, exponent, ..] with increasing variables and positive exponents."""
    flat = typed(value, list, where)
    if len(flat) % 2 or any(type(a) is not int for a in flat):
        raise Invalid(f"{where}: a monomial is not a list of variables and exponents by turns")
    variables, exponents = flat[::2], flat[1::2]
    if any(not 0 <= v < n for v in variables) or any(a >= b for a, b in pairwise(variables)):
        raise Invalid(f"{where}: a monomial does not have increasing variables from 0 to {n - 1}")
    if any(e < 1 for e in exponents):
        raise Invalid(f"{where}: an exponent is not positive")
    degree = sum(exponents)
    if degree > MAX_DEGREE:
        raise Declined(f"{where}: a degree above {MAX_DEGREE}")
    packed = 0
    for v, e in zip(variables, exponents, strict=True):
        packed += e << (_BITS * v)
    return packed, degree


def _terms(value: Any, n: int, where: str) -> list[tuple[Any, int, int]]:
    """(coefficient as written, packed monomial, degree) of each term, in their one order."""
    table = typed(value, list, where)
    if len(table) > MAX_TERMS:
        raise Declined(f"{where}: more than {MAX_TERMS} terms")
    result = []
    last = None
    for term in table:
        if type(term) is not list or len(term) != 2:
            raise Invalid(f"{where}: {str(term)[:60]} is not [coefficient, monomial]")
        packed, degree = _monomial(term[1], n, where)
        if last is not None and not last < term[1]:
            raise Invalid(f"{where}: a monomial is not greater than the one before it")
        last = term[1]
        result.append((term[0], packed, degree))
    return result


def rational_poly(value: Any, n: int, where: str) -> Rational:
    """A polynomial in n variables whose coefficients are strings "p/q". Raises Invalid, Declined."""
    terms = _terms(value, n, where)
    numbers = [rational(typed(c, str, where), where) for c, _, _ in terms]
    if not all(numbers):
        raise Invalid(f"{where}: a coefficient is zero")
    bits = sum({c.denominator: c.denominator.bit_length() for c in numbers}.values())
    bits += max((c.numerator.bit_length() for c in numbers), default=0)
    if bits * len(numbers) > MAX_BITS:
        raise Declined(f"{where}: numbers over their common denominator are too long")
    d = lcm(*(c.denominator for c in numbers))
    packed = {m: c.numerator * (d // c.denominator) for c, (_, m, _) in zip(numbers, terms, strict=True)}
    return Rational(packed, d, max((degree for _, _, degree in terms), default=0))


def integer_poly(value: Any, n: int, where: str) -> Rational:
    """A polynomial in n variables whose coefficients are integers. Raises Invalid, Declined."""
    terms = _terms(value, n, where)
    if any(type(c) is not int or c == 0 for c, _, _ in terms):
        raise Invalid(f"{where}: a coefficient of a basis is not an integer, or zero")
    return Rational({m: c for c, m, _ in terms}, 1, max((degree for _, _, degree in terms), default=0))


class Work:
    """Arithmetic of polynomials that declines before it is too much."""

    def __init__(self) -> None:
        self.left = MAX_PRODUCTS

    def spend(self, products: int, bits: int) -> None:
        self.left -= products * (1 + bits // 512)
        if self.left < 0:
            raise Declined(f"the identity takes more than {MAX_PRODUCTS} products of two terms")

    def times(self, p: Rational, q: Rational) -> Rational:
        """p q."""
        if p.degree + q.degree > _LARGEST:
            raise Declined("a degree is too large")
        self.spend(len(p.terms) * len(q.terms), _bits(p.terms) + _bits(q.terms))
        product: Poly = {}
        for m, a in p.terms.items():
            for k, b in q.terms.items():
                product[m + k] = product.get(m + k, 0) + a * b
        return Rational(_clean(product), p.denominator * q.denominator, p.degree + q.degree)

    def form(self, basis: Sequence[Rational], gram: Sequence[Sequence[int]]) -> Poly:
        """b' H b."""
        n, bits = len(basis), longest(gram) + 2 * max(_bits(b.terms) for b in basis)
        distinct = len({m for b in basis for m in b.terms})
        self.spend(sum(len(b.terms) for b in basis) * (n + distinct), bits)
        result: Poly = {}
        if all(len(b.terms) == 1 for b in basis):
            single = [next(iter(b.terms.items())) for b in basis]
            for i, (m, a) in enumerate(single):
                for (k, b), h in zip(single, gram[i], strict=False):
                    value = a * b * h
                    result[m + k] = result.get(m + k, 0) + value + value
                result[m + m] -= a * a * gram[i][i]
            return _clean(result)
        for i, left in enumerate(basis):
            image: Poly = {}  # twice the row below the diagonal, and the diagonal
            for j in range(i + 1):
                h = gram[i][j] * (1 if i == j else 2)
                for m, b in basis[j].terms.items():
                    image[m] = image.get(m, 0) + h * b
            for m, a in left.terms.items():
                for k, b in image.items():
                    result[m + k] = result.get(m + k, 0) + a * b
        return _clean(result)

    def total(self, summands: Sequence[Rational], constant: Fraction) -> Rational:
        """The sum, and the constant."""
        d = constant.denominator
        for p in summands:
            d = lcm(d, p.denominator)
            self.spend(1, d.bit_length())
        self.spend(sum(len(p.terms) for p in summands), d.bit_length())
        result: Poly = {0: constant.numerator * (d // constant.denominator)}
        for p in summands:
            factor = d // p.denominator
            for m, c in p.terms.items():
                result[m] = result.get(m, 0) + c * factor
        return Rational(_clean(result), d, max((p.degree for p in summands), default=0))


def _bits(p: Poly) -> int:
    return max(map(abs, p.values()), default=0).bit_length()


def _clean(p: Poly) -> Poly:
    return {m: c for m, c in p.items() if c}


def longest(rows: Sequence[Sequence[int]]) -> int:
    """Bits of the longest entry."""
    return max(max(map(abs, row)) for row in rows).bit_length()


def exponents(m: int) -> Iterator[tuple[int, int]]:
    """(variable, exponent) of a packed monomial, without exponents that are zero."""
    while m:
        k = ((m & -m).bit_length() - 1) // _BITS
        e = (m >> (_BITS * k)) & ((1 << _BITS) - 1)
        yield k, e
        m -= e << (_BITS * k)


def sign_at(p: Rational, point: Sequence[Fraction]) -> int:
    """A number with the sign of p at the point. Raises Declined where it would be too long."""
    d = lcm(*(x.denominator for x in point))
    numbers = [x.numerator * (d // x.denominator) for x in point]
    bits = max((abs(a) for a in numbers), default=0).bit_length() + d.bit_length()
    if (bits + 1) * (p.degree + 1) * (len(p.terms) + 1) > MAX_BITS:
        raise Declined("the point has too many digits")
    total = 0
    for m, c in p.terms.items():
        value, left = c, p.degree
        for k, e in exponents(m):
            value *= numbers[k] ** e
            left -= e
        total += value * d**left
    return total
