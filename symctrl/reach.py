"""What the evaluation of a problem reads: listings at which level and under which law, names, motions, laws.

A problem holds exactly what is read: `pruned` leaves out the rest.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol

from symctrl.graph import Instruction, Tape
from symctrl.problem import LEMMA, OBLIGATION, PROVED, Assumption, Meaning, Output, Problem, star

Visit = tuple[str, int, str | None]  # listing, level, law


class Tables(Protocol):
    """A problem, or one that is being collected."""

    @property
    def listings(self) -> Mapping[str, Tape]: ...
    @property
    def names(self) -> Mapping[str, Meaning]: ...
    @property
    def scalars(self) -> Mapping[str, str]: ...
    @property
    def motion(self) -> Mapping[str, Output]: ...
    @property
    def laws(self) -> Mapping[str, Mapping[str, Output]]: ...


@dataclass
class Reach:
    """Visits listings recursively. closed: definitions that are not entered, where they are read at level 0.

    wanted: called with a state whose motion is needed and not there; it may add it.
    """

    tables: Tables
    closed: Collection[str] = ()
    wanted: Callable[[str], None] = lambda _: None
    visits: set[Visit] = field(default_factory=set)
    read: set[str] = field(default_factory=set)
    moved: set[str] = field(default_factory=set)
    replaced: set[tuple[str, str]] = field(default_factory=set)
    rated: set[tuple[str, str | None]] = field(default_factory=set)

    def listing(self, name: str, level: int = 0, law: str | None = None) -> None:
        if (name, level, law) in self.visits:
            return
        self.visits.add((name, level, law))
        for scalar in self.tables.listings[name].inputs:
            self._name(star(scalar), level, law)

    def _name(self, name: str, level: int, law: str | None) -> None:
        self.read.add(name)
        if level > 0:
            self.rated.add((name, law))
        meaning = self.tables.names.get(name)
        if meaning is None:
            self._scalar(name, level, law)
        elif meaning.of is not None:
            if meaning.is_ == "rate":
                level, law = level + 1, meaning.law or law
            if meaning.is_ == "value" and meaning.of[0] in self.closed:
                self.visits.add((meaning.of[0], level, law))
            else:
                self.listing(meaning.of[0], level, law)

    def _scalar(self, name: str, level: int, law: str | None) -> None:
        given = self.tables.laws[law].get(name) if law else None
        if given is not None and law is not None:
            self.replaced.add((law, name))
            self.listing(given[0], level, law)
        elif level > 0 and self.tables.scalars[name] != "parameter":
            if name not in self.tables.motion:
                self.wanted(name)
            if name in self.tables.motion:
                self.moved.add(name)
                for below in range(level):
                    self.listing(self.tables.motion[name][0], below, law)


def pruned(problem: Problem, closed: Collection[str] = ()) -> Problem:
    """The problem with only what its claim and the assumptions about that read. closed: definitions taken as
    free.
    """
    reach = Reach(problem, closed)
    reach.listing(problem.claim.listing)
    kept: list[Assumption] = []
    waiting = list(problem.given)
    while True:
        ready = [a for a in waiting if _is_about(problem, a, reach.read)]
        if not ready:
            break
        for assumption in ready:
            waiting.remove(assumption)
            kept.append(assumption)
            for of in assumption.of:
                reach.listing(of[0])
    order = {id(a): k for k, a in enumerate(problem.given)}
    kept.sort(key=lambda a: order[id(a)])
    names = {n: m for n, m in problem.names.items() if n in reach.read and not _is_closed(m, closed)}
    scalars = {n: k for n, k in problem.scalars.items() if n in reach.read or n in reach.moved}
    scalars |= {n: "signal" for n, m in problem.names.items() if n in reach.read and _is_closed(m, closed)}
    laws = {
        law: {u: of for u, of in table.items() if (law, u) in reach.replaced}
        for law, table in problem.laws.items()
    }
    laws = {law: table for law, table in laws.items() if table}
    entered = {name for name, _, _ in reach.visits} - set(closed)
    return replace(
        problem,
        listings={name: tape for name, tape in problem.listings.items() if name in entered},
        names={n: _without_idle_law(m, laws) for n, m in names.items()},
        scalars=scalars,
        motion={n: of for n, of in problem.motion.items() if n in reach.moved},
        laws=laws,
        given=tuple(kept),
        uses=tuple(use for use in problem.uses if use.listing in entered),
    )


def closings(problem: Problem) -> Iterator[Problem]:
    """The problem with definitions taken as free symbols: all that can be, those that reach a division, those
    that divide.

    What holds for all values of these symbols holds for those of the definitions. A definition can be closed
    where it is read only at level 0.
    """
    every = {m.of[0] for m in problem.names.values() if m.is_ == "value" and m.of is not None}
    dividing = {name for name in every if _divides(problem, name)}
    reaching = {name for name in every if _reaches(problem, name, dividing)}
    tried: list[set[str]] = [set()]
    for wanted in (every, reaching, dividing):
        candidates = _closable(problem, wanted)
        if candidates not in tried:
            tried.append(candidates)
            yield pruned(problem, candidates)


def _closable(problem: Problem, candidates: set[str]) -> set[str]:
    """Those of the candidates that are read, and only at level 0, when all of them are closed."""
    while candidates:
        reach = Reach(problem, candidates)
        reach.listing(problem.claim.listing)
        for assumption in problem.given:
            if assumption.about == PROVED:
                for listing, _ in assumption.of:
                    reach.listing(listing)
        moving = {name for name, level, _ in reach.visits if name in candidates and level > 0}
        if not moving:
            return candidates & {name for name, _, _ in reach.visits}
        candidates = candidates - moving
    return candidates


def _reaches(problem: Problem, name: str, wanted: Collection[str]) -> bool:
    reach = Reach(problem)
    reach.listing(name)
    return any(listing in wanted for listing, _, _ in reach.visits)


def _divides(problem: Problem, name: str) -> bool:
    """By something else than a number?"""
    code = problem.listings[name].code
    by = [code[step.args[1]].op for step in code if step.op == "DIV"]
    return any(op != "CONST" for op in by) or any(step.op == "INV" for step in code)


def with_motion(problem: Problem, name: str, size: Sequence[str], listing: str) -> Problem:
    """The problem in which a name is a state of its own whose motion is a listing.

    size: its scalars, starred. Where the name is the rate of plain states, their motion is the name from now
    on.
    """
    names = {n: m for n, m in problem.names.items() if n not in size}
    scalars = dict(problem.scalars) | dict.fromkeys(size, "state")
    motion = dict(problem.motion) | {scalar: (listing, k) for k, scalar in enumerate(size)}
    listings = dict(problem.listings)
    meaning = problem.names[size[0]]
    assert meaning.of is not None
    rated = listings[meaning.of[0]]
    states = [rated.code[r].name for r in rated.outputs if rated.code[r].op == "INPUT"]
    if meaning.is_ == "rate" and len(states) == len(size):
        again = f"motion by {name}"
        code = tuple(Instruction("INPUT", name=scalar.replace(".*", ".i")) for scalar in size)
        listings[again] = Tape(code, tuple(range(len(size))))
        motion |= {star(state): (again, k) for k, state in enumerate(states)}
    return replace(problem, names=names, scalars=scalars, motion=motion, listings=listings)


def _is_about(problem: Problem, assumption: Assumption, read: Collection[str]) -> bool:
    """Does a state or signal of the assumption occur, or any symbol of one that is about parameters only?"""
    if assumption.about == OBLIGATION:
        return True
    symbols = {star(n) for of in assumption.of for n in problem.listings[of[0]].inputs}
    if assumption.about in (PROVED, LEMMA) and symbols & set(read):
        return True
    if assumption.about == LEMMA:  # sums over all nodes have to do with each other
        return _has_total(problem, symbols) and _has_total(problem, read)
    if assumption.about == PROVED:
        return False
    kinds = {problem.scalars.get(n, "name") for n in symbols}
    occurring = symbols & set(read)
    if kinds == {"parameter"}:
        return bool(occurring)
    return not symbols or any(problem.scalars.get(n, "name") != "parameter" for n in occurring)


def _has_total(problem: Problem, names: Collection[str]) -> bool:
    return any(name in problem.names and problem.names[name].is_ == "total" for name in names)


def _is_closed(meaning: Meaning, closed: Collection[str]) -> bool:
    return meaning.is_ == "value" and meaning.of is not None and meaning.of[0] in closed


def _without_idle_law(meaning: Meaning, laws: Mapping[str, object]) -> Meaning:
    return replace(meaning, law=None) if meaning.law is not None and meaning.law not in laws else meaning
