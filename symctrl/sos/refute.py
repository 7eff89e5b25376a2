"""Rational points of a set at which a polynomial is negative. Floats propose; every point is tried exactly.

In this order: points with coordinates 0, 1, -1; points far out along monomial curves c t^h, on which a part
of the polynomial decides; points that a descent finds. Each is rounded as coarsely as it may be, so that a
witness is short; in a set with equations it is moved onto them exactly (`onto`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
from scipy.optimize import minimize

from symctrl.sos.deadline import Deadline
from symctrl.sos.floats import Floats
from symctrl.sos.onto import Onto
from symctrl.sos.polish import stationary
from symctrl.sos.problem import Problem
from symctrl.sos.ring import value_at

Point = tuple[Fraction, ...]
_BITS = (0, 1, 2, 4, 8, 14, 24, 40, 60, 100)
_SEED = 7


class Refuter:
    """Looks for a point that contradicts a problem. `admissible`: the first point of the set that was met."""

    def __init__(self, problem: Problem, deadline: Deadline) -> None:
        self.problem = problem
        self.deadline = deadline
        self.n = len(problem.names)
        self.p = Floats(problem.polynomial)
        self.gs = [Floats(g) for g in problem.nonnegative]
        self.hs = [Floats(h) for h in problem.zero]
        self.onto = Onto(problem)
        self.admissible: Point | None = None
        self.draw = np.random.default_rng(_SEED)
        self.best: list[tuple[float, Any]] = []  # the lowest float values in the set, and where

    def quick(self) -> Point | None:
        """Grid and curves: milliseconds."""
        return self._among(self._grid()) or self._curves()

    def thorough(self, starts: int = 24) -> Point | None:
        """Descents from many starts, then Newton's method from where they ended."""
        return self._among_floats(self._descents(starts)) or self._polished()

    def _polished(self) -> Point | None:
        """Where the lowest values are nearly zero, with many digits."""
        if self.hs or self.gs:
            return None
        size = float(np.abs(self.p.coefficients).max())
        seen: list[Any] = []
        for value, x in sorted(self.best, key=lambda entry: entry[0])[:8]:
            if value > 1e-6 * size or any(np.abs(x - y).max() < 1e-4 * (1 + np.abs(y).max()) for y in seen):
                continue
            seen.append(x)
            for point in stationary(self.problem.polynomial, x):
                if self.contradicts(point):
                    return point
        return None

    def contradicts(self, point: Sequence[Fraction]) -> bool:
        """Exactly: is the point in the set, and the claim false there?"""
        problem = self.problem
        if any(value_at(h, point) != 0 for h in problem.zero):
            return False
        if any(value_at(g, point) < 0 for g in problem.nonnegative):
            return False
        if self.admissible is None:
            self.admissible = tuple(point)
        value = value_at(problem.polynomial, point)
        return value < 0 or (problem.strict and value == 0)

    def _inside(self, points: Any) -> Any:
        """Which of the points are in the set, nearly and in floats."""
        ok = np.isfinite(self.p(points))
        for g in self.gs:
            ok &= g(points) >= -1e-7
        for h in self.hs:
            ok &= np.abs(h(points)) <= 1e-6
        return ok

    def _grid(self) -> Any:
        if self.n <= 6:
            return np.array(list(product((0.0, 1.0, -1.0), repeat=self.n)))
        some = self.draw.integers(-1, 2, (600, self.n)).astype(float)
        return np.vstack([np.zeros(self.n), np.eye(self.n), -np.eye(self.n), np.ones(self.n), some])

    def _among(self, points: Any) -> Point | None:
        """The first exact contradiction among float points that are exact themselves or nearly right."""
        if self.hs:
            points = np.vstack([points, self.draw.uniform(-2, 2, (200, self.n))])
            return self._among_floats(iter(points[:400]), coarse=True)
        values = self.p(points)
        ok = self._inside(points)
        scale = 1e-9 * (1 + np.abs(values))
        for k in np.argsort(values)[:400]:
            if ok[k] and values[k] <= scale[k]:
                point = tuple(map(Fraction, points[k].tolist()))
                if self.contradicts(point):
                    return point
            elif ok[k] and self.admissible is None:
                self.contradicts(tuple(map(Fraction, points[k].tolist())))
        return None

    def _curves(self) -> Point | None:
        """c t^h for large t, where the terms of the largest weight h'a have a negative sum at c."""
        if self.hs or self.gs:
            return None
        n, exponents, coefficients = self.n, self.p.exponents, self.p.coefficients
        directions = [*np.eye(n, dtype=int), -np.ones(n, dtype=int), np.ones(n, dtype=int)]
        directions += [np.array(h) for h in product((-2, -1, 0, 1, 2), repeat=n)] if n <= 3 else []
        directions += list(self.draw.integers(-2, 3, (60 if n > 3 else 0, n)))
        lowest = exponents[coefficients < 0]
        directions += [2 * a - exponents.mean(axis=0).astype(int) for a in lowest[:20]]
        signs = np.vstack([self.draw.choice([-1.0, 1.0], (16, n)), np.ones(n), -np.ones(n)])
        signs = np.vstack([signs, self.draw.choice([-2.0, -1.0, 0.5, 1.0, 3.0], (16, n))])
        for h in directions:
            weights = exponents @ h
            face = object.__new__(Floats)
            face.n = n
            kept = weights == weights.max()
            face.exponents, face.coefficients = exponents[kept], coefficients[kept]
            values = face(signs)
            k = int(np.argmin(values))
            if values[k] >= 0:
                continue
            for t in (2, 10, 10**3, 10**7, 10**15):
                point = tuple(
                    Fraction(c) * Fraction(t) ** int(e) for c, e in zip(signs[k].tolist(), h, strict=True)
                )
                if self.contradicts(point):
                    return point
        return None

    def _descents(self, starts: int) -> Iterator[Any]:
        n = self.n
        for k in range(starts):
            if self.deadline.left <= 0:
                return
            scale = (1.0, 0.3, 3.0, 10.0)[k % 4]
            start = self.draw.normal(size=n) * scale if k else np.full(n, 0.1)
            found = self._descend(start)
            if found is not None:
                yield found

    def _descend(self, start: Any) -> Any:
        size = max(1.0, float(np.abs(self.p.coefficients).max()))

        def value(x: Any) -> Any:
            with np.errstate(all="ignore"):
                v, d = float(self.p(x)[0]) / size, self.p.gradient(x) / size
            return (v, d) if np.isfinite(v) and np.isfinite(d).all() else (1e300, np.zeros(self.n))

        try:
            with np.errstate(all="ignore"):
                if not self.gs and not self.hs:
                    done = minimize(value, start, jac=True, method="BFGS", options={"maxiter": 200})
                else:
                    bounds = [
                        {"type": kind, "fun": _of(f), "jac": f.gradient}
                        for kind, fs in (("ineq", self.gs), ("eq", self.hs))
                        for f in fs
                    ]
                    done = minimize(
                        value, start, jac=True, method="SLSQP", constraints=bounds, options={"maxiter": 200}
                    )
        except (ValueError, ArithmeticError, np.linalg.LinAlgError):
            return None
        x = np.asarray(done.x)
        if not np.isfinite(x).all() or np.abs(x).max() > 1e30:
            return None
        if bool(self._inside(x[None])[0]):
            self.best.append((float(self.p(x)[0]), x))
        return x

    def _among_floats(self, found: Iterable[Any], coarse: bool = False) -> Point | None:
        for x in found:
            for point in self._rounded(x, coarse):
                if self.contradicts(point):
                    return point
        return None

    def _rounded(self, x: Any, coarse: bool) -> Iterator[Point]:
        """The point in rationals, from coarse to fine, on the equations and inside the inequalities."""
        pulls = [x]
        if self.gs and not coarse and self.admissible is not None:
            inner = np.array([float(a) for a in self.admissible])
            pulls += [x + 2.0**-k * (inner - x) for k in (40, 30, 20, 14, 10, 7, 5)]
        value = float(self.p(x)[0])
        if value > 1e-3 * (1 + float(np.abs(self.p.coefficients).max())) and self.admissible is not None:
            return
        for start in pulls:
            for bits in _BITS[:5] if coarse else _BITS:
                point = tuple(
                    Fraction(round(a * (1 << bits)), 1 << bits) for a in map(Fraction, start.tolist())
                )
                if not self.hs:
                    yield point
                else:
                    yield from self.onto.points(point)
            if not self.hs:
                for limit in (12, 1000):
                    yield tuple(Fraction(a).limit_denominator(limit) for a in start.tolist())


def _of(f: Floats) -> Any:
    return lambda x: float(f(x)[0])
