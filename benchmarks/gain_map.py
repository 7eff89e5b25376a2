"""Maps of gains, each cell decided as a whole, against what a user would do instead at the cells' middles.

Two conditions on (k, beta): those of a formation on a ring of eight, k > beta lambda for every eigenvalue and
k^2 >= 2 beta; and a 3x3 matrix of products of gains. Instead: the bounds in numpy, eigenvalues of the matrix
by LAPACK in a batch or one by one by SciPy, and one semidefinite feasibility problem a point in CVXPY. None
of these says anything about the rest of a cell, and floats on the edge may be wrong. The times are for all
cells: the map decides large blocks of them together, which points cannot do.

Run: python benchmarks/gain_map.py
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
import scipy.linalg

from symctrl import Study, positive_definite, registry
from symctrl.context import within
from symctrl.gains.answer import Asked
from symctrl.gains.conditions import conditions
from symctrl.gains.maps import Axis, Map, swept
from symctrl.vectors import row, stack

Made = Callable[[Sequence[Axis]], Map]
Points = Callable[[Any, Any], Any]  # at arrays of the two gains: does everything hold?
LOW, HIGH = Fraction(1, 10), Fraction(3)


def mapped(study: Study, theorem: str | None = None) -> Made:
    """The map of a study's conditions, without the time that its theorem takes."""
    with within(study.instance):
        entry = study.entries[theorem] if theorem else None
        asked = Asked(study, conditions(study, entry), (), study.all_values())
        cases = asked.cases(asked.bracket())
        deciding = asked.deciding
    return lambda axes: swept(deciding, axes, asked.values, cases)


def ring() -> Study:
    study = Study("ring")
    k, beta = study.gain("a", "2"), study.gain("b", "1/4")
    fleet = study.fleet(default="ring:8")

    @study.condition("1")
    def stiff() -> Any:
        """The stiffness exceeds the coupling."""
        return k - beta * fleet.eigenvalue > 0

    @study.condition("2")
    def damped(i: Any) -> Any:
        """Every craft is damped."""
        return k**2 >= beta * fleet.degree(i)

    return study


def matrix() -> Study:
    study = Study("matrix")
    a, b = study.gain("a", "2"), study.gain("b", "1/2")

    @study.condition("1")
    def definite() -> Any:
        """A matrix of products of gains is positive definite."""
        return positive_definite(stack(row(a, a * b / 2, b), row(a * b / 2, 2, a / 3), row(b, a / 3, a * a)))

    return study


def on_a_ring(k: Any, beta: Any) -> Any:
    return (k > 4 * beta) & (k * k >= 2 * beta)


def entries(a: Any, b: Any) -> Any:
    made = [[a, a * b / 2, b], [a * b / 2, 2 + 0 * a, a / 3], [b, a / 3, a * a]]
    return np.moveaxis(np.array(made), (0, 1), (-2, -1))


def in_a_batch(a: Any, b: Any) -> Any:
    return np.linalg.eigvalsh(entries(a, b))[..., 0] > 0


def one_by_one(a: Any, b: Any) -> Any:
    found = [scipy.linalg.eigvalsh(A)[0] > 0 for A in entries(a.ravel(), b.ravel())]
    return np.array(found).reshape(a.shape)


def programmes(a: Any, b: Any) -> Any:
    """Is there a y = 1 with y A >> 0? A feasibility problem a point, with the gains as parameters."""
    import cvxpy as cp

    A, y = cp.Parameter((3, 3), symmetric=True), cp.Variable()
    problem = cp.Problem(cp.Minimize(0), [y * A >> 1e-9 * np.eye(3), y == 1])
    found = []
    for value in entries(a.ravel(), b.ravel()):
        A.value = value
        problem.solve(solver=cp.CLARABEL)
        found.append(problem.status == "optimal")
    return np.array(found).reshape(a.shape)


def timed(work: Callable[[], Any]) -> tuple[Any, float]:
    began = time.perf_counter()
    made = work()
    return made, time.perf_counter() - began


def axes_of(count: int, names: Sequence[str] = ("a", "b")) -> list[Axis]:
    return [Axis(name, LOW, HIGH, count) for name in names]


def middles(axes: Sequence[Axis]) -> Any:
    lines = [np.linspace(float(x.lo), float(x.hi), 2 * x.count + 1)[1::2] for x in axes]
    return np.meshgrid(*lines)


def compare(name: str, made: Made, count: int, points: Sequence[tuple[str, Points, int]]) -> None:
    axes = axes_of(count)
    made(axes_of(32))  # what is loaded at first
    found, seconds = timed(lambda: made(axes))
    speed = count**2 / seconds
    open_ = int(np.count_nonzero(found.states == 0))
    print(f"{name}, {count} x {count} cells: {seconds:.3f} s, {speed:.2e} cells/s, {open_} undecided")
    for other, holds, most in points:
        size = min(count, most)
        at = middles(axes_of(size))
        seen, used = timed(lambda: holds(*at))  # noqa: B023
        rate = size**2 / used
        agree = ""
        if size == count:
            sure = found.states != 0
            wrong = int(np.count_nonzero(seen[sure] != (found.states[sure] == 1)))
            agree = f"; {wrong} middles differ"
        print(f"    {other}: {rate:.2e} points/s at {size} x {size}; symctrl {speed / rate:.3g} times{agree}")


def formation() -> None:
    """The theorem of the paper's formation, with gains and range as in its report."""
    study = registry.load("liang2016_formation")
    made = mapped(study, "synchronisation")
    for count in (1000, 3163):
        axes = [
            Axis("K_o", Fraction(1, 2), Fraction(8), count),
            Axis("beta", Fraction(1, 100), Fraction(1), count),
        ]
        made(axes_of(32, ("K_o", "beta")))
        found, seconds = timed(lambda: made(axes))  # noqa: B023
        open_ = int(np.count_nonzero(found.states == 0))
        print(
            f"formation, {count} x {count} cells: {seconds:.3f} s, {count**2 / seconds:.2e} cells/s, "
            f"{open_} undecided"
        )


def main() -> None:
    formation()
    for count in (1000, 3163):
        compare("ring of eight", mapped(ring()), count, [("numpy at the middles", on_a_ring, 3163)])
    batch = [("LAPACK in a batch", in_a_batch, 1000)]
    single = [("scipy eigvalsh", one_by_one, 100), ("CVXPY feasibility", programmes, 20)]
    for count in (1000, 3163):
        compare("3x3 matrix", mapped(matrix()), count, batch + (single if count == 1000 else []))


if __name__ == "__main__":
    main()
