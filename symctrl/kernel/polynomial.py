"""Polynomials with rational coefficients: sums, products, exact quotients and normal forms.

Soundness-critical. Last reviewed 2026-11-24.

Relies on: p is congruent to its normal form modulo the ideal of the relations that rewrote it, whatever the
order of rewriting, since each step subtracts a multiple of a relation; so a normal form 0 proves that p
vanishes wherever the relations do (the converse is not used). Rewriting ends because it replaces a monomial
by smaller ones in a well-ordering.

A polynomial is {monomial: coefficient} without zero coefficients. A monomial is one integer, 16 bits for each
variable with the highest bit kept free: no sum of two carries into the next variable before it is noticed.
As integers, monomials are ordered lexicographically, later variables first.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from heapq import heapify, heappop, heappush
from math import lcm

from symctrl.kernel.certificate import Declined

Number = int | Fraction
Poly = dict[int, Number]
Relation = tuple[int, Poly]  # a leading monomial and the smaller polynomial that it equals

BITS = 16
MAX_EXPONENT = 2 ** (BITS - 1) - 1
MAX_VARIABLES = 4096
MAX_WORK = 200_000_000
MAX_COEFFICIENT_BITS = 200_000


def monomial(powers: Sequence[tuple[int, int]]) -> int:
    """The packed product of variables to exponents up to MAX_EXPONENT; no variable twice."""
    return sum(exponent << (BITS * k) for k, exponent in powers)


def powers(packed: int) -> list[tuple[int, int]]:
    """The (variable, exponent) pairs of a packed monomial, variables increasing."""
    result, k = [], 0
    while packed:
        skip = (packed & -packed).bit_length() // BITS if not packed & 0xFFFF else 0
        k, packed = k + skip, packed >> (BITS * skip)
        if packed & 0xFFFF:
            result.append((k, packed & 0xFFFF))
        k, packed = k + 1, packed >> BITS
    return result


def variables(p: Poly) -> set[int]:
    """The variables that occur in a polynomial."""
    return {k for k, _ in powers(_bound(p))}


def relation(p: Poly) -> Relation:
    """The relation p = 0 solved for its leading monomial; p is not constant."""
    lead = max(p)
    return lead, {m: tidy(Fraction(-c) / p[lead]) for m, c in p.items() if m != lead}


def tidy(c: Fraction) -> Number:
    """The same number, as an int where it is one."""
    return c.numerator if c.denominator == 1 else c


class Ring:
    """Arithmetic in a number of variables, with a bound on all the work done: Declined beyond it."""

    def __init__(self, count: int) -> None:
        if count > MAX_VARIABLES:
            raise Declined(f"{count} generators are more than the limit {MAX_VARIABLES}")
        self._guard = sum(1 << (BITS * k + BITS - 1) for k in range(count))
        self._work = 0

    def spend(self, steps: int) -> None:
        self._work += steps
        if self._work > MAX_WORK:
            raise Declined("the check takes more steps than the limit")

    def add(self, p: Poly, q: Poly) -> Poly:
        if len(p) < len(q):
            p, q = q, p
        self.spend(len(p))
        result = dict(p)
        for m, c in q.items():
            total = result.get(m, 0) + c
            if total:
                result[m] = total
            else:
                del result[m]
        return result

    def scale(self, p: Poly, factor: Number) -> Poly:
        factor = tidy(Fraction(factor))
        return {m: c * factor for m, c in p.items()} if factor else {}

    def mul(self, p: Poly, q: Poly) -> Poly:
        """Raises Declined where an exponent or a coefficient could become too large."""
        self.spend(len(p) * len(q) + 1)
        self._require_room(p, q)
        (d, p), (e, q) = _integral(p), _integral(q)
        result: Poly = {}
        get = result.get
        for m, c in p.items():
            for n, d_n in q.items():
                k = m + n
                result[k] = get(k, 0) + c * d_n
        return _over(result, d * e)

    def power(self, p: Poly, n: int) -> Poly:
        """p to the power n >= 0."""
        if n == 0:
            return {0: 1}
        half = self.power(p, n // 2)
        square = self.mul(half, half)
        return self.mul(square, p) if n % 2 else square

    def _require_room(self, p: Poly, q: Poly) -> None:
        if (_bound(p) + _bound(q)) & self._guard:
            raise Declined(f"an exponent may exceed the limit {MAX_EXPONENT}")
        sizes = [
            max((c.numerator.bit_length() + c.denominator.bit_length() for c in one.values()), default=0)
            for one in (p, q)
        ]
        if sum(sizes) > MAX_COEFFICIENT_BITS:
            raise Declined("a coefficient has too many digits")

    def divides(self, m: int, n: int) -> bool:
        """Does the monomial m divide n?"""
        return m <= n and ((n | self._guard) - m) & self._guard == self._guard

    def quotient(self, p: Poly, divisor: Poly) -> Poly | None:
        """p / divisor where that is a polynomial, else None; the divisor is not zero."""
        if p and not (self.divides(max(divisor), max(p)) and self.divides(min(divisor), min(p))):
            return None
        remainder, quotient = self._divide(p, [relation(divisor)], stop=True)
        if remainder:
            return None
        lead = divisor[max(divisor)]
        return {m: tidy(Fraction(c) / lead) for m, c in quotient.items()}

    def normal(self, p: Poly, relations: Sequence[Relation]) -> Poly:
        """p rewritten by the relations until no leading monomial of one divides a monomial of it."""
        return self._divide(p, relations, stop=False)[0]

    def _divide(self, p: Poly, relations: Sequence[Relation], stop: bool) -> tuple[Poly, Poly]:
        """(remainder, multiples of leads that were replaced); `stop` at the first remaining term."""
        d, rest = _integral(p)
        heap = [-m for m in rest]
        heapify(heap)
        remainder: Poly = {}
        replaced: Poly = {}
        bounds = [_bound(tail) for _, tail in relations]
        while heap:
            m = -heappop(heap)
            c = rest.pop(m, 0)
            if not c:
                continue
            found = next((r for r, (lead, _) in enumerate(relations) if self.divides(lead, m)), None)
            if found is None:
                remainder[m] = c
                if stop:
                    return remainder, replaced
                continue
            lead, tail = relations[found]
            by = m - lead
            self.spend(len(tail) + 1)
            if (by + bounds[found]) & self._guard:
                raise Declined(f"an exponent may exceed the limit {MAX_EXPONENT}")
            if c.numerator.bit_length() > MAX_COEFFICIENT_BITS:
                raise Declined("a coefficient has too many digits")
            replaced[by] = c
            for n, t in tail.items():
                k = by + n
                if k in rest:
                    rest[k] += c * t
                else:
                    rest[k] = c * t
                    heappush(heap, -k)
        return _over(remainder, d), _over(replaced, d)


def _bound(p: Poly) -> int:
    """At least the largest exponent of each variable, packed like a monomial."""
    bound = 0
    for m in p:
        bound |= m
    return bound


def _integral(p: Poly) -> tuple[int, Poly]:
    """(d, d p) with the least d > 0 that makes the coefficients integers. The polynomial is a new one."""
    d = lcm(*{c.denominator for c in p.values()})
    return d, {m: c.numerator * (d // c.denominator) for m, c in p.items()}


def _over(p: Mapping[int, Number], d: int) -> Poly:
    """p / d without the terms that are zero."""
    if d == 1:
        return {m: c for m, c in p.items() if c}
    return {m: tidy(Fraction(c) / d) for m, c in p.items() if c}
