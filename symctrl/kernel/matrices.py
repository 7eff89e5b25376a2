"""Exact definiteness of rational symmetric matrices: elimination, and diagonal dominance of a remainder.

Soundness-critical. Last reviewed 2026-11-24.

Theorem (LDL'): a symmetric A = L D L' with unit lower triangular L is positive semidefinite exactly where
D >= 0, and definite exactly where D > 0 (Sylvester's law of inertia). Elimination without pivoting finds
these factors of a semidefinite matrix: a zero pivot there has a zero column. It is carried out on
integers: after each step the stored entry is the Schur complement times the last pivot, a minor of A, so
that every division is exact (Bareiss 1968).

Theorem (dominance): a symmetric R with t_i R_ii >= sum over j != i of t_j |R_ij| for all i, with all t_i
> 0, is positive semidefinite, and definite where all the inequalities are strict (Gershgorin, after
scaling by t). Then A = L L' + R is too, whatever L is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from operator import mul

from symctrl.kernel.certificate import Declined, Invalid

Rows = Sequence[Sequence[Fraction]]
MAX_WORK = 10**11  # rows cubed times the bits of the largest minor


@dataclass(frozen=True, slots=True)
class Elimination:
    """Pivot k is zero where its column is; else column k of L, below it, is `columns[k]` over `pivots[k]`."""

    pivots: list[int]
    columns: list[list[int]]
    denominator: int

    @property
    def definite(self) -> bool:
        return all(self.pivots)


def require_symmetric(rows: Rows) -> None:
    """Raises Invalid for rows that are not those of a symmetric matrix."""
    if any(len(row) != len(rows) for row in rows):
        raise Invalid("the matrix is not square")
    for i, row in enumerate(rows):
        for j in range(i):
            if row[j] != rows[j][i]:
                raise Invalid(f"the matrix is not symmetric in row {i + 1}, column {j + 1}")


def eliminate(rows: Rows) -> Elimination | None:
    """The factors of a symmetric matrix; None where it is not semidefinite. Raises Invalid, Declined."""
    require_symmetric(rows)
    d, work = _integers(rows)
    n = len(work)
    bits = max(abs(a) for row in work for a in row).bit_length()
    if n**4 * (bits + n.bit_length()) > MAX_WORK:
        raise Declined(f"exact elimination of {n} rows with numbers of {bits} bits is too much work")
    pivots: list[int] = []
    columns: list[list[int]] = []
    last = 1
    while work:
        column = [row[0] for row in work]
        pivot = column[0]
        if pivot < 0 or (pivot == 0 and any(column)):
            return None
        work = [row[1:] for row in work[1:]]
        if pivot:
            for i, (row, c) in enumerate(zip(work, column[1:], strict=True)):
                row[: i + 1] = [
                    (pivot * a - c * b) // last for a, b in zip(row[: i + 1], column[1:], strict=False)
                ]
            last = pivot
        pivots.append(pivot)
        columns.append(column[1:])
    return Elimination(pivots, columns, d)


def has_factors(rows: Rows, lower: Rows, diagonal: Sequence[Fraction]) -> bool:
    """Is A = L D L' with D >= 0, `lower` being the rows of the unit lower triangular L up to the diagonal?

    Where D_k is not zero, column k of L is the only one that can be; where it is zero, it does not matter.
    """
    found = eliminate(rows)
    if found is None or any(row[-1] != 1 for row in lower):
        return False
    last = 1
    for k, (pivot, column) in enumerate(zip(found.pivots, found.columns, strict=True)):
        if diagonal[k] * found.denominator * last != pivot:
            return False
        if pivot:
            last = pivot
            if any(row[k] * pivot != c for row, c in zip(lower[k + 1 :], column, strict=True)):
                return False
    return True


def is_dominant(rows: Rows, lower: Rows, scale: Sequence[Fraction], strict: bool) -> bool:
    """Is A - L L' dominant with the positive scale, `lower` being the rows of L up to the diagonal?

    In integers: with l_i the common denominator of row i of L, and Q_ij = l_i l_j (A - L L')_ij, the
    inequality of row i is u_i Q_ii >= sum of u_j |Q_ij| with u_i = scale_i / l_i.
    """
    require_symmetric(rows)
    if any(s <= 0 for s in scale):
        return False
    d, integers = _integers(rows)
    units = [lcm(*{a.denominator for a in row}) for row in lower]
    factor = [[a.numerator * (u // a.denominator) for a in row] for row, u in zip(lower, units, strict=True)]
    weights = _integers([[s / u for s, u in zip(scale, units, strict=True)]])[1][0]
    remainder = [
        [units[i] * units[j] * integers[i][j] - d * sum(map(mul, factor[i], factor[j])) for j in range(i + 1)]
        for i in range(len(rows))
    ]
    others = [0] * len(rows)
    for i, row in enumerate(remainder):
        for j in range(i):
            others[i] += weights[j] * abs(row[j])
            others[j] += weights[i] * abs(row[j])
    slack = [w * row[-1] - other for w, row, other in zip(weights, remainder, others, strict=True)]
    return all(s > 0 if strict else s >= 0 for s in slack)


def _integers(rows: Rows) -> tuple[int, list[list[int]]]:
    """(d, d A) with the least positive d that makes it integers."""
    d = lcm(*{a.denominator for row in rows for a in row})
    return d, [[a.numerator * (d // a.denominator) for a in row] for row in rows]
