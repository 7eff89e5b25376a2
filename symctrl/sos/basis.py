"""Which monomials a sum of squares can use: Newton polytope, diagonal consistency, sign symmetries.

If p = sum of f_k^2, each f_k has its exponents in half the Newton polytope of p (Reznick, Extremal psd forms
with few terms, Duke Math. J. 45, 1978). An exponent b whose double is neither an exponent of p nor a sum of
two other candidates cannot occur either. If p is even in some variables together, its Gram matrix can be
block diagonal (Lofberg, Pre- and post-processing sum-of-squares programs, IEEE TAC 54, 2009).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np
from scipy.optimize import linprog

from symctrl.sos.ring import Monomial, Poly

MAX_CANDIDATES = 3000


class TooMany(ValueError):  # noqa: N818
    """A basis would have more monomials than can be used."""


def monomials(n: int, top: int, least: int = 0) -> list[Monomial]:
    """All exponents of total degree least to top."""
    return list(_within([top] * n, least, top))


def _within(caps: Sequence[int], least: int, top: int) -> Iterator[Monomial]:
    """Exponents under the caps, with a total degree in the range."""
    if not caps:
        if least <= 0:
            yield ()
        return
    for e in range(min(caps[0], top) + 1):
        for rest in _within(caps[1:], least - e, top - e):
            yield (e, *rest)


def half_newton(support: Iterable[Monomial]) -> list[Monomial]:
    """Candidates b with 2b in the Newton polytope, less those that diagonal consistency excludes.

    Raises TooMany.
    """
    points = np.array(sorted(support), dtype=np.int64)
    degrees = points.sum(axis=1)
    caps = (points.max(axis=0) // 2).tolist()
    found = []
    for b in _within(caps, -(-int(degrees.min()) // 2), int(degrees.max()) // 2):
        found.append(b)
        if len(found) > MAX_CANDIDATES:
            raise TooMany(f"more than {MAX_CANDIDATES} monomials")
    inside = _Inside(points)
    kept = [b for b in found if inside(b)]
    return _consistent(kept, {tuple(m) for m in points.tolist()})


class _Inside:
    """Is 2b in the convex hull of the points? Directions that have separated others are tried first."""

    def __init__(self, points: Any) -> None:
        self.points = points
        self.known = {tuple(m) for m in points.tolist()}
        n = points.shape[1]
        self.directions = [*np.eye(n), *-np.eye(n), np.ones(n), -np.ones(n)]
        self.tops = [float((points @ d).max()) for d in self.directions]

    def __call__(self, b: Monomial) -> bool:
        double = 2 * np.array(b)
        if tuple(double.tolist()) in self.known:
            return True
        if any(float(double @ d) > top + 1e-9 for d, top in zip(self.directions, self.tops, strict=True)):
            return False
        n = len(b)
        # The best d in the unit box with d'double - max over the points of d'point.
        matrix = np.hstack([self.points - double, -np.ones((len(self.points), 1))])
        done = linprog(
            np.r_[np.zeros(n), 1.0],
            A_ub=matrix,
            b_ub=np.zeros(len(self.points)),
            bounds=[(-1, 1)] * n + [(None, None)],
            method="highs",
        )
        if done.x is None or done.fun > -1e-6:
            return True
        direction = np.rint(done.x[:n] * 720) / 720
        top = float((self.points @ direction).max())
        if float(double @ direction) > top + 1e-9:
            self.directions.append(direction)
            self.tops.append(top)
            return False
        return True


def _consistent(basis: list[Monomial], support: set[Monomial]) -> list[Monomial]:
    """Without b where 2b is neither in the support nor a sum of two different others, again and again."""
    array = np.array(basis, dtype=np.int64).reshape(len(basis), -1)
    while len(array):
        base = int(array.max()) * 2 + 1
        exact = base ** array.shape[1] < 2**62
        if not exact:
            return _consistent_slowly(array, support)
        keys = array @ np.array([base**k for k in range(array.shape[1])], dtype=np.int64)
        sums = (keys[:, None] + keys[None, :])[~np.eye(len(keys), dtype=bool)]
        wanted = [tuple(row) in support for row in (2 * array).tolist()]
        keep = np.array(wanted) | np.isin(2 * keys, sums)
        if keep.all():
            break
        array = array[keep]
    return [tuple(row) for row in array.tolist()]


def _consistent_slowly(array: Any, support: set[Monomial]) -> list[Monomial]:
    rows = [tuple(row) for row in array.tolist()]
    while True:
        sums = {tuple(x + y for x, y in zip(a, b, strict=True)) for i, a in enumerate(rows) for b in rows[:i]}
        kept = [a for a in rows if tuple(2 * e for e in a) in support | sums]
        if len(kept) == len(rows):
            return rows
        rows = kept


def parities(polys: Sequence[Poly]) -> Any:
    """Sign changes that leave all polynomials as they are: rows over GF(2), a basis of them."""
    table = {tuple(int(e) % 2 for e in m) for p in polys for m in p.monoms()}
    n = len(next(iter(table))) if table else 0
    rows = [sum(b << k for k, b in enumerate(m)) for m in table]
    pivots: dict[int, int] = {}
    for given in rows:
        row = given
        for k, pivot in pivots.items():
            if row >> k & 1:
                row ^= pivot
        if row:
            k = row.bit_length() - 1
            for other in list(pivots):
                if pivots[other] >> k & 1:
                    pivots[other] ^= row
            pivots[k] = row
    free = [k for k in range(n) if k not in pivots]
    kernel = []
    for k in free:
        vector = [0] * n
        vector[k] = 1
        for j, pivot in pivots.items():
            vector[j] = pivot >> k & 1
        kernel.append(vector)
    return np.array(kernel, dtype=np.int64).reshape(len(kernel), n)


def split(basis: Sequence[Monomial], signs: Any) -> list[list[Monomial]]:
    """The basis in classes that behave alike under the sign changes."""
    classes: dict[tuple[int, ...], list[Monomial]] = {}
    for b in basis:
        classes.setdefault(tuple((signs @ np.array(b) % 2).tolist()), []).append(b)
    return list(classes.values())
