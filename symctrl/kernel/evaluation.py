"""The one walk over a statement: listings, names, motion and laws, evaluated in any domain.

Soundness-critical. Last reviewed 2026-11-24.

Relies on: a value at level n is the truncated tower of iterated derivatives along the motion, held as nested
pairs; the chain rule of each operation carries it from the arguments to the result (`chain`). A sum over
neighbours or over nodes is differentiated term by term. `closure` has shown that the recursion ends.

A level value is a domain value at level 0 and a pair (value, derivative) of level values one lower above; a
derivative that is None is that of a constant: zero.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Generic, Protocol, TypeVar

from symctrl.kernel.certificate import Invalid, at_node, per_node, split_name
from symctrl.kernel.chain import Chain, Domain
from symctrl.kernel.closure import effective_law, law_of
from symctrl.kernel.values import Meaning, Ref, Statement

Value = TypeVar("Value")
Binding = Mapping[str, str]  # the letters i and j to nodes
Level = Any  # a level value


class Sums(Protocol):
    """What a sum over neighbours (`node` is its node) or a total (`node` is "") is, as a level value."""

    def value(self, walk: Evaluation[Any], key: str, node: str, level: int, law: str | None) -> Level: ...


class Evaluation(Generic[Value]):
    """Evaluates the outputs of listings; each (listing, level, law, binding) once.

    free: the domain value of a free symbol, by its name at its node (`q[1]`, `q.i[1]`, `q.2[1]`).
    A binding counts only by the letters that the listing itself mentions: one without a node is run once.
    """

    def __init__(
        self, statement: Statement, domain: Domain[Value], free: Callable[[str], Value], sums: Sums
    ) -> None:
        self.statement = statement
        self.chain = Chain(domain)
        self.free = free
        self.sums = sums
        self._letters = {name: sorted(listing.letters) for name, listing in statement.listings.items()}
        self._memo: dict[tuple[str, int, str | None, tuple[str, ...]], list[Level]] = {}

    def output(self, ref: Ref, binding: Binding, level: int = 0, law: str | None = None) -> Level:
        """The level value of one output of a listing. Raises Invalid, and what the domain raises."""
        return self.outputs(ref[0], binding, level, law)[ref[1]]

    def outputs(self, listing: str, binding: Binding, level: int = 0, law: str | None = None) -> list[Level]:
        """The level values of all outputs of a listing, under a law that replaces inputs."""
        letters = self._letters[listing]
        if any(letter not in binding for letter in letters):
            raise Invalid(f"listing {listing[:60]!r} mentions a node that is not bound where it is used")
        key = (listing, level, law, tuple(binding[letter] for letter in letters))
        if key not in self._memo:
            self._memo[key] = self._run(listing, binding, level, law)
        return self._memo[key]

    def _run(self, listing: str, binding: Binding, level: int, law: str | None) -> list[Level]:
        work: list[Level] = []
        for step in self.statement.listings[listing].code:
            if step.op == "INPUT":
                key, letter = split_name(step.name)
                work.append(self.read(key, binding[letter] if letter else "", level, law))
            elif step.op == "CONST":
                work.append(self.chain.constant(level, step.value))
            else:
                work.append(self.chain.operation(step.op, level, [work[a] for a in step.args]))
        return [work[r] for r in self.statement.listings[listing].outputs]

    def read(self, key: str, node: str, level: int, law: str | None) -> Level:
        """The level value of a scalar or name, by its key in the tables and its node ("" without one)."""
        if key in self.statement.names:
            return self._meaning(key, self.statement.names[key], node, level, law)
        kind = self.statement.scalars[key]
        binding = {"i": node} if per_node(key) else {}
        given = law_of(self.statement, key, law) if kind == "input" else None
        if given is not None:
            return self.output(given, binding, level, law)
        if level == 0:
            return self.free(at_node(key, node))
        if kind != "parameter" and key not in self.statement.motion:
            raise Invalid(f"{at_node(key, node)} has no rate")
        value = self.read(key, node, level - 1, law)
        if kind == "parameter":
            return value, None
        return value, self.output(self.statement.motion[key], binding, level - 1, law)

    def _meaning(self, key: str, meaning: Meaning, node: str, level: int, law: str | None) -> Level:
        binding = {"i": node} if per_node(key) else {}
        if meaning.kind == "constant":
            return self.chain.constant(level, meaning.value)
        if meaning.kind == "value":
            return self.output(meaning.of, binding, level, law)
        if meaning.kind == "rate":
            derivative = self.output(meaning.of, binding, level + 1, effective_law(meaning.law, law))[1]
            return self.chain.constant(level, 0) if derivative is None else derivative
        return self.sums.value(self, key, node, level, law)


class GraphSums:
    """Sums over the neighbours and nodes of a given graph, term by term in the order of the mapping.

    neighbours: node to its neighbours. An empty sum is zero.
    """

    def __init__(self, neighbours: Mapping[str, Sequence[str]]) -> None:
        self.neighbours = neighbours

    def value(self, walk: Evaluation[Any], key: str, node: str, level: int, law: str | None) -> Level:
        meaning = walk.statement.names[key]
        if meaning.kind == "sum" and node not in self.neighbours:
            raise Invalid(f"{key}: the graph has no node {node[:40]!r}")
        if meaning.kind == "sum":
            bindings = [{"i": node, "j": other} for other in self.neighbours[node]]
        else:
            bindings = [{"i": each} for each in self.neighbours]
        total = walk.chain.constant(level, 0)
        for binding in bindings:
            total = walk.chain.add(level, total, walk.output(meaning.of, binding, level, law))
        return total


class NoSums:
    """Where a sum has no meaning: every one is refused."""

    def value(self, walk: Evaluation[Any], key: str, node: str, level: int, law: str | None) -> Level:
        raise Invalid(f"{key} is a sum inside a sum, or a sum without a graph")
