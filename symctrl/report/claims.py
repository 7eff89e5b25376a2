"""The header, the notes and the table of claims."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from symctrl.report import words
from symctrl.report.mathml import math, signs
from symctrl.report.names import SHAPES, Group, anchor, chip, numbers, standing_chip
from symctrl.report.page import Chip, ClaimLine, Count, Header, Link, Mark, MarkGroup, Note
from symctrl.rows import Report, Row

NOTES = 4
LONG = 45  # signs of a formula that is shown once on a page
PARTS = 2  # of a claim of many that are shown
_BETWEEN = r",\quad "  # what stands between the parts of a claim


def header(report: Report, title: str, grouped: Sequence[Group], numbered: int) -> Header:
    printed = [row for group in grouped if group.form == "printed" for row in group.rows]
    others = [g for g in grouped if g.form not in ("definition", "law")]
    good = [row for group in others for row in (*group.corrections, *_own(group))]
    return Header(
        title=title,
        study=report.study,
        source=report.source,
        lead=words.lead(report, grouped),
        strip=tuple(_strip(grouped)),
        printed=_counts(printed),
        corrected=_standing_counts(good),
        entered=words.entered(report, numbered),
    )


def _own(group: Group) -> tuple[Row, ...]:
    return group.rows if group.form == "claimed" else ()


def _counts(rows: Sequence[Row]) -> tuple[Count, ...]:
    return tuple(Count(Chip(SHAPES[v], v), n) for v, n in words.tally(rows).items())


def _standing_counts(rows: Sequence[Row]) -> tuple[Count, ...]:
    told: dict[Chip, int] = {}
    for row in rows:
        told[standing_chip(row)] = told.get(standing_chip(row), 0) + 1
    return tuple(Count(c, n) for c, n in told.items())


def _strip(grouped: Sequence[Group]) -> Iterator[MarkGroup]:
    """Every claim in the order of the paper, those of one equation together."""
    together: list[tuple[str, list[Mark]]] = []
    for group in grouped:
        if group.form in ("definition", "law") and not group.fails:
            continue
        equation = group.rows[0].equation
        if not together or together[-1][0] != equation:
            together.append((equation, []))
        together[-1][1].extend(_mark(group, row) for row in group.rows)
    return (MarkGroup(equation, tuple(marks)) for equation, marks in together)


def _mark(group: Group, row: Row) -> Mark:
    printed, corrected = _chips(group, row)
    return Mark(f"{row.equation} {row.id}", place(group, row), printed, corrected)


def place(group: Group, row: Row) -> str:
    """Where the page says more about a claim: in its block if it fails, in the table if it does not."""
    return anchor(group.base, "f") if group.fails else anchor(row.id)


def _chips(group: Group, row: Row) -> tuple[Chip | None, Chip | None]:
    """The verdict as printed, none for a claim that the study adds; and of what stands in its place."""
    if row.form == "claimed":
        return None, standing_chip(row)
    if row.verdict == "proved" and row.stands:
        return Chip("proved", "proved, if …") if row.conditional else chip(row), None
    good = [r for r in group.corrections if r.stands] or list(group.corrections)
    other = [r for r in group.rows if r.stands]
    if good:
        return chip(row), standing_chip(good[-1])
    return chip(row), Chip("proved", "other reading stands") if other else None


def notes(grouped: Sequence[Group]) -> tuple[Note, ...]:
    """At most four findings that a user of the paper has to know, those about theorems first."""
    found = [
        (row, group) for group in grouped for row in group.rows if row.finding and row.verdict != "proved"
    ]
    ranked = sorted(found, key=lambda pair: _rank(pair[0]))
    said: dict[str, list[tuple[Row, Group]]] = {}
    for row, group in ranked:
        said.setdefault(row.finding or "", []).append((row, group))
    return tuple(_note(sentence, pairs) for sentence, pairs in list(said.items())[:NOTES])


def _rank(row: Row) -> int:
    if row.kind == "theorem":
        return 0 if "theorem" in row.equation else 1
    return 2 if "values of the study" in row.holds_for else 3


def _note(sentence: str, pairs: Sequence[tuple[Row, Group]]) -> Note:
    row, group = pairs[0]
    readings = [r.id.partition("[")[2].rstrip("]") for r, _ in pairs if "[" in r.id]
    return Note(
        head=words.relies(row.equation, readings),
        text=f"{sentence} {words.instead(group)}".strip(),
        link=Link(row.equation, place(group, row)),
    )


def lines(grouped: Sequence[Group]) -> tuple[ClaimLine, ...]:
    """The table of claims: definitions and laws are among the formulas of the study."""
    return tuple(
        _line(group, row)
        for group in grouped
        if group.form not in ("definition", "law") or group.fails
        for row in group.rows
    )


def _line(group: Group, row: Row) -> ClaimLine:
    printed, corrected = _chips(group, row)
    failed = row.verdict != "proved" or not row.stands
    target = anchor(group.base, "f") if group.fails else anchor(row.id, "cert")
    formula, more = _formula(group, row)
    return ClaimLine(
        anchor=anchor(row.id),
        id=row.id,
        equation=row.equation,
        sentence=row.statement,
        formula=math(formula),
        long=signs(formula) > 2 * LONG,
        more=more,
        reading=row.id.partition("[")[2].rstrip("]") or None,
        printed=printed,
        corrected=corrected,
        evidence=Link(_evidence(row), target),
        attention=failed,
    )


def _formula(group: Group, row: Row) -> tuple[str, str]:
    """The formula in LaTeX, and words for what is left out: the same form again, many parts of one form."""
    first = group.rows[0]
    if row is not first and _form(row.latex) == _form(first.latex) and row.latex:
        return "", "The formula has the form of the first reading."
    if group.fails and signs(row.latex) > LONG:
        return "", "The formula stands below."
    parts = row.latex.split(_BETWEEN)
    if row.kind != "all" or len(parts) <= PARTS + 1:
        return row.latex, ""
    return _BETWEEN.join(parts[:PARTS]), f"And {len(parts) - PARTS} more, each with its own proof."


def _form(latex: str) -> str:
    """The formula without its numbers, and with one in the place of each matrix."""
    plain = re.sub(r"\\begin\{pmatrix\}.*?\\end\{pmatrix\}", "0", latex)
    return re.sub(r"-?\\frac\{\d+\}\{\d+\}|-?[\d.]+", "0", plain)


def _evidence(row: Row) -> str:
    short = row.reason.partition(";")[0]
    if row.verdict == "refuted" and short.startswith("left is ") and len(short) < 48:
        return numbers(f"witness: {short}")
    return words.evidence(row)
