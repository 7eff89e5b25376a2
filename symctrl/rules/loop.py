"""The closed loop of a theorem as pure data: motion, laws, assumptions, conclusions, and quantities beside."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from symctrl.collect import Collector
from symctrl.entries import component_names
from symctrl.expr import Expr
from symctrl.facts import SETS, Fact
from symctrl.graph import Instruction, Tape
from symctrl.kernel import values as kernel
from symctrl.kernel.argument import extended
from symctrl.kernel.compose import rates_of
from symctrl.kernel.form import read_statement
from symctrl.problem import Assumption, Claim, Meaning, Output, Problem, split, star
from symctrl.records import rate
from symctrl.theorem import Theorem
from symctrl.written import Law, StudyError

if TYPE_CHECKING:
    from symctrl.study import Study

Sentence = dict[str, Any]


class Loop:
    """The problem of a theorem, and more quantities as they are asked for.

    problem: the theorem alone, its statement. statement: the kernel's form of it with all quantities and rates.
    """

    def __init__(self, study: Study, theorem: Theorem, id_: str) -> None:
        self.study = study
        self.theorem = theorem
        self.laws = _laws_of(study, theorem)
        self.law = " and ".join(law.name for law in self.laws) or None
        self.collector = Collector(study)
        self.suppose, self.then = self._claim_listing(theorem)
        self._close()
        for given in theorem.given:
            self.collector.assume(given.claim, given.about)
            self._close()
        with study.along_trajectory(True):
            self.collector._assume_what_occurs()
        self._close()
        self.problem = self._tables(Problem(study.name, id_, theorem.text(), {}, self._claim()))
        self.statement = extended(read_statement(self.problem.statement()), ())
        self.quantities: dict[str, Expr | None] = {}
        self._by_tape: dict[str, str] = {}

    def quantity(self, what: Expr | Tape) -> str:
        """The name of a scalar expression, or of a tape of one output, as a quantity of the argument."""
        name = f"x{len(self.quantities) + 1}"
        if isinstance(what, Tape):
            self.collector.listings[name] = what
        else:
            self.collector.add(name, [what])
        tape = self.collector.listings[name]
        known = self._by_tape.get(tape.sha256)
        if known is not None:
            del self.collector.listings[name]
            return known
        self._by_tape[tape.sha256] = name
        self.quantities[name] = what if isinstance(what, Expr) else None
        self._close()
        self._extend(name)
        return name

    def rate(self, what: Expr) -> Expr:
        """The rate of an expression along the closed loop."""
        return rate(what, self.laws[0].name if self.law is not None else None)

    def _extend(self, quantity: str) -> None:
        """Bring the kernel's statement up to the collector's tables."""
        whole = self._tables(self.problem)
        new = {k: listing_of(t) for k, t in whole.listings.items() if k not in self.statement.listings}
        names = {k: meaning_of(m) for k, m in whole.names.items() if k not in self.statement.names}
        rate_listings, rates = rates_of(quantity, new[quantity], self.law)
        self.statement = replace(
            self.statement,
            listings={**self.statement.listings, **new, **rate_listings},
            names={**self.statement.names, **names, **rates},
            scalars={**self.statement.scalars, **whole.scalars},
            motion={**self.statement.motion, **whole.motion},
            laws={**self.statement.laws, **whole.laws},
        )

    def added(self, used: Sequence[str]) -> dict[str, Any]:
        """What the argument has beside the statement: the tables of its proof, with the quantities used."""
        whole = self._tables(self.problem)
        from symctrl.reach import Reach

        reach = Reach(whole)
        for quantity in used:
            reach.listing(quantity, 0, None)
            reach.listing(quantity, 0, self.law)
        reached = {name for name, _, _ in reach.visits}
        moved = {n for n in whole.motion if n in reach.read}
        while True:
            for n in moved:
                reach.listing(whole.motion[n][0], 0, self.law)
            more = {n for n in whole.motion if n in reach.read} - moved
            reached = {name for name, _, _ in reach.visits}
            if not more:
                break
            moved |= more
        old = self.problem
        return {
            "listings": {
                n: t.as_json() | {"sha256": t.sha256}
                for n, t in whole.listings.items()
                if n in reached and n not in old.listings
            },
            "names": {n: m.as_json() for n, m in whole.names.items() if n in reach.read and n not in old.names},
            "scalars": {n: k for n, k in whole.scalars.items() if n in reach.read and n not in old.scalars},
            "motion": {n: list(of) for n, of in whole.motion.items() if n in moved and n not in old.motion},
            "laws": {},
        }

    def _close(self) -> None:
        """Add the motion, under the law, of every state that occurs."""
        for law in self.laws:
            if any(u in self.collector.scalars for u in _targets(law)):
                self.collector._law(law.name)
        done: set[str] = set()
        while True:
            states = [n for n, kind in self.collector.scalars.items() if kind != "parameter" and n not in done]
            if not states:
                return
            for name in states:
                done.add(name)
                self.collector._add_motion(name)
                if self.collector.scalars[name] == "state" and name not in self.collector.motion:
                    raise StudyError(f"the state {name} has no motion: study.motion({split(name)[0]}, ...)")
            for law in self.laws:
                if any(u in self.collector.scalars for u in _targets(law)):
                    self.collector._law(law.name)

    def _tables(self, problem: Problem) -> Problem:
        """The problem with what has been collected, and one law for the closed loop."""
        c = self.collector
        own = [law.name for law in self.laws]
        joint = {u: of for name in own for u, of in c.laws.get(name, {}).items()}
        laws: dict[str, Mapping[str, Output]] = {n: table for n, table in c.laws.items() if n not in own}
        if self.law is not None and joint:
            laws[self.law] = joint
        names = {n: replace(m, law=self.law) if m.law in own else m for n, m in c.names.items()}
        return replace(
            problem,
            listings=dict(c.listings),
            scalars=dict(c.scalars),
            names=names,
            motion=dict(c.motion),
            laws=laws,
            given=tuple(c.given),
        )

    def _claim_listing(self, theorem: Theorem) -> tuple[list[Sentence], list[Sentence]]:
        exprs: list[Expr] = []
        parts = []
        for facts in (theorem.suppose, theorem.then):
            parts.append([self._sentence(fact, exprs) for fact in facts])
        self.collector.add("claim", exprs or [_zero()])
        return parts[0], parts[1]

    def _sentence(self, fact: Fact, exprs: list[Expr]) -> Sentence:
        made: Sentence = {"word": fact.word, "of": []}
        if fact.at:
            made["at"] = self._point(fact)
        count = sum(e.shape[0] * e.shape[1] for e in exprs)
        if fact.of is not None:
            exprs.append(fact.of)
            made["of"] = list(range(count, count + fact.of.shape[0]))
            count += fact.of.shape[0]
        if fact.by is not None:
            exprs.append(fact.by)
            made["by"] = count
        return made | ({"zero": True} if fact.zero and fact.word in SETS else {})

    def _point(self, fact: Fact) -> dict[str, str]:
        return {name: str(value) for name, value in scalars_at(self.study, fact.at, fact.word).items()}

    def _claim(self) -> Claim:
        theorem = {"law": self.law if self._law_is_used() else None, "suppose": self.suppose, "then": self.then}
        if theorem["law"] is None:
            self.law = None
        return Claim("theorem", "claim", theorem=theorem)

    def _law_is_used(self) -> bool:
        return any(self.collector.laws.get(law.name) for law in self.laws)


def scalars_at(study: Study, at: Mapping[str, Sequence[Any]], what: str) -> dict[str, Any]:
    """Numbers by scalar name, from numbers by symbol. Raises StudyError for unknown symbols and wrong sizes."""
    from difflib import get_close_matches

    found: dict[str, Any] = {}
    for name, numbers in at.items():
        declared = study.symbols.get(name)
        if declared is None:
            near = get_close_matches(name, study.symbols, 3, 0.4) or list(study.symbols)[:8]
            raise StudyError(f"{what}: {name} is no symbol of {study.name}; it has {', '.join(near)}")
        names = component_names(name, declared.expr.shape, declared.expr.args[2])
        if len(names) != len(numbers):
            raise StudyError(f"{what}: {name} has {len(names)} components, and {len(numbers)} numbers were given")
        found |= dict(zip(names, numbers, strict=True))
    return found


def listing_of(tape: Tape) -> kernel.Listing:
    """The kernel's form of a tape."""
    steps = tuple(kernel.Step(s.op, s.args, s.name, s.value) for s in tape.code)
    return kernel.Listing(steps, tape.outputs, tape.sha256)


def tape_of(listing: kernel.Listing) -> Tape:
    """The tape of the kernel's listing."""
    return Tape(tuple(Instruction(s.op, s.args, s.name, s.value) for s in listing.code), listing.outputs)


def meaning_of(meaning: Meaning) -> kernel.Meaning:
    of = meaning.of if meaning.of is not None else ("", 0)
    from fractions import Fraction

    return kernel.Meaning(meaning.is_, Fraction(meaning.value or 0), of, meaning.law)


def assumption_of(a: kernel.Assumption) -> Assumption:
    return Assumption(a.kind, a.of, a.text, a.about, a.size)


def _laws_of(study: Study, theorem: Theorem) -> list[Law]:
    laws = list(theorem.laws) if theorem.laws is not None else list(study.laws.values())
    targets: dict[str, str] = {}
    for law in laws:
        for u in _targets(law):
            if targets.setdefault(u, law.name) != law.name:
                raise StudyError(
                    f"two laws give {u}, {targets[u]} and {law.name}: say which closes the loop, claim(.., laws=[..])"
                )
    return laws


def _targets(law: Law) -> list[str]:
    target = law.target
    return [star(n) for n in component_names(target.args[0].replace(".i", ".*"), target.shape)]


def _zero() -> Expr:
    from symctrl.expr import lift

    return lift(0)
