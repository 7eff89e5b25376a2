"""Lower bounds of the largest eigenvalue of a Laplacian: integer vectors and their exact Rayleigh quotients.

Floats propose, after Lanczos 1950 (Golub and Van Loan, Matrix Computations, chapter 10); what leaves this
module is an integer vector x with the quotient x'Lx / x'x in integers.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import sqrt

import numpy as np

from symctrl.spectral.network import Array, Network

INT64 = 2**63
BITS = 20  # of the entries of a rounded vector, where their squares can be added in int64
SEED = 1


def quotient(network: Network, x: Array) -> Fraction:
    """x'Lx / x'x for integers x, not all zero, shape (nodes,)."""
    top = int(np.abs(x).max())
    if max(4 * network.edges, network.nodes) * top**2 >= INT64:
        x = x.astype(object)
    difference = x[network.a] - x[network.b]
    return Fraction(int((difference * difference).sum()), int((x * x).sum()))


def rounded(network: Network, x: Array) -> Array:
    """Integers in nearly the direction of the floats x, short enough for sums of their squares in int64."""
    room = 60 - max(4 * network.edges, network.nodes).bit_length()
    return np.rint(x * (2 ** min(BITS, room // 2) / np.abs(x).max())).astype(np.int64)


def laplacian_times(network: Network) -> Callable[[Array], Array]:
    """The product of L with floats."""
    degrees, adjacency = network.degrees.astype(float), network.adjacency
    return lambda x: degrees * x - adjacency @ x


def signless_times(network: Network) -> Callable[[Array], Array]:
    """The product of degrees plus adjacency with floats."""
    degrees, adjacency = network.degrees.astype(float), network.adjacency
    return lambda x: degrees * x + adjacency @ x


def dot(x: Array, y: Array) -> float:
    """The scalar product, the same for any number of threads."""
    return float((x * y).sum())


def lanczos(times: Callable[[Array], Array], size: int, steps: int, start: Array | None = None) -> Array:
    """Floats, shape (size,), near the eigenvector of the largest eigenvalue of a symmetric matrix.

    The basis is made twice, not kept, so that the memory does not grow with the steps.
    """
    if start is None:
        start = np.random.default_rng(SEED).standard_normal(size)
    diagonal, beside = _tridiagonal(times, start, steps)
    chosen = _largest(diagonal, beside)
    found = np.zeros(size)
    before, now = np.zeros(size), start / sqrt(dot(start, start))
    for k, c in enumerate(chosen):
        found += c * now
        if k < len(chosen) - 1:
            after = times(now) - diagonal[k] * now - (beside[k - 1] * before if k else 0)
            before, now = now, after / beside[k]
    return found


def _tridiagonal(
    times: Callable[[Array], Array], start: Array, steps: int
) -> tuple[list[float], list[float]]:
    """The diagonal and what stands beside it."""
    before, now = np.zeros(len(start)), start / sqrt(dot(start, start))
    diagonal: list[float] = []
    beside: list[float] = []
    for k in range(steps):
        after = times(now)
        diagonal.append(dot(now, after))
        after -= diagonal[k] * now + (beside[k - 1] * before if k else 0)
        length = sqrt(dot(after, after))
        if k == steps - 1 or length < 1e-10 * (1 + abs(diagonal[0])):
            break
        beside.append(length)
        before, now = now, after / length
    return diagonal, beside


def _largest(diagonal: list[float], beside: list[float]) -> Array:
    from scipy.linalg import eigh_tridiagonal

    last = len(diagonal) - 1
    return eigh_tridiagonal(diagonal, beside, select="i", select_range=(last, last))[1][:, 0]
