"""Theorems that are false for one forgotten assumption: never proved, and the reason names what is missing.

Here: what falls, decays, is kept, and exists.
From the textbooks: Khalil, Nonlinear Systems; Slotine and Li, Applied Nonlinear Control.
"""

import pytest

from symctrl import Study, bounded, equal, exists, exponentially, initially, settles, stays, tends
from symctrl.expr import lift
from symctrl.vectors import absolute, power, sgn, signed_power, sqrt, stack, tan, tanh
from tests.rules.theorem_rows import assert_open, collector, states, theorem

FALSE, false = collector()


# falls


@false("V is bounded below", "line 1, falls: V is bounded below")
def v_falls_without_a_lower_bound():
    study, x = states("x")
    study.motion(x, lift(1))
    return theorem(study, [bounded(x)], lambda run: run.falls(-x))


@false("V is bounded below", "falls: V is bounded below")
def v_bounded_below_at_the_beginning_only():
    study, x = states("x")
    study.motion(x, lift(-1))
    return theorem(study, [bounded(x)], lambda run: (run.exists(), run.falls(x)), [initially(x >= 0)])


@false("V falls", "falls: V falls")
def an_assumption_about_parameters_that_reads_a_state():
    study, x = states("x")
    study.motion(x, lift(1))
    return theorem(study, [bounded(x)], lambda run: (run.exists(), run.falls(x**2)), [x <= 0])


@false("V falls", "falls: V falls")
def time_varying_with_frozen_eigenvalues_to_the_left():
    """Khalil, example 4.22: eigenvalues -1/4 +- i sqrt(7)/4 at every time, and solutions grow."""
    study, x, y, c, n = states("x", "y", "c", "n")
    study.motion(c, -n)
    study.motion(n, c)
    study.motion(x, (-1 + "3/2" * c**2) * x + (1 - "3/2" * n * c) * y)
    study.motion(y, (-1 - "3/2" * n * c) * x + (-1 + "3/2" * n**2) * y)
    return theorem(study, [bounded(x)], lambda run: run.falls(x**2 + y**2), [equal(c**2 + n**2, 1)])


@false("part 1 is not negative", "falls: part 1 is not negative")
def sliding_mode_below_the_disturbance():
    study, x = states("x")
    K, D = study.gain("K"), study.gain("D")
    d = study.disturbance("d", bound=D)
    study.motion(x, -K * sgn(x) + d)
    part = (K - D) * absolute(x)

    def lines(run):
        run.falls(x**2 / 2, by=part)
        run.exists()
        run.barbalat(x, of=part, least=K - D, power=1)

    return theorem(study, [tends(x)], lines, [bounded(d)])


@false("input 1 is summable", "falls: input 1 is summable")
def disturbance_of_infinite_energy():
    study, x = states("x")
    d = study.disturbance("d")
    study.motion(x, -x + d)
    return theorem(study, [bounded(x)], lambda run: run.falls(x**2, by=x**2, plus=d**2))


@false("V is differentiable, switches", "V is differentiable, switches: it has a kink")
def kink_under_a_product_of_switches():
    study, x, y = states("x", "y")
    study.motion(x, -sgn(x) * sgn(y) ** 2)
    study.motion(y, -y)
    return theorem(study, [bounded(x)], lambda run: (run.falls(absolute(x)), run.exists()))


# exists


@false("x stays finite", "exists: x stays finite")
def escape_in_finite_time():
    study, x = states("x")
    study.motion(x, x**2)
    return theorem(study, [exists(), stays(x >= 0)], lambda run: (run.keeps(x), run.exists()))


@false("x stays finite", "exists: x stays finite")
def cascade_with_a_product():
    """Each part alone is stable, and the peak of the driving one lets the other escape."""
    study, x, y = states("x", "y")
    study.motion(x, -x + x**2 * y)
    study.motion(y, -y)
    return theorem(study, [tends(x)], lambda run: (run.decays(y**2, a=2), run.exists()))


@false("m[1] stays finite", "exists: m[1] stays finite")
def rodrigues_parameters_of_a_full_turn():
    """A constant rate turns the body by 360 degrees, where they are infinite."""
    study = Study("loop")
    m, w = study.state("m", 3), study.state("w")
    first = m[0]
    along = (1 + first**2 - m[1] ** 2 - m[2] ** 2) * w / 4
    study.motion(m, stack(along, (first * m[1] + m[2]) * w / 2, (first * m[2] - m[1]) * w / 2))
    study.motion(w, lift(0))
    return theorem(study, [bounded(m)], lambda run: (run.falls(w**2), run.exists()))


@false("the field stays defined", "exists: roll stays finite")
def euler_angles_at_ninety_degrees():
    study, roll, pitch, w = states("roll", "pitch", "w")
    study.motion(roll, w * tan(pitch))
    study.motion(pitch, w)
    study.motion(w, -w)
    return theorem(study, [tends(w), bounded(tanh(roll))], lambda run: (run.decays(w**2, a=2), run.exists()))


# decays


@false(None, "no line gives that x tends to zero")
def offset_and_yet_to_zero():
    study, x = states("x")
    study.motion(x, -x + 1)
    return theorem(study, [tends(x)], lambda run: (run.decays(x**2, a=1, c=1), run.exists()))


@false("gamma is below one", "decays: gamma is below one")
def finite_time_with_a_linear_law():
    study, x = states("x")
    study.motion(x, -x)
    lines = lambda run: run.decays(x**2, power=(2, 1, absolute(x)))  # noqa: E731
    return theorem(study, [settles(equal(x, 0))], lines)


@false("gamma is below one", "decays: gamma is below one")
def finite_time_with_a_high_power():
    study, x = states("x")
    study.motion(x, -signed_power(x, 2))
    lines = lambda run: run.decays(x**2, power=(2, 2, absolute(x)))  # noqa: E731
    return theorem(study, [settles(equal(x, 0))], lines)


@false("gamma is not negative", "decays: gamma is not negative")
def finite_time_with_a_negative_exponent():
    study, x = states("x")
    study.motion(x, -x)
    lines = lambda run: run.decays(x**2, power=(1, "-1/2", absolute(x)))  # noqa: E731
    return theorem(study, [settles(equal(x, 0))], lines)


@false("the time is late enough", "decays: the time is late enough")
def half_the_settling_time():
    study, x = states("x")
    study.motion(x, -signed_power(x, "1/2"))
    time = power(absolute(x), "1/2")
    lines = lambda run: run.decays(x**2, power=(2, "1/2", absolute(x)), time=time)  # noqa: E731
    return theorem(study, [settles(equal(x, 0), by=time)], lines)


@false("the rate is positive", "decays: the rate is positive")
def gain_that_may_be_zero():
    study, x = states("x")
    k = study.parameter("k", low=0)
    study.motion(x, -k * x)
    return theorem(study, [tends(x)], lambda run: run.decays(x**2, a=2 * k))


@false("V falls at the radius", "decays: V falls at the radius")
def ultimate_bound_of_half_the_size():
    study, x = states("x")
    D, d = study.gain("D"), study.disturbance("d")
    study.motion(x, -x + d)
    lines = lambda run: run.decays(x**2, a=1, c=D**2, radius=D**2 / 2)  # noqa: E731
    return theorem(study, [settles(x**2 <= D**2 / 2)], lines, [d**2 <= D**2])


@false("V decays", "decays: V decays")
def local_region_taken_for_the_whole():
    study, x = states("x")
    study.motion(x, -x + x**3)
    return theorem(study, [tends(x)], lambda run: run.decays(x**2, a=1), [initially(x**2 <= 2)])


@false(None, "no line gives that x decays exponentially")
def twice_the_rate():
    study, x = states("x")
    k = study.gain("k")
    study.motion(x, -k * x)
    return theorem(study, [exponentially(x, 2 * k)], lambda run: run.decays(x**2, a=2 * k))


@false(None, "no line gives that x tends to zero")
def input_that_is_bounded_and_does_not_vanish():
    study, x, y = states("x", "y")
    study.motion(x, -x + y)
    study.motion(y, lift(0))
    return theorem(study, [tends(x)], lambda run: (run.falls(y**2), run.decays(x**2, a=1, input=y**2)))


@false("the input is known", "decays: the input is known")
def disturbance_without_a_bound():
    study, x = states("x")
    d = study.disturbance("d")
    study.motion(x, -x + d)
    return theorem(study, [bounded(x)], lambda run: run.decays(x**2, a=1, input=d**2))


# keeps


@false("g is kept", "keeps: g is kept")
def root_that_is_zero_on_the_boundary():
    """g' = 0 where g = 0, and yet g is left in finite time the other way."""
    study, x = states("x")
    study.motion(x, -sqrt(absolute(x)))
    return theorem(study, [stays(x >= 0)], lambda run: run.keeps(x))


@false("g is kept", "keeps: g is kept")
def constant_harvest():
    study, x = states("x")
    h = study.gain("h")
    study.motion(x, x * (1 - x) - h)
    return theorem(study, [stays(x >= 0)], lambda run: run.keeps(x, a=x - 1))


@false("a has no signal", "keeps: a has no signal")
def boundary_pushed_by_a_signal():
    study, x = states("x")
    d = study.disturbance("d", bound=1)
    study.motion(x, -x + d)
    return theorem(study, [stays(x >= 0)], lambda run: run.keeps(x, a=1 - d / x))


@pytest.mark.parametrize(("build", "role", "reason"), FALSE, ids=lambda x: x.__name__ if callable(x) else "")
def test_a_false_theorem_is_not_proved(build, role, reason):
    assert_open(build(), role, reason)
