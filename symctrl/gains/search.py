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

CANDIDATES = 512
ROUNDS = 9
NARROWER = 0.5  # of the ranges, from round to round
STEPS = 16  # of bisection
FINEST = 10_000  # a margin is a multiple of one part in this many
GOOD = 0.99  # of the best objective is what rounded gains must reach
MOST_DIGITS = 6

Gains = Mapping[str, Fraction]
Ranges = Mapping[str, tuple[Fraction, Fraction]]
Rate = Callable[[Mapping[str, Box], Boxes], Box]


@dataclass(frozen=True)
class Best:
    """gains: of few digits. objective: certified for them; None where no feasible gains were found."""

    gains: Gains
    objective: Fraction | None


@dataclass(frozen=True)
class Among:
    """Where is looked: gains within the ranges, with the values of the others, that meet the requirements."""

    requirements: Sequence[Requirement]
    values: Gains
    ranges: Ranges
    cases: Cases

    def boxes(self, at: Mapping[str, Box], domain: Boxes) -> dict[str, Box]:
        return {name: domain.between(value, value) for name, value in self.values.items()} | dict(at)


def margin(
    requirements: Sequence[Requirement], gains: Gains, varied: Sequence[str], cases: Cases
) -> Fraction:
    """The largest multiple r of 1/FINEST below 1 that is found, such that all gains within the factors 1 - r
    and 1 + r meet the requirements; for gains that meet them.
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
    """Exactly, or where that is not to be had, rounded outward."""

    def holds(one: Requirement) -> bool:
        for domain in (Boxes(exact=True), Boxes()):
            boxes = {name: domain.between(value, value) for name, value in gains.items()}
            ends = {name: sorted((gains[name] * (1 - r), gains[name] * (1 + r))) for name in varied}
            boxes |= {name: domain.between(low, high) for name, (low, high) in ends.items()}
            try:
                return bool((state(one, boxes, cases, domain) == HOLDS).all())
            except Unsupported:
                continue
        return False

    return all(map(holds, requirements))


def largest_margin(among: Among, varied: Sequence[str]) -> Best:
    """Gains with a margin as large as is found."""

    def certified(gains: Gains) -> Fraction | None:
        at = {**among.values, **gains}
        if not _all_hold(among.requirements, at, (), among.cases, Fraction(0)):
            return None
        return margin(among.requirements, at, varied, among.cases)

    return _best(among, lambda at: _radii(among, at, varied), certified)


def _radii(among: Among, at: Mapping[str, Array], varied: Sequence[str]) -> Array:
    """The margin of each candidate in floating point; -1 where it is not feasible."""
    domain, count = Boxes(), len(next(iter(at.values())))
    centre: dict[str, Array] = {
        name: np.array([float(among.values[name])]) for name in varied if name not in at
    }
    centre |= at

    def good(r: Array) -> Array:
        boxes = {name: Box(x * (1 - r), x * (1 + r)) for name, x in centre.items()}
        return together(among.requirements, among.boxes(boxes, domain), among.cases, domain, count) == HOLDS

    low, high = np.zeros(count), np.ones(count)
    for _ in range(STEPS):
        r = (low + high) / 2
        found = good(r)
        low, high = np.where(found, r, low), np.where(found, high, r)
    return np.where(good(low), low, -1.0)


def fastest(among: Among, rate: Rate) -> Best:
    """Feasible gains with a rate of decay as large as is found."""
    floats = Boxes()

    def speed(at: Mapping[str, Array]) -> Array:
        count = len(next(iter(at.values())))
        boxes = among.boxes({name: Box(x, x) for name, x in at.items()}, floats)
        good = together(among.requirements, boxes, among.cases, floats, count) == HOLDS
        found = np.broadcast_to(rate(boxes, floats).low, count)
        return np.where(good & np.isfinite(found), found, -1.0)

    def certified(gains: Gains) -> Fraction | None:
        at = {**among.values, **gains}
        if not _all_hold(among.requirements, at, (), among.cases, Fraction(0)):
            return None
        for domain in (Boxes(exact=True), floats):
            try:
                low = rate({n: domain.between(v, v) for n, v in at.items()}, domain).low[0]
            except Unsupported:
                continue
            return Fraction(low) if domain.exact or np.isfinite(low) else None
        return None

    return _best(among, speed, certified)


def _best(
    among: Among,
    objective: Callable[[Mapping[str, Array]], Array],
    certified: Callable[[Gains], Fraction | None],
) -> Best:
    """The best of random candidates, in ranges that close in on it; then with as few digits as will do."""
    generator = np.random.default_rng(1)
    spans = {name: (float(lo), float(hi)) for name, (lo, hi) in among.ranges.items()}
    best, value = {name: (lo + hi) / 2 for name, (lo, hi) in spans.items()}, -np.inf
    for _ in range(ROUNDS):
        drawn = {name: generator.uniform(lo, hi, CANDIDATES) for name, (lo, hi) in spans.items()}
        drawn = {name: np.append(x, best[name]) for name, x in drawn.items()}
        found = objective(drawn)
        k = int(np.argmax(found))
        best, value = {name: float(x[k]) for name, x in drawn.items()}, float(found[k])
        if value < 0:  # none is feasible yet: look everywhere again
            continue
        spans = {name: _closer(among.ranges[name], span, best[name]) for name, span in spans.items()}
    return _rounded(best, value, among.ranges, certified)


def _closer(
    whole: tuple[Fraction, Fraction], span: tuple[float, float], centre: float
) -> tuple[float, float]:
    half = (span[1] - span[0]) * NARROWER / 2
    return max(float(whole[0]), centre - half), min(float(whole[1]), centre + half)


def _rounded(
    best: Mapping[str, float],
    value: float,
    ranges: Ranges,
    certified: Callable[[Gains], Fraction | None],
) -> Best:
    found = Best({}, None)
    for digits in range(1, MOST_DIGITS + 1):
        gains = {name: _within(Fraction(f"{x:.{digits}g}"), ranges[name]) for name, x in best.items()}
        objective = certified(gains)
        if objective is not None and (found.objective is None or objective > found.objective):
            found = Best(gains, objective)
        if found.objective is not None and float(found.objective) >= GOOD * value:
            break
    return found


def _within(value: Fraction, span: tuple[Fraction, Fraction]) -> Fraction:
    return min(max(value, span[0]), span[1])
