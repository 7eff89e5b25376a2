"""Rigorously enclosed solutions of a problem's motion from an exact initial value, by a validated Taylor
method.

One step from the box X at t over h (Moore, Interval Analysis, 1966; Nedialkov, Jackson and Corliss,
Validated solutions of initial value problems, Appl. Math. Comput. 105 (1999) 21):

* a box B with X + [0, h] f(B) inside B: every solution that is in X at t exists on [t, t + h] and stays in B
  (Picard-Lindeloef);
* with the Taylor coefficients x_k of order k and T = x_0 + .. + h^(N-1) x_(N-1), the solution at t + h is in
  T(x) + h^N x_N(B) for the x at t (Lagrange), and T(x) in T(m) + T'(X) A r for x = m + A r (mean value);
* the set of all y + M r is put into a new frame m' + A' r', A' nearly orthogonal after scaling, so that a
  turning box does not grow (Lohner, in: Computational ordinary differential equations, Oxford, 1992).

Numbers are dyadic, and sets a little larger than needed, so that another arithmetic finds the inclusions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import ceil, floor
from typing import Any

import flint
import numpy as np
from flint import arb

from symctrl.domains.interval import Ball, ball, bounds
from symctrl.domains.series import Undecided
from symctrl.problem import Problem
from symctrl.taylor import Taylor
from symctrl.tubes import Box, End, Frame, Tube, TubeStep

GUARD = 40  # bits of the working precision beyond those of the boxes
SHORTEST = 30  # steps below 2^-SHORTEST of the whole time are given up
SLACK = Fraction(1, 8)  # of what a step adds to a box
ATTEMPTS = 12  # to find a box
MAX_STEPS = 20_000
LARGE, TINY = arb(2) ** 4096, Fraction(1, 2**4096)
SHORT = 24  # bits of the entries of a frame
FLAT = 60  # bits by which one state's scale may be below another's in a frame


class NotEnclosed(ValueError):  # noqa: N818
    """No enclosure beyond the time `until`: the solution grows without bound there, meets a switch, or the
    boxes have become too wide.
    """

    def __init__(self, until: Fraction, why: str) -> None:
        super().__init__(f"the solution is enclosed until t = {float(until):.6g} only: {why}")
        self.until = until


def enclose(
    problem: Problem,
    law: str | None,
    values: Mapping[str, Fraction],
    until: Fraction,
    order: int = 16,
    tolerance: Fraction = Fraction(1, 2**60),
) -> Tube:
    """A tube around the solution of the problem's motion under the law, from t = 0 to `until`.

    values: of all free scalars: states at t = 0; parameters, and signals without a motion, for all times.
    tolerance: what one step may add to a state's box, relative to the largest value of the state so far.
    Raises NotEnclosed where steps become too small, Unsupported for an operation without a series, and
    ValueError for a problem of a fleet or a value that is missing.
    """
    if until <= 0 or order < 2 or tolerance <= 0:
        raise ValueError("the time, the order less 1 and the tolerance must be positive")
    missing = [name for name in problem.motion if name not in values]
    if missing:
        raise ValueError(f"no initial value was given for {', '.join(missing)}")
    precision = max(1, _exponent(1 / tolerance)) + GUARD
    taylor = Taylor(problem, law, values, 2 * precision)
    with taylor.base.working():
        return _Stepper(taylor, until, order, tolerance, precision).run(values)


class _Stepper:
    """Step by step from 0 to `until`, each as long as the tolerance lets it be."""

    def __init__(
        self, taylor: Taylor, until: Fraction, order: int, tolerance: Fraction, precision: int
    ) -> None:
        self.taylor, self.until, self.order = taylor, until, order
        self.tolerance, self.precision = tolerance, precision
        self.scales = [-precision] * len(taylor.states)  # exponents of the largest values so far

    def run(self, values: Mapping[str, Fraction]) -> Tube:
        start = tuple((values[name], values[name]) for name in self.taylor.states)
        nothing = tuple((Fraction(0), Fraction(0)) for _ in start)
        self._measure(start)
        frame, box = self._framed([ball(*x) for x in start], _identity(len(start)), nothing, nothing)
        t, h, steps = Fraction(0), self.until, []
        while t < self.until:
            step, frame, box, h = self._step(t, box, frame, min(h, self.until - t))
            steps.append(step)
            t += step.h
            if len(steps) > MAX_STEPS:
                raise NotEnclosed(t, f"that took {MAX_STEPS} steps")
        return Tube(self.taylor.states, self.order, _finest(steps) + GUARD, tuple(steps), box)

    def _measure(self, box: Box) -> None:
        self.scales = [max(e, _exponent(_size(end))) for e, end in zip(self.scales, box, strict=True)]

    def _step(
        self, t: Fraction, box: Box, frame: Frame, h: Fraction
    ) -> tuple[TubeStep, Frame, Box, Fraction]:
        """The step from t, the frame and the box after it, and a length for the next one."""
        shortest = min(h, self.until / 2**SHORTEST)
        while h >= shortest:
            factor, why = Fraction(1, 2), "no box holds it for even a short time"
            try:
                over = self._over(box, h)
                rest = None if over is None else self._order(over, h, self.order)
                if over is not None and rest is not None:
                    factor = self._factor(rest, over)
                    if factor >= 1:
                        self._measure(over)
                        next_frame, end = self._after(box, frame, h, rest)
                        return TubeStep(t, h, box, over, frame), next_frame, end, _short(h * factor)
            except Undecided as undecided:
                why = str(undecided)
            h = _short(h * factor)
        raise NotEnclosed(t, why)

    def _order(self, box: Box, h: Fraction, k: int) -> Box | None:
        """Bounds of h^k x_k on the box; None where there are none."""
        return _bounded([terms[k] for terms in self.taylor.coefficients(box, h, k)])

    def _over(self, box: Box, h: Fraction) -> Box | None:
        """A box that box + [0, h] f does not leave, or None."""
        tried = box
        for _ in range(ATTEMPTS):
            image = self._image(box, tried, h)
            if image is None:
                return None
            if _inside(image, tried):
                closer = self._wider(image, SLACK / 256)
                again = self._image(box, closer, h)
                return closer if again is not None and _inside(again, closer) else tried
            tried = self._wider(image, 2 * SLACK)
        return None

    def _image(self, box: Box, over: Box, h: Fraction) -> Box | None:
        """box + [0, h] f(over), and a little more."""
        change = self._order(over, h, 1)
        if change is None:
            return None
        none = Fraction(0)
        reached = ((x[0] + min(none, d[0]), x[1] + max(none, d[1])) for x, d in zip(box, change, strict=True))
        return self._wider(tuple(reached), SLACK / 1024)

    def _wider(self, box: Box, share: Fraction) -> Box:
        """Each end moved by at least the share of the width, to a short number. What is zero stays zero."""
        return tuple(_rounded(x, share * (x[1] - x[0]) or self._unit(n)) for n, x in enumerate(box))

    def _unit(self, n: int) -> Fraction:
        """The last place that the boxes of a state show."""
        return Fraction(2) ** (self.scales[n] - self.precision)

    def _after(self, box: Box, frame: Frame, h: Fraction, rest: Box) -> tuple[Frame, Box]:
        """The solution after a step is in y + D A r: y the Taylor polynomial of the middle, and the
        remainder; D the polynomial's derivative on the box.
        """
        middle = tuple((x, x) for x in frame.middle)
        y = [
            sum(reversed(terms)) + ball(*r)
            for terms, r in zip(self.taylor.coefficients(middle, h, self.order - 1), rest, strict=True)
        ]
        slopes = flint.arb_mat(self.taylor.slopes(box, h, self.order - 1))
        return self._framed(y, slopes * _matrix(frame.matrix), frame.spread, rest)

    def _framed(self, y: list[Ball], turn: Any, spread: Box, added: Box) -> tuple[Frame, Box]:
        """A frame and a box around y + turn r with r in `spread`, and a little more.

        added: what of y is new; part of it is the margin.
        """
        units = [self._unit(n) for n in range(len(y))]
        middle = tuple(round(_middle(x) / unit) * unit for x, unit in zip(y, units, strict=True))
        moved = _column(y) + turn * _column([ball(*r) for r in spread])
        margins = [SLACK * (r[1] - r[0]) + unit for r, unit in zip(added, units, strict=True)]
        around = map(_hull, _certain(moved), ((m, m) for m in middle))
        box = tuple(_rounded(x, more) for x, more in zip(around, margins, strict=True))

        matrix = self._orthogonal(turn, spread)
        back = _matrix(matrix).inv()
        inner = back * _column([x - _exact(m) for x, m in zip(y, middle, strict=True)])
        inner += (back * turn) * _column([ball(*r) for r in spread])
        reach = _certain(back * _column([ball(-more, more) for more in margins]))
        inside = (_rounded(x, more[1]) for x, more in zip(_certain(inner), reach, strict=True))
        return Frame(middle, matrix, tuple(inside)), box

    def _orthogonal(self, turn: Any, spread: Box) -> tuple[tuple[Fraction, ...], ...]:
        """Directions nearly orthogonal after scaling, the first along the longest edge of the parallelepiped
        that is to be enclosed (Lohner): each has SHORT bits.
        """
        n, top = len(spread), max(self.scales)
        scales = [max(e, top - FLAT) for e in self.scales]
        rows = [[_middle(turn[i, j]) / Fraction(2) ** e for j in range(n)] for i, e in enumerate(scales)]
        edges = np.array(rows, dtype=float)
        widths = np.array([float(r[1] - r[0]) for r in spread])
        order = np.argsort(-np.linalg.norm(edges, axis=0) * widths, kind="stable")
        directions = np.linalg.qr(edges[:, order])[0]
        return tuple(
            tuple(Fraction(round(float(x) * 2**SHORT), 2**SHORT) * Fraction(2) ** e for x in row)
            for row, e in zip(directions, scales, strict=True)
        )

    def _factor(self, rest: Box, over: Box) -> Fraction:
        """By how much the step can be longer (or must be shorter, below 1) for the tolerance, roughly."""
        spare = [
            max(e, _exponent(_size(b))) + _exponent(self.tolerance) - _exponent(r[1] - r[0])
            for e, b, r in zip(self.scales, over, rest, strict=True)
            if r[1] > r[0]
        ]
        ratio = 2.0 ** (min(spare, default=self.order) / self.order)
        if ratio < 1:
            return Fraction(max(0.9 * ratio, 1 / 16))
        return Fraction(min(max(0.9 * ratio, 1.0), 1.5))


def _bounded(balls: Sequence[Ball]) -> Box | None:
    """Bounds of each; None where one has none, or only such as are out of all proportion."""
    if not all(x.abs_upper() < LARGE for x in balls):
        return None
    ends = [(-TINY, TINY) if not x.is_zero() and x.abs_upper() * LARGE < 1 else bounds(x) for x in balls]
    return tuple(end for end in ends if end is not None)


def _certain(column: Any) -> Box:
    """Bounds of a column of numbers that are finite because those over the whole step are."""
    ends = _bounded(column.entries())
    assert ends is not None
    return ends


def _middle(x: Ball) -> Fraction:
    low, high = _certain(_column([x]))[0]
    return (low + high) / 2


def _exact(x: Fraction) -> Ball:
    return ball(x, x)


def _column(entries: Sequence[Ball]) -> Any:
    return flint.arb_mat([[x] for x in entries])


def _matrix(rows: Sequence[Sequence[Fraction]]) -> Any:
    return flint.arb_mat([[_exact(x) for x in row] for row in rows])


def _identity(n: int) -> Any:
    return _matrix([[Fraction(int(i == j)) for j in range(n)] for i in range(n)])


def _finest(steps: Sequence[TubeStep]) -> int:
    """The largest number of bits of a denominator in the tube."""
    rows = [row for s in steps for row in (*s.box, *s.over, s.frame.middle, *s.frame.matrix, *s.frame.spread)]
    return max(x.denominator.bit_length() for row in rows for x in row)


def _inside(inner: Box, outer: Box) -> bool:
    return all(o[0] <= i[0] and i[1] <= o[1] for i, o in zip(inner, outer, strict=True))


def _hull(a: End, b: End) -> End:
    return min(a[0], b[0]), max(a[1], b[1])


def _size(end: End) -> Fraction:
    return max(abs(end[0]), abs(end[1]))


def _exponent(x: Fraction) -> int:
    """2^e is x > 0 within a factor 2; a low number for 0."""
    return x.numerator.bit_length() - x.denominator.bit_length() if x else -(10**6)


def _rounded(end: End, more: Fraction) -> End:
    """Each end moved outward by at least `more` to a multiple of a power of two below it."""
    if not _size(end):
        return end
    unit = Fraction(2) ** (_exponent(more) - 1)
    return floor((end[0] - more) / unit) * unit, ceil((end[1] + more) / unit) * unit


def _short(h: Fraction) -> Fraction:
    """A number of eight bits at most as large."""
    unit = Fraction(2) ** (_exponent(h) - 8)
    return floor(h / unit) * unit
