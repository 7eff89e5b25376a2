"""A polynomial in floating point, at many points at once, with its gradient."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from symctrl.sos.ring import Poly, to_fraction


class Floats:
    """Values of a polynomial in n variables at arrays of points of shape (points, n)."""

    def __init__(self, p: Poly) -> None:
        self.n = len(p.context().names())
        table = {tuple(map(int, m)): c for m, c in p.to_dict().items()} or {(0,) * self.n: None}
        self.exponents = np.array(list(table), dtype=np.int64)
        numbers = [0.0 if c is None else _float(c) for c in table.values()]
        self.coefficients = np.array(numbers)

    def __call__(self, points: Any) -> Any:
        points = np.atleast_2d(points)
        result = np.ones((len(points), len(self.exponents)))
        with np.errstate(all="ignore"):
            for v in np.flatnonzero(self.exponents.any(axis=0)):
                powers = points[:, v : v + 1] ** np.arange(self.exponents[:, v].max() + 1)
                result *= powers[:, self.exponents[:, v]]
            return result @ self.coefficients

    @cached_property
    def partials(self) -> list[Floats]:
        """The derivatives."""
        result = []
        for v in range(self.n):
            kept = self.exponents[:, v] > 0
            part = object.__new__(Floats)
            part.n = self.n
            part.exponents = self.exponents[kept] - np.eye(self.n, dtype=np.int64)[v]
            part.coefficients = self.coefficients[kept] * self.exponents[kept, v]
            result.append(part)
        return result

    def gradient(self, point: Any) -> Any:
        """The gradient at one point of shape (n,)."""
        return np.array([float(part(point)[0]) if len(part.exponents) else 0.0 for part in self.partials])


def _float(c: Any) -> float:
    try:
        return float(to_fraction(c))
    except OverflowError:
        return 1e300 if c > 0 else -1e300
