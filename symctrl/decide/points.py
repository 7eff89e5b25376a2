"""Admissible rational points of a problem: all assumptions hold there exactly.

Relations are met by construction, through the rational parametrisation of a sphere or circle or by solving for a symbol
that enters linearly; symmetric definite matrices are L Lᵀ + I; inequalities by trying, with smaller and smaller values.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any

from symctrl.decide.place import SMALL_GRAPHS, Place, evaluation, free_names, is_fleet, neighbours
from symctrl.decide.session import Session, exactly
from symctrl.domains.fraction import FractionDomain, NoExactValue, rational_root
from symctrl.problem import Assumption, Problem, split, star

TRIES_PER_POINT = 60


class NoPoint(ValueError):  # noqa: N818
    """No admissible point was found; the message names the assumption that failed last."""


@dataclass(frozen=True)
class Sphere:
    """x_1² + .. + x_k² = radius², for symbols by their starred names."""

    names: tuple[str, ...]
    radius: Fraction


@dataclass(frozen=True)
class Linear:
    """The symbol `name` solves: coefficient * name + rest = 0, both free of it; monomials over starred names."""

    name: str
    coefficient: tuple[tuple[Fraction, Mapping[str, int]], ...]
    rest: tuple[tuple[Fraction, Mapping[str, int]], ...]


@dataclass(frozen=True)
class Recipe:
    """How the symbols of a problem are drawn. root: powers of this degree keep roots rational."""

    problem: Problem
    solved: tuple[Sphere | Linear, ...]
    definite: tuple[tuple[tuple[str, ...], int], ...]
    positive: frozenset[str]
    root: int


def recipe(problem: Problem) -> Recipe:
    """The recipe of a problem. Raises NoPoint for a relation of a form that is not solved here."""
    solved = exactly(problem, _solutions)
    definite = []
    positive = set()
    for assumption in problem.given:
        names = _plain_names(problem, assumption)
        if assumption.kind.startswith("positive_") and None not in names:
            definite.append((tuple(n for n in names if n), assumption.size))
        elif assumption.kind in ("positive", "nonnegative") and names[0]:
            positive.add(names[0])
    return Recipe(problem, tuple(solved), tuple(definite), frozenset(positive), _root_degree(problem))


def points(problem: Problem, seed: int = 1) -> Iterator[Place]:
    """Admissible places without end, small numbers first, for fleets on small graphs in turn.

    Raises NoPoint where none is found in a bounded number of tries.
    """
    made = recipe(problem)
    graphs: tuple[tuple[tuple[str, str], ...], ...] = SMALL_GRAPHS if is_fleet(problem) else ((),)
    generator = random.Random(seed)
    count = 0
    while True:
        yield _point(made, graphs[count % len(graphs)], generator, height=2 + count // 2)
        count += 1


def admissible(problem: Problem, place: Place) -> str | None:
    """The text of the first assumption that does not hold at the place, or None. Raises NoExactValue."""
    at = evaluation(problem, place, FractionDomain())
    for assumption in problem.given:
        nodes = list(place.neighbours) or [""]
        for node in nodes if _at_nodes(problem, assumption) else nodes[:1]:
            values = [at.output(of, {"i": node} if node else {}) for of in assumption.of]
            if not _holds(assumption, values):
                return assumption.text
    return None


def _point(made: Recipe, edges: tuple[tuple[str, str], ...], generator: random.Random, height: int) -> Place:
    failed = "a value that is not rational"
    for attempt in range(TRIES_PER_POINT):
        try:
            place = Place(_draw(made, edges, generator, height + attempt // 8, attempt), edges)
            wrong = admissible(made.problem, place)
        except (NoExactValue, ZeroDivisionError):
            continue
        if wrong is None:
            return place
        failed = wrong
    raise NoPoint(f"no point was found at which all assumptions hold; the last to fail was {failed}")


def _draw(
    made: Recipe, edges: tuple[tuple[str, str], ...], generator: random.Random, height: int, attempt: int
) -> dict[str, Fraction]:
    at = neighbours(edges)
    values = {name: _number(made, star(name) if edges else name, generator, height, attempt) for name in free_names(made.problem, at)}
    for node in at or ("",):
        local = lambda name, node=node: name.replace(".*", f".{node}", 1)  # noqa: E731
        for names, size in made.definite:
            for name, entry in zip(names, _definite(size, generator, height), strict=True):
                values[local(name)] = entry
        for way in made.solved:
            if isinstance(way, Sphere):
                drawn = _on_sphere(len(way.names), generator, height)
                values.update({local(n): way.radius * x for n, x in zip(way.names, drawn, strict=True)})
            else:
                known = {star(n) if edges else n: v for n, v in values.items() if not edges or split(n)[1] in (node, None)}
                values[local(way.name)] = -_evaluated(way.rest, known) / _evaluated(way.coefficient, known)
    return values


def _number(made: Recipe, name: str, generator: random.Random, height: int, attempt: int) -> Fraction:
    """A small rational; every other attempt a power that keeps roots rational, and smaller ones as attempts fail."""
    root = made.root if attempt % 2 == 0 else 1
    value = Fraction(generator.randint(name in made.positive, height + 1), generator.randint(1, height)) ** root
    if name not in made.positive and generator.random() < 0.5:
        value = -value
    if name not in made.positive and made.problem.scalars.get(name) in ("signal", "state", "parameter") and attempt > 4:
        value /= 2 ** generator.randint(0, attempt // 2)
    return value


def _on_sphere(count: int, generator: random.Random, height: int) -> list[Fraction]:
    """A rational point of the unit sphere by stereographic projection; the last coordinate is never -1."""
    t = [Fraction(generator.randint(-height, height), generator.randint(1, height)) for _ in range(count - 1)]
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
    return answer == "positive definite" or (answer != "not positive semidefinite" and "semi" in assumption.kind)


def _solutions(session: Session) -> list[Sphere | Linear]:
    found: list[Sphere | Linear] = []
    taken: set[str] = set()
    for assumption, numerator in session.zeros:
        way = _sphere(session, numerator, taken) or _linear(session, numerator, taken)
        if way is None:
            raise NoPoint(f"no exact point is known with {assumption.text}")
        found.append(way)
        taken |= set(way.names) if isinstance(way, Sphere) else {way.name}
    return found


def _monomials(session: Session, p: Any) -> list[tuple[Fraction, dict[str, int]]] | None:
    """The terms of a relation over starred names; None where it has opaque generators or speaks of the neighbour."""
    field = session.domain.field
    result = []
    for exponents, c in p.terms():
        names = {}
        for v, e in enumerate(exponents):
            if e:
                g = field.generators[field.size - 1 - v]
                if g.kind != "free" or ".j" in g.name:
                    return None
                names[star(g.name)] = int(e)
        result.append((Fraction(int(c.p), int(c.q)), names))
    return result


def _sphere(session: Session, p: Any, taken: set[str]) -> Sphere | None:
    terms = _monomials(session, p)
    if terms is None:
        return None
    constant = sum((c for c, names in terms if not names), Fraction(0))
    squares = [(c, names) for c, names in terms if names]
    if any(list(names.values()) != [2] for _, names in squares) or len({c for c, _ in squares}) != 1:
        return None
    names = tuple(next(iter(n)) for _, n in reversed(squares))
    radius = rational_root(-constant / squares[0][0], 2) if -constant / squares[0][0] > 0 else None
    return None if radius is None or len(names) < 2 or taken & set(names) else Sphere(names, radius)


def _linear(session: Session, p: Any, taken: set[str]) -> Linear | None:
    terms = _monomials(session, p)
    for name in sorted({n for _, names in terms or () for n in names} - taken):
        if all(names.get(name, 0) <= 1 for _, names in terms or ()):
            lead = tuple((c, {n: e for n, e in names.items() if n != name}) for c, names in terms or () if name in names)
            return Linear(name, lead, tuple((c, names) for c, names in terms or () if name not in names))
    return None


def _evaluated(terms: tuple[tuple[Fraction, Mapping[str, int]], ...], values: Mapping[str, Fraction]) -> Fraction:
    total = Fraction(0)
    for c, names in terms:
        for name, e in names.items():
            c = c * values[name] ** e
        total += c
    return total


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


