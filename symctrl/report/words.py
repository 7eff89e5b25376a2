"""The sentences of a page. What a finding says is the author's; the rest are these few forms with numbers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from symctrl.report.names import Group, capital, certificate_kind, few, in_words
from symctrl.rows import Report, Row
from symctrl.table import MARKS

_EVIDENCE = {
    "identity": "identity, exact",
    "combination": "assumptions and squares, exact",
    "squeeze": "both sides squeezed, exact",
    "definite": "matrix factors, exact",
    "each": "term by term in sums",
    "spectral": "spectrum of the graph, exact",
    "conforms": "shapes conform",
    "argument": "argument, every line checked",
    "witness": "witness, exact",
    "against": "counterexample, exact",
}
_RATHER = {
    "proved": "stands",
    "refuted": "is false",
    "ill-formed": "is ill-formed",
    "undecided": "is not proved",
}


def lead(report: Report, grouped: Sequence[Group]) -> tuple[str, ...]:
    """What was found, in at most five sentences; the theorem that comes last is what a paper is about."""
    theorem = next((g for g in reversed(grouped) if g.rows[0].kind == "theorem"), None)
    said = [] if theorem is None else list(_about(theorem))
    return (*said, *_counted(grouped))


def _about(theorem: Group) -> tuple[str, ...]:
    row = theorem.rows[0]
    name = capital(row.equation)
    printed = " as printed" if row.form == "printed" else ""
    if not theorem.fails:
        return (f"{name} stands{printed}{_condition(row)}: {row.statement}",)
    because = f": {row.finding}" if row.finding else "."
    first = f"{name}{printed} {_RATHER[row.verdict]}{because}"
    standing = [r for r in theorem.corrections if r.stands]
    if not standing:
        return first, "No correction stands yet."
    good = standing[-1]
    return first, f"A corrected theorem stands{_condition(good)}: {good.finding or good.statement}"


def _condition(row: Row) -> str:
    """Under how many assumptions about the trajectory a row stands."""
    held = [given for given in row.given if given.about == "trajectory"]
    if not row.conditional or not held:
        return ""
    return f", under {counted(len(held), 'assumption')} about what happens along the motion"


def _counted(grouped: Sequence[Group]) -> tuple[str, ...]:
    printed = [g for g in grouped if g.form == "printed"]
    failing = [g for g in printed if g.fails]
    if not printed:
        own = [g for g in grouped if g.form == "claimed"]
        stand = sum(not g.fails for g in own)
        return (f"Of {counted(len(own), 'claim')} {stand} stand{'s' if stand == 1 else ''}.",) if own else ()
    if not failing:
        return (f"All {counted(len(printed), 'printed claim')} stand.",)
    settled = sum(bool(g.standing) for g in failing)
    return (
        f"Of {counted(len(printed), 'printed claim')}, {len(printed) - len(failing)} "
        f"stand in every reading and {len(failing)} do not; for {settled} of these a correction or another "
        "reading stands.",
    )


def counted(number: int, noun: str) -> str:
    """`1 claim`, `3 claims`."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def entered(report: Report, numbered: int) -> str:
    """How much of the paper the rows are about."""
    if not numbered:
        return ""
    missing = f"; not entered: {', '.join(report.missing)}" if report.missing else ""
    return f"Of {numbered} numbered items of the paper {numbered - len(report.missing)} are entered{missing}."


def tally(rows: Sequence[Row]) -> dict[str, int]:
    """How many rows have each verdict, in the order of the marks."""
    count = Counter(row.verdict for row in rows)
    return {verdict: count[verdict] for verdict in MARKS if count[verdict]}


def evidence(row: Row) -> str:
    """What shows the verdict, in few words."""
    if row.certificate is None:
        return "shapes do not conform" if row.verdict == "ill-formed" else "no certificate, no witness"
    kinds = certificate_kind(row)
    if kinds == "argument" and row.method.startswith("argument"):
        lines = [id_ for id_ in row.rests_on if id_.startswith(f"{row.id}/")]
        return f"argument, {counted(len(lines), 'line')} checked"
    head, _, kind = kinds.rpartition(", ")
    return ", ".join(filter(None, [head, _EVIDENCE.get(kind, kind)]))


def relies(row_equation: str, readings: Sequence[str]) -> str:
    """The head of a note: whom it concerns."""
    read = f", read as {in_words(readings)}" if readings else ""
    first = row_equation.partition(" ")[0]
    what = "the text " if first in ("after", "before", "in") else "equation " if first[:1] == "(" else ""
    return f"If you rely on {what}{row_equation}{read}"


def instead(group: Group) -> str:
    """What holds in the place of a claim that fails, in one sentence; empty where nothing does."""
    good = [row for row in group.corrections if row.stands]
    if good:
        return good[-1].finding or good[-1].statement
    readings = [row.reading for row in group.rows if row.stands and row.reading]
    return f"It stands for {few(readings)}." if readings else ""
