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
from symctrl.kernel.interval import Arithmetic, Interval, point, rounded_down

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
    total = Interval(Fraction(total_low - tail, one), Fraction(total_high + tail, one))
    return Arithmetic(bits).mul(first, total)


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
        result = Arithmetic(bits).mul(result, result)
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
    domain = Arithmetic(bits)
    part = _odd_series(point((m - 1) / (m + 1)), 1, bits)
    whole = domain.mul(point(2 * e), _half_log2(bits + abs(e).bit_length()))
    return domain.add(whole, domain.add(part, part))


def _odd_series(z: Interval, side: int, bits: int) -> Interval:
    """The sum of side^n z^(2n+1)/(2n+1): atanh(z) for side 1, atan(z) for -1; r(n) = (2n+1)/(2n+3) < 1."""
    domain, z = Arithmetic(bits), _short(z, bits)
    square = domain.mul(z, z)
    step = square if side > 0 else domain.neg(square)
    return _series(z, step, lambda n: (2 * n + 1, 2 * n + 3), Fraction(1), bits)


@lru_cache(maxsize=16)
def _half_log2(bits: int) -> Interval:
    return _odd_series(point(Fraction(1, 3)), 1, bits)


@lru_cache(maxsize=16)
def pi(bits: int) -> Interval:
    """Machin: pi = 16 atan(1/5) - 4 atan(1/239)."""
    domain = Arithmetic(bits + GUARD)
    fifth, small = (_odd_series(point(Fraction(1, q)), -1, bits + GUARD) for q in (5, 239))
    return domain.sub(domain.mul(point(16), fifth), domain.mul(point(4), small))


def atan_at(x: Fraction, bits: int) -> Interval:
    if x == 0:
        return point(0)
    domain = Arithmetic(bits + GUARD)
    if x < 0:
        return domain.neg(atan_at(-x, bits))
    if x > 1:
        return domain.sub(domain.mul(point(Fraction(1, 2)), pi(domain.bits)), atan_at(1 / x, domain.bits))
    z = _short(point(x), domain.bits)
    for _ in range(2):  # from an angle of at most pi/4 to one of at most pi/16
        root = domain.sqrt_(domain.add(_ONE, domain.mul(z, z)))
        z = domain.mul(z, domain.inv(domain.add(_ONE, root)))
    return domain.mul(point(4), _odd_series(z, -1, domain.bits))


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
    domain = Arithmetic(bits + 2 * size)
    half = domain.mul(point(Fraction(1, 2)), pi(domain.bits))
    k = round(x / half.lo)
    r = _short(domain.sub(point(x), domain.mul(point(k), half)), bits)
    if r.magnitude > 1:
        raise Declined("an angle could not be reduced to a quarter turn")
    turn = (k + quarter) % 4
    value = _quarter(r, turn % 2, bits)
    value = domain.neg(value) if turn >= 2 else value
    return Interval(max(value.lo, Fraction(-1)), min(value.hi, Fraction(1)))


def _quarter(r: Interval, even: int, bits: int) -> Interval:
    """cos r for even = 1, with r(n) = 1/((2n+1)(2n+2)) <= 1/2; sin r for 0, with 1/((2n+2)(2n+3)) <= 1/6."""
    domain = Arithmetic(bits)
    step = domain.neg(domain.mul(r, r))
    if even:
        return _series(_ONE, step, lambda n: (1, (2 * n + 1) * (2 * n + 2)), Fraction(1, 2), bits)
    return _series(r, step, lambda n: (1, (2 * n + 2) * (2 * n + 3)), Fraction(1, 6), bits)


def _short(x: Interval, bits: int) -> Interval:
    """Ends of about `bits` bits even for one exact number, whose powers in a series would grow."""
    return Interval(rounded_down(x.lo, bits), -rounded_down(-x.hi, bits))
