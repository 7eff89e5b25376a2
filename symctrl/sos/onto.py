"""Rational points exactly on equations, near a rational point that is not on them.

An equation is met by one of these: solving it for a variable in which it is linear; the nearest rational root
where it has one variable; on a sphere, the second point on a line through a rational point of it
(stereographic projection). They are used one after another; that all equations hold is tested afterwards.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import product
from math import isqrt
from typing import Any

from flint import fmpq_poly

from symctrl.sos.problem import Problem
from symctrl.sos.ring import Poly, to_fraction, value_at

Move = Callable[[list[Fraction]], "list[Fraction] | None"]
_MOST = 24


class Onto:
    """The ways to meet the equations of a problem."""

    def __init__(self, problem: Problem) -> None:
        self.zero = problem.zero
        names = list(problem.names)
        self.moves: list[list[Move]] = []
        for h in problem.zero:
            ways: list[Move] = []
            used = [k for k, e in enumerate(h.degrees()) if e]
            if len(used) == 1:
                ways.append(_root(h, used[0]))
            sphere = _sphere(h, used)
            if sphere is not None and len(used) > 1:
                ways.append(sphere)
            ways += [_linear(h, k, names) for k in used if h.degrees()[k] == 1]
            self.moves.append(ways)

    def points(self, near: tuple[Fraction, ...]) -> Iterator[tuple[Fraction, ...]]:
        """Points on all equations."""
        for count, ways in enumerate(product(*self.moves)):
            if count == _MOST:
                return
            for order in (ways, ways[::-1]) if len(ways) > 1 else (ways,):
                point: list[Fraction] | None = list(near)
                for move in order:
                    point = move(point) if point is not None else None
                if point is not None and all(value_at(h, point) == 0 for h in self.zero):
                    yield tuple(point)


def _linear(h: Poly, k: int, names: list[str]) -> Move:
    slope = h.derivative(names[k])

    def move(point: list[Fraction]) -> list[Fraction] | None:
        base = [*point[:k], Fraction(0), *point[k + 1 :]]
        a = value_at(slope, base)
        if a == 0:
            return None
        base[k] = -value_at(h, base) / a
        return base

    return move


def _root(h: Poly, k: int) -> Move:
    coefficients: list[Any] = [0] * (int(h.degrees()[k]) + 1)
    for m, c in h.to_dict().items():
        coefficients[int(m[k])] = c
    roots = [to_fraction(-f[0] / f[1]) for f, _ in fmpq_poly(coefficients).factor()[1] if f.degree() == 1]

    def move(point: list[Fraction]) -> list[Fraction] | None:
        if not roots:
            return None
        return [*point[:k], min(roots, key=lambda r: abs(r - point[k])), *point[k + 1 :]]

    return move


def _sphere(h: Poly, used: list[int]) -> Move | None:
    """For a (|x - c|^2 - r) with a rational point on it; None where h is something else."""
    table = {tuple(map(int, m)): to_fraction(c) for m, c in h.to_dict().items()}
    n = len(h.context().names())

    def unit(k: int, e: int) -> tuple[int, ...]:
        return tuple(e if j == k else 0 for j in range(n))

    a = table.get(unit(used[0], 2), Fraction(0)) if used else Fraction(0)
    if a == 0 or any(table.get(unit(k, 2)) != a for k in used):
        return None
    if set(table) - {unit(k, e) for k in used for e in (1, 2)} - {(0,) * n}:
        return None
    center = {k: -table.get(unit(k, 1), Fraction(0)) / (2 * a) for k in used}
    r = sum((c * c for c in center.values()), Fraction(0)) - table.get((0,) * n, Fraction(0)) / a
    pole = _on_sphere(r, len(used))
    if pole is None:
        return None
    poles = [[s * v for v in pole] for s in (-1, 1)]

    def move(point: list[Fraction]) -> list[Fraction] | None:
        x = [point[k] - center[k] for k in used]
        # From the pole that is farther away, so that the line is not nearly tangent.
        q = min(poles, key=lambda q: sum(a * b for a, b in zip(q, x, strict=True)))
        d = [a - b for a, b in zip(x, q, strict=True)]
        square = sum((b * b for b in d), Fraction(0))
        if square == 0:
            return None
        t = -2 * sum((a * b for a, b in zip(q, d, strict=True)), Fraction(0)) / square
        result = list(point)
        for k, a_, b in zip(used, q, d, strict=True):
            result[k] = center[k] + a_ + t * b
        return result

    return move


def _on_sphere(r: Fraction, n: int) -> list[Fraction] | None:
    """A rational point with |x|^2 = r."""
    if r < 0:
        return None
    number = r.numerator * r.denominator  # r = number / denominator^2
    found = _squares(number, min(n, 4))
    if found is None:
        return None
    return [Fraction(a, r.denominator) for a in found] + [Fraction(0)] * (n - len(found))


def _squares(number: int, count: int) -> list[int] | None:
    """Integers with this sum of squares, by search; None also where it would take long."""
    top = isqrt(number)
    if top * top == number:
        return [top] + [0] * (count - 1)
    if count == 1 or top > 2000:
        return None
    for a in range(top, max(-1, top - 200), -1):
        rest = _squares(number - a * a, count - 1)
        if rest is not None:
            return [a, *rest]
    return None
