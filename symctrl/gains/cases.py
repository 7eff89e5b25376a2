"""What the conditions speak of besides gains: the graph, and constants that the designer may choose."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from symctrl.decide.points import points
from symctrl.decide.solve import NoPoint
from symctrl.domains.boxes import Box, Boxes, rounded
from symctrl.domains.domain import Unsupported
from symctrl.fleet import EIGENVALUE
from symctrl.gains.conditions import Conditions, is_gain
from symctrl.gains.definite import HOLDS
from symctrl.gains.requirement import DEGREE, Case, Cases, Requirement, known, outputs
from symctrl.problem import Meaning

if TYPE_CHECKING:
    import networkx as nx

    from symctrl.study import Study

ZERO = Fraction(0)
MOST_DEGREES = 64  # that are looked at one by one; of more, the least and the greatest
CHOICES = tuple(
    Fraction(n, d) for n, d in ((1, 1), (1, 2), (2, 1), (1, 4), (4, 1), (1, 10), (10, 1), (1, 100), (1, 1000))
)
TRIES = 2048


def needs_spectrum(found: Conditions) -> bool:
    return bool(found.assumed.bounds) or any(EIGENVALUE in one.names for one in found.each)


def thresholds(found: Conditions, gains: Mapping[str, Fraction]) -> list[Fraction]:
    """The numbers that the largest eigenvalue must not exceed for a condition to hold at these gains, where a
    condition is affine in it.
    """
    domain, known = Boxes(exact=True), []
    for one in (one for condition in found.each for one in condition.requirements):
        read = [name for name in one.names if name == EIGENVALUE or name in found.assumed.bounds]
        if (
            len(read) != 1
            or one.kind not in ("positive", "nonnegative")
            or not _all_known(one, gains, read[0])
        ):
            continue
        at = {name: domain.between(value, value) for name, value in gains.items()}
        try:
            values = [_value(one, {**at, read[0]: domain.constant(Fraction(k))}, domain) for k in (0, 1, 2)]
        except Unsupported:
            continue
        slope = values[1] - values[0]
        if slope and values[2] - values[1] == slope:
            known.append(-values[0] / slope)
    return [t for t in dict.fromkeys(known) if t > 0]


def _all_known(one: Requirement, gains: Mapping[str, Fraction], beside: str) -> bool:
    return all(name in gains for name in one.names if name != beside)


def _value(one: Requirement, at: Mapping[str, Box], domain: Boxes) -> Fraction:
    return Fraction(outputs(one, at, domain)[0].low[0])


def of_graph(
    found: Conditions, graph: nx.Graph | None, spectrum: tuple[Fraction, Fraction] | None
) -> dict[str, Case]:
    """The cases that the graph decides. spectrum: bounds of the Laplacian's largest eigenvalue.

    0 is an eigenvalue of every Laplacian. What is assumed to be no less than all eigenvalues is chosen: as
    the largest, or for a condition to fail, as anything that is not less.
    """
    cases: dict[str, Case] = {}
    if spectrum is not None:
        low, high = spectrum
        cases[EIGENVALUE] = Case((ZERO, high), ((ZERO, ZERO), (low, high)))
        cases |= {name: Case((high, high), ((low, None),)) for name in found.assumed.bounds}
    if graph is not None and any(DEGREE in one.names for one in found.each):
        degrees = sorted({Fraction(degree) for _, degree in graph.degree})
        seen = degrees if len(degrees) <= MOST_DEGREES else [degrees[0], degrees[-1]]
        cases[DEGREE] = Case((degrees[0], degrees[-1]), tuple((d, d) for d in seen))
    return cases


def covers(found: Conditions, graph: nx.Graph | None) -> bool:
    """Is the graph one that the theorem is about? A theorem on a fleet is about connected graphs with two
    nodes or more.
    """
    if graph is None or not found.assumed.of_fleet:
        return True
    import networkx as nx

    return len(graph) > 1 and bool(nx.is_connected(graph))


def chosen(
    study: Study,
    found: Conditions,
    cases: Cases,
    gains: Mapping[str, Fraction],
    at_point: Mapping[str, Fraction] | None,
) -> dict[str, Case]:
    """A value for each gain that has none: those of an admissible point of the theorem, if they serve as many
    conditions as any that are tried.

    Whether a condition fails is asked of all values that the gain may take.
    """
    names = dict.fromkeys(name for condition in found.each for name in condition.names)
    open_ = [n for n in names if n not in cases and n not in gains and is_gain(study, n)]
    if not open_:
        return {}
    tried = _tried(len(open_))
    if at_point is not None and all(name in at_point for name in open_):
        tried.insert(0, tuple(at_point[name] for name in open_))
    requirements = [one for condition in found.deciding for one in condition.requirements]
    best = tried[int(np.argmax(_score(requirements, open_, tried, cases, gains)))]
    return {name: Case((v, v), ((ZERO, None),)) for name, v in zip(open_, best, strict=True)}


def admissible_constants(found: Conditions, gains: Mapping[str, Fraction]) -> Mapping[str, Fraction] | None:
    """All values at a point at which everything that the theorem assumes holds together, with these gains, on
    some small graph.

    Without one the theorem may speak of nothing. None where none is known.
    """
    problem = found.assumed.problem
    if problem is None:
        return {}
    bound = {name: Meaning("constant", value=str(v)) for name, v in gains.items() if name in problem.scalars}
    free = {name: kind for name, kind in problem.scalars.items() if name not in bound}
    try:
        place = next(points(replace(problem, scalars=free, names={**problem.names, **bound})))
    except (NoPoint, Unsupported):
        return None
    return place.values


def _tried(count: int) -> list[tuple[Fraction, ...]]:
    """Simple values first, the same ones each time."""
    generator = random.Random(1)
    more = (tuple(generator.choice(CHOICES) for _ in range(count)) for _ in range(TRIES))
    return list(dict.fromkeys([*((choice,) * count for choice in CHOICES), *more]))


def _score(
    requirements: Sequence[Requirement],
    open_: Sequence[str],
    values: Sequence[Sequence[Fraction]],
    cases: Cases,
    gains: Mapping[str, Fraction],
) -> np.ndarray:
    """How many requirements hold with each choice."""
    domain = Boxes()
    boxes = {name: domain.between(value, value) for name, value in gains.items()}
    for k, name in enumerate(open_):
        low = np.array([rounded(value[k], -np.inf) for value in values])
        boxes[name] = Box(low, np.array([rounded(value[k], np.inf) for value in values]))
    good = np.zeros(len(values))
    for one in requirements:
        if all(name in boxes or name in cases for name in one.names):
            good = good + (known(one, boxes, cases, domain) == HOLDS)
    return good
