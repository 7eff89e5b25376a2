"""Rigorous enclosures by balls, rounded outward (Johansson, Arb, IEEE Trans. Computers 66 (2017) 1281).

Every operation returns a ball that contains its value for all arguments in the given balls. nan means
undecided: the operation may be undefined somewhere on its arguments (a divisor contains zero), and nothing is
said about the value. Arb is made for narrow balls; at wide ones the operations here take hulls over the ends
of their arguments wherever they are monotone, and keep what is not negative from dipping below zero.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from functools import partial, reduce
from typing import Any, TypeAlias

import flint
from flint import arb

from symctrl.domains.domain import Operators
from symctrl.graph import Tape, prebound

Ball: TypeAlias = Any  # flint.arb, which has no type information

NARROW_BITS = 40  # a ball with this relative accuracy is evaluated as it is: a hull would be no tighter
NAN, ZERO, ONE, HALF = arb("nan"), arb(0), arb(1), arb(0.5)
EITHER = arb(0.5, 0.5)  # a truth value that is not known


def ball(low: Fraction, high: Fraction) -> Ball:
    """A ball that contains [low, high], rounded outward, but not below zero for low >= 0."""
    hull = _exact(low).union(_exact(high))
    return hull.nonnegative_part() if low >= 0 else hull


def bounds(x: Ball) -> tuple[Fraction, Fraction] | None:
    """Rational bounds of all values in the ball; None if it is unbounded or nan."""
    if not x.is_finite():
        return None
    middle, radius = _dyadic(x.mid()), _dyadic(x.rad())
    return middle - radius, middle + radius


def _exact(value: Fraction) -> Ball:
    return arb(flint.fmpq(value.numerator, value.denominator))


def _dyadic(x: Ball) -> Fraction:
    mantissa, exponent = (int(part) for part in x.man_exp())
    return Fraction(mantissa) * Fraction(2) ** exponent


def _narrow(a: Ball) -> bool:
    return bool(a.rel_accuracy_bits() > NARROW_BITS)


def _straddles(a: Ball) -> bool:
    return not (a >= 0 or a <= 0)


def _monotone(function: Callable[[Ball], Ball], a: Ball) -> Ball:
    """Enclosure of a monotone function: at a wide ball, the hull of the values at its ends.

    What is not finite becomes nan: an infinity (log 0) is no value, and some functions of FLINT turn nan and
    infinities back into numbers (asin(nan), tanh(inf)).
    """
    if not a.is_finite():
        return NAN
    value = function(a) if _narrow(a) else function(a.lower()).union(function(a.upper()))
    return value if value.is_finite() else NAN


def _increasing(function: Callable[[Ball], Ball]) -> Any:
    return staticmethod(partial(_monotone, function))


def _known(a: Ball) -> bool | None:
    """The truth value of a ball: None if it contains zero and something else."""
    if a == 0:
        return False
    return True if a != 0 else None


def _truth(true: bool, false: bool, *args: Ball) -> Ball:
    if true or false:
        return ONE if true else ZERO
    return NAN if any(a.is_nan() for a in args) else EITHER


class IntervalDomain(Operators[Ball]):
    """Values are `flint.arb`. bits: the working precision of `walk` and `constant`.

    Outside `walk` and `working` an operation rounds at FLINT's current precision; it encloses all the same.
    """

    name = "interval"

    def __init__(self, bits: int = 128) -> None:
        self.bits = bits

    @contextmanager
    def working(self) -> Iterator[None]:
        """FLINT's precision, which is global, is `bits` inside and restored after."""
        before, flint.ctx.prec = flint.ctx.prec, self.bits
        try:
            yield
        finally:
            flint.ctx.prec = before

    def walk(self, tape: Tape) -> Callable[[Sequence[Ball]], list[Ball]]:
        """The pre-bound walk over `tape` at the domain's own precision."""
        run = prebound(tape, self)

        def enclose(inputs: Sequence[Ball]) -> list[Ball]:
            with self.working():
                return run(inputs)

        return enclose

    def constant(self, value: Fraction) -> Ball:
        with self.working():
            return _exact(value)

    # The ring operations. They are hot: one comparison decides whether the plain ball operation will do.

    def add_(self, a: Ball, b: Ball) -> Ball:
        r = a + b
        return r if r > ZERO or not (a >= ZERO and b >= ZERO) else r.nonnegative_part()

    def mul_(self, a: Ball, b: Ball) -> Ball:
        """The plain product of two wide balls is up to twice too wide, so it is the hull over the ends."""
        r = a * b
        if r > ZERO or r < ZERO or _narrow(a) or _narrow(b):
            return r
        ends = [(x, y) for x in (a.lower(), a.upper()) for y in (b.lower(), b.upper())]
        hull = reduce(arb.union, [x * y for x, y in ends])
        alike = (a >= ZERO and b >= ZERO) or (a <= ZERO and b <= ZERO)
        return hull.nonnegative_part() if alike else hull

    def div_(self, a: Ball, b: Ball) -> Ball:
        return self.mul_(a, 1 / b)

    def sign_(self, a: Ball) -> Ball:
        return NAN if a.is_nan() else a.sgn()

    sin_ = staticmethod(arb.sin)
    cos_ = staticmethod(arb.cos)
    exp_ = _increasing(arb.exp)
    expm1_ = _increasing(arb.expm1)
    log_ = _increasing(arb.log)
    log1p_ = _increasing(arb.log1p)
    asin_ = _increasing(arb.asin)
    atan_ = _increasing(arb.atan)
    sinh_ = _increasing(arb.sinh)
    tanh_ = _increasing(arb.tanh)
    asinh_ = _increasing(arb.asinh)
    acosh_ = _increasing(arb.acosh)
    atanh_ = _increasing(arb.atanh)
    erf_ = _increasing(arb.erf)
    erfinv_ = _increasing(arb.erfinv)
    floor_ = _increasing(arb.floor)
    ceil_ = _increasing(arb.ceil)

    def twice_(self, a: Ball) -> Ball:
        return a + a

    def sq_(self, a: Ball) -> Ball:
        """Never negative, unlike the product of a ball with itself."""
        if _narrow(a):
            return a * a
        low, high = a.abs_lower(), a.abs_upper()
        return (low * low).union(high * high).nonnegative_part()

    def sqrt_(self, a: Ball) -> Ball:
        return _monotone(arb.sqrt, a).nonnegative_part()

    def acos_(self, a: Ball) -> Ball:
        return _monotone(arb.acos, a)

    def cosh_(self, a: Ball) -> Ball:
        return _monotone(arb.cosh, self.fabs_(a))

    def tan_(self, a: Ball) -> Ball:
        t = a.tan()
        return t if t.is_finite() else NAN

    def fabs_(self, a: Ball) -> Ball:
        if not _straddles(a):
            return abs(a)
        return a.abs_upper().union(ZERO).nonnegative_part()

    def hypot_(self, a: Ball, b: Ball) -> Ball:
        """Increasing in |a| and in |b|."""
        low = (a.abs_lower() ** 2 + b.abs_lower() ** 2).sqrt()
        high = (a.abs_upper() ** 2 + b.abs_upper() ** 2).sqrt()
        return low.union(high).nonnegative_part()

    def pow_(self, a: Ball, b: Ball) -> Ball:
        """Any base for an exact integer exponent; else a base > 0, or >= 0 for an exponent > 0."""
        if b.is_integer():
            return self._integer_power(a, int(b.unique_fmpz()))
        if a > 0:
            return _monotone(lambda x: x**b, a)
        if a >= 0 and b > 0:
            return (a.upper() ** b).union(ZERO).nonnegative_part() if a.upper() > 0 else ZERO
        return NAN

    def _integer_power(self, a: Ball, n: int) -> Ball:
        if n < 0:
            return 1 / self._integer_power(a, -n)
        if n == 0:
            return NAN if a.is_nan() else ONE
        if n % 2:
            return _monotone(lambda x: x**n, a)
        return _monotone(lambda x: x**n, self.fabs_(a)).nonnegative_part()

    def atan2_(self, a: Ball, b: Ball) -> Ball:
        if a.contains(0) and b.contains(0):
            return NAN
        return arb.atan2(a, b)

    # Operations with jumps: where the ball straddles one, the hull of both sides.

    def fmin_(self, a: Ball, b: Ball) -> Ball:
        return a.min(b)

    def fmax_(self, a: Ball, b: Ball) -> Ball:
        return a.max(b)

    def copysign_(self, a: Ball, b: Ball) -> Ball:
        """|a| with the sign of b; zero counts as positive."""
        size = self.fabs_(a)
        if b >= 0:
            return size
        if b < 0:
            return -size
        return NAN if b.is_nan() else size.union(-size)

    def fmod_(self, a: Ball, b: Ball) -> Ball:
        """a - n b with n = a/b rounded towards zero; where n is not unique, a bound by |a| and |b|."""
        ratio = a / b
        if not ratio.is_finite():
            return NAN
        low, high = ratio.lower(), ratio.upper()
        n = [x.floor() if x >= 0 else x.ceil() for x in (low, high)]
        if n[0] == n[1]:
            return a - n[0] * b
        size = a.abs_upper().min(b.abs_upper())
        return (ZERO if a >= 0 else -size).union(ZERO if a <= 0 else size)

    def remainder_(self, a: Ball, b: Ball) -> Ball:
        """a - n b with n the integer nearest to a/b; where n is not unique, a bound by |a| and |b|/2."""
        shifted = a / b + HALF
        if not shifted.is_finite():
            return NAN
        if not shifted.contains_integer():
            return a - shifted.lower().floor() * b
        size = a.abs_upper().min(b.abs_upper() * HALF)
        return (-size).union(size)

    def lt_(self, a: Ball, b: Ball) -> Ball:
        return _truth(a < b, a >= b, a, b)

    def le_(self, a: Ball, b: Ball) -> Ball:
        return _truth(a <= b, a > b, a, b)

    def eq_(self, a: Ball, b: Ball) -> Ball:
        return _truth(a == b, a != b, a, b)

    def ne_(self, a: Ball, b: Ball) -> Ball:
        return _truth(a != b, a == b, a, b)

    def not_(self, a: Ball) -> Ball:
        return _truth(a == 0, a != 0, a)

    def and_(self, a: Ball, b: Ball) -> Ball:
        if a.is_nan() or b.is_nan():
            return NAN
        left, right = _known(a), _known(b)
        return _truth(left is True and right is True, left is False or right is False, a, b)

    def or_(self, a: Ball, b: Ball) -> Ball:
        if a.is_nan() or b.is_nan():
            return NAN
        left, right = _known(a), _known(b)
        return _truth(left is True or right is True, left is False and right is False, a, b)

    def if_else_zero_(self, a: Ball, b: Ball) -> Ball:
        """b where a is not zero; a branch that is certainly not taken may be undecided."""
        known = _known(a)
        if known is None:
            return NAN if a.is_nan() else b.union(ZERO)
        return b if known else ZERO
