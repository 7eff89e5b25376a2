"""The kernel's twin of a tube: what it confirms, and every alteration that it must refuse."""

from __future__ import annotations

import copy
from fractions import Fraction
from functools import cache
from itertools import pairwise

import casadi as ca
import pytest

from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.form import read_statement
from symctrl.kernel.interval import Undecided
from symctrl.kernel.tube import verify_tube
from symctrl.trajectories import enclose
from tests.motions import BODY, OSCILLATOR, PENDULUM, SPIN, motion, numbers

VALUES = numbers(x=2, v="-1/2", w="1/10")
STATEMENT = read_statement(PENDULUM.statement())


@cache
def _tube():
    return enclose(PENDULUM, "law", VALUES, Fraction(2), order=8, tolerance=Fraction(1, 2**30))


@pytest.fixture
def tube():
    return copy.deepcopy(_tube().as_json())


def check(tube, values=VALUES, law="law"):
    return verify_tube(STATEMENT, law, values, tube)


def test_segments_join_and_hold_the_boxes(tube):
    segments = check(tube)
    assert segments[0].t0 == 0
    assert segments[-1].t1 == 2
    for before, after in pairwise(segments):
        assert before.t1 == after.t0
        assert before.end == after.start
    for segment in segments:
        for name in ("x", "v"):
            for box in (segment.start[name], segment.end[name]):
                over = segment.over[name]
                assert over.lo < box.lo <= box.hi < over.hi


def narrowed(ends, share):
    low, high = map(Fraction, ends)
    cut = (high - low) * share
    return [str(low + cut), str(high - cut)]


def moved(ends, share):
    low, high = map(Fraction, ends)
    by = (high - low) * share
    return [str(low + by), str(high + by)]


def _shrink_box(tube):
    step = tube["steps"][4]
    step["box"][0] = narrowed(step["box"][0], Fraction(1, 3))


def _shrink_end(tube):
    tube["end"][1] = narrowed(tube["end"][1], Fraction(1, 3))


def _move_end(tube):
    tube["end"][0] = moved(tube["end"][0], 2)


def _shrink_over(tube):
    step = tube["steps"][4]
    step["over"][0] = narrowed(step["over"][0], Fraction(1, 4))


def _move_over(tube):
    step = tube["steps"][4]
    step["over"][1] = moved(step["over"][1], 3)


def _over_is_the_box(tube):
    step = tube["steps"][4]
    step["over"] = step["box"]


def _enlarge_last_step(tube):
    step = tube["steps"][-1]
    step["h"] = str(Fraction(step["h"]) * Fraction(9, 8))


def _enlarge_step_and_shift_times(tube):
    more = Fraction(tube["steps"][3]["h"]) / 8
    tube["steps"][3]["h"] = str(Fraction(tube["steps"][3]["h"]) + more)
    for step in tube["steps"][4:]:
        step["t"] = str(Fraction(step["t"]) + more)


def _shorten_step_and_shift_times(tube):
    less = Fraction(tube["steps"][3]["h"]) / 2
    tube["steps"][3]["h"] = str(less)
    for step in tube["steps"][4:]:
        step["t"] = str(Fraction(step["t"]) - less)


def _leave_a_gap(tube):
    del tube["steps"][3]


def _leave_a_gap_and_shift_times(tube):
    less = Fraction(tube["steps"][3]["h"])
    del tube["steps"][3]
    for step in tube["steps"][3:]:
        step["t"] = str(Fraction(step["t"]) - less)


def _negative_step(tube):
    tube["steps"][3]["h"] = "-" + tube["steps"][3]["h"]


def _zero_step(tube):
    tube["steps"][-1]["h"] = "0"


def _begin_later(tube):
    del tube["steps"][0]


def _swap_states(tube):
    tube["states"].reverse()


def _state_twice(tube):
    tube["states"] = ["x", "x"]


def _lack_a_state(tube):
    tube["states"] = ["x"]


def _shrink_spread(tube):
    step = tube["steps"][4]
    step["spread"][0] = narrowed(step["spread"][0], Fraction(1, 3))


def _move_middle(tube):
    step = tube["steps"][4]
    low, high = map(Fraction, step["box"][0])
    step["middle"][0] = str(low / 4 + 3 * high / 4)


def _middle_outside(tube):
    step = tube["steps"][4]
    step["middle"][0] = str(Fraction(step["box"][0][1]) + 1)
    step["spread"] = [["-10", "10"], ["-10", "10"]]


def _turn_frame(tube):
    step = tube["steps"][4]
    step["matrix"].reverse()


def _singular_frame(tube):
    tube["steps"][4]["matrix"] = [["1", "2"], ["1/2", "1"]]


def _ends_swapped(tube):
    tube["end"][0].reverse()


def _order_zero(tube):
    tube["order"] = 0


def _no_steps(tube):
    tube["steps"] = []


def _unknown_field(tube):
    tube["steps"][0]["note"] = "1"


def _missing_field(tube):
    del tube["end"]


def _decimal(tube):
    tube["end"][0] = [float(Fraction(x)) for x in tube["end"][0]]


def _not_lowest(tube):
    tube["steps"][0]["t"] = "0/2"


def _short_box(tube):
    tube["end"].pop()


ALTERATIONS = [
    _shrink_box,
    _shrink_end,
    _move_end,
    _shrink_over,
    _move_over,
    _over_is_the_box,
    _enlarge_last_step,
    _enlarge_step_and_shift_times,
    _shorten_step_and_shift_times,
    _leave_a_gap,
    _leave_a_gap_and_shift_times,
    _negative_step,
    _zero_step,
    _begin_later,
    _swap_states,
    _state_twice,
    _lack_a_state,
    _shrink_spread,
    _move_middle,
    _middle_outside,
    _turn_frame,
    _singular_frame,
    _ends_swapped,
    _order_zero,
    _no_steps,
    _unknown_field,
    _missing_field,
    _decimal,
    _not_lowest,
    _short_box,
]


@pytest.mark.parametrize("alter", ALTERATIONS)
def test_an_altered_tube_is_refused(tube, alter):
    alter(tube)
    with pytest.raises(Invalid):
        check(tube)


@pytest.mark.parametrize("name", ["x", "v", "w"])
def test_another_value_is_refused(tube, name):
    with pytest.raises(Invalid, match="may miss the solution"):
        check(tube, VALUES | {name: VALUES[name] + Fraction(1, 1000)})


@pytest.mark.parametrize(
    ("values", "law", "message"),
    [
        (VALUES, "other", "law 'other' is not given"),
        (VALUES, None, "input u has no motion or law"),
        ({"x": Fraction(2), "v": Fraction(-1, 2)}, "law", "no value is given for w"),
        ({"x": Fraction(2), "w": Fraction(1, 10)}, "law", "no value is given for v"),
    ],
)
def test_what_is_missing_is_named(tube, values, law, message):
    with pytest.raises(Invalid, match=message):
        check(tube, values, law)


def test_a_tube_of_another_motion_is_refused(tube):
    other = motion(lambda x, v, w: (v, -x + w), x="state", v="state", w="signal")
    with pytest.raises(Invalid):
        verify_tube(read_statement(other.statement()), None, VALUES, tube)


def test_too_few_bits_prove_nothing_wrong(tube):
    tube["bits"] = 8
    with pytest.raises((Invalid, Declined)):
        check(tube)


def _from(problem, tube):
    return verify_tube(read_statement(problem.statement()), None, numbers(x="1/2"), tube)


@pytest.mark.parametrize(
    ("formula", "refusal"),
    [
        (ca.floor, Declined),
        (lambda x: ca.sign(x - 2 / 4) - 1, Undecided),
        (lambda x: -ca.fabs(x - 0.5), Undecided),
        (lambda x: ca.fmin(x, 0.5) - x, Undecided),
        (lambda x: ca.sqrt(x - 0.5), Declined),
        (lambda x: (x - 0.5) / (x - 0.5), Undecided),
        (lambda x: ca.log(x - 2), Invalid),
    ],
)
def test_what_is_not_smooth_over_the_box_is_not_confirmed(formula, refusal):
    still = motion(lambda x: (0 * x,), x="state")
    tube = enclose(still, None, numbers(x="1/2"), Fraction(1)).as_json()
    for step in tube["steps"]:
        step["over"] = [["0", "1"]]
    assert _from(still, tube)
    with pytest.raises(refusal):
        _from(motion(lambda x: (formula(x),), x="state"), tube)


def test_a_body_of_three_states_takes_some_seconds_at_most():
    tube = enclose(BODY, None, SPIN, Fraction(15), order=8, tolerance=Fraction(1, 2**40))
    segments = verify_tube(read_statement(BODY.statement()), None, SPIN, tube.as_json())
    assert len(segments) > 150


def test_high_orders_and_precision():
    tube = enclose(OSCILLATOR, None, numbers(x=1, v=0), Fraction(3), order=40, tolerance=Fraction(1, 2**200))
    segments = verify_tube(read_statement(OSCILLATOR.statement()), None, numbers(x=1, v=0), tube.as_json())
    assert segments[-1].end["x"].hi - segments[-1].end["x"].lo < Fraction(1, 2**190)
