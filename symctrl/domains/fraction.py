"""Exact rational values: the domain in which witnesses are evaluated.

A value that is not rational has no place here: the domain says which operation left the rationals, and the
caller chooses another point. Nothing is ever rounded.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction

from symctrl.domains.domain import Operators

MAX_BITS = 1_000_000

Predicate = Callable[[Fraction], bool]


class NoExactValue(ValueError):  # noqa: N818
    """The operation has no exact rational value at this argument."""


class Undefined(NoExactValue):
    """The argument lies outside the domain of the operation, over the reals."""


class Irrational(NoExactValue):
    """The value is real, but not rational (or not known to be)."""


class TooLarge(NoExactValue):
    """The value is rational, but has more than MAX_BITS bits."""


def rational_root(value: Fraction, degree: int) -> Fraction | None:
    """The nonnegative r with r**degree = value, if it is rational. Needs value >= 0 and degree >= 1."""
    top, bottom = _integer_root(value.numerator, degree), _integer_root(value.denominator, degree)
    return None if top is None or bottom is None else Fraction(top, bottom)


def _integer_root(value: int, degree: int) -> int | None:
    if degree == 1 or value < 2:
        return value
    root = math.isqrt(value) if degree == 2 else _floor_root(value, degree)
    return root if root**degree == value else None


def _floor_root(value: int, degree: int) -> int:
    """Newton's iteration from above decreases until it reaches the integer part of the root."""
    root = 1 << -(-value.bit_length() // degree)
    while True:
        closer = ((degree - 1) * root + value // root ** (degree - 1)) // degree
        if closer >= root:
            return root
        root = closer


def _known(op: str, inside: Predicate, table: dict[Fraction, Fraction]) -> Callable[..., Fraction]:
    """A transcendental function: rational only where `table` says so, undefined where `inside` is false."""

    def evaluate(self: FractionDomain, a: Fraction) -> Fraction:
        if not inside(a):
            raise Undefined(f"{op}({a}) is undefined over the reals")
        if a not in table:
            raise Irrational(f"{op}({a}) has no known rational value")
        return table[a]

    evaluate.__doc__ = f"{op}(a). Raises Irrational or Undefined."
    return evaluate


_ZERO, _ONE = Fraction(0), Fraction(1)


def _everywhere(a: Fraction) -> bool:
    return True


def _truth(value: bool) -> Fraction:
    return _ONE if value else _ZERO


class FractionDomain(Operators[Fraction]):
    """Values are `Fraction`; a truth value is 0 or 1, and every value but 0 is true.

    Raises Undefined, Irrational or TooLarge, which are all NoExactValue.
    """

    name = "fraction"

    def constant(self, value: Fraction) -> Fraction:
        return value

    def inv_(self, a: Fraction) -> Fraction:
        if not a:
            raise Undefined("inv(0): the inverse of zero is undefined")
        return 1 / a

    def div_(self, a: Fraction, b: Fraction) -> Fraction:
        if not b:
            raise Undefined(f"div({a}, 0): a division by zero is undefined")
        return a / b

    def sqrt_(self, a: Fraction) -> Fraction:
        """The nonnegative root of a perfect square. Raises Irrational, and Undefined below zero."""
        if a < 0:
            raise Undefined(f"sqrt({a}): the root of a negative number is undefined over the reals")
        root = rational_root(a, 2)
        if root is None:
            raise Irrational(f"sqrt({a}) is irrational")
        return root

    def pow_(self, a: Fraction, b: Fraction) -> Fraction:
        """a**b: any base for an integer b (0**0 is 1), a base >= 0 for other exponents."""
        if b.denominator == 1:
            return self._integer_power(a, int(b))
        if a < 0 or (a == 0 and b < 0):
            raise Undefined(f"pow({a}, {b}) is undefined over the reals")
        root = rational_root(a, b.denominator)
        if root is None:
            raise Irrational(f"pow({a}, {b}) is irrational")
        return self._integer_power(root, b.numerator)

    def _integer_power(self, a: Fraction, n: int) -> Fraction:
        if a == 0 and n < 0:
            raise Undefined(f"pow(0, {n}): a negative power of zero is undefined")
        bits = max(abs(a.numerator).bit_length(), a.denominator.bit_length())
        if abs(a) not in (0, 1) and bits * abs(n) > MAX_BITS:
            raise TooLarge(f"pow({a}, {n}) has more than {MAX_BITS} bits")
        return a**n

    def sign_(self, a: Fraction) -> Fraction:
        return Fraction((a > 0) - (a < 0))

    def fabs_(self, a: Fraction) -> Fraction:
        return abs(a)

    def floor_(self, a: Fraction) -> Fraction:
        return Fraction(math.floor(a))

    def ceil_(self, a: Fraction) -> Fraction:
        return Fraction(math.ceil(a))

    def fmin_(self, a: Fraction, b: Fraction) -> Fraction:
        return min(a, b)

    def fmax_(self, a: Fraction, b: Fraction) -> Fraction:
        return max(a, b)

    def copysign_(self, a: Fraction, b: Fraction) -> Fraction:
        """|a| with the sign of b; an exact zero counts as positive."""
        return -abs(a) if b < 0 else abs(a)

    def fmod_(self, a: Fraction, b: Fraction) -> Fraction:
        """a - n b with n = a/b rounded towards zero."""
        return a - b * math.trunc(self.div_(a, b))

    def remainder_(self, a: Fraction, b: Fraction) -> Fraction:
        """a - n b with n the integer nearest to a/b, the even one of two."""
        return a - b * round(self.div_(a, b))

    def lt_(self, a: Fraction, b: Fraction) -> Fraction:
        return _truth(a < b)

    def le_(self, a: Fraction, b: Fraction) -> Fraction:
        return _truth(a <= b)

    def eq_(self, a: Fraction, b: Fraction) -> Fraction:
        return _truth(a == b)

    def ne_(self, a: Fraction, b: Fraction) -> Fraction:
        return _truth(a != b)

    def and_(self, a: Fraction, b: Fraction) -> Fraction:
        return _truth(bool(a) and bool(b))

    def or_(self, a: Fraction, b: Fraction) -> Fraction:
        return _truth(bool(a) or bool(b))

    def not_(self, a: Fraction) -> Fraction:
        return _truth(not a)

    def if_else_zero_(self, a: Fraction, b: Fraction) -> Fraction:
        return b if a else _ZERO

    def atan2_(self, a: Fraction, b: Fraction) -> Fraction:
        """The angle of the point (b, a): rational only on the positive half axis, undefined at the origin."""
        if a:
            raise Irrational(f"atan2({a}, {b}) has no known rational value")
        if not b:
            raise Undefined("atan2(0, 0) is undefined: the origin has no angle")
        if b < 0:
            raise Irrational(f"atan2(0, {b}) is pi, which is irrational")
        return _ZERO

    exp_ = _known("exp", _everywhere, {_ZERO: _ONE})
    log_ = _known("log", lambda a: a > 0, {_ONE: _ZERO})
    sin_ = _known("sin", _everywhere, {_ZERO: _ZERO})
    cos_ = _known("cos", _everywhere, {_ZERO: _ONE})
    tan_ = _known("tan", _everywhere, {_ZERO: _ZERO})
    asin_ = _known("asin", lambda a: abs(a) <= 1, {_ZERO: _ZERO})
    acos_ = _known("acos", lambda a: abs(a) <= 1, {_ONE: _ZERO})
    atan_ = _known("atan", _everywhere, {_ZERO: _ZERO})
    sinh_ = _known("sinh", _everywhere, {_ZERO: _ZERO})
    cosh_ = _known("cosh", _everywhere, {_ZERO: _ONE})
    tanh_ = _known("tanh", _everywhere, {_ZERO: _ZERO})
    asinh_ = _known("asinh", _everywhere, {_ZERO: _ZERO})
    acosh_ = _known("acosh", lambda a: a >= 1, {_ONE: _ZERO})
    atanh_ = _known("atanh", lambda a: abs(a) < 1, {_ZERO: _ZERO})
    erf_ = _known("erf", _everywhere, {_ZERO: _ZERO})
    erfinv_ = _known("erfinv", lambda a: abs(a) < 1, {_ZERO: _ZERO})
    log1p_ = _known("log1p", lambda a: a > -1, {_ZERO: _ZERO})
    expm1_ = _known("expm1", _everywhere, {_ZERO: _ZERO})
