"""Admissible rational points of a problem: all assumptions hold there exactly.

Equations are met by construction (symctrl.decide.solve); symmetric definite matrices are L Lᵀ + I, or a
multiple of it; inequalities by trying, with smaller and smaller values."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from math import lcm

from symctrl.decide.place import SMALL_GRAPHS, Place, evaluation, free_names, is_fleet, neighbours
from symctrl.decide.session import exactly
from symctrl.decide.solve import NoPoint, Sphere, Way, evaluated, ways
from symctrl.domains.fraction import FractionDomain, NoExactValue
from symctrl.graph import interpret
from symctrl.problem import Assumption, Problem, split, star
from symctrl.reach import Reach

TRIES_PER_POINT = 60
TRIES_PER_CONSTANTS = 8
DRAWS = 60  # of constants
RESTS = 6  # beginnings of the search for a point at rest
MOST_SHIFTS = 12


@dataclass(frozen=True)
class Recipe:
    """How the symbols of a problem are drawn.

    ways: to meet the assumed equations. definite: symbols of matrices, with their sizes. root: powers of this
    degree keep roots rational. positive, nonnegative: symbols that are assumed to be. between: the least and
    the greatest value of a symbol, where numbers bound it. constant: the assumptions about parameters that
    belong to no node, with their symbols.
    """

    problem: Problem
    ways: tuple[Way, ...]
    definite: tuple[tuple[tuple[str, ...], int], ...]
    positive: frozenset[str]
    nonnegative: frozenset[str]
    root: int
    between: Mapping[str, tuple[Fraction | None, Fraction | None]]
    constant: tuple[tuple[Assumption, tuple[str, ...]], ...]


def recipe(problem: Problem) -> Recipe:
    """The recipe of a problem. Raises NoPoint for a relation of a form that is not solved here."""
    found = exactly(problem, ways)
    definite = []
    positive, nonnegative = set(), set()
    for assumption in problem.given:
        names = _plain_names(problem, assumption)
        if assumption.kind.startswith("positive_") and None not in names:
            definite.append((tuple(n for n in names if n), assumption.size))
        elif assumption.kind == "positive" and names[0]:
            positive.add(names[0])
        elif assumption.kind == "nonnegative" and names[0]:
            nonnegative.add(names[0])
    return Recipe(
        problem,
        tuple(found),
        tuple(definite),
        frozenset(positive),
        frozenset(nonnegative),
        _root_degree(problem),
        _between(problem),
        tuple(_about_constants(problem)),
    )


def points(problem: Problem, seed: int = 1) -> Iterator[Place]:
    """Admissible places without end, small numbers first, for fleets on small graphs in turn.

    Raises NoPoint where none is found in a bounded number of tries.
    """
    made = recipe(problem)
    graphs: tuple[tuple[tuple[str, str], ...], ...] = SMALL_GRAPHS if is_fleet(problem) else ((),)
    generator = random.Random(seed)
    count, begin = 0, 0
    while True:
        place, begin = _point(made, graphs[count % len(graphs)], generator, 2 + count // 2, begin)
        yield place
        count += 1


def admissible(problem: Problem, place: Place) -> str | None:
    """The text of the first assumption that does not hold at the place, or None. Raises NoExactValue."""
    at = evaluation(problem, place, FractionDomain())
    for assumption in problem.given:
        nodes = list(place.neighbours) or [""]
        for node in nodes if _at_nodes(problem, assumption) else nodes[:1]:
            values = [at.output(of, {"i": node} if node else {}) for of in assumption.of]
            if not _holds_at(place, assumption, values):
                return assumption.text
    return None


def _point(
    made: Recipe, edges: tuple[tuple[str, str], ...], generator: random.Random, height: int, begin: int
) -> tuple[Place, int]:
    """A place and the attempt with which to begin for the next one: what grew large enough stays large."""
    failed = "a value that is not rational"
    constants: dict[str, Fraction] = {}
    for attempt in range(begin, begin + TRIES_PER_POINT):
        grown = height + (attempt - begin) // TRIES_PER_CONSTANTS
        if (attempt - begin) % TRIES_PER_CONSTANTS == 0:
            constants = _constants(made, edges, generator, grown, attempt)
        try:
            place = Place(_draw(made, edges, generator, grown, attempt, constants), edges)
            wrong = admissible(made.problem, place)
        except (NoExactValue, ZeroDivisionError):
            continue
        if wrong is None:
            return place, attempt
        failed = wrong
    resting = (_at_rest(made, edges, generator, height) for _ in range(RESTS))
    found = next((place for place in resting if place is not None), None)
    if found is None:
        raise NoPoint(f"no point was found at which all assumptions hold; the last to fail was {failed}")
    return found, begin


def _at_rest(
    made: Recipe, edges: tuple[tuple[str, str], ...], generator: random.Random, height: int
) -> Place | None:
    """A point where all is zero that may be, and the constants of an assumption that fails are drawn again.

    Only where moving points have failed: at rest too many claims hold that are false elsewhere.
    """
    names = _constant_names(made.problem)
    constants = {name: _number(made, name, generator, height, 0) for name in names}
    constants |= _constants(made, edges, generator, height, 0)
    for attempt in range(DRAWS):
        place = Place(_draw(made, edges, generator, 0, attempt, constants), edges)
        try:
            wrong = admissible(made.problem, place)
        except (NoExactValue, ZeroDivisionError):
            continue
        if wrong is None:
            return place
        again = _constants_of(made, wrong) & constants.keys()
        drawn = {name: _number(made, name, generator, height, attempt) for name in sorted(again)}
        if not _read_by_a_false_one(made, Place({**constants, **drawn}, edges)):
            constants = {**constants, **drawn}
    return None


def _constants_of(made: Recipe, text: str) -> set[str]:
    """The symbols that the assumptions of this text read."""
    reach = Reach(made.problem)
    for assumption in made.problem.given:
        if assumption.text == text:
            for listing, _ in assumption.of:
                reach.listing(listing)
    return reach.read


def _draw(
    made: Recipe,
    edges: tuple[tuple[str, str], ...],
    generator: random.Random,
    height: int,
    attempt: int,
    constants: Mapping[str, Fraction],
) -> dict[str, Fraction]:
    """Values of all symbols. height: of the numbers; 0 for a point at rest."""
    at = neighbours(edges)
    values = {
        name: constants[name]
        if name in constants
        else _number(made, star(name) if edges else name, generator, height, attempt)
        for name in free_names(made.problem, at)
    }
    scale = Fraction(2) ** (generator.choice((0, attempt // 4 % MOST_SHIFTS)) if made.definite else 0)
    for node in at or ("",):

        def local(name: str, node: str = node) -> str:
            return name.replace(".*", f".{node}", 1)

        for names, size in made.definite:
            for name, entry in zip(names, _definite(size, generator, height), strict=True):
                values[local(name)] = scale * entry
        for step in reversed(generator.choice(made.ways)):
            if isinstance(step, Sphere):
                drawn = _on_sphere(len(step.names), generator, height)
                for name, x in zip(sorted(step.names, key=made.positive.__contains__), drawn, strict=True):
                    values[local(name)] = step.radius * (abs(x) if name in made.positive else x)
            else:
                known = {
                    star(n) if edges else n: v
                    for n, v in values.items()
                    if not edges or split(n)[1] in (node, None)
                }
                values[local(step.name)] = -evaluated(step.rest, known) / evaluated(step.coefficient, known)
    return values


def _constants(
    made: Recipe, edges: tuple[tuple[str, str], ...], generator: random.Random, height: int, attempt: int
) -> dict[str, Fraction]:
    """Parameters that belong to no node; those of an assumption about these alone are drawn again until it
    holds.
    """
    values: dict[str, Fraction] = {}
    again = _constant_names(made.problem) if made.constant else []
    for more in range(DRAWS):
        values |= {name: _number(made, name, generator, height, attempt + more) for name in again}
        again = _read_by_a_false_one(made, Place(values, edges))
        if not again:
            break
    return values


def _constant_names(problem: Problem) -> list[str]:
    """Parameters that belong to no node."""
    return [n for n, kind in problem.scalars.items() if kind == "parameter" and ".*" not in n]


def _read_by_a_false_one(made: Recipe, place: Place) -> list[str]:
    """The symbols of the first assumption about constants that does not hold."""
    at = evaluation(made.problem, place, FractionDomain())
    for assumption, names in made.constant:
        try:
            holds = _holds_at(place, assumption, [at.output(of, {}) for of in assumption.of])
        except (NoExactValue, ZeroDivisionError):
            holds = False
        if not holds:
            return list(names)
    return []


def _about_constants(problem: Problem) -> Iterator[tuple[Assumption, tuple[str, ...]]]:
    """The assumptions about parameters that belong to no node, with the symbols that they read."""
    for assumption in problem.given:
        reach = Reach(problem)
        for listing, _ in assumption.of:
            reach.listing(listing)
        free = [name for name in problem.scalars if name in reach.read]
        kinds = {problem.names[name].is_ for name in reach.read if name in problem.names}
        constant = all(problem.scalars[name] == "parameter" and ".*" not in name for name in free)
        if assumption.kind != "zero" and constant and not kinds & {"sum", "total", "rate"}:
            yield assumption, tuple(free)


def _number(made: Recipe, name: str, generator: random.Random, height: int, attempt: int) -> Fraction:
    """A small rational; every other attempt a power that keeps roots rational.

    As attempts fail, what is positive grows or shrinks and all else shrinks, which most bounds want.
    height 0: at rest.
    """
    low, high = made.between.get(name, (None, None))
    if height == 0:
        return _least(name in made.positive, low, high)
    if low is not None and high is not None:
        part = generator.choice((0, 1, Fraction(generator.randint(0, height), height)))
        return low + (high - low) * part
    root = made.root if attempt % 2 == 0 else 1
    least = int(name in made.positive)
    value = Fraction(generator.randint(least, height + 1), generator.randint(1, height)) ** root
    signed = name not in made.positive and name not in made.nonnegative
    if signed and generator.random() < 0.5:
        value = -value
    shift = attempt // 4 % MOST_SHIFTS
    if low is not None or high is not None:
        return low + abs(value) if low is not None else Fraction(high or 0) - abs(value)
    if not signed:
        return value * Fraction(2) ** generator.choice((0, shift, -shift))
    return value / Fraction(2) ** generator.choice((shift, generator.randint(0, shift)))


def _least(positive: bool, low: Fraction | None, high: Fraction | None) -> Fraction:
    """Zero, or the number closest to it that the bounds allow; 1 for what shall be positive."""
    closest = max(low, Fraction(0)) if low is not None else Fraction(0)
    closest = min(closest, high) if high is not None else closest
    return Fraction(1) if positive and closest <= 0 and (high is None or high > 1) else closest


def _on_sphere(count: int, generator: random.Random, height: int) -> list[Fraction]:
    """A rational point of the unit sphere by stereographic projection; the last coordinate is never -1, and 1
    at height 0.
    """
    t = [
        Fraction(generator.randint(-height, height), generator.randint(1, max(height, 1)))
        for _ in range(count - 1)
    ]
    square = sum((x * x for x in t), Fraction(0))
    return [2 * x / (1 + square) for x in t] + [(1 - square) / (1 + square)]


def _definite(size: int, generator: random.Random, height: int) -> list[Fraction]:
    """L Lᵀ + I for a small integer L, entry by entry."""
    low = [[generator.randint(-height, height) if c <= r else 0 for c in range(size)] for r in range(size)]
    return [
        Fraction(sum(low[r][k] * low[c][k] for k in range(size)) + (r == c), 1)
        for c in range(size)
        for r in range(size)
    ]


def _holds(assumption: Assumption, values: list[Fraction]) -> bool:
    match assumption.kind:
        case "zero":
            return values[0] == 0
        case "nonzero":
            return values[0] != 0
        case "positive":
            return values[0] > 0
        case "nonnegative":
            return values[0] >= 0
    from symctrl.decide.definiteness import decide_matrix

    n = assumption.size
    answer = decide_matrix([[values[r + n * c] for c in range(n)] for r in range(n)]).definiteness
    return answer == "positive definite" or (
        answer != "not positive semidefinite" and "semi" in assumption.kind
    )


def _holds_at(place: Place, assumption: Assumption, values: list[Fraction]) -> bool:
    """A bound b of the eigenvalues of the graph's Laplacian L is b I - L positive semidefinite."""
    if assumption.kind != "laplacian_bound":
        return _holds(assumption, values)
    at = place.neighbours
    if not at:
        return True
    entries = [values[0] - len(at[a]) if a == b else Fraction(b in at[a]) for a in at for b in at]
    return _holds(replace(assumption, kind="positive_semidefinite", size=len(at)), entries)


def _between(problem: Problem) -> dict[str, tuple[Fraction | None, Fraction | None]]:
    """The numbers between which assumptions that are affine in one symbol keep it; 0 as only bound aside."""
    found: dict[str, tuple[Fraction | None, Fraction | None]] = {}
    for assumption in problem.given:
        listing, k = assumption.of[0]
        tape = problem.listings[listing]
        name = star(tape.inputs[0]) if len(tape.inputs) == 1 else ""
        if assumption.kind not in ("positive", "nonnegative") or name not in problem.scalars:
            continue
        try:
            at = [interpret(tape, FractionDomain(), [Fraction(x)])[k] for x in (0, 1, 2)]
        except NoExactValue:
            continue
        slope = at[1] - at[0]
        if at[2] - at[1] != slope or slope == 0:
            continue
        bound = -at[0] / slope
        low, high = found.get(name, (None, None))
        if slope > 0:
            low = bound if low is None else max(low, bound)
        else:
            high = bound if high is None else min(high, bound)
        found[name] = low, high
    return {name: (low, high) for name, (low, high) in found.items() if high is not None or low != 0}


def _plain_names(problem: Problem, assumption: Assumption) -> list[str | None]:
    """The starred names of the assumption's entries that are plain symbols."""
    result: list[str | None] = []
    for listing, k in assumption.of:
        tape = problem.listings[listing]
        step = tape.code[tape.outputs[k]]
        result.append(star(step.name) if step.op == "INPUT" and star(step.name) in problem.scalars else None)
    return result


def _at_nodes(problem: Problem, assumption: Assumption) -> bool:
    return any(split(n)[1] for listing, _ in assumption.of for n in problem.listings[listing].inputs)


def _root_degree(problem: Problem) -> int:
    degree = 1
    for tape in problem.listings.values():
        for step in tape.code:
            if step.op in ("SQRT", "HYPOT"):
                degree = lcm(degree, 2)
            elif step.op in ("POW", "CONSTPOW") and tape.code[step.args[1]].op == "CONST":
                degree = lcm(degree, tape.code[step.args[1]].value.denominator)
    return degree if degree <= 12 else 1
