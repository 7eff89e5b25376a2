"""How far gains are from the edge, and the gains that are farthest from it or decay fastest.

Floating-point boxes propose, exact ones decide: what is answered is certified for gains of a few digits.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from symctrl.domains.boxes import Array, Box, Boxes
from symctrl.domains.domain import Unsupported
from symctrl.gains.definite import HOLDS
from symctrl.gains.maps import together
from symctrl.gains.requirement import Cases, Requirement, state

CANDIDATES = 4096
ROUNDS = 6
NARROWER = 0.35  # of the ranges, from round to round
STEPS = 24  # of bisection
FINEST = 10_000  # a margin is a multiple of one part in this many
GOOD = 0.99  # of the best objective is what rounded gains must reach
MOST_DIGITS = 6

Gains = Mapping[str, Fraction]
Ranges = Mapping[str, tuple[Fraction, Fraction]]


@dataclass(frozen=True)
class Best:
    """gains: of few digits. objective: certified for them."""

    gains: Gains
    objective: Fraction


def margin(
    requirements: Sequence[Requirement], gains: Gains, varied: Sequence[str], cases: Cases
) -> Fraction:
    """The largest multiple r of 1/FINEST that is found, such that all gains within the factors 1 - r and
    1 + r meet the requirements; 0 where the point itself does not. Exact.
    """
    low, high = 0, FINEST
    while high - low > 1:
        middle = (low + high) // 2
        if _all_hold(requirements, gains, varied, cases, Fraction(middle, FINEST)):
            low = middle
        else:
            high = middle
    return Fraction(low, FINEST)


def _all_hold(
    requirements: Sequence[Requirement], gains: Gains, varied: Sequence[str], cases: Cases, r: Fraction
) -> bool:
    domain = Boxes(exact=True)
    boxes = {name: domain.between(value, value) for name, value in gains.items()}
    boxes |= {n: domain.between(gains[n] * (1 - r), gains[n] * (1 + r)) for n in varied}
    try:
        return all(bool((state(one, boxes, cases, domain) == HOLDS).all()) for one in requirements)
    except Unsupported:
        return False


def largest_margin(requirements: Sequence[Requirement], gains: Gains, ranges: Ranges, cases: Cases) -> Best:
    """Gains within the ranges with a margin as large as is found."""

    def radius(candidates: Mapping[str, Array]) -> Array:
        return _radii(requirements, gains, candidates, cases)

    def certified(chosen: Gains) -> Fraction:
        return margin(requirements, {**gains, **chosen}, list(ranges), cases)

    return _best(ranges, radius, certified)


def _radii(requirements: Sequence[Requirement], gains: Gains, at: Mapping[str, Array], cases: Cases) -> Array:
    """The margin of each candidate in floating point."""
    domain, count = Boxes(), len(next(iter(at.values())))
    fixed = {name: domain.between(value, value) for name, value in gains.items()}
    low, high = np.full(count, -1e-9), np.ones(count)
    for _ in range(STEPS):
        r = (low + high) / 2
        boxes = {**fixed, **{n: Box(x * (1 - r), x * (1 + r)) for n, x in at.items()}}
        good = together(requirements, boxes, cases, domain, count) == HOLDS
        low, high = np.where(good, r, low), np.where(good, high, r)
    return low


def fastest(
    requirements: Sequence[Requirement],
    rate: Callable[[Mapping[str, Box], Boxes], Box],
    gains: Gains,
    ranges: Ranges,
    cases: Cases,
) -> Best:
    """Feasible gains within the ranges with a rate of decay as large as is found."""
    floats, exact = Boxes(), Boxes(exact=True)
    fixed = {name: floats.between(value, value) for name, value in gains.items()}

    def speed(candidates: Mapping[str, Array]) -> Array:
        count = len(next(iter(candidates.values())))
        boxes = {**fixed, **{name: Box(x, x) for name, x in candidates.items()}}
        good = together(requirements, boxes, cases, floats, count) == HOLDS
        return np.where(good, np.broadcast_to(rate(boxes, floats).low, count), -1.0)

    def certified(chosen: Gains) -> Fraction:
        at = {**gains, **chosen}
        if not _all_hold(requirements, at, (), cases, Fraction(0)):
            return Fraction(0)
        return Fraction(rate({n: exact.between(v, v) for n, v in at.items()}, exact).low[0])

    return _best(ranges, speed, certified)


def _best(
    ranges: Ranges, objective: Callable[[Mapping[str, Array]], Array], certified: Callable[[Gains], Fraction]
) -> Best:
    """The best of random candidates, in ranges that close in on it; then with as few digits as will do."""
    generator = np.random.default_rng(1)
    spans = {name: (float(lo), float(hi)) for name, (lo, hi) in ranges.items()}
    best, value = {name: (lo + hi) / 2 for name, (lo, hi) in spans.items()}, -np.inf
    for _ in range(ROUNDS):
        drawn = {name: generator.uniform(lo, hi, CANDIDATES) for name, (lo, hi) in spans.items()}
        drawn = {name: np.append(x, best[name]) for name, x in drawn.items()}
        found = objective(drawn)
        k = int(np.argmax(found))
        best, value = {name: float(x[k]) for name, x in drawn.items()}, float(found[k])
        spans = {name: _closer(ranges[name], span, best[name]) for name, span in spans.items()}
    return _rounded(best, value, ranges, certified)


def _closer(
    whole: tuple[Fraction, Fraction], span: tuple[float, float], centre: float
) -> tuple[float, float]:
    half = (span[1] - span[0]) * NARROWER / 2
    return max(float(whole[0]), centre - half), min(float(whole[1]), centre + half)


def _rounded(
    best: Mapping[str, float], value: float, ranges: Ranges, certified: Callable[[Gains], Fraction]
) -> Best:
    found = Best({}, Fraction(-1))
    for digits in range(1, MOST_DIGITS + 1):
        gains = {name: _within(Fraction(f"{x:.{digits}g}"), ranges[name]) for name, x in best.items()}
        made = Best(gains, certified(gains))
        if made.objective > found.objective:
            found = made
        if float(found.objective) >= GOOD * value:
            break
    return found


def _within(value: Fraction, span: tuple[Fraction, Fraction]) -> Fraction:
    return min(max(value, span[0]), span[1])
