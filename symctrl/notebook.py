"""How a notebook shows statements, verdicts, reports, certificates and gains.

Text in tables is escaped; formulas stand between dollar signs, which a notebook sets with MathJax. Nothing
heavy is imported before something is shown.
"""

from __future__ import annotations

import base64
import json
import struct
import zlib
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from symctrl.gains.answer import Gains
    from symctrl.rows import Report, Row
    from symctrl.verdict import Verdict

MARKS = {"proved": "✓", "refuted": "✗", "ill-formed": "≠", "undecided": "?"}
STATES = {1: "✓ holds", -1: "✗ fails", 0: "? undecided"}
MOST_PIXELS = 400  # of a map on a side
WIDTH, HIGH, LOW, LEFT, BELOW = 460, 300, 56, 56, 40  # px of a map and of what is left of it and below


def formula(latex: str) -> str:
    """LaTeX as a notebook wants it; it is no HTML."""
    return rf"$\displaystyle {latex}$"


def _math(latex: str) -> str:
    return escape(formula(latex))


def verdict(found: Verdict) -> str:
    rows = [("why", escape(found.reason))] if found.reason else []
    if found.conditions:
        rows.append(("needs", escape("; ".join(map(str, found.conditions)))))
    if found.witness is not None:
        rows.append(("at", _values(found.witness)))
    if found.residual:
        rows.append(("left − right", _math(found.residual)))
    return f"<b>{_word(str(found.outcome))}</b>{_pairs(rows)}"


def row(found: Row) -> str:
    said = [("statement", escape(found.statement)), ("why", escape(found.reason))]
    if found.latex:
        said.insert(1, ("formula", _math(found.latex)))
    said += [("needs", escape(f"{one.condition}: {one.by or 'nobody'}")) for one in found.conditions]
    if found.witness is not None:
        said.append(("at", _values(found.witness)))
    stands = "" if found.stands or found.verdict != "proved" else ", does not stand"
    return f"<b>{escape(found.id)}: {_word(found.verdict)}{stands}</b>{_pairs(said)}"


def report(found: Report) -> str:
    head = ("equation", "id", "form", "verdict", "stands", "why not")
    rows = [
        (one.equation, one.id, one.form, _word(one.verdict), "yes" if one.stands else "no", _why_not(one))
        for one in found.rows
        if one.form != "obligation" or one.verdict != "proved"
    ]
    return f"<b>{escape(found.study)}</b>{table(head, [[escape(cell) for cell in line] for line in rows])}"


def _why_not(found: Row) -> str:
    return found.reason if found.verdict != "proved" or not found.stands else ""


class Certificate:
    """A certificate as a notebook shows it: what it states, and what the kernel says of it."""

    def __init__(self, content: Mapping[str, Any]) -> None:
        from symctrl.kernel.check import check_text

        self.content = content
        self.answer = check_text(json.dumps(content))

    def __repr__(self) -> str:
        return f"<certificate: {self.answer.status}>"

    def _repr_html_(self) -> str:
        said = [("states", f"<pre>{escape(self.answer.statement)}</pre>")] if self.answer.statement else []
        said += [("why", escape(self.answer.reason)), ("sha256", escape(str(self.content.get("sha256"))))]
        return f"<b>certificate: {self.answer.status}</b>{_pairs(said)}"


def gains(found: Gains) -> str:
    from symctrl.gains.show import percent, short

    at = _values(found.gains)
    head = ("condition", "verdict", "margin", "from")
    rows = [
        (
            _math(one.condition.latex) if one.condition.latex else escape(one.condition.statement),
            escape(f"{STATES[one.state]}{': ' * bool(one.reason)}{one.reason}"),
            "" if one.margin is None else f"≥ {short(one.margin)}",
            escape(one.condition.source),
        )
        for one in found.conditions
    ]
    where = f" on {found.graph}" if found.graph else ""
    said = [("edge", escape(found.boundary))] if found.boundary else []
    if found.margin is not None:
        said.append(("margin", f"all gains within {percent(found.margin)} % of these"))
    if found.chosen:
        said.append(
            ("chosen", escape(", ".join(f"{name} = {value}" for name, value in found.chosen.items())))
        )
    picture = svg(found) if found.map is not None else ""
    title = escape(f"{found.study}{where}: {found.verdict}") + f" at {at}" * bool(at)
    return f"<b>{title}</b>{table(head, rows)}{_pairs(said)}{picture}"


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """The cells are HTML already."""
    top = "".join(f'<th style="text-align:left">{escape(cell)}</th>' for cell in head)
    body = "".join(
        "<tr>" + "".join(f'<td style="text-align:left">{cell}</td>' for cell in line) + "</tr>"
        for line in rows
    )
    return f"<table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table>"


def _pairs(rows: Sequence[tuple[str, str]]) -> str:
    body = "".join(
        f'<tr><th style="text-align:left">{name}</th><td style="text-align:left">{cell}</td></tr>'
        for name, cell in rows
    )
    return f"<table><tbody>{body}</tbody></table>" if rows else ""


def _word(outcome: str) -> str:
    return f"{MARKS.get(outcome, '')} {outcome}".strip()


def _values(witness: Mapping[str, Any]) -> str:
    return escape(", ".join(f"{name} = {value}" for name, value in witness.items()))


# The map: its cells as a picture in the SVG, and words on it


def svg(found: Gains) -> str:
    """The map of an answer, drawn inline."""
    from symctrl.gains import plot

    made = found.map
    assert made is not None
    high = HIGH if len(made.axes) > 1 else LOW
    parts = [_image(plot.thinned(made.states, MOST_PIXELS), plot.COLOURS, high)]
    at = plot.place(found)
    for state, x, y in plot.rooms(made, plot.beside(at, len(made.axes) > 1)):
        parts.append(_text(LEFT + x * WIDTH, (1 - y) * high + 4, plot.WORDS[state], "middle"))
    if at is not None:
        x, y = LEFT + at[0] * WIDTH, (1 - at[1]) * high
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{plot.INK}"/>')
        right = plot.is_left(at[0])
        parts.append(_text(x + (8 if right else -8), y + 4, "the study", "start" if right else "end"))
    for k, axis in enumerate(made.axes):
        parts += _axis(k, axis.name, float(axis.lo), float(axis.hi), high)
    size = f'viewBox="0 0 {LEFT + WIDTH + 20} {high + BELOW}" style="max-width:{LEFT + WIDTH + 20}px"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {size} role="img">{"".join(parts)}</svg>'


def _axis(k: int, name: str, low: float, high: float, size: int) -> list[str]:
    """The ends of an axis as numbers, and its name between."""
    places: list[tuple[float, float, str]]
    if k == 0:
        below, end = size + 16, LEFT + WIDTH
        places = [(LEFT, below, "start"), (end, below, "end"), ((LEFT + end) / 2, below + 14, "middle")]
    else:
        places = [(LEFT - 6, size, "end"), (LEFT - 6, 12, "end"), (LEFT - 6, size / 2, "end")]
    words = (f"{low:.6g}", f"{high:.6g}", name)
    return [
        _text(x, y, word, anchor, "currentColor") for (x, y, anchor), word in zip(places, words, strict=True)
    ]


def _text(x: float, y: float, word: str, anchor: str, colour: str = "#1c1b19") -> str:
    style = f'font-family="sans-serif" font-size="12" fill="{colour}" text-anchor="{anchor}"'
    return f'<text x="{x:.1f}" y="{y:.1f}" {style}>{escape(word)}</text>'


def _image(states: Any, colours: Mapping[int, str], high: int) -> str:
    content = base64.b64encode(png(states, colours)).decode()
    place = f'x="{LEFT}" y="0" width="{WIDTH}" height="{high}" preserveAspectRatio="none"'
    return f'<image {place} style="image-rendering:pixelated" href="data:image/png;base64,{content}"/>'


def png(states: Any, colours: Mapping[int, str]) -> bytes:
    """Rows from below, a pixel for each cell, its colour that of the state."""
    order = sorted(colours)
    palette = b"".join(bytes.fromhex(colours[state][1:]) for state in order)
    rows = b"".join(b"\0" + bytes(order.index(int(s)) for s in line) for line in states[::-1])
    size = struct.pack(">IIBBBBB", states.shape[1], states.shape[0], 8, 3, 0, 0, 0)
    chunks = [(b"IHDR", size), (b"PLTE", palette), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(kind, content) for kind, content in chunks)


def _chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
