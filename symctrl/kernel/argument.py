"""An argument for a theorem: a chain of rules, each with its obligations and what it gives.

Soundness-critical. Last reviewed 2026-11-24.

Relies on the theorems of the rules (`kernel.rules`), one in each file. An assumption that speaks of states,
and neither of a signal nor of the whole trajectory, holds at the beginning only: an equation is used after
its rate is shown to be zero, an inequality after the rule `keeps`. The field is affine in its switches
wherever a rate of |.| is taken: then every value of the field is that for one value of each switch, and |a|
has the rate s a' for any s where a = 0.

An obligation is composed here from the formula of its rule (`compose`); the certificate has only its proof.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

from symctrl.kernel.certificate import Invalid
from symctrl.kernel.closure import Reach, rates_exist_where_defined
from symctrl.kernel.compose import composed, rates_of
from symctrl.kernel.knowledge import Knowledge
from symctrl.kernel.traits import LIPSCHITZ, NOT_AFFINE
from symctrl.kernel.values import Assumption, Claim, Listing, Statement, Step

OBLIGATION = "obligation"
LEMMA = "lemma"  # what an assumption is about that a line has shown to hold at every state
STRICT = frozenset(("nonzero", "positive"))


@dataclass(frozen=True)
class Beside:
    """What an obligation may use beside or in place of the assumptions that are available.

    extra: assumed too. closed: assumptions that leave out a part of the boundary of the domain must not be
    used, nor what was shown with them. only: of those available these alone.
    """

    extra: tuple[Assumption, ...] = ()
    closed: bool = False
    only: tuple[Assumption, ...] | None = None


@dataclass(frozen=True)
class Obligation:
    """A claim for all states, parameters, signals and switches."""

    role: str
    kind: str
    formulas: tuple[str, ...]
    roles: Mapping[str, str]
    beside: Beside = Beside()


class Judge(Protocol):
    """Who settles obligations: the checker of a certificate, or a search for one."""

    def prove(self, at: Argument, obligation: Obligation) -> None:
        """Raises Invalid where the obligation is not met."""

    def require(self, role: str, holds: bool, why: str) -> None:
        """Raises Invalid where something that is read off the graph does not hold."""


@dataclass
class Argument(Knowledge):
    """The state of an argument: what is known, and the assumptions that may be used by now.

    available: assumptions that may be used in obligations. initial: those of the beginning only. stated: the
    states whose motion the statement itself has.
    """

    quantities: tuple[str, ...]
    judge: Judge
    available: list[Assumption] = field(default_factory=list)
    initial: list[tuple[str, Assumption]] = field(default_factory=list)
    relations: list[tuple[str, Assumption]] = field(default_factory=list)
    stated: frozenset[str] = frozenset()

    # Obligations and needs

    def prove(
        self,
        role: str,
        kind: str,
        formulas: str | Sequence[str],
        beside: Beside | None = None,
        /,
        **roles: str,
    ) -> None:
        """An obligation by its formula. kind equal: the first half of the formulas equals the second."""
        given = (formulas,) if isinstance(formulas, str) else tuple(formulas)
        self.judge.prove(self, Obligation(role, kind, given, roles, beside or Beside()))

    def require(self, role: str, holds: bool, why: str) -> None:
        self.judge.require(role, holds, why)

    def need(self, role: str, word: str, quantity: str) -> None:
        """An earlier fact about the quantity."""
        self.require(
            role, self.has(word, quantity), f"that {quantity} {PHRASES[word]} is not known before this line"
        )

    def need_existence(self) -> None:
        self.require(
            "existence",
            ("exists", "") in self.facts,
            "that solutions exist for all time is not known before this line",
        )

    def require_constant(self, role: str, quantity: str) -> None:
        self.require(role, self.is_constant(quantity), f"{quantity} is not made of parameters alone")

    def require_differentiable(self, role: str, quantity: str) -> None:
        """Locally Lipschitz along solutions, with the rate that the chain rule gives almost everywhere."""
        traits = self.traits(quantity)
        fits = traits.level <= LIPSCHITZ and not traits.jumps
        self.require(role, fits, f"{quantity} jumps, or is not locally Lipschitz")
        if fits and traits.level == LIPSCHITZ:
            affine = all(rate.degree < NOT_AFFINE for rate in self.field().values())
            self.require(
                f"{role}, switches", affine, "it has a kink, and the field is not affine in its switches"
            )

    def require_total(self, total: str, quantity: str) -> None:
        fits = self.is_total_of_square(total, quantity)
        self.require(
            "the total is that of the square", fits, f"{total} is not the sum of the squares of {quantity}"
        )

    # Assumptions

    def begin(self, cofactors: Mapping[str, str], edges: Sequence[str] = ()) -> None:
        """Sorts the assumptions, and asks that the equations about states are kept.

        An equation g = 0 is kept where g' = c g for a c that is continuous in the state, not only where g =
        0: then g is exp(int c) times its value at the beginning. cofactors: c by the quantity of the
        equation. edges: quantities that the field divides by: it has a value all along a solution.
        """
        divisors = {key for kind, _, key in (e.partition(" ") for e in self.edges()) if kind == "nonzero"}
        if edges and not rates_exist_where_defined(self.statement, self.law):
            divisors = set()
        for edge in edges:
            known = self.traits(edge).key in divisors
            self.require("the field has no value where it is zero", known, f"it does not divide by {edge}")
        apart = [Assumption("nonzero", ((edge, 0),), text=f"{edge} != 0", about=LEMMA) for edge in edges]
        self.available = list(apart)
        for k, assumption in enumerate(self.statement.given):
            keys = [self.output_traits(ref).key for ref in assumption.of]
            if assumption.about == "trajectory" or not self._is_of_the_beginning(assumption):
                self.available.append(assumption)
                self._learn_apart(assumption, keys)
            elif assumption.kind == "zero":
                self.relations.append((relation(k), assumption))
            elif assumption.kind in ("nonnegative", "positive"):
                self.initial.append((keys[0], assumption))
        for quantity, assumption in self.relations:
            self._keep(quantity, assumption, cofactors.get(quantity))
        relations = [assumption for _, assumption in self.relations]
        self.available = [*self.available[len(apart) :], *relations, *apart]

    def _keep(self, quantity: str, assumption: Assumption, cofactor: str | None) -> None:
        role = f"{assumption.text or quantity} is kept"
        self.require_differentiable(f"{role}: differentiable", quantity)
        if cofactor is None:
            self.prove(role, "equal", ["g'", "0"], g=quantity)
            return
        self.require(f"{role}: continuous", not self.traits(cofactor).jumps, f"{cofactor} jumps")
        self.prove(role, "equal", ["g'", "c g *"], g=quantity, c=cofactor)

    def _learn_apart(self, assumption: Assumption, keys: Sequence[str]) -> None:
        """A constant that is not zero stays apart from it."""
        constant = self._is_about_constants(assumption)
        if assumption.kind in STRICT and constant:
            self.facts |= {("apart", key) for key in keys}
        if assumption.kind == "positive" and constant:
            self.facts |= {("apart", f"positive {key}") for key in keys}

    def _is_of_the_beginning(self, assumption: Assumption) -> bool:
        """Does it speak of states, and of no signal, whose admissible values it would say for all times?"""
        reads = self._reads(assumption)
        kinds, moving = self.statement.scalars, self.statement.motion
        free = any(kinds.get(key) == "signal" and key not in moving for key in reads)
        return not free and self.reads_states(assumption)

    def _is_about_constants(self, assumption: Assumption) -> bool:
        return all(
            self.statement.scalars.get(key) == "parameter" or key in self.statement.names
            for key in self._reads(assumption)
        )

    def _reads(self, assumption: Assumption) -> set[str]:
        reach = Reach(self.statement)
        for name, _ in assumption.of:
            reach.listing(name, "i", 0, None)
        return reach.read

    def reads_states(self, assumption: Assumption) -> bool:
        kinds, moving = self.statement.scalars, self.statement.motion
        return any(kinds.get(key) in ("state", "input") or key in moving for key in self._reads(assumption))

    def usable(self, obligation: Obligation) -> list[Assumption]:
        """The assumptions that an obligation may use, in their order."""
        beside = obligation.beside
        kept: Sequence[Assumption] = self.available if beside.only is None else beside.only
        if beside.closed:
            kept = [a for a in kept if self._is_about_constants(a) or self._is_closed(a)]
        return [*kept, *beside.extra]

    def _is_closed(self, assumption: Assumption) -> bool:
        """Does it hold at limits of states at which it holds, for the same signals?"""
        traits = [self.output_traits(ref) for ref in assumption.of]
        strict = assumption.kind in (*STRICT, "positive_definite")
        if strict or assumption.about == LEMMA or any(t.edges or t.jumps for t in traits):
            return False
        free = any(self.is_signal(name) for t in traits for name in t.reads)
        return not (free and self.reads_states(assumption))

    # What is composed

    def composed(self, obligation: Obligation, given: Sequence[Assumption]) -> Statement:
        """The statement of an obligation under some of the assumptions."""
        listing = composed(self.statement.listings, obligation.formulas, obligation.roles)
        count = len(listing.outputs) // (2 if obligation.kind == "equal" else 1)
        claim = self._claim(obligation.kind, count)
        listings = {**self.statement.listings, OBLIGATION: listing}
        return replace(
            self.statement,
            listings=listings,
            given=tuple(given),
            claim=claim,
            conditions=(),
            uses=(),
            along=True,
        )

    @staticmethod
    def _claim(kind: str, count: int) -> Claim:
        if kind not in ("positive_definite", "positive_semidefinite"):
            return Claim(kind, OBLIGATION, (count, 1))
        size = round(count**0.5)
        tree = {"entries": [[r + size * c for c in range(size)] for r in range(size)]}
        return Claim(kind, OBLIGATION, (size, size), tree)

    def mint(self, name: str, formulas: Sequence[str]) -> None:
        """A listing of the rules' own, of formulas over the states."""
        _enter(
            listings := dict(self.statement.listings), {name: composed(self.statement.listings, formulas, {})}
        )
        self.statement = replace(self.statement, listings=listings)

    def mint_single(self, name: str, ref: tuple[str, int]) -> str:
        """A quantity of the rules' own that is one output of a listing."""
        _enter(
            listings := dict(self.statement.listings), {name: single(self.statement.listings[ref[0]], ref[1])}
        )
        self.statement = replace(self.statement, listings=listings)
        return name


PHRASES = {
    "bounded": "stays bounded",
    "summable": "has a finite integral",
    "tends": "tends to zero",
    "exponentially": "decays exponentially",
    "apart": "stays apart from zero",
}


def extended(statement: Statement, quantities: Sequence[str]) -> Statement:
    """The statement with the listings of quantities' rates, and of each equation that is assumed."""
    listings: dict[str, Listing] = dict(statement.listings)
    names = dict(statement.names)
    own = list(quantities)
    for k, assumption in enumerate(statement.given):
        if assumption.kind == "zero":
            listing, at = assumption.of[0]
            own.append(relation(k))
            _enter(listings, {relation(k): single(statement.listings[listing], at)})
    for quantity in own:
        more, meanings = rates_of(quantity, listings[quantity], statement.claim.law)
        _enter(listings, more)
        _enter(names, meanings, statement.scalars)
    return replace(statement, listings=listings, names=names)


def relation(k: int) -> str:
    """The quantity of the equation that is assumption k."""
    return f"relation{k + 1}"


def _enter(table: dict[str, Any], new: Mapping[str, Any], beside: Mapping[str, Any] | None = None) -> None:
    for key in new:
        if key in table or key in (beside or {}):
            raise Invalid(f"the name {key[:60]} belongs to the rules")
    table.update(new)


def single(listing: Listing, k: int) -> Listing:
    """One output of a listing, with the instructions that it needs."""
    needed = {listing.outputs[k]}
    for r in range(len(listing.code) - 1, -1, -1):
        if r in needed:
            needed.update(listing.code[r].args)
    new = {old: n for n, old in enumerate(sorted(needed))}
    code = tuple(
        Step(s.op, tuple(new[a] for a in s.args), s.name, s.value)
        for r, s in enumerate(listing.code)
        if r in needed
    )
    return Listing(code, (new[listing.outputs[k]],), "")
