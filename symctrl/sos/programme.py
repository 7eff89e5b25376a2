"""What a solver is asked: to write a polynomial as weights times sums of squares over given bases.

    target = sum over blocks of weight * b' X b  +  sum over multiples of c * (monomial * h)

with X >= 0. Solvers look for the largest lam for which X - lam I is possible, in bases that are orthonormal
on sample points (Lofberg and Parrilo, From coefficients to samples, CDC 2004): a polynomial identity is
imposed at as many points as there are monomials, which makes every constraint of rank one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from symctrl.sos.ring import Monomial, Poly, to_fraction

_SEED = 20_041
_MOST_BYTES = 1.5e9


MAX_ROWS = 600  # of one Gram matrix


class TooLarge(ValueError):  # noqa: N818
    """The programme takes more memory or time than there is; the message says how much."""


@dataclass(frozen=True)
class Block:
    """weight * b' X b. product: the constraints whose product the weight is; multiplier: the weight is -p."""

    product: tuple[int, ...]
    weight: Poly
    basis: tuple[Poly, ...]
    multiplier: bool = False

    @cached_property
    def monomials(self) -> list[Monomial] | None:
        """The exponents of the basis where each of its polynomials is a monomial and the weight is 1."""
        if self.weight != 1 or any(len(b) != 1 for b in self.basis):
            return None
        return [tuple(map(int, b.monoms()[0])) for b in self.basis]


@dataclass(frozen=True)
class Programme:
    """multiples: (index j of h_j, monomial times h_j)."""

    target: Poly
    blocks: tuple[Block, ...]
    multiples: tuple[tuple[int, Poly, Poly], ...] = ()

    @cached_property
    def support(self) -> list[Monomial]:
        """All monomials that the right side can have; the target's where it has others."""
        found: set[Monomial] = set()
        for block in self.blocks:
            own = sorted({tuple(map(int, m)) for b in block.basis for m in b.monoms()})
            array = np.array(own, dtype=np.int64).reshape(len(own), -1)
            sums = np.unique((array[:, None, :] + array[None, :, :]).reshape(-1, array.shape[1]), axis=0)
            weight = np.array(block.weight.monoms(), dtype=np.int64)
            if len(weight) > 1 or weight.any():
                sums = np.unique((sums[:, None, :] + weight[None, :, :]).reshape(-1, sums.shape[1]), axis=0)
            found.update(map(tuple, sums.tolist()))
        for _, _, product in self.multiples:
            found.update(tuple(map(int, m)) for m in product.monoms())
        return sorted(found)

    @property
    def reaches(self) -> bool:
        """Is each monomial of the target one that the right side can have?"""
        found = set(self.support)
        return all(tuple(map(int, m)) in found for m in self.target.monoms())

    @property
    def rows(self) -> int:
        return sum(len(block.basis) for block in self.blocks)

    def require_room(self, bytes_: float = 8.0, seconds: float = 1e9) -> None:
        """Raises TooLarge where the solver would need too much memory or time."""
        widest = max((len(b.basis) for b in self.blocks), default=0)
        if widest > MAX_ROWS:
            raise TooLarge(f"a Gram matrix of {widest} rows")
        m = len(self.support)
        memory = 4 * m * m * bytes_
        flops = 20 * (m**3 / 3 + 2 * sum(m * m * len(b.basis) for b in self.blocks))
        if memory > _MOST_BYTES or flops > 1e10 * seconds:
            raise TooLarge(
                f"{m} equations and Gram matrices of {', '.join(str(len(b.basis)) for b in self.blocks[:5])}"
                f" rows: about {memory / 1e9:.1f} GB and {flops / 1e9:.0f} Gflop"
            )


@dataclass(frozen=True)
class Samples:
    """The programme at points u. Of block k: q_k(u), with orthonormal columns, and its weight there.

    lift: q = lift' ^-1 b; so b' (lift G lift') b = q' G q... see `grams`.
    """

    points: Any
    rows: list[Any]  # (U, N_k)
    weights: list[Any]  # (U,)
    triangles: list[Any]  # R of the QR factors
    target: Any  # (U,)
    free: Any  # (U, m): an orthonormal basis of the functionals that see no multiple, or None
    multiples: Any  # (U, number of multiples)
    row_scale: Any  # (U,)


def values(exponents: Sequence[Monomial], points: Any) -> Any:
    """Each monomial at each point: shape (points, monomials)."""
    table = np.array(exponents, dtype=np.int64).reshape(len(exponents), -1)
    result = np.ones((len(points), len(table)))
    for v in np.flatnonzero(table.any(axis=0)):
        powers = points[:, v : v + 1] ** np.arange(table[:, v].max() + 1)
        result *= powers[:, table[:, v]]
    return result


def poly_values(polys: Sequence[Poly], points: Any) -> Any:
    """Each polynomial at each point: shape (points, polynomials)."""
    if all(len(p) == 1 for p in polys):
        coefficients = np.array([float(to_fraction(p.leading_coefficient())) for p in polys])
        return values([tuple(map(int, p.monoms()[0])) for p in polys], points) * coefficients
    dicts = [{tuple(map(int, m)): float(to_fraction(c)) for m, c in p.to_dict().items()} for p in polys]
    monomials = sorted({m for d in dicts for m in d})
    place = {m: k for k, m in enumerate(monomials)}
    matrix = np.zeros((len(monomials), len(polys)))
    for k, d in enumerate(dicts):
        for m, c in d.items():
            matrix[place[m], k] = c
    return values(monomials, points) @ matrix if monomials else np.zeros((len(points), len(polys)))


def sample(programme: Programme, seed: int = _SEED) -> Samples:
    """The programme at as many random points of [-1, 1]^n as it has monomials."""
    draw = np.random.default_rng(seed)
    n = len(programme.target.context().names())
    points = np.cos(np.pi * draw.random((len(programme.support), n)))
    points *= 1 + 0.25 * draw.random((len(points), 1))
    bases = [poly_values(block.basis, points) for block in programme.blocks]
    weights = [poly_values([block.weight], points)[:, 0] for block in programme.blocks]
    size = sum(np.abs(w) * (b * b).sum(axis=1) for b, w in zip(bases, weights, strict=True))
    scale = 1 / np.maximum(size, 1e-12 * size.max())
    rows, triangles = [], []
    for basis in bases:
        q, r = np.linalg.qr(basis * np.sqrt(scale)[:, None])
        if np.abs(np.diag(r)).min() < 1e-10 * np.abs(np.diag(r)).max():
            raise TooLarge("a basis is dependent at the sample points in floating point")
        rows.append(q)
        triangles.append(r)
    target = poly_values([programme.target], points)[:, 0] * scale
    free = multiples = None
    if programme.multiples:
        multiples = poly_values([product for _, _, product in programme.multiples], points) * scale[:, None]
        u, s, _ = np.linalg.svd(multiples, full_matrices=True)
        free = u[:, int((s > 1e-9 * s[0]).sum()) :]
    return Samples(points, rows, weights, triangles, target, free, multiples, scale)


def grams(samples: Samples, found: Sequence[Any]) -> list[Any]:
    """Gram matrices in the programme's own bases b, from those in the orthonormal ones: R^-1 G R^-T."""
    result = []
    for r, g in zip(samples.triangles, found, strict=True):
        half = np.linalg.solve(r, g)
        h = np.linalg.solve(r, half.T)
        result.append((h + h.T) / 2)
    return result
