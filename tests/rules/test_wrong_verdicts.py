"""False theorems that the rules once proved, each by a condition that one of them did not ask for.

The sentence below each name says what a solution does.
"""

import pytest

from symctrl import (
    Study,
    along_trajectory,
    apart,
    bounded,
    equal,
    exists,
    initially,
    nonzero,
    positive_definite,
    stays,
)
from symctrl.expr import lift
from symctrl.vectors import absolute, asin, atan, block, exp, sgn, sqrt
from tests.rules.theorem_rows import decided, states, theorem

WRONG = []


def wrong(build):
    WRONG.append(build)
    return build


@wrong
def existence_of_states_that_no_conclusion_reads():
    """x = 1/(1 - t)."""
    study, x = states("x")
    study.motion(x, x**2)
    return theorem(study, [exists()], lambda run: run.exists())


@wrong
def stays_carried_to_a_larger_set():
    """From (0, 10) the ellipse is left at once: x' = 100."""
    study, x, y = states("x", "y")
    study.motion(x, -x + 10 * y)
    study.motion(y, -10 * x - y)

    def lines(run):
        run.decays(x**2 + y**2, outside=1, rate=1)
        run.exists()
        run.carries(stays(x**2 + y**2 / 100 <= 1))

    return theorem(study, [stays(x**2 + y**2 / 100 <= 1)], lines)


@wrong
def stays_carried_from_what_is_kept():
    """x = -exp(-t), y = exp(-t): the sum x + y^2 is 0 at the beginning and negative after."""
    study, x, y = states("x", "y")
    study.motion(x, -x)
    study.motion(y, -y)
    lines = lambda run: (run.falls(x**2 + y**2), run.exists(), run.keeps(x, a=1))  # noqa: E731
    return theorem(study, [stays(x + y**2 >= 0)], lines)


@wrong
def definiteness_kept_by_one_entry():
    """a = 1, b = t: the matrix is definite at the beginning only."""
    study, a, b = states("a", "b")
    study.motion(a, lift(0))
    study.motion(b, lift(1))
    lines = lambda run: (run.keeps(a), run.falls(a), run.bounded(b, by=a))  # noqa: E731
    return theorem(study, [bounded(b)], lines, [initially(positive_definite(block([[a, b], [b, 1]])))])


@wrong
def nonzero_kept_as_if_it_were_positive():
    """x = -1 + t passes zero, and exp(1/x) has no bound to its right."""
    study, x = states("x")
    study.motion(x, lift(1))
    lines = lambda run: (run.keeps(x), run.exists(), run.falls(exp(1 / x)))  # noqa: E731
    return theorem(study, [bounded(exp(1 / x))], lines, [initially(nonzero(x))])


@wrong
def equation_kept_by_a_root():
    """x = t^2 / 4 begins at 0 too: x' is zero where x is, and is no multiple of x."""
    study, x = states("x")
    study.motion(x, sqrt(absolute(x)))
    return theorem(study, [bounded(x)], lambda run: (run.falls(x**2), run.exists()), [equal(x, 0)])


@wrong
def equation_kept_by_a_switch():
    """x = t begins at 0 too: a switch has every value in [-1, 1] there."""
    study, x = states("x")
    study.motion(x, sgn(x))
    return theorem(study, [bounded(x)], lambda run: (run.falls(x**2), run.exists()), [equal(x, 0)])


@wrong
def switch_on_a_surface_that_is_not_left():
    """x = 0, y = t is a solution in the sense of Filippov; the value sgn(0) = 0 is none of its."""
    study, x, y = states("x", "y")
    study.motion(x, lift(0))
    study.motion(y, sgn(x))
    return theorem(study, [bounded(y)], lambda run: (run.falls(y**2), run.exists()), [equal(x, 0)])


@wrong
def denominator_with_a_signal():
    """d = t up to 1, then 0: the solution turns infinitely often before t = 1 and ends there."""
    study, x, y = states("x", "y")
    d = study.disturbance("d")
    study.assume(1 - d > 0, about="signal")
    study.motion(x, y / (1 - d))
    study.motion(y, -x / (1 - d))
    return theorem(study, [bounded(x, y)], lambda run: (run.falls(x**2 + y**2), run.exists()))


@wrong
def positive_signal_taken_for_apart_from_zero():
    """d = exp(-t)."""
    study, x = states("x")
    d = study.disturbance("d")
    study.assume(d > 0, about="signal")
    study.motion(x, -d * x)
    return theorem(study, [apart(d)], lambda run: (run.falls(x**2), run.exists()))


@wrong
def positive_trajectory_taken_for_apart_from_zero():
    """x = exp(-t)."""
    study, x = states("x")
    study.motion(x, -x)
    return theorem(study, [apart(x)], lambda run: (run.falls(x**2), run.exists()), [along_trajectory(x > 0)])


@wrong
def existence_up_to_an_edge_that_is_reached():
    """x = sqrt(1 - 2 t) is positive as long as it exists, and ends at t = 1/2."""
    study, x = states("x")
    study.motion(x, -1 / x)
    lines = lambda run: (run.falls(x**2), run.exists())  # noqa: E731
    return theorem(study, [bounded(x)], lines, [along_trajectory(x > 0)])


@wrong
def law_without_a_value():
    """The arcsine of 2 + x^2 is nowhere defined."""
    study, x, y = states("x", "y")
    study.motion(x, -x)
    study.motion(y, asin(2 + x**2))
    return theorem(study, [bounded(x, atan(y))], lambda run: (run.falls(x**2), run.exists()))


@wrong
def subsystem_of_a_loop_that_escapes():
    """With m' = m^2 no solution of the whole loop exists for all time, and the theorem says that all do."""
    study = Study("loop")
    x, m = study.state("x"), study.state("m")
    study.motion(x, -x)
    study.motion(m, m**2)
    return theorem(study, [bounded(x), exists()], lambda run: (run.falls(x**2), run.exists()))


@pytest.mark.parametrize("build", WRONG, ids=lambda build: build.__name__)
def test_a_false_theorem_is_not_proved(build):
    row, _ = decided(build())
    assert row.verdict != "proved"
