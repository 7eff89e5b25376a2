"""Squares as they are written: set aside, or times what is assumed; and never where the rest is negative."""

import json

import pytest

from symctrl import Study, exponentially, tends
from symctrl.decide.decision import decide
from symctrl.kernel.check import check_text
from symctrl.verdict import Outcome
from tests.decide.problems import problem
from tests.rules.theorem_rows import assert_proved, states, theorem


def outcome(build):
    study = Study("s")
    x, y, v = (study.state(name) for name in "xyv")
    k, kp, kd, ki = (study.gain(name) for name in ("k", "kp", "kd", "ki"))
    claim, *given = build(x, y, v, k, kp, kd, ki)
    found = decide(problem(study, claim, *given))
    if found.certificate is not None:
        assert check_text(json.dumps(found.certificate)).status == "valid"
    return found.outcome


def pid(x, y, v, kp, kd, ki):
    return (v + kd * x) ** 2 + kp * x**2 + 2 * ki * x * y + kd * ki * y**2


@pytest.mark.parametrize(
    "build",
    [
        lambda x, y, v, k, kp, kd, ki: [x**4 + (k - 1) * (y + x**2 + x) ** 2 >= 0, k >= 1],
        lambda x, y, v, k, kp, kd, ki: [pid(x, y, v, kp, kd, ki) >= 0, kp * kd > ki],
        lambda x, y, v, k, kp, kd, ki: [
            ki * (v + x**2) ** 2 + kp * x**2 + 2 * x * y + kd * y**2 >= 0,
            kp * kd > 1,
        ],
    ],
)
def test_what_holds_is_proved(build):
    assert outcome(build) is Outcome.PROVED


@pytest.mark.parametrize(
    "build",
    [
        lambda x, y, v, k, kp, kd, ki: [x**4 + (k - 1) * (y + x**2 + x) ** 2 >= 0, k >= "0.99"],
        lambda x, y, v, k, kp, kd, ki: [pid(x, y, v, kp, kd, ki) >= 0, kp * kd > "0.9" * ki],
        lambda x, y, v, k, kp, kd, ki: [pid(x, y, v, kp, kd, ki) - x**2 / 10 >= 0, kp * kd > ki],
        lambda x, y, v, k, kp, kd, ki: [pid(x, y, v, kp, kd, ki) > 0, kp * kd > ki],
    ],
)
def test_what_does_not_is_not(build):
    assert outcome(build) is not Outcome.PROVED


def test_backstepping_with_a_square_that_is_written():
    study, x, y = states("x", "y")
    k = study.gain("k")
    rate = (-2 * x - 1) * (x**2 - x**3 + y)
    z = y + x**2 + x
    study.motion(x, x**2 - x**3 + y)
    study.motion(y, rate - x - k * z)

    def argument(run):
        V = x**2 / 2 + z**2 / 2
        run.decays(V, a=2)
        run.exponentially(x, by=V, least="1/2")
        run.tends(x)
        run.tends(z, by=V, least="1/2")
        run.tends(y)

    assert_proved(theorem(study, [tends(x, y), exponentially(x, 1)], argument, [k >= 1]))
