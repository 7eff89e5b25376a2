"""Counterexamples that refute a theorem, and those that do not, each with its reason."""

from fractions import Fraction

import pytest

from symctrl import claim
from symctrl.counterexample import along, at, enclosed, leaves, t, unstable
from symctrl.facts import (
    apart,
    bounded,
    enters,
    eventually,
    exists,
    exponentially,
    settles,
    stable,
    stays,
    summable,
    tends,
)
from symctrl.kernel.check import check_text
from symctrl.rules.against import Refuted, contradict
from symctrl.rules.loop import Loop
from symctrl.statements import equal
from symctrl.theorem import along_trajectory, initially
from symctrl.vectors import absolute, cos, exp, maximum, sgn, sin, sqrt, tanh
from tests.rules import systems


def offered(study, theorem, counterexample, against=None):
    return contradict(Loop(study, theorem, "theorem"), counterexample, against)


def refuted(study, then, counterexample, against=None, given=()):
    found = offered(study, claim(given=list(given), then=then), counterexample, against)
    assert isinstance(found, Refuted), found
    return found


def refused(why, study, then, counterexample, against=None, given=()):
    found = offered(study, claim(given=list(given), then=then), counterexample, against)
    assert isinstance(found, str), found.says
    assert why in found
    assert "\n" not in found


class TestRestPoints:
    def test_the_other_one(self):
        study, x, v = systems.duffing()
        found = refuted(study, [tends(v), tends(x - 1)], at(x=-1, v=0))
        assert found.witness == {"x": "-1", "v": "0"}
        assert found.certificate["proof"]["then"] == 1
        assert found.says == (
            "at x = -1, v = 0 every rate is zero, so that it is not true that x - 1 tends to zero"
        )

    @pytest.mark.parametrize(
        "fact",
        [
            exponentially,
            lambda x: exponentially(x, 1),
            summable,
            lambda x: settles(x >= 0),
            lambda x: eventually(absolute(x) <= "1/2"),
            lambda x: enters(equal(x, 0)),
            lambda x: enters(x >= 0, by=7),
            lambda x: bounded(x, by="1/2"),
            lambda x: apart(x + 1),
        ],
    )
    def test_contradict_every_word_about_limits(self, fact):
        study, x, _ = systems.duffing()
        refuted(study, [fact(x)], at(x=-1, v=0), fact(x))

    @pytest.mark.parametrize(
        "fact",
        [
            lambda x: tends(x + 1),
            lambda x: exponentially(x, -1),
            bounded,
            lambda x: bounded(x, by=1),
            lambda x: stays(x >= 0),
            lambda x: settles(x >= -1),
            apart,
            lambda x: exists(),
        ],
    )
    def test_do_not_contradict_what_holds_of_constants(self, fact):
        study, x, _ = systems.duffing()
        refused("does not contradict the conclusion", study, [fact(x)], at(x=-1, v=0), fact(x))

    def test_reasons(self):
        study, x, v = systems.duffing()
        then = [tends(x - 1), tends(v)]
        refused("the rate of v is -6", study, then, at(x=2, v=0))
        refused("no value is given for v", study, then, at(x=-1))
        refused("y is no symbol of duffing; it has x, v", study, then, at(x=-1, y=0))
        refused("x has 1 component, and 2 values", study, then, at(x=[0, 1], v=0))
        refused("contradicts no conclusion", study, then, at(x=1, v=0))
        refused("does not conclude that x tends to zero, but that", study, then, at(x=-1, v=0), tends(x))
        refused("not an exact number", study, then, at(x=t, v=0))
        refused("has no graph", study, then, at({"x": -1}, graph="path:2", v=0))

    def test_of_a_quaternion_by_its_symbols(self):
        study, q, omega = systems.attitude()
        then = [tends(omega, q.vector), tends(1 - q.scalar)]
        rest = {"q": [0, 0, 0], "omega": [0, 0, 0]}
        found = refuted(study, then, at(rest, q0=-1, c=5))
        assert found.witness["J[1,2]"] == "3/10"
        assert found.witness["k"] == "2"
        refused('assumption 1, "q\'*q + q0^2 = 1"', study, then, at(rest, q0=-2, c=5))
        refused("'c > 0'", study, then, at(rest, q0=-1, c=-5))
        refused("no value is given for c", study, then, at(rest, q0=-1))
        refused("u[1] is given by the law", study, then, at(rest, q0=-1, c=5, u=[0, 0, 0]))

    def test_with_a_constant_signal(self):
        study, x, w, _ = systems.disturbed()
        refuted(study, [tends(x)], at(x=1, w=1, D=1))
        refused("'D - w[1] >= 0'", study, [tends(x)], at(x=2, w=2, D=1))
        refused("supposed (tends)", study, [tends(x)], at(x=1, w=1, D=1), given=[tends(w)])
        refuted(study, [tends(x)], at(x=1, w=1, D=1), given=[bounded(w)])

    def test_of_which_an_assumption_about_the_trajectory_speaks(self):
        study, x, _v = systems.duffing()
        kept = [along_trajectory(x >= 0)]
        refused("'x >= 0'", study, [tends(x - 1)], at(x=-1, v=0), given=kept)
        refuted(study, [tends(x - 1)], at(x=0, v=0), given=kept)

    def test_of_a_fleet(self):
        study, _, y, i = systems.consensus()
        then = [tends(y[i])]
        found = refuted(study, then, at({"y.1": 2, "y.2": 2, "y.3": 2}, graph="path:3"))
        assert found.witness["graph"] == [["1", "2"], ["2", "3"]]
        refused("the rate of y.1", study, then, at({"y.1": 2, "y.2": 3}, graph="path:2"))
        refused("no value is given for y.2", study, then, at({"y.1": 2}, graph="path:2"))
        refused("needs a graph", study, then, at({"k": 1}))
        refused("z.1 is no symbol", study, then, at({"z.1": 2, "y.2": 3}, graph="path:2"))


class TestRestPointsOnASwitch:
    def test_where_friction_holds_the_mass(self):
        study, x, _ = systems.friction()
        found = refuted(study, [tends(x)], at(x=1, v=0))
        assert found.certificate["proof"]["switches"] == ["-1/2"]

    def test_where_it_does_not(self):
        study, x, _ = systems.friction()
        refused("the rate of v is -3", study, [tends(x)], at(x=3, v=0))

    def test_beside_a_root_of_the_same_argument(self):
        study, x, _v = systems.reaching()
        refuted(study, [tends(x + 1)], at(x=0, v=0))

    def test_a_state_that_an_equation_binds(self):
        study, x, v = systems.friction()
        given = [initially(equal(v, 0))]
        refused("dependent", study, [tends(x)], at(x=1, v=0), given=given)

    def test_a_product_of_switches(self):
        study, x, _v = systems.friction(lambda x, v: -x + 2 * sgn(v) * sgn(x - 1))
        refused("not affine in switches", study, [tends(x)], at(x=1, v=0))

    def test_arguments_with_dependent_gradients(self):
        study, x, _v = systems.friction(lambda x, v: -x + sgn(2 * v) * 2)
        refused("dependent", study, [tends(x)], at(x="1/2", v=0))

    def test_an_argument_with_a_kink(self):
        study, x = systems.scalar(lambda x: 1 - 2 * sgn(absolute(x)))
        refused("gradient", study, [tends(x + 1)], at(x=0))

    def test_a_switch_in_the_conclusion(self):
        study, _x, v = systems.friction()
        refused("at its jump", study, [tends(sgn(v) + 1)], at(x=1, v=0))


class TestClosedForms:
    def test_an_oscillation(self):
        study, x, v, _ = systems.oscillator()
        path = along(x=cos(2 * t), v=-2 * sin(2 * t), k=4)
        found = refuted(study, [tends(x)], path)
        assert found.witness == {"x": "cos(2*t)", "v": "-2*sin(2*t)", "k": "4"}
        assert "(by c = 1, k = 1/4)" in found.says
        for fact in (
            exponentially(x, 1),
            settles(equal(x, 0)),
            eventually(equal(v, 0)),
            stays(2 * x >= 1),
            settles(x >= "-1/2", by=1),
            enters(x <= -2),
            eventually(x <= -2),
        ):
            refuted(study, [fact], path)
        for fact in (bounded(x), enters(x <= 0), stays(absolute(x) <= 1), settles(x <= 0)):
            refused("contradicts no conclusion", study, [fact], path)

    def test_one_that_is_zero_once(self):
        study, x, *_ = systems.oscillator()
        refuted(study, [apart(x)], along(x=sin(t), v=cos(t), k=1))

    def test_a_decay(self):
        study, x = systems.scalar(lambda x: -x)
        refuted(study, [stays(x >= 1)], along(x=exp(-t)))
        refused("contradicts no", study, [stays(x >= 0)], along(x=exp(-t)))
        refused("does not begin in the set", study, [stays(x >= 2)], along(x=exp(-t)), stays(x >= 2))

    def test_growth(self):
        study, x = systems.scalar(lambda x: x**2 * 0 + 1)
        refuted(study, [bounded(x)], along(x=t))
        refuted(study, [bounded(x, by=3)], along(x=t))
        refuted(study, [summable(x)], along(x=t + 1))
        refused("contradicts no", study, [enters(x >= 1)], along(x=t))
        refuted(study, [enters(x >= 1, by="1/2")], along(x=t, until="3/4"))
        refused("contradicts no", study, [enters(x >= 1, by=2)], along(x=t, until="3/4"))

    def test_a_blow_up(self):
        study, x = systems.scalar(lambda x: x**2)
        found = refuted(study, [tends(x)], along(x=1 / (1 - t), until=1))
        assert found.certificate["proof"]["then"] == "exists"
        refuted(study, [tends(x)], along(x=1 / (1 - t), until=1), exists())
        refused("t - 1 is nonzero", study, [tends(x)], along(x=1 / (1 - t)))
        refused("contradicts no", study, [tends(x)], along(x=1 / (1 - t), until="1/2"))

    def test_what_is_no_solution(self):
        study, x, *_ = systems.oscillator()
        refused("the rate of v: not at t = 0", study, [tends(x)], along(x=cos(t), v=-sin(t), k=4))
        refused("the parameter k is not constant", study, [tends(x)], along(x=0, v=0, k=1 + t**2))
        refused("x is a function of y", study, [tends(x)], along(x=study.state("y"), v=0, k=1))
        refused("no value is given for v", study, [tends(x)], along(x=cos(t), k=1))
        refused("known to be smooth", study, [tends(x)], along(x=absolute(t), v=1, k=1))

    def test_what_does_not_meet_an_assumption(self):
        study, x, v, _k = systems.oscillator()
        grown = along(x=exp(t), v=exp(t), k=-1)
        refused("'k > 0'", study, [tends(x)], grown)
        turning = along(x=cos(t), v=-sin(t), k=1)
        refused("'x <= 0'", study, [tends(x)], turning, given=[initially(x <= 0)])
        refuted(study, [tends(x)], turning, given=[initially(x >= 1)])
        refused("x >= 1", study, [tends(x)], turning, given=[along_trajectory(x >= 1)])
        refuted(study, [tends(x)], turning, given=[along_trajectory(v**2 <= 1)])

    def test_an_assumption_about_times_after_the_last(self):
        study, x = systems.scalar(lambda x: -x)
        path, kept = along(x=exp(-t), until=1), [along_trajectory(x <= 1)]
        refused("holds after 1", study, [stays(x >= 1)], path, given=kept)

    def test_a_signal(self):
        study, x, w, _ = systems.disturbed()
        study.assumed = study.assumed[:1]
        study.assume(w.T @ w <= 1, about="signal")
        refuted(study, [tends(x)], along(x=(sin(t) - cos(t)) / 2, w=sin(t)))
        study, x, w, _ = systems.disturbed()
        refused("D - w[1] >= 0", study, [tends(x)], along(x=sin(t) - cos(t), w=2 * sin(t), D=1))
        refused("supposed 1, tends", study, [tends(x)], along(x=1, w=1, D=1), given=[tends(w)])

    def test_a_signal_that_blows_up_itself(self):
        study, x, _w, _ = systems.disturbed()
        blown = along(x=1 / (1 - t), w=1 / (1 - t) + 1 / (1 - t) ** 2, D=1, until=1)
        refused("the signal w divides", study, [tends(x)], blown)

    def test_a_field_that_jumps(self):
        study, x = systems.scalar(lambda x: -sgn(x) * (x**2 + 1) + x**2 + 2)
        refuted(study, [bounded(x)], along(x=t + 1))
        refused("the rate of x", study, [bounded(x)], along(x=t))


class TestBoundaries:
    def test_a_state_that_leaves(self):
        study, x = systems.scalar(lambda x: -x)
        assert refuted(study, [stays(x >= 1)], leaves(x=1)).witness == {"x": "1"}
        refuted(study, [stays(equal(x, 1))], leaves(x=1))

    def test_states_that_do_not(self):
        study, x = systems.scalar(lambda x: -x)
        refused("has the sign 1", study, [stays(x <= 1)], leaves(x=1))
        refused("has the sign 0", study, [stays(x >= 0)], leaves(x=0))
        refused("no point of its boundary", study, [stays(x >= 1)], leaves(x=2))
        refused("not in the set", study, [stays(x >= 1)], leaves(x=0))
        refused("does not contradict the conclusion tends", study, [tends(x)], leaves(x=0), tends(x))

    def test_one_value_of_a_switch_keeps_it(self):
        study, x = systems.scalar(lambda x: -sgn(x) * 2 + 1)
        refused("has the sign 1 for one value of the switches", study, [stays(x <= 0)], leaves(x=0))
        study, x = systems.scalar(lambda x: -sgn(x) * 2 + 3)
        refuted(study, [stays(x <= 0)], leaves(x=0))

    def test_an_admissible_signal(self):
        study, x, _w, D = systems.disturbed()
        refuted(study, [stays(2 * x <= D)], leaves(x="1/2", w=1, D=1))
        refused("'D - w[1] >= 0'", study, [stays(2 * x <= D)], leaves(x="1/2", w=2, D=1))
        kept = [along_trajectory(x <= 1)]
        refused("at later times", study, [stays(2 * x <= D)], leaves(x="1/2", w=1, D=1), given=kept)

    def test_a_kink(self):
        study, x = systems.scalar(lambda x: -x - 1)
        refused("rate of |.|", study, [stays(x + absolute(x) >= 0)], leaves(x=0))


class TestInstability:
    def test_the_upright_pendulum(self):
        study, x, _v = systems.pendulum()
        refuted(study, [stable(x=0, v=0), bounded(x)], unstable(x=0, v=0))

    def test_a_saddle_and_a_well(self):
        study, x, _v = systems.duffing()
        refuted(study, [stable(x=0, v=0), bounded(x)], unstable(x=0, v=0))
        well = [stable(x=1, v=0), bounded(x)]
        refused("no eigenvalue", study, well, unstable(x=1, v=0))
        refused("not the point", study, well, unstable(x=0, v=0))
        refused("no rest point", study, [stable(x=2, v=0), bounded(x)], unstable(x=2, v=0))
        refused("does not speak of all", study, [stable(x=0), bounded(x)], unstable(x=0, v=0))

    def test_an_oscillation_that_grows(self):
        study, x, v = systems.duffing()
        study.motions[1] = (v, v * "1/10" - x)
        refuted(study, [stable(x=0, v=0), bounded(x)], unstable(x=0, v=0))
        study.motions[1] = (v, -x)
        refused("no eigenvalue", study, [stable(x=0, v=0), bounded(x)], unstable(x=0, v=0))

    def test_on_the_sphere_of_quaternions(self):
        study, _q, omega = systems.attitude()
        rest = {"q": [0, 0, 0], "omega": [0, 0, 0]}
        there = {**rest, "q0": -1}
        refuted(study, [stable(**there), tends(omega)], unstable(there, c=5))
        here = {**rest, "q0": 1}
        refused("no eigenvalue", study, [stable(**here), tends(omega)], unstable(here, c=5))

    def test_what_grows_only_off_the_sphere(self):
        study, x, v = systems.duffing()
        study.motions[0], study.motions[1] = (x, x - 1), (v, -v)
        given = [initially(equal(x, 1))]
        then = [stable(x=1, v=0), bounded(x, v)]
        refuted(study, then, unstable(x=1, v=0))
        refused("no eigenvalue", study, then, unstable(x=1, v=0), given=given)

    def test_a_kink(self):
        study, x, v = systems.duffing()
        study.motions[1] = (v, x + absolute(v))
        refused("not smooth", study, [stable(x=0, v=0), bounded(x)], unstable(x=0, v=0))

    def test_at_the_edge_of_the_initial_states(self):
        study, x, v = systems.duffing()
        given = [initially(x * v >= 0)]
        refused("edge", study, [stable(x=0, v=0), bounded(x)], unstable(x=0, v=0), given=given)


class TestTubes:
    def test_a_set_that_is_left(self):
        study, x = systems.scalar(lambda x: -x + tanh(x) / 2)
        refuted(study, [stays(x >= 1)], enclosed(1, x="3/2"))
        refused("does not begin", study, [stays(x >= 2)], enclosed(1, x="3/2"), stays(x >= 2))
        refused("contradicts no", study, [stays(x >= 0)], enclosed(1, x="3/2"))

    def test_a_time_that_is_too_short(self):
        study, x = systems.scalar(lambda x: -x)
        refuted(study, [settles(x <= 1, by=1)], enclosed(2, x=9))
        refuted(study, [enters(x <= 1, by=1)], enclosed(2, x=9))
        refuted(study, [settles(equal(x, 0), by=absolute(x))], enclosed(10, x=9))
        refused("contradicts no", study, [settles(x <= 1, by=3)], enclosed(2, x=9))
        refused("contradicts no", study, [enters(x <= 1, by=3)], enclosed(4, x=9))
        refused("contradicts no", study, [enters(x <= 1)], enclosed(2, x=9))

    def test_no_tube(self):
        study, x = systems.scalar(lambda x: x**2)
        refused("enclosed until", study, [stays(x <= 2)], enclosed(3, x=1))
        refused("positive number", study, [stays(x <= 2)], enclosed(-3, x=1))


def test_a_certificate_is_a_file_of_its_own():
    import json

    study, x, _ = systems.duffing()
    found = refuted(study, [tends(x - 1)], at(x=-1, v=0))
    answer = check_text(json.dumps(found.certificate))
    assert answer.status == "valid"
    assert "it is false that" in answer.statement
    assert Fraction(found.witness["x"]) == -1


def test_a_maximum_and_a_root_beside_a_rest_point():
    study, x = systems.scalar(lambda x: maximum(x, 0) * sqrt(x**2 + 3) - 2)
    refuted(study, [tends(x)], at(x=1))
