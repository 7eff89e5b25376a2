"""A tube around a solution of a statement's motion: every step re-verified from boxes that somebody found.

Soundness-critical. Last reviewed 2026-11-24.

Theorem (Moore, Interval Analysis, 1966): let f be analytic on the boxes X and B, and let X + [0, h] f(B) be
inside B, h > 0. Then each solution of x' = f(x) that is in X at t exists on [t, t + h], is the only one from
its value at t, and stays in B there (Picard-Lindeloef); and with its Taylor coefficients x_k as functions of
the value at t, x(t + h) is in T(x(t)) + h^N x_N(B), T = x_0 + .. + h^(N-1) x_(N-1) (Taylor, remainder of
Lagrange). That f is analytic there is what the coefficients show by having a value (`series`).

Theorem (mean value): for a middle m in X and x(t) = m + A r in X, T(x(t)) is in T(m) + T'(X) A r. So after a
step the solution is in the set y + M r with y = T(m) + h^N x_N(B), M = T'(X) A; it is in m' + A' r' where
r' holds A'^-1 (y - m') + (A'^-1 M) r (Lohner, in: Computational ordinary differential equations, 1992).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any

from symctrl.kernel.certificate import Declined, Invalid, fields, natural, per_node, rational, several, typed
from symctrl.kernel.evaluation import Evaluation, NoSums
from symctrl.kernel.interval import Interval
from symctrl.kernel.series import ZERO, Along, Choosing, Pair, Series, SeriesDomain
from symctrl.kernel.values import Statement

MAX_STEPS, MAX_ORDER, MAX_BITS = 100_000, 200, 4096
_ROW = ("t", "h", "box", "over", "middle", "matrix", "spread")
Box = Mapping[str, Interval]


@dataclass(frozen=True, slots=True)
class Frame:
    """All middle + matrix r with r in spread; matrix by rows."""

    middle: Sequence[Fraction]
    matrix: Sequence[Sequence[Fraction]]
    spread: Sequence[Interval]


@dataclass(frozen=True, slots=True)
class Segment:
    """Where the solution is at t0, at t1, and for all times between, by state."""

    t0: Fraction
    t1: Fraction
    start: Box
    end: Box
    over: Box


def verify_tube(
    statement: Statement, law: str | None, values: Mapping[str, Fraction], tube: Any
) -> list[Segment]:
    """The segments of a tube from t = 0 around the solution under the law.

    values: states at t = 0; parameters, and signals without a motion, for all times. tube: parsed JSON.
    Raises Invalid where an inclusion fails, and Declined for what has no rule or cannot be decided.
    """
    given = fields(tube, ("states", "order", "bits", "steps", "end"), "the tube")
    order = natural(given["order"], MAX_ORDER + 1, "the order of the tube")
    bits = natural(given["bits"], MAX_BITS + 1, "the bits of the tube")
    states = [typed(name, str, "a state of the tube") for name in typed(given["states"], list, "states")]
    steps = typed(given["steps"], list, "the steps of the tube")
    if sorted(states) != sorted(statement.motion):
        raise Invalid("the states of the tube are not the names that have a motion")
    if order == 0 or not steps:
        raise Invalid("a tube has an order of at least 1 and at least one step")
    if len(steps) > MAX_STEPS:
        raise Declined(f"a tube of more than {MAX_STEPS} steps")
    flow = Flow(statement, law, values, states, bits)
    rows = [fields(row, _ROW, f"step {k}") for k, row in enumerate(steps, 1)]
    boxes = [_read_box(row["box"], states, f"the box of step {k}") for k, row in enumerate(rows, 1)]
    boxes.append(_read_box(given["end"], states, "the last box"))
    segments: list[Segment] = []
    for k, row in enumerate(rows):
        where = f"step {k + 1}"
        t, h = rational(row["t"], where), rational(row["h"], where)
        if h <= 0 or t != (segments[-1].t1 if segments else 0):
            raise Invalid(f"{where} does not begin where the one before ends, or its length is not positive")
        over = _read_box(row["over"], states, f"the box over {where}")
        flow.require_inside(boxes[k], f"the box at the beginning of {where}")
        flow.enter(_read_frame(row, len(states), where), boxes[k], where)
        flow.step(boxes[k], over, h, order, where)
        segments.append(Segment(t, t + h, boxes[k], boxes[k + 1], over))
    flow.require_inside(boxes[-1], "the last box")
    return segments


def _read_frame(row: Mapping[str, Any], n: int, where: str) -> Frame:
    middle, *matrix = (
        [rational(x, where) for x in several(line, n, where)]
        for line in (row["middle"], *several(row["matrix"], n, where))
    )
    spread = _read_box(row["spread"], [str(k) for k in range(n)], f"the spread of {where}")
    return Frame(middle, matrix, list(spread.values()))


def _read_box(value: Any, states: Sequence[str], where: str) -> Box:
    ends = [several(pair, 2, where) for pair in several(value, len(states), where)]
    box = {n: Interval(*(rational(x, where) for x in e)) for n, e in zip(states, ends, strict=True)}
    if any(x.lo > x.hi for x in box.values()):
        raise Invalid(f"{where}: a lower end is above its upper end")
    return box


class Flow:
    """The set y + turn r, r in spread, in which a solution of the motion is, carried on from step to step."""

    def __init__(
        self,
        statement: Statement,
        law: str | None,
        values: Mapping[str, Fraction],
        states: Sequence[str],
        bits: int,
    ) -> None:
        if law is not None and law not in statement.laws:
            raise Invalid(f"the law {law[:60]!r} is not given")
        if any(map(per_node, states)):
            raise Declined("a tube is for one vehicle, and this motion is that of each node of a fleet")
        self.domain = SeriesDomain(bits)
        self.states = states
        self.box: Sequence[Pair] = ()
        self.h = Fraction(0)
        moving = {name: self.domain.made(name, (), partial(self._next, n)) for n, name in enumerate(states)}

        def free(name: str) -> Series:
            if name in moving:
                return moving[name]
            if statement.scalars[name] in ("state", "input"):
                raise Invalid(f"the {statement.scalars[name]} {name} has no motion or law")
            return self.domain.constant(_value(values, name))

        def rates(domain: SeriesDomain | Along, read: Callable[[str], Any]) -> list[Any]:
            walk = Evaluation(statement, domain, read, NoSums())
            walk.chain = Choosing(domain)
            return [walk.output(statement.motion[name], {}, 0, law) for name in states]

        self.rates: list[Series] = rates(self.domain, free)
        self.plain = len(self.domain.moving)
        self.slopes = [self._slopes_by(j, free, rates) for j in range(len(states))]
        self.y = [self.domain.number(_value(values, name)) for name in states]
        self.middle = self.y
        self.turn = [[self.domain.number(i == j) for j in range(len(states))] for i in range(len(states))]
        self.spread: list[Pair] = [ZERO for _ in states]

    def _slopes_by(
        self, j: int, free: Callable[[str], Series], rates: Callable[[Along, Callable[[str], Any]], list[Any]]
    ) -> list[Series]:
        """The series of all states' derivatives by the initial value of state j."""
        found: list[Any] = []

        def rule(n: int, k: int) -> Pair:
            return self._integrated(found[n][1], k) if k else self.domain.number(n == j)

        made = self.domain.made
        slopes = [made(f"{name} by {j}", (), partial(rule, n)) for n, name in enumerate(self.states)]
        moving = dict(zip(self.states, slopes, strict=True))
        found += rates(Along(self.domain), lambda name: (free(name), moving.get(name)))
        return slopes

    def _next(self, n: int, k: int) -> Pair:
        return self._integrated(self.rates[n], k) if k else self.box[n]

    def _integrated(self, rate: Series | None, k: int) -> Pair:
        """h/k times the rate's coefficient k - 1."""
        low, high = ZERO if rate is None else rate.at(k - 1)
        p, q = self.h.numerator, self.h.denominator * k
        return low * p // q, -(-high * p // q)

    def _taylor(self, box: Sequence[Pair], order: int, count: int, of: Sequence[Series]) -> list[list[Pair]]:
        """Coefficients 0 .. order, with their powers of h, of some of the first `count` series on the box."""
        self.box = box
        self.domain.grow(count, order)
        return [series.terms[:] for series in of]

    def step(self, start: Box, over: Box, h: Fraction, order: int, where: str) -> None:
        """The set after h. Raises Invalid where the solution may leave the box `over`."""
        n, self.h = len(self.states), h
        states, everything = self.domain.moving[:n], len(self.domain.moving)
        begin = [self.domain.pair(start[name]) for name in self.states]
        rest = self._taylor([self.domain.pair(over[name]) for name in self.states], order, self.plain, states)
        for name, (low, high), terms in zip(self.states, begin, rest, strict=True):
            reached = low + min(0, terms[1][0]), high + max(0, terms[1][1])
            self._require_within(reached, over[name], f"the box over {where}", name)
        middle = self._taylor(self.middle, order - 1, self.plain, states)
        self.y = [_total([*terms, last[order]]) for terms, last in zip(middle, rest, strict=True)]
        flat = [series for by in self.slopes for series in by]
        sums = [_total(terms) for terms in self._taylor(begin, order - 1, everything, flat)]
        slopes = [[sums[j * n + i] for j in range(n)] for i in range(n)]
        self.turn = self._product(slopes, self.turn)

    def enter(self, frame: Frame, box: Box, where: str) -> None:
        """Take the frame in the place of the set. Raises Invalid where it may miss some of it."""
        number = self.domain.number
        back = [[number(x) for x in row] for row in _inverse(frame.matrix, where)]
        middle = [number(x) for x in frame.middle]
        if any(not box[s].lo <= m <= box[s].hi for s, m in zip(self.states, frame.middle, strict=True)):
            raise Invalid(f"{where}: the middle of its frame is not in its box")
        away = [[(y[0] - m[1], y[1] - m[0])] for y, m in zip(self.y, middle, strict=True)]
        spread = self._product(self._product(back, self.turn), [[r] for r in self.spread])
        for shift, turned, r in zip(self._product(back, away), spread, frame.spread, strict=True):
            self._require_within(_total([shift[0], turned[0]]), r, f"the frame of {where}", "a direction")
        self.middle = middle
        self.turn = [[number(x) for x in row] for row in frame.matrix]
        self.spread = [self.domain.pair(r) for r in frame.spread]

    def require_inside(self, box: Box, what: str) -> None:
        """Raises Invalid where the solution may be outside the box."""
        moved = self._product(self.turn, [[r] for r in self.spread])
        for name, y, turned in zip(self.states, self.y, moved, strict=True):
            self._require_within(_total([y, turned[0]]), box[name], what, name)

    def _product(self, a: Sequence[Sequence[Pair]], b: Sequence[Sequence[Pair]]) -> list[list[Pair]]:
        columns = list(zip(*b, strict=True))
        return [[self.domain.dot(list(zip(row, c, strict=True))) for c in columns] for row in a]

    def _require_within(self, inner: Pair, outer: Interval, what: str, name: str) -> None:
        if not (outer.lo * self.domain.one <= inner[0] and inner[1] <= outer.hi * self.domain.one):
            raise Invalid(f"{what} may miss the solution in {name}")


def _total(terms: Sequence[Pair]) -> Pair:
    return sum(low for low, _ in terms), sum(high for _, high in terms)


def _inverse(matrix: Sequence[Sequence[Fraction]], where: str) -> list[list[Fraction]]:
    """The exact inverse, by elimination. Raises Invalid for a singular matrix."""
    n = len(matrix)
    rows = [[*row, *(Fraction(i == j) for j in range(n))] for i, row in enumerate(matrix)]
    for k in range(n):
        pivot = next((i for i in range(k, n) if rows[i][k]), None)
        if pivot is None:
            raise Invalid(f"{where}: the matrix of its frame is singular")
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i in range(n):
            if i != k and rows[i][k]:
                rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k], strict=True)]
    return [row[n:] for row in rows]


def _value(values: Mapping[str, Fraction], name: str) -> Fraction:
    if name not in values:
        raise Invalid(f"no value is given for {name}")
    return values[name]
