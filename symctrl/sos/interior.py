"""A primal-dual interior point in double precision, for a few large blocks.

    maximise lam  such that  A(X) + lam A(I) = b,  X_k >= 0
    minimise b'y  such that  Z_k = sum over u of y_u w_k(u) q_k(u) q_k(u)' >= 0,  A(I)'y = 1

where A(X)_u is the sum over blocks k of w_k(u) q_k(u)' X_k q_k(u).

Directions of Helmberg, Rendl, Vanderbei and Wolkowicz (SIAM J. Optim. 6, 1996; HKM), Mehrotra's predictor and
corrector. As every constraint has rank one, the Schur complement is a Hadamard product,
(Q X Q') o (Q Z^-1 Q'): three matrix products and one Cholesky factor in each step.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import cho_factor, cho_solve, solve_triangular

from symctrl.sos.programme import Samples

_STEPS = 60


@dataclass(frozen=True)
class Iterate:
    """grams: X_k + lam I. lam: the margin; bound: of the dual, above the best lam where it is feasible."""

    lam: float
    grams: list[Any]
    mu: float
    residual: float
    bound: float
    moments: Any  # y
    dual_residual: float


def iterates(s: Samples, constant: bool = False) -> Iterator[Iterate]:
    """Points with X_k > 0 on the way to the best lam; ends where floats go no further.

    constant: lam is subtracted from the polynomial instead, and the Gram matrices are X_k alone.
    """
    size = float(np.abs(s.target).max()) or 1.0
    b = s.target / size
    ws, qs = s.weights, s.rows
    rows = sum(q.shape[1] for q in qs)
    v = s.free

    def down(y: Any) -> Any:
        return y if v is None else v.T @ y

    def up(w: Any) -> Any:
        return w if v is None else v @ w

    a0 = down(s.row_scale if constant else sum(w * (q * q).sum(axis=1) for q, w in zip(qs, ws, strict=True)))
    b = down(b)
    if not float(a0 @ a0) > 0:
        return
    w = a0 / float(a0 @ a0)
    fit = float(b @ a0) / float(a0 @ a0)
    spread = max(abs(fit), float(np.abs(b - fit * a0).max()) / max(float(np.abs(a0).max()), 1e-300), 1e-3)
    xs = [spread * np.eye(q.shape[1]) for q in qs]
    lam = fit - spread
    zs = [np.eye(q.shape[1]) / rows for q in qs]
    for _ in range(_STEPS):
        y = up(w)
        rds = [(q.T * (y * g)) @ q - z for q, g, z in zip(qs, ws, zs, strict=True)]  # A*(y) - Z
        rp = b - down(_apply(qs, ws, xs)) - lam * a0
        rl = 1 - float(a0 @ w)
        mu = sum(float(np.sum(x * z)) for x, z in zip(xs, zs, strict=True)) / rows
        residual = float(np.abs(rp).max())
        dual = max(float(np.abs(r).max()) for r in rds) + abs(rl)
        shown = [size * (x + (0 if constant else lam) * np.eye(len(x))) for x in xs]
        yield Iterate(size * lam, shown, size * mu, size * residual, size * float(b @ w), y, dual)
        if mu < 1e-15 and residual < 1e-12:
            return
        try:
            step = _direction(qs, ws, xs, zs, rds, rp, rl, mu, a0, down, up)
        except np.linalg.LinAlgError:
            return
        if step is None:
            return
        dx, dz, dw, dl, ap, ad = step
        if max(ap, ad) < 1e-5:
            return
        xs = [x + ap * d for x, d in zip(xs, dx, strict=True)]
        lam += ap * dl
        zs = [z + ad * d for z, d in zip(zs, dz, strict=True)]
        w = w + ad * dw


def _apply(qs: list[Any], ws: list[Any], xs: list[Any]) -> Any:
    return sum(g * ((q @ x) * q).sum(axis=1) for q, g, x in zip(qs, ws, xs, strict=True))


def _direction(
    qs: Any, ws: Any, xs: Any, zs: Any, rds: Any, rp: Any, rl: float, mu: float, a0: Any, down: Any, up: Any
) -> Any:
    inverses, roots = [], []
    schur: Any = 0
    for q, g, x, z in zip(qs, ws, xs, zs, strict=True):
        root = np.linalg.cholesky(z)
        half = solve_triangular(root, q.T, lower=True, check_finite=False)
        product = (q @ x) @ q.T
        product *= half.T @ half
        if len(set(g.tolist())) > 1 or g[0] != 1:
            product *= g[:, None]
            product *= g[None, :]
        schur = product if isinstance(schur, int) else schur + product
        li = solve_triangular(root, np.eye(len(z)), lower=True, check_finite=False)
        inverses.append(li.T @ li)
        roots.append((np.linalg.cholesky(x), root))
    schur = down(down(schur).T)
    schur[np.diag_indices_from(schur)] *= 1 + 1e-14
    factor = cho_factor(schur, lower=True, check_finite=False)

    def solve_schur(right: Any) -> Any:
        """With one step of refinement."""
        first = cho_solve(factor, right, check_finite=False)
        return first + cho_solve(factor, right - schur @ first, check_finite=False)

    along = solve_schur(a0)
    below = float(a0 @ along)

    def solve(center: list[Any]) -> Any:
        # dZ = A*(dy) + Rd, dX = center - X - sym(X dZ Z^-1)
        fixed = [c - x - _sym(x @ rd @ zi) for c, x, rd, zi in zip(center, xs, rds, inverses, strict=True)]
        rhs = down(_apply(qs, ws, fixed)) - rp
        first = solve_schur(rhs)
        dl = (rl - float(a0 @ first)) / below
        dw = first + dl * along
        y = up(dw)
        dz = [(q.T * (y * g)) @ q + rd for q, g, rd in zip(qs, ws, rds, strict=True)]
        dx = [c - x - _sym(x @ d @ zi) for c, x, d, zi in zip(center, xs, dz, inverses, strict=True)]
        return dx, dz, dw, dl

    dx, dz, dw, dl = solve([0 * x for x in xs])
    ap = min(_longest(r[0], d) for r, d in zip(roots, dx, strict=True))
    ad = min(_longest(r[1], d) for r, d in zip(roots, dz, strict=True))
    rows = sum(len(x) for x in xs)
    after = sum(float(np.sum((x + ap * a) * (z + ad * c))) for x, a, z, c in zip(xs, dx, zs, dz, strict=True))
    sigma = min(1.0, max(1e-6, (after / rows / mu) ** 2 if after > 0 else 1e-6)) * (
        1.0 if min(ap, ad) > 0.1 else 3.0
    )
    center = [min(sigma, 1.0) * mu * zi - _sym(a @ c @ zi) for zi, a, c in zip(inverses, dx, dz, strict=True)]
    dx, dz, dw, dl = solve(center)
    if not all(np.isfinite(a).all() for a in (*dx, *dz)):
        return None
    reach = 0.95 if min(ap, ad) > 0.5 else 0.9
    ap = min(1.0, reach * min(_longest(r[0], d) for r, d in zip(roots, dx, strict=True)))
    ad = min(1.0, reach * min(_longest(r[1], d) for r, d in zip(roots, dz, strict=True)))
    return dx, dz, dw, dl, ap, ad


def _sym(a: Any) -> Any:
    return (a + a.T) / 2


def _longest(root: Any, d: Any) -> float:
    """The longest step along d that keeps L L' + step d semidefinite, 1 where it is longer."""
    half = solve_triangular(root, d, lower=True, check_finite=False)
    scaled = solve_triangular(root, half.T, lower=True, check_finite=False)
    least = float(np.linalg.eigvalsh(_sym(scaled))[0])
    return 1.0 if least > -1.0 else -1.0 / least
