"""Short rational vectors on which a quadratic form is negative, or zero where the matrix is singular.

Floats propose a direction; every vector that leaves this module has been put into the form exactly.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from math import gcd, lcm
from operator import mul
from typing import Any

import numpy as np
from flint import fmpq, fmpq_mat

from symctrl.decide.scaling import Symmetric

_BITS = (0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48)
_LONG_BITS = (*_BITS, 64, 96, 128, 192, 256, 512, 1024)


def form(integers: Sequence[Sequence[int]], x: Sequence[int]) -> int:
    """x'Ax in integers."""
    support = [k for k, value in enumerate(x) if value]
    values = [x[k] for k in support]
    if len(support) == len(x):
        return sum(value * sum(map(mul, integers[k], x)) for k, value in zip(support, values, strict=True))
    return sum(
        value * sum(integers[k][j] * other for j, other in zip(support, values, strict=True))
        for k, value in zip(support, values, strict=True)
    )


def from_pair(matrix: Symmetric) -> list[Fraction] | None:
    """A negative vector with two entries, where a 2 x 2 principal minor is negative by a clear amount."""
    b = matrix.floats
    slack = b * b - np.outer(np.diag(b), np.diag(b))
    i, j = divmod(int(np.argmax(slack)), matrix.size)
    if i == j or slack[i, j] <= 1e-12:
        return None
    a = matrix.rows
    sign = 1 if a[i][j] < 0 else -1
    best = -a[i][j] / a[j][j]
    for t in (Fraction(sign), *_roundings(best), best):
        if a[i][i] + 2 * t * a[i][j] + t * t * a[j][j] < 0:
            x = [Fraction(0)] * matrix.size
            x[i], x[j] = Fraction(1), t
            return _primitive(x)
    return None


def from_eigenvector(matrix: Symmetric, vector: Any) -> list[Fraction] | None:
    """A negative vector close to a float eigenvector of `matrix.floats`, shape (n,); None: not found."""
    exact = [Fraction(float(v)) * Fraction(2) ** e for v, e in zip(vector, matrix.exponents, strict=True)]
    return _first(matrix, exact, _BITS)


def shortened(matrix: Symmetric, x: Sequence[Fraction]) -> list[Fraction]:
    """A shorter vector near x on which the form is negative still; x itself is one."""
    return _first(matrix, x, _LONG_BITS) or _primitive(x)


def _first(matrix: Symmetric, x: Sequence[Fraction], bits: Iterable[int]) -> list[Fraction] | None:
    return next((y for y in _candidates(matrix, x, bits) if form(matrix.integers, _cleared(y)) < 0), None)


def _candidates(matrix: Symmetric, x: Sequence[Fraction], bits: Iterable[int]) -> Iterator[list[Fraction]]:
    """x rounded ever finer, relative to its largest entry as it stands and as the matrix is scaled.

    What is clearly positive in floating point is left out: it would cost an exact evaluation.
    """
    units = [[Fraction(1)] * len(x)]
    if any(matrix.exponents):
        units.append([Fraction(2) ** e for e in matrix.exponents])
    for b in bits:
        for unit in units:
            ratios = [a / u for a, u in zip(x, unit, strict=True)]
            top = max(map(abs, ratios)) / 2**b
            y = [round(r / top) * u for r, u in zip(ratios, unit, strict=True)]
            if any(y) and not _clearly_positive(matrix, y):
                yield _primitive(y)


def _clearly_positive(matrix: Symmetric, y: Sequence[Fraction]) -> bool:
    scaled = [a * Fraction(2) ** -e for a, e in zip(y, matrix.exponents, strict=True)]
    top = max(map(abs, scaled))
    v = np.array([float(a / top) for a in scaled])
    return bool(v @ matrix.floats @ v > 1e-9 * len(y))


def _roundings(value: Fraction) -> list[Fraction]:
    return [value.limit_denominator(10**k) for k in (0, 1, 2, 4, 8)]


def _cleared(x: Sequence[Fraction]) -> list[int]:
    d = lcm(*{a.denominator for a in x})
    return [a.numerator * (d // a.denominator) for a in x]


def _primitive(x: Sequence[Fraction]) -> list[Fraction]:
    """The same direction in integers without a common factor."""
    cleared = _cleared(x)
    common = gcd(*cleared)
    return [Fraction(a // common) for a in cleared]


def null_vector(rows: Sequence[Sequence[Fraction]]) -> list[Fraction]:
    """A nonzero vector that the singular matrix takes to zero."""
    n = len(rows)
    entries = [fmpq(entry.numerator, entry.denominator) for row in rows for entry in row]
    reduced, rank = fmpq_mat(n, n, entries).rref()
    pivots = [next(c for c in range(n) if reduced[r, c] != 0) for r in range(rank)]
    free = next(c for c in range(n) if c not in pivots)
    x = [Fraction(0)] * n
    x[free] = Fraction(1)
    for r, c in enumerate(pivots):
        entry = reduced[r, free]
        x[c] = -Fraction(int(entry.p), int(entry.q))
    return x
