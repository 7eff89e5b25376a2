"""How far gains are from the edge, and the gains that are farthest from it or decay fastest.

Floating-point boxes propose, exact ones decide: what is answered is certified for gains of a few digits.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

import numpy as np

from symctrl.domains.boxes import Array, Box, Boxes
from symctrl.domains.domain import Unsupported
from symctrl.gains.definite import FAILS, HOLDS, OPEN
from symctrl.gains.maps import together
from symctrl.gains.requirement import Cases, Requirement, known, state

CANDIDATES = 512
ROUNDS = 9
NARROWER = 0.5  # of the ranges, from round to round
STEPS = 16  # of bisection
FINEST = 10_000  # a margin is a multiple of one part in this many
GOOD = 0.99  # of the best objective is what rounded gains must reach
MOST_DIGITS = 6
MOST_CORNERS = 64
MOST_CUTS, MOST_PARTS = 24, 4096

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
    """Exactly in one box, or else, rounded outward, in each of the parts into which that is cut."""
    ends = {name: (value, value) for name, value in gains.items()}
    for name in varied:
        low, high = sorted((gains[name] * (1 - r), gains[name] * (1 + r)))
        ends[name] = low, high
    return all(_holds_within(one, ends, cases) for one in requirements)


def _holds_within(one: Requirement, ends: Ranges, cases: Cases) -> bool:
    exact, floats = Boxes(exact=True), Boxes()
    try:
        found = state(one, {n: exact.between(*pair) for n, pair in ends.items()}, cases, exact)
        if found[0] != OPEN:
            return bool(found[0] == HOLDS)
    except Unsupported:
        pass
    boxes = {name: floats.between(*pair) for name, pair in ends.items()}
    wide = [name for name in one.names if name in ends and ends[name][0] < ends[name][1]]
    for k in range(MOST_CUTS):
        found = known(one, boxes, cases, floats)
        open_ = np.flatnonzero(found == OPEN)
        if (found == FAILS).any() or not open_.size:
            return not open_.size and bool((found == HOLDS).all())
        if not wide or open_.size > MOST_PARTS:
            return False
        taken = open_ if found.size == boxes[wide[0]].low.size else np.arange(boxes[wide[0]].low.size)
        boxes |= {n: Box(boxes[n].low[taken], boxes[n].high[taken]) for n in wide}
        boxes |= _halved({n: boxes[n] for n in wide}, wide[k % len(wide)])
    return False


def _halved(boxes: Mapping[str, Box], name: str) -> dict[str, Box]:
    """Each box as two, cut across one gain."""
    made = {n: Box(np.tile(box.low, 2), np.tile(box.high, 2)) for n, box in boxes.items()}
    low, high = boxes[name].low, boxes[name].high
    middle = low / 2 + high / 2
    made[name] = Box(np.concatenate([low, middle]), np.concatenate([middle, high]))
    return made


def largest_margin(among: Among, varied: Sequence[str]) -> Best:
    """Gains with a margin as large as is found."""

    def certified(gains: Gains) -> Fraction | None:
        at = {**among.values, **gains}
        if not _all_hold(among.requirements, at, (), among.cases, Fraction(0)):
            return None
        return margin(among.requirements, at, varied, among.cases)

    return _best(among, lambda at: _radii(among, at, varied), certified)


def _radii(among: Among, at: Mapping[str, Array], varied: Sequence[str]) -> Array:
    """The margin of each candidate as the corners of its box show it, in floating point; -1 where it is not
    feasible.
    """
    domain, count = Boxes(), len(next(iter(at.values())))
    signs = _signs(len(varied))

    def good(r: Array) -> Array:
        boxes = {}
        for name, sign in zip(varied, signs.T, strict=True):
            centre = at[name] if name in at else np.full(count, float(among.values[name]))
            ends = (centre[:, None] * (1 + r[:, None] * sign)).ravel()
            boxes[name] = Box(ends, ends)
        size = count * len(signs)
        found = together(among.requirements, among.boxes(boxes, domain), among.cases, domain, size)
        return np.asarray((found == HOLDS).reshape(count, -1).all(axis=1))

    low, high = np.zeros(count), np.ones(count)
    for _ in range(STEPS):
        r = (low + high) / 2
        found = good(r)
        low, high = np.where(found, r, low), np.where(found, high, r)
    return np.where(good(low), low, -1.0)


def _signs(count: int) -> Array:
    """The corners of a box, or some of them where there are many."""
    if 2**count <= MOST_CORNERS:
        return np.array(list(product((-1.0, 1.0), repeat=count)))
    return np.random.default_rng(1).choice((-1.0, 1.0), (MOST_CORNERS, count))


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
