"""Deciding every claim of a study: one row for each, in the order in which they are written."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

from symctrl import evidence, standing
from symctrl.certify import digest
from symctrl.collect import UndefinedLetter
from symctrl.context import Instance, within
from symctrl.decide.claims import Part, parts, verdict_of
from symctrl.expr import Nonconforming
from symctrl.latex import latex
from symctrl.problem import PROVED
from symctrl.rows import Given, Report, Row
from symctrl.statements import Conforms, Equal, Statement
from symctrl.verdict import Outcome, Verdict
from symctrl.written import Entry, StudyError

if TYPE_CHECKING:
    from symctrl.store import Store
    from symctrl.study import Study

Progress = Callable[[str], None]


class ToolError(RuntimeError):
    """Two ways of evaluating the same claim disagree: an error of symctrl, not of the study."""


@dataclass(frozen=True)
class Decided:
    """A claim with its problems and verdict. claim: what the function returned, or None where it does not
    conform.
    """

    claim: Any
    parts: tuple[Part, ...]
    verdict: Verdict
    using: tuple[Any, ...] = ()


def verify(
    study: Study,
    only: Collection[str] | None = None,
    store: Store | None = None,
    progress: Progress = lambda _: None,
) -> Report:
    """All rows of the study, or those of `only`. Raises StudyError for an unknown id, ToolError."""
    began = time.perf_counter()
    wanted = _wanted(study, only)
    rows = []
    for entry in study.entries.values():
        for id_ in entry.ids:
            if id_ in wanted:
                progress(id_)
                rows.append(_row(study, entry, id_, store))
    rows = standing.settle(study, rows, complete=only is None)
    used = {row.equation for row in rows}
    missing = tuple(n for n in study.numbers if n not in used and not any(n in e.split(", ") for e in used))
    inputs = digest(
        [study.name, study.graph, {k: str(v) for k, v in study.instance.values.items()}, sorted(wanted)]
    )
    return Report(
        study.name, study.source, study.graph, tuple(rows), missing, inputs, time.perf_counter() - began
    )


def _wanted(study: Study, only: Collection[str] | None) -> set[str]:
    known = study.statement_ids()
    if only is None:
        return set(known)
    found = set()
    for id_ in only:
        matching = [k for k in known if id_ in (k, k.partition("[")[0])]
        if not matching:
            near = get_close_matches(id_, known, 3, 0.4)
            hint = f"; did you mean {', '.join(near)}?" if near else f"; it has {', '.join(known[:8])}, .."
            raise StudyError(f"the study {study.name} has no claim {id_}{hint}")
        found.update(matching)
    return found


def _row(study: Study, entry: Entry, id_: str, store: Store | None) -> Row:
    began = time.perf_counter()
    reading = id_.partition("[")[2].rstrip("]") or None
    variant = "printed" if entry.form in ("printed", "definition", "law") else "corrected"
    with within(replace(study.instance, variant=variant)):
        decided = _decide(study, entry, reading, store)
        if entry.form == "printed" and decided.verdict.outcome is not Outcome.PROVED:
            decided = _again_with_corrections(study, entry, reading, store, decided)
        row = _made(study, entry, id_, reading, decided)
        if decided.verdict.outcome is Outcome.PROVED:
            row = _with_evidence(study, decided, row)
        row = standing.with_conditions(study, decided.claim, decided.using, decided.verdict, row)
    return replace(row, seconds=round(time.perf_counter() - began, 3))


def _decide(study: Study, entry: Entry, reading: str | None, store: Store | None) -> Decided:
    try:
        claim = entry.call(study, reading)
        if entry.form in ("definition", "law") or (entry.corrects and _is_named(study, entry.corrects)):
            claim = Conforms(_body(study, entry, claim))
        using = [used.call(study) for used in entry.using]
        found = tuple(parts(study, claim, entry.id, using=using))
    except (Nonconforming, UndefinedLetter) as error:
        return Decided(None, (), Verdict(Outcome.ILL_FORMED, str(error)))
    return Decided(claim, found, verdict_of(found, store), tuple(using))


def _body(study: Study, entry: Entry, made: Any) -> Any:
    from symctrl.expr import lift

    law = study.laws.get(entry.corrects or entry.id)
    return law.body() if law is not None else lift(made)


def _is_named(study: Study, id_: str) -> bool:
    return study.entries[id_].form in ("definition", "law")


def _again_with_corrections(
    study: Study, entry: Entry, reading: str | None, store: Store | None, printed: Decided
) -> Decided:
    """A printed claim that fails, decided with the corrected definitions: is it wrong by itself?"""
    corrected = Instance("corrected", study.instance.graph, study.instance.values)
    with within(corrected):
        again = _decide(study, entry, reading, store)
    if _same(printed, again):
        return printed
    standing_in = printed.verdict.outcome is Outcome.ILL_FORMED and again.claim is not None
    if standing_in and again.verdict.outcome is not Outcome.ILL_FORMED:
        reason = (
            f"{printed.verdict.reason}; with the corrected definition in its place: {again.verdict.reason}"
        )
        return replace(again, verdict=replace(again.verdict, reason=reason))
    how = (
        "it holds with the corrected definitions: it is wrong only through what it uses"
        if again.verdict.outcome is Outcome.PROVED
        else "it fails with the corrected definitions too"
    )
    return replace(printed, verdict=replace(printed.verdict, reason=f"{printed.verdict.reason}; {how}"))


def _same(a: Decided, b: Decided) -> bool:
    return [p.problem.sha256 for p in a.parts] == [p.problem.sha256 for p in b.parts] and (
        a.verdict.reason == b.verdict.reason
    )


def _made(study: Study, entry: Entry, id_: str, reading: str | None, decided: Decided) -> Row:
    verdict = decided.verdict
    return Row(
        id=id_,
        equation=entry.equation,
        statement=entry.sentence or f"{entry.id} is well formed",
        latex=_latex(decided.claim, entry),
        form=entry.form,
        corrects=entry.corrects,
        kind=_kind(decided.claim),
        verdict=verdict.outcome.value,
        stands=False,
        conditional=False,
        reason=verdict.reason,
        method=verdict.method,
        reading=reading or entry.reading,
        given=_given(decided.parts),
        holds_for=_holds_for(study, decided),
        rests_on=_rests_on(study, entry, decided.parts),
        witness=verdict.witness,
        certificate=verdict.certificate,
        units=None,
        finding=_finding(entry, verdict),
    )


def _latex(claim: Any, entry: Entry) -> str:
    if isinstance(claim, list | tuple):
        return r",\quad ".join(_latex(one, entry) for one in claim)
    if isinstance(claim, Conforms):
        from symctrl.latex import name_latex

        return f"{name_latex(entry.corrects or entry.id)} = {latex(claim.expr)}"
    return claim.latex() if isinstance(claim, Statement) else ""


def _kind(claim: Any) -> str:
    if isinstance(claim, list | tuple):
        return "all"
    return claim.kind if isinstance(claim, Statement) else "conforms"


def _given(found: tuple[Part, ...]) -> tuple[Given, ...]:
    return tuple(
        dict.fromkeys(
            Given(a.text, a.about) for part in found for a in part.problem.given if a.about != PROVED
        )
    )


def _holds_for(study: Study, decided: Decided) -> str:
    """All graphs and sizes, or the instance's graph where the claim was made of it."""
    used = any("uses the graph" in str(part.problem.text) for part in decided.parts)
    return f"{study.graph}" if used else "all"


def _rests_on(study: Study, entry: Entry, found: tuple[Part, ...]) -> tuple[str, ...]:
    """The definitions and laws that the claim reaches, and the statements that it uses."""
    reached = {name.removeprefix("law ") for part in found for name in part.problem.listings}
    own = {entry.id, entry.corrects}
    named = [id_ for id_ in study.entries if id_ in reached - own and _is_named(study, id_)]
    return (*named, *(used.id for used in entry.using))


def _finding(entry: Entry, verdict: Verdict) -> str | None:
    sentence = entry.finding.get(verdict.outcome.value) or (
        entry.why if verdict.outcome is Outcome.PROVED else None
    )
    if sentence is None:
        return None
    fields: Mapping[str, Any] = {"witness": verdict.witness or {}, "residual": verdict.residual or ""}
    try:
        return sentence.format(**fields)
    except (KeyError, IndexError, ValueError):
        return sentence


def _with_evidence(study: Study, decided: Decided, row: Row) -> Row:
    """Twins and floating-point residuals of an equation. Raises ToolError where these contradict the
    proof.
    """
    if not isinstance(decided.claim, Equal) or len(decided.parts) != 1:
        return row
    found = evidence.numeric(decided.parts[0].problem)
    if found is not None and found.max_residual > evidence.TOLERANCE:
        raise ToolError(
            f"{row.id} is proved, but left and right differ by {found.max_residual:.1e} of the largest value "
            "at a random admissible point"
        )
    return replace(row, numeric=found, twins=evidence.twins(study, decided.claim, row.id))
