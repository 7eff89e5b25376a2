"""False theorems that were once proved by what an assumption says of limits, of later times, or at a jump.

The sentence below each name is a solution for which the theorem is wrong.
"""

import pytest

from symctrl import along_trajectory, apart, bounded, initially, positive_definite, summable, tends
from symctrl.expr import lift
from symctrl.vectors import block, power, sgn
from symctrl.written import StudyError
from tests.rules.theorem_rows import assert_open, collector, decided, states, theorem

WRONG, wrong = collector()


# what is divided by does not stay apart from zero because solutions exist


def quotient_of_a_clock(then):
    """x' = -x (1 + y^2), y' = 1, where 1/(1 + y^2) is what x' divides by."""
    study, x, y = states("x", "y")
    q = 1 / (1 + y**2)
    study.motion(x, -x / q)
    study.motion(y, lift(1))
    return theorem(study, [then(q)], lambda run: (run.falls(x**2), run.exists()))


@wrong(None, "no line gives that 1/(1 + y^2) stays apart from zero")
def apart_because_solutions_exist():
    """x = 0, y = t: the divisor is 1/(1 + t^2)."""
    return quotient_of_a_clock(apart)


@wrong(None, "no line gives that 1/(1/(1 + y^2)) stays bounded")
def bounded_because_solutions_exist():
    """x = 0, y = t: one over the divisor is 1 + t^2."""
    return quotient_of_a_clock(lambda q: bounded(1 / q))


# an assumption may leave out a part of the boundary by what it divides by


@wrong("d is nonzero", "line 2, exists: d is nonzero")
def signal_whose_inverse_is_assumed():
    """d = 1 - t up to t = 1, then 1: the solution turns infinitely often before t = 1 and ends there."""
    study, x, y = states("x", "y")
    d = study.disturbance("d")
    study.assume(1 / d >= 1, about="signal")
    study.motion(x, y / d)
    study.motion(y, -x / d)
    return theorem(study, [bounded(x, y)], lambda run: (run.falls(x**2 + y**2), run.exists()))


def falling_into_zero(along):
    """x' = -1/x, and what is assumed along the trajectory."""
    study, x = states("x")
    study.motion(x, -1 / x)
    lines = lambda run: (run.falls(x**2), run.exists())  # noqa: E731
    return theorem(study, [bounded(x)], lines, [along_trajectory(along(x))])


@wrong("x is nonzero", "line 2, exists: x is nonzero")
def trajectory_whose_inverse_is_assumed():
    """x = sqrt(1 - 2 t) has 1/x >= 0 as long as it exists, and ends at t = 1/2."""
    return falling_into_zero(lambda x: 1 / x >= 0)


@wrong("x is nonzero", "line 2, exists: x is nonzero")
def trajectory_in_an_open_set_of_matrices():
    """x = sqrt(1 - 2 t) has diag(x, 1) positive definite as long as it exists, and ends at t = 1/2."""
    return falling_into_zero(lambda x: positive_definite(block([[x, 0], [0, 1]])))


# a switch has every value at its jump


@wrong(None, "no line gives that the integral of |(1 - sgn(a))*y^2| is finite")
def conclusion_that_jumps():
    """a = 0, y = 1 with the value 1 of the switch; the integrand with sgn(0) = 0 is 1 for all time."""
    study, a, y = states("a", "y")
    study.motion(a, 1 - sgn(a))
    study.motion(y, -(1 - sgn(a)) * y)
    lines = lambda run: (run.falls(y**2, by=2 * (1 - sgn(a)) * y**2), run.exists())  # noqa: E731
    return theorem(study, [summable((1 - sgn(a)) * y**2)], lines)


# limit sets: signals have no limits, and an assumption may not hold at limits


@wrong("d has no signal", "line 3, lasalle: d has no signal: it depends on d")
def limit_of_a_signal():
    """v = exp(-t), d = exp(t)."""
    study, v = states("v")
    d = study.disturbance("d")
    study.assume(v * d**4 >= d**2, about="signal")
    study.motion(v, -v)
    lines = lambda run: (run.falls(v**2), run.exists(), run.lasalle(v**2, zero=v, limit=[d]))  # noqa: E731
    return theorem(study, [tends(d)], lines)


def fading(bind):
    """v' = -v, y' = -v^2 (y - 1), and what is assumed of v by the study, or along the trajectory."""
    study, v, y = states("v", "y")
    given = bind(study, v)
    study.motion(v, -v)
    study.motion(y, -(v**2) * (y - 1))

    def lines(run):
        run.falls(v**2)
        run.falls((y - 1) ** 2)
        run.bounded(y - 1, by=(y - 1) ** 2)
        run.bounded(y)
        run.exists()
        run.lasalle((y - 1) ** 2, zero=y - 1, limit=[y - 1])

    return theorem(study, [tends(y - 1)], lines, given)


@wrong("V' = 0 gives zero 1", "lasalle: V' = 0 gives zero 1")
def limit_at_which_no_signal_is_admissible():
    """v = exp(-t), y = 1 + exp(exp(-2 t)/2), d = exp(t/2) has v d^2 = 1, which no d has in the limit."""

    def bind(study, v):
        d = study.disturbance("d")
        study.assume(v * d**2 >= 1, about="signal")
        return []

    return fading(bind)


@wrong("V' = 0 gives zero 1", "lasalle: V' = 0 gives zero 1")
def limit_outside_an_open_set_of_matrices():
    """v = exp(-t), y = 1 + exp(exp(-2 t)/2): diag(v, 1) is positive definite, and not in the limit."""
    return fading(lambda _, v: [along_trajectory(positive_definite(block([[v, 0], [0, 1]])))])


@wrong("V' = 0 gives zero 1", "lasalle: V' = 0 gives zero 1")
def limit_at_which_an_assumption_has_no_value():
    """v = exp(-t), y = 1 + exp(exp(-2 t)/2): 1/v is positive, and has no value in the limit."""
    return fading(lambda _, v: [along_trajectory(1 / v >= 0)])


@pytest.mark.parametrize(("build", "role", "reason"), WRONG, ids=lambda x: getattr(x, "__name__", ""))
def test_a_false_theorem_is_undecided(build, role, reason):
    assert_open(build(), role, reason)


@wrong("e is positive", "line 2, holds: e is positive: the value is 0 <= 0")
def power_of_a_gain_is_taken_for_a_division():
    """x = 0, y = t, z = exp(-t): x^p has a value at x = 0, for p > 0."""
    study, x, y, z = states("x", "y", "z")
    p = study.gain("p")
    study.motion(x, lift(0))
    study.motion(y, 1 - sgn(x))
    study.motion(z, -z - power(x, p) * z)

    def lines(run):
        run.keeps(x, a=0)
        run.holds(x > 0)
        run.falls(x**2)
        run.falls(y**2)
        run.falls(z**2)
        run.exists()

    return theorem(study, [bounded(y)], lines, [initially(x >= 0)])


def test_a_fact_that_jumps_cannot_be_supposed():
    """a = 0, x = 1 with the value 1 of the switch, though sgn(a) = 0 tends to zero."""
    study, x, a = states("x", "a")
    study.motion(a, lift(0))
    study.motion(x, -x + sgn(a))

    def lines(run):
        run.falls(a**2)
        run.decays(x**2, a=1, input=sgn(a) ** 2)
        run.exists()

    supposing = theorem(study, [tends(x)], lines, [tends(sgn(a))])
    with pytest.raises(StudyError, match=r"sgn\(a\) tends to zero cannot be supposed: it jumps"):
        decided(supposing)
