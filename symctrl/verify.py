"""Deciding every claim of a study: one row for each, in the order in which they are written."""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

from symctrl import evidence, standing
from symctrl.bounds import Statement
from symctrl.context import within
from symctrl.decide.claims import Part
from symctrl.deciding import Decided, decide, is_named, with_corrections
from symctrl.dimensions import units_of
from symctrl.expr import scalars
from symctrl.inputs import inputs_digest
from symctrl.latex import latex
from symctrl.problem import PROVED, star
from symctrl.rows import Given, Report, Row
from symctrl.statements import Conforms, Equal
from symctrl.theorem import Theorem
from symctrl.verdict import Outcome, Verdict
from symctrl.written import Entry, StudyError

if TYPE_CHECKING:
    from symctrl.store import Store
    from symctrl.study import Study

Progress = Callable[[str], None]


class ToolError(RuntimeError):
    """Two ways of evaluating the same claim disagree: an error of symctrl, not of the study."""


def verify(
    study: Study,
    only: Collection[str] | None = None,
    store: Store | None = None,
    progress: Progress = lambda _: None,
    decided: Mapping[str, Row] | None = None,
) -> Report:
    """All rows of the study, or those of `only`. Raises StudyError for an unknown id, ToolError.

    decided: rows that another process has found already, by id.
    """
    began = time.perf_counter()
    wanted = _wanted(study, only)
    rows = []
    for entry in study.entries.values():
        for id_ in entry.ids:
            if id_ in wanted:
                progress(id_)
                rows += _known(decided or {}, id_) or _rows(study, entry, id_, store)
    rows = standing.settle(study, rows, complete=only is None)
    standing.refuse_needless(study, rows)
    used = {row.equation for row in rows}
    missing = tuple(n for n in study.numbers if n not in used and not any(n in e.split(", ") for e in used))
    inputs = inputs_digest(study, wanted)
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


def _known(decided: Mapping[str, Row], id_: str) -> list[Row]:
    """The row of a claim and those of its arguments, where another process has found them."""
    return [row for name, row in decided.items() if name == id_ or name.startswith(f"{id_}/")]


def _rows(study: Study, entry: Entry, id_: str, store: Store | None) -> list[Row]:
    """The row of a claim; below that of a theorem those of its arguments."""
    began = time.perf_counter()
    reading = id_.partition("[")[2].rstrip("]") or None
    variant = "printed" if entry.form in ("printed", "definition", "law") else "corrected"
    decided = decide(study, entry, reading, store, variant)
    if entry.form == "printed" and decided.verdict.outcome is not Outcome.PROVED:
        decided = with_corrections(study, entry, reading, store, decided)
    row = _with_conditions(study, entry, id_, decided, store, variant)
    if entry.form == "printed" and any(c.by is None for c in row.conditions):
        corrected = decide(study, entry, reading, store, "corrected")
        again = _with_conditions(study, entry, id_, corrected, store, "corrected")
        if again.verdict == "proved" and all(c.by is not None for c in again.conditions):
            decided, row = corrected, replace(again, reason=f"{again.reason}, with the corrected definitions")
    if decided.verdict.outcome is Outcome.PROVED:
        with within(replace(study.instance, variant=variant)):
            row = _with_evidence(study, decided, row)
    return [replace(row, seconds=round(time.perf_counter() - began, 3)), *decided.below]


def _with_conditions(
    study: Study, entry: Entry, id_: str, decided: Decided, store: Store | None, variant: str
) -> Row:
    row = _made(study, entry, id_, decided)
    with within(replace(study.instance, variant=variant)):
        return standing.with_conditions(study, decided.claim, decided.using, decided.verdict, row, store)


def _made(study: Study, entry: Entry, id_: str, decided: Decided) -> Row:
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
        conditional=isinstance(decided.claim, Theorem) and _assumes_the_trajectory(study, decided),
        reason=verdict.reason,
        method=verdict.method,
        reading=id_.partition("[")[2].rstrip("]") or entry.reading,
        given=_given(decided.parts) + _supposed(study, decided),
        holds_for=_holds_for(study, decided),
        rests_on=(*_rests_on(study, entry, decided.parts), *decided.steps),
        unmet=decided.unmet,
        units=units_of(study, decided.parts[0].problem) if decided.parts else None,
        shown=decided.shown,
        witness=verdict.witness,
        certificate=verdict.certificate,
        residual=verdict.residual,
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


def _assumes_the_trajectory(study: Study, decided: Decided) -> bool:
    given = _given(decided.parts) + _supposed(study, decided)
    return any(one.about == "trajectory" for one in given)


def _supposed(study: Study, decided: Decided) -> tuple[Given, ...]:
    """The facts that a theorem supposes: of signals, or, where they read a state, of the trajectory."""
    if not isinstance(decided.claim, Theorem):
        return ()
    found = []
    for fact in decided.claim.suppose:
        names = scalars(fact.of) if fact.of is not None else []
        symbols = [study.symbols.get(star(name).partition("[")[0]) for name in names]
        state = any(symbol is None or symbol.kind == "state" for symbol in symbols)
        found.append(Given(fact.text(), "trajectory" if state else "signal"))
    return tuple(found)


def _holds_for(study: Study, decided: Decided) -> str:
    """All graphs and values, or the instance's graph and the study's values if the claim is about these."""
    about = [str(study.graph)] if decided.of_graph else []
    about += ["the values of the study"] if decided.at_values else []
    return ", ".join(about) or "all"


def _rests_on(study: Study, entry: Entry, found: tuple[Part, ...]) -> tuple[str, ...]:
    """The definitions and laws that the claim reaches, and the statements that it uses."""
    reached = {name.removeprefix("law ") for part in found for name in part.problem.listings}
    own = {entry.id, entry.corrects}
    named = [id_ for id_ in study.entries if id_ in reached - own and is_named(study, id_)]
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
    """Twins, and floating-point residuals of an equation. Raises ToolError if these contradict the proof."""
    problems = [part.problem for part in decided.parts]
    if not evidence.point_known(problems):
        reason = f"{row.reason}; no point is known at which all assumptions hold"
        return replace(row, reason=reason, point_known=False)
    if isinstance(decided.claim, Theorem):
        return replace(row, twins=decided.twins)
    if not isinstance(decided.claim, Equal) or len(decided.parts) != 1:
        return replace(row, twins=evidence.reversed_twins(problems))
    found = evidence.numeric(decided.parts[0].problem)
    if found is not None and found.max_residual > evidence.TOLERANCE:
        raise ToolError(
            f"{row.id} is proved, but left and right differ by {found.max_residual:.1e} of the largest value "
            "at a random admissible point"
        )
    return replace(row, numeric=found, twins=evidence.twins(study, decided.claim, row.id))
