"""Formulas as MathML, in pieces between which a line may break."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from markupsafe import Markup

from symctrl.report.difference import marked
from symctrl.report.formula import RELATIONS, SIGNS, Element, parse

UNBROKEN = 26  # about as many signs as fit in a line on a phone
WIDE = 38  # about as many as in half a page
LARGEST = 5  # rows or columns of a matrix that are shown in full


def math(latex: str, display: bool = False) -> Markup:
    """A formula; in pieces if it is long."""
    return _shown(_elided(parse(latex)), display)


def pair(printed: str, corrected: str) -> tuple[Markup, Markup]:
    """Two formulas, each with the parts tinted that the other has not."""
    left, right = marked(_elided(parse(printed)), _elided(parse(corrected)))
    return _shown(left, True), _shown(right, True)


def differ(printed: str, corrected: str) -> bool:
    """Do two formulas say something different?"""
    return parse(printed) != parse(corrected)


def signs(latex: str) -> float:
    """About how many signs a formula is wide."""
    return width(_elided(parse(latex)))


def width(parts: Sequence[Element]) -> float:
    """About how many signs the elements are wide."""
    return sum(map(_width, parts))


def _width(part: Element) -> float:
    if part.tag in ("mfrac", "munder"):
        return max(map(_width, part.parts))
    if part.tag == "mtable":
        return sum(max(width(cell.parts) + 1 for cell in column) for column in _columns(part))
    if part.tag == "mover":
        return _width(part.parts[0])
    if part.tag in ("msub", "msup", "msubsup"):
        return _width(part.parts[0]) + 0.7 * max(map(_width, part.parts[1:]))
    if part.parts:
        return width(part.parts)
    if part.tag == "mspace":
        return 0.5
    return len(part.text) + (0.9 if part.is_operator and part.text in RELATIONS | SIGNS else 0)


def _columns(table: Element) -> list[tuple[Element, ...]]:
    lines = [line.parts for line in table.parts]
    return [tuple(line[k] for line in lines if k < len(line)) for k in range(max(map(len, lines)))]


def _elided(parts: Sequence[Element]) -> tuple[Element, ...]:
    """Large matrices by their first and last rows and columns, long lists by their ends."""
    return tuple(_elided_element(part) for part in parts)


def _elided_element(part: Element) -> Element:
    inside = _elided(part.parts)
    if part.tag == "mtr" and len(inside) > LARGEST:
        inside = (*inside[:2], Element("mtd", (Element("mo", text="⋯"),)), inside[-1])
    if part.tag == "mtable" and len(inside) > LARGEST:
        dots = Element("mtr", tuple(Element("mtd", (Element("mo", text="⋮"),)) for _ in inside[0].parts))
        inside = (*inside[:2], dots, inside[-1])
    commas = [k for k, one in enumerate(inside) if one.is_operator and one.text == ","]
    if part.tag == "mrow" and len(commas) >= LARGEST:
        inside = (*inside[: commas[0] + 1], Element("mo", text="⋯"), *inside[commas[-1] :])
    return Element(part.tag, inside, part.text, part.attributes)


def _shown(parts: Sequence[Element], display: bool) -> Markup:
    if not parts:
        return Markup("")
    style = ' displaystyle="true"' if display else ""
    pieces = _pieces(_spread(parts)) if width(parts) > UNBROKEN else [tuple(parts)]
    # What is put together here are leaves that `_written` has escaped.
    made = (f"<math{_size(piece)}{style}>{''.join(map(_written, piece))}</math>" for piece in pieces)
    return Markup("<wbr>".join(made))


def _spread(parts: Sequence[Element]) -> list[Element]:
    """The parts with a long tinted one in pieces that are tinted each."""
    made: list[Element] = []
    for part in parts:
        inner = part.parts[0].parts if part.attributes.startswith(" class=") and len(part.parts) == 1 else ()
        if inner and part.parts[0].tag == "mrow" and width(inner) > UNBROKEN / 2:
            tinted = (Element("mrow", piece) for piece in _pieces(inner))
            made += [Element("mrow", (row,), "", part.attributes) for row in tinted]
        else:
            made.append(part)
    return made


def _size(piece: Sequence[Element]) -> str:
    """A class for what is wider than a column, so that it is set smaller."""
    wide = width(piece)
    return "" if wide <= WIDE else ' class="w"' if wide <= 1.6 * WIDE else ' class="ww"'


def _pieces(parts: Sequence[Element]) -> list[tuple[Element, ...]]:
    """The formula cut before relations and signs, after spaces, and before what would make it wide."""
    pieces: list[list[Element]] = [[]]
    for part in parts:
        first = _first(part)
        prefix = 'form="prefix"' in first.attributes
        breaks = first.is_operator and first.text in RELATIONS | SIGNS and not prefix
        after = pieces[-1][-1] if pieces[-1] else None
        leads = after is not None and after.is_operator and after.text in RELATIONS | SIGNS
        wide = width([*pieces[-1], part]) > UNBROKEN and not leads and not first.is_operator
        if after is not None and (breaks or after.tag == "mspace" or wide):
            pieces.append([])
        pieces[-1].append(_infix(part) if breaks else part)
    return [tuple(piece) for piece in pieces if piece]


def _first(part: Element) -> Element:
    while part.tag == "mrow" and part.parts:
        part = part.parts[0]
    return part


def _infix(part: Element) -> Element:
    """The same with its first sign as one between two things, though it begins a line."""
    if part.tag == "mrow" and part.parts:
        return Element(part.tag, (_infix(part.parts[0]), *part.parts[1:]), part.text, part.attributes)
    return part if part.attributes else Element("mo", text=part.text, attributes=' form="infix"')


def _written(part: Element) -> str:
    inside = "".join(map(_written, part.parts)) if part.parts else escape(part.text, quote=False)
    return f"<{part.tag}{part.attributes}>{inside}</{part.tag}>"
