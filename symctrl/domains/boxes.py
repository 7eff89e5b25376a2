"""Enclosures over many boxes at once: a value is an array of intervals, one for each box.

Rounding: every operation in floating point is rounded outward by one step (IEEE 754 operations are correctly
rounded, so that the exact result lies between the neighbours of the computed one). Over exact fractions
nothing is rounded. nan means undecided: the operation may be undefined somewhere in the box. It stays nan in
all that is made of it; exact fractions have no nan, and Unsupported is raised in its place.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from math import inf, isinf, nextafter
from typing import Any, TypeAlias

import numpy as np

from symctrl.domains.domain import Domain, Unsupported

Array: TypeAlias = Any  # an array of float64, or of Fraction


def quiet() -> AbstractContextManager[None]:
    """Inside, infinities and nan are values like others, and no reason for numpy to warn."""
    return np.errstate(all="ignore")


@dataclass(frozen=True, slots=True)
class Box:
    """low <= value <= high in every box. power: of a constant, its exact value, for exponents."""

    low: Array
    high: Array
    power: Fraction | None = None


class Boxes(Domain[Box]):
    """Values are `Box`. exact: the ends are fractions; else float64, rounded outward."""

    name = "boxes"

    def __init__(self, exact: bool = False) -> None:
        self.exact = exact

    def between(self, low: Fraction, high: Fraction) -> Box:
        """One interval for all boxes."""
        if self.exact:
            return Box(_one(low), _one(high))
        return Box(np.array([rounded(low, -np.inf)]), np.array([rounded(high, np.inf)]))

    def constant(self, value: Fraction) -> Box:
        return Box(*_ends(self.between(value, value)), power=value)

    def add_(self, a: Box, b: Box) -> Box:
        return self._out(a.low + b.low, a.high + b.high)

    def neg_(self, a: Box) -> Box:
        return Box(-a.high, -a.low)

    def sub_(self, a: Box, b: Box) -> Box:
        return self._out(a.low - b.high, a.high - b.low)

    def mul_(self, a: Box, b: Box) -> Box:
        ends = [self._product(x, y) for x in (a.low, a.high) for y in (b.low, b.high)]
        return self._out(reduce(np.minimum, ends), reduce(np.maximum, ends))

    def sq_(self, a: Box) -> Box:
        size = self.fabs_(a)
        made = self._out(size.low * size.low, size.high * size.high)
        return Box(np.maximum(made.low, self._zero), made.high)

    def inv_(self, a: Box) -> Box:
        """nan where the box contains zero."""
        inside = (a.low <= 0) & (a.high >= 0)
        if self.exact:
            if inside.any():
                raise Unsupported("an exact box divides by what may be zero")
            return Box(1 / a.high, 1 / a.low)
        return _unless(inside, self._out(1.0 / a.high, 1.0 / a.low))

    def fabs_(self, a: Box) -> Box:
        straddles = (a.low < 0) & (a.high > 0)
        low = np.where(straddles, self._zero, np.minimum(abs(a.low), abs(a.high)))
        return Box(low, np.maximum(abs(a.low), abs(a.high)))

    def fmin_(self, a: Box, b: Box) -> Box:
        return Box(np.minimum(a.low, b.low), np.minimum(a.high, b.high))

    def fmax_(self, a: Box, b: Box) -> Box:
        return Box(np.maximum(a.low, b.low), np.maximum(a.high, b.high))

    def sqrt_(self, a: Box) -> Box:
        """nan where the box reaches below zero."""
        if self.exact:
            raise Unsupported("a root is not exact")
        made = self._out(np.sqrt(a.low), np.sqrt(a.high))
        return _unless(a.low < 0, Box(np.maximum(made.low, self._zero), made.high))

    def sign_(self, a: Box) -> Box:
        """1, -1, or 0 at zero."""
        signs = [np.where(x > 0, self._one, np.where(x < 0, -self._one, x * 0)) for x in (a.low, a.high)]
        return Box(*signs)

    def pow_(self, a: Box, b: Box) -> Box:
        """A constant exponent that is whole, or half of a whole number."""
        if b.power is None or b.power.denominator > 2:
            raise Unsupported("the boxes domain knows whole exponents and halves of these only")
        if b.power.denominator == 2:
            a = self.sqrt_(a)
        return self._power(a, b.power.numerator)

    def _power(self, a: Box, n: int) -> Box:
        """0^0 is 1; a negative power is that of the inverse."""
        if n < 0:
            return self._power(self.inv_(a), -n)
        if n == 0:
            one = self.constant(Fraction(1))
            return one if self.exact else _unless(np.isnan(a.low), one)
        half = self._power(a, n // 2)
        return self.sq_(half) if n % 2 == 0 else self.mul_(a, self.sq_(half)) if n > 1 else a

    @property
    def _zero(self) -> Any:
        return Fraction(0) if self.exact else 0.0

    @property
    def _one(self) -> Any:
        return Fraction(1) if self.exact else 1.0

    def _product(self, x: Array, y: Array) -> Array:
        """0 times an unbounded end is 0: the end itself is never taken."""
        made = x * y
        if self.exact:
            return made
        lost = np.isnan(made) & ~np.isnan(x) & ~np.isnan(y)
        return np.where(lost, 0.0, made)

    def _out(self, low: Array, high: Array) -> Box:
        if self.exact:
            return Box(low, high)
        return Box(np.nextafter(low, -np.inf), np.nextafter(high, np.inf))


def rounded(value: Fraction, towards: float) -> float:
    """The closest floating-point number on the side of `towards` (an infinity), or the number itself."""
    try:
        near = float(value)
    except OverflowError:
        near = inf if value > 0 else -inf
    if isinf(near):
        return near if (near > 0) == (towards > 0) else nextafter(near, towards)
    beyond = Fraction(near) < value if towards > 0 else Fraction(near) > value
    return nextafter(near, towards) if beyond else near


def exact_array(values: Sequence[Fraction]) -> Array:
    """An array of fractions."""
    made = np.empty(len(values), dtype=object)
    made[:] = values
    return made


def _one(value: Fraction) -> Array:
    return exact_array([value])


def _ends(box: Box) -> tuple[Array, Array]:
    return box.low, box.high


def _unless(undefined: Array, box: Box) -> Box:
    return Box(np.where(undefined, np.nan, box.low), np.where(undefined, np.nan, box.high))
