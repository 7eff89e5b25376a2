"""Where a counterexample to a theorem is: exact values of everything that is free, on a graph for a fleet.

Soundness-critical. Last reviewed 2026-11-24.

Relies on: a claim about fleets is one about every connected graph, so that one is enough. An assumption that
speaks of states, and neither of signals nor of the whole trajectory, is one about the initial state; every
other is one about all times, and so is what is supposed of solutions. Signals that are chosen constant meet
at all times what they meet once, if states have no part in it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from symctrl.kernel.certificate import Declined, Invalid, at_node, per_node
from symctrl.kernel.closure import Reach
from symctrl.kernel.evaluation import Evaluation, GraphSums, Level, NoSums
from symctrl.kernel.interval import Interval, Undecided
from symctrl.kernel.sliced import slice_of, sliced
from symctrl.kernel.spots import Spot, Spots
from symctrl.kernel.values import Assumption, Ref, Sentence, Statement
from symctrl.kernel.witness import Graph, _bindings, _holds_on, _read_graph, _values


class NotContradicted(Invalid):
    """What is offered may be a solution, but it does not contradict the conclusion."""


SETS = frozenset(("stays", "enters", "settles", "eventually"))


@dataclass(frozen=True, slots=True)
class Place:
    """values: by name at its node, without inputs that the law gives."""

    values: Mapping[str, Fraction]
    graph: Graph


def is_fleet(statement: Statement) -> bool:
    return any(per_node(key) for key in (*statement.scalars, *statement.names)) or any(
        meaning.kind in ("sum", "total") for meaning in statement.names.values()
    )


def free_scalars(statement: Statement) -> dict[str, str]:
    """The scalars that the law of the closed loop does not give, with their kinds."""
    law = statement.claim.law
    given = statement.laws[law] if law is not None else {}
    return {key: kind for key, kind in statement.scalars.items() if key not in given}


def read_place(statement: Statement, proof: Mapping[str, Any]) -> Place:
    """From the fields `values` and, for a fleet, `graph`. Raises Invalid or Declined."""
    graph = _read_graph(proof["graph"]) if is_fleet(statement) else {}
    numbers = _values(replace(statement, scalars=free_scalars(statement)), proof["values"], graph)
    values: dict[str, Fraction] = {}
    for name, number in numbers.items():
        if not isinstance(number, Fraction):
            raise Declined(f"the value of {name} is not rational")
        values[name] = number
    return Place(values, graph)


def reads(statement: Statement, refs: Sequence[Ref]) -> set[str]:
    """What these outputs read in the closed loop, also through laws and rates."""
    reach = Reach(statement)
    for name, _ in refs:
        reach.listing(name, "ij", 0, statement.claim.law)
    return reach.read | reach.moved


def moves(statement: Statement, key: str) -> bool:
    """Is it a state, or a signal with a motion?"""
    return key in statement.motion or statement.scalars.get(key) == "state"


def is_signal(statement: Statement, key: str) -> bool:
    return key in free_scalars(statement) and not (
        statement.scalars[key] == "parameter" or moves(statement, key)
    )


def is_initial(statement: Statement, assumption: Assumption) -> bool:
    """Is it about the initial state alone?"""
    found = reads(statement, assumption.of)
    states = any(moves(statement, key) for key in found)
    signals = any(is_signal(statement, key) for key in found)
    return states and not signals and assumption.about != "trajectory"


def supposed(statement: Statement) -> Iterator[tuple[Sentence, Ref]]:
    for sentence in statement.claim.suppose:
        for k in sentence.of:
            yield sentence, (statement.claim.listing, k)


def require_momentary(statement: Statement) -> None:
    """Raises Declined where an assumption speaks of states at later times, which a state does not show."""
    for assumption in statement.given:
        states = any(moves(statement, key) for key in reads(statement, assumption.of))
        if states and not is_initial(statement, assumption):
            raise Declined(f"that {assumption.text[:80]!r} holds at later times is not shown by a state")
    for sentence, ref in supposed(statement):
        if any(moves(statement, key) for key in reads(statement, [ref])):
            raise Declined(f"that what is supposed ({sentence.word}) holds is not shown by a state")


class Site:
    """The closed loop evaluated at a place, each output with the instructions alone that it needs."""

    def __init__(
        self,
        statement: Statement,
        place: Place,
        bits: int,
        directions: Sequence[str] = (),
        switches: Mapping[str, Fraction] | None = None,
    ) -> None:
        self.statement, self.place = statement, place
        moving = {name for _, name, _ in states(statement, place.graph)}
        self.domain = Spots(bits, place.values, lambda name: name not in moving, directions, switches)
        sums = GraphSums(place.graph) if place.graph else NoSums()
        self.walk: Evaluation[Spot] = Evaluation(sliced(statement), self.domain, self.domain.free, sums)

    @property
    def law(self) -> str | None:
        return self.statement.claim.law

    def value(self, ref: Ref, binding: Mapping[str, str], level: int = 0) -> Level:
        return self.walk.output(slice_of(ref), binding, level, self.law)

    def rates(self) -> dict[str, Spot]:
        """Of every state, by its name at its node."""
        return {
            name: self.value(self.statement.motion[key], binding)
            for key, name, binding in states(self.statement, self.place.graph)
        }

    def active(self, rates: Mapping[str, Spot]) -> list[str]:
        """The keys of the arguments of switches at which a rate jumps, in the order of meeting them."""
        jumps = frozenset().union(*(rate.traits.jumps for rate in rates.values()))
        if jumps - self.domain.active.keys():
            raise Declined("the field has a jump that is not one of a sign")
        return [key for key in self.domain.active if key in jumps]

    def outputs(self, k: int) -> list[Spot]:
        """One output of the claim's listing, for all nodes and neighbours that it speaks of."""
        ref = (self.statement.claim.listing, k)
        return [self.value(ref, binding) for binding in self.bindings()]

    def bindings(self) -> list[dict[str, str]]:
        letters = self.statement.listings[self.statement.claim.listing].letters
        if not letters:
            return [{}]
        if letters == {"i"}:
            return [{"i": node} for node in self.place.graph]
        return [{"i": node, "j": other} for node, others in self.place.graph.items() for other in others]

    def require_given(self) -> None:
        """Every assumption holds here, and what is supposed holds for constants. Raises Invalid otherwise."""
        for k, assumption in enumerate(self.statement.given):
            for binding in _bindings(self.statement, assumption, self.place.graph):
                entries = [self.value(ref, binding) for ref in assumption.of]
                require_no_jump(entries, assumption.text)
                if not self._holds(assumption, [entry.number for entry in entries]):
                    at = f" at node {binding['i']}" if binding else ""
                    raise Invalid(
                        f"the values do not satisfy assumption {k + 1}, {assumption.text[:80]!r}{at}"
                    )

    def _holds(self, assumption: Assumption, entries: Sequence[Interval]) -> bool:
        return _holds_on(self.place.graph, assumption, entries)

    def require_supposed(self) -> None:
        """What is supposed holds, if all that it speaks of stays as it is here."""
        for sentence, (_, k) in supposed(self.statement):
            found = self.outputs(k)
            require_no_jump(found, sentence.word)
            for spot in found if sentence.word != "bounded" else ():
                sign = sign_of(spot, "what is supposed")
                if (sign == 0) == (sentence.word == "apart"):
                    raise Invalid(f"what is supposed ({sentence.word}) does not hold for the constant {k}")


def states(statement: Statement, graph: Graph) -> list[tuple[str, str, dict[str, str]]]:
    """The key, the name at its node and the node of everything with a motion."""
    found: list[tuple[str, str, dict[str, str]]] = []
    for key in statement.motion:
        nodes = list(graph) if per_node(key) else [""]
        found += [(key, at_node(key, node), {"i": node} if node else {}) for node in nodes]
    missing = sorted(
        key for key, kind in statement.scalars.items() if kind == "state" and key not in statement.motion
    )
    if missing:
        raise Invalid(f"the state {missing[0]} has no motion")
    return found


def sign_of(spot: Spot, what: str) -> int:
    if spot.number.sign is None:
        raise Undecided(f"the sign of {what}")
    return spot.number.sign


def require_no_jump(spots: Sequence[Spot], what: str) -> None:
    if any(spot.traits.jumps for spot in spots):
        raise Declined(f"{what[:80]!r} has a switch that is at its jump")
