"""Upper bounds of the largest eigenvalue of a Laplacian: positive integer vectors.

x > 0 with (t - d_i) x_i >= the sum of x over the neighbours of i, for each node i, shows that no eigenvalue
of degrees plus adjacency exceeds t (Collatz 1942), hence none of the Laplacian (`kernel/laplacian.py`). With
x the degrees, t is the largest sum of a node's degree and the mean degree of its neighbours (Merris, Linear
Algebra Appl. 285, 1998): never above the largest d_u + d_v over the edges (Anderson and Morley 1985), nor
above 2 d. Vectors for a smaller t come from floating-point solutions of (t I - D - A) x = 1, and are checked
in integers.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import ceil

import numpy as np

from symctrl.spectral.network import Array, Network
from symctrl.spectral.witness import INT64, dot, lanczos, signless_times

DIGITS = 6  # of a bound that is searched for
GAP = 1e-6  # at which the search is over
STEP = (0.05, 0.2, 0.5, 0.5, 0.5)  # of the way from the least conceivable bound to the present, by misses
ITERATIONS = 600  # of conjugate gradients, for one vector
IN_ALL = 2500
FILL = 500  # edges more than nodes up to which a direct solution is cheap
STEPS = 60


@dataclass(frozen=True)
class Positive:
    """No eigenvalue of L exceeds `bound`, by the integers x; strict: none reaches it."""

    bound: Fraction
    x: Array
    strict: bool = False


def by_degrees(network: Network) -> Positive:
    """The bound of Merris."""
    x = np.maximum(network.degrees, 1)
    bound = least_bound(network, x)
    return Positive(bound, x, dominates(network, x, bound, strict=True))


def least_bound(network: Network, x: Array) -> Fraction:
    """The least t for which the positive integers x will do: the largest (d_i x_i + sum of x_j) / x_i."""
    top = int(x.max()) * 2 * int(network.degrees.max(initial=1))
    exact = x if top < INT64 else x.astype(object)
    tops = network.degrees * exact + network.neighbour_sums(exact)
    ratios = tops.astype(float) / exact.astype(float)
    near = np.flatnonzero(ratios >= ratios.max() * (1 - 1e-12))
    pairs = set(zip(tops[near].tolist(), exact[near].tolist(), strict=True))
    return max(Fraction(a, b) for a, b in pairs)


def dominates(network: Network, x: Array, t: Fraction, strict: bool = False) -> bool:
    """Is x > 0, and (t - d_i) x_i at least (strict: above) the sum of x_j, for each node, in integers?"""
    p, q = t.numerator, t.denominator
    if x.min() <= 0:
        return False
    widest = max(abs(p), q * int(network.degrees.max(initial=1)))
    if 2 * widest * int(x.max()) >= INT64:
        x = x.astype(object)
    factors = p - q * network.degrees.astype(x.dtype)
    slack = factors * x - q * network.neighbour_sums(x)
    return bool((slack > 0).all() if strict else (slack >= 0).all())


class Search:
    """Positive vectors for ever smaller bounds, from the one by degrees on."""

    def __init__(self, network: Network) -> None:
        self.network = network
        self.best = by_degrees(network)
        self.least = 0.0  # an eigenvalue of degrees plus adjacency is at least this, as floats have it
        self.work = 0

    def tighten(self, enough: Fraction, thresholds: tuple[Fraction, ...] = (), strict: bool = False) -> None:
        """Better bounds, down to `enough`, the thresholds first, until the work is done.

        strict: a threshold that is the bound already is wanted as one that no eigenvalue reaches.
        """
        if self.least == 0.0:
            times = signless_times(self.network)
            self._raise_least(lanczos(times, self.network.nodes, STEPS))
        self.least = max(self.least, float(enough))
        for t in sorted(thresholds, reverse=True):
            if enough < t < self.best.bound or (strict and t == self.best.bound and not self.best.strict):
                self.at(t)
        misses = 0
        while misses < len(STEP) and self.work < IN_ALL:
            high = float(self.best.bound)
            gap = high - self.least
            if gap <= GAP or high - float(enough) <= GAP:
                return
            t = _written(self.least + STEP[misses] * gap, gap * STEP[0])
            if t >= self.best.bound or not self.at(t):
                misses += 1

    def at(self, t: Fraction) -> bool:
        """Is there a vector for t? If so, it is kept where it is better."""
        x = self._solution(float(t))
        if x is None:
            return False
        scaled = x * (2.0 * float(self.network.degrees.max()) + 2.0)
        if scaled.min() <= 0 or not np.isfinite(scaled).all():
            return False
        integers = _integers(np.ceil(scaled))
        if not dominates(self.network, integers, t, strict=True):
            return False
        reached = _written(float(least_bound(self.network, integers)), 0.0)
        bound = reached if reached < t and dominates(self.network, integers, reached) else t
        if bound < self.best.bound or not self.best.strict:
            strict = dominates(self.network, integers, bound, strict=True)
            self.best = Positive(bound, integers, strict)
        self._raise_least(x)
        return True

    def _raise_least(self, x: Array) -> None:
        product = signless_times(self.network)(x)
        self.least = max(self.least, dot(x, product) / dot(x, x))

    def _solution(self, t: float) -> Array | None:
        """Floats with (t I - D - A) x near 1, or None."""
        if self.network.edges <= self.network.nodes + FILL:
            return _direct(self.network, t)
        margin = t - self.network.degrees
        if margin.min() <= 0:
            return None
        adjacency = self.network.adjacency
        x = 1 / margin
        rest = adjacency @ x
        ready = rest / margin
        way, size = ready, dot(rest, ready)
        for _ in range(ITERATIONS):
            if np.abs(rest).max() < 0.25:
                return x
            self.work += 1
            product = margin * way - adjacency @ way
            curvature = dot(way, product)
            if curvature <= 0:
                self.least = max(self.least, t)
                return None
            x = x + (size / curvature) * way
            rest = rest - (size / curvature) * product
            ready = rest / margin
            size, last = dot(rest, ready), size
            way = ready + (size / last) * way
        return None


def _direct(network: Network, t: float) -> Array | None:
    from scipy import sparse
    from scipy.sparse.linalg import splu

    matrix = sparse.diags(t - network.degrees) - network.adjacency
    try:
        return splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A").solve(np.ones(network.nodes))
    except RuntimeError:  # exactly singular
        return None


def _integers(x: Array) -> Array:
    """The floats x, which are integers, as such."""
    if x.max() < 2.0**62:
        return x.astype(np.int64)
    return np.array([int(a) for a in x.tolist()], dtype=object)


def _written(value: float, room: float) -> Fraction:
    """A number of few decimal digits from the value up, by at most about the room."""
    digits = 0
    while digits < DIGITS and 10.0**-digits > room:
        digits += 1
    return Fraction(ceil(Fraction(value) * 10**digits), 10**digits)
