"""What is known along every solution: facts about quantities, and what is read off the graph with them.

Soundness-critical. Last reviewed 2026-11-24.

Relies on what `traits` relies on: quantities of one structure have one key, and a fact about one is a fact
about all. A fact about a quantity of a node is about that of every node. What is said is said of every
solution on its maximal interval: absolutely continuous, and where the field jumps in the sense of Filippov,
for every admissible signal (measurable, locally bounded).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from symctrl.kernel.certificate import at_node, split_name
from symctrl.kernel.compose import rate_listing
from symctrl.kernel.evaluation import Evaluation
from symctrl.kernel.traits import Reading, Traits, reading
from symctrl.kernel.values import Statement

Known = tuple[str, str]  # a word and what it is about: a key, or the keys of a set
INSIDE = "inside"


@dataclass
class Knowledge:
    """The system with its quantities, and the facts so far."""

    statement: Statement
    facts: set[Known] = field(init=False, default_factory=set)
    _stamp: tuple[int, int] = field(init=False, default=(-1, -1))
    _read: Any = field(init=False, default=None)

    @property
    def law(self) -> str | None:
        return self.statement.claim.law

    # Facts

    def has(self, word: str, quantity: str) -> bool:
        if word == "bounded" and self.traits(quantity).bounded:
            return True
        return any((word, key) in self.facts for key in self.keys(quantity))

    def learn(self, word: str, quantity: str) -> None:
        for key in self.keys(quantity):
            self.facts.add((word, key))

    def learn_set(self, word: str, zero: bool, quantities: Sequence[str], by: str | None = None) -> None:
        self.facts.add((word, self.set_key(zero, [self.traits(q).key for q in quantities])))
        if by is not None:
            time = self.traits(by).key
            self.facts.add((word, self.set_key(zero, [self.traits(q).key for q in quantities], time)))

    @staticmethod
    def set_key(zero: bool, keys: Sequence[str], by: str = "") -> str:
        return f"{'=' if zero else '>='} {' '.join(sorted(keys))} {by}"

    # What is read off the graph

    def traits(self, listing: str, letter: str = "i") -> Traits:
        """Of the only output of a listing."""
        walk, _ = self._reading()
        binding = {"i": letter, "j": {"i": "j", "j": "i"}[letter]}
        value: Traits = walk.output((listing, 0), binding, 0, self.law)
        return value

    def output_traits(self, ref: tuple[str, int]) -> Traits:
        """Of one output of a listing that may speak of a node and its neighbour."""
        walk, _ = self._reading()
        value: Traits = walk.output(ref, {"i": "i", "j": "j"}, 0, self.law)
        return value

    def keys(self, listing: str) -> list[str]:
        """Keys under which facts about the listing stand: of a node's that of any node."""
        letters = ("i", "j") if self.statement.listings[listing].letters == {"i"} else ("i",)
        return [self.traits(listing, letter).key for letter in letters]

    def field(self) -> dict[str, Traits]:
        """The traits of every state's rate."""
        walk, _ = self._reading()
        return {
            state: walk.output(ref, {"i": "i"}, 0, self.law) for state, ref in self.statement.motion.items()
        }

    def edges(self) -> dict[str, Traits]:
        """What the field and the definitions of its inputs divide by or take roots of, as `kind key`."""
        walk, domain = self._reading()
        found: dict[str, Traits] = {}
        for ref in self.statement.motion.values():
            value: Traits = walk.output(ref, {"i": "i"}, 0, self.law)
            for edge in value.edges:
                found[edge] = domain.of_edge[edge.partition(" ")[2]]
        return found

    def edges_are_known(self, traits: Traits) -> bool:
        """Is all that it divides by, or takes roots of, known to stay inside its domain?"""
        return all(self.edge_is_known(*edge.split(" ", 1)) for edge in traits.edges)

    def edge_is_known(self, kind: str, key: str) -> bool:
        words = {
            "nonzero": ("", "positive "),
            "positive": ("positive ",),
            "nonnegative": ("positive ", "nonnegative "),
            "unit": ("unit ",),
        }
        keys = [f"{sign}{key}" for sign in words[kind]]
        return any((word, key) in self.facts for word in ("apart", INSIDE) for key in keys)

    def learn_edge(self, kind: str, key: str) -> None:
        """It stays inside its domain over every finite time."""
        self.facts.add((INSIDE, key if kind == "nonzero" else f"{kind} {key}"))

    def is_constant(self, quantity: str) -> bool:
        return all(map(self._is_parameter, self.traits(quantity).reads))

    def is_signal(self, name: str) -> bool:
        """Is it a free symbol that moves and has no motion?"""
        key = _starred(name)
        return self.statement.scalars.get(key) != "parameter" and key not in self.statement.motion

    def state_is_bounded(self, state: str) -> bool:
        return self.free_is_bounded(at_node(state, "i"))

    def state_key(self, state: str) -> str:
        _, domain = self._reading()
        return domain.free(at_node(state, "i")).key

    def free_is_bounded(self, name: str) -> bool:
        _, domain = self._reading()
        return domain.free(name).bounded

    def is_total_of_square(self, total: str, quantity: str) -> bool:
        """Is `total` the sum over nodes of the square of a quantity at a node, or over nodes and neighbours
        of that of one at both?
        """
        walk, domain = self._reading()
        of = self._summed(total, "total")
        binding = {"i": "i"}
        if of is not None and "j" in self.statement.listings[quantity].letters:
            of, binding = self._summed(of, "sum"), {"i": "i", "j": "j"}
        if of is None or self.statement.listings[of].letters - set(binding):
            return False
        inner: Traits = walk.output((of, 0), binding, 0, self.law)
        e: Traits = walk.output((quantity, 0), binding, 0, self.law)
        return inner.key == domain.mul(e, e).key

    def is_total_of(self, total: str, quantity: str) -> bool:
        """Is `total` the sum over nodes of a quantity at a node?"""
        walk, _ = self._reading()
        of = self._summed(total, "total")
        if of is None or self.statement.listings[quantity].letters - {"i"}:
            return False
        inner: Traits = walk.output((of, 0), {"i": "i"}, 0, self.law)
        return inner.key == self.traits(quantity).key

    def _summed(self, listing: str, kind: str) -> str | None:
        """The listing of one output that a listing sums, if a sum is all that it is."""
        code = self.statement.listings[listing].code
        meaning = self.statement.names.get(_starred(code[0].name)) if len(code) == 1 else None
        if (
            meaning is None
            or meaning.kind != kind
            or len(self.statement.listings[meaning.of[0]].outputs) != 1
        ):
            return None
        return meaning.of[0]

    def rate_is_bounded(self, quantity: str, order: int = 1) -> bool:
        return self.traits(rate_listing(quantity, order)).bounded

    def _is_parameter(self, name: str) -> bool:
        return self.statement.scalars.get(_starred(name)) == "parameter"

    def _reading(self) -> tuple[Evaluation[Traits], Reading]:
        """The walk with what is known now."""
        stamp = len(self.facts), len(self.statement.listings)
        if self._stamp != stamp:
            domain = Reading(
                lambda key: ("bounded", key) in self.facts or ("tends", key) in self.facts,
                lambda key: ("apart", key) in self.facts,
                self._is_parameter,
            )
            self._stamp, self._read = stamp, (reading(self.statement, domain), domain)
        walk, known = self._read
        return walk, known


def _starred(name: str) -> str:
    return split_name(name)[0]
