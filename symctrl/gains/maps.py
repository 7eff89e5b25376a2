"""The map of one or two gains: large boxes are decided first, and only what the boundary crosses is cut.

Cells are closed. Their edges are exact rationals; in floating point a box is rounded outward, so that it
contains its cells, and a cell that the boundary only touches is decided by fractions.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from symctrl.domains.boxes import Array, Box, Boxes, exact_array, rounded
from symctrl.domains.domain import Unsupported
from symctrl.expr import lift
from symctrl.files import InputError
from symctrl.gains.definite import FAILS, HOLDS, OPEN
from symctrl.gains.requirement import Cases, Requirement, known, state

LETTERS = {HOLDS: "f", FAILS: "i", OPEN: "u"}
LARGEST_BLOCK = 512  # cells on a side
AT_ONCE = 1 << 17  # boxes
MOST_OPEN = 1 << 22  # cells of the blocks that are cut together
EDGE = 2.0**-20  # of its width, by which a cell is shrunk to see whether rounding alone keeps it open
FEW = 32
BYTES_PER_CELL = 6  # in the array, in the rows of text, and in what is written of them

Span = tuple[Array, Array]  # the first cells of blocks, and those after the last


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
    if not re.fullmatch(r"\s*[0-9]{1,12}\s*", parts[2]) or int(parts[2]) < 2:
        raise InputError(f"--sweep {text}: COUNT is the number of cells, a whole number of at least 2")
    if lo >= hi:
        raise InputError(f"--sweep {text}: LO must be less than HI")
    return Axis(name.strip(), lo, hi, int(parts[2]))


def _number(text: str, part: str) -> Fraction:
    try:
        value: Fraction = lift(part.strip()).args[0]
    except ValueError:
        raise InputError(f"--sweep {text}: {part!r} is no exact number; write 0.4, 2/5 or 1e-3") from None
    return value


def refuse_too_large(axes: Sequence[Axis]) -> None:
    """Raises InputError, with the estimate, where the cells do not go into half of the free memory."""
    cells = int(np.prod([axis.count for axis in axes], dtype=object))
    free = free_memory()
    if cells * BYTES_PER_CELL > free // 2:
        raise InputError(
            f"--sweep: {cells:.2e} cells take about {cells * BYTES_PER_CELL / 1e9:.1f} GB, more than half of "
            f"the {free / 1e9:.1f} GB that are free; take fewer cells"
        )


def free_memory() -> int:
    """Bytes that may be had: what the system says is available, or else all that is not in use."""
    try:
        text = Path("/proc/meminfo").read_text(encoding="ascii")
        return 1024 * int(text.partition("MemAvailable:")[2].split()[0])
    except (OSError, IndexError, ValueError):
        return os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")


def swept(
    requirements: Sequence[Requirement], axes: Sequence[Axis], gains: Mapping[str, Fraction], cases: Cases
) -> Map:
    """Each closed cell as a whole: HOLDS where all requirements do at every point of it, FAILS where one does
    at none, else OPEN.
    """
    cases = {name: case for name, case in cases.items() if name not in {axis.name for axis in axes}}
    sweep = _Sweep(requirements, axes, gains, cases)
    if sweep.still == FAILS:
        return Map(tuple(axes), np.full(sweep.shape, FAILS, np.int8))
    for left, low in _groups(sweep.shape, sweep.side):
        sweep.cut(left, low)
    return Map(tuple(axes), sweep.states)


class _Sweep:
    """The cells of a map as they are decided: in blocks of cells, from `side` on a side down to one."""

    def __init__(
        self,
        requirements: Sequence[Requirement],
        axes: Sequence[Axis],
        gains: Mapping[str, Fraction],
        cases: Cases,
    ) -> None:
        self.requirements, self.axes, self.cases = requirements, axes, cases
        self.names = {axis.name for axis in axes}
        self.gains = {name: value for name, value in gains.items() if name not in self.names}
        self.still = self._still()
        self.shape = axes[1].count if len(axes) > 1 else 1, axes[0].count
        self.side = min(LARGEST_BLOCK, 1 << (max(self.shape) - 1).bit_length())
        self.states = np.zeros(self.shape, np.int8)
        self.exact = [exact_array([axis.edge(k) for k in range(axis.count + 1)]) for axis in axes]
        self.down = [np.array([rounded(x, -np.inf) for x in edges]) for edges in self.exact]
        self.up = [np.array([rounded(x, np.inf) for x in edges]) for edges in self.exact]

    def cut(self, left: Array, low: Array) -> None:
        """Decide blocks by the first cell of each, and cut those that are open into four."""
        side = self.side
        while left.size:
            right, high = np.minimum(left + side, self.shape[1]), np.minimum(low + side, self.shape[0])
            spans = [(left, right), (low, high)][: len(self.axes)]
            found = np.concatenate([self._decided(part) for part in _parts(spans)])
            if side == 1:
                self.states[low, left] = found
                self._settle_touching(left[found == OPEN], low[found == OPEN])
                return
            sure = found != OPEN
            self._fill(found[sure], left[sure], low[sure], side)
            side //= 2
            left, low = self._quarters(left[~sure], low[~sure], side)

    def _decided(self, spans: Sequence[Span], within: float = 0.0) -> Array:
        """The states of boxes in floating point; within: the part of its width by which a box is shrunk."""
        moving = [one for one in self.requirements if not self.names.isdisjoint(one.names)]
        found = together(moving, self._boxes(spans, within), self.cases, Boxes(), spans[0][0].size)
        return np.minimum(found, self.still)

    def _boxes(self, spans: Sequence[Span], within: float = 0.0) -> dict[str, Box]:
        boxes = self._fixed(Boxes())
        for k, (first, last) in enumerate(spans):
            low, high = self.down[k][first], self.up[k][last]
            less = (high - low) * within
            boxes[self.axes[k].name] = Box(low + less, high - less)
        return boxes

    def _fixed(self, domain: Boxes) -> dict[str, Box]:
        return {name: domain.between(value, value) for name, value in self.gains.items()}

    def _still(self) -> int:
        """The state of the requirements that read no gain that is swept: exactly, where that is to be had."""
        found = HOLDS
        for one in self.requirements:
            if self.names.isdisjoint(one.names):
                exact, floats = Boxes(exact=True), Boxes()
                try:
                    made = state(one, self._fixed(exact), self.cases, exact)
                except Unsupported:
                    made = known(one, self._fixed(floats), self.cases, floats)
                found = min(found, int(made[0]))
        return found

    def _settle_touching(self, left: Array, low: Array) -> None:
        """Decide by fractions the cells that rounding alone may have left open: those whose inside is
        decided.
        """
        for (first, bottom), *_ in _parts([(left, low)]) if left.size else ():
            spans = [(first, first + 1), (bottom, bottom + 1)][: len(self.axes)]
            near = self._decided(spans, within=EDGE) != OPEN
            if near.any():
                found = self._exactly([(a[near], b[near]) for a, b in spans])
                self.states[bottom[near], first[near]] = found

    def _exactly(self, spans: Sequence[Span]) -> Array:
        found = np.full(spans[0][0].size, HOLDS, np.int8)
        for one in self.requirements:
            found = np.minimum(found, self._one_exactly(one, spans))
        return found

    def _one_exactly(self, one: Requirement, spans: Sequence[Span]) -> Array:
        """One requirement by fractions; rounded outward in boxes where that is not to be had."""
        domain, count = Boxes(exact=True), spans[0][0].size
        boxes = self._fixed(domain)
        for k, (first, last) in enumerate(spans):
            boxes[self.axes[k].name] = Box(self.exact[k][first], self.exact[k][last])
        try:
            return np.broadcast_to(state(one, boxes, self.cases, domain), count).astype(np.int8)
        except Unsupported:  # in one box, perhaps
            if count <= FEW:
                return together([one], self._boxes(spans), self.cases, Boxes(), count)
        halves = slice(None, count // 2), slice(count // 2, None)
        return np.concatenate([self._one_exactly(one, [(a[h], b[h]) for a, b in spans]) for h in halves])

    def _fill(self, found: Array, left: Array, low: Array, side: int) -> None:
        if side >= FEW:
            for state_, x, y in zip(found, left, low, strict=True):
                self.states[y : y + side, x : x + side] = state_
            return
        for dy in range(min(side, self.shape[0])):
            for dx in range(side):
                x, y = left + dx, low + dy
                inside = (x < self.shape[1]) & (y < self.shape[0])
                self.states[y[inside], x[inside]] = found[inside]

    def _quarters(self, left: Array, low: Array, side: int) -> tuple[Array, Array]:
        left = np.concatenate([left, left + side, left, left + side])
        low = np.concatenate([low, low, low + side, low + side])
        inside = (left < self.shape[1]) & (low < self.shape[0])
        return left[inside], low[inside]


def _groups(shape: tuple[int, int], side: int) -> Iterator[tuple[Array, Array]]:
    """The first cells of the blocks, a few blocks at a time."""
    grid = np.meshgrid(np.arange(0, shape[1], side), np.arange(0, shape[0], side))
    left, low = grid[0].ravel(), grid[1].ravel()
    step = max(1, MOST_OPEN // (side * min(side, shape[0])))
    for start in range(0, left.size, step):
        yield left[start : start + step], low[start : start + step]


def _parts(spans: Sequence[Span]) -> Iterator[list[Span]]:
    for start in range(0, spans[0][0].size, AT_ONCE):
        part = slice(start, start + AT_ONCE)
        yield [(first[part], last[part]) for first, last in spans]


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
        found = np.minimum(found, known(one, boxes, cases, domain).astype(np.int8))
    return found
