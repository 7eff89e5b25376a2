"""A switch squared beside roots and powers of its argument: s^2 r = r, where r is zero at the jump."""

import pytest

from symctrl import Study, equal
from symctrl.decide.decision import decide
from symctrl.kernel.field import Field
from symctrl.kernel.generators import read_generators, relations_of_switches
from symctrl.vectors import absolute, power, sgn, signed_power
from symctrl.verdict import Outcome
from tests.decide.problems import problem


def outcome(build):
    study = Study("s")
    x, y, g = study.state("x"), study.state("y"), study.parameter("g")
    claim, *given = build(x, y, g)
    return decide(problem(study, claim, *given)).outcome


@pytest.mark.parametrize(
    "build",
    [
        lambda x, y, g: [equal(sgn(x) * signed_power(x, "1/2"), power(absolute(x), "1/2"))],
        lambda x, y, g: [equal(power(absolute(x), "2/3") * sgn(x) ** 2, power(absolute(x), "2/3"))],
        lambda x, y, g: [equal(power(absolute(x), g) * sgn(x) ** 2, power(absolute(x), g)), g > 0],
        lambda x, y, g: [equal(sgn(x) ** 3 * signed_power(x, "1/2"), power(absolute(x), "1/2"))],
    ],
)
def test_what_holds_at_zero_too(build):
    assert outcome(build) is Outcome.PROVED


@pytest.mark.parametrize(
    "build",
    [
        lambda x, y, g: [equal(sgn(x) ** 2, 1)],
        lambda x, y, g: [equal(sgn(x) ** 2 * (power(absolute(x), "1/2") + 1), power(absolute(x), "1/2") + 1)],
        lambda x, y, g: [equal(sgn(y) ** 2 * power(absolute(x), "1/2"), power(absolute(x), "1/2"))],
        lambda x, y, g: [equal(sgn(x) * signed_power(x, "1/2"), signed_power(x, "1/2"))],
    ],
)
def test_what_does_not(build):
    assert outcome(build) is not Outcome.PROVED


SWITCH = [
    {"free": "x"},
    {"free": "g"},
    {"abs": [["1", 0, 1]]},
    {"sign": [["1", 0, 1]], "abs": 2},
]


@pytest.mark.parametrize(
    ("definition", "growing", "count"),
    [
        ({"root": 2, "of": [["1", 2, 1]]}, False, 1),
        ({"root": 2, "of": [["2", 2, 1]]}, False, 0),
        ({"root": 2, "of": [["1"], ["1", 2, 1]]}, False, 0),
        ({"root": 2, "of": [["1", 0, 1]]}, False, 0),
        ({"power": [["1", 2, 1]], "exponent": [[[], [["1", 1, 1]]]]}, True, 1),
        ({"power": [["1", 2, 1]], "exponent": [[[], [["1", 1, 1]]]]}, False, 0),
        ({"exp": [[[], [["1", 2, 1]]]]}, True, 0),
        ({"function": "log", "of": [[[[], [["1", 2, 1]]]]]}, True, 0),
    ],
)
def test_only_what_is_zero_at_the_jump_takes_the_switch_up(definition, growing, count):
    field = Field(5, [])
    table = read_generators([*SWITCH, definition], field)
    assert len(relations_of_switches(table, lambda _: growing)) == count
