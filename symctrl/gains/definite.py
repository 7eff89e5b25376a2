"""Definiteness of a matrix over boxes.

It is positive definite in a box where all pivots of its elimination in interval arithmetic are positive, for
these enclose the pivots at every point of the box. It is not where for a vector x, chosen at the middle of
the box, the enclosure of x'Ax lies below zero.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from symctrl.decide.definiteness import decide_matrix
from symctrl.domains.boxes import Array, Box, Boxes, exact_array, quiet, rounded
from symctrl.domains.domain import Unsupported

HOLDS, OPEN, FAILS = 1, 0, -1
DIGITS = 2.0**12  # of the entries of a vector x
Rows = list[list[Box]]


def definite_in(tree: Mapping[str, Any], strict: bool, outputs: Sequence[Box], domain: Boxes) -> Array:
    """HOLDS, FAILS or OPEN for each box. Raises Unsupported for a structure that is not read here."""
    with quiet():
        found = [_matrix_in(rows, strict, domain) for rows in leaves(tree, outputs)]
    return np.min(np.broadcast_arrays(*found), axis=0)


def is_symmetric(tree: Mapping[str, Any], outputs: Sequence[Box]) -> bool:
    """Do the enclosures of entries that mirror each other meet?"""
    pairs = [
        (row[c], rows[c][r])
        for rows in leaves(tree, outputs)
        for r, row in enumerate(rows)
        for c in range(len(row))
    ]
    return all(((a.low <= b.high) & (b.low <= a.high) | np.isnan(a.low + b.low)).all() for a, b in pairs)


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
    largest row sum of W. That of C is bounded because C - s I is exactly semidefinite. A short s is tried
    first: the eigenvalue may be one. Raises Unsupported for numbers that are too large for floating point.
    """
    middle = [[(low + high) / 2 for low, high in row] for row in rows]
    spread = max(sum(((high - low) / 2 for low, high in row), Fraction(0)) for row in rows)
    try:
        near = float(np.linalg.eigvalsh(np.array([[float(x) for x in row] for row in middle]))[0])
        short = Fraction(near).limit_denominator(1000)
    except (ValueError, OverflowError, np.linalg.LinAlgError):
        raise Unsupported("the eigenvalues are too large") from None
    step = max(Fraction(abs(near)), Fraction(1)) / 2**40
    bound = short if abs(short - Fraction(near)) <= step else Fraction(round(near * 2**40), 2**40)
    while not _exceeds(middle, bound):
        bound, step = bound - step, 2 * step
    return bound - spread


def _exceeds(rows: Sequence[Sequence[Fraction]], bound: Fraction) -> bool:
    shifted = [[x - (bound if r == c else 0) for c, x in enumerate(row)] for r, row in enumerate(rows)]
    return decide_matrix(shifted).definiteness != "not positive semidefinite"


def _matrix_in(rows: Rows, strict: bool, domain: Boxes) -> Array:
    if domain.exact and all((box.low == box.high).all() for row in rows for box in row):
        return _at_points(rows, strict)
    holds = _pivots(rows, domain)
    count = np.broadcast_shapes(*(box.low.shape for row in rows for box in row))
    found = np.where(np.broadcast_to(holds, count), HOLDS, OPEN)
    left = np.flatnonzero(found == OPEN)
    if left.size:
        low: Array = np.array(_together([[box.low for box in row] for row in rows]))[..., left]
        high: Array = np.array(_together([[box.high for box in row] for row in rows]))[..., left]
        found[left] = np.where(_excluded(low, high, strict, domain), FAILS, OPEN)
    return found


def _at_points(rows: Rows, strict: bool) -> Array:
    each = _together([[box.low for box in row] for row in rows])
    found = []
    for k in range(each[0][0].size):
        answer = decide_matrix([[Fraction(entry[k]) for entry in row] for row in each]).definiteness
        good = answer == "positive definite" or (answer == "positive semidefinite" and not strict)
        found.append(HOLDS if good else FAILS)
    return np.array(found)


def _together(rows: Sequence[Sequence[Array]]) -> list[list[Array]]:
    """The entries as arrays of one length; those below the diagonal are those above it."""
    count = np.broadcast_shapes(*(entry.shape for row in rows for entry in row))
    upper = {(r, c): np.broadcast_to(row[c], count) for r, row in enumerate(rows) for c in range(r, len(row))}
    return [[upper[min(r, c), max(r, c)] for c in range(len(rows))] for r in range(len(rows))]


def _pivots(rows: Rows, domain: Boxes) -> Array:
    """Are all pivots of the elimination positive in the whole box? Only entries on and above the diagonal are
    looked at.
    """
    left = [row[r:] for r, row in enumerate(rows)]
    holds = np.array([True])
    one: Any = Fraction(1) if domain.exact else 1.0  # for a pivot below one that is not positive
    while left:
        top = left.pop(0)
        holds = holds & (top[0].low > 0)
        if not left or not holds.any():
            break
        pivot = Box(np.where(holds, top[0].low, one), np.where(holds, top[0].high, one))
        inverse = domain.inv_(pivot)
        left = [_eliminated(top, k, row, inverse, domain) for k, row in enumerate(left, 1)]
    return holds


def _eliminated(top: list[Box], k: int, row: list[Box], inverse: Box, domain: Boxes) -> list[Box]:
    """Row k below the top one, from its diagonal on, with the top one's first entry eliminated."""
    made = []
    for c, entry in enumerate(row, k):
        both = domain.sq_(top[k]) if c == k else domain.mul_(top[k], top[c])
        made.append(domain.sub_(entry, domain.mul_(both, inverse)))
    return made


def _excluded(low: Array, high: Array, strict: bool, domain: Boxes) -> Array:
    """Is x'Ax below zero (or zero, where the matrix shall be definite) in the whole box, for a vector x that
    is proposed in floating point?

    low, high: of shape (n, n, boxes).
    """
    n, x = len(low), _directions(low, high)
    total = domain.constant(Fraction(0))
    for r in range(n):
        for c in range(r, n):
            twice = x[:, r] * x[:, c] * (1 if r == c else 2)  # whole numbers below 2^26: exact
            weight = exact_array([Fraction(int(w)) for w in twice]) if domain.exact else twice
            entry = domain.mul_(Box(weight, weight), Box(low[r, c], high[r, c]))
            total = domain.add_(total, entry)
    below = total.high <= 0 if strict else total.high < 0
    return below.astype(bool) & (np.abs(x).max(axis=1) > 0)


def _directions(low: Array, high: Array) -> Array:
    """Eigenvectors of the smallest eigenvalues in the middle of the boxes, as whole numbers; zero where there
    is none.
    """
    middle = np.moveaxis((_floats(low) + _floats(high)) / 2, 2, 0)
    known = np.isfinite(middle).all(axis=(1, 2))
    middle[~known] = 0
    try:
        x = np.round(np.linalg.eigh(middle)[1][:, :, 0] * DIGITS)
    except np.linalg.LinAlgError:
        return np.zeros(middle.shape[:2])
    return np.where(known[:, None], x, 0.0)


def _floats(ends: Array) -> Array:
    """About the fractions, as floating-point numbers."""
    if ends.dtype != object:
        return ends
    return np.array([rounded(x, -np.inf) for x in ends.ravel()]).reshape(ends.shape)
