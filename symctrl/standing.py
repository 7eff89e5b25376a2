"""Whether a verdict stands: its conditions vouched for, and everything that it rests on standing too."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from symctrl.bounds import Statement
from symctrl.decide.claims import parts, verdict_of
from symctrl.expr import Nonconforming
from symctrl.rows import Discharged, Given, Row
from symctrl.statements import Nonzero
from symctrl.theorem import Theorem
from symctrl.verdict import Condition, Outcome, Verdict
from symctrl.written import StudyError

if TYPE_CHECKING:
    from symctrl.store import Store
    from symctrl.study import Study


def with_conditions(
    study: Study, claim: Any, using: Sequence[Any], verdict: Verdict, row: Row, store: Store | None
) -> Row:
    """The row with each condition of its proof and who vouches for it.

    An assumption about the trajectory that says just this; else, found by deciding the claim again with them
    and seeing which conditions are gone: all assumptions about the trajectory, then the exact values of the
    parameters.
    """
    assumed = study.trajectory_assumptions()
    by: dict[str, str] = {}
    given: dict[Given, None] = {}
    for condition in verdict.conditions:
        same = next((a for a in assumed if _says(a.claim, condition)), None)
        if same is not None:
            by[str(condition)] = "assumed along the trajectory"
            given[Given(same.claim.text(), "trajectory")] = None
    open_ = [str(c) for c in verdict.conditions if str(c) not in by]
    if open_ and assumed:
        under = _conditions(study, claim, using, row.id, None, True, store)
        gone = [c for c in open_ if under is not None and c not in under]
        by |= dict.fromkeys(gone, "assumed along the trajectory")
        given |= dict.fromkeys(Given(a.claim.text(), "trajectory") for a in assumed if gone)
        open_ = [c for c in open_ if c not in by]
    if open_ and _conditions(study, claim, using, row.id, study.all_values(), bool(assumed), store) == []:
        by |= dict.fromkeys(open_, "the exact values of the study")
    discharged = tuple(Discharged(str(c), by.get(str(c))) for c in verdict.conditions)
    return replace(
        row, conditions=discharged, given=row.given + tuple(given), conditional=row.conditional or bool(given)
    )


def _says(claim: Statement, condition: Condition) -> bool:
    """Is the assumption that a symbol is not zero (at node i, so at every node) the very condition?"""
    if not isinstance(claim, Nonzero) or claim.expr.op != "symbol" or condition.kind != "nonzero":
        return False
    name = claim.expr.args[0]
    return condition.of in (name, f"{name.removesuffix('.i')}.j" if name.endswith(".i") else name)


def settle(study: Study, rows: Sequence[Row], complete: bool) -> list[Row]:
    """The rows with `stands` and `settled`. complete: all rows of the study are here. Raises StudyError."""
    known = {row.id: row for row in rows}
    standing: dict[str, bool] = {}
    for row in rows:
        _stands(row.id, known, standing, complete)
    inherited = {row.id: _inherited(row.id, known, frozenset()) for row in rows}
    done = [
        replace(r, stands=standing[r.id], conditional=_speaks_of_the_trajectory(inherited[r.id]))
        for r in rows
    ]
    return [
        replace(row, given=inherited[row.id], settled=_settled(study, row, done, complete)) for row in done
    ]


def _speaks_of_the_trajectory(given: Sequence[Given]) -> bool:
    return any(one.about == "trajectory" for one in given)


def _inherited(id_: str, known: dict[str, Row], above: frozenset[str]) -> tuple[Given, ...]:
    """The row's assumptions and, after them, those of everything that it rests on, each once; without those
    about the trajectory that its argument shows.
    """
    row = known[id_]
    found = dict.fromkeys(row.given)
    for below in row.rests_on:
        at = below if below in known else next((k for k in known if k.partition("[")[0] == below), None)
        if at is not None and at not in above:
            more = _inherited(at, known, above | {id_})
            found |= dict.fromkeys(g for g in more if g.about != "trajectory" or g.text not in row.shown)
    return tuple(found)


def _stands(id_: str, known: dict[str, Row], standing: dict[str, bool], complete: bool) -> None:
    if id_ in standing:
        return
    row = known[id_]
    standing[id_] = False
    own = row.verdict == "proved" and row.point_known and all(c.by is not None for c in row.conditions)
    for below in row.rests_on:
        at = below if below in known else next((k for k in known if k.partition("[")[0] == below), None)
        if at is None:
            own = own and not complete
            continue
        _stands(at, known, standing, complete)
        corrected = [r.id for r in known.values() if r.corrects == below]
        for other in corrected:
            _stands(other, known, standing, complete)
        own = own and (standing[at] or any(standing[c] for c in corrected))
    standing[id_] = own


def _settled(study: Study, row: Row, rows: Sequence[Row], complete: bool) -> bool:
    if row.form in ("step", "obligation", "fact"):
        return True  # what they are missing is missing from their theorem
    if row.form in ("corrected", "claimed"):
        return row.stands
    if row.stands or (row.kind == "theorem" and row.verdict == "undecided"):
        return True
    base = row.id.partition("[")[0]
    corrections = [r for r in rows if r.corrects == base]
    siblings = [r for r in rows if r.id != row.id and r.id.partition("[")[0] == base]
    if row.verdict in ("refuted", "ill-formed"):
        covered = any(r.stands for r in corrections + siblings) or base in study.rejections
        return covered or (not complete and not corrections)
    return False


def refuse_needless(study: Study, rows: Sequence[Row]) -> None:
    """Raises StudyError where a corrected statement's printed one is proved."""
    by_base: dict[str, list[Row]] = {}
    for row in rows:
        by_base.setdefault(row.id.partition("[")[0], []).append(row)
    for row in rows:
        printed = by_base.get(row.corrects or "", [])
        if (
            printed
            and all(p.stands for p in printed)
            and study.entries[printed[0].id.partition("[")[0]].form == "printed"
        ):
            raise StudyError(
                f"{row.id} corrects {row.corrects}, which is proved as printed: there is nothing to correct"
            )


def _conditions(
    study: Study,
    claim: Any,
    using: Sequence[Any],
    id_: str,
    values: dict[str, Fraction] | None,
    along: bool,
    store: Store | None,
) -> list[str] | None:
    """The conditions of the claim decided under the trajectory assumptions, or at exact values; None if not
    proved so.
    """
    if isinstance(claim, Theorem):
        return None
    try:
        with study.along_trajectory(along):
            verdict = verdict_of(parts(study, claim, id_, values, using), store)
    except Nonconforming:
        return None
    return [str(c) for c in verdict.conditions] if verdict.outcome is Outcome.PROVED else None
