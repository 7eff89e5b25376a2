"""Quotients whose denominators are products of nonzero factors, as sums of fractions; the zero test.

Soundness-critical. Last reviewed 2026-11-24.

Relies on: a sum of fractions whose denominators vanish nowhere is zero exactly where its numerator over a
common denominator is, and a numerator with normal form 0 is zero wherever the relations hold (`polynomial`).

A Value is {key: numerator}, key = ((factor, exponent), ..) with increasing factors and positive exponents:
the sum of numerator / product of factor^exponent. It stands for a real number at every point of the domain.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import Any

from symctrl.kernel.certificate import Invalid, natural, rational, several, typed
from symctrl.kernel.polynomial import MAX_EXPONENT, Number, Poly, Relation, Ring, monomial, tidy

Key = tuple[tuple[int, int], ...]
Value = dict[Key, Poly]


def read_poly(value: Any, variables: int, where: str) -> Poly:
    """A POLY of docs/certificates.md over so many generators. Raises Invalid."""
    result: Poly = {}
    for term in typed(value, list, where):
        typed(term, list, where)
        if len(term) % 2 == 0:
            raise Invalid(f"{where}: a term is [coefficient, generator, exponent, ..]")
        coefficient = rational(term[0], where)
        packed = monomial(read_powers(list(zip(term[1::2], term[2::2], strict=True)), variables, where))
        if coefficient == 0 or packed in result:
            raise Invalid(f"{where}: a term is zero or occurs twice")
        result[packed] = tidy(coefficient)
    return result


def read_powers(pairs: Iterable[Any], below: int, where: str, signed: bool = False) -> Key:
    """(index, exponent) pairs with increasing indices; positive exponents, or nonzero ones if `signed`."""
    result: list[tuple[int, int]] = []
    for pair in pairs:
        if type(pair) not in (list, tuple) or len(pair) != 2:
            raise Invalid(f"{where}: powers are pairs [index, exponent]")
        k = natural(pair[0], below, where)
        if type(pair[1]) is not int or not (1 <= (abs(pair[1]) if signed else pair[1]) <= MAX_EXPONENT):
            raise Invalid(f"{where}: {str(pair[1])[:40]} is not an exponent")
        if result and result[-1][0] >= k:
            raise Invalid(f"{where}: the indices do not increase")
        result.append((k, pair[1]))
    return tuple(result)


class Field:
    """Values over a table of factors, modulo relations that can be added."""

    def __init__(self, variables: int, factors: list[Poly]) -> None:
        self.variables = variables
        self.ring = Ring(variables)
        self.factors = factors
        self.relations: list[Relation] = []

    def read(self, value: Any, where: str) -> Value:
        """A VALUE of docs/certificates.md. Raises Invalid."""
        result: Value = {}
        for group in typed(value, list, where):
            below, above = several(group, 2, f"{where}, [[[factor, exponent], ..], POLY]")
            key = read_powers(typed(below, list, where), len(self.factors), where)
            numerator = read_poly(above, self.variables, where)
            if key in result or not numerator:
                raise Invalid(f"{where}: a group is zero or occurs twice")
            result[key] = numerator
        return result

    def constant(self, value: Number) -> Value:
        return {(): {0: value}} if value else {}

    def generator(self, k: int) -> Value:
        return {(): {monomial([(k, 1)]): 1}}

    def add(self, a: Value, b: Value) -> Value:
        result = dict(a)
        for key, p in b.items():
            result[key] = self.ring.add(result[key], p) if key in result else p
        return {key: p for key, p in result.items() if p}

    def neg(self, a: Value) -> Value:
        return {key: self.ring.scale(p, -1) for key, p in a.items()}

    def sub(self, a: Value, b: Value) -> Value:
        return self.add(a, self.neg(b))

    def mul(self, a: Value, b: Value) -> Value:
        result: Value = {}
        for k, p in a.items():
            for l, q in b.items():  # noqa: E741
                product = self._cancelled(_times(k, l), self.ring.mul(p, q))
                result = self.add(result, product)
        return result

    def power(self, a: Value, n: int) -> Value:
        """a to the power n >= 0."""
        result = self.constant(1)
        for _ in range(n):
            result = self.mul(result, a)
        return result

    def _cancelled(self, key: Key, p: Poly) -> Value:
        """p over a key, with each factor divided out as often as it goes."""
        left = []
        for factor, exponent in key:
            while exponent:
                divided = self.ring.quotient(p, self.factors[factor])
                if divided is None:
                    left.append((factor, exponent))
                    break
                p, exponent = divided, exponent - 1  # noqa: PLW2901
        return {tuple(left): p} if p else {}

    def rational(self, a: Value) -> Fraction | None:
        """The number that a value is as written, without use of the relations; None if it is not one."""
        if not a:
            return Fraction(0)
        return Fraction(a[()][0]) if a.keys() == {()} and a[()].keys() == {0} else None

    def denominator(self, key: Key) -> Poly:
        """The product of the factors of a key."""
        result: Poly = {0: 1}
        for factor, exponent in key:
            result = self.ring.mul(result, self.ring.power(self.factors[factor], exponent))
        return result

    def fraction(self, a: Value) -> tuple[Poly, Key]:
        """The numerator, not reduced, over the least common denominator."""
        exponents: dict[int, int] = {}
        for key in a:
            for factor, exponent in key:
                exponents[factor] = max(exponent, exponents.get(factor, 0))
        numerator: Poly = {}
        for key, p in a.items():
            have = dict(key)
            missing = ((f, e - have.get(f, 0)) for f, e in exponents.items())
            by = self.denominator(tuple((f, e) for f, e in missing if e))
            numerator = self.ring.add(numerator, self.ring.mul(p, by))
        return numerator, tuple(sorted(exponents.items()))

    def normal(self, p: Poly) -> Poly:
        return self.ring.normal(p, self.relations)

    def is_zero(self, a: Value) -> bool:
        """Is the value shown to be zero? First the parts that share no factor each alone, then all."""
        if all(not self.normal(self.fraction(part)[0]) for part in _parts(a)):
            return True
        return not self.normal(self.fraction(a)[0])


def _times(k: Key, l: Key) -> Key:  # noqa: E741
    if not k or not l:
        return k or l
    exponents = dict(k)
    for factor, exponent in l:
        exponents[factor] = exponents.get(factor, 0) + exponent
    return tuple(sorted(exponents.items()))


def _parts(a: Value) -> list[Value]:
    parts: list[tuple[set[int], Value]] = []
    for key, p in a.items():
        factors, joined = {factor for factor, _ in key}, {key: p}
        apart = []
        for other, value in parts:
            if factors & other:
                factors, joined = factors | other, joined | value
            else:
                apart.append((other, value))
        parts = [*apart, (factors, joined)]
    return [value for _, value in parts]
