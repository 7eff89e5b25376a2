"""What fails, and what holds instead: one block for each claim that is not proved as printed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from symctrl.report import witnesses
from symctrl.report.mathml import differ, math, pair
from symctrl.report.names import (
    Group,
    anchor,
    certificate_kind,
    certificate_path,
    certificate_size,
    chip,
    find,
    numbers,
    standing_chip,
)
from symctrl.report.page import (
    CertificateBlock,
    Correction,
    Failure,
    Link,
    Reading,
    Script,
    TwinsBlock,
)
from symctrl.report.witnesses import Symbols
from symctrl.rows import Report, Row
from symctrl.study import Study

_THROUGH = "it holds with the corrected definitions"


def blocks(
    report: Report,
    study: Study,
    grouped: Sequence[Group],
    symbols: Symbols,
    script: Callable[[Row], Script],
) -> tuple[Failure, ...]:
    return tuple(_block(report, study, g, symbols, script) for g in grouped if g.fails)


def _block(
    report: Report, study: Study, group: Group, symbols: Symbols, script: Callable[[Row], Script]
) -> Failure:
    failing = [row for row in group.rows if row.verdict != "proved" or not row.stands]
    first = failing[0]
    chips = list(dict.fromkeys(chip(row) for row in group.rows))
    chips += list(dict.fromkeys(standing_chip(row) for row in group.corrections))
    entry = study.entries.get(group.base)
    why = [row.finding for row in failing] + [row.finding for row in group.corrections]
    if group.base in study.rejections:
        why.append(study.rejections[group.base])
    return Failure(
        anchor=anchor(group.base, "f"),
        id=group.base,
        equation=first.equation,
        sentence=first.statement,
        kind=chip(first).shape,
        chips=tuple(chips),
        why=tuple(dict.fromkeys(filter(None, why))),
        reading_note=entry.reading if entry is not None else None,
        readings=_readings(report, group, symbols, script),
        corrections=tuple(_correction(report, group, row) for row in group.corrections),
    )


def _readings(
    report: Report, group: Group, symbols: Symbols, script: Callable[[Row], Script]
) -> tuple[Reading, ...]:
    """All readings; the values of a witness are shown once where several have them."""
    made: list[Reading] = []
    for row in group.rows:
        one = _reading(report, group, row, symbols, script)
        earlier = [known.witness for known in made if known.witness is not None]
        if one.witness is not None and any(w.values == one.witness.values for w in earlier):
            one = replace(one, witness=replace(one.witness, values=(), hypotheses=(), again=True))
        made.append(one)
    return tuple(made)


def _reading(
    report: Report, group: Group, row: Row, symbols: Symbols, script: Callable[[Row], Script]
) -> Reading:
    other = next((c.latex for c in group.corrections if c.latex and row.latex), None)
    other = other or next((r.latex for r in group.rows if r.stands and r.latex), None)
    through = _through(report, row) if _THROUGH in row.reason else ()
    compared = other is not None and not through and differ(row.latex, other)
    formula = pair(row.latex, other or "")[0] if compared else math(row.latex, True)
    return Reading(
        name=row.id.partition("[")[2].rstrip("]") or None,
        chip=chip(row),
        formula=formula,
        reason=_reason(row),
        through=through,
        witness=witnesses.block(row, symbols, script(row)),
        certificate=certificate(report.study, row),
    )


def _reason(row: Row) -> str:
    """What the verdict says beyond the witness's values."""
    if row.verdict == "refuted":
        return "It fails with the corrected definitions too." if "it fails with" in row.reason else ""
    return "" if row.verdict == "proved" and row.stands else numbers(row.reason)


def _through(report: Report, row: Row) -> tuple[Link, ...]:
    """The corrected definitions that a claim reaches."""
    found: dict[str, None] = {}
    todo = list(row.rests_on)
    while todo:
        below = todo.pop(0)
        if below not in found:
            found[below] = None
            todo += [name for r in find(report.rows, below) for name in r.rests_on]
    corrected = {r.corrects for r in report.rows if r.form == "corrected"}
    return tuple(Link(name, anchor(name, "d")) for name in found if name in corrected)


def _correction(report: Report, group: Group, row: Row) -> Correction:
    printed = next((r.latex for r in group.rows if r.latex and r.verdict != "proved"), "")
    same = bool(printed) and not differ(printed, row.latex)
    wrong = [r for r in group.rows if r.latex and r.verdict != "proved" and _THROUGH not in r.reason]
    compared = bool(wrong) and differ(wrong[0].latex, row.latex)
    formula = pair(wrong[0].latex, row.latex)[1] if compared else math(row.latex, True)
    return Correction(
        id=row.id,
        chip=standing_chip(row),
        sentence=row.statement,
        formula=formula,
        same=same,
        conditions=tuple(g.text for g in row.given if g.about == "trajectory") if row.conditional else (),
        certificate=certificate(report.study, row),
        twins=twins(row),
    )


def twins(row: Row) -> TwinsBlock | None:
    if row.twins is None:
        return None
    still = row.twins.still_true
    return TwinsBlock(row.twins.tried, row.twins.tried - len(still), tuple(still))


def certificate(study: str, row: Row) -> CertificateBlock | None:
    if row.certificate is None:
        return None
    return CertificateBlock(
        of=row.id,
        kind=certificate_kind(row),
        size=certificate_size(row),
        sha256=str(row.certificate["sha256"]),
        command=f"symctrl check {certificate_path(study, row)}",
    )
