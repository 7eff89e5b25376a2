"""Twins of a proved theorem: each assumption dropped, each addend of a law with its sign turned.

The argument must not close for a twin; where it does, it does not need the assumption, or the theorem does
not depend on what the law says. The argument was written for the theorem, and a twin may take it where nobody
looked: an error there is said of the twin, which then counts as not proved, and is no end of the theorem.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from symctrl.expr import Expr, Nonconforming, terms
from symctrl.rows import Twins
from symctrl.rules.loop import Changed, Loop
from symctrl.rules.seeker import Memory
from symctrl.text import text
from symctrl.theorem import ArgumentEntry, Theorem
from symctrl.written import Law, StudyError

if TYPE_CHECKING:
    from symctrl.collect import Used
    from symctrl.study import Study


def twins(
    study: Study,
    theorem: Theorem,
    id_: str,
    using: Sequence[Used],
    entry: ArgumentEntry,
    laws: Sequence[str],
    memory: Memory,
) -> Twins:
    """The twins for which the argument closes too.

    laws: those that the closed loop reads. memory: what became of the theorem's own obligations.
    """
    from symctrl.rules.theorems import attempt

    tried, still, failed = 0, [], []
    for said, changed in (*_without(theorem), *_turned([study.laws[name] for name in laws])):
        tried += 1
        try:
            closes = attempt(Loop(study, theorem, id_, using, changed), entry, memory, thorough=False).closes
        except (Nonconforming, StudyError):
            continue
        except Exception as error:
            failed.append(f"{said}: {type(error).__name__}: {error}")
            continue
        if closes:
            still.append(said)
    return Twins(tried, tuple(still), tuple(failed))


def _without(theorem: Theorem) -> Iterator[tuple[str, Changed]]:
    for k, given in enumerate(theorem.given):
        yield f"without {given.text()}", Changed(dropped=k)
    for k, fact in enumerate(theorem.suppose):
        yield f"without that {fact.text()}", Changed(forgotten=k)


def _turned(laws: Sequence[Law]) -> Iterator[tuple[str, Changed]]:
    for law in laws:
        addends = terms(law.body())
        for n, addend in enumerate(addends):
            turned = _sum([-a if k == n else a for k, a in enumerate(addends)])
            yield f"{law.name} with the sign of {text(addend)} turned", Changed(laws={law.name: turned})


def _sum(addends: Sequence[Expr]) -> Expr:
    total = addends[0]
    for addend in addends[1:]:
        total = total + addend
    return total
