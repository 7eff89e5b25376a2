"""The face of the cone on which the Gram matrices of a programme lie, exactly, from kernels in many digits.

If p = b' G b vanishes somewhere, every Gram matrix of p has a kernel, and none is definite. The polynomials
w'b that G can use are those with w'v = 0 for all v in the kernel. They have rational bases even where the
kernel is irrational (then its conjugates are in it too): LLL finds the integer relations w among the digits
of v (Lenstra, Lenstra and Lovasz, 1982). In the new basis the programme has an interior, or the next face is
looked for. A wrong relation costs the proof, never its correctness.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import log10
from typing import Any

from flint import arb, fmpz_mat

from symctrl.sos.programme import Block, Programme
from symctrl.sos.ring import Poly

_SMALL = 1e-9  # relative to the largest pivot, of pivots that may belong to the kernel
_MOST_CUTS = 3
_GAP = 1e-5  # between the pivots of the kernel and the others


def reduced(programme: Programme, grams: list[Any], floor: float) -> Iterator[Programme]:
    """The programme over the bases of its face; several where it is unclear what belongs to the kernel.

    floor: relative to the largest pivot, what is as good as zero.
    """
    factors = [_pivoted(g) for g in grams]
    largest = max((p for _, ps, _ in factors for p in ps[:1]), default=0.0)
    if largest <= 0:
        return
    every = sorted((max(p / largest, floor) for _, ps, _ in factors for p in ps), reverse=True)
    for cut in _cuts(every):
        noise = max((p for p in every if p < cut), default=floor)
        digits = max(6, int(-log10(noise)) - 3)
        blocks = []
        for block, (order, ps, rows) in zip(programme.blocks, factors, strict=True):
            rank = sum(p / largest >= cut for p in ps)
            if rank == len(ps):
                blocks.append(block)
                continue
            basis = _relations(block, _kernel(order, rows, rank), digits)
            if basis:
                blocks.append(Block(block.product, block.weight, tuple(basis), block.multiplier))
        smaller = Programme(programme.target, tuple(blocks), programme.multiples)
        if smaller.rows < programme.rows and smaller.reaches:
            yield smaller


def _cuts(pivots: list[float]) -> list[float]:
    """Numbers between the pivots of the range and those of the kernel: in wide gaps, from the top."""
    found = [a * (b / a) ** 0.5 for a, b in pairwise(pivots) if b < _SMALL and b / a < _GAP]
    return found[:_MOST_CUTS]


def _pivoted(g: Any) -> tuple[list[int], list[float], list[list[Any]]]:
    """(order, pivots, rows of L) of an L D L' with diagonal pivoting, in the scale of a unit diagonal."""
    n = g.nrows()
    work = [[a.mid() for a in row] for row in g.tolist()]
    order = list(range(n))
    pivots: list[float] = []
    rows: list[list[Any]] = [[] for _ in range(n)]
    for k in range(n):
        best = max(range(k, n), key=lambda i: work[order[i]][order[i]])
        order[k], order[best] = order[best], order[k]
        p = order[k]
        pivot = work[p][p]
        pivots.append(max(float(pivot), 0.0))
        if not pivot > 0:
            pivots += [0.0] * (n - k - 1)
            break
        for i in order[k + 1 :]:
            factor = (work[i][p] / pivot).mid()
            rows[i].append(factor)
            for j in order[k + 1 :]:
                work[i][j] = (work[i][j] - factor * work[p][j]).mid()
    return order, pivots, rows


def _kernel(order: list[int], rows: list[list[Any]], rank: int) -> list[list[Any]]:
    """For each index beyond the rank, v with 1 there and L11' v_1 = -l: G v is nearly zero."""
    n = len(order)
    kernel = []
    for free in range(rank, n):
        v: list[Any] = [arb(0)] * n
        v[order[free]] = arb(1)
        for k in range(rank - 1, -1, -1):
            total = rows[order[free]][k]
            for later in range(k + 1, rank):
                total += rows[order[later]][k] * v[order[later]]
            v[order[k]] = (-total).mid()
        kernel.append(v)
    return kernel


def _relations(block: Block, kernel: list[list[Any]], digits: int) -> list[Poly]:
    """Integer polynomials w'b with w'v = 0, as far as the digits say."""
    n, m = len(block.basis), len(kernel)
    if m == n:
        return []
    scale = arb(10) ** digits
    tails = [
        [int((v[i] * scale / _largest(v)).mid().floor().unique_fmpz() or 0) for v in kernel] for i in range(n)
    ]
    lattice = fmpz_mat([[int(i == j) for j in range(n)] + tails[i] for i in range(n)]).lll()
    # A relation by chance has about this size.
    chance = 10.0 ** (digits * m / n)
    basis = []
    for row in lattice.tolist():
        w, tail = [int(a) for a in row[:n]], [int(a) for a in row[n:]]
        size = max(map(abs, w))
        if size and size < max(2.0, chance**0.5) and max(map(abs, tail)) <= 2 * sum(map(abs, w)):
            basis.append(sum((b * c for b, c in zip(block.basis, w, strict=True) if c), 0 * block.basis[0]))
    return basis


def _largest(v: list[Any]) -> Any:
    return max((abs(a) for a in v), key=float)
