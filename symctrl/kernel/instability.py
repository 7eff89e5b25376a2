"""A rest point that is not stable, by the linear part of the field there.

Soundness-critical. Last reviewed 2026-11-24.

Theorem (Lyapunov; center-stable manifold theorem: Kelley, J. Differential Equations 3 (1967)): let a field be
continuously differentiable near a rest point, with the Jacobian J there. A solution that stays near the point
begins in a manifold that is tangent to the sum E of the eigenspaces of J whose eigenvalues have no positive
real part. So the rest point is not stable with respect to initial states in a manifold with the tangent space
T, where T is not in E. That is so if J maps T into itself and has an eigenvalue with a positive real part on
T. T is the kernel of the gradients of assumed equations about the state, which must be independent; all other
assumptions about the state must hold in a neighbourhood.

Theorem: if no root of a real monic polynomial has a positive real part, no coefficient is negative (it is a
product of x + a and x^2 + b x + c with a, b, c >= 0). The number of roots with a positive real part is that
of the changes of sign in the first column of its Routh array, if there is no zero in it (Gantmacher, The
Theory of Matrices, chapter XV).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.place import (
    NotContradicted,
    Place,
    Site,
    is_fleet,
    is_initial,
    moves,
    reads,
    require_momentary,
    require_no_jump,
    sign_of,
)
from symctrl.kernel.spots import Spot
from symctrl.kernel.traits import SMOOTH
from symctrl.kernel.values import Sentence, Statement

Row = Sequence[Fraction]
Rows = Sequence[Row]
MAX_STATES = 40


def unstable(
    statement: Statement, sentence: Sentence, place: Place, table: Mapping[str, Any], bits: int
) -> None:
    """Raises Invalid or Declined where the point is not shown to be no stable one."""
    if sentence.word != "stable":
        raise NotContradicted(f"an unstable rest point does not contradict the conclusion {sentence.word}")
    if is_fleet(statement):
        raise Declined("the stability of a rest point of a fleet")
    states = list(statement.motion)
    if len(states) > MAX_STATES:
        raise Declined(f"the stability of a rest point with more than {MAX_STATES} states")
    at = dict(sentence.at)
    if not at.keys() <= statement.motion.keys():
        raise Declined("the statement does not have the motion of all states of the point")
    if any(place.values.get(name) != x for name, x in at.items()):
        raise Invalid("the values are not the point that the conclusion speaks of")
    if at.keys() != set(states):
        raise Declined("the conclusion does not speak of all states")
    require_momentary(statement)
    site = Site(statement, place, bits, states)
    jacobian = _jacobian(site)
    site.require_given()
    site.require_supposed()
    tangent = kernel(_equations(site, states), len(states))
    if not grows(restricted(jacobian, tangent)):
        raise Declined("no eigenvalue of the linear part is shown to have a positive real part")


def _jacobian(site: Site) -> list[list[Fraction]]:
    """Of the field by the states, at a rest point near which it is smooth."""
    rows = []
    for name, rate in site.rates().items():
        if sign_of(rate, f"the rate of {name}"):
            raise Invalid(f"this is no rest point: the rate of {name} is not zero")
        rows.append(_gradient(rate, f"the rate of {name}"))
    return rows


def _gradient(spot: Spot, what: str) -> list[Fraction]:
    row = spot.gradient()
    if row is None or spot.traits.level != SMOOTH or spot.traits.jumps:
        raise Declined(f"{what} is not smooth here, or its gradient is not known exactly")
    return row


def _equations(site: Site, states: Sequence[str]) -> list[list[Fraction]]:
    """The gradients of the equations about the state; what else is assumed of it must hold near the point."""
    statement, rows = site.statement, []
    for assumption in statement.given:
        if not any(moves(statement, key) for key in reads(statement, assumption.of)):
            continue
        if not is_initial(statement, assumption) or len(assumption.of) != 1:
            raise Declined(f"that {assumption.text[:80]!r} holds near the point")
        spot: Spot = site.value(assumption.of[0], {})
        require_no_jump([spot], assumption.text)
        if assumption.kind == "zero":
            rows.append(_gradient(spot, f"{assumption.text[:80]!r}"))
        elif spot.number.sign is None or spot.number.sign == 0:
            raise Declined(f"the point is at the edge of {assumption.text[:80]!r}")
    if rank(rows) < len(rows):
        raise Declined("the gradients of the assumed equations are dependent here")
    return rows


# Linear algebra over the rationals.


def reduced(rows: Rows) -> tuple[list[list[Fraction]], list[int]]:
    """The reduced echelon form without zero rows, and the columns of its pivots."""
    left, pivots = [list(row) for row in rows], []
    done: list[list[Fraction]] = []
    for column in range(len(rows[0]) if rows else 0):
        found = next((row for row in left if row[column]), None)
        if found is None:
            continue
        left.remove(found)
        pivot = [x / found[column] for x in found]
        left = [_without(row, pivot, column) for row in left]
        done = [*(_without(row, pivot, column) for row in done), pivot]
        pivots.append(column)
    return done, pivots


def _without(row: Row, pivot: Row, column: int) -> list[Fraction]:
    return [x - row[column] * y for x, y in zip(row, pivot, strict=True)]


def rank(rows: Rows) -> int:
    return len(reduced(rows)[1])


def kernel(rows: Rows, n: int) -> list[list[Fraction]]:
    """A basis of the vectors that every row maps to zero: each has a 1 where all others have a 0."""
    done, pivots = reduced(rows)
    basis = []
    for free in (k for k in range(n) if k not in pivots):
        vector = [Fraction(k == free) for k in range(n)]
        for row, pivot in zip(done, pivots, strict=True):
            vector[pivot] = -row[free]
        basis.append(vector)
    return basis


def restricted(matrix: Rows, basis: Rows) -> list[list[Fraction]]:
    """The matrix of a map on the space of a basis from `kernel`. Raises Declined if it leaves the space."""
    n = len(matrix)
    free = [
        next(k for k in range(n) if v[k] == 1 and all(w[k] == 0 for w in basis if w is not v)) for v in basis
    ]
    columns = []
    for v in basis:
        image = [sum((a * x for a, x in zip(row, v, strict=True)), Fraction(0)) for row in matrix]
        part = [image[k] for k in free]
        again = [sum((c * w[k] for c, w in zip(part, basis, strict=True)), Fraction(0)) for k in range(n)]
        if again != image:
            raise Declined("the linear part does not keep the assumed equations")
        columns.append(part)
    return [list(row) for row in zip(*columns, strict=True)]


def characteristic(matrix: Rows) -> list[Fraction]:
    """The coefficients of det(x - A), the highest first (Faddeev and Le Verrier)."""
    n = len(matrix)
    coefficients, work = [Fraction(1)], [[Fraction(0)] * n for _ in range(n)]
    for k in range(1, n + 1):
        for i in range(n):
            work[i][i] += coefficients[-1]
        work = [
            [sum((a * row[j] for a, row in zip(line, work, strict=True)), Fraction(0)) for j in range(n)]
            for line in matrix
        ]
        coefficients.append(-sum((work[i][i] for i in range(n)), Fraction(0)) / k)
    return coefficients


def grows(matrix: Rows) -> bool:
    """Is an eigenvalue shown to have a positive real part?"""
    coefficients = characteristic(matrix)
    return any(c < 0 for c in coefficients) or _changes(coefficients)


def _changes(coefficients: Row) -> bool:
    """Does the first column of the Routh array change its sign, without a zero in it?"""
    above, row = list(coefficients[::2]), list(coefficients[1::2])
    column = [above[0]]
    for _ in range(len(coefficients) - 1):
        row += [Fraction(0)] * (len(above) - len(row))
        if not row[0]:
            return False
        column.append(row[0])
        ratio = above[0] / row[0]
        below = [a - ratio * b for a, b in zip(above[1:], [*row[1:], Fraction(0)], strict=False)]
        above, row = row, below
    return any(a * b < 0 for a, b in pairwise(column))
