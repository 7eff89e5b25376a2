"""Enclosures of every operation of a listing: the kernel's interval meaning of the instructions.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: an interval extension of each operation gives, by induction over the instructions, an interval
extension of the listing (Moore, Interval Analysis, 1966). Monotone functions are enclosed by their values at
the end points, periodic ones with the extremes that may lie between. What jumps is evaluated only where its
case is decided. An operation that has no value anywhere on its arguments raises Undefined, one that may have
none Undecided.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import ceil, floor

from symctrl.kernel import elementary
from symctrl.kernel.certificate import Declined
from symctrl.kernel.interval import Arithmetic, Interval, Undecided, Undefined, outward, point

AtPoint = Callable[[Fraction, int], Interval]
MAX_ROOT = 64


class Enclosure(Arithmetic):
    """Interval arithmetic with every function that has a rule."""

    def function(self, op: str, args: Sequence[Interval]) -> Interval:
        method: Callable[..., Interval] | None = getattr(self, f"{op.lower()}_", None)
        if method is None:
            raise Declined(f"{op.lower()} has no rule in the kernel")
        return method(*args)

    # Powers: x^y = exp(y log x) for x > 0; an integer exponent has a meaning for every base.

    def pow_(self, a: Interval, b: Interval) -> Interval:
        if b.thin and b.lo.denominator == 1:
            return self.power(a, b.lo.numerator)
        if a.hi < 0:
            raise Undefined("a power of a negative number with an exponent that is not an integer")
        if a.sign == 0 and b.sign is not None:
            if b.sign <= 0:
                raise Undefined("zero to a negative power")
            return point(0)
        if a.lo < 0 or (a.lo == 0 and (not b.thin or b.lo < 0)):
            raise Undecided("a power of what may be zero or negative")
        if b.thin:
            return self._hull(self._rational_power(a.lo, b.lo), self._rational_power(a.hi, b.lo))
        return self.exp_(self.mul(b, self.log_(a)))

    def _rational_power(self, x: Fraction, exponent: Fraction) -> Interval:
        """x^(p/q), x >= 0: monotone in x. Exact where x is the q-th power of a rational."""
        if x == 0:
            return point(0)
        q = exponent.denominator
        root = _exact_root(x, q)
        if root is not None:
            return self.power(point(root), exponent.numerator)
        return self.exp_(self.mul(point(exponent), self.log_(point(x))))

    # Monotone functions.

    def _rising(self, a: Interval, at: AtPoint) -> Interval:
        low = at(a.lo, self.bits)
        high = low if a.thin else at(a.hi, self.bits)
        return outward(low.lo, high.hi, self.bits)

    def exp_(self, a: Interval) -> Interval:
        return self._rising(a, elementary.exp_at)

    def log_(self, a: Interval) -> Interval:
        if a.hi <= 0:
            raise Undefined("a logarithm of a number that is not positive")
        if a.lo <= 0:
            raise Undecided("a logarithm of what may not be positive")
        return self._rising(a, elementary.log_at)

    def atan_(self, a: Interval) -> Interval:
        return self._rising(a, elementary.atan_at)

    def tanh_(self, a: Interval) -> Interval:
        """1 - 2/(e^2a + 1), in which a occurs once."""
        below = self.add(self.exp_(self.mul(point(2), a)), point(1))
        return self.sub(point(1), self.mul(point(2), self.inv(below)))

    def asin_(self, a: Interval) -> Interval:
        """atan(x/root(1 - x^2)) rises for |x| < 1; +-pi/2 at the ends."""
        if a.lo > 1 or a.hi < -1:
            raise Undefined("an arc sine of a number outside [-1, 1]")
        if a.magnitude > 1:
            raise Undecided("an arc sine of what may be outside [-1, 1]")
        return self._rising(a, self._asin_at)

    def _asin_at(self, x: Fraction, bits: int) -> Interval:
        if abs(x) == 1:
            return self.mul(point(x / 2), elementary.pi(bits))
        return self.atan_(self.mul(point(x), self.inv(self.sqrt_(point(1 - x * x)))))

    def acos_(self, a: Interval) -> Interval:
        """pi/2 - asin(x)."""
        if a.thin and a.lo == 1:
            return point(0)
        return self.sub(self.mul(point(Fraction(1, 2)), elementary.pi(self.bits)), self.asin_(a))

    def angle(self, cos: Fraction, sin: Fraction) -> Interval:
        """The angle in (-pi, pi] of a point of the unit circle: 2 atan(sin/(1 + cos)), or pi."""
        if cos == -1:
            return elementary.pi(self.bits)
        return self.mul(point(2), self.atan_(point(sin / (1 + cos))))

    # Periodic functions.

    def sin_(self, a: Interval) -> Interval:
        """Extremes (-1)^k at pi/2 + k pi."""
        return self._wave(a, elementary.sin_at, Fraction(1, 2))

    def cos_(self, a: Interval) -> Interval:
        """Extremes (-1)^k at k pi."""
        return self._wave(a, elementary.cos_at, Fraction(0))

    def _wave(self, a: Interval, at: AtPoint, first: Fraction) -> Interval:
        """The hull of the values at the ends and of all extremes that may lie between."""
        low = at(a.lo, self.bits)
        if a.thin:
            return outward(low.lo, low.hi, self.bits)
        if a.hi - a.lo > 7:
            return Interval(Fraction(-1), Fraction(1))
        high = at(a.hi, self.bits)
        turns = self.sub(self.mul(a, self.inv(elementary.pi(self.bits))), point(first))
        extremes = [point((-1) ** (k % 2)) for k in range(ceil(turns.lo), floor(turns.hi) + 1)]
        return self._hull(low, high, *extremes)

    def sign_(self, a: Interval) -> Interval:
        if a.sign is None:
            raise Undecided("the sign of what may be zero")
        return point(a.sign)

    def _hull(self, *parts: Interval) -> Interval:
        return outward(min(part.lo for part in parts), max(part.hi for part in parts), self.bits)


def _exact_root(x: Fraction, q: int) -> Fraction | None:
    """The q-th root of x > 0 where it is rational: then both parts of the fraction are q-th powers."""
    if q > MAX_ROOT:
        return None
    top, bottom = _integer_root(x.numerator, q), _integer_root(x.denominator, q)
    return Fraction(top, bottom) if top**q == x.numerator and bottom**q == x.denominator else None


def _integer_root(n: int, q: int) -> int:
    """The integer part of the q-th root of n >= 1, by bisection."""
    low, high = 1, 1 << (n.bit_length() // q + 1)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if middle**q <= n else (low, middle)
    return low
