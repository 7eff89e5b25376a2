"""Gains as a table on a terminal."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction

from rich.console import Console
from rich.table import Table

from symctrl.gains.answer import Gains
from symctrl.gains.definite import FAILS, HOLDS, OPEN
from symctrl.gains.point import Answer
from symctrl.gains.search import Best

MARKS = {HOLDS: "✓", FAILS: "✗", OPEN: "?"}
LONG = 12  # characters of an exact number beyond which a decimal, rounded to the safe side, is shown
LETTERS = {"f": "feasible", "i": "infeasible", "x": "unstable", "u": "undecided"}


def show(found: Gains, console: Console) -> None:
    where = f" on {found.graph}" if found.graph else ""
    named = ", ".join(f"{name} = {value}" for name, value in found.gains.items())
    console.print(
        f"{found.study}{where}: {MARKS[found.state]} {found.verdict}" + f" at {named}" * bool(named)
    )
    if found.reason:
        console.print(found.reason)
    if found.chosen:
        console.print("chosen: " + ", ".join(f"{name} = {value}" for name, value in found.chosen.items()))
    console.print(_table(found))
    if found.spectrum is not None:
        low, high = found.spectrum.low, found.spectrum.high
        exactly = f"is {low}" if low == high else f"lies between {short(low)} and {short(high, up=True)}"
        console.print(f"the largest eigenvalue of the Laplacian {exactly}")
    if found.boundary:
        console.print(f"edge: {found.boundary}")
    if found.margin is not None:
        console.print(f"margin: feasible for all gains within {percent(found.margin)} % of these")
    if found.best is not None:
        console.print(_best(*found.best))
    if found.map is not None:
        count = Counter("".join(found.map.cells))
        cells = ", ".join(f"{count[letter]} {word}" for letter, word in LETTERS.items() if count[letter])
        console.print(f"map: {cells} of {found.map.states.size} cells")
    if found.assumes:
        console.print("the theorem also assumes: " + "; ".join(text for text, _ in found.assumes))


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
    for name in ("condition", "verdict", "margin", "from"):
        table.add_column(name, overflow="fold")
    for answer in found.conditions:
        margin = "" if answer.margin is None else f">= {short(answer.margin)}"
        verdict = f"{MARKS[answer.state]} {_verdict(answer)}"
        table.add_row(answer.condition.statement, verdict, margin, answer.condition.source)
    return table


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
