"""Combinations: sums that are nonnegative by construction are found again, false bounds never."""

import json
import random

import pytest

from symctrl import Study
from symctrl.decide.decision import decide
from symctrl.kernel.check import check_text
from symctrl.vectors import absolute
from symctrl.verdict import Outcome
from tests.decide.problems import problem


def start():
    study = Study("s")
    x, y, z = (study.parameter(name) for name in "xyz")
    return study, x, y, z


def outcome(study, claim, *hypotheses):
    found = decide(problem(study, claim, *hypotheses))
    if found.certificate is not None:
        assert check_text(json.dumps(found.certificate)).status == "valid"
    return found.outcome


@pytest.mark.parametrize("seed", range(8))
def test_a_sum_of_products_of_assumptions_and_squares_is_found(seed):
    """c1 a b + c2 a u^2 + c3 v^2 >= 0 for a, b >= 0, where a and b are differences of symbols."""
    study, x, y, z = start()
    draw = random.Random(seed)
    a, b = x - y, z - draw.randint(1, 3)
    u, v = draw.choice([x, z, y + z]), draw.choice([x - z, y, x + y])
    value = draw.randint(1, 5) * a * b + draw.randint(1, 5) * a * u**2 + draw.randint(1, 5) * v**2
    assert outcome(study, value >= 0, a >= 0, b >= 0) is Outcome.PROVED


@pytest.mark.parametrize("seed", range(6))
def test_a_sum_less_a_little_is_refuted(seed):
    """A sum of squares that vanish together, less a little, is negative there."""
    study, x, y, z = start()
    draw = random.Random(seed)
    k = draw.randint(1, 4)
    value = k * (x - y) ** 2 + (y - z) ** 2 - (x - z) ** 2 * k
    assert outcome(study, value >= 0) in (Outcome.REFUTED, Outcome.UNDECIDED)
    assert outcome(study, k * (x - y) ** 2 + z**2 - "1/1000" >= 0) is not Outcome.PROVED


@pytest.mark.parametrize(
    "bound",
    [
        lambda x, y, z: x**2 + y**2 - 2 * x * y >= 0,
        lambda x, y, z: x**2 + y**2 + z**2 - x * y - y * z - x * z >= 0,
        lambda x, y, z: x**2 - x + "1/4" >= 0,
        lambda x, y, z: absolute(x) * y**2 + 2 * absolute(x * y) >= 0,
        lambda x, y, z: x**2 + 1 > 0,
    ],
)
def test_a_true_bound_is_proved(bound):
    study, *symbols = start()
    assert outcome(study, bound(*symbols)) is Outcome.PROVED


@pytest.mark.parametrize(
    "bound",
    [
        lambda x, y, z: x**2 + y**2 - "2.001" * x * y >= 0,
        lambda x, y, z: x**2 - x + "249/1000" >= 0,
        lambda x, y, z: x**2 > 0,
        lambda x, y, z: x * y >= 0,
        lambda x, y, z: absolute(x) - 1 >= 0,
        lambda x, y, z: (x - y) ** 2 * (z - 1) >= 0,
    ],
)
def test_a_false_bound_is_never_proved(bound):
    study, *symbols = start()
    assert outcome(study, bound(*symbols)) is Outcome.REFUTED


def test_what_is_assumed_to_be_nonnegative_is_not_taken_as_positive():
    study, x, _, _ = start()
    assert outcome(study, x > 0, x >= 0) is Outcome.REFUTED
    assert outcome(study, x + 1 > 0, x >= 0) is Outcome.PROVED
