"""Names, laws, rates and sums: against finite differences, SymPy and explicit sums."""

from fractions import Fraction
from itertools import islice

import mpmath
import pytest
import sympy

from symctrl import Study, equal
from symctrl.decide.place import evaluation
from symctrl.decide.points import points
from symctrl.domains.fraction import FractionDomain
from symctrl.domains.sympy_ import SympyDomain
from symctrl.evaluate import Environment, NoRate
from symctrl.vectors import sin
from tests.decide.problems import body, problem
from tests.domains.exactly import Numbers


class NoSums:
    def value(self, at, name, level, law):
        raise AssertionError(name)


def pendulum():
    study = Study("pendulum")
    a, w, k = study.state("a"), study.state("w"), study.parameter("k")
    u = study.input("u")
    study.motion(a, w)
    study.motion(w, u - sin(a))

    @study.law("(1)", u)
    def feedback():
        return -k * w

    return study, a, w, feedback


def symbolic(made):
    domain = SympyDomain()
    outputs = Environment(made, domain, domain.symbol, NoSums()).outputs(made.claim.listing, {})
    return outputs[: len(outputs) // 2]


def test_a_rate_under_a_law_is_the_one_of_sympy():
    study, a, w, feedback = pendulum()
    made = problem(study, equal(study.rate(w**2 * sin(a), feedback), 0))
    (rate,) = symbolic(made)
    A, W, k = (sympy.Symbol(name, real=True) for name in ("a", "w", "k"))
    body_ = W**2 * sympy.sin(A)
    assert sympy.expand(rate - (body_.diff(A) * W + body_.diff(W) * (-k * W - sympy.sin(A)))) == 0


def test_a_second_rate_is_the_one_of_sympy():
    study, a, _, feedback = pendulum()
    made = problem(study, equal(study.rate(study.rate(a**3, feedback), feedback), 0))
    (rate,) = symbolic(made)
    A, W, k = (sympy.Symbol(name, real=True) for name in ("a", "w", "k"))
    along = lambda e: e.diff(A) * W + e.diff(W) * (-k * W - sympy.sin(A))  # noqa: E731
    assert sympy.expand(rate - along(along(A**3))) == 0


def test_a_rate_is_a_finite_difference_along_the_motion():
    """Central differences of order h^2 at 60 digits."""
    study, q, w = body()
    study.motion(w, q.vector - w)
    V = (q.vector.T @ w) / (2 + q.scalar)
    made = problem(study, equal(study.rate(V), V))
    start = {
        "q[1]": "1/3",
        "q[2]": "2/3",
        "q[3]": "-1/7",
        "q0": "2/3",
        "w[1]": "1",
        "w[2]": "-2",
        "w[3]": "1/2",
    }
    with mpmath.workdps(60):
        at = {name: Numbers().constant(Fraction(v)) for name, v in start.items()}
        here = Environment(made, Numbers(), at.__getitem__, NoSums())
        rate = here.outputs("claim", {})[0]
        speed = {name: here.output(made.motion[name], {}) for name in at}
        h = mpmath.mpf(10) ** -20
        ends = []
        for side in (1, -1):
            moved = {name: v + side * h * speed[name] for name, v in at.items()}
            ends.append(Environment(made, Numbers(), moved.__getitem__, NoSums()).outputs("claim", {})[1])
        assert abs(rate - (ends[0] - ends[1]) / (2 * h)) < mpmath.mpf(10) ** -35


def test_an_input_without_a_law_has_no_rate():
    study, _, w, _ = pendulum()
    with pytest.raises(NoRate, match="u"):
        symbolic(problem(study, equal(study.rate(study.rate(w)), 0)))


def test_sums_are_those_over_the_graph():
    """A sum over neighbours and one over all nodes, at points on the small graphs."""
    study = Study("s")
    fleet = study.fleet()
    x, y = fleet.state("x"), fleet.state("y")
    i, j = fleet.node, fleet.neighbour
    inner = fleet.sum(j, (x[i] - x[j]) ** 2 * y[j])
    made = problem(study, equal(inner, fleet.sum(i, x[i] * y[i])))
    for place in islice(points(made), 8):
        v, at = place.values, place.binding["i"]
        near, whole = evaluation(made, place, FractionDomain()).outputs("claim", place.binding)
        assert near == sum((v[f"x.{at}"] - v[f"x.{k}"]) ** 2 * v[f"y.{k}"] for k in place.neighbours[at])
        assert whole == sum(v[f"x.{k}"] * v[f"y.{k}"] for k in place.neighbours)
