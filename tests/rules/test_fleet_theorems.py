"""Theorems about a fleet on any connected graph: agreement, and what it does not say."""

from symctrl import Study, bounded, tends
from tests.rules.theorem_rows import assert_open, assert_proved, theorem


def agreement(then, more):
    """x_i' = -(L x)_i: what is concluded and how, from the sum of squares."""
    study = Study("loop")
    fleet = study.fleet()
    x, i, j = fleet.state("x"), fleet.node, fleet.neighbour
    fleet.motion(x, lambda i: -fleet.sum(j, x[i] - x[j], at=i))
    half = fleet.sum(i, x[i] * x[i] / 2)
    form = fleet.sum(i, x[i] * fleet.sum(j, x[i] - x[j]))
    squares = fleet.sum(i, fleet.sum(j, (x[i] - x[j]) * (x[i] - x[j])))

    def lines(run):
        run.falls(half, by=form)
        run.bounded(x[i], by=half, least="1/2")
        run.exists()
        more(run, x[i], x[i] - x[j], form, squares)

    bound = fleet.eigenvalues_at_most(study.gain("Lambda"))
    return theorem(study, then(x[i], x[i] - x[j]), lines, [bound])


def test_states_stay_bounded():
    assert_proved(agreement(lambda x, e: [bounded(x)], lambda *_: None))


def test_neighbours_agree():
    def more(run, x, e, form, squares):
        run.barbalat(form)
        run.tends(squares, by=form, times=2)
        run.tends(e, by=squares)

    assert_proved(agreement(lambda x, e: [tends(e)], more))


def test_agreement_is_not_at_zero():
    """The Laplacian has a kernel: all states may be equal and stay where they are."""
    study = agreement(lambda x, e: [tends(x)], lambda run, x, *_: run.barbalat(x))
    assert_open(study, "W bounds the power of e", "barbalat: W bounds the power of e")
