"""Theorems that hold are proved by their textbook arguments, with symbolic gains, inertias and exponents."""

import json

import pytest

from symctrl import (
    Study,
    along_trajectory,
    apart,
    bounded,
    equal,
    eventually,
    exponentially,
    initially,
    settles,
    stable,
    stays,
    summable,
    tends,
)
from symctrl.expr import lift
from symctrl.kernel.check import check_text
from symctrl.vectors import absolute, cross, inverse, power, sgn, signed_power, stack
from tests.rules.theorem_rows import assert_proved, decided, states, theorem

PROVED = []


def proved(build):
    PROVED.append(build)
    return build


@proved
def quaternion_feedback():
    """LaSalle, for every inertia."""
    study = Study("loop")
    q, w, J = study.unit_quaternion("q"), study.state("w", 3), study.inertia("J")
    k, c = study.gain("k"), study.gain("c")
    study.motion(q, stack(q.scalar * w + cross(q.vector, w), -q.vector.T @ w) / 2)
    study.motion(w, inverse(J) @ (-cross(w, J @ w) - k * q.vector - c * w))
    V = w.T @ J @ w / 2 + 2 * k * (1 - q.scalar)
    return theorem(study, [tends(w, q.vector)], lambda run: run.lasalle(V, zero=w, limit=[w, q.vector]))


@proved
def finite_time_with_a_symbolic_exponent():
    study, x = states("x")
    a, b, gamma = study.gain("a"), study.gain("b"), study.parameter("gamma")
    study.assume(gamma > 0, gamma < 1)
    study.motion(x, -a * x - b * signed_power(x, gamma))
    return theorem(
        study,
        [settles(equal(x, 0))],
        lambda run: run.decays(x**2, a=2 * a, power=(2 * b, gamma, absolute(x))),
    )


@proved
def settling_time():
    study, x = states("x")
    a, b = study.gain("a"), study.gain("b")
    study.motion(x, -a * x - b * signed_power(x, "1/3"))
    time = "3/2" * power(absolute(x), "2/3") / b
    return theorem(
        study,
        [settles(equal(x, 0), by=time)],
        lambda run: run.decays(x**2, a=2 * a, power=(2 * b, "1/3", absolute(x)), time=time),
    )


@proved
def adaptation():
    """Barbalat, for every bounded regressor."""
    study, e, p = states("e", "p")
    a, g, w = study.gain("a"), study.gain("g"), study.disturbance("w")
    study.motion(e, -a * e + p * w)
    study.motion(p, -g * e * w)

    def lines(run):
        run.falls(e**2 / 2 + p**2 / (2 * g), by=a * e**2)
        run.exists()
        run.barbalat(e)

    return theorem(study, [tends(e), bounded(p)], lines, [bounded(w)])


@proved
def input_to_state():
    study, x = states("x")
    a, D, d = study.gain("a"), study.gain("D"), study.disturbance("d")
    study.motion(x, -a * x + d)
    small = a * x**2 / 2 <= D**2 / a
    return theorem(
        study,
        [settles(small), stays(small)],
        lambda run: run.decays(a * x**2 / 2, a=a, c=D**2 / 2, radius=D**2 / a),
        [d**2 <= D**2],
    )


@proved
def sliding_mode_of_second_order():
    study, x, v = states("x", "v")
    K, D, rate = study.gain("K"), study.gain("D"), study.gain("l")
    d = study.disturbance("d", bound=D)
    s = v + rate * x
    study.motion(x, v)
    study.motion(v, -rate * v - K * sgn(s) + d)

    def lines(run):
        run.falls(s**2 / 2, by=(K - D) * absolute(s))
        run.decays(rate * x**2, a=rate, input=s**2)
        run.exists()
        run.barbalat(s, of=(K - D) * absolute(s), least=K - D, power=1)
        run.tends(x)
        run.tends(v)

    return theorem(study, [tends(x, v)], lines, [K > D, bounded(d)])


@proved
def exponential_and_stable():
    study, x = states("x")
    k = study.gain("k")
    study.motion(x, -k * x - x**3)

    def lines(run):
        run.decays(x**2, a=2 * k)
        run.lyapunov(x**2, at={"x": 0})

    return theorem(study, [exponentially(x, k), tends(x), stable(x=0)], lines)


@proved
def oscillator():
    study, x, v = states("x", "v")
    k, c = study.gain("k"), study.gain("c")
    study.motion(x, v)
    study.motion(v, -k * x - c * v)
    V = k * x**2 + v**2

    def lines(run):
        run.lasalle(V, zero=v, limit=[x, v])
        run.lyapunov(V, at={"x": 0, "v": 0}, least=k / (1 + k))

    return theorem(study, [tends(x, v), stable(x=0, v=0)], lines)


@proved
def hardening_spring():
    study, x, v = states("x", "v")
    k, c = study.gain("k"), study.gain("c")
    study.motion(x, v)
    study.motion(v, -k * x - x**3 - c * v)
    V = k * x**2 / 2 + x**4 / 4 + v**2 / 2
    return theorem(study, [tends(x, v)], lambda run: run.lasalle(V, zero=v, limit=[x, v]))


def _pendulum():
    study, c, s, w = states("c", "s", "w")
    k, b = study.gain("k"), study.gain("b")
    study.motion(c, -s * w)
    study.motion(s, c * w)
    study.motion(w, -k * s - b * w)
    return study, w**2 / 2 + k * (1 - c), b * w**2, c, s, w


@proved
def pendulum_by_lasalle():
    study, V, _, c, s, w = _pendulum()
    lines = lambda run: run.lasalle(V, zero=w, limit=[w, s])  # noqa: E731
    return theorem(study, [tends(w, s)], lines, [equal(c**2 + s**2, 1)])


@proved
def pendulum_by_barbalat():
    study, V, part, c, s, w = _pendulum()

    def lines(run):
        run.falls(V, by=part)
        run.exists()
        run.barbalat(w)
        run.barbalat_rate(w)
        run.tends(s)

    return theorem(study, [tends(w, s)], lines, [equal(c**2 + s**2, 1)])


@proved
def cascade():
    study, x, y = states("x", "y")
    a = study.gain("a")
    study.motion(x, -a * x + y)
    study.motion(y, -y)

    def lines(run):
        run.decays(y**2, a=2)
        run.decays(x**2, a=a, input=y**2 / a)

    return theorem(study, [tends(x, y)], lines)


@proved
def observer():
    study, x, e = states("x", "e")
    k, rate = study.gain("k"), study.gain("l")
    study.motion(x, -k * (x - e))
    study.motion(e, -rate * e)

    def lines(run):
        run.decays(e**2, a=2 * rate)
        run.decays(x**2, a=k, input=k * e**2)
        run.exists()
        run.tends(e)
        run.tends(x)

    return theorem(study, [tends(x, e)], lines)


@proved
def logistic_growth_stays_in_its_interval():
    study, x = states("x")
    study.motion(x, x * (1 - x))

    def lines(run):
        run.keeps(x, a=x - 1)
        run.keeps(1 - x, a=x)
        run.bounded(x, offset=1)

    return theorem(study, [stays(x >= 0), bounded(x)], lines, [initially(x >= 0), initially(x <= 1)])


@proved
def detumbling():
    study = Study("loop")
    w, J, c = study.state("w", 3), study.inertia("J"), study.gain("c")
    study.motion(w, inverse(J) @ (-cross(w, J @ w) - c * w))

    def lines(run):
        run.falls(w.T @ J @ w / 2, by=c * w.T @ w)
        run.exists()
        run.barbalat(w)

    return theorem(study, [tends(w)], lines)


@proved
def real_radical():
    """Only over the complex numbers does x^2 + y^2 = 0 leave x free."""
    study, x, y = states("x", "y")
    study.motion(x, -x * (x**2 + y**2))
    study.motion(y, -y * (x**2 + y**2))
    V = x**2 + y**2
    return theorem(study, [tends(x, y)], lambda run: run.lasalle(V, zero=V, limit=[x, y]))


@proved
def factor_without_a_real_zero():
    study, x, y = states("x", "y")
    study.motion(x, -x * (y**2 + 1) ** 2)
    study.motion(y, lift(0))

    def lines(run):
        run.falls(y**2)
        run.lasalle(x**2, zero=x * (y**2 + 1), limit=[x])

    return theorem(study, [tends(x), bounded(y)], lines)


@proved
def input_of_finite_energy():
    study, x = states("x")
    d = study.disturbance("d")
    study.motion(x, -x + d)

    def lines(run):
        run.falls(x**2, by=x**2, plus=d**2)
        run.exists()
        run.decays(x**2, a=1, input=d**2)

    return theorem(study, [tends(x)], lines, [summable(d**2)])


@proved
def input_that_vanishes():
    study, x = states("x")
    d = study.disturbance("d")
    study.motion(x, -x + d)

    def lines(run):
        run.decays(x**2, a=1, input=d**2)
        run.exists()
        run.tends(d**2, by=d, times=d)
        run.decays(x**2, a=1, input=d**2)

    return theorem(study, [tends(x)], lines, [tends(d)])


@proved
def bounded_by_its_rate():
    study, x, y = states("x", "y")
    study.motion(x, -x)
    study.motion(y, x**2)

    def lines(run):
        run.falls(x**2, by=x**2)
        run.bounded(y, rate=x**2)
        run.exists()

    return theorem(study, [bounded(y)], lines)


@proved
def ultimate_bound():
    study, x = states("x")
    study.motion(x, -2 * x + 1)
    return theorem(study, [eventually(x**2 <= 4)], lambda run: run.decays(x**2, a=1, c=1, radius=4))


@proved
def denominator_apart_from_zero():
    study, x = states("x")
    study.motion(x, -x / (1 + x**2))

    def lines(run):
        run.falls(x**2)
        run.apart(1 + x**2, least=1)
        run.lasalle(x**2, zero=x)

    return theorem(study, [apart(1 + x**2), tends(x)], lines)


@proved
def along_a_trajectory():
    study, x, y = states("x", "y")
    study.motion(x, -x * y**2)
    study.motion(y, -(x**2) * y)

    def lines(run):
        run.falls(x**2 + y**2)
        run.exists()
        run.decays(x**2, a=2)

    return theorem(study, [tends(x)], lines, [along_trajectory(y**2 >= 1)])


@pytest.mark.parametrize("build", PROVED, ids=lambda build: build.__name__)
def test_a_true_theorem_is_proved(build):
    assert_proved(build())


@pytest.mark.parametrize("build", [adaptation, oscillator], ids=lambda build: build.__name__)
def test_its_certificate_is_checked_by_the_kernel_alone(build):
    row, _ = decided(build())
    assert check_text(json.dumps(row.certificate)).status == "valid"
