"""A tube: boxes around one solution of a motion, step by step, as exact numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

End = tuple[Fraction, Fraction]  # lower and upper bound
Box = tuple[End, ...]  # one for each state


@dataclass(frozen=True)
class Frame:
    """The parallelepiped of all middle + matrix r with r in spread; matrix by rows, invertible."""

    middle: tuple[Fraction, ...]
    matrix: tuple[tuple[Fraction, ...], ...]
    spread: Box


@dataclass(frozen=True)
class TubeStep:
    """From t to t + h: the box at t, one that holds the solution on the whole of [t, t + h], and the frame
    that holds it at t, in which the box is carried on.
    """

    t: Fraction
    h: Fraction
    box: Box
    over: Box
    frame: Frame

    def as_json(self) -> dict[str, Any]:
        return {
            "t": str(self.t),
            "h": str(self.h),
            "box": _written(self.box),
            "over": _written(self.over),
            "middle": [str(x) for x in self.frame.middle],
            "matrix": _written(self.frame.matrix),
            "spread": _written(self.frame.spread),
        }


@dataclass(frozen=True)
class Tube:
    """Enclosures of one solution. order and bits: what a second arithmetic needs to find the same."""

    states: tuple[str, ...]
    order: int
    bits: int
    steps: tuple[TubeStep, ...]
    end: Box

    @property
    def until(self) -> Fraction:
        return self.steps[-1].t + self.steps[-1].h

    @property
    def times(self) -> tuple[Fraction, ...]:
        """The times of the grid, the last one included."""
        return (*(step.t for step in self.steps), self.until)

    def at(self, t: Fraction) -> dict[str, End]:
        """The bounds of each state at a time of the grid. Raises KeyError for another time."""
        boxes = dict(zip(self.times, (*(step.box for step in self.steps), self.end), strict=True))
        return dict(zip(self.states, boxes[t], strict=True))

    def over(self, t: Fraction) -> dict[str, End]:
        """Bounds of each state on the whole step that contains t. Raises KeyError outside the tube."""
        for step in self.steps:
            if step.t <= t <= step.t + step.h:
                return dict(zip(self.states, step.over, strict=True))
        raise KeyError(t)

    def as_json(self) -> dict[str, Any]:
        """Integers, names and numbers "p/q"; what the kernel reads."""
        return {
            "states": list(self.states),
            "order": self.order,
            "bits": self.bits,
            "steps": [step.as_json() for step in self.steps],
            "end": _written(self.end),
        }


def _written(rows: Sequence[Sequence[Fraction]]) -> list[list[str]]:
    return [[str(x) for x in row] for row in rows]
