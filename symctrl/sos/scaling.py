"""A problem in better variables: x = c + w t, so that the set or the interesting points are near [-1, 1].

The substitution is exact, and the squares of an answer are substituted back. A box is read off the
constraints; without one, powers of two make the coefficients of like size.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from math import isqrt, lcm
from typing import Any

import numpy as np

from symctrl.sos.problem import Problem
from symctrl.sos.proof import Part, Proof
from symctrl.sos.ring import Poly, denominator, terms, to_fmpq


@dataclass(frozen=True)
class Scaled:
    """`problem` is in the variables t. centers c, widths w > 0."""

    problem: Problem
    centers: tuple[Fraction, ...]
    widths: tuple[Fraction, ...]

    @property
    def same(self) -> bool:
        return all(c == 0 for c in self.centers) and all(w == 1 for w in self.widths)

    def back(self, proof: Proof) -> Proof:
        """The proof in x."""
        if self.same:
            return proof
        gens = self.problem.ring.gens()
        inner = [
            (x - to_fmpq(c)) * to_fmpq(1 / w) for x, c, w in zip(gens, self.centers, self.widths, strict=True)
        ]

        def of(part: Part) -> Part:
            basis = [b.compose(*inner) for b in part.basis]
            unit = lcm(*map(denominator, basis))
            return replace(part, basis=tuple(b * unit for b in basis), denominator=part.denominator * unit**2)

        return replace(
            proof,
            parts=tuple(map(of, proof.parts)),
            multiplier=tuple(map(of, proof.multiplier)),
            multiples=tuple(c.compose(*inner) for c in proof.multiples),
        )


def scaled(problem: Problem) -> Scaled:
    """The problem in better variables."""
    n = len(problem.names)
    if problem.everywhere or problem.zero:
        centers = [Fraction(0)] * n
        widths = _balance(problem.polynomial) if problem.everywhere else [Fraction(1)] * n
    else:
        centers, widths = _box(problem)
    if all(c == 0 for c in centers) and all(w == 1 for w in widths):
        return Scaled(problem, tuple(centers), tuple(widths))
    inner = [
        to_fmpq(c) + x * to_fmpq(w) for x, c, w in zip(problem.ring.gens(), centers, widths, strict=True)
    ]

    def of(p: Poly) -> Poly:
        return p.compose(*inner)

    better = replace(
        problem,
        polynomial=of(problem.polynomial),
        nonnegative=tuple(map(of, problem.nonnegative)),
        zero=tuple(map(of, problem.zero)),
    )
    return Scaled(better, tuple(centers), tuple(widths))


def _balance(p: Poly) -> list[Fraction]:
    """Powers of two after which the coefficients are as equal as they can be, by least squares."""
    table = {m: c for m, c in terms(p).items() if any(m)}
    n = len(p.context().names())
    if len(table) < 2:
        return [Fraction(1)] * n
    logs = np.array(
        [c.numerator.bit_length() - c.denominator.bit_length() for c in table.values()], dtype=float
    )
    if logs.max() - logs.min() < 8:
        return [Fraction(1)] * n
    matrix = np.hstack([np.array(list(table), dtype=float), np.ones((len(table), 1))])
    best = np.linalg.lstsq(matrix, -logs, rcond=None)[0][:n]
    steps = [int(np.clip(round(float(s)), -200, 200)) for s in best]
    return [Fraction(2) ** s for s in steps]


def _box(problem: Problem) -> tuple[list[Fraction], list[Fraction]]:
    """Centers and half widths where constraints bound a variable on both sides; 0 and 1 elsewhere."""
    n = len(problem.names)
    lows: list[Fraction | None] = [None] * n
    highs: list[Fraction | None] = [None] * n

    def narrow(k: int, low: Fraction | None, high: Fraction | None) -> None:
        a, b = lows[k], highs[k]
        if low is not None and (a is None or low > a):
            lows[k] = low
        if high is not None and (b is None or high < b):
            highs[k] = high

    for g in problem.nonnegative:
        for k, low, high in _bounds(terms(g), n):
            narrow(k, low, high)
    centers, widths = [Fraction(0)] * n, [Fraction(1)] * n
    for k, (a, b) in enumerate(zip(lows, highs, strict=True)):
        if a is not None and b is not None and a < b:
            centers[k], widths[k] = (a + b) / 2, (b - a) / 2
        elif a is not None and b is None:
            centers[k] = a
        elif b is not None and a is None:
            centers[k] = b
        if abs(centers[k]) < 2 * widths[k] and b is not None and a is not None and abs(a + b) * 8 < b - a:
            centers[k] = Fraction(0)
    return centers, widths


def _bounds(table: dict[Any, Fraction], n: int) -> list[tuple[int, Fraction | None, Fraction | None]]:
    """Bounds that follow from g >= 0: g linear in one variable, or concave, quadratic and diagonal."""
    used = sorted({k for m in table for k, e in enumerate(m) if e})
    if len(used) == 1 and max(m[used[0]] for m in table) == 1:
        k = used[0]
        slope = next(c for m, c in table.items() if m[k])
        root = -next((c for m, c in table.items() if not m[k]), Fraction(0)) / slope
        return [(k, root, None) if slope > 0 else (k, None, root)]
    squares: dict[int, list[Fraction]] = {k: [Fraction(0), Fraction(0)] for k in used}
    constant = Fraction(0)
    for m, c in table.items():
        own = [k for k in used if m[k]]
        if not own:
            constant = c
        elif len(own) > 1 or m[own[0]] > 2:
            return []
        else:
            squares[own[0]][2 - m[own[0]]] = c
    if any(a >= 0 for a, _ in squares.values()):
        return []
    # constant + sum of a (x + b/2a)^2 - b^2/4a >= 0
    top = constant + sum((-b * b / (4 * a) for a, b in squares.values()), Fraction(0))
    if top <= 0:
        return []
    result: list[tuple[int, Fraction | None, Fraction | None]] = []
    for k, (a, b) in squares.items():
        center, r2 = -b / (2 * a), -top / a
        radius = Fraction(isqrt(int(r2 * 2**40)) + 1, 2**20)
        exact = Fraction(isqrt(r2.numerator), isqrt(r2.denominator))
        radius = exact if exact**2 == r2 else radius
        result.append((k, center - radius, center + radius))
    return result
