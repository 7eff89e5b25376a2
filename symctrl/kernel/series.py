"""Power series with enclosed coefficients, grown one coefficient at a time.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: the coefficients of a sum add, those of a product are the convolution, r = 1/a has a r = 1, and a
function v of a with the slope g, v' = g a', has k v_k = 1 a_1 g_(k-1) + .. + k a_k g_0 (Moore, Interval
Analysis, 1966). With intervals for coefficients each rule gives an interval that holds the coefficient.
Every operation is analytic where its constant coefficient is enclosed: roots, logarithms and powers need a
positive one because their slopes divide by it, and a kink is passed only where the sign is known.

A walk in this domain makes a programme: a series is a rule for its next coefficient, which finds lower ones
of any series and the same one of those made before it. A coefficient is a pair of integers, the ends in units
of 2^-bits, rounded outward. A series without a rule is a constant. Equal operations are made once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import ceil, floor
from typing import Any

from symctrl.kernel.chain import Chain, Domain
from symctrl.kernel.enclosure import Enclosure
from symctrl.kernel.interval import Interval, Undecided, point

Pair = tuple[int, int]
Rule = Callable[[int], Pair]
Level = Any  # of the chain rule: a series and its derivative, or None
ZERO: Pair = (0, 0)


class Series:
    """Coefficients as far as they are known. Without a rule: the constant `exact`, higher ones being zero."""

    __slots__ = ("exact", "rule", "terms")

    def __init__(self, terms: list[Pair], exact: Interval, rule: Rule | None = None) -> None:
        self.terms, self.exact, self.rule = terms, exact, rule

    def at(self, k: int) -> Pair:
        return ZERO if self.rule is None and k > 0 else self.terms[k]


class SeriesDomain(Domain[Series]):
    """An operation on constants is that of intervals; one on what moves makes a series."""

    def __init__(self, bits: int) -> None:
        self.bits, self.one = bits, 1 << bits
        self.real = Enclosure(bits)
        self.moving: list[Series] = []
        self._made: dict[tuple[Any, ...], Series] = {}

    # Coefficients.

    def pair(self, a: Interval) -> Pair:
        return floor(a.lo * self.one), ceil(a.hi * self.one)

    def number(self, x: Fraction | int) -> Pair:
        return self.pair(point(x))

    def interval(self, a: Pair) -> Interval:
        return Interval(Fraction(a[0], self.one), Fraction(a[1], self.one))

    def dot(self, factors: Sequence[tuple[Pair, Pair]]) -> Pair:
        """The sum of the products, rounded outward once."""
        low = high = 0
        for (a, b), (c, d) in factors:
            ends = (a * c, a * d, b * c, b * d)
            low, high = low + min(ends), high + max(ends)
        return low >> self.bits, -(-high >> self.bits)

    def grow(self, count: int, order: int) -> None:
        """Coefficients 0 .. order of the first `count` series. Raises what a rule raises."""
        programme = [(s.terms, s.rule) for s in self.moving[:count] if s.rule is not None]
        for terms, _ in programme:
            terms.clear()
        for k in range(order + 1):
            for terms, rule in programme:
                terms.append(rule(k))

    # Series.

    def made(self, op: str, args: Sequence[Series], rule: Rule) -> Series:
        """The series of the rule, or the one that an equal operation has made."""
        key = (op, *args)
        if key not in self._made:
            self._made[key] = Series([], point(0), rule)
            self.moving.append(self._made[key])
        return self._made[key]

    def _constant(self, value: Interval) -> Series:
        key = ("CONST", value.lo, value.hi)
        return self._made.setdefault(key, Series([self.pair(value)], value))

    def constant(self, value: Fraction) -> Series:
        return self._constant(point(value))

    def rational(self, a: Series) -> Fraction | None:
        return self.real.rational(a.exact) if a.rule is None else None

    def nonzero(self, a: Series) -> None:
        """Asked before SIGN, whose rule refuses what may be zero."""
        if a.rule is None:
            self.real.nonzero(a.exact)

    def add(self, a: Series, b: Series) -> Series:
        if a.rule is None and b.rule is None:
            return self._constant(self.real.add(a.exact, b.exact))
        return self.made("ADD", (a, b), lambda k: (a.at(k)[0] + b.at(k)[0], a.at(k)[1] + b.at(k)[1]))

    def neg(self, a: Series) -> Series:
        if a.rule is None:
            return self._constant(self.real.neg(a.exact))
        return self.made("NEG", (a,), lambda k: (-a.terms[k][1], -a.terms[k][0]))

    def mul(self, a: Series, b: Series) -> Series:
        if a.rule is None and b.rule is None:
            return self._constant(self.real.mul(a.exact, b.exact))
        if b.rule is None:
            a, b = b, a
        if a.rule is None:
            return self.made("MUL", (a, b), lambda k: self.dot([(a.terms[0], b.terms[k])]))
        return self.made(
            "MUL", (a, b), lambda k: self.dot([(a.terms[i], b.terms[k - i]) for i in range(k + 1)])
        )

    def square(self, a: Series) -> Series:
        """Products of two different coefficients count twice; the square of one is not negative."""
        if a.rule is None:
            return self._constant(self.real.square(a.exact))

        def rule(k: int) -> Pair:
            low, high = self.dot([(a.terms[i], a.terms[k - i]) for i in range((k + 1) // 2)])
            lo, hi = self.dot([] if k % 2 else [(a.terms[k // 2], a.terms[k // 2])])
            across = k % 2 == 0 and a.terms[k // 2][0] < 0 < a.terms[k // 2][1]
            return 2 * low + (0 if across else lo), 2 * high + hi

        return self.made("SQ", (a,), rule)

    def inv(self, a: Series) -> Series:
        """r_k = -r_0 (a_1 r_(k-1) + .. + a_k r_0)."""
        if a.rule is None:
            return self._constant(self.real.inv(a.exact))

        def rule(k: int) -> Pair:
            if k == 0:
                return self.pair(self.real.inv(self.interval(a.terms[0])))
            low, high = self.dot([(a.terms[i], r.terms[k - i]) for i in range(1, k + 1)])
            return self.dot([((-high, -low), r.terms[0])])

        r = self.made("INV", (a,), rule)
        return r

    def function(self, op: str, args: Sequence[Series]) -> Series:
        """Raises Declined for one without a rule."""
        a = args[0]
        if all(x.rule is None for x in args):
            return self._constant(self.real.function(op, [x.exact for x in args]))
        if op == "FABS":
            return self.choice(a, self.neg(a), a)
        if op == "SIGN":
            return self.made(op, args, lambda k: ZERO if k else (self.side(a) * self.one,) * 2)
        if op == "POW" and args[1].rule is not None:
            return self.function("EXP", [self.mul(args[1], self.function("LOG", [a]))])
        if op in _SLOPE:
            return self._integral(op, args)
        return super().function(op, args)

    def _integral(self, op: str, args: Sequence[Series]) -> Series:
        """A function v of a and the series of its slope, which may use v and so is made after it."""
        a = args[0]
        slope: list[Series] = []

        def rule(k: int) -> Pair:
            if k == 0:
                return self.pair(self.real.function(op, [self.interval(x.at(0)) for x in args]))
            weighted = [(i * low, i * high) for i, (low, high) in enumerate(a.terms[: k + 1])]
            low, high = self.dot([(weighted[i], slope[0].at(k - i)) for i in range(1, k + 1)])
            return low // k, -(-high // k)

        known = len(self._made)
        v = self.made(op, args, rule)
        if len(self._made) > known:
            slope.append(_SLOPE[op](self, args, v))
        return v

    def side(self, a: Series) -> int:
        """The sign of a constant coefficient that is not zero. Raises Undecided."""
        low, high = a.at(0)
        if low <= 0 <= high:
            raise Undecided("a kink where its argument may be zero")
        return 1 if low > 0 else -1

    def choice(self, gap: Series, less: Series, more: Series) -> Series:
        """`less` where gap < 0 and `more` where gap > 0, as long as it is one of the two."""
        if gap.rule is None:
            return less if self.real.sign_(gap.exact).lo < 0 else more

        def rule(k: int) -> Pair:
            return less.at(k) if self.side(gap) < 0 else more.at(k)

        return self.made("CHOICE", (gap, less, more), rule)


def _inverse_root(d: SeriesDomain, a: Series) -> Series:
    """1/root(1 - a^2)."""
    return d.inv(d.function("SQRT", [d.sub(d.constant(Fraction(1)), d.square(a))]))


_SLOPE: dict[str, Callable[[SeriesDomain, Sequence[Series], Series], Series]] = {
    "EXP": lambda d, args, v: v,
    "LOG": lambda d, args, v: d.inv(args[0]),
    "SQRT": lambda d, args, v: d.inv(d.add(v, v)),
    "POW": lambda d, args, v: d.mul(d.mul(args[1], v), d.inv(args[0])),
    "SIN": lambda d, args, v: d.function("COS", args),
    "COS": lambda d, args, v: d.neg(d.function("SIN", args)),
    "TANH": lambda d, args, v: d.sub(d.constant(Fraction(1)), d.square(v)),
    "ATAN": lambda d, args, v: d.inv(d.add(d.constant(Fraction(1)), d.square(args[0]))),
    "ASIN": lambda d, args, v: _inverse_root(d, args[0]),
    "ACOS": lambda d, args, v: d.neg(_inverse_root(d, args[0])),
}


class Choosing(Chain[Any]):
    """The chain rule, with the smaller and the larger of two series chosen rather than composed."""

    domain: SeriesDomain | Along

    def operation(self, op: str, n: int, args: Sequence[Any]) -> Any:
        if n > 0 or op not in ("FMIN", "FMAX"):
            return super().operation(op, n, args)
        gap = self.domain.sub(*args)
        return self.domain.choice(gap, *(args if op == "FMIN" else args[::-1]))


class Along(Domain[Level]):
    """Series with their derivative by one initial value: level values of the chain rule, as a domain."""

    def __init__(self, domain: SeriesDomain) -> None:
        self.domain = domain
        self.chain: Chain[Series] = Chain(domain)

    def constant(self, value: Fraction) -> Level:
        return self.chain.constant(1, value)

    def add(self, a: Level, b: Level) -> Level:
        return self.chain.add(1, a, b)

    def mul(self, a: Level, b: Level) -> Level:
        return self.chain.mul(1, a, b)

    def inv(self, a: Level) -> Level:
        return self.chain.inv(1, a)

    def square(self, a: Level) -> Level:
        return self.chain.square(1, a)

    def function(self, op: str, args: Sequence[Level]) -> Level:
        """A sign is locally constant where it has a value."""
        if op == "SIGN":
            return self.domain.function(op, [args[0][0]]), None
        return self.chain.operation(op, 1, args)

    def nonzero(self, a: Level) -> None:
        self.domain.nonzero(a[0])

    def rational(self, a: Level) -> Fraction | None:
        return self.domain.rational(a[0]) if a[1] is None else None

    def choice(self, gap: Level, less: Level, more: Level) -> Level:
        zero = self.domain.constant(Fraction(0))
        rates = [zero if x[1] is None else x[1] for x in (less, more)]
        value = self.domain.choice(gap[0], less[0], more[0])
        return value, self.domain.choice(gap[0], *rates)
