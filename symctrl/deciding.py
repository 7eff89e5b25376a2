"""Deciding one entry of a study: with the printed or the corrected definitions, for one reading."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from symctrl.collect import Used
from symctrl.context import noticing_graph, within
from symctrl.decide.claims import Part, digest_of, parts, verdict_of
from symctrl.expr import Nonconforming, lift
from symctrl.listings import UndefinedLetter
from symctrl.statements import AtValues, Conforms
from symctrl.theorem import Theorem
from symctrl.verdict import Outcome, Verdict

if TYPE_CHECKING:
    from symctrl.rows import Row, Twins
    from symctrl.store import Store
    from symctrl.study import Study
    from symctrl.written import Entry


@dataclass(frozen=True)
class Decided:
    """A claim with its problems and verdict.

    claim: what the function returned, None where it does not conform. using: the claims of the statements
    that it uses. of_graph: the claim speaks of the instance's graph. below: the rows of a theorem's
    arguments; steps: those that the proof consists of; unmet: those that are missing. shown: the study's
    assumptions about the trajectory that the proof shows.
    """

    claim: Any
    parts: tuple[Part, ...]
    verdict: Verdict
    using: tuple[Any, ...] = ()
    of_graph: bool = False
    below: tuple[Row, ...] = ()
    steps: tuple[str, ...] = ()
    unmet: tuple[str, ...] = ()
    twins: Twins | None = None
    shown: tuple[str, ...] = ()

    @property
    def at_values(self) -> bool:
        """Is the claim one about the exact values of the study?"""
        return isinstance(self.claim, AtValues)


def decide(study: Study, entry: Entry, reading: str | None, store: Store | None, variant: str) -> Decided:
    """The entry decided with the definitions of a variant, "printed" or "corrected"."""
    with within(replace(study.instance, variant=variant)), noticing_graph() as marks:
        try:
            claim = entry.call(study, reading)
            if is_named(study, entry.corrects or entry.id):
                claim = Conforms(_body(study, entry, claim))
            using = tuple(used(study, other) for other in entry.using)
            if isinstance(claim, Theorem):
                return _theorem(study, entry, claim, using, bool(marks), store)
            found = tuple(parts(study, claim, entry.id, using=using))
        except (Nonconforming, UndefinedLetter) as error:
            return Decided(None, (), Verdict(Outcome.ILL_FORMED, str(error)), of_graph=bool(marks))
        return Decided(claim, found, verdict_of(found, store), using, bool(marks))


def _theorem(
    study: Study,
    entry: Entry,
    claim: Theorem,
    using: tuple[Used, ...],
    of_graph: bool,
    store: Store | None,
) -> Decided:
    from symctrl.rules import theorems

    made = theorems.decide(study, claim, entry.id, entry.equation, using, store)
    part = Part(made.problem)
    return Decided(
        claim,
        (part,),
        made.verdict,
        using,
        of_graph,
        made.rows,
        made.rests_on,
        made.unmet,
        made.twins,
        made.shown,
    )


def used(study: Study, entry: Entry) -> Used:
    """A statement that another one uses, with its digest."""
    claim = entry.call(study)
    using = tuple(used(study, other) for other in entry.using)
    return Used(entry.id, claim, digest_of(parts(study, claim, entry.id, using=using)))


def is_named(study: Study, id_: str) -> bool:
    """Is the entry a definition or a law?"""
    return study.entries[id_].form in ("definition", "law")


def with_corrections(
    study: Study, entry: Entry, reading: str | None, store: Store | None, printed: Decided
) -> Decided:
    """A printed claim that fails, decided again with the corrected definitions: is it wrong by itself?"""
    again = decide(study, entry, reading, store, "corrected")
    if _same(printed, again):
        return printed
    stands_in = printed.verdict.outcome is Outcome.ILL_FORMED and again.claim is not None
    if stands_in and again.verdict.outcome is not Outcome.ILL_FORMED:
        how = f"{printed.verdict.reason}; with the corrected definition in its place: {again.verdict.reason}"
        return replace(again, verdict=replace(again.verdict, reason=how))
    how = (
        "it holds with the corrected definitions: it is wrong only through what it uses"
        if again.verdict.outcome is Outcome.PROVED
        else "it fails with the corrected definitions too"
    )
    return replace(printed, verdict=replace(printed.verdict, reason=f"{printed.verdict.reason}; {how}"))


def _body(study: Study, entry: Entry, made: Any) -> Any:
    law = study.laws.get(entry.corrects or entry.id)
    return law.body() if law is not None else lift(made)


def _same(a: Decided, b: Decided) -> bool:
    return [p.problem.sha256 for p in a.parts] == [p.problem.sha256 for p in b.parts] and (
        a.verdict.reason == b.verdict.reason
    )
