"""Known signs, and the conditions that a proof needs beyond what is given.

Soundness-critical. Last reviewed 2026-11-24.

Relies on: the sign of a sum of terms whose signs are known; the principal minors of a positive definite
matrix are positive, those of a positive semidefinite one are not negative (Horn and Johnson, Matrix
Analysis, 7.1; for a matrix that is not symmetric: Johnson, Positive definite matrices, 1970). What is not
known so becomes a condition of the statement: nothing is ever assumed silently.

A sign set is the set of the signs -1, 0, 1 that a number may have.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from math import comb, gcd, lcm

from symctrl.kernel.certificate import Invalid
from symctrl.kernel.field import Field, Value
from symctrl.kernel.generators import Generator, Printer
from symctrl.kernel.polynomial import Number, Poly, monomial, powers, tidy
from symctrl.kernel.values import Condition

SignSet = frozenset[int]
ANY: SignSet = frozenset((-1, 0, 1))
SIGNS: dict[str, SignSet] = {
    "zero": frozenset((0,)),
    "nonzero": frozenset((-1, 1)),
    "positive": frozenset((1,)),
    "nonnegative": frozenset((0, 1)),
}
MAX_MINOR = 4  # rows
MAX_MINORS = 1000  # of one size
ODD = ("tanh", "atan", "asin", "erf")


def product(a: SignSet, b: SignSet) -> SignSet:
    return frozenset(x * y for x in a for y in b)


def total(a: SignSet, b: SignSet) -> SignSet:
    found: set[int] = set()
    for x in a:
        for y in b:
            found |= {x, y} - {0} if x * y >= 0 and (x or y) else {-1, 0, 1} if x * y < 0 else {0}
    return frozenset(found)


class Signs:
    """What is known about the signs of polynomials, and what is needed and not known."""

    def __init__(self, field: Field, table: list[Generator], along: bool = False) -> None:
        """along: a switch has any value from -1 to 1 at its jump, as along a solution; else zero."""
        self.field = field
        self.along = along
        self.table = table
        self.printer = Printer(table, field)
        self.needed: dict[Condition, Poly] = {}
        self._known: dict[frozenset[tuple[int, Number]], tuple[Poly, SignSet]] = {}
        self._matrices: list[tuple[list[list[Value]], SignSet]] = []
        self._cache: dict[int, SignSet] = {}

    def learn(self, kind: str, value: Value) -> None:
        """An assumption: the value has this kind of sign. Raises Invalid where that is never so."""
        self._learn(self.carrier(value), SIGNS[kind])
        if kind == "nonzero":
            self._learn(self.field.fraction(value)[0], SIGNS[kind])

    def learn_matrix(self, matrix: list[list[Value]], strict: bool) -> None:
        """An assumption: the matrix (rows of values) is positive definite, or semidefinite."""
        self._matrices.append((matrix, SIGNS["positive" if strict else "nonnegative"]))

    def carrier(self, value: Value) -> Poly:
        """A polynomial with the sign of the value: numerator times the factors of odd exponent below it."""
        numerator, key = self.field.fraction(value)
        return self.field.ring.mul(numerator, self.field.denominator(tuple((f, 1) for f, e in key if e % 2)))

    def _learn(self, p: Poly, signs: SignSet) -> None:
        for form in (p, self.field.normal(p)):
            if form.keys() <= {0}:
                if not signs & self._constant(form):
                    raise Invalid("an assumption can never be met")
                continue
            key, flip, unit = _unit(form)
            before = self._known.get(key, (unit, ANY))[1]
            self._known[key] = unit, before & product(signs, flip)
            if not self._known[key][1]:
                raise Invalid("two assumptions contradict each other")
        self._cache.clear()

    def _constant(self, p: Poly) -> SignSet:
        c = p.get(0, 0)
        return frozenset(((c > 0) - (c < 0),))

    def of(self, p: Poly) -> SignSet:
        """The signs that a polynomial may have, as far as is known."""
        found = self._terms(p)
        for form in (p, self.field.normal(p)):
            if form.keys() <= {0}:
                return self._constant(form)
            key, flip, _ = _unit(form)
            if key in self._known:
                found &= product(self._known[key][1], flip)
            found &= self._terms(form)
            found &= self._beside_known(form) & self._beside_size(form)
        return found

    def _beside_size(self, p: Poly) -> SignSet:
        """|p| - p, |p| + p, 1 - s and 1 + s for a sign s are not negative."""
        key, flip, _ = _unit(p)
        for k in {k for m in p for k, _ in powers(m)}:
            g = self.table[k]
            own: Poly = {monomial([(k, 1)]): 1}
            if g.kind not in ("abs", "sign") or g.base is None:
                continue
            one: Poly = {0: 1}
            size, inner = (own, g.base) if g.kind == "abs" else (one, own)
            for sign in (1, -1):
                beside = self.field.ring.add(size, self.field.ring.scale(inner, sign))
                if beside and _unit(beside)[0] == key:
                    return product(SIGNS["nonnegative"], product(flip, _unit(beside)[1]))
        return ANY

    def _terms(self, p: Poly) -> SignSet:
        found: SignSet = frozenset((0,))
        for m, c in p.items():
            sign: SignSet = frozenset((1 if c > 0 else -1,))
            for k, exponent in powers(m):
                of = self.of_generator(k)
                sign = product(sign, of if exponent % 2 else product(of, of) - (frozenset((-1,))))
            found = total(found, sign)
            if found == ANY:
                break
        return found

    def _beside_known(self, p: Poly) -> SignSet:
        """Is p a positive multiple of a polynomial of known sign, plus terms of known sign?"""
        found = ANY
        for unit, signs in self._known.values():
            ratio = p.get(max(unit), 0)
            if len(unit) > 1 and ratio:
                rest = self.field.ring.add(p, self.field.ring.scale(unit, -ratio))
                part = product(signs, frozenset((1 if ratio > 0 else -1,)))
                found &= total(part, self._terms(rest))
        return found

    def of_generator(self, k: int) -> SignSet:
        """The signs that a generator may have."""
        if k not in self._cache:
            known = self._known.get(frozenset(((monomial([(k, 1)]), 1),)), ({}, ANY))[1]
            self._cache[k] = known & self._by_definition(self.table[k])
        return self._cache[k]

    def _by_definition(self, g: Generator) -> SignSet:
        positive, nonnegative = SIGNS["positive"], SIGNS["nonnegative"]
        function = g.name if g.kind == "function" else ""
        if g.kind == "exp":
            return positive
        if function == "acos":
            return nonnegative
        if function == "log":  # log a has the sign of a - 1
            return self.of_value(self.field.add(g.args[0], self.field.constant(-1)))
        if function in ODD:
            return self.of_value(g.args[0])
        if g.base is None:
            return ANY
        of = self.of(g.base)
        if g.kind == "sign":
            return ANY if self.along and 0 in of else of
        return positive if (0 not in of if g.kind == "abs" else of == positive) else nonnegative

    def of_value(self, value: Value) -> SignSet:
        """The signs that a value may have; every factor counts as nonzero."""
        found: SignSet = frozenset((0,))
        for key, p in value.items():
            sign = self.of(p)
            for factor, exponent in key:
                if exponent % 2:
                    sign = product(sign, self.of(self.field.factors[factor]) - {0})
            found = total(found, sign)
        return found if len(found) == 1 else found & self.of(self.carrier(value))

    def require(self, kind: str, p: Poly, what: str) -> None:
        """The polynomial must have this kind of sign: known, or a condition. Raises Invalid if never."""
        if self.of(p) <= SIGNS[kind] or self.of_learned(p) <= SIGNS[kind]:
            return
        if not self.of(p) & SIGNS[kind]:
            raise Invalid(f"{what} must be {kind}, and it never is: {self.printer.poly(p)[:200]}")
        _, flip, unit = _unit(p)
        shown = unit if kind == "nonzero" or 1 in flip else self.field.ring.scale(unit, -1)
        self.needed[Condition(kind, self.printer.poly(_primitive(shown)))] = p

    def require_value(self, kind: str, value: Value, what: str) -> None:
        """The same of a value."""
        if not self.of_value(value) <= SIGNS[kind]:
            self.require(kind, self.carrier(value), what)

    def of_learned(self, p: Poly) -> SignSet:
        """The signs that p may have, also by the principal minors of the assumed matrices."""
        self._learn_minors()
        return self.of(p)

    def _learn_minors(self) -> None:
        matrices, self._matrices = self._matrices, []
        for matrix, signs in matrices:
            n = len(matrix)
            for size in (size for size in range(1, min(MAX_MINOR, n) + 1) if comb(n, size) <= MAX_MINORS):
                for rows in combinations(range(len(matrix)), size):
                    minor = determinant(self.field, [[matrix[r][c] for c in rows] for r in rows])
                    self._learn(self.carrier(minor), signs)


def determinant(field: Field, matrix: list[list[Value]]) -> Value:
    """By expansion along the first row; the matrix is small."""
    if not matrix:
        return field.constant(1)
    result: Value = {}
    for k, entry in enumerate(matrix[0]):
        minor = determinant(field, [[*row[:k], *row[k + 1 :]] for row in matrix[1:]])
        term = field.mul(entry, minor)
        result = field.add(result, field.neg(term) if k % 2 else term)
    return result


def _unit(p: Poly) -> tuple[frozenset[tuple[int, Number]], SignSet, Poly]:
    """The multiple with leading coefficient 1, as a key; the sign of that coefficient; the multiple."""
    lead = p[max(p)]
    unit = {m: tidy(Fraction(c) / lead) for m, c in p.items()}
    return frozenset(unit.items()), frozenset((1 if lead > 0 else -1,)), unit


def _primitive(p: Poly) -> Poly:
    """The positive multiple with integer coefficients that have no common divisor."""
    bottom = lcm(*(c.denominator for c in p.values()))
    top = gcd(*(int(c * bottom) for c in p.values()))
    return {m: int(c * bottom) // top for m, c in p.items()}
