"""Rational intervals and their arithmetic, rounded outward so that numbers stay short.

Soundness-critical. Last reviewed 2026-11-24.

Theorem (inclusion): each operation returns an interval that contains the result for all arguments in the
given intervals. Sums, differences and products of intervals take their extremes at end points; rounding moves
the lower end down and the upper end up. An interval of one point stays exact while its number has at most
EXACT_BITS bits.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import isqrt

from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.chain import Domain

EXACT_BITS = 1 << 14
MAX_BITS = 1 << 17  # a number with more bits before or after the point is declined


class Undecided(Declined):
    """The enclosures are too wide to decide; more bits may help."""


class Undefined(Invalid):
    """An operation has no real value anywhere on its arguments."""


@dataclass(frozen=True, slots=True)
class Interval:
    """All reals from lo to hi."""

    lo: Fraction
    hi: Fraction

    @property
    def thin(self) -> bool:
        return self.lo == self.hi

    @property
    def magnitude(self) -> Fraction:
        """The largest absolute value in it."""
        return max(abs(self.lo), abs(self.hi))

    @property
    def sign(self) -> int | None:
        """The sign that all its numbers have, None where they differ."""
        if self.lo > 0:
            return 1
        if self.hi < 0:
            return -1
        return 0 if self.lo == self.hi else None


def point(x: Fraction | int) -> Interval:
    return Interval(Fraction(x), Fraction(x))


def rounded_down(x: Fraction, bits: int) -> Fraction:
    """A dyadic number at most x with about `bits` significant bits. Raises Declined beyond MAX_BITS."""
    p, q = x.numerator, x.denominator
    if max(p.bit_length(), q.bit_length()) > 4 * MAX_BITS or abs(p.bit_length() - q.bit_length()) > MAX_BITS:
        raise Declined("a number in the evaluation is too large or too small to be enclosed")
    shift = bits - (p.bit_length() - q.bit_length())
    if shift >= 0:
        return Fraction((p << shift) // q, 1 << shift)
    return Fraction((p // (q << -shift)) << -shift)


def outward(lo: Fraction, hi: Fraction, bits: int) -> Interval:
    """An interval that contains [lo, hi]: the same where it is one short number, else with rounded ends."""
    if lo == hi and max(lo.numerator.bit_length(), lo.denominator.bit_length()) <= EXACT_BITS:
        return Interval(lo, hi)
    return Interval(rounded_down(lo, bits), -rounded_down(-hi, bits))


class Arithmetic(Domain[Interval]):
    """The domain of intervals whose ends are rounded outward to about `bits` significant bits."""

    def __init__(self, bits: int) -> None:
        self.bits = bits

    def constant(self, value: Fraction) -> Interval:
        return point(value)

    def rational(self, a: Interval) -> Fraction | None:
        return a.lo if a.thin else None

    def nonzero(self, a: Interval) -> None:
        if a.sign == 0:
            raise Undefined("a division by zero, or a rate of |.| at zero")
        if a.sign is None:
            raise Undecided("a division by what may be zero, or a rate of |.| there")

    def add(self, a: Interval, b: Interval) -> Interval:
        return outward(a.lo + b.lo, a.hi + b.hi, self.bits)

    def sub(self, a: Interval, b: Interval) -> Interval:
        return outward(a.lo - b.hi, a.hi - b.lo, self.bits)

    def neg(self, a: Interval) -> Interval:
        return Interval(-a.hi, -a.lo)

    def mul(self, a: Interval, b: Interval) -> Interval:
        products = (a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi)
        return outward(min(products), max(products), self.bits)

    def inv(self, a: Interval) -> Interval:
        """1/a is monotone on either side of zero. Raises Undefined at zero, Undecided where it is inside."""
        self.nonzero(a)
        return outward(1 / a.hi, 1 / a.lo, self.bits)

    def square(self, a: Interval) -> Interval:
        return self.power(a, 2)

    def power(self, a: Interval, n: int) -> Interval:
        """a^n, n an integer: monotone on each side of zero, and even powers are least at zero; a^0 is 1."""
        if n < 0:
            return self.inv(self.power(a, -n))
        if n > MAX_BITS:
            raise Declined(f"an exponent larger than {MAX_BITS}")
        a = self.fabs_(a) if n % 2 == 0 else a
        return Interval(_power_at(a.lo, n, self.bits + 8).lo, _power_at(a.hi, n, self.bits + 8).hi)

    def fabs_(self, a: Interval) -> Interval:
        if a.lo >= 0:
            return a
        return self.neg(a) if a.hi <= 0 else Interval(Fraction(0), a.magnitude)

    def sqrt_(self, a: Interval) -> Interval:
        """The root is monotone. Raises Undefined below zero, Undecided where the sign is not known."""
        if a.hi < 0:
            raise Undefined("a square root of a negative number")
        if a.lo < 0:
            raise Undecided("a square root of what may be negative")
        return Interval(_root_at(a.lo, self.bits).lo, _root_at(a.hi, self.bits).hi)


def _power_at(x: Fraction, n: int, bits: int) -> Interval:
    """x^n by squaring; each step rounds outward."""
    domain, result, square = Arithmetic(bits), point(1), point(x)
    while n:
        if n % 2:
            result = domain.mul(result, square)
        n //= 2
        if n:
            square = domain.mul(square, square)
    return result


def _root_at(x: Fraction, bits: int) -> Interval:
    """isqrt(floor(y)) is the integer part of the root of y; y = 4^s x. Exact for the square of a rational."""
    p, q = x.numerator, x.denominator
    if isqrt(p) ** 2 == p and isqrt(q) ** 2 == q:
        return point(Fraction(isqrt(p), isqrt(q)))
    s = bits - (p.bit_length() - q.bit_length()) // 2
    n = isqrt((p << 2 * s) // q if s >= 0 else p // (q << -2 * s))
    unit = Fraction(2) ** -s
    return Interval(n * unit, (n + 1) * unit)
