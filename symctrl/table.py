"""The verdicts of a study as a terminal shows them: a table, or the proof graph as a nested list.

Without colour every line says the same: a verdict is a mark and a word.
"""

from __future__ import annotations

import textwrap
from collections import Counter
from collections.abc import Iterator, Sequence

from rich.cells import cell_len
from rich.console import Console
from rich.text import Text

from symctrl.rows import Report, Row

MARKS = {"proved": "✓", "refuted": "✗", "ill-formed": "≠", "undecided": "?"}
ARGUMENT = ("step", "obligation", "fact")  # rows of a theorem's arguments, not claims of their own
_STYLES = {"proved": "green", "refuted": "red", "ill-formed": "magenta", "undecided": "yellow"}
_HEADS = ("equation", "id", "form", "verdict", "stands", "time")
_GAP = "  "
_REASON_BESIDE = 36  # columns that a reason needs to stand beside its row and not below it
_LONGEST = 160  # of each thing said about a row; the JSON has it whole


def show(
    report: Report, console: Console, *, numbered: int = 0, tree: bool = False, strict: bool = False
) -> None:
    """Print the table, or the tree, of `report`, and a summary; where that is no terminal, one line a row.

    numbered: how many items the paper numbers, where the study says so.
    """
    width = console.width if console.is_terminal else None
    lines = _tree(report) if tree else _table([row for row in report.rows if _is_told(row)], width)
    findings = _findings(report.rows, width)
    for line in (*lines, *findings, *_summary(report, numbered, strict), Text()):
        console.print(line, soft_wrap=True)


def _is_told(row: Row) -> bool:
    """Is the row in the table? An obligation that is met is in the tree and in the JSON."""
    return row.form != "obligation" or row.verdict != "proved"


def _table(rows: Sequence[Row], width: int | None) -> Iterator[Text]:
    cells = [_cells(row) for row in rows]
    widths = [max(map(cell_len, column)) for column in zip(_HEADS, *cells, strict=True)]
    used = sum(widths) + len(_GAP) * len(widths)
    yield Text(_line(_HEADS, widths).rstrip(), style="bold")
    for row, texts in zip(rows, cells, strict=True):
        line = Text(_line(texts, widths))
        start = len(_GAP.join(_padded(texts[:3], widths[:3])) + _GAP)
        line.stylize(_STYLES[row.verdict], start, start + len(texts[3]))
        reason = _in_few_words(row)
        if width is None or (reason and width - used >= _REASON_BESIDE):
            yield from _beside(line, reason, used, width)
        else:
            yield from _below(line, reason, width)


def _findings(rows: Sequence[Row], width: int | None) -> Iterator[Text]:
    """What it means that a claim fails, in the author's sentences, each once with its ids."""
    said: dict[str, list[str]] = {}
    for row in rows:
        if row.finding and row.verdict in ("refuted", "ill-formed"):
            said.setdefault(row.finding, []).append(row.id)
    if said:
        yield Text("what it means", style="bold")
    for sentence, ids in said.items():
        first, *more = _wrapped(f"{', '.join(ids)}: {sentence}", width)
        yield Text(f"  {first}")
        yield from (Text(f"    {line}") for line in more)


def _wrapped(text: str, width: int | None) -> list[str]:
    return textwrap.wrap(text, width - 4) if width else [text]


def _beside(line: Text, reason: str, used: int, width: int | None) -> Iterator[Text]:
    first, *more = textwrap.wrap(reason, width - used) if width else [reason]
    yield Text.assemble(line, _GAP, first) if first else line
    yield from (Text(" " * used + text) for text in more)


def _below(line: Text, reason: str, width: int) -> Iterator[Text]:
    yield line
    indent = " " * 6
    yield from map(Text, textwrap.wrap(reason, width, initial_indent=indent, subsequent_indent=indent))


def _cells(row: Row) -> tuple[str, ...]:
    verdict = f"{MARKS[row.verdict]} {row.verdict}"
    return row.equation, row.id, row.form, verdict, _stands(row), f"{row.seconds:.1f} s"


def _stands(row: Row) -> str:
    if not row.stands:
        return "no"
    return "if" if row.conditional else "yes"


def _in_few_words(row: Row) -> str:
    """Nothing where all is well; else conditions without a voucher, the reason, what is odd beside it."""
    said = [f"if {given.text}" for given in row.given if row.conditional and given.about == "trajectory"]
    said += [f"needs {condition.condition}" for condition in row.conditions if condition.by is None]
    if row.verdict != "proved" or not (row.stands or said):
        said.append(row.reason)
    if row.units is not None and row.units.mismatch:
        said.append(f"units: {row.units.mismatch}")
    if row.twins is not None and row.twins.still_true:
        said.append(f"twins that hold too: {', '.join(row.twins.still_true)}")
    if row.twins is not None and row.twins.failed:
        said.append(f"twins not decided: {', '.join(row.twins.failed)}")
    return "; ".join(map(_shortened, said))


def _shortened(text: str) -> str:
    """Its beginning, where it is long; a formula is cut anywhere, for it may have no blanks."""
    flat = " ".join(text.split())
    return flat if len(flat) <= _LONGEST else f"{flat[: _LONGEST - 2].rstrip()} …"


def _line(texts: Sequence[str], widths: Sequence[int]) -> str:
    *left, last = _padded(texts, widths)
    return _GAP.join([*left, last.strip().rjust(widths[-1])])


def _padded(texts: Sequence[str], widths: Sequence[int]) -> list[str]:
    return [text + " " * (width - cell_len(text)) for text, width in zip(texts, widths, strict=True)]


def _tree(report: Report) -> Iterator[Text]:
    """Each statement on which nothing rests, and below it what it rests on; nothing is repeated."""
    rows = {row.id: row for row in report.rows}
    used = {below for row in report.rows for below in row.rests_on if below != row.id}
    shown: set[str] = set()
    for row in report.rows:
        if row.id not in used:
            yield from _branch(row.id, rows, shown, 0)
    # What is left rests on itself by way of others; it must not be lost.
    for row in report.rows:
        if row.id not in shown:
            yield from _branch(row.id, rows, shown, 0)


def _branch(name: str, rows: dict[str, Row], shown: set[str], depth: int) -> Iterator[Text]:
    indent = "  " * depth + "- "
    if name not in rows:
        yield Text(f"{indent}{name}: not decided in this run")
        return
    row = rows[name]
    verdict = (f"{MARKS[row.verdict]} {row.verdict}", _STYLES[row.verdict])
    stands = {"yes": "", "if": ", stands conditionally", "no": ", does not stand"}[_stands(row)]
    again = ", as above" if name in shown and row.rests_on else ""
    said = f" {row.statement}" if row.form == "step" else ""
    yield Text.assemble(f"{indent}{row.equation} {name}:{said} ", verdict, stands, again)
    if name not in shown:
        shown.add(name)
        for below in row.rests_on:
            yield from _branch(below, rows, shown, depth + 1)


def _summary(report: Report, numbered: int, strict: bool) -> Iterator[Text]:
    claims = [row for row in report.rows if row.form not in ARGUMENT]
    count = Counter(row.verdict for row in claims)
    verdicts = ", ".join(f"{count[verdict]} {verdict}" for verdict in MARKS if count[verdict]) or "no claims"
    stand = sum(row.stands for row in claims)
    conditional = sum(row.stands and row.conditional for row in claims)
    under = f" ({conditional} conditionally)" if conditional else ""
    graph = f" on {report.graph}" if report.graph else ""
    head = f"{report.study}{graph}: {verdicts}; {stand} of {len(claims)} stand{under}"
    yield Text(head, style="bold")
    lines = [row for row in report.rows if row.form == "step"]
    if lines:
        met = sum(row.verdict == "proved" for row in lines)
        obligations = [row for row in report.rows if row.form == "obligation"]
        proved = sum(row.verdict == "proved" for row in obligations)
        yield Text(
            f"arguments of theorems: {met} of {len(lines)} lines, {proved} of {len(obligations)} obligations"
        )
    if numbered:
        missing = f"; missing: {', '.join(report.missing)}" if report.missing else ""
        entered = numbered - len(report.missing)
        yield Text(f"of {numbered} numbered items of the paper {entered} are entered{missing}")
    open_ = [row.id for row in report.rows if not settled(row, strict)]
    if open_:
        yield Text(f"not settled: {', '.join(open_)}", style="bold yellow")


def settled(row: Row, strict: bool) -> bool:
    """Whether nothing is left to do about the row; under `strict` one that stands conditionally is left."""
    return row.settled and not (strict and row.conditional)
