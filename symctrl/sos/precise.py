"""The interior point of `interior` with numbers of hundreds of bits, for problems on the cone's boundary.

Where the best margin is zero, doubles find the kernel of the Gram matrix to a few digits only; here its small
eigenvalues are as small as wanted, and `face` reads the exact face off the kernel. Balls are not followed:
midpoints of python-flint's matrices, as every answer is checked exactly afterwards.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import arb, arb_mat, fmpq, fmpq_mat
from scipy.linalg import solve_triangular

from symctrl.sos.deadline import Deadline
from symctrl.sos.programme import Programme, Samples, TooLarge
from symctrl.sos.ring import Poly, monomial
from symctrl.sos.univariate import precision

MAX_EQUATIONS = 320
MAX_ROWS = 130
_STEPS = 90
_MOST_ENTRIES = 40_000


@dataclass(frozen=True)
class Precise:
    """grams: X_k + lam I in the programme's bases; mu: how far from optimal."""

    lam: float
    grams: list[Any]  # arb_mat
    mu: float
    orthonormal: list[Any]  # the same in floats, in the orthonormal bases of the samples


def solve(programme: Programme, samples: Samples, bits: int, deadline: Deadline) -> Precise | None:
    """A point close to the best lam; None where the iteration breaks down. Raises TooLarge and Late."""
    if len(programme.support) > MAX_EQUATIONS or programme.rows > MAX_ROWS:
        raise TooLarge(f"{len(programme.support)} equations in {bits} bits")
    with precision(bits):
        return _Iteration(programme, samples, bits, deadline).run()


def _column(values: Sequence[Any]) -> Any:
    return arb_mat(len(values), 1, list(values))


def _diagonal(values: Sequence[Any]) -> Any:
    n = len(values)
    return arb_mat(n, n, [values[i] if i == j else 0 for i in range(n) for j in range(n)])


def _at(polys: Sequence[Poly], points: Sequence[Sequence[Any]]) -> list[list[Any]]:
    """Exact values, as balls: one row a point."""
    return [[arb(p(*point)) for p in polys] for point in points]


def _unit(n: int) -> Any:
    return _diagonal([arb(1)] * n)


def _dot(a: Any, b: Any) -> Any:
    return sum((x * y for x, y in zip(a.entries(), b.entries(), strict=True)), arb(0))


def _sym(a: Any) -> Any:
    return ((a + a.transpose()) / 2).mid()


def cholesky(a: Any) -> Any:
    """Lower triangular; raises ZeroDivisionError where a is not definite."""
    n = a.nrows()
    rows = a.tolist()
    low: list[list[Any]] = []
    for i in range(n):
        row: list[Any] = []
        for j in range(i + 1):
            total = rows[i][j]
            for x, y in zip(row, low[j] if j < i else row, strict=False):
                total -= x * y
            if i == j:
                total = total.mid()
                if not total > 0:
                    raise ZeroDivisionError("not definite")
                row.append(total.sqrt().mid())
            else:
                row.append((total / low[j][j]).mid())
        low.append(row)
    return arb_mat(n, n, [low[i][j] if j <= i else 0 for i in range(n) for j in range(n)])


class _Iteration:
    def __init__(self, programme: Programme, samples: Samples, bits: int, deadline: Deadline) -> None:
        self.deadline = deadline
        self.bits = bits
        self.tolerance = 2.0 ** (-0.8 * bits)
        points = [[fmpq(*float(x).as_integer_ratio()) for x in point] for point in samples.points]
        scale = [arb(float(s)) for s in samples.row_scale]
        self.triangles = []
        self.rows: list[Any] = []
        self.weights: list[list[Any]] = []
        for block, r in zip(programme.blocks, samples.triangles, strict=True):
            inverse = solve_triangular(r, np.eye(len(r)))
            to_q = arb_mat(inverse.tolist())
            self.triangles.append(to_q)
            values = arb_mat(_at(block.basis, points))
            roots = _diagonal([s.sqrt().mid() for s in scale])
            self.rows.append((roots * values * to_q).mid())
            self.weights.append([row[0] for row in _at([block.weight], points)])
        target = [row[0] * s for row, s in zip(_at([programme.target], points), scale, strict=True)]
        self.size = max((abs(float(t.mid())) for t in target), default=1.0) or 1.0
        self.down: Any = None
        if programme.multiples:
            self.down = _left_kernel(programme, points, [float(s) for s in samples.row_scale])
        b = _column([t / self.size for t in target])
        self.b = b if self.down is None else (self.down * b).mid()
        self.count = sum(q.ncols() for q in self.rows)

    def apply(self, xs: list[Any]) -> Any:
        total = None
        for q, w, x in zip(self.rows, self.weights, xs, strict=True):
            left = (q * x).tolist()
            right = q.tolist()
            values = [
                sum((a * b for a, b in zip(u, v, strict=True)), arb(0)) * g
                for u, v, g in zip(left, right, w, strict=True)
            ]
            total = values if total is None else [s + v for s, v in zip(total, values, strict=True)]
        column = _column(total or [])
        return column.mid() if self.down is None else (self.down * column).mid()

    def adjoint(self, w: Any) -> list[Any]:
        y = (w if self.down is None else self.down.transpose() * w).entries()
        return [
            _sym(q.transpose() * (_diagonal([a * g for a, g in zip(y, gs, strict=True)]) * q))
            for q, gs in zip(self.rows, self.weights, strict=True)
        ]

    def schur(self, xs: list[Any], inverses: list[Any]) -> Any:
        total: list[Any] = []
        for q, w, x, zi in zip(self.rows, self.weights, xs, inverses, strict=True):
            left = (q * x * q.transpose()).entries()
            right = (q * zi * q.transpose()).entries()
            m = len(w)
            plain = all(g == 1 for g in w)
            product = [a * b for a, b in zip(left, right, strict=True)]
            if not plain:
                product = [p * w[k // m] * w[k % m] for k, p in enumerate(product)]
            total = product if not total else [s + p for s, p in zip(total, product, strict=True)]
        m = len(self.weights[0])
        matrix = arb_mat(m, m, total).mid()
        if self.down is not None:
            matrix = (self.down * matrix * self.down.transpose()).mid()
        return matrix

    def run(self) -> Precise | None:
        units = [_unit(q.ncols()) for q in self.rows]
        a0 = self.apply(units)
        norm = _dot(a0, a0).mid()
        w = (a0 / norm).mid()
        fit = (_dot(self.b, a0) / norm).mid()
        spread = arb(max(abs(float(fit)), 1.0))
        xs = [(u * spread).mid() for u in units]
        zs = [(u / self.count).mid() for u in units]
        lam = fit - spread
        last = None
        for _ in range(_STEPS):
            self.deadline.check()
            mu = float(sum((_dot(x, z) for x, z in zip(xs, zs, strict=True)), arb(0)).mid()) / self.count
            rp = (self.b - self.apply(xs) - a0 * lam).mid()
            residual = max((abs(float(r.mid())) for r in rp.entries()), default=0.0)
            shown = [x + u * lam for x, u in zip(xs, units, strict=True)]
            if residual < max(1e-30, mu) or last is None:
                last = (float(lam), shown, mu)
            if mu < self.tolerance or (float(lam) < -1e-6 and mu < 1e-12):
                break
            try:
                step = self.direction(xs, zs, w, rp, mu, a0)
            except (ZeroDivisionError, ValueError, np.linalg.LinAlgError):
                break
            dx, dz, dw, dl, ap, ad = step
            if max(float(ap), float(ad)) < 1e-4:
                break
            xs = [(x + d * ap).mid() for x, d in zip(xs, dx, strict=True)]
            zs = [(z + d * ad).mid() for z, d in zip(zs, dz, strict=True)]
            w, lam = (w + dw * ad).mid(), (lam + dl * ap).mid()
        if last is None:
            return None
        grams = [
            _sym(t * x * t.transpose()) * self.size for t, x in zip(self.triangles, last[1], strict=True)
        ]
        floats = [np.array([[float(a) for a in row] for row in x.tolist()]) * self.size for x in last[1]]
        return Precise(last[0], grams, last[2], floats)

    def inverse(self, a: Any) -> Any:
        """Elimination with balls loses twice the digits that its midpoints would; so it gets more of them."""
        with precision(2 * self.bits):
            found = a.inv()
        return found.mid()

    def direction(self, xs: Any, zs: Any, w: Any, rp: Any, mu: float, a0: Any) -> Any:
        rds = [_sym(a - z) for a, z in zip(self.adjoint(w), zs, strict=True)]
        rl = (arb(1) - _dot(a0, w)).mid()
        roots = [(cholesky(x), cholesky(z)) for x, z in zip(xs, zs, strict=True)]
        inverses = [self.inverse(z) for z in zs]
        schur = self.schur(xs, inverses)
        inverse = self.inverse(schur)
        along = (inverse * a0).mid()
        below = _dot(a0, along).mid()

        def solved(center: list[Any]) -> Any:
            fixed = [
                (c - x - _sym(x * rd * zi)).mid()
                for c, x, rd, zi in zip(center, xs, rds, inverses, strict=True)
            ]
            first = (inverse * (self.apply(fixed) - rp)).mid()
            dl = ((rl - _dot(a0, first)) / below).mid()
            dw = (first + along * dl).mid()
            dz = [(a + rd).mid() for a, rd in zip(self.adjoint(dw), rds, strict=True)]
            dx = [
                (c - x - _sym(x * d * zi)).mid() for c, x, d, zi in zip(center, xs, dz, inverses, strict=True)
            ]
            return dx, dz, dw, dl

        dx, dz, dw, dl = solved([x * 0 for x in xs])
        ap, ad = self._steps(roots, dx, dz, 1.0)
        after = sum((_dot(x + a * ap, z + c * ad) for x, a, z, c in zip(xs, dx, zs, dz, strict=True)), arb(0))
        ratio = max(float(after.mid()), 0.0) / self.count / mu
        sigma = min(1.0, max(1e-7, ratio**2 if min(ap, ad) > 0.1 else ratio))
        center = [
            (zi * (sigma * mu) - _sym(a * c * zi)).mid() for zi, a, c in zip(inverses, dx, dz, strict=True)
        ]
        dx, dz, dw, dl = solved(center)
        ap, ad = self._steps(roots, dx, dz, 0.95)
        return dx, dz, dw, dl, arb(ap), arb(ad)

    def _steps(self, roots: Any, dx: Any, dz: Any, reach: float) -> tuple[float, float]:
        ap = min(1.0, reach * min(_longest(r[0], d) for r, d in zip(roots, dx, strict=True)))
        ad = min(1.0, reach * min(_longest(r[1], d) for r, d in zip(roots, dz, strict=True)))
        return ap, ad


def _longest(root: Any, d: Any) -> float:
    """The longest step along d that keeps L L' + step d semidefinite: the small matrix fits in doubles."""
    inverse = root.inv()
    small = _sym(inverse * d * inverse.transpose())
    floats = np.array([[float(a) for a in row] for row in small.tolist()])
    least = float(np.linalg.eigvalsh(floats)[0])
    return 1.0 if least > -1.0 else -1.0 / least


def _left_kernel(programme: Programme, points: list[list[Any]], scale: list[float]) -> Any:
    """Rows that are orthogonal to each multiple's values at the points, which are scaled: an arb_mat.

    Functionals of the coefficients are found exactly, and the coefficients from the values by interpolation.
    """
    support = programme.support
    place = {m: k for k, m in enumerate(support)}
    count, m = len(programme.multiples), len(support)
    if count * m > _MOST_ENTRIES:
        raise TooLarge(f"{count} multiples of equations with {m} monomials")
    matrix = fmpq_mat(count, m)
    for r, (_, _, product) in enumerate(programme.multiples):
        for exponents, c in product.to_dict().items():
            matrix[r, place[tuple(map(int, exponents))]] = c
    reduced, rank = matrix.rref()
    pivots = []
    column = 0
    for r in range(rank):
        while reduced[r, column] == 0:
            column += 1
        pivots.append(column)
        column += 1
    free = [k for k in range(m) if k not in set(pivots)]
    rows = []
    for k in free:
        row = [arb(0)] * m
        row[k] = arb(1)
        for r, p in enumerate(pivots):
            row[p] = -arb(reduced[r, k])
        rows.append(row)
    over = programme.target.context()
    values = arb_mat(_at([monomial(over, e) for e in support], points))
    down = (arb_mat(rows) * values.inv().mid()).mid() * _diagonal([1 / arb(s) for s in scale])
    found = []
    for row in down.tolist():
        norm = sum((x * x for x in row), arb(0)).sqrt()
        found.append([(x / norm).mid() for x in row])
    return arb_mat(found)
