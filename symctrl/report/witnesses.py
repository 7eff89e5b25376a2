"""Witnesses as tables: the components of a vector or matrix together, zeros in one line, the failing side."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from markupsafe import Markup

from symctrl.latex import name_latex
from symctrl.report.mathml import math
from symctrl.report.names import decimal, few, numbers
from symctrl.report.page import Script, Value, WitnessBlock
from symctrl.rows import Row

LONGEST = 9  # entries of a vector that are all shown
_NAME = re.compile(r"([^\[\].]+)(?:\.([^\[\]]+))?(?:\[([\d,]+)\])?")
_SIDES = re.compile(r"left is (about )?(\S+), right (?:is )?(about )?([^\s:;]+)")
_VALUES = re.compile(r"^at (?:.* on the graph with the edges [\w-]+(?:, [\w-]+)*|.*?, \.\.) ")
_VALUE = re.compile(r"the value is (\S+) (<=?) 0")


@dataclass(frozen=True)
class Symbols:
    """How the study's symbols are shown, by the name before a node: their units, and LaTeX of their own."""

    units: Mapping[str, str]
    latex: Mapping[str, str]

    def name(self, symbol: str, node: str) -> Markup:
        own = self.latex.get(symbol)
        if own is None:
            return math(name_latex(f"{symbol}.{node}" if node else symbol))
        return math(f"{{{own}}}_{{{node}}}" if node else own)


def block(row: Row, symbols: Symbols, script: Script) -> WitnessBlock | None:
    """The witness of a row that has one."""
    if row.witness is None:
        return None
    values = {k: v for k, v in row.witness.items() if k != "graph" and not isinstance(v, list | tuple)}
    vectors = {k: v for k, v in row.witness.items() if k != "graph" and isinstance(v, list | tuple)}
    told, zeros = _table(values, symbols)
    told += [Value(math(name_latex(name)), _sparse(entries), "") for name, entries in vectors.items()]
    return WitnessBlock(
        values=tuple(told),
        zeros=few(zeros, 8),
        graph=_graph(row.witness.get("graph")),
        outcome=outcome(row),
        hypotheses=tuple(_hypotheses(row)),
        script=script,
    )


def outcome(row: Row) -> tuple[str, ...]:
    """The failing sides, exact first; where the verdict has none, its reason."""
    reason = row.reason.replace(
        "; it holds with the corrected definitions: it is wrong only through what it uses", ""
    )
    sides = _SIDES.search(row.reason)
    if sides:
        about = "about " if sides[1] or sides[3] else ""
        return tuple(
            f"{name} side: {about}{_number(text)}" for name, text in (("left", sides[2]), ("right", sides[4]))
        )
    value = _VALUE.search(row.reason)
    if value:
        return (f"value: {_number(value[1])}, which is {value[2].replace('<=', '≤')} 0",)
    return (numbers(_VALUES.sub("", reason.partition("; it fails with")[0])),)


def _number(text: str) -> str:
    try:
        value = Fraction(text)
    except ValueError:
        return numbers(text)
    return " ".join(filter(None, [numbers(text), decimal(value) if "/" in text else ""]))


def _table(values: Mapping[str, Any], symbols: Symbols) -> tuple[list[Value], list[str]]:
    """Each symbol with its entries in order; the names of those that are zero throughout."""
    entries: dict[tuple[str, str], dict[tuple[int, ...], Any]] = {}
    for name, value in values.items():
        match = _NAME.fullmatch(name)
        if match is None:
            entries[(name, "")] = {(): value}
            continue
        index = tuple(int(k) for k in match[3].split(",")) if match[3] else ()
        entries.setdefault((match[1], match[2] or ""), {})[index] = value
    told, zeros = [], []
    for (symbol, node), parts in sorted(entries.items(), key=lambda item: (item[0][0], item[0][1])):
        if all(value == "0" for value in parts.values()):
            zeros.append(f"{symbol} of {node}" if node else symbol)
        else:
            told.append(Value(symbols.name(symbol, node), _entries(parts), symbols.units.get(symbol, "")))
    return told, zeros


def _entries(parts: Mapping[tuple[int, ...], Any]) -> str:
    if list(parts) == [()]:
        return _one(parts[()])
    if any(len(index) == 2 for index in parts):
        size = max(max(index) for index in parts)
        rows = [
            [_one(parts.get((r, c), parts.get((c, r), "0"))) for c in range(1, size + 1)]
            for r in range(1, size + 1)
        ]
        return f"({'; '.join(', '.join(row) for row in rows)})"
    return f"({', '.join(_one(parts[index]) for index in sorted(parts))})"


def _one(value: Any) -> str:
    """A number, or an angle by its cosine and sine."""
    if isinstance(value, Mapping):
        return numbers(f"the angle with cos {value['cos']}, sin {value['sin']}")
    return numbers(str(value))


def _sparse(entries: Sequence[Any]) -> str:
    if len(entries) <= LONGEST:
        return f"({', '.join(map(_one, entries))})"
    shown = [f"{_one(entry)} at {k}" for k, entry in enumerate(entries, start=1) if entry != "0"]
    return f"{few(shown)}; the other of {len(entries)} entries are 0"


def _graph(edges: Any) -> str | None:
    return ", ".join("–".join(map(str, edge)) for edge in edges) if edges else None


def _hypotheses(row: Row) -> list[str]:
    """What is assumed and holds at the witness; the kernel checks it there."""
    made = row.certificate or {}
    given = made.get("statement", {}).get("given", [])
    return [str(one.get("text") or one["kind"].replace("_", " ")) for one in given]
