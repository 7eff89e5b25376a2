"""Enclosed Taylor coefficients of the solutions of a problem's motion, and their derivatives by the initial
values.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

from flint import arb

from symctrl.domains.interval import Ball, IntervalDomain, ball
from symctrl.domains.series import Series, SeriesDomain
from symctrl.domains.tangent import Pair, Tangent
from symctrl.evaluate import Environment
from symctrl.problem import Problem
from symctrl.tubes import Box


class Taylor:
    """Taylor coefficients of the solutions of one problem: its motion as a programme of series."""

    def __init__(self, problem: Problem, law: str | None, values: Mapping[str, Fraction], bits: int) -> None:
        self.base = IntervalDomain(bits)
        self.domain = SeriesDomain(self.base)
        self.states = tuple(problem.motion)
        self.box: Sequence[Ball] = ()
        self.h: Ball = None
        variables = {x: self.domain.made(partial(self._next, n)) for n, x in enumerate(self.states)}

        def free(name: str) -> Series[Ball]:
            known = variables.get(name)
            return self.domain.constant(_value(problem, name, values)) if known is None else known

        with self.base.working():
            self.rates = self._rates(problem, law, self.domain, free)
            self.plain = len(self.domain.moving)
            self._by = [self._along(problem, law, free, j) for j in range(len(self.states))]

    def _rates(self, problem: Problem, law: str | None, domain: Any, free: Callable[[str], Any]) -> list[Any]:
        walk = Environment(problem, domain, free, _NoSums())
        return [walk.output(problem.motion[name], {}, 0, law) for name in self.states]

    def _along(
        self, problem: Problem, law: str | None, free: Callable[[str], Series[Ball]], j: int
    ) -> list[Series[Ball]]:
        """The derivatives of all states by the initial value of state j."""
        rates: list[Pair[Series[Ball]]] = []

        def rule(n: int, k: int) -> Ball:
            if k == 0:
                return self.base.constant(Fraction(int(n == j)))
            moved = rates[n].derivative
            return self._integrated(None if moved is None else moved.at(k - 1), k)

        slopes = [self.domain.made(partial(rule, n)) for n in range(len(self.states))]
        pairs = {name: Pair(free(name), slope) for name, slope in zip(self.states, slopes, strict=True)}
        rates += self._rates(problem, law, _Sided(self.domain), lambda x: pairs.get(x) or Pair(free(x)))
        return slopes

    def _next(self, n: int, k: int) -> Ball:
        """x_0 is the box, x_k = (h/k) f_(k-1)."""
        return self._integrated(self.rates[n].at(k - 1), k) if k else self.box[n]

    def _integrated(self, rate: Ball | None, k: int) -> Ball:
        return self.base.constant(Fraction(0)) if rate is None else self.h * rate / k

    def coefficients(self, box: Box, h: Fraction, order: int) -> list[list[Ball]]:
        """Of each state, h^k x_k for k = 0 .. order on the box. Raises Undecided at a switch."""
        self._expand(box, h, order, self.plain)
        return [list(series.terms) for series in self.domain.moving[: len(self.states)]]

    def slopes(self, box: Box, h: Fraction, order: int) -> list[list[Ball]]:
        """The derivatives of the Taylor polynomials of that order by the initial values, on the box: a little
        more than needed.
        """
        self._expand(box, h, order, len(self.domain.moving))
        sums = [[sum(reversed(series.terms)) for series in by] for by in self._by]
        return [[x + arb(0, x.rad() / 8) for x in row] for row in zip(*sums, strict=True)]

    def _expand(self, box: Box, h: Fraction, order: int, count: int) -> None:
        self.box, self.h = [ball(*ends) for ends in box], ball(h, h)
        self.domain.expand(count, order)


def _value(problem: Problem, name: str, values: Mapping[str, Fraction]) -> Fraction:
    """What a free scalar is for all times."""
    kind = problem.scalars[name]
    if kind in ("state", "input"):
        lacks = "no motion" if kind == "state" else "no law"
        raise ValueError(f"the {kind} {name} has {lacks}, so its course in time is not known")
    if name not in values:
        raise ValueError(f"no value was given for the {kind} {name}")
    return values[name]


class _Sided(Tangent[Series[Ball]]):
    """Derivatives of series, which have a value only on one side of a switch: there a sign is constant."""

    def operation(self, op: str) -> Callable[..., Pair[Series[Ball]]]:
        if op != "SIGN":
            return super().operation(op)
        return lambda a: Pair(self.base.operation(op)(a.value))


class _NoSums:
    def value(self, at: Environment, name: str, level: int, law: str | None) -> Any:
        raise ValueError(f"{name} is a sum over the nodes of a fleet; a tube is made for one vehicle")
