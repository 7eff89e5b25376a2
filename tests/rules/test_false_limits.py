"""Theorems that are false for one forgotten assumption: never proved, and the reason names what is missing.

Here: limits, what is carried over, and what is assumed.
From the textbooks: Khalil, Nonlinear Systems; Slotine and Li, Applied Nonlinear Control.
"""

import pytest

from symctrl import (
    Study,
    along_trajectory,
    apart,
    bounded,
    equal,
    initially,
    settles,
    stable,
    stays,
    summable,
    tends,
)
from symctrl.expr import lift
from symctrl.vectors import absolute, cross, power, sgn, stack, tanh
from symctrl.written import StudyError
from tests.rules.theorem_rows import assert_open, collector, decided, states, theorem

FALSE, false = collector()


# barbalat


@false("the rate of e is bounded", "barbalat: the rate of e is bounded")
def spikes():
    """The square of x has a finite integral, and x has ever narrower spikes."""
    study, x = states("x")
    study.motion(x, study.disturbance("d"))
    lines = lambda run: (run.exists(), run.barbalat(x, of=x**2))  # noqa: E731
    return theorem(study, [tends(x)], lines, [summable(x**2), bounded(x)])


@false("the rate of e is bounded", "barbalat: the rate of e is bounded")
def regressor_without_a_bound():
    study, e, p = states("e", "p")
    w = study.disturbance("w")
    study.motion(e, -e + p * w)
    study.motion(p, -e * w)

    def lines(run):
        run.falls(e**2 + p**2, by=2 * e**2)
        run.exists()
        run.barbalat(e)

    return theorem(study, [tends(e)], lines)


@false(None, "no line gives that p tends to zero")
def estimate_without_excitation():
    study, e, p = states("e", "p")
    w = study.disturbance("w")
    study.motion(e, -e + p * w)
    study.motion(p, -e * w)

    def lines(run):
        run.falls(e**2 + p**2, by=2 * e**2)
        run.exists()
        run.barbalat(e)

    return theorem(study, [tends(p)], lines, [bounded(w)])


@false("tends", "carries: tends: no way was found")
def estimate_with_an_excitation_that_fades():
    """c tends to zero, so that c p does says nothing of p."""
    study, e, p, c = states("e", "p", "c")
    study.motion(e, -e + p * c)
    study.motion(p, -e * c)
    study.motion(c, -c)

    def lines(run):
        run.falls(e**2 + p**2, by=2 * e**2)
        run.falls(c**2)
        run.exists()
        run.barbalat(e)
        run.barbalat_rate(e)
        run.tends(p)

    return theorem(study, [tends(p)], lines)


@false("barbalat", "sign of what is not constant has no derivative")
def lemma_for_what_jumps():
    study, x = states("x")
    study.motion(x, -sgn(x))

    def lines(run):
        run.falls(x**2 / 2, by=absolute(x))
        run.exists()
        run.barbalat(sgn(x), of=absolute(x))

    return theorem(study, [tends(sgn(x))], lines)


@false("barbalat_rate", "sign of what is not constant has no derivative")
def chattering_that_vanishes():
    """x tends to zero, and its rate, which has a switch in it, need not."""
    study, x = states("x")
    study.motion(x, -x - sgn(x))
    lines = lambda run: (run.decays(x**2, a=2), run.exists(), run.tends(x), run.barbalat_rate(x))  # noqa: E731
    return theorem(study, [tends(x + sgn(x))], lines)


# lasalle


@false("the rate of v is continuous", "lasalle: the rate of v is continuous")
def dry_friction_stops_anywhere():
    study, x, v = states("x", "v")
    study.motion(x, v)
    study.motion(v, -x - sgn(v))
    return theorem(study, [tends(x)], lambda run: run.lasalle(x**2 + v**2, zero=v, limit=[x, v]))


@false("the rate of v has no signal", "lasalle: the rate of v has no signal")
def damping_that_varies_with_time():
    """Damping that grows without bound leaves the spring where it is."""
    study, x, v = states("x", "v")
    d = study.disturbance("d")
    study.motion(x, v)
    study.motion(v, -x - (1 + d**2) * v)
    return theorem(study, [tends(x)], lambda run: run.lasalle(x**2 + v**2, zero=v, limit=[x, v]))


@false("limit 1 vanishes on the invariant set", "lasalle: limit 1 vanishes on the invariant set")
def damping_that_fades():
    study, x, v, z = states("x", "v", "z")
    study.motion(x, v)
    study.motion(v, -x - z**2 * v)
    study.motion(z, -z)
    lines = lambda run: (run.falls(z**2), run.lasalle(x**2 + v**2, zero=z * v, limit=[v]))  # noqa: E731
    return theorem(study, [tends(v)], lines)


@false("limit 3 vanishes on the invariant set", "lasalle: limit 3 vanishes on the invariant set")
def unwinding():
    """The attitude turned by a full turn is at rest too."""
    study, c, s, w = states("c", "s", "w")
    k, b = study.gain("k"), study.gain("b")
    study.motion(c, -s * w)
    study.motion(s, c * w)
    study.motion(w, -k * s - b * w)
    lines = lambda run: run.lasalle(w**2 / 2 + k * (1 - c), zero=w, limit=[w, s, 1 - c])  # noqa: E731
    return theorem(study, [tends(1 - c)], lines, [equal(c**2 + s**2, 1)])


@false("x is bounded", "lasalle: x is bounded")
def v_of_a_part_of_the_state():
    """x runs away, with it the damping of y, and y has another limit than zero."""
    study, x, y = states("x", "y")
    study.motion(x, lift(1))
    study.motion(y, -y / (1 + x**2))
    lines = lambda run: (run.falls(y**2), run.exists(), run.lasalle(y**2, zero=y))  # noqa: E731
    return theorem(study, [tends(y)], lines)


@false("V is differentiable", "lasalle: the rate of v is continuous")
def relay_without_damping():
    study, x, v = states("x", "v")
    study.motion(x, v)
    study.motion(v, -sgn(x))
    V = absolute(x) + v**2 / 2
    lines = lambda run: (run.falls(V), run.exists(), run.lasalle(V, zero=v, limit=[x, v]))  # noqa: E731
    return theorem(study, [tends(x)], lines)


# lyapunov


@false("V does not rise", "lyapunov: V does not rise")
def not_a_rest_point():
    study, x = states("x")
    study.motion(x, 1 - x)
    return theorem(study, [stable(x=0), bounded(x)], lambda run: run.lyapunov(x**2, at={"x": 0}))


@false("the point meets x^2 + y^2 = 1", "lyapunov: V is zero at the point")
def rest_point_outside_the_domain():
    study, x, y = states("x", "y")
    study.motion(x, y)
    study.motion(y, -x)
    lines = lambda run: run.lyapunov(x**2 + y**2, at={"x": 0, "y": 0})  # noqa: E731
    return theorem(study, [stable(x=0, y=0), bounded(x)], lines, [equal(x**2 + y**2, 1)])


@false("V grows with the distance", "lyapunov: V grows with the distance")
def v_that_leaves_out_a_state_of_the_point():
    study, x, y = states("x", "y")
    study.motion(x, -x)
    study.motion(y, tanh(y))

    def lines(run):
        run.falls(x**2)
        run.exists()
        run.lyapunov(x**2, at={"x": 0, "y": 0})

    return theorem(study, [stable(x=0, y=0), bounded(x, tanh(y))], lines)


@false("every state is named", "lyapunov: every state is named")
def stability_of_a_part_of_the_state():
    study, x, y = states("x", "y")
    study.motion(x, -x + y)
    study.motion(y, tanh(y))
    return theorem(study, [stable(x=0), bounded(x)], lambda run: run.lyapunov(x**2, at={"x": 0}))


# carries


@false("factor 1 is bounded", "carries: factor 1 is bounded")
def product_with_what_is_not_bounded():
    study, x, y = states("x", "y")
    study.motion(x, lift(1))
    study.motion(y, -y)

    def lines(run):
        run.decays(y**2, a=2)
        run.exists()
        run.tends(y)
        run.tends(x * y, by=y, times=x)

    return theorem(study, [tends(x * y)], lines)


@false("the square is bounded", "carries: the square is bounded")
def v_that_does_not_grow_with_the_conclusion():
    study, x, y = states("x", "y")
    study.motion(x, -x)
    study.motion(y, tanh(1 + y**2))

    def lines(run):
        run.falls(x**2)
        run.exists()
        run.bounded(y, by=x**2)

    return theorem(study, [bounded(y)], lines)


@false("the bound of the rate is summable", "carries: the bound of the rate is summable")
def integral_of_what_vanishes_too_slowly():
    study, x, y = states("x", "y")
    study.motion(x, -(x**3))
    study.motion(y, x)

    def lines(run):
        run.falls(x**2, by=2 * x**4)
        run.exists()
        run.bounded(y, rate=absolute(x))

    return theorem(study, [bounded(y)], lines)


@false("the parts bound e", "carries: the parts bound e")
def vanishing_taken_for_summable():
    study, x = states("x")
    study.motion(x, -(x**3))
    lines = lambda run: (run.falls(x**2, by=2 * x**4), run.exists(), run.summable(x, by=2 * x**4))  # noqa: E731
    return theorem(study, [summable(x)], lines)


@false("the square stays above", "carries: the square stays above")
def positive_taken_for_apart_from_zero():
    study, x = states("x")
    study.motion(x, -x)
    lines = lambda run: (run.keeps(x, a=1), run.falls(x**2), run.exists(), run.apart(x, least=1))  # noqa: E731
    return theorem(study, [apart(x)], lines, [initially(x > 0)])


@false("bounded", "carries: bounded: no way was found")
def integrator_windup():
    """A saturated actuator against a constant that it cannot balance: the integrator grows."""
    study, x, z = states("x", "z")
    study.motion(z, tanh(x))
    study.motion(x, 2 - tanh(x) - tanh(z))
    return theorem(study, [bounded(z)], lambda run: (run.exists(), run.bounded(z)))


@false("bounded", "carries: bounded: no way was found")
def momentum_of_a_wheel():
    study, w, h = states("w", "h")
    c, d = study.gain("c"), study.disturbance("d")
    study.motion(w, -c * w)
    study.motion(h, c * w + d)
    lines = lambda run: (run.falls(w**2), run.exists(), run.bounded(h))  # noqa: E731
    return theorem(study, [bounded(h)], lines, [bounded(d)])


@false(None, "no line gives that x = 0 is reached and kept by absolute(x)^(1/2)")
def a_time_that_no_line_speaks_of():
    study, x = states("x")
    study.motion(x, -sgn(x) * power(absolute(x), "1/2"))
    root = power(absolute(x), "1/2")
    lines = lambda run: run.decays(x**2, power=(2, "1/2", absolute(x)), time=2 * root)  # noqa: E731
    return theorem(study, [settles(equal(x, 0), by=root)], lines)


# assumptions


@false("q'*q + q0^2 = 1 is kept", "q'*q + q0^2 = 1 is kept")
def kinematics_with_a_wrong_sign():
    study = Study("loop")
    q, w = study.unit_quaternion("q"), study.state("w", 3)
    study.motion(q, stack(q.scalar * w + cross(q.vector, w), q.vector.T @ w) / 2)
    study.motion(w, -w)
    return theorem(study, [bounded(q.vector)], lambda run: run.falls(w.T @ w))


@pytest.mark.parametrize(("build", "role", "reason"), FALSE, ids=lambda x: x.__name__ if callable(x) else "")
def test_a_false_theorem_is_not_proved(build, role, reason):
    assert_open(build(), role, reason)


def test_assumptions_that_cannot_be_met_prove_nothing_that_stands():
    study, x = states("x")
    study.motion(x, -x)
    given = [initially(x >= 1), initially(x <= 0)]
    row, _ = decided(theorem(study, [tends(x)], lambda run: run.decays(x**2, a=2), given))
    assert row.verdict == "ill-formed"
    assert "contradicts itself" in row.reason


def test_a_function_with_a_pole_proves_nothing_that_stands():
    """x passes the pole of 1/x, and x >= 0 is left."""
    study, x = states("x")
    study.motion(x, lift(-1))
    row, _ = decided(theorem(study, [stays(x >= 0)], lambda run: (run.exists(), run.keeps(x, a=1 / x))))
    assert not row.stands
    assert [c.condition for c in row.conditions] == ["x != 0"]


@pytest.mark.parametrize("given", [lambda x: along_trajectory(x <= 1), tends])
def test_a_conclusion_is_not_assumed_of_the_trajectory(given):
    study, x = states("x")
    study.motion(x, lift(1))
    wanted = theorem(study, [stays(x <= 1), tends(x)], lambda run: run.exists(), [given(x)])
    with pytest.raises(StudyError, match="is assumed of the trajectory"):
        decided(wanted)
