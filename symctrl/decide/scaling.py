"""A rational symmetric matrix beside its image in floating point, scaled to a unit diagonal."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import lcm
from typing import Any

import numpy as np

# A scaled entry of a semidefinite matrix is below 2; beyond this the size no longer matters.
_CAP = 2.0**40


@dataclass(frozen=True)
class Symmetric:
    """A symmetric n x n matrix over Q, all of whose diagonal entries are positive."""

    rows: Sequence[Sequence[Fraction]]

    @property
    def size(self) -> int:
        return len(self.rows)

    @cached_property
    def integers(self) -> list[list[int]]:
        """The matrix times `denominator`, which is positive: it has the same sign on every vector."""
        d = self.denominator
        return [[a.numerator * (d // a.denominator) for a in row] for row in self.rows]

    @cached_property
    def denominator(self) -> int:
        return lcm(*{a.denominator for row in self.rows for a in row})

    @cached_property
    def exponents(self) -> list[int]:
        """e with 1/2 < 4^e[i] a[i,i] < 8: by 2^e rows and columns are scaled, which is exact at any size."""
        return [-((_log2(self.rows[i][i])) // 2) for i in range(self.size)]

    @cached_property
    def floats(self) -> Any:
        """2^(e[i]+e[j]) a[i,j] rounded to doubles: an array of shape (n, n)."""
        e, n = self.exponents, self.size
        result = np.empty((n, n))
        for i, row in enumerate(self.rows):
            for j in range(i + 1):
                result[i, j] = result[j, i] = shifted(row[j], e[i] + e[j])
        return result


def _log2(a: Fraction) -> int:
    """The binary logarithm of a > 0, to within one."""
    return a.numerator.bit_length() - a.denominator.bit_length()


def shifted(a: Fraction, shift: int) -> float:
    """2^shift a as a double, cut off at a size that no scaled semidefinite matrix has."""
    p, q = a.numerator, a.denominator
    if p.bit_length() - q.bit_length() + shift > 40:
        return _CAP if p > 0 else -_CAP
    return p / (q << -shift) if shift < 0 else (p << shift) / q
