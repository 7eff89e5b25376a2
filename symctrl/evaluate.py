"""The values of a problem's names in any domain: definitions, rates along the motion, laws, sums over a
fleet.

Every quantity has a value at level 0; at level n it is the pair of its value and its derivative at level n -
1 (domains.tangent). A rate is the derivative part of what it rates, one level higher. A binding says which
nodes the letters i and j of a fleet's listings stand for.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any, Protocol

from symctrl.domains.domain import Domain
from symctrl.domains.tangent import Pair, Tangent
from symctrl.graph import interpret
from symctrl.problem import Output, Problem, split, star

Binding = tuple[tuple[str, str], ...]  # letter -> node


class NoRate(ValueError):  # noqa: N818
    """A rate of something that has no motion and is not constant; the message says what to declare."""


class Sums(Protocol):
    """What a sum over neighbours or over all nodes is: generators, or sums over a given graph."""

    def value(self, at: Environment, name: str, level: int, law: str | None) -> Any:
        """The value of the sum or total `name` (its node resolved) at `level`."""


class Environment:
    """Evaluates names and listings of one problem in one domain, each once.

    free: the value of a free scalar by its resolved name, at level 0.
    """

    def __init__(self, problem: Problem, domain: Domain[Any], free: Callable[[str], Any], sums: Sums) -> None:
        self.problem = problem
        self.free = free
        self.sums = sums
        self._domains: list[Domain[Any]] = [domain]
        self._listings: dict[tuple[str, int, str | None, Binding], list[Any]] = {}
        self._names: dict[tuple[str, int, str | None], Any] = {}

    def domain(self, level: int) -> Domain[Any]:
        while len(self._domains) <= level:
            self._domains.append(Tangent(self._domains[-1]))
        return self._domains[level]

    def outputs(
        self, listing: str, binding: Mapping[str, str], level: int = 0, law: str | None = None
    ) -> list[Any]:
        """All outputs of a listing at a level, with the law's inputs replaced by the law."""
        tape = self.problem.tape(listing)
        letters = {node for name in tape.inputs if (node := split(name)[1])}
        relevant = tuple(sorted((letter, node) for letter, node in binding.items() if letter in letters))
        key = (listing, level, law, relevant)
        if key not in self._listings:
            values = {name: self.name(resolved(name, binding), level, law) for name in tape.inputs}
            self._listings[key] = interpret(tape, self.domain(level), values)
        return self._listings[key]

    def output(self, of: Output, binding: Mapping[str, str], level: int = 0, law: str | None = None) -> Any:
        return self.outputs(of[0], binding, level, law)[of[1]]

    def name(self, name: str, level: int, law: str | None) -> Any:
        """The value of a scalar whose node, if any, is resolved."""
        key = (name, level, law)
        if key not in self._names:
            self._names[key] = self._evaluated(name, level, law)
        return self._names[key]

    def _evaluated(self, name: str, level: int, law: str | None) -> Any:
        node = split(name)[1]
        at = {"i": node} if node else {}
        general = star(name)
        meaning = self.problem.names.get(general)
        if meaning is None:
            defined_by = self.problem.laws.get(law, {}).get(general) if law else None
            if defined_by is not None:
                return self.output(defined_by, at, level, law)
            return self._free(name, general, level, law)
        if meaning.is_ == "constant":
            return self.domain(level).constant(Fraction(meaning.value or "0"))
        assert meaning.of is not None
        if meaning.is_ == "value":
            return self.output(meaning.of, at, level, law)
        if meaning.is_ == "rate":
            raised = self.output(meaning.of, at, level + 1, meaning.law or law)
            return self._derivative(raised, level)
        return self.sums.value(self, name, level, law)

    def _free(self, name: str, general: str, level: int, law: str | None) -> Any:
        if level == 0:
            return self.free(name)
        below = self.name(name, level - 1, law)
        if self.problem.scalars[general] == "parameter":
            return Pair(below)
        if general not in self.problem.motion:
            raise NoRate(_no_motion(name, self.problem.scalars[general], law))
        node = split(name)[1]
        return Pair(
            below, self.output(self.problem.motion[general], {"i": node} if node else {}, level - 1, law)
        )

    def _derivative(self, raised: Any, level: int) -> Any:
        """The derivative part of a value one level up: at level 0 the derivative itself."""
        if raised.derivative is not None:
            return raised.derivative
        return self.domain(level).constant(Fraction(0))


def resolved(name: str, binding: Mapping[str, str]) -> str:
    """The name with its node letter replaced by the node that it is bound to."""
    base, node, index = split(name)
    return name if node is None else f"{base}.{binding.get(node, node)}{index}"


def _no_motion(name: str, kind: str, law: str | None) -> str:
    if kind == "input":
        under = f"the law {law} does not give it" if law else "no law is given"
        return f"the rate depends on the input {name}, and {under}: study.rate(x, law)"
    if kind == "signal":
        return f"the rate depends on the rate of the signal {name}, which has no motion"
    return f"the state {name} has no motion: study.motion(...)"
