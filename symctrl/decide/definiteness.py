"""Whether a rational symmetric matrix is positive definite, semidefinite or neither, with exact evidence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal

import numpy as np
from flint import fmpz_mat

from symctrl.decide.direction import from_eigenvector, from_pair, shortened
from symctrl.decide.dominance import dominate
from symctrl.decide.ldl import factor
from symctrl.decide.scaling import Symmetric

Name = Literal["positive definite", "positive semidefinite", "not positive semidefinite"]
DEFINITE: Name = "positive definite"
SEMIDEFINITE: Name = "positive semidefinite"
INDEFINITE: Name = "not positive semidefinite"

# Up to this size the exact factors are as quick to find as a float proposal, and as short.
_SMALL = 10
# Relative to the size, an eigenvalue of a unit-diagonal matrix that doubles can tell from zero.
_CLEAR = 1e-12
_LONGEST = 13_000  # bits of a number in a certificate: 3913 digits


@dataclass(frozen=True)
class Definiteness:
    """The answer for A of shape (n, n), with its evidence.

    witness: x with x'Ax < 0 where A is not positive semidefinite. leaf: otherwise a leaf proof of
    docs/certificates.md, `ldl` or `dominant`, with numbers as strings "p/q"; None where its numbers are
    longer than a certificate may hold. rank: exact.
    """

    definiteness: Name
    rank: int
    witness: tuple[Fraction, ...] | None = None
    leaf: Mapping[str, Any] | None = None


def decide_matrix(rows: Sequence[Sequence[Fraction]]) -> Definiteness:
    """Decides the definiteness of the symmetric matrix with these rows.

    Raises ValueError where the rows are not those of a symmetric matrix with at least one row.
    """
    _check(rows)
    n = len(rows)
    witness = _from_diagonal(rows)
    if witness is not None:
        return _indefinite(rows, witness)
    kept = [i for i, row in enumerate(rows) if row[i]]
    if not kept:
        return _definite(
            n, 0, {"ldl": {"lower": _spread_rows([], [], n, Fraction(1)), "diagonal": ["0"] * n}}
        )
    inner = Symmetric([[rows[i][j] for j in kept] for i in kept] if len(kept) < n else rows)
    return _decide_inner(rows, kept, inner)


def _decide_inner(rows: Sequence[Sequence[Fraction]], kept: list[int], inner: Symmetric) -> Definiteness:
    """Floats first where the matrix is large or clearly not semidefinite; exact factors settle the rest."""
    n = len(rows)
    smallest, vector = _smallest(inner)
    clear = _CLEAR * inner.size
    if smallest < -clear:
        x = from_pair(inner) or from_eigenvector(inner, vector)
        if x is not None:
            return _indefinite(rows, _spread(x, kept, n))
    if smallest > clear and inner.size > _SMALL:
        found = dominate(inner, smallest)
        if found is not None:
            scale = ["1"] * n
            for i, s in zip(kept, found.scale, strict=True):
                scale[i] = str(s)
            lower = _spread_rows(found.lower, kept, n, Fraction(0))
            return _definite(n, inner.size, {"dominant": {"lower": lower, "scale": scale}})
    factors = factor(inner.integers, inner.denominator)
    if isinstance(factors, list):
        return _indefinite(rows, _spread(shortened(inner, factors), kept, n))
    if any(_long(a) for row in (*factors.lower, factors.diagonal) for a in row):
        return _definite(n, factors.rank, None)
    diagonal = [str(d) for d in _spread(factors.diagonal, kept, n)]
    lower = _spread_rows(factors.lower, kept, n, Fraction(1))
    return _definite(n, factors.rank, {"ldl": {"lower": lower, "diagonal": diagonal}})


def _check(rows: Sequence[Sequence[Fraction]]) -> None:
    n = len(rows)
    if n == 0:
        raise ValueError("a matrix must have at least one row, instead got none")
    for i, row in enumerate(rows):
        if len(row) != n:
            raise ValueError(
                f"a matrix with {n} rows must have {n} entries a row, row {i + 1} has {len(row)}"
            )
        for j in range(i):
            if row[j] != rows[j][i]:
                raise ValueError(
                    f"the matrix must be symmetric, but entry ({i + 1}, {j + 1}) is {row[j]} "
                    f"and entry ({j + 1}, {i + 1}) is {rows[j][i]}"
                )


def _from_diagonal(rows: Sequence[Sequence[Fraction]]) -> list[Fraction] | None:
    """A negative vector where a diagonal entry is negative, or zero in a row that is not."""
    n = len(rows)
    for i, row in enumerate(rows):
        if row[i] < 0:
            return [Fraction(int(k == i)) for k in range(n)]
    for i, row in enumerate(rows):
        j = next((j for j in range(n) if row[j]), None) if row[i] == 0 else None
        if j is not None:
            x = [Fraction(0)] * n
            x[j] = Fraction(1)
            x[i] = Fraction(-(rows[j][j] // (2 * abs(row[j])) + 1) * (1 if row[j] > 0 else -1))
            return x
    return None


def _smallest(matrix: Symmetric) -> tuple[float, Any]:
    """The float eigenvalue that is least, and its vector of shape (n,)."""
    try:
        values, vectors = np.linalg.eigh(matrix.floats)
    except np.linalg.LinAlgError:
        return 0.0, np.zeros(matrix.size)
    return float(values[0]), vectors[:, 0]


def _definite(n: int, rank: int, leaf: Mapping[str, Any] | None) -> Definiteness:
    return Definiteness(DEFINITE if rank == n else SEMIDEFINITE, rank, leaf=leaf)


def _indefinite(rows: Sequence[Sequence[Fraction]], x: Sequence[Fraction]) -> Definiteness:
    integers = Symmetric(rows).integers
    return Definiteness(INDEFINITE, int(fmpz_mat(integers).rank()), witness=tuple(x))


def _long(a: Fraction) -> bool:
    return max(a.numerator.bit_length(), a.denominator.bit_length()) > _LONGEST


def _spread(x: Sequence[Fraction], kept: Sequence[int], n: int) -> list[Fraction]:
    """x with a zero at every index that is not kept."""
    result = [Fraction(0)] * n
    for i, value in zip(kept, x, strict=True):
        result[i] = value
    return result


def _spread_rows(
    lower: Sequence[Sequence[Fraction]], kept: Sequence[int], n: int, diagonal: Fraction
) -> list[list[str]]:
    """The rows of a lower triangle, as text, with `diagonal` alone in the rows that are not kept."""
    result = [["0"] * i + [str(diagonal)] for i in range(n)]
    for i, row in zip(kept, lower, strict=True):
        for j, value in zip(kept, row, strict=False):
            result[i][j] = str(value)
    return result
