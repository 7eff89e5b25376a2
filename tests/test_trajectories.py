"""Enclosed solutions against closed forms, conserved quantities and SciPy; where they must end."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import casadi as ca
import flint
import mpmath
import pytest
from flint import arb, fmpq
from scipy.integrate import solve_ivp

from symctrl.domains.domain import Unsupported
from symctrl.domains.interval import bounds
from symctrl.trajectories import NotEnclosed, enclose
from symctrl.tubes import Tube
from tests.motions import BODY, LOGISTIC, OSCILLATOR, PENDULUM, SPIN, both, motion, numbers

# y is the integral of a function of x = t: formula, its meaning in mpmath, x at t = 0.
FUNCTIONS = {
    "inv": (lambda x: 1 / x, lambda x: 1 / x, "1/2"),
    "sq": (lambda x: x**2, lambda x: x**2, "-1/2"),
    "power": (lambda x: x**7, lambda x: x**7, "-1/2"),
    "negative power": (lambda x: x**-3, lambda x: x**-3, "1/2"),
    "root power": (lambda x: x**1.5, lambda x: x**1.5, "1/2"),
    "moving power": (lambda x: x**x, lambda x: x**x, "1/2"),
    "exponential": (lambda x: ca.constpow(2, x), lambda x: 2**x, "1/2"),
    "sqrt": (ca.sqrt, mpmath.sqrt, "1/2"),
    "exp": (ca.exp, mpmath.exp, "-1/2"),
    "log": (ca.log, mpmath.log, "1/2"),
    "sin": (ca.sin, mpmath.sin, "-1/2"),
    "cos": (ca.cos, mpmath.cos, "-1/2"),
    "tan": (ca.tan, mpmath.tan, "-1/2"),
    "asin": (ca.asin, mpmath.asin, "-1/2"),
    "acos": (ca.acos, mpmath.acos, "-1/2"),
    "atan": (ca.atan, mpmath.atan, "-1/2"),
    "sinh": (ca.sinh, mpmath.sinh, "-1/2"),
    "cosh": (ca.cosh, mpmath.cosh, "-1/2"),
    "tanh": (ca.tanh, mpmath.tanh, "-1/2"),
    "asinh": (ca.asinh, mpmath.asinh, "-1/2"),
    "acosh": (ca.acosh, mpmath.acosh, "3/2"),
    "atanh": (ca.atanh, mpmath.atanh, "-1/2"),
    "expm1": (ca.expm1, mpmath.expm1, "-1/2"),
    "log1p": (ca.log1p, lambda x: mpmath.log(1 + x), "-1/4"),
    "hypot": (lambda x: ca.hypot(x, 2), lambda x: mpmath.sqrt(x * x + 4), "-1/2"),
    "fabs": (lambda x: ca.fabs(x - 2), lambda x: abs(x - 2), "1/2"),
    "sign": (lambda x: ca.sign(x) * x, lambda x: x, "1/2"),
    "fmin": (lambda x: ca.fmin(x, 2) * x, lambda x: x**2, "1/2"),
    "fmax": (lambda x: ca.fmax(x, 2) * x, lambda x: 2 * x, "1/2"),
}


def assert_holds(tube: Tube, name: str, t: Fraction, value: arb) -> None:
    low, high = bounds(value)
    assert tube.at(t)[name][0] <= low <= high <= tube.at(t)[name][1]


def width(tube: Tube, name: str) -> Fraction:
    return tube.at(tube.until)[name][1] - tube.at(tube.until)[name][0]


@cache
def spinning() -> Tube:
    return both(BODY, SPIN, 10)


@pytest.fixture(autouse=True)
def many_digits():
    before, flint.ctx.prec = flint.ctx.prec, 400
    with mpmath.workdps(40):
        yield
    flint.ctx.prec = before


def test_decay():
    tube = both(motion(lambda x, k: (-k * x,), x="state", k="parameter"), numbers(x="1/3", k="2/7"), 20)
    for t in tube.times:
        assert_holds(tube, "x", t, arb(fmpq(1, 3)) * (-arb(fmpq(2, 7)) * _arb(t)).exp())
    assert width(tube, "x") < Fraction(1, 10**15)


def test_an_oscillator_turns_without_its_boxes_growing():
    tube = both(OSCILLATOR, numbers(x=1, v=0), 100)
    for t in tube.times:
        assert_holds(tube, "x", t, _arb(t).cos())
        assert_holds(tube, "v", t, -_arb(t).sin())
    assert width(tube, "x") < Fraction(1, 10**13)


def test_logistic_growth():
    tube = both(LOGISTIC, numbers(x="1/10"), 12)
    for t in tube.times:
        assert_holds(tube, "x", t, 1 / (1 + 9 * (-_arb(t)).exp()))


def test_a_rigid_body_keeps_energy_and_momentum():
    tube = spinning()
    J = [SPIN[name] for name in "JKL"]
    for power in (1, 2):
        first = sum(j**power * SPIN[name] ** 2 for j, name in zip(J, "abc", strict=True))
        for t in tube.times:
            squares = [_square(tube.at(t)[name]) for name in "abc"]
            low, high = (sum(j**power * s[k] for j, s in zip(J, squares, strict=True)) for k in (0, 1))
            assert low <= first <= high <= low + Fraction(1, 10**12)


def test_scipy_ends_beside_the_box_of_a_pendulum_under_a_law():
    values = numbers(x=2, v="-1/2", w="1/10")
    tube = both(PENDULUM, values, 10, "law")

    def field(_, y):
        return [y[1], -mpmath.sin(y[0]) - mpmath.tanh(2 * y[1]) / 2 + 0.1]

    end = solve_ivp(field, (0, 10), [2, -0.5], rtol=1e-11, atol=1e-12).y[:, -1]
    for name, value in zip("xv", end, strict=True):
        low, high = tube.at(Fraction(10))[name]
        assert low - Fraction(1, 10**8) <= Fraction(float(value)) <= high + Fraction(1, 10**8)
        assert high - low < Fraction(1, 10**12)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_integral_of_each_function(name):
    formula, meaning, start = FUNCTIONS[name]
    problem = motion(lambda x, y: (1, formula(x)), x="state", y="state")
    tube = both(problem, numbers(x=start, y=0), "1/2", order=12)
    x = mpmath.mpf(Fraction(start).numerator) / Fraction(start).denominator
    integral = mpmath.quad(meaning, [x, x + 0.5])
    low, high = (mpmath.mpf(end.numerator) / end.denominator for end in tube.at(Fraction(1, 2))["y"])
    assert low - mpmath.mpf(10) ** -30 <= integral <= high + mpmath.mpf(10) ** -30
    assert high - low < 1e-14


def test_the_rate_of_a_definition_is_taken_along_the_motion():
    """v' = -x - (x^2)' = -x - 2 x v."""
    rated = motion(lambda x, v, e: (v, -x - e), rated=("e", lambda x, v: (x**2,)), x="state", v="state")
    plain = motion(lambda x, v: (v, -x - 2 * x * v), x="state", v="state")
    start = numbers(x="1/2", v=0)
    a, b = (both(problem, start, 2).at(Fraction(2)) for problem in (rated, plain))
    for name in ("x", "v"):
        assert max(a[name][0], b[name][0]) <= min(a[name][1], b[name][1])


def test_a_switch_that_is_not_met_and_one_that_is():
    """u = -1 as long as x + 2 v > 1: from x = 4 at rest until 4 - t^2/2 - 2 t = 1, t = root(10) - 2."""
    problem = motion(
        lambda x, v, u: (v, u),
        lambda x, v, u: (ca.fmax(-1, ca.fmin(1, -x - 2 * v)),),
        x="state",
        v="state",
        u="input",
    )
    values = numbers(x=4, v=0)
    tube = both(problem, values, 1, "law")
    assert tube.at(Fraction(1))["x"][0] <= Fraction(7, 2) <= tube.at(Fraction(1))["x"][1]
    with pytest.raises(NotEnclosed, match="kink where its argument is zero") as caught:
        enclose(problem, "law", values, Fraction(3), order=8, tolerance=Fraction(1, 2**40))
    assert 1.16 < caught.value.until < 1.1622777


def test_what_grows_without_bound_is_enclosed_until_shortly_before():
    problem = motion(lambda x: (x**2,), x="state")
    with pytest.raises(NotEnclosed, match="no box holds it") as caught:
        enclose(problem, None, numbers(x=1), Fraction(2), order=8, tolerance=Fraction(1, 2**30))
    assert Fraction(99, 100) < caught.value.until < 1


def test_a_tube_is_read_by_time_and_written_exactly():
    tube = spinning()
    assert tube.times[0] == 0
    assert tube.until == 10
    assert tube.at(Fraction(0))["b"][0] <= Fraction(1, 100) <= tube.at(Fraction(0))["b"][1]
    inside = tube.steps[3].t + tube.steps[3].h / 3
    assert tube.over(inside) == dict(zip(tube.states, tube.steps[3].over, strict=True))
    for t in (Fraction(-1), Fraction(11)):
        with pytest.raises(KeyError):
            tube.at(t)
        with pytest.raises(KeyError):
            tube.over(t)
    assert set(map(type, _leaves(tube.as_json()))) == {int, str}


@pytest.mark.parametrize(
    ("problem", "law", "values", "message"),
    [
        (OSCILLATOR, None, numbers(x=1), "no initial value was given for v"),
        (BODY, None, {k: v for k, v in SPIN.items() if k != "L"}, "no value was given for the parameter L"),
        (PENDULUM, None, numbers(x=0, v=0, w=0), "input u has no law"),
    ],
)
def test_what_is_missing_is_named(problem, law, values, message):
    with pytest.raises(ValueError, match=message):
        enclose(problem, law, values, Fraction(1))


def test_an_operation_without_a_series_is_named():
    with pytest.raises(Unsupported, match="no meaning to floor"):
        enclose(motion(lambda x: (ca.floor(x),), x="state"), None, numbers(x="1/2"), Fraction(1))


def _arb(x: Fraction) -> arb:
    return arb(fmpq(x.numerator, x.denominator))


def _square(ends):
    low, high = ends
    squares = sorted((low**2, high**2))
    return (Fraction(0) if low < 0 < high else squares[0], squares[1])


def _leaves(value):
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [leaf for entry in value for leaf in _leaves(entry)]
    return [value]
