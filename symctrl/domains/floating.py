"""Float64 values, vectorised over samples: the second, numeric evidence beside an exact verdict.

The domain remembers the largest magnitude it met, because a residual means something only relative to it:
near a singularity large terms cancel, and the residual relative to the result says nothing.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symctrl.domains.domain import Domain

Samples = NDArray[np.float64]


def _recorded(function: Callable[..., Any]) -> Callable[..., Any]:
    def evaluate(self: FloatDomain, *args: Samples) -> Samples:
        with np.errstate(all="ignore"):
            result = np.asarray(function(*args), dtype=np.float64)
        self.observe(*args, result)
        return result

    return evaluate


def _erf(a: Samples) -> Any:
    from scipy.special import erf

    return erf(a)


def _erfinv(a: Samples) -> Any:
    from scipy.special import erfinv

    return erfinv(a)


def _remainder(a: float, b: float) -> float:
    """The IEEE remainder, which numpy lacks; Python's raises where IEEE gives nan."""
    return math.remainder(a, b) if math.isfinite(a) and b and not math.isnan(b) else math.nan


class FloatDomain(Domain[Samples]):
    """Values are float64 arrays that broadcast against each other: one entry per sample, or a scalar.

    `largest` is, per sample, the largest finite magnitude among all arguments and results so far. Undefined
    operations give nan or inf as in IEEE arithmetic, without a warning, since a branch that is not taken may
    be undefined.
    """

    name = "float"

    def __init__(self) -> None:
        self.largest: Samples = np.zeros(())

    def observe(self, *values: Samples) -> None:
        """Count the values among those that `largest` is taken over."""
        for value in values:
            self.largest = np.maximum(self.largest, np.where(np.isfinite(value), np.abs(value), 0.0))

    def constant(self, value: Fraction) -> Samples:
        return np.asarray(float(value))

    add_ = _recorded(np.add)
    sub_ = _recorded(np.subtract)
    mul_ = _recorded(np.multiply)
    div_ = _recorded(np.divide)
    neg_ = _recorded(np.negative)
    inv_ = _recorded(lambda a: np.divide(1.0, a))
    sq_ = _recorded(np.square)
    twice_ = _recorded(lambda a: np.multiply(2.0, a))
    sqrt_ = _recorded(np.sqrt)
    pow_ = _recorded(lambda a, b: np.power(np.asarray(a, dtype=np.float64), b))
    exp_ = _recorded(np.exp)
    expm1_ = _recorded(np.expm1)
    log_ = _recorded(np.log)
    log1p_ = _recorded(np.log1p)
    sin_ = _recorded(np.sin)
    cos_ = _recorded(np.cos)
    tan_ = _recorded(np.tan)
    asin_ = _recorded(np.arcsin)
    acos_ = _recorded(np.arccos)
    atan_ = _recorded(np.arctan)
    atan2_ = _recorded(np.arctan2)
    sinh_ = _recorded(np.sinh)
    cosh_ = _recorded(np.cosh)
    tanh_ = _recorded(np.tanh)
    asinh_ = _recorded(np.arcsinh)
    acosh_ = _recorded(np.arccosh)
    atanh_ = _recorded(np.arctanh)
    erf_ = _recorded(_erf)
    erfinv_ = _recorded(_erfinv)
    hypot_ = _recorded(np.hypot)
    fabs_ = _recorded(np.abs)
    sign_ = _recorded(np.sign)
    floor_ = _recorded(np.floor)
    ceil_ = _recorded(np.ceil)
    fmin_ = _recorded(np.fmin)
    fmax_ = _recorded(np.fmax)
    fmod_ = _recorded(np.fmod)
    remainder_ = _recorded(np.vectorize(_remainder, otypes=[np.float64]))
    copysign_ = _recorded(np.copysign)
    lt_ = _recorded(np.less)
    le_ = _recorded(np.less_equal)
    eq_ = _recorded(np.equal)
    ne_ = _recorded(np.not_equal)
    and_ = _recorded(np.logical_and)
    or_ = _recorded(np.logical_or)
    not_ = _recorded(np.logical_not)
    if_else_zero_ = _recorded(lambda a, b: np.where(np.not_equal(a, 0.0), b, 0.0))
