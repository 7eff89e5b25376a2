"""Which theorem of a study the gains shall make applicable: the last one that stands and asks something of
gains.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from symctrl.context import within
from symctrl.expr import Nonconforming
from symctrl.listings import UndefinedLetter
from symctrl.theorem import Theorem
from symctrl.verify import verify
from symctrl.written import Entry, StudyError

if TYPE_CHECKING:
    from symctrl.store import Store
    from symctrl.study import Study


def standing_theorem(study: Study, store: Store | None, progress: Callable[[str], None]) -> Entry | None:
    """None where no theorem stands, or none that does assumes anything of a symbol that has a value."""
    for entry in reversed(study.entries.values()):
        if _asks_of_gains(study, entry):
            row = next(r for r in verify(study, [entry.id], store, progress).rows if r.id == entry.id)
            if row.stands:
                return entry
    return None


def _asks_of_gains(study: Study, entry: Entry) -> bool:
    from symctrl.gains.conditions import of_theorem

    if entry.readings or entry.nodes:
        return False
    with within(replace(study.instance, variant="corrected")):
        try:
            if not isinstance(entry.call(study), Theorem):
                return False
            found = of_theorem(study, entry)
        except (Nonconforming, UndefinedLetter, StudyError):
            return False
    return any(study.value(name) is not None for one in found.conditions for name in one.names)
