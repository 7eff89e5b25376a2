"""The map of one or two gains: large boxes are decided first, and only what the boundary crosses is cut.

Edges are exact rationals; in floating point a box is rounded outward, so that it contains its cells.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from symctrl.domains.boxes import Array, Box, Boxes, rounded
from symctrl.files import InputError
from symctrl.gains.definite import FAILS, HOLDS, OPEN
from symctrl.gains.requirement import Cases, Requirement, state

LETTERS = {HOLDS: "f", FAILS: "i", OPEN: "u"}
LARGEST_BLOCK = 512  # cells on a side
AT_ONCE = 1 << 17  # boxes
BYTES_PER_CELL = 6  # in the array, in the rows of text, and in what is written of them


@dataclass(frozen=True)
class Axis:
    """COUNT cells of equal width between lo and hi."""

    name: str
    lo: Fraction
    hi: Fraction
    count: int

    def edge(self, k: int) -> Fraction:
        return self.lo + (self.hi - self.lo) * Fraction(k, self.count)

    def as_json(self) -> dict[str, Any]:
        return {"name": self.name, "lo": str(self.lo), "hi": str(self.hi), "count": self.count}


@dataclass(frozen=True)
class Map:
    """The cells' states, a row for each cell of the second axis."""

    axes: tuple[Axis, ...]
    states: Array

    @property
    def cells(self) -> list[str]:
        """One string a row: f feasible, i infeasible, u undecided."""
        table = np.zeros(3, np.uint8)
        for found, letter in LETTERS.items():
            table[found + 1] = ord(letter)
        return [row.tobytes().decode() for row in table[self.states + 1]]


def parsed(text: str) -> Axis:
    """The axis of NAME=LO:HI:COUNT. Raises InputError."""
    name, equals, rest = text.partition("=")
    parts = rest.split(":")
    if not equals or not name.strip() or len(parts) != 3:
        raise InputError(f"--sweep {text}: must be like NAME=LO:HI:COUNT, as in K_o=1/2:3:100")
    lo, hi = (_number(text, part) for part in parts[:2])
    if not parts[2].strip().isdecimal() or int(parts[2]) < 2:
        raise InputError(f"--sweep {text}: COUNT is the number of cells, a whole number of at least 2")
    if lo >= hi:
        raise InputError(f"--sweep {text}: LO must be less than HI")
    return Axis(name.strip(), lo, hi, int(parts[2]))


def _number(text: str, part: str) -> Fraction:
    try:
        return Fraction(part.strip())
    except (ValueError, ZeroDivisionError):
        raise InputError(f"--sweep {text}: {part!r} is no exact number; write 0.4, 2/5 or 1e-3") from None


def refuse_too_large(axes: Sequence[Axis]) -> None:
    """Raises InputError, with the estimate, where the cells do not go into half of the free memory."""
    cells = int(np.prod([axis.count for axis in axes], dtype=object))
    free = os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    if cells * BYTES_PER_CELL > free // 2:
        raise InputError(
            f"--sweep: {cells:.2e} cells take about {cells * BYTES_PER_CELL / 1e9:.1f} GB, more than half of "
            f"the {free / 1e9:.1f} GB that are free; take fewer cells"
        )


def swept(
    requirements: Sequence[Requirement], axes: Sequence[Axis], gains: Mapping[str, Fraction], cases: Cases
) -> Map:
    """Each cell as a whole: HOLDS where all requirements do, FAILS where one does, else OPEN.

    Raises Unsupported for an operation that boxes do not know.
    """
    domain = Boxes()
    fixed = {name: domain.between(value, value) for name, value in gains.items()}
    columns, rows = axes[0].count, axes[1].count if len(axes) > 1 else 1
    states = np.zeros((rows, columns), np.int8)
    edges = [_edges(axis) for axis in axes]
    side = min(LARGEST_BLOCK, 1 << (max(rows, columns) - 1).bit_length())
    grid = np.meshgrid(np.arange(0, columns, side), np.arange(0, rows, side))
    left, low = grid[0].ravel(), grid[1].ravel()
    while left.size:
        right, high = np.minimum(left + side, columns), np.minimum(low + side, rows)
        spans = [(left, right), (low, high)][: len(axes)]
        found = np.concatenate(list(_in_parts(requirements, axes, edges, spans, fixed, cases, domain)))
        _fill(states, found, left, right, low, high)
        if side == 1:
            break
        side //= 2
        left, low = _quarters(left[found == OPEN], low[found == OPEN], side, columns, rows)
    return Map(tuple(axes), states)


def _edges(axis: Axis) -> tuple[Array, Array]:
    """The edges rounded down and up."""
    exact = [axis.edge(k) for k in range(axis.count + 1)]
    return np.array([rounded(x, -np.inf) for x in exact]), np.array([rounded(x, np.inf) for x in exact])


def _in_parts(
    requirements: Sequence[Requirement],
    axes: Sequence[Axis],
    edges: Sequence[tuple[Array, Array]],
    spans: Sequence[tuple[Array, Array]],
    fixed: Mapping[str, Box],
    cases: Cases,
    domain: Boxes,
) -> Iterator[Array]:
    for start in range(0, spans[0][0].size, AT_ONCE):
        part = slice(start, start + AT_ONCE)
        boxes = dict(fixed)
        for axis, (down, up), (first, last) in zip(axes, edges, spans, strict=True):
            boxes[axis.name] = Box(down[first[part]], up[last[part]])
        yield together(requirements, boxes, cases, domain, spans[0][0][part].size)


def together(
    requirements: Sequence[Requirement],
    boxes: Mapping[str, Box],
    cases: Cases,
    domain: Boxes,
    count: int,
) -> Array:
    """The state of all requirements together in each of `count` boxes."""
    found = np.full(count, HOLDS, np.int8)
    for one in requirements:
        found = np.minimum(found, state(one, boxes, cases, domain).astype(np.int8))
    return found


def _fill(states: Array, found: Array, left: Array, right: Array, low: Array, high: Array) -> None:
    if (right - left == 1).all() and (high - low == 1).all():
        states[low, left] = found
        return
    for k in np.flatnonzero(found != OPEN):
        states[low[k] : high[k], left[k] : right[k]] = found[k]


def _quarters(left: Array, low: Array, side: int, columns: int, rows: int) -> tuple[Array, Array]:
    left = np.concatenate([left, left + side, left, left + side])
    low = np.concatenate([low, low, low + side, low + side])
    inside = (left < columns) & (low < rows)
    return left[inside], low[inside]
