"""Which parts of two formulas differ, by their signs in order; what differs is tinted.

A bracket that has come or gone is not a difference by itself: it follows from the others.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from difflib import SequenceMatcher

from symctrl.report.formula import BRACKETS, Element, row

MARKED_AT_MOST = 0.5  # of the signs; where more differ, the two are simply different
_PLACES = {  # of the parts of an element that has a fixed number of them
    "msub": ("", "_"),
    "msup": ("", "^"),
    "msubsup": ("", "_", "^"),
    "munder": ("", "_"),
    "mfrac": ("/", "÷"),
}
_ROWS = ("mrow", "mtd", "msqrt", "math")  # elements that take any number of parts

Elements = tuple[Element, ...]


def marked(left: Elements, right: Elements) -> tuple[Elements, Elements]:
    """Both formulas, each with what the other has not under `<mrow class="del">` and `"ins"`."""
    a, b = list(_leaves(left, "")), list(_leaves(right, ""))
    matcher = SequenceMatcher(None, a, b, autojunk=False)
    if not a or not b or matcher.ratio() < 1 - MARKED_AT_MOST:
        return left, right
    same_a: set[int] = set()
    same_b: set[int] = set()
    for block in matcher.get_matching_blocks():
        same_a.update(range(block.a, block.a + block.size))
        same_b.update(range(block.b, block.b + block.size))
    return _Tint("del", same_a).row(left), _Tint("ins", same_b).row(right)


def _leaves(parts: Sequence[Element], where: str) -> Iterator[tuple[str, str]]:
    """Every leaf's text with its place: above or below what, so that x² and x2 are told apart."""
    for part in parts:
        if not part.parts:
            yield part.text or part.tag, where
        elif part.tag in _PLACES:
            for place, inner in zip(_PLACES[part.tag], part.parts, strict=True):
                yield from _leaves((inner,), where + place)
        else:
            yield from _leaves(part.parts, where)


class _Tint:
    """Walks a formula in the order of its leaves and tints those that are not among the `same`."""

    def __init__(self, how: str, same: set[int]) -> None:
        self.how = how
        self.same = same
        self.at = 0

    def row(self, parts: Elements) -> Elements:
        return self._joined([self._one(part) for part in parts])

    def _one(self, part: Element) -> tuple[Element, bool | None]:
        """The element, and whether all of it differs; None where nothing in it counts."""
        if not part.parts:
            differs = self.at not in self.same
            self.at += 1
            neutral = part.tag == "mspace" or part.text in BRACKETS or not part.text
            return part, None if neutral else differs
        told = [self._one(inner) for inner in part.parts]
        counted = {differs for _, differs in told if differs is not None}
        if counted == {True}:
            return Element(part.tag, tuple(e for e, _ in told), "", part.attributes), True
        inside = (
            self._joined(told)
            if part.tag in _ROWS
            else tuple(self._tinted([e]) if d and e.tag not in ("mtr", "mtd") else e for e, d in told)
        )
        if part.tag == "mtr":
            inside = tuple(Element("mtd", (self._tinted(e.parts),)) if d else e for e, d in told)
        if part.tag == "mtable":
            inside = tuple(self._line(e) if d else e for e, d in told)
        return Element(part.tag, inside, "", part.attributes), False if counted else None

    def _line(self, line: Element) -> Element:
        return Element("mtr", tuple(Element("mtd", (self._tinted(cell.parts),)) for cell in line.parts))

    def _joined(self, told: Sequence[tuple[Element, bool | None]]) -> Elements:
        """Neighbours that differ under one tint, with what stands between them."""
        made: list[Element] = []
        run: list[Element] = []
        waiting: list[Element] = []
        for element, differs in told:
            if differs:
                run += [*waiting, element] if run else [element]
                made += [] if len(run) > len(waiting) or not waiting else waiting
                waiting = []
            elif differs is None and run:
                waiting.append(element)
            else:
                made += [*([self._tinted(run)] if run else []), *waiting, element]
                run, waiting = [], []
        return (*made, *([self._tinted(run)] if run else []), *waiting)

    def _tinted(self, run: Sequence[Element]) -> Element:
        return Element("mrow", (row(tuple(run)),), "", f' class="{self.how}"')
