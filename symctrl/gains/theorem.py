"""Which theorem of a study the gains shall make applicable: the last one that stands and asks something of
gains.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import TYPE_CHECKING

from symctrl.context import within
from symctrl.expr import Nonconforming
from symctrl.listings import UndefinedLetter
from symctrl.rows import Row
from symctrl.theorem import Theorem
from symctrl.verify import verify
from symctrl.written import Entry, StudyError

if TYPE_CHECKING:
    from symctrl.store import Store
    from symctrl.study import Study


NOTHING: Mapping[str, Row] = MappingProxyType({})


def standing_theorem(
    study: Study,
    store: Store | None,
    progress: Callable[[str], None],
    decided: Mapping[str, Row] = NOTHING,
) -> Entry | None:
    """None where no theorem stands for all values, or none that does assumes anything of a gain.

    decided: rows that are known already, by id.
    """
    for entry in reversed(study.entries.values()):
        if _asks_of_gains(study, entry) and _stands(study, entry, store, progress, decided):
            return entry
    return None


def _stands(
    study: Study,
    entry: Entry,
    store: Store | None,
    progress: Callable[[str], None],
    decided: Mapping[str, Row],
) -> bool:
    """Does the theorem stand, with all that it rests on, and none of it for the study's values alone?"""
    wanted, rows = {entry.id}, dict[str, Row]()
    while True:
        rows = {row.id: row for row in verify(study, wanted, store, progress, {**decided, **rows}).rows}
        below = {_base(id_) for row in rows.values() for id_ in _below(study, row)}
        if below <= {_base(id_) for id_ in rows}:
            break
        wanted |= below
    return rows[entry.id].stands and not any(_at_values(row) for row in rows.values())


def _below(study: Study, row: Row) -> list[str]:
    """The claims that a row rests on, and those that correct them."""
    named = [_base(id_) for id_ in row.rests_on if _base(id_) in study.entries]
    return [*named, *(e.id for e in study.entries.values() if e.corrects in named)]


def _base(id_: str) -> str:
    return id_.partition("[")[0]


def _at_values(row: Row) -> bool:
    return any(one.by == "the exact values of the study" for one in row.conditions)


def _asks_of_gains(study: Study, entry: Entry) -> bool:
    from symctrl.gains.conditions import of_theorem, variant_of

    if entry.readings:
        return False
    with within(replace(study.instance, variant=variant_of(entry))):
        try:
            if not isinstance(entry.call(study), Theorem):
                return False
            found = of_theorem(study, entry)
        except (Nonconforming, UndefinedLetter, StudyError):
            return False
    return bool(found.conditions)
