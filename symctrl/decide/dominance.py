"""A - L L^T diagonally dominant: definiteness of larger matrices from a rounded float Cholesky factor.

Theorem (Gershgorin): a symmetric R with t_i R_ii >= sum over j != i of t_j |R_ij|, all t_i > 0, is positive
semidefinite, and definite where every inequality is strict. Then A = L L^T + R is too, whatever L is, so that
L may be short dyadic numbers (the idea of Rump, Verification of positive definiteness, BIT 46, 2006, who
bounds the remainder in floating point).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import ceil, log2
from typing import Any

import numpy as np
from flint import fmpz_mat

from symctrl.decide.scaling import Symmetric


@dataclass(frozen=True)
class Dominance:
    """`lower`: the rows of L up to the diagonal; A - L L^T is strictly dominant with `scale`."""

    lower: list[list[Fraction]]
    scale: list[Fraction]


def dominate(matrix: Symmetric, smallest: float) -> Dominance | None:
    """A strictly dominant remainder; `smallest` is the float eigenvalue of `matrix.floats`. None: not found.

    Rounding L to b bits costs about sqrt(n) 2^-b a row; half the smallest eigenvalue pays for it.
    """
    n = matrix.size
    try:
        factor = np.linalg.cholesky(matrix.floats - smallest / 2 * np.eye(n))
    except np.linalg.LinAlgError:
        return None
    first = max(4, ceil(log2(n / smallest)) + 1)
    for bits in (first, first + 4, first + 12):
        if bits <= 52:
            rounded = np.rint(np.ldexp(factor, bits)).astype(np.int64).tolist()
            if _dominant(matrix, rounded, bits):
                return _result(matrix, rounded, bits)
    return None


def _dominant(matrix: Symmetric, rounded: list[list[int]], bits: int) -> bool:
    """Exactly: 4^bits S A S - N N^T is strictly dominant, S = diag(2^exponents)."""
    n, e = matrix.size, matrix.exponents
    factor = fmpz_mat(rounded)
    product: list[list[Any]] = (factor * factor.transpose()).tolist()
    low = 2 * min(*e, 0)
    unit = matrix.denominator << -low
    for i, row in enumerate(matrix.integers):
        remainder = [
            (a << (2 * bits + e[i] + e[j] - low)) - unit * int(p)
            for j, (a, p) in enumerate(zip(row, product[i], strict=True))
        ]
        if remainder[i] <= 0 or 2 * remainder[i] <= sum(map(abs, remainder)):
            return False
    return n > 0


def _result(matrix: Symmetric, rounded: list[list[int]], bits: int) -> Dominance:
    units = [Fraction(2) ** -(bits + e) for e in matrix.exponents]
    lower = [
        [a * unit for a in row[: i + 1]] for i, (row, unit) in enumerate(zip(rounded, units, strict=True))
    ]
    return Dominance(lower, [Fraction(2) ** e for e in matrix.exponents])
