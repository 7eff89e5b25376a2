"""What holds at every state, a term of a sum, and the sign of what the field divides by: true and false."""

import pytest

from symctrl import Study, apart, bounded, equal, initially, nonzero, stays, tends
from symctrl.expr import lift
from symctrl.theorem import Run
from symctrl.vectors import absolute, sgn, sqrt
from tests.rules.theorem_rows import assert_open, assert_proved, collector, decided, states, theorem

PROVED = []
FALSE, false = collector()


def proved(build):
    PROVED.append(build)
    return build


def repelled(lines, then, given=lambda x, c: [initially(x > 0), initially(x >= c)]):
    """x' = -x + 1/x, and a constant c from 0 to 1."""
    study, x = states("x")
    c = study.parameter("c")
    study.motion(x, -x + 1 / x)

    def whole(run):
        lines(run, x, c)
        run.decays(x**2, a=2, c=2)
        run.exists()

    return theorem(study, then(x, c), whole, [c > 0, c <= 1, *given(x, c)])


def above(run, x, c):
    """(x - c)' >= -(x + c)/x (x - c), for x > 0."""
    run.keeps(x - c, a=(x + c) / x)


# by the sign of what the field divides by


@proved
def positive_because_the_field_divides_by_it():
    return repelled(
        lambda run, x, c: (run.keeps(x > 0), above(run, x, c)), lambda x, c: [stays(x >= c), bounded(x)]
    )


@proved
def nonzero_because_the_field_divides_by_it():
    study, x, y = states("x", "y")
    c = study.parameter("c")
    study.motion(x, 1 - x)
    study.motion(y, -y * (1 + 1 / x))

    def lines(run):
        run.holds(nonzero(x))
        run.keeps(x - c, a=1)
        run.decays((x - 1) ** 2, a=2)
        run.falls(y**2, by=2 * y**2)
        run.exists()

    return theorem(study, [stays(x >= c)], lines, [c > 0, c <= 1, initially(x >= c)])


@proved
def apart_because_the_field_divides_by_it():
    """x' = 1/x: the rate of x^2 is 2 where x is not zero."""
    study, x = states("x")
    c = study.gain("c")
    study.motion(x, 1 / x)

    def lines(run):
        run.holds(x**2 > 0)
        run.keeps(x**2 - c)
        run.apart(x, least=c)
        run.exists()

    return theorem(study, [apart(x)], lines, [initially(x**2 >= c)])


@false("g is kept", "line 1, keeps: g is kept")
def sign_that_is_not_kept():
    """True, and not by this line alone: without x > 0 it is not so that (x - c)' >= -(x + c)/x (x - c)."""
    return repelled(above, lambda x, c: [stays(x >= c)])


@false("g is kept", "line 1, keeps: g is kept")
def sign_of_what_is_not_divided_by():
    """x = 1 + exp(-t) goes below 3/2, and to 1."""
    return repelled(
        lambda run, x, c: run.keeps(x - 1 > 0),
        lambda x, c: [stays(x >= 1)],
        lambda x, c: [initially(x - 1 > 0)],
    )


@false("g is kept", "line 1, keeps: g is differentiable: sgn(x) jumps")
def sign_that_jumps():
    """x = 1 - t."""
    study, x = states("x")
    study.motion(x, lift(-1))
    lines = lambda run: (run.keeps(sgn(x) > 0), run.holds(x >= 0), run.falls(x), run.exists())  # noqa: E731
    return theorem(study, [bounded(x)], lines, [initially(sgn(x) > 0)])


@false("g is kept", "line 1, keeps: g is kept")
def sign_of_what_is_under_a_root():
    """x = (1 - t/2)^2 up to t = 2, then 0: the field has a value there, and y = t - 2 after it."""
    study, x, y = states("x", "y")
    study.motion(x, -sqrt(x))
    study.motion(y, 1 - sgn(x))
    lines = lambda run: (run.keeps(x > 0), run.falls(x**2), run.falls(y**2), run.exists())  # noqa: E731
    return theorem(study, [bounded(y)], lines, [initially(x > 0)])


# what holds at every state


@proved
def what_holds_is_an_assumption_of_the_lines_below():
    study, x, y = states("x", "y")
    study.motion(x, -x * (x**2 + y**2 - 2 * x * y + 1))
    study.motion(y, -y)

    def lines(run):
        run.holds(x**2 + y**2 - 2 * x * y >= 0)
        run.falls(x**2, by=2 * x**2)
        run.falls(y**2)
        run.exists()

    return theorem(study, [tends(x)], lambda run: (lines(run), run.barbalat(x)))


def claims(claim):
    """x' = -x, and a claim of every state."""
    study, x = states("x")
    study.motion(x, -x)
    return theorem(study, [bounded(x)], lambda run: (run.holds(claim(x)), run.falls(x**2), run.exists()))


@proved
def strict():
    return claims(lambda x: x**2 + 1 > 0)


@proved
def an_equation():
    return claims(lambda x: equal(absolute(x) ** 2, x**2))


@proved
def not_zero():
    return claims(lambda x: nonzero(x**2 + 1))


@false("e is nonnegative", "line 1, holds: e is nonnegative")
def what_is_negative_somewhere():
    """x = -1."""
    return claims(lambda x: x >= 0)


@false("e is positive", "line 1, holds: e is positive")
def what_is_zero_somewhere():
    """x = 0."""
    return claims(lambda x: x**2 > 0)


@false("e is zero", "line 1, holds: e is zero")
def equation_at_one_state():
    return claims(lambda x: equal(x, 1))


@false("e is nonzero", "line 1, holds: e is nonzero")
def zero_at_one_state():
    return claims(lambda x: nonzero(x - 1))


# a term of a sum


def fleet(lines):
    study = Study("loop")
    team = study.fleet()
    x, i, j = team.state("x"), team.node, team.neighbour
    team.motion(x, lambda n: -x[n])
    return theorem(study, [bounded(x[i])], lambda run: lines(run, team, x, i, j))


@proved
def term_of_a_sum():
    """Each |x_i|^2 is at most c, for their sum is, and does not rise."""
    study = Study("loop")
    team = study.fleet()
    x, i, j = team.state("x"), team.node, team.neighbour
    c = study.gain("c")
    team.motion(x, lambda n: -team.sum(j, x[n] - x[j], at=n))
    whole = team.sum(i, x[i] ** 2)

    def lines(run):
        run.falls(whole)
        run.bounded(x[i], by=whole)
        run.keeps(c - whole)
        run.part(x[i] ** 2, of=whole)
        run.holds(c - x[i] ** 2 >= 0)
        run.apart(2 * c - x[i] ** 2, least=c**2)
        run.exists()

    bound = team.eigenvalues_at_most(study.gain("Lambda"))
    return theorem(study, [apart(2 * c - x[i] ** 2)], lines, [bound, initially(c - whole >= 0)])


@false("the term is not negative", "part: the term is not negative")
def term_that_may_be_negative():
    """x_1 = -1, x_2 = 1: the sum is zero, and 1 is above it."""

    def lines(run, team, x, i, j):
        run.part(x[i], of=team.sum(i, x[i]))
        run.exists()

    return fleet(lines)


@false("the total is that of the term", "part: the total is that of the term")
def sum_of_another_term():
    def lines(run, team, x, i, j):
        run.part(2 * x[i] ** 2, of=team.sum(i, x[i] ** 2))
        run.exists()

    return fleet(lines)


@false("the total is that of the term", "part: the total is that of the term")
def sum_over_the_neighbours():
    def lines(run, team, x, i, j):
        run.part(x[i] ** 2, of=team.sum(j, x[j] ** 2, at=i))
        run.exists()

    return fleet(lines)


@pytest.mark.parametrize("build", PROVED, ids=lambda build: build.__name__)
def test_it_is_proved(build):
    assert_proved(build())


@pytest.mark.parametrize(("build", "role", "reason"), FALSE, ids=lambda x: getattr(x, "__name__", ""))
def test_it_is_undecided(build, role, reason):
    assert_open(build(), role, reason)


def test_a_line_takes_a_claim():
    with pytest.raises(TypeError, match="holds takes an equation, a bound or nonzero"):
        Run().holds(bounded(1))


def test_what_has_no_value_somewhere_is_kept_as_far_as_it_has():
    """x = t - 1 passes the pole of -1/x, which the condition leaves out: the theorem does not stand."""
    study, x = states("x")
    study.motion(x, lift(1))
    lines = lambda run: (run.keeps(-1 / x > 0), run.holds(-x >= 0), run.falls(-x), run.exists())  # noqa: E731
    row, _ = decided(theorem(study, [bounded(x)], lines, [initially(-1 / x > 0)]))
    assert not row.stands
    assert [met.condition for met in row.conditions] == ["x != 0"]
