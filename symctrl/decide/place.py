"""Exact points: where a problem's symbols have rational values, on a small graph if it has a fleet."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from symctrl.domains.domain import Domain
from symctrl.evaluate import Environment
from symctrl.problem import Problem, split

Neighbours = Mapping[str, tuple[str, ...]]

# Small connected graphs on which a claim about every graph is tried: two nodes, a path, a star, a ring.
SMALL_GRAPHS: tuple[tuple[tuple[str, str], ...], ...] = (
    (("1", "2"),),
    (("1", "2"), ("2", "3")),
    (("1", "2"), ("1", "3"), ("1", "4")),
    (("1", "2"), ("2", "3"), ("3", "4"), ("1", "4")),
)


@dataclass(frozen=True)
class Place:
    """Values of all free scalars by resolved name; for fleets the edges and the nodes that i and j stand
    for.
    """

    values: Mapping[str, Fraction]
    edges: tuple[tuple[str, str], ...] = ()

    @property
    def neighbours(self) -> Neighbours:
        return neighbours(self.edges)

    @property
    def binding(self) -> dict[str, str]:
        """The first node for i and its first neighbour for j."""
        if not self.edges:
            return {}
        first, second = self.edges[0]
        return {"i": first, "j": second}


def neighbours(edges: tuple[tuple[str, str], ...]) -> Neighbours:
    """Node to its neighbours, in the order of the edges."""
    found: dict[str, list[str]] = {}
    for a, b in edges:
        found.setdefault(a, []).append(b)
        found.setdefault(b, []).append(a)
    return {node: tuple(others) for node, others in found.items()}


class GraphSums:
    """Sums over the neighbours and nodes of a given graph, term by term."""

    def __init__(self, of: Neighbours) -> None:
        self.of = of

    def value(self, at: Environment, name: str, level: int, law: str | None) -> Any:
        _, node, _ = split(name)
        meaning = at.problem.names[name.replace(f".{node}", ".*", 1) if node else name]
        assert meaning.of is not None
        if meaning.is_ == "sum":
            assert node is not None
            bindings = [{"i": node, "j": other} for other in self.of[node]]
        else:
            bindings = [{"i": each} for each in self.of]
        domain = at.domain(level)
        total = domain.constant(Fraction(0))
        for binding in bindings:
            total = domain.add_(total, at.output(meaning.of, binding, level, law))
        return total


def is_fleet(problem: Problem) -> bool:
    """Does the problem speak of nodes?"""
    return any(".*" in name for name in (*problem.scalars, *problem.names)) or any(
        meaning.is_ == "total" for meaning in problem.names.values()
    )


def free_names(problem: Problem, at: Neighbours) -> list[str]:
    """The resolved names of all free scalars, at every node."""
    return [
        name.replace(".*", f".{node}", 1)
        for name in problem.scalars
        for node in (at if ".*" in name else ("",))
    ]


def evaluation(problem: Problem, place: Place, domain: Domain[Any]) -> Environment:
    """The problem's names at the place, in a domain."""
    values = {name: domain.constant(value) for name, value in place.values.items()}
    return Environment(problem, domain, values.__getitem__, GraphSums(place.neighbours))
