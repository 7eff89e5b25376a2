"""A condition on gains as something that can be evaluated over boxes of gains.

A case is a symbol that is no gain: the largest eigenvalue of the graph at hand, the number of a craft's
neighbours, a constant that the designer may choose. A condition holds where it holds for all values in the
case's hull; it fails where it fails for all values of one of the ranges in which the case is known to take a
value.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np

from symctrl.bounds import Statement
from symctrl.domains.boxes import Array, Box, Boxes, quiet, rounded
from symctrl.domains.domain import Domain, Unsupported
from symctrl.domains.tangent import NotDifferentiable, Pair
from symctrl.evaluate import Environment
from symctrl.gains.definite import FAILS, HOLDS, OPEN, definite_in
from symctrl.problem import Problem, split
from symctrl.reach import Reach

Interval = tuple[Fraction, Fraction | None]  # None: without an upper end
DEGREE = "neighbours of i"  # the case that sums over the neighbours of a node read


@dataclass(frozen=True)
class Case:
    """hull: the condition must hold for all of it. ranges: in each the case takes a value."""

    hull: tuple[Fraction, Fraction]
    ranges: tuple[Interval, ...]


Cases = Mapping[str, Case]
Gains = Mapping[str, Box]


@dataclass(frozen=True)
class Requirement:
    """One claim about gains. kind: zero, nonzero, positive, nonnegative, positive_definite or
    positive_semidefinite, of the values that the problem's claim lists.

    statement: as it is written. names: the gains and cases that it reads.
    """

    statement: Statement
    problem: Problem
    kind: str
    names: tuple[str, ...]


def state(requirement: Requirement, gains: Gains, cases: Cases, domain: Boxes) -> Array:
    """HOLDS, FAILS or OPEN for each box: the closed box, edges and all. Raises Unsupported for an operation
    that boxes do not know, and in exact arithmetic for one that may be undefined.
    """
    read = [name for name in requirement.names if name in cases]
    hull = {name: domain.between(*cases[name].hull) for name in read}
    found = _decided(requirement, {**gains, **hull}, domain)
    if not read:
        return found
    fails = np.zeros(found.shape, bool)
    for ranges in choices(requirement, cases):
        fails = fails | (in_ranges(requirement, gains, ranges, domain) == FAILS)
    return np.where(found == HOLDS, HOLDS, np.where(fails, FAILS, OPEN))


def known(requirement: Requirement, gains: Gains, cases: Cases, domain: Boxes) -> Array:
    """As `state`; OPEN in all boxes where an operation is not known."""
    try:
        return state(requirement, gains, cases, domain)
    except Unsupported:
        return np.array([OPEN])


def choices(requirement: Requirement, cases: Cases) -> Iterator[Mapping[str, Interval]]:
    """A range for each case that is read: in each combination the cases take values."""
    read = [name for name in requirement.names if name in cases]
    for ranges in product(*(cases[name].ranges for name in read)):
        yield dict(zip(read, ranges, strict=True))


def in_ranges(requirement: Requirement, gains: Gains, ranges: Mapping[str, Interval], domain: Boxes) -> Array:
    """The state with each case anywhere in a range. One without an upper end has floating-point ends."""
    if domain.exact and any(high is None for _, high in ranges.values()):
        gains, domain = _as_floats(gains), Boxes()
    chosen = {name: _between(domain, *one) for name, one in ranges.items()}
    return _decided(requirement, {**gains, **chosen}, domain)


def _between(domain: Boxes, low: Fraction, high: Fraction | None) -> Box:
    if high is not None:
        return domain.between(low, high)
    return Box(np.array([rounded(low, -np.inf)]), np.array([np.inf]))


def _decided(requirement: Requirement, values: Gains, domain: Boxes) -> Array:
    if requirement.kind.startswith("positive_"):
        tree, strict = requirement.problem.claim.matrix, requirement.kind == "positive_definite"
        assert tree is not None
        return definite_in(tree, strict, outputs(requirement, values, domain), domain)
    found = [sign(requirement.kind, box) for box in tight(requirement, values, domain)]
    return np.asarray(np.min(np.broadcast_arrays(*found), axis=0))


def sign(kind: str, box: Box) -> Array:
    """HOLDS, FAILS or OPEN for a value in the box."""
    low, high = box.low, box.high
    if kind == "zero":
        holds, fails = (low == 0) & (high == 0), (low > 0) | (high < 0)
    elif kind == "nonzero":
        holds, fails = (low > 0) | (high < 0), (low == 0) & (high == 0)
    elif kind == "positive":
        holds, fails = low > 0, high <= 0
    else:
        holds, fails = low >= 0, high < 0
    return np.where(holds, HOLDS, np.where(fails, FAILS, OPEN))


def tight(requirement: Requirement, values: Gains, domain: Boxes) -> list[Box]:
    """Enclosures of the claim's values: where one is monotone in a symbol, from the symbol's ends."""
    direct = outputs(requirement, values, domain)
    wide = [name for name in requirement.names if (values[name].low != values[name].high).any()]
    if not wide:
        return direct
    slopes = {name: found for name in wide if (found := _slopes(requirement, values, name))}
    if not slopes:
        return direct
    return [_at_ends(requirement, values, domain, k, slopes, box) for k, box in enumerate(direct)]


def _at_ends(
    requirement: Requirement,
    values: Gains,
    domain: Boxes,
    k: int,
    slopes: Mapping[str, Sequence[Box | None]],
    direct: Box,
) -> Box:
    low_at, high_at = dict(values), dict(values)
    for name, of in slopes.items():
        slope = of[k]
        if slope is None:
            continue
        box, rises = values[name], slope.low >= 0
        falls = (slope.high <= 0) & ~rises
        low_at[name] = Box(np.where(falls, box.high, box.low), np.where(rises, box.low, box.high))
        high_at[name] = Box(np.where(rises, box.high, box.low), np.where(falls, box.low, box.high))
    low = outputs(requirement, low_at, domain)[k].low
    high = outputs(requirement, high_at, domain)[k].high
    return Box(np.maximum(direct.low, low), np.minimum(direct.high, high))


def _slopes(requirement: Requirement, values: Gains, name: str) -> list[Box | None]:
    """The derivative of each value by a symbol, in floating point; None where it is zero. None of all where
    one is not known.

    Where a value has a kink, what is enclosed is its generalized gradient, for which the mean value theorem
    holds too (Lebourg).
    """
    made = _Along(requirement.problem, _as_floats(values), name)
    try:
        with quiet():
            found = made.outputs(requirement.problem.claim.listing, {"i": "i"}, 1)
    except (Unsupported, NotDifferentiable):
        return []
    return [pair.derivative for pair in found]


def _as_floats(values: Gains) -> Gains:
    """The boxes rounded outward."""
    return {key: Box(_floats(box.low, -np.inf), _floats(box.high, np.inf)) for key, box in values.items()}


def _floats(ends: Array, towards: float) -> Array:
    return np.array([rounded(x, towards) for x in ends]) if ends.dtype == object else ends


def outputs(requirement: Requirement, values: Mapping[str, Any], domain: Domain[Any]) -> list[Any]:
    """The values that the claim lists."""
    made = Environment(requirement.problem, domain, values.__getitem__, _Degrees(values))
    with quiet():
        return made.outputs(requirement.problem.claim.listing, {"i": "i"})


class _Degrees:
    """A sum over the neighbours of a node of what is the same for all of them."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self.values = values

    def value(self, at: Environment, name: str, level: int, law: str | None) -> Any:
        meaning = at.problem.names[name.replace(f".{split(name)[1]}", ".*", 1)]
        assert meaning.of is not None
        degree: Any = self.values[DEGREE]
        for _ in range(level):
            degree = Pair(degree)
        return at.domain(level).mul_(degree, at.output(meaning.of, {}, level, law))


class _Along(Environment):
    """The derivatives along one symbol, at level 1."""

    def __init__(self, problem: Problem, values: Gains, symbol: str) -> None:
        super().__init__(problem, Boxes(), values.__getitem__, _Degrees(values))
        self.symbol = symbol

    def _free(self, name: str, general: str, level: int, law: str | None) -> Any:
        if level == 0:
            return self.free(name)
        moves = Boxes().constant(Fraction(1)) if name == self.symbol else None
        return Pair(self.name(name, level - 1, law), moves)


def reached(problem: Problem) -> set[str]:
    """The names that a problem's claim reads, and those that these stand for."""
    reach = Reach(problem)
    reach.listing(problem.claim.listing)
    return reach.read


def read_names(problem: Problem) -> Iterator[str]:
    """The scalars that a problem's claim reads, and the degree where it sums over neighbours."""
    read = reached(problem)
    yield from (name for name in problem.scalars if name in read)
    if any(meaning.is_ == "sum" for name, meaning in problem.names.items() if name in read):
        yield DEGREE
