"""A tree of the proof graph as an SVG, coloured by the page's variables alone."""

from __future__ import annotations

from collections.abc import Iterator

from markupsafe import Markup, escape

from symctrl.report.page import Branch, Chip, Tree

WIDTH, TOP, ROW = 560, 34, 20
BOX, LINE, LEAF = 118, 152, 336  # where the theorem's box ends, where lines and leaves begin
ICON = 13
_SIGN = 6.4  # about the width of a sign of 12 px


def draw(tree: Tree) -> Markup:
    """Left the theorem, then its lines, then what these rest on; a cut link has a cross."""
    body = list(_body(tree))
    height = TOP + ROW * _rows(tree) + 6
    middle = min(TOP + ROW * _rows(tree) / 2, TOP + 150)
    links, labels = [], []
    for y, branch in body:
        if branch is None:
            continue
        links.append(_link(BOX + 4, middle, LINE - 3, y, branch.cut, branch.tainted))
        labels.append(_label(LINE, y, branch.chip, branch.text, LEAF - LINE - 30))
        end = LINE + 20 + _length(branch.text, LEAF - LINE - 30)
        for k, leaf in enumerate(branch.leaves):
            links.append(_link(end + 4, y, LEAF - 3, y + ROW * k, leaf.cut, branch.tainted))
            labels.append(_label(LEAF, y + ROW * k, leaf.chip, leaf.text, WIDTH - LEAF - 20))
        if branch.more:
            below = y + ROW * len(branch.leaves)
            labels.append(_text(LEAF, below + 4, branch.more, WIDTH - LEAF, "s"))
    headings = [_text(LINE, y + 4, text, WIDTH - LINE, "s b") for y, text in _headings(tree)]
    label = (
        f"Proof graph of {tree.equation}, {tree.side or 'as claimed'}: {tree.summary}; the list has the same"
    )
    head = (
        f'<text x="0" y="14" class="h">{escape(tree.side or "Claimed")}</text>'
        f'<text x="{WIDTH}" y="14" class="s" text-anchor="end">{escape(tree.summary)}</text>'
        f'<line x1="0" x2="{WIDTH}" y1="22" y2="22" class="ax"></line>'
    )
    inside = head + "".join([*links, *headings, *labels, _box(tree, middle)])
    frame = f'viewBox="0 0 {WIDTH} {height:g}" class="pg" role="img" aria-label="{escape(label)}"'
    return Markup(f"<svg {frame}>{inside}</svg>")  # of numbers and escaped text


def _height(branch: Branch) -> int:
    return max(1, len(branch.leaves) + bool(branch.more and branch.leaves))


def _rows(tree: Tree) -> int:
    return sum(1 + sum(map(_height, limb.branches)) for limb in tree.limbs)


def _body(tree: Tree) -> Iterator[tuple[float, Branch | None]]:
    """The height of each line, and None at headings."""
    y = TOP + ROW / 2
    for limb in tree.limbs:
        yield y, None
        y += ROW
        for branch in limb.branches:
            yield y, branch
            y += ROW * _height(branch)


def _headings(tree: Tree) -> Iterator[tuple[float, str]]:
    heights = [y for y, branch in _body(tree) if branch is None]
    yield from zip(heights, (limb.heading for limb in tree.limbs), strict=True)


def _box(tree: Tree, middle: float) -> str:
    top = middle - 24
    word = tree.chip.word
    return (
        f'<g class="th {tree.chip.shape}"><rect x="0.5" y="{top:g}" width="{BOX}" height="48" rx="3"></rect>'
        f"{_icon(8, middle - 10, tree.chip)}"
        f"{_text(27, middle - 5, tree.equation, BOX - 30, 'b')}"
        f"{_text(8, middle + 15, word, BOX - 12, 's')}</g>"
    )


def _label(x: float, y: float, chip: Chip, text: str, room: float) -> str:
    return _icon(x, y, chip) + _text(x + 19, y + 4, text, room, "")


def _icon(x: float, y: float, chip: Chip) -> str:
    place = f'x="{x:g}" y="{y - ICON / 2:g}" width="{ICON}" height="{ICON}"'
    return f'<use href="#{chip.shape}" {place} class="{chip.shape}"/>'


def _text(x: float, y: float, text: str, room: float, style: str) -> str:
    named = f' class="{style}"' if style else ""
    return f'<text x="{x:g}" y="{y:g}"{named}>{escape(_cut(text, room))}</text>'


def _cut(text: str, room: float) -> str:
    """The text, or its beginning where there is no room; the list has it whole."""
    most = int(room / _SIGN)
    return text if len(text) <= most else f"{text[: most - 1].rstrip()}…"


def _length(text: str, room: float) -> float:
    return len(_cut(text, room)) * _SIGN


def _link(x: float, y: float, to_x: float, to_y: float, cut: bool, tainted: bool) -> str:
    if cut:
        (x1, x2), (y1, y2) = ([a + (b - a) * s for s in (0.38, 0.62)] for a, b in ((x, to_x), (y, to_y)))
        mx, my = (x + to_x) / 2, (y + to_y) / 2
        line = f"M{x:g} {y:g}L{x1:.1f} {y1:.1f}M{x2:.1f} {y2:.1f}L{to_x:g} {to_y:g}"
        return (
            f'<path d="{line}" class="lk cut"></path>'
            f'<path d="M{mx - 4:.1f} {my - 4:.1f}l8 8m0 -8l-8 8" class="cutx"></path>'
        )
    half = (x + to_x) / 2
    style = "lk taint" if tainted else "lk"
    return (
        f'<path d="M{x:g} {y:g}C{half:g} {y:g} {half:g} {to_y:g} {to_x:g} {to_y:g}" class="{style}"></path>'
    )
