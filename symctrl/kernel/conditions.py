"""Known signs, and the conditions that a proof needs beyond what is given.

Soundness-critical. Last reviewed 2026-11-24.

Relies on: the sign of a sum of terms whose signs are known; the principal minors of a positive definite
matrix are positive, those of a positive semidefinite one are not negative (Horn and Johnson, Matrix
Analysis, 7.1; for a matrix that is not symmetric: Johnson, Positive definite matrices, 1970); what the
definition of a generator says of polynomials beside it (`beside`); the sign of a factor by that of the whole,
where the other factor is not zero and of known sign. What is not
known so becomes a condition of the statement: nothing is ever assumed silently.

A sign set is the set of the signs -1, 0, 1 that a number may have.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations
from math import comb, gcd, lcm

from symctrl.kernel import beside
from symctrl.kernel.certificate import Invalid
from symctrl.kernel.field import Field, Value
from symctrl.kernel.generators import Generator, Printer
from symctrl.kernel.polynomial import Number, Poly, monomial, powers, tidy, variables
from symctrl.kernel.values import Condition

SignSet = frozenset[int]
ANY: SignSet = frozenset((-1, 0, 1))
SIGNS: dict[str, SignSet] = {
    "zero": frozenset((0,)),
    "nonzero": frozenset((-1, 1)),
    "positive": frozenset((1,)),
    "nonnegative": frozenset((0, 1)),
}
NEGATIVE: SignSet = frozenset((-1,))
MAX_MINOR = 4  # rows
MAX_MINORS = 1000  # of one size
MAX_ASKED = 4
MAX_CONJUGATE = 12  # terms of a polynomial that is multiplied by its conjugate
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
        self._asked: list[frozenset[int]] = []  # the monomials of what is being asked for, one for another

    def learn(self, kind: str, value: Value) -> None:
        """An assumption: the value has this kind of sign. Raises Invalid where that is never so."""
        self._learn(self.carrier(value), SIGNS[kind])
        if kind == "nonzero":
            self._learn(self.field.fraction(value)[0], SIGNS[kind])

    def learn_matrix(self, matrix: list[list[Value]], strict: bool) -> None:
        """An assumption: the matrix (rows of values) is positive definite, or semidefinite."""
        self._matrices.append((matrix, SIGNS["positive" if strict else "nonnegative"]))

    def suppose(self, kind: str, p: Poly) -> bool:
        """Suppose a polynomial to have a sign, under relations that are new; False where it never has.

        What was known is read again under the relations.
        """
        before = self.known
        self._cache.clear()
        try:
            if not self.of(p) & SIGNS[kind]:
                return False
            self._learn(p, SIGNS[kind])
            for unit, signs in before.values():
                self._learn(unit, signs)
        except Invalid:  # it contradicts what is known
            return False
        return True

    @property
    def known(self) -> dict[frozenset[tuple[int, Number]], tuple[Poly, SignSet]]:
        """A copy of what is known of polynomials."""
        return dict(self._known)

    @known.setter
    def known(self, value: dict[frozenset[tuple[int, Number]], tuple[Poly, SignSet]]) -> None:
        self._known = dict(value)
        self._cache.clear()

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
            found &= self._beside_known(form)
            if len(found) > 1:
                found &= self._beside_definitions(form)
        return found

    def _beside_definitions(self, p: Poly) -> SignSet:
        """By what the definitions of the generators in p say of polynomials beside them (`beside`)."""
        found = ANY
        asked = frozenset(p)
        if asked in self._asked or len(self._asked) >= MAX_ASKED:
            return ANY
        self._asked.append(asked)
        for k in sorted(variables(p)):
            g = self.table[k]
            for q, strict in beside.not_negative(self.field, k, g):
                found &= self._as_multiple(p, q, SIGNS["positive" if strict else "nonnegative"])
            pairs = beside.pairs_of_one_sign(self.field, k, g)
            for u, v in (*pairs, *beside.differences(self.field, p, self.table, k)):
                found &= self._by_other(p, u, v)
                product_ = self.field.ring.mul(u, v)
                if product_ and self._divide(p, product_) is not None:
                    never = 0 not in self.of(u) or 0 not in self.of(v)
                    found &= self._as_multiple(p, product_, SIGNS["positive" if never else "nonnegative"])
            found &= self._by_conjugate(p, k)
        self._asked.pop()
        return found

    def _by_other(self, p: Poly, u: Poly, v: Poly) -> SignSet:
        """The sign of p where it is a multiple of one of two polynomials of one sign, by the other."""
        found, (key, flip, _) = ANY, _unit(p)
        for w, other in ((u, v), (v, u)):
            if w and other and _unit(w)[0] == key:
                found &= product(product(flip, _unit(w)[1]), self.of(other))
        return found

    def _divide(self, p: Poly, q: Poly) -> tuple[Poly, bool] | None:
        """(r, True) where p = q r, (r, False) where q = p r; None where neither divides."""
        if not q or not p:
            return None
        r = self.field.ring.quotient(p, q)
        if r is not None:
            return r, True
        r = self.field.ring.quotient(q, p)
        return None if r is None else (r, False)

    def _as_multiple(self, p: Poly, q: Poly, signs: SignSet) -> SignSet:
        """The signs of p by those of q, where one is a multiple of the other."""
        found = self._divide(p, q)
        if found is None:
            return ANY
        r, multiple = found
        of = self.of(r)
        return product(signs, of) if multiple or 0 not in of else ANY

    def _by_conjugate(self, p: Poly, k: int) -> SignSet:
        """The sign of c n + r by that of its product with c n - r, for n = |b| or a square root."""
        if len(p) > MAX_CONJUGATE:
            return ANY
        made = beside.conjugate(self.field, p, k, self.table[k])
        if made is None:
            return ANY
        c, r, other, D = made
        of = self.of(D)
        least = SIGNS["nonnegative" if 0 in of else "positive"]
        for side, large in ((of, c), (product(of, NEGATIVE), r)):
            if side <= SIGNS["nonnegative"] and self._terms(large) <= SIGNS["nonnegative"]:
                return least
        return of if self._terms(other) == SIGNS["positive"] else ANY

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
            if len(unit) > 1 and unit.keys() != p.keys():
                found &= self._as_divisor(p, unit, signs)
            if len(unit) > 1 and ratio:
                rest = self.field.ring.add(p, self.field.ring.scale(unit, -ratio))
                part = product(signs, frozenset((1 if ratio > 0 else -1,)))
                found &= total(part, self._terms(rest))
        return found

    def _as_divisor(self, p: Poly, known: Poly, signs: SignSet) -> SignSet:
        """By a known multiple p r, where r is not zero."""
        r = self.field.ring.quotient(known, p) if len(p) > 1 else None
        of = ANY if r is None else self._terms(r)
        return product(signs, of) if 0 not in of else ANY

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
        self.learn_minors()
        return self.of(p)

    def learn_minors(self) -> None:
        """Take the signs of the principal minors of the assumed matrices."""
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
