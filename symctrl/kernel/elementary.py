"""Enclosures of elementary functions at one rational number.

Soundness-critical. Last reviewed 2026-11-24.

Theorem (tail): where each term of a series is at most half the one before in magnitude, the sum of all terms
after the last one taken is at most that term in magnitude. All series here are Taylor series whose arguments
are reduced so far that this holds; partial sums are enclosed, which bounds their rounding.
The reductions are identities (Abramowitz and Stegun, chapter 4): exp(x) = exp(x/2^k)^(2^k), log(2^e m) =
e log 2 + log m, atan(x) = 2 atan(x/(1 + root(1 + x^2))), atan(x) = pi/2 - atan(1/x) for x > 0, and sin and
cos by quarter turns.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache
from math import ceil, floor

from symctrl.kernel.certificate import Declined
from symctrl.kernel.interval import (
    Interval,
    add,
    inverse,
    multiply,
    negative,
    point,
    rounded_down,
    square_root,
    subtract,
)

MAX_EXPONENT = 1 << 14  # of exp
MAX_ANGLE_BITS = 256
GUARD = 12
Ratio = Callable[[int], tuple[int, int]]
_ONE = point(1)


def _series(first: Interval, step: Interval, ratio: Ratio, most: Fraction, bits: int) -> Interval:
    """first (1 + step r(0) + step^2 r(0) r(1) + ..), where 0 < r(n) = p/q <= most with ratio(n) = (p, q).

    Terms and their sum are pairs of integers in units of 2^-bits, rounded outward.
    """
    if step.magnitude * most > Fraction(1, 2):
        raise Declined("the argument of a series was not reduced far enough")
    one = 1 << bits
    ends = floor(step.lo * one), ceil(step.hi * one)
    low = high = total_low = total_high = one
    n = 0
    while max(abs(low), abs(high)) > 2:
        p, q = ratio(n)
        products = [p * end * term for end in ends for term in (low, high)]
        low, high = min(products) // (q << bits), -(-max(products) // (q << bits))
        total_low, total_high, n = total_low + low, total_high + high, n + 1
    tail = max(abs(low), abs(high))
    return multiply(first, Interval(Fraction(total_low - tail, one), Fraction(total_high + tail, one)), bits)


def exp_at(x: Fraction, bits: int) -> Interval:
    """r(n) = 1/(n+1) <= 1, and |x/2^k| <= 1/2."""
    if x == 0:
        return _ONE
    if abs(x) > MAX_EXPONENT:
        raise Declined(f"exp of a number beyond {MAX_EXPONENT} in magnitude")
    k = (abs(x.numerator) // x.denominator).bit_length() + 1
    bits += k + GUARD
    result = _series(_ONE, _short(point(x / 2**k), bits), lambda n: (1, n + 1), Fraction(1), bits)
    for _ in range(k):
        result = multiply(result, result, bits)
    return result


def log_at(x: Fraction, bits: int) -> Interval:
    """x > 0. With 2/3 <= m <= 4/3: log m = 2 atanh(z), z = (m-1)/(m+1), z^2 <= 1/25."""
    if x == 1:
        return point(0)
    bits += GUARD
    e = x.numerator.bit_length() - x.denominator.bit_length()
    m = x / Fraction(2) ** e  # between 1/2 and 2
    while m > Fraction(4, 3):
        m, e = m / 2, e + 1
    while m < Fraction(2, 3):
        m, e = m * 2, e - 1
    part = _atanh(_short(point((m - 1) / (m + 1)), bits), bits)
    whole = multiply(point(2 * e), _half_log2(bits + abs(e).bit_length()), bits)
    return add(whole, add(part, part, bits), bits)


@lru_cache(maxsize=16)
def _half_log2(bits: int) -> Interval:
    return _atanh(_short(point(Fraction(1, 3)), bits), bits)


def _atanh(z: Interval, bits: int) -> Interval:
    """r(n) = (2n+1)/(2n+3) < 1."""
    return _series(z, multiply(z, z, bits), lambda n: (2 * n + 1, 2 * n + 3), Fraction(1), bits)


@lru_cache(maxsize=16)
def pi(bits: int) -> Interval:
    """Machin: pi = 16 atan(1/5) - 4 atan(1/239)."""
    bits += GUARD
    parts = [multiply(point(c), _atan(point(Fraction(1, q)), bits), bits) for c, q in ((16, 5), (4, 239))]
    return subtract(parts[0], parts[1], bits)


def atan_at(x: Fraction, bits: int) -> Interval:
    if x == 0:
        return point(0)
    if x < 0:
        return negative(atan_at(-x, bits))
    bits += GUARD
    if x > 1:
        half = multiply(point(Fraction(1, 2)), pi(bits), bits)
        return subtract(half, atan_at(1 / x, bits), bits)
    z = _short(point(x), bits)
    for _ in range(2):  # from an angle of at most pi/4 to one of at most pi/16
        root = square_root(add(_ONE, multiply(z, z, bits), bits), bits)
        z = multiply(z, inverse(add(_ONE, root, bits), bits), bits)
    return multiply(point(4), _atan(z, bits), bits)


def _atan(z: Interval, bits: int) -> Interval:
    """r(n) = (2n+1)/(2n+3) < 1."""
    z = _short(z, bits)
    square = negative(multiply(z, z, bits))
    return _series(z, square, lambda n: (2 * n + 1, 2 * n + 3), Fraction(1), bits)


def sin_at(x: Fraction, bits: int) -> Interval:
    return point(0) if x == 0 else _turned(x, 0, bits)


def cos_at(x: Fraction, bits: int) -> Interval:
    return _ONE if x == 0 else _turned(x, 1, bits)


def _turned(x: Fraction, quarter: int, bits: int) -> Interval:
    """sin(x + quarter pi/2): with x = k pi/2 + r, |r| < 1, it is one of sin r, cos r, -sin r, -cos r."""
    size = (abs(x.numerator) // x.denominator).bit_length()
    if size > MAX_ANGLE_BITS:
        return Interval(Fraction(-1), Fraction(1))
    bits += GUARD
    half = multiply(point(Fraction(1, 2)), pi(bits + 2 * size), bits + 2 * size)
    k = round(x / half.lo)
    r = subtract(point(x), multiply(point(k), half, bits + 2 * size), bits + size)
    if r.magnitude > 1:
        raise Declined("an angle could not be reduced to a quarter turn")
    turn = (k + quarter) % 4
    value = _cos(_short(r, bits), bits) if turn % 2 else _sin(_short(r, bits), bits)
    value = negative(value) if turn >= 2 else value
    return Interval(max(value.lo, Fraction(-1)), min(value.hi, Fraction(1)))


def _sin(r: Interval, bits: int) -> Interval:
    """r(n) = 1/((2n+2)(2n+3)) <= 1/6 and r^2 <= 1."""
    square = negative(multiply(r, r, bits))
    return _series(r, square, lambda n: (1, (2 * n + 2) * (2 * n + 3)), Fraction(1, 6), bits)


def _cos(r: Interval, bits: int) -> Interval:
    """r(n) = 1/((2n+1)(2n+2)) <= 1/2 and r^2 <= 1."""
    square = negative(multiply(r, r, bits))
    return _series(_ONE, square, lambda n: (1, (2 * n + 1) * (2 * n + 2)), Fraction(1, 2), bits)


def _short(x: Interval, bits: int) -> Interval:
    """Ends of about `bits` bits even for one exact number, whose powers in a series would grow."""
    return Interval(rounded_down(x.lo, bits), -rounded_down(-x.hi, bits))
