"""Looking for the proofs of obligations, which the kernel then accepts or not, one by one."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any

from symctrl.decide.decision import DECIDERS, PROVERS
from symctrl.decide.place import Place
from symctrl.decide.points import points
from symctrl.decide.solve import NoPoint
from symctrl.decide.witness import Witness, fails_at, refute
from symctrl.domains.domain import Unsupported
from symctrl.domains.opaque import NowhereDefined
from symctrl.domains.tangent import NotDifferentiable
from symctrl.evaluate import NoRate
from symctrl.graph import Tape
from symctrl.kernel import values as kernel
from symctrl.kernel.argument import OBLIGATION, Argument, Obligation
from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.theorem import proved
from symctrl.kernel.values import Condition
from symctrl.problem import Assumption, Claim, Meaning, Problem
from symctrl.reach import pruned
from symctrl.rules import totals
from symctrl.rules.loop import assumption_of, tape_of

FIRST_TRIES, TRIES = 3, 200  # points at which an obligation is tried, before and after a proof
NO_MEANING = (Unsupported, NowhereDefined, NotDifferentiable, NoRate, NoPoint)


@dataclass(frozen=True)
class Outcome:
    """What came of one obligation. problem: of a pointwise one. given: the numbers of assumptions used."""

    role: str
    met: bool
    reason: str
    problem: Problem | None = None
    given: tuple[int, ...] = ()
    proof: Any = None
    conditions: tuple[Condition, ...] = ()
    witness: Witness | None = None


Memory = dict[str, tuple[Outcome, tuple[Assumption, ...]]]  # by digest; what the proof assumes, in order


class Abandoned(Exception):  # noqa: N818
    """An obligation is not met, and nobody asks for the others."""


class Seeker:
    """The judge of an argument that is being looked for: it notes every outcome and goes on.

    thorough: an obligation without a proof is also tried to be refuted. brief: the first that is not met ends
    the search. memory: outcomes of other searches
    for the same theorem.
    """

    def __init__(self, id_: str, thorough: bool = True, memory: Memory | None = None) -> None:
        self.id = id_
        self.thorough = thorough
        self.brief = False
        self.outcomes: list[Outcome] = []
        self.tapes: dict[int, tuple[kernel.Listing, Tape]] = {}
        self.meanings: dict[int, tuple[kernel.Meaning, Meaning]] = {}
        self.memory: Memory = {} if memory is None else memory
        self.pointless: set[tuple[str, ...]] = set()
        self.places: dict[tuple[str, ...], tuple[frozenset[str], tuple[Place, ...]]] = {}

    def prove(self, at: Argument, obligation: Obligation) -> None:
        usable = at.usable(obligation)
        problem = self.problem(at.composed(obligation, usable), usable)
        own = [assumption_of(a) for a in usable]
        known = self.memory.get(problem.sha256)
        if known is not None and not set(known[1]) <= set(own):
            known = None
        if known is None or (self.thorough and not known[0].met and not known[0].witness):
            outcome = self._outcome(at, obligation, usable, problem)
            known = self.memory[problem.sha256] = outcome, tuple(own[k] for k in outcome.given)
        numbers = tuple(own.index(a) for a in known[1])
        self.outcomes.append(replace(known[0], role=obligation.role, given=numbers))
        self._go_on()

    def require(self, role: str, holds: bool, why: str) -> None:
        if not holds:
            self.outcomes.append(Outcome(role, False, why))
            self._go_on()

    def _go_on(self) -> None:
        if self.brief and not self.outcomes[-1].met:
            raise Abandoned

    def problem(self, statement: kernel.Statement, usable: Sequence[kernel.Assumption]) -> Problem:
        """The composed statement as a problem, with what it reads."""
        claim = statement.claim
        made = Claim(claim.kind, OBLIGATION, claim.shape, claim.matrix)
        whole = Problem(
            statement.study,
            self.id,
            "",
            {name: self._tape(listing) for name, listing in statement.listings.items()},
            made,
            statement.scalars,
            {name: self._meaning(meaning) for name, meaning in statement.names.items()},
            statement.motion,
            statement.laws,
            tuple(assumption_of(a) for a in usable),
        )
        return pruned(whole)

    def _tape(self, listing: kernel.Listing) -> Tape:
        if id(listing) not in self.tapes:
            self.tapes[id(listing)] = listing, tape_of(listing)
        return self.tapes[id(listing)][1]

    def _meaning(self, meaning: kernel.Meaning) -> Meaning:
        if id(meaning) not in self.meanings:
            constant = meaning.kind == "constant"
            made = Meaning(
                meaning.kind,
                None if constant else meaning.of,
                meaning.law,
                str(meaning.value) if constant else None,
            )
            self.meanings[id(meaning)] = meaning, made
        return self.meanings[id(meaning)][1]

    def _outcome(
        self, at: Argument, obligation: Obligation, usable: Sequence[kernel.Assumption], problem: Problem
    ) -> Outcome:
        own = [assumption_of(a) for a in usable]
        numbers = tuple(own.index(a) for a in problem.given)
        false = self._first_look(problem)
        if false is not None:
            return Outcome(obligation.role, False, false.says, problem, numbers, witness=false)
        try:
            proof = PROVERS[problem.claim.kind](problem)
            if proof is None and problem.claim.kind == "nonnegative" and totals.speaks_of_totals(problem):
                numbers, proof = self._of_totals(at, obligation, usable, numbers)
        except NO_MEANING as error:
            return Outcome(obligation.role, False, str(error), problem)
        reason = "no proof was found"
        if proof is not None:
            proof = json.loads(json.dumps(proof))
            try:
                conditions = proved(at, obligation, list(numbers), proof)
            except (Invalid, Declined) as error:
                refused = f"a proof was found, and the kernel does not accept it: {error}"
                return Outcome(obligation.role, False, refused, problem, numbers)
            else:
                accepted = tuple(sorted(conditions, key=lambda c: (c.kind, c.of)))
                return Outcome(obligation.role, True, "proved", problem, numbers, proof, accepted)
        if not self.thorough:
            return Outcome(obligation.role, False, reason, problem, numbers)
        return self._refuted(obligation, problem, numbers, reason)

    def _first_look(self, problem: Problem) -> Witness | None:
        """A witness among a few points: what is false by much is refuted before it is evaluated exactly."""
        under = tuple(a.text for a in problem.given)
        if problem.claim.matrix is not None or under in self.pointless:
            return None
        scalars = frozenset(problem.scalars)
        known, places = self.places.get(under, (frozenset(), ()))
        try:
            if not scalars <= known:
                places = tuple(islice(points(problem), FIRST_TRIES))
                self.places[under] = scalars, places
            return fails_at(problem, places)
        except NO_MEANING:
            self.pointless.add(under)
            return None

    def _of_totals(
        self,
        at: Argument,
        obligation: Obligation,
        usable: Sequence[kernel.Assumption],
        numbers: tuple[int, ...],
    ) -> tuple[tuple[int, ...], Any]:
        """A proof node by node, or mode by mode without the equations about states."""
        statement = at.composed(obligation, [usable[k] for k in numbers])
        proof = totals.each(statement, self.problem(statement, statement.given), self.problem)
        if proof is not None:
            return numbers, proof
        plain = tuple(k for k, a in enumerate(usable) if a.kind != "zero" and not at.reads_states(a))
        statement = at.composed(obligation, [usable[k] for k in plain])
        problem = self.problem(statement, statement.given)
        own = [assumption_of(usable[k]) for k in plain]
        kept = tuple(plain[own.index(a)] for a in problem.given)
        bounds = [k for k in plain if usable[k].kind == "laplacian_bound" and k not in kept]
        chosen = tuple(sorted({*kept, *bounds}))
        statement = at.composed(obligation, [usable[k] for k in chosen])
        return chosen, totals.spectral(statement, problem, self.problem)

    def _refuted(
        self, obligation: Obligation, problem: Problem, numbers: tuple[int, ...], reason: str
    ) -> Outcome:
        try:
            if problem.claim.matrix is None:
                witness = refute(problem, TRIES)
            else:
                witness = DECIDERS[problem.claim.kind](problem).witness
        except NO_MEANING as error:
            return Outcome(obligation.role, False, f"{reason}; {error}", problem, numbers)
        if witness is None:
            why = f"{reason}, and none of {TRIES} points refutes it"
            return Outcome(obligation.role, False, why, problem, numbers)
        return Outcome(obligation.role, False, witness.says, problem, numbers, witness=witness)
