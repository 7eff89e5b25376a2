"""The largest eigenvalue of a symmetric rational matrix, between two rationals, with exact evidence for both.

A floating-point eigenvalue proposes; the upper bound is one because c I - A is positive semidefinite by an
exact certificate, the lower bound because x'Ax >= c x'x for a rational vector.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor, lcm

import numpy as np

from symctrl.decide.definiteness import decide_matrix
from symctrl.decide.direction import null_vector

DIGITS = 6
Rows = Sequence[Sequence[Fraction | int]]


@dataclass(frozen=True)
class LargestEigenvalue:
    """low <= largest eigenvalue <= high, equal where it is an integer; vector: rational, x'Ax >= low x'x."""

    low: Fraction
    high: Fraction
    vector: tuple[Fraction, ...]


def largest_eigenvalue(rows: Rows) -> LargestEigenvalue:
    """Bounds of the largest eigenvalue, some 2e-6 apart. Raises ValueError for a matrix not symmetric."""
    exact = [[Fraction(entry) for entry in row] for row in rows]
    if exact != [list(column) for column in zip(*exact, strict=True)]:
        raise ValueError("the largest eigenvalue is that of a symmetric matrix; this one is not symmetric")
    values, vectors = np.linalg.eigh(np.array([[float(entry) for entry in row] for row in exact]))
    found = _integer(exact, round(float(values[-1])))
    return found or _bracket(exact, float(values[-1]), vectors[:, -1])


def _integer(rows: list[list[Fraction]], value: int) -> LargestEigenvalue | None:
    """The bounds, if the integer is the largest eigenvalue."""
    rest = shifted(rows, Fraction(value))
    answer = decide_matrix(rest)
    if answer.definiteness != "positive semidefinite":
        return None
    vector = tuple(null_vector(rest))
    return LargestEigenvalue(Fraction(value), Fraction(value), vector)


def _bracket(rows: list[list[Fraction]], value: float, vector: np.ndarray) -> LargestEigenvalue:
    scale = 10**DIGITS
    x = [Fraction(round(entry * 10**4)) for entry in (vector / np.abs(vector).max()).tolist()]
    product = [sum((a * b for a, b in zip(row, x, strict=True)), Fraction(0)) for row in rows]
    quotient = sum((a * b for a, b in zip(x, product, strict=True)), Fraction(0)) / sum(e * e for e in x)
    high = Fraction(ceil(value * scale), scale)
    while decide_matrix(shifted(rows, high)).definiteness == "not positive semidefinite":
        high += Fraction(1, scale)
    return LargestEigenvalue(Fraction(floor(quotient * scale), scale), high, tuple(x))


def shifted(rows: Rows, c: Fraction) -> list[list[Fraction]]:
    """c I - A."""
    return [
        [(c if r == k else Fraction(0)) - entry for k, entry in enumerate(row)] for r, row in enumerate(rows)
    ]


def integers(x: Sequence[Fraction]) -> tuple[int, ...]:
    """A multiple of x in integers."""
    common = lcm(*(a.denominator for a in x))
    return tuple(a.numerator * (common // a.denominator) for a in x)
