"""Stationary points to many digits: Newton's method on the gradient, in rational arithmetic that is cut off.

Where a polynomial is negative by 1e-40 at a minimum with irrational coordinates, doubles do not come close
enough to it. The polynomial is flat there, so that half the digits suffice.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from flint import arb, arb_mat

from symctrl.sos.ring import Poly
from symctrl.sos.univariate import precision

_DIGITS = 400
_STEPS = 14


def stationary(p: Poly, start: Any) -> Iterator[tuple[Fraction, ...]]:
    """Rational points ever nearer to a point where the gradient of p vanishes, if start is close to one."""
    over = p.context()
    names = over.names()
    used = [k for k, e in enumerate(p.degrees()) if e]
    gradient = [p.derivative(names[k]) for k in used]
    hessian = [[g.derivative(names[k]) for k in used] for g in gradient]
    x = [Fraction(float(a)) for a in start]
    bits = 60
    for _ in range(_STEPS):
        bits = min(2 * bits, int(_DIGITS * 3.3))
        try:
            with precision(2 * bits):
                point = [arb(a.numerator) / a.denominator for a in x]
                right = arb_mat(len(used), 1, [_at(g, point) for g in gradient])
                matrix = arb_mat(len(used), len(used), [_at(h, point) for row in hessian for h in row])
                step = [float_free(s, bits) for s in matrix.solve(right).entries()]
        except (ZeroDivisionError, ValueError):
            return
        for k, s in zip(used, step, strict=True):
            x[k] = _cut(x[k] - s, bits)
        yield tuple(x)


def _at(p: Poly, point: list[Any]) -> Any:
    total = arb(0)
    for m, c in p.to_dict().items():
        term = arb(c)
        for x, e in zip(point, m, strict=True):
            if e:
                term *= x ** int(e)
        total += term
    return total.mid()


def float_free(x: Any, bits: int) -> Fraction:
    """The midpoint of a ball, to so many bits."""
    man, exp = x.mid().man_exp()
    return _cut(Fraction(int(man)) * Fraction(2) ** int(exp), bits)


def _cut(a: Fraction, bits: int) -> Fraction:
    return Fraction(round(a * (1 << bits)), 1 << bits)
