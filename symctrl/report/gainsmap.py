"""A map of gains as an SVG, coloured by the page's variables alone; each size is drawn anew."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from html import escape
from typing import Any

import numpy as np
from markupsafe import Markup

from symctrl.gains.definite import FAILS, HOLDS, OPEN
from symctrl.gains.maps import Axis, Map
from symctrl.report.formula import Element, parse
from symctrl.report.names import numbers

CLASSES = {FAILS: "i", HOLDS: "f", OPEN: "u"}  # in the order in which they are drawn
SHAPES = {HOLDS: "proved", FAILS: "refuted", OPEN: "undecided"}
BAR = 44  # the height of a map of one gain
LONG = 12  # characters of an exact number beyond which a decimal is shown
_SIGN = 6.6  # about the width of a sign of 12 px
_LINE = 15
_ICON = 15
_NEAR = 9  # px between the point and its name
_FREE = 14  # px round the name on which nothing else stands
_STEPS = (1, 2, 5)
_ROUND = [Fraction(tenths, 10) for tenths in (10, 12, 15, 20, 25, 30, 40, 50, 60, 80, 100)]

Rectangle = tuple[int, int, int, int]  # left, bottom, width, height, in cells


@dataclass(frozen=True)
class Size:
    """In px: of the whole drawing, and of what is left of and above the cells; ticks: about how many."""

    width: int
    height: int
    left: int
    ticks: int
    top: int = 24
    below: int = 40
    right: int = 14


WIDE = Size(700, 460, 52, 6)
NARROW = Size(328, 310, 42, 4)  # a phone's 360 px without the page's margins


@dataclass(frozen=True)
class Scene:
    """What is drawn. latex, units and point: of each axis. words: the name of each state. label: what is seen
    in words, for those who do not see it.
    """

    map: Map
    latex: tuple[str, ...]
    units: tuple[str, ...]
    point: tuple[Fraction, ...]
    state: int
    words: Mapping[int, str]
    label: str


def draw(scene: Scene, size: Size) -> Markup:
    """Cells, axes, the study's point and the names of the areas."""
    plot = _Plot(scene, size)
    parts = [plot.cells(), *plot.axes(), *plot.inside()]
    frame = f'viewBox="0 0 {size.width} {plot.end + size.below}" class="gm" role="img"'
    return Markup(f'<svg {frame} aria-label="{escape(scene.label)}">{"".join(parts)}</svg>')


def rectangles(cells: Any) -> list[Rectangle]:
    """The true cells in runs of a row, with equal runs of the rows above joined."""
    made: list[Rectangle] = []
    growing: dict[tuple[int, int], int] = {}  # the first row of a run that may go on
    for row in range(len(cells) + 1):
        runs = set(_runs(cells[row])) if row < len(cells) else set()
        for run in sorted(set(growing) - runs):
            bottom = growing.pop(run)
            made.append((run[0], bottom, run[1] - run[0], row - bottom))
        for run in runs - set(growing):
            growing[run] = row
    return sorted(made, key=lambda one: (one[1], one[0]))


def _runs(row: Any) -> Iterator[tuple[int, int]]:
    ends = np.flatnonzero(np.diff(np.concatenate([[0], row.astype(np.int8), [0]])))
    yield from zip(ends[::2].tolist(), ends[1::2].tolist(), strict=True)


class _Plot:
    """One drawing: cells are counted from the left and from below, px from the left and from above."""

    def __init__(self, scene: Scene, size: Size) -> None:
        self.scene, self.size = scene, size
        self.rows, self.columns = scene.map.states.shape
        self.has_height = len(scene.map.axes) > 1
        self.start = size.top if self.has_height else size.top + 4
        self.end = size.height - size.below if self.has_height else self.start + BAR
        self.across = size.width - size.left - size.right
        self.high = self.end - self.start
        self.taken = np.zeros(scene.map.states.shape, bool)  # cells on which something is written

    def cells(self) -> str:
        """One path for each class that occurs."""
        scale = f"scale({self.across / self.columns:.6g} {-self.high / self.rows:.6g})"
        place = f'transform="translate({self.size.left} {self.end}) {scale}"'
        paths = []
        for state, name in CLASSES.items():
            found = rectangles(self.scene.map.states == state)
            lines = "".join(f"M{x} {y}h{w}v{h}H{x}" for x, y, w, h in found)
            paths += [f'<path class="{name}" d="{lines}"></path>'] if lines else []
        return f'<g {place} class="cells">{"".join(paths)}</g>'

    # Axes

    def axes(self) -> Iterator[str]:
        axes, size = self.scene.map.axes, self.size
        right = size.left + self.across
        yield f'<path d="M{size.left} {self.start}V{self.end}H{right}" class="ax"></path>'
        for value in _labelled(axes[0], size.ticks, self.across, 44):
            x = self._x(value)
            yield f'<path d="M{x:.1f} {self.end}v4" class="ax"></path>'
            yield _text(x, self.end + 17, escape(plain(value)), "s", "middle")
        yield _text(right, self.end + 34, self._named(0), "n", "end")
        if self.has_height:
            for value in _labelled(axes[1], size.ticks, self.high, 26):
                y = self._y(value)
                yield f'<path d="M{size.left} {y:.1f}h-4" class="ax"></path>'
                yield _text(size.left - 7, y + 4, escape(plain(value)), "s", "end")
            yield _text(size.left - 4, self.start - 10, self._named(1), "n", "start")

    def _named(self, k: int) -> str:
        unit = self.scene.units[k]
        return spans(self.scene.latex[k]) + (escape(f", {unit}") if unit else "")

    def _x(self, value: Fraction) -> float:
        axis = self.scene.map.axes[0]
        return self.size.left + float((value - axis.lo) / (axis.hi - axis.lo)) * self.across

    def _y(self, value: Fraction) -> float:
        axis = self.scene.map.axes[1]
        return self.end - float((value - axis.lo) / (axis.hi - axis.lo)) * self.high

    # What stands on the cells

    def inside(self) -> Iterator[str]:
        yield from self._point()
        for state in (FAILS, HOLDS, OPEN):
            yield from self._area(state)

    def _point(self) -> Iterator[str]:
        """The study's gains, named where the name is inside and, as far as there is room, on one class."""
        x = self._x(self.scene.point[0])
        y = self._y(self.scene.point[1]) if self.has_height else (self.start + self.end) / 2
        lines, signs = self._point_lines()
        left, top = self._beside(x, y, max(signs) * _SIGN, len(lines) * _LINE)
        self._take(left - _FREE, top - _FREE, max(signs) * _SIGN + 2 * _FREE, len(lines) * _LINE + 2 * _FREE)
        self._take(x - _ICON, y - _ICON, 2 * _ICON, 2 * _ICON)
        shape = SHAPES[self.scene.state]
        icon = f'x="{x - _ICON / 2:.1f}" y="{y - _ICON / 2:.1f}" width="{_ICON}" height="{_ICON}"'
        yield f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{_ICON / 2 + 2}" class="ring"></circle>'
        yield f'<use href="#{shape}" {icon} class="{shape}"/>'
        for k, line in enumerate(lines):
            yield _text(left, top + _LINE * (k + 0.8), line, "s2" if k else "b", "start")

    def _point_lines(self) -> tuple[list[str], list[int]]:
        """The verdict, and in a map of two gains their values; and about how many signs each line has."""
        said = f"the study: {self.scene.words[self.scene.state]}"
        if not self.has_height:
            return [escape(said)], [len(said)]
        pairs = list(zip(self.scene.latex, self.scene.point, strict=True))
        values = ", ".join(f"{spans(name)} = {escape(exact(value))}" for name, value in pairs)
        return [escape(said), values], [len(said), sum(6 + len(exact(value)) for _, value in pairs)]

    def _beside(self, x: float, y: float, wide: float, high: float) -> tuple[float, float]:
        """The corner of what is written about a point: right of it, left, below or above."""
        away = _ICON / 2 + _NEAR
        corners = [(x + away, y - high / 2), (x - away - wide, y - high / 2)]
        corners += [(x - wide / 2, y + away), (x - wide / 2, y - away - high)]
        inside = [(left, top) for left, top in corners if self._is_inside(left, top, wide, high)]
        return max(inside or corners[:1], key=lambda corner: self._alike(corner[0], corner[1], wide, high))

    def _area(self, state: int) -> Iterator[str]:
        """The name of a class in the place nearest to its middle that has room for it."""
        free = (self.scene.map.states == state) & ~self.taken
        word = self.scene.words[state]
        for lines in ([word], _halves(word)):
            wide, high = max(map(len, lines)) * _SIGN, _LINE * len(lines)
            found = _room(free, self._columns_of(wide + 10), self._rows_of(high + 6))
            if found is None:
                continue
            x = self.size.left + found[0] * self.across / self.columns
            y = self.end - found[1] * self.high / self.rows
            for k, line in enumerate(lines):
                at = y - high / 2 + _LINE * (k + 0.8)
                yield _text(x, at, escape(line), f"a{CLASSES[state]}", "middle")
            self._take(x - wide / 2, y - high / 2, wide, high)
            return

    def _columns_of(self, px: float) -> int:
        return int(np.ceil(px * self.columns / self.across))

    def _rows_of(self, px: float) -> int:
        return int(np.ceil(px * self.rows / self.high)) if self.has_height else 1

    def _is_inside(self, left: float, top: float, wide: float, high: float) -> bool:
        across = self.size.left + 4 <= left and left + wide <= self.size.left + self.across - 4
        return across and self.start <= top and top + high <= self.end

    def _window(self, left: float, top: float, wide: float, high: float) -> tuple[slice, slice]:
        """The cells under a rectangle of px."""
        first = (left - self.size.left) * self.columns / self.across
        last = (left + wide - self.size.left) * self.columns / self.across
        low, up = ((self.end - y) * self.rows / self.high for y in (top + high, top))
        across = slice(max(0, int(np.floor(first))), max(0, int(np.ceil(last))))
        return slice(max(0, int(np.floor(low))), max(0, int(np.ceil(up)))), across

    def _alike(self, left: float, top: float, wide: float, high: float) -> float:
        """The part of the cells under a rectangle that are of the commonest class there."""
        count = np.unique(self.scene.map.states[self._window(left, top, wide, high)], return_counts=True)[1]
        return float(count.max() / count.sum()) if count.size else 0.0

    def _take(self, left: float, top: float, wide: float, high: float) -> None:
        self.taken[self._window(left, top, wide, high)] = True


def _room(free: Any, wide: int, high: int) -> tuple[float, float] | None:
    """The middle, in cells, of a window of free cells alone: of all the one nearest to their middle."""
    if wide > free.shape[1] or high > free.shape[0] or not free.any():
        return None
    sums = np.pad(np.cumsum(np.cumsum(free, 0, dtype=np.int64), 1), ((1, 0), (1, 0)))
    inside = sums[high:, wide:] - sums[:-high, wide:] - sums[high:, :-wide] + sums[:-high, :-wide]
    low, left = np.nonzero(inside == wide * high)
    if not low.size:
        return None
    rows, columns = np.nonzero(free)
    middle = float(np.median(columns)) - wide / 2, float(np.median(rows)) - high / 2
    k = int(np.argmin((left - middle[0]) ** 2 + (low - middle[1]) ** 2))
    return int(left[k]) + wide / 2, int(low[k]) + high / 2


def _halves(word: str) -> list[str]:
    """Two lines, of about the same length."""
    parts = word.split()
    cuts = [(" ".join(parts[:k]), " ".join(parts[k:])) for k in range(1, len(parts))]
    return list(min(cuts, key=lambda cut: max(map(len, cut)))) if cuts else [word]


# Numbers and names


def _labelled(axis: Axis, about: int, px: float, apart: float) -> list[Fraction]:
    """Round numbers on the axis, and its lower end if that is `apart` px from the first of them."""
    values = ticks(axis.lo, axis.hi, about)
    first = float((values[0] - axis.lo) / (axis.hi - axis.lo)) * px if values else px
    return [axis.lo, *values] if first >= apart else values


def ticks(lo: Fraction, hi: Fraction, about: int) -> list[Fraction]:
    """The multiples of 1, 2 or 5 times a power of ten that lie between, about as many as that."""
    ten = Fraction(10)
    power = _floor_log10((hi - lo) / about)
    steps = [s * ten**k for k in (power, power + 1) for s in _STEPS]
    step = next(s for s in steps if (hi - lo) / s <= about)
    return [k * step for k in range(int(-(-lo // step)), int(hi // step) + 1)]


def _floor_log10(value: Fraction) -> int:
    k = len(str(value.numerator)) - len(str(value.denominator))
    return k if Fraction(10) ** k <= value else k - 1


def ceiling(value: Fraction) -> Fraction:
    """The least round number that is no less."""
    ten = Fraction(10) ** _floor_log10(value)
    return next(s * ten for s in _ROUND if s * ten >= value)


def plain(value: Fraction) -> str:
    """A short decimal; with a power of ten where it would be long."""
    mantissa, e, power = f"{float(value):.6g}".partition("e")
    if not e:
        return numbers(mantissa)
    raised = str(int(power)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return numbers(mantissa) + f" · 10{raised}"


def exact(value: Fraction) -> str:
    """The number; where that is long, about what it is."""
    return numbers(str(value)) if len(str(value)) <= LONG else f"≈ {numbers(f'{float(value):.4g}')}"


def spans(latex: str) -> str:
    """A symbol in LaTeX as text of an SVG, with subscripts lowered and exponents raised."""
    made, at = "", 0
    for text, down in _leaves(parse(latex), 0):
        size = ' class="sb"' if down else ' class="m"'
        move = f' dy="{down - at}"' if down != at else ""
        made += f"<tspan{size}{move}>{escape(text)}</tspan>"
        at = down
    # what follows stands on the line again: an empty span has no effect everywhere, one of no width has
    return made + (f'<tspan dy="{-at}">\N{ZERO WIDTH SPACE}</tspan>' if at else "")


def _leaves(parts: Sequence[Element], down: int) -> Iterator[tuple[str, int]]:
    for part in parts:
        if part.tag == "msub":
            yield from _leaves(part.parts[:1], down)
            yield from _leaves(part.parts[1:], 3)
        elif part.tag == "msup":
            yield from _leaves(part.parts[:1], down)
            yield from _leaves(part.parts[1:], -5)
        elif part.tag == "msubsup":
            yield from _leaves(part.parts[:1], down)
            yield from _leaves(part.parts[1:2], 3)
            yield from _leaves(part.parts[2:], -5)
        elif part.tag == "mover" and len(part.parts) == 2:
            base = "".join(text for text, _ in _leaves(part.parts[:1], down))
            yield base + _COMBINING.get(part.parts[1].text, ""), down
        elif part.parts:
            yield from _leaves(part.parts, down)
        elif part.text:
            yield part.text, down


_COMBINING = {
    "¯": "\u0304",
    "˙": "\u0307",
    "¨": "\u0308",
    "~": "\u0303",
    "^": "\u0302",
    "ˇ": "\u030c",
    "→": "\u20d7",
}


def _text(x: float, y: float, inside: str, style: str, anchor: str) -> str:
    side = "" if anchor == "start" else f' text-anchor="{anchor}"'
    return f'<text x="{x:.1f}" y="{y:.1f}" class="{style}"{side}>{inside}</text>'
