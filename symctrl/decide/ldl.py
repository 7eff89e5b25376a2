"""Exact LDL^T of a symmetric integer matrix, fraction-free.

Bareiss elimination keeps the Schur complements as integers: after pivots p_1, .., p_k the stored entry is the
complement times p_k (a minor of the matrix, by Sylvester's identity), so that each division is exact. A
semidefinite matrix needs no pivoting: a zero pivot there has a zero column (Higham, Accuracy and Stability of
Numerical Algorithms, section 10.3).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import fmpz

# Below this size Python's integers are as fast as FLINT's and need no conversion.
_SMALL = 16


@dataclass(frozen=True)
class Factors:
    """A = L D L^T: `lower` has the rows of the unit lower triangular L up to the diagonal; D >= 0."""

    lower: list[list[Fraction]]
    diagonal: list[Fraction]

    @property
    def rank(self) -> int:
        return sum(d != 0 for d in self.diagonal)


def factor(integers: Sequence[Sequence[int]], denominator: int = 1) -> Factors | list[Fraction]:
    """The factors of A = integers/denominator where A is positive semidefinite, else x with x'Ax < 0."""
    n = len(integers)
    work: list[list[Any]] = [list(row[: i + 1]) for i, row in enumerate(integers)]
    if n > _SMALL:
        work = [[fmpz(a) for a in row] for row in work]
    pivots: list[int] = [0] * n
    previous: Any = 1
    for k in range(n):
        pivot = work[k][k]
        if pivot < 0:
            return _solve(work, pivots, k, {k: Fraction(1)})
        if pivot == 0:
            coupled = next((i for i in range(k + 1, n) if work[i][k] != 0), None)
            if coupled is None:
                continue
            return _solve(
                work, pivots, k, _saddle(int(work[coupled][k]), int(work[coupled][coupled]), k, coupled)
            )
        pivots[k] = int(pivot)
        _eliminate(work, k, pivot, previous)
        previous = pivot
    return _factors(work, pivots, denominator)


def _eliminate(work: list[list[Any]], k: int, pivot: Any, previous: Any) -> None:
    """One Bareiss step on the lower triangle; column k is kept, it is column k of L times the pivot."""
    column = [row[k] for row in work[k + 1 :]]
    for row in work[k + 1 :]:
        c = row[k]
        if c:
            row[k + 1 :] = [
                (pivot * a - c * b) // previous for a, b in zip(row[k + 1 :], column, strict=False)
            ]
        elif pivot != previous:
            row[k + 1 :] = [pivot * a // previous for a in row[k + 1 :]]


def _saddle(c: int, d: int, k: int, i: int) -> dict[int, Fraction]:
    """y with y'Sy = -1 for the part [[0, c], [c, d]] of the complement in rows k and i."""
    return {k: Fraction(-(d + 1), 2 * c), i: Fraction(1)}


def _solve(work: list[list[Any]], pivots: list[int], k: int, tail: dict[int, Fraction]) -> list[Fraction]:
    """x with (L^T x)_j = 0 for j < k, and `tail` after: x'Ax is the complement's value at `tail`."""
    x = [Fraction(0)] * len(work)
    for j, value in tail.items():
        x[j] = value
    for j in range(k - 1, -1, -1):
        if pivots[j]:
            total = sum((int(work[i][j]) * x[i] for i in range(j + 1, len(work)) if x[i]), Fraction(0))
            x[j] = -total / pivots[j]
    return x


def _factors(work: list[list[Any]], pivots: list[int], denominator: int) -> Factors:
    n = len(work)
    lower = [
        [Fraction(int(work[i][j]), pivots[j]) if pivots[j] else Fraction(0) for j in range(i)] + [Fraction(1)]
        for i in range(n)
    ]
    diagonal, previous = [], 1
    for pivot in pivots:
        diagonal.append(Fraction(pivot, previous * denominator))
        previous = pivot or previous
    return Factors(lower, diagonal)
