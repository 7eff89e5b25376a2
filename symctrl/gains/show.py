"""Gains as a table on a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

import numpy as np
from rich.cells import cell_len
from rich.console import Console
from rich.table import Table
from rich.text import Text

from symctrl.gains.answer import Gains
from symctrl.gains.definite import FAILS, HOLDS, OPEN
from symctrl.gains.point import Answer
from symctrl.gains.search import Best

MARKS = {HOLDS: "✓", FAILS: "✗", OPEN: "?"}
LONG = 12  # characters of an exact number beyond which a decimal, rounded to the safe side, is shown
WORDS = {HOLDS: "feasible", FAILS: "infeasible", OPEN: "undecided"}
HEADS = ("condition", "verdict", "margin", "from")


def show(found: Gains, console: Console) -> None:
    """On a terminal in its width; else one line for each thing that is said."""
    for line in _above(found):
        _print(console, line)
    if console.is_terminal:
        console.print(_table(found))
    else:
        for line in _lines([HEADS, *map(_cells, found.conditions)]):
            _print(console, line)
    for line in _below(found):
        _print(console, line)


def _print(console: Console, line: str) -> None:
    console.print(Text(line), soft_wrap=not console.is_terminal)


def _above(found: Gains) -> Iterator[str]:
    where = f" on {found.graph}" if found.graph else ""
    named = f" at {_named(found.gains)}" if found.gains else ""
    yield f"{found.study}{where}: {MARKS[found.state]} {found.verdict}{named}"
    if found.reason:
        yield found.reason
    if found.chosen:
        yield f"chosen: {_named(found.chosen)}"


def _below(found: Gains) -> Iterator[str]:
    if found.spectrum is not None:
        low, high = found.spectrum.low, found.spectrum.high
        exactly = f"is {low}" if low == high else f"lies between {short(low)} and {short(high, up=True)}"
        yield f"the largest eigenvalue of the Laplacian {exactly}"
    if found.boundary:
        yield f"edge: {found.boundary}"
    if found.margin is not None:
        yield f"margin: feasible for all gains within {percent(found.margin)} % of these"
    if found.best is not None:
        yield _best(*found.best)
    if found.map is not None:
        states = found.map.states
        counts = [(int(np.count_nonzero(states == state)), word) for state, word in WORDS.items()]
        cells = ", ".join(f"{count} {word}" for count, word in counts if count)
        yield f"map: {cells} of {states.size} cells"
    if found.assumes:
        yield "the theorem also assumes: " + "; ".join(text for text, _ in found.assumes)


def _named(values: Mapping[str, Fraction]) -> str:
    return ", ".join(f"{name} = {value}" for name, value in values.items())


def _best(what: str, best: Best) -> str:
    if best.objective is None:
        return f"largest {what}: no feasible gains were found"
    at = ", ".join(f"{name} = {_decimal(value)}" for name, value in best.gains.items())
    value = f"{percent(best.objective)} %" if what == "margin" else short(best.objective)
    return f"largest {what} found: {value} at {at} (certified there)"


def percent(margin: Fraction) -> str:
    """Exactly: a margin is a multiple of one part in 10,000."""
    return _decimal(100 * margin)


def _table(found: Gains) -> Table:
    table = Table(box=None, pad_edge=False, header_style="", show_edge=False)
    for name in HEADS:
        table.add_column(name, overflow="fold")
    for answer in found.conditions:
        table.add_row(*map(Text, _cells(answer)))
    return table


def _cells(answer: Answer) -> tuple[str, ...]:
    margin = "" if answer.margin is None else f">= {short(answer.margin)}"
    verdict = f"{MARKS[answer.state]} {_verdict(answer)}"
    return answer.condition.statement, verdict, margin, answer.condition.source


def _lines(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    widths = [max(map(cell_len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        padded = (cell + " " * (w - cell_len(cell)) for cell, w in zip(row, widths, strict=True))
        yield "  ".join(padded).rstrip()


def _verdict(answer: Answer) -> str:
    word = {HOLDS: "holds", FAILS: "fails", OPEN: "undecided"}[answer.state]
    return f"{word}: {answer.reason}" if answer.reason else word


def short(value: Fraction, up: bool = False) -> str:
    """Exact where that is short; else a decimal rounded to the safe side."""
    if len(str(value)) <= LONG:
        return str(value)
    scale = 10**6
    whole = -(-value * scale // 1) if up else value * scale // 1
    return _decimal(Fraction(int(whole), scale))


def _decimal(value: Fraction) -> str:
    """A number with a finite decimal expansion as such."""
    text = f"{float(value):.12g}"
    return text if Fraction(text) == value else str(value)
