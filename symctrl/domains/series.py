"""Truncated power series over any other domain, grown one coefficient at a time.

A walk in this domain builds a programme: every value remembers its coefficients so far and the rule for its
next one. `expand` finds one coefficient after another of all values, in the order in which they were made, so
that each rule finds those of its arguments; the same programme serves every expansion. Equal operations are
made once.
A quotient and a function are found from an equation that their series satisfy: b q = a, and v' = g(a) a'
where the slope g(a) is itself a series (Moore, Interval Analysis, 1966; Griewank and Walther, Evaluating
Derivatives, 2008, chapter 13). A kink is passed over only where the constant coefficient decides its side.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, wraps
from typing import Any, Generic, TypeVar, cast

from symctrl.domains.domain import Domain, Unsupported
from symctrl.domains.fraction import FractionDomain

Value = TypeVar("Value")
Rule = Callable[[int], Value]
Method = TypeVar("Method", bound=Callable[..., Any])


class Undecided(Unsupported):
    """The constant coefficient does not decide on which side of a switch the series is."""


@dataclass(eq=False, slots=True)
class Series(Generic[Value]):
    """Coefficients 0, 1, .. as far as they are known. Without a rule it is a constant: the others are zero.

    literal: of a constant, the rational number that it is exactly; an exponent is looked at.
    """

    terms: list[Value]
    rule: Rule[Value] | None = None
    literal: Fraction | None = None

    def at(self, k: int) -> Value | None:
        """Coefficient k; None is the zero of a constant's higher ones."""
        return self.terms[k] if self.rule is not None or k == 0 else None


def _once(method: Method) -> Method:
    """The operation, made once for equal arguments, and folded where all of them are constants."""
    op = method.__name__.rstrip("_").upper()

    @wraps(method)
    def evaluate(self: SeriesDomain[Any], *args: Series[Any]) -> Series[Any]:
        key = (op, *args)
        if key not in self.known:
            self.known[key] = method(self, *args) if any(a.rule for a in args) else self.folded(op, args)
        return self.known[key]

    return cast(Method, evaluate)


class SeriesDomain(Domain[Series[Value]]):
    """Series over the domain `base`, which meets inverses and functions of the constant coefficients only."""

    def __init__(self, base: Domain[Value]) -> None:
        self.base = base
        self.name = f"series over the {base.name}"
        self.moving: list[Series[Value]] = []
        self.known: dict[Any, Series[Value]] = {}
        self._number = cache(base.constant)
        self._zero = base.constant(Fraction(0))

    def constant(self, value: Fraction) -> Series[Value]:
        return self.known.setdefault(value, Series([self._number(value)], None, value))

    def made(self, rule: Rule[Value]) -> Series[Value]:
        """A new series whose coefficient k is rule(k): it may use coefficients below k of any series, and
        coefficient k of earlier ones.
        """
        series = Series([], rule)
        self.moving.append(series)
        return series

    def expand(self, count: int, order: int) -> None:
        """Coefficients 0 .. order of the first `count` series. Raises Undecided at a switch."""
        programme = [(series.terms, series.rule) for series in self.moving[:count] if series.rule]
        for terms, _ in programme:
            terms.clear()
        for k in range(order + 1):
            for terms, rule in programme:
                terms.append(rule(k))

    def folded(self, op: str, args: Sequence[Series[Value]]) -> Series[Value]:
        """An operation on constants: one on the base, and on the rational numbers where they are known."""
        known = [a.literal for a in args if a.literal is not None]
        if len(known) == len(args):
            with suppress(ValueError):  # an irrational value, or none: the base says which
                return self.constant(FractionDomain().operation(op)(*known))
        return Series([self.base.operation(op)(*(a.terms[0] for a in args))])

    def _term(self, a: Series[Value], k: int) -> Value:
        known = a.at(k)
        return self._zero if known is None else known

    def _sum(self, terms: Sequence[Value]) -> Value:
        total = terms[0] if terms else self._zero
        for term in terms[1:]:
            total = self.base.add_(total, term)
        return total

    def _scaled(self, factor: Fraction, a: Value) -> Value:
        return self.base.mul_(self._number(factor), a)

    def _products(self, a: Series[Value], b: Series[Value], k: int, first: int, end: int) -> list[Value]:
        """a_i b_(k-i) for first <= i < end, those with a factor zero left out."""
        pairs = [(a.at(i), b.at(k - i)) for i in range(first, end)]
        return [self.base.mul_(x, y) for x, y in pairs if x is not None and y is not None]

    # Arithmetic.

    @_once
    def add_(self, a: Series[Value], b: Series[Value]) -> Series[Value]:
        return self.made(lambda k: self._sum([x for x in (a.at(k), b.at(k)) if x is not None]))

    @_once
    def sub_(self, a: Series[Value], b: Series[Value]) -> Series[Value]:
        def rule(k: int) -> Value:
            y = b.at(k)
            return self._term(a, k) if y is None else self.base.sub_(self._term(a, k), y)

        return self.made(rule)

    @_once
    def neg_(self, a: Series[Value]) -> Series[Value]:
        return self.made(lambda k: self.base.neg_(self._term(a, k)))

    @_once
    def mul_(self, a: Series[Value], b: Series[Value]) -> Series[Value]:
        return self.made(lambda k: self._sum(self._products(a, b, k, 0, k + 1)))

    @_once
    def sq_(self, a: Series[Value]) -> Series[Value]:
        """Each product of two different coefficients once, and the square of the middle one."""

        def rule(k: int) -> Value:
            pairs = self._products(a, a, k, 0, (k + 1) // 2)
            middle = [] if k % 2 else [self.base.sq_(self._term(a, k // 2))]
            return self._sum([*map(self.base.twice_, pairs), *middle])

        return self.made(rule)

    @_once
    def inv_(self, a: Series[Value]) -> Series[Value]:
        """r_k = -(a_1 r_(k-1) + .. + a_k r_0)/a_0."""

        def rule(k: int) -> Value:
            if k == 0:
                return self.base.inv_(a.terms[0])
            rest = self._sum(self._products(a, result, k, 1, k + 1))
            return self.base.neg_(self.base.mul_(result.terms[0], rest))

        result = self.made(rule)
        return result

    @_once
    def pow_(self, a: Series[Value], b: Series[Value]) -> Series[Value]:
        """By squaring for an integer constant; with the slope b a^b/a for another; else exp(b log a)."""
        n = b.literal
        if b.rule is not None:
            return self.exp_(self.mul_(b, self.log_(a)))
        if n is not None and n.denominator == 1:
            return self._integer_power(a, int(n))
        return self._of("POW", a, lambda v: self.mul_(self.mul_(b, v), self.inv_(a)), b)

    def _integer_power(self, a: Series[Value], n: int) -> Series[Value]:
        if n == 0:
            return self._one()
        if n < 0:
            return self._integer_power(self.inv_(a), -n)
        half = self.sq_(self._integer_power(a, n // 2)) if n > 1 else a
        return self.mul_(half, a) if n > 1 and n % 2 else half

    # Functions: the value at the constant coefficient, then k v_k = 1 a_1 g_(k-1) + .. + k a_k g_0.

    def _of(
        self,
        op: str,
        a: Series[Value],
        slope: Callable[[Series[Value]], Series[Value]],
        *constants: Series[Value],
    ) -> Series[Value]:
        """The function with opcode `op`, of a and constants; slope: from the function's own series."""
        value = self.base.operation(op)
        later: list[Series[Value]] = []

        def rule(k: int) -> Value:
            if k == 0:
                return value(*(x.terms[0] for x in (a, *constants)))
            weighted = [self._scaled(Fraction(i), a.terms[i]) for i in range(1, k + 1)]
            terms = [(x, later[0].at(k - i)) for i, x in enumerate(weighted, 1)]
            total = self._sum([self.base.mul_(x, y) for x, y in terms if y is not None])
            return self._scaled(Fraction(1, k), total)

        result = self.known[(op, a, *constants)] = self.made(rule)
        later.append(slope(result))  # which may ask for the function itself again, as cosine does for sine
        return result

    def _one(self) -> Series[Value]:
        return self.constant(Fraction(1))

    @_once
    def sqrt_(self, a: Series[Value]) -> Series[Value]:
        return self._of("SQRT", a, lambda v: self.inv_(self.twice_(v)))

    @_once
    def exp_(self, a: Series[Value]) -> Series[Value]:
        return self._of("EXP", a, lambda v: v)

    @_once
    def log_(self, a: Series[Value]) -> Series[Value]:
        return self._of("LOG", a, lambda _: self.inv_(a))

    @_once
    def sin_(self, a: Series[Value]) -> Series[Value]:
        return self._of("SIN", a, lambda _: self.cos_(a))

    @_once
    def cos_(self, a: Series[Value]) -> Series[Value]:
        return self._of("COS", a, lambda _: self.neg_(self.sin_(a)))

    def sinh_(self, a: Series[Value]) -> Series[Value]:
        grown = self.exp_(a)
        return self.mul_(self.constant(Fraction(1, 2)), self.sub_(grown, self.inv_(grown)))

    def cosh_(self, a: Series[Value]) -> Series[Value]:
        grown = self.exp_(a)
        return self.mul_(self.constant(Fraction(1, 2)), self.add_(grown, self.inv_(grown)))

    def asinh_(self, a: Series[Value]) -> Series[Value]:
        return self.log_(self.add_(a, self.sqrt_(self.add_(self.sq_(a), self._one()))))

    def acosh_(self, a: Series[Value]) -> Series[Value]:
        return self.log_(self.add_(a, self.sqrt_(self.sub_(self.sq_(a), self._one()))))

    def atanh_(self, a: Series[Value]) -> Series[Value]:
        ratio = self.div_(self.add_(self._one(), a), self.sub_(self._one(), a))
        return self.mul_(self.constant(Fraction(1, 2)), self.log_(ratio))

    @_once
    def tanh_(self, a: Series[Value]) -> Series[Value]:
        return self._of("TANH", a, lambda v: self.sub_(self._one(), self.sq_(v)))

    def _inverse_cosine(self, a: Series[Value]) -> Series[Value]:
        return self.inv_(self.sqrt_(self.sub_(self._one(), self.sq_(a))))

    @_once
    def asin_(self, a: Series[Value]) -> Series[Value]:
        return self._of("ASIN", a, lambda _: self._inverse_cosine(a))

    @_once
    def acos_(self, a: Series[Value]) -> Series[Value]:
        return self._of("ACOS", a, lambda _: self.neg_(self._inverse_cosine(a)))

    @_once
    def atan_(self, a: Series[Value]) -> Series[Value]:
        return self._of("ATAN", a, lambda _: self.inv_(self.add_(self._one(), self.sq_(a))))

    # Operations with a kink, away from it.

    def _side(self, a: Series[Value], what: str) -> int:
        """The sign that the constant coefficient has. Raises Undecided where it may be zero."""
        sign = self.base.operation("SIGN")(a.terms[0])
        for side in (1, -1):
            if sign == self._number(Fraction(side)):
                return side
        raise Undecided(f"{what} has a kink where its argument is zero, and here it may be zero")

    @_once
    def fabs_(self, a: Series[Value]) -> Series[Value]:
        return self.made(lambda k: self._scaled(Fraction(self._side(a, "fabs")), self._term(a, k)))

    @_once
    def sign_(self, a: Series[Value]) -> Series[Value]:
        return self.made(lambda k: self._number(Fraction(0 if k else self._side(a, "sign"))))

    def _chosen(self, a: Series[Value], b: Series[Value], sign: int, what: str) -> Series[Value]:
        """The smaller of the two for sign 1, the larger for -1."""
        gap = self.sub_(a, b)
        return self.made(lambda k: self._term(a if self._side(gap, what) * sign < 0 else b, k))

    @_once
    def fmin_(self, a: Series[Value], b: Series[Value]) -> Series[Value]:
        return self._chosen(a, b, 1, "fmin")

    @_once
    def fmax_(self, a: Series[Value], b: Series[Value]) -> Series[Value]:
        return self._chosen(a, b, -1, "fmax")
