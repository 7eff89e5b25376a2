"""Definiteness of a matrix over boxes.

It is positive definite in a box where all pivots of its elimination in interval arithmetic are positive, for
these enclose the pivots at every point of the box. It is not where for a vector x, chosen at the middle of
the box, the enclosure of x'Ax lies below zero.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import reduce
from typing import Any

import numpy as np

from symctrl.decide.definiteness import decide_matrix
from symctrl.domains.boxes import Array, Box, Boxes
from symctrl.domains.domain import Unsupported

HOLDS, OPEN, FAILS = 1, 0, -1
DIGITS = 2.0**12  # of the entries of a vector x
Rows = list[list[Box]]


def definite_in(tree: Mapping[str, Any], strict: bool, outputs: Sequence[Box], domain: Boxes) -> Array:
    """HOLDS, FAILS or OPEN for each box. Raises Unsupported for a structure that is not read here."""
    found = [_matrix_in(rows, strict, domain) for rows in leaves(tree, outputs)]
    return np.min(np.broadcast_arrays(*found), axis=0)


def leaves(tree: Mapping[str, Any], outputs: Sequence[Any]) -> Iterator[list[list[Any]]]:
    """The matrices of which all are definite exactly if the whole is."""
    if "kron_identity" in tree:
        yield from leaves(tree["kron_identity"], outputs)
    elif "blocks" in tree:
        for block in tree["blocks"]:
            yield from leaves(block, outputs)
    elif "entries" in tree:
        yield [[outputs[k] for k in row] for row in tree["entries"]]
    else:
        raise Unsupported("a product of matrices is not read over boxes of gains")


def smallest_eigenvalue(rows: Sequence[Sequence[tuple[Fraction, Fraction]]]) -> Fraction:
    """A lower bound of the smallest eigenvalue of every symmetric matrix within the entries' intervals.

    A = C + R with |R| <= W entry by entry: the smallest eigenvalue of A is at least that of C less the
    largest row sum of W. That of C is bounded because C - s I is exactly semidefinite.
    """
    middle = [[(low + high) / 2 for low, high in row] for row in rows]
    spread = max(sum(((high - low) / 2 for low, high in row), Fraction(0)) for row in rows)
    near = float(np.linalg.eigvalsh(np.array([[float(x) for x in row] for row in middle]))[0])
    step = Fraction(abs(near) or 1.0).limit_denominator(1) / 2**40 + Fraction(1, 2**40)
    bound = Fraction(round(near * 2**40), 2**40)
    while not _exceeds(middle, bound):
        bound, step = bound - step, 2 * step
    return bound - spread


def _exceeds(rows: Sequence[Sequence[Fraction]], bound: Fraction) -> bool:
    shifted = [[x - (bound if r == c else 0) for c, x in enumerate(row)] for r, row in enumerate(rows)]
    return decide_matrix(shifted).definiteness != "not positive semidefinite"


def _matrix_in(rows: Rows, strict: bool, domain: Boxes) -> Array:
    if domain.exact and all((box.low == box.high).all() for row in rows for box in row):
        return _at_points(rows, strict)
    holds = reduce(np.logical_and, (pivot.low > 0 for pivot in _pivots(rows, domain)))
    return np.where(holds, HOLDS, np.where(_excluded(rows, strict), FAILS, OPEN))


def _at_points(rows: Rows, strict: bool) -> Array:
    count = np.broadcast_shapes(*(box.low.shape for row in rows for box in row))[0]
    each = [[np.broadcast_to(box.low, count) for box in row] for row in rows]
    found = []
    for k in range(count):
        answer = decide_matrix([[Fraction(entry[k]) for entry in row] for row in each]).definiteness
        good = answer == "positive definite" or (answer == "positive semidefinite" and not strict)
        found.append(HOLDS if good else FAILS)
    return np.array(found)


def _pivots(rows: Rows, domain: Boxes) -> Iterator[Box]:
    """The pivots of the elimination, up to one of which nothing is known where the ends are fractions."""
    left = [list(row) for row in rows]
    while left:
        pivot = left[0][0]
        yield pivot
        if len(left) == 1 or (domain.exact and not (pivot.low > 0).all()):
            return
        inverse = domain.inv_(pivot)
        left = [_eliminated(left[0], row, r, inverse, domain) for r, row in enumerate(left) if r]


def _eliminated(top: list[Box], row: list[Box], r: int, inverse: Box, domain: Boxes) -> list[Box]:
    """A row below the top one without its first entry; row[0] and top[r] are the same by symmetry."""
    made = []
    for c in range(1, len(row)):
        both = domain.sq_(row[0]) if c == r else domain.mul_(row[0], top[c])
        made.append(domain.sub_(row[c], domain.mul_(both, inverse)))
    return made


def _excluded(rows: Rows, strict: bool) -> Array:
    """Is x'Ax below zero (or zero, where the matrix shall be definite) in the whole box?"""
    floats, n = Boxes(), len(rows)
    shape = np.broadcast_shapes(*(box.low.shape for row in rows for box in row))
    low = np.array([[np.broadcast_to(_as_floats(box.low), shape) for box in row] for row in rows])
    high = np.array([[np.broadcast_to(_as_floats(box.high), shape) for box in row] for row in rows])
    middle = np.moveaxis((low + high) / 2, 2, 0)
    known = np.isfinite(middle).all(axis=(1, 2))
    middle[~known] = np.eye(n)
    x = np.round(np.linalg.eigh(middle)[1][:, :, 0] * DIGITS)
    total = floats.constant(Fraction(0))
    for r in range(n):
        for c in range(n):
            weight = Box(x[:, r] * x[:, c], x[:, r] * x[:, c])  # whole numbers below 2^24: exact
            entry = Box(np.nextafter(low[r, c], -np.inf), np.nextafter(high[r, c], np.inf))
            total = floats.add_(total, floats.mul_(weight, entry))
    below = total.high <= 0 if strict else total.high < 0
    return below & known & (np.abs(x).max(axis=1) > 0)


def _as_floats(ends: Array) -> Array:
    return ends.astype(float)
