"""Deciding an argument line by line: each becomes lines of the kernel, with the proofs that were found."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from symctrl.certify import certificate
from symctrl.expr import Expr, lift
from symctrl.graph import Tape
from symctrl.kernel.argument import Argument
from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.check import check_text
from symctrl.kernel.closure import rates_exist_where_defined
from symctrl.kernel.rules.roles import Roles
from symctrl.kernel.theorem import RULES, concluded, suppose
from symctrl.kernel.values import Condition, Sentence
from symctrl.rules import tapes
from symctrl.rules.algebra import rate_over
from symctrl.rules.loop import Loop, tape_of
from symctrl.rules.seeker import Abandoned, Outcome, Seeker
from symctrl.rules.tapes import arguments
from symctrl.text import text
from symctrl.theorem import Line

if TYPE_CHECKING:
    from symctrl.theorem import Run

Table = dict[str, Any]


@dataclass(frozen=True)
class Done:
    """One line of the author's, decided: the kernel's lines that it took, and what was not met."""

    line: Line
    outcomes: tuple[Outcome, ...]
    blocked: bool = False

    @property
    def met(self) -> bool:
        return not self.blocked and all(outcome.met for outcome in self.outcomes)

    @property
    def reason(self) -> str:
        if self.blocked:
            return "a line above it is broken"
        return next((f"{o.role}: {o.reason}" for o in self.outcomes if not o.met), "")


@dataclass
class Chain:
    """The state of an argument on its way: the loop, the facts, and the kernel's lines so far.

    again: lines that may give more once more is known of their input, or that solutions exist. hasty: it only
    matters whether the argument closes.
    """

    loop: Loop
    seeker: Seeker
    hasty: bool = False
    at: Argument = field(init=False)
    steps: list[Table] = field(default_factory=list)
    relations: Table = field(default_factory=dict)
    cofactors: dict[str, str] = field(default_factory=dict)
    edges: list[str] = field(default_factory=list)
    conditions: set[Condition] = field(default_factory=set)
    outcomes: list[Outcome] = field(default_factory=list)
    again: list[tuple[str, Table]] = field(default_factory=list)

    def __post_init__(self) -> None:
        stated = frozenset(self.loop.problem.motion)
        self.at = Argument(self.loop.statement, (), self.seeker, stated=stated)
        suppose(self.at)
        self.edges = self._edges()
        self.cofactors = self._cofactors()
        self.seeker.outcomes = []
        self.at.begin(self.cofactors, self.edges)
        self.relations = self._proofs()
        self.outcomes = self.seeker.outcomes

    def _edges(self) -> list[str]:
        """What the field divides by, and is not made of parameters alone."""
        if not rates_exist_where_defined(self.at.statement, self.at.law):
            return []
        strict = {key for kind, _, key in (e.partition(" ") for e in self.at.edges()) if kind == "nonzero"}
        named = dict.fromkeys(map(self.q, arguments(list(self.loop.collector.listings.values()))))
        return [q for q in named if self.at.traits(q).key in strict and not self.at.is_constant(q)]

    def _cofactors(self) -> dict[str, str]:
        """For each equation g = 0 about states whose rate is not zero by itself, c with g' = c g."""
        seeker = Seeker(self.seeker.id, thorough=False)
        trial = Argument(self.at.statement, (), seeker)
        trial.begin({}, self.edges)
        tried = [outcome for outcome in seeker.outcomes if outcome.problem is not None]
        found = {}
        for (quantity, _), outcome in zip(trial.relations, tried, strict=True):
            tape = None if outcome.met else rate_over(self, quantity)
            if tape is not None:
                found[quantity] = self.q(tape)
        return found

    # Quantities

    def q(self, what: Expr | Tape | int | str) -> str:
        """The quantity of a scalar expression or tape."""
        name = self.loop.quantity(what if isinstance(what, Tape) else lift(what))
        self.at.statement = self.loop.statement
        self.at.quantities = tuple(self.loop.quantities)
        return name

    def qs(self, what: Sequence[Expr]) -> list[str]:
        return [self.q(one) for one in what]

    def having(self, word: str) -> list[str]:
        """The quantities with a fact, in the order in which they came."""
        return [
            name
            for name in self.loop.quantities
            if any((word, key) in self.at.facts for key in self.at.keys(name))
        ]

    # Lines of the kernel

    def run(self, rule: str, table: Mapping[str, Any]) -> bool:
        """Try a line with all its obligations, refuting where it can; its facts count if all are met."""
        if self.hasty:
            return self.attempt(rule, table) or self.fail(rule, "an obligation is not met")
        met = self._tried(rule, table, thorough=True)
        self.outcomes += self.seeker.outcomes
        return met

    def attempt(self, rule: str, table: Mapping[str, Any]) -> bool:
        """Try a line; one that fails leaves no trace."""
        met = self._tried(rule, table, thorough=False, brief=True)
        if met:
            self.outcomes += self.seeker.outcomes
        return met

    def first(self, rule: str, tables: Sequence[Mapping[str, Any]]) -> bool:
        """The first of the tables that works; if none does, what the best of them lacks."""
        best, fewest = tables[0], None
        for table in tables:
            if self._tried(rule, table, thorough=False, brief=self.hasty):
                self.outcomes += self.seeker.outcomes
                return True
            unmet = sum(not outcome.met for outcome in self.seeker.outcomes)
            if fewest is None or unmet < fewest:
                best, fewest = table, unmet
        return self.run(rule, best)

    def fail(self, role: str, reason: str) -> bool:
        self.outcomes.append(Outcome(role, False, reason))
        return False

    def _tried(self, rule: str, table: Mapping[str, Any], thorough: bool, brief: bool = False) -> bool:
        before = set(self.at.facts), list(self.at.available), list(self.at.initial)
        statement = self.at.statement
        self.seeker.outcomes, self.seeker.thorough, self.seeker.brief = [], thorough, brief
        roles = Roles(dict(table), self.at.quantities, rule)
        try:
            RULES[rule](self.at, roles)
            roles.close()
        except Abandoned:
            pass
        except (Invalid, Declined) as error:
            self.seeker.outcomes.append(Outcome(rule, False, str(error)))
        self.seeker.brief = False
        if all(outcome.met for outcome in self.seeker.outcomes):
            self.steps.append({"rule": rule, "of": dict(table), "proofs": self._proofs()})
            return True
        self.at.facts, self.at.available, self.at.initial = before
        self.at.statement = statement
        return False

    def _proofs(self) -> Table:
        proofs: Table = {}
        for outcome in self.seeker.outcomes:
            if outcome.proof is not None:
                proofs[outcome.role] = {"given": list(outcome.given), "proof": outcome.proof}
                self.conditions |= set(outcome.conditions)
        return proofs

    # The whole

    def decided(
        self, lines: Sequence[Line], planners: Mapping[str, Callable[[Chain, Mapping[str, Any]], bool]]
    ) -> Iterator[Done]:
        """The author's lines in turn; those below a broken one are blocked."""
        broken = any(not o.met for o in self.outcomes)
        for line in lines:
            if broken:
                yield Done(line, (), blocked=True)
                continue
            self.outcomes = []
            try:
                broken = not planners[line.rule](self, line.what)
            except (Invalid, Declined) as error:
                broken = not self.fail(line.rule, str(error))
            yield Done(line, tuple(map(self.worded, self.outcomes)))

    def said(self, name: str) -> str:
        """A quantity in the author's words, or as the formula that it is; any other name as it stands."""
        if name not in self.loop.quantities:
            return name
        expr = self.loop.quantities[name]
        return tapes.said(tape_of(self.at.statement.listings[name])) if expr is None else text(expr)

    def worded(self, outcome: Outcome) -> Outcome:
        """The outcome with expressions in the place of the names of quantities."""

        def shown(match: re.Match[str]) -> str:
            return self.said(match.group())

        role, reason = (re.sub(r"\bx\d+\b", shown, said) for said in (outcome.role, outcome.reason))
        return replace(outcome, role=role, reason=reason)

    def open_conclusions(self) -> list[Sentence]:
        """The conclusions that no line has given yet."""
        claim = self.loop.statement.claim
        return [s for s in (Sentence("exists", ()), *claim.then) if not concluded(self.at, s)]

    def certificate(self) -> Table:
        """The certificate of the whole argument, with the lines and quantities that it needs."""
        named = [name for step in self.steps for name in _named(step["of"], self.at.quantities)]
        used = list(dict.fromkeys([*self.edges, *self.cofactors.values(), *named]))
        proof = {
            "kind": "argument",
            **self.loop.added(used),
            "quantities": used,
            "edges": self.edges,
            "relations": self.relations,
            "cofactors": self.cofactors,
            "lines": self.steps,
        }
        conditions = sorted(self.conditions, key=lambda c: (c.kind, c.of))
        stated = self.loop.problem.statement([{"kind": c.kind, "of": c.of} for c in conditions])
        return certificate(json.loads(json.dumps(stated)), json.loads(json.dumps(proof)))


def accepted(made: Mapping[str, Any]) -> str | None:
    """None where the kernel accepts the certificate, else what it says."""
    answer = check_text(json.dumps(made))
    return None if answer.status == "valid" else f"{answer.status}: {answer.reason}"


def recorded(write: Callable[[Run], Any]) -> list[Line]:
    """The lines that the author's function writes."""
    from symctrl.theorem import Run

    run = Run()
    write(run)
    return run.lines


def _named(of: Any, known: Sequence[str]) -> Iterator[str]:
    """The quantities that a line's table names."""
    if isinstance(of, str):
        if of in known:
            yield of
    elif isinstance(of, Mapping):
        for key, value in of.items():
            if key in known:
                yield key
            yield from _named(value, known)
    elif isinstance(of, list | tuple):
        for value in of:
            yield from _named(value, known)
