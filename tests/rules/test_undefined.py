"""States at which the closed loop has no value: they refute, or do not, each with its reason."""

import pytest

from symctrl.counterexample import undefined
from symctrl.facts import tends
from symctrl.theorem import initially
from symctrl.vectors import absolute, atan, cos, exp, maximum, sin, sqrt, tanh
from tests.rules import systems
from tests.rules.test_against import refused, refuted


class TestEdges:
    def test_a_division_by_zero(self):
        study, x, *_ = systems.quotient()
        found = refuted(study, [tends(x)], undefined(x=1, y=2, a=2))
        assert found.certificate["proof"]["then"] == "exists"

    def test_a_root_of_a_negative_number(self):
        study, x, *_ = systems.quotient()
        refuted(study, [tends(x)], undefined(x=1, y=-10, a=2))

    def test_where_there_is_none(self):
        study, x, y, _ = systems.quotient()
        refused("has a value here", study, [tends(x)], undefined(x=1, y=1, a=2))
        refused("'a > 1'", study, [tends(x)], undefined(x=1, y=1, a=1))
        refused("'y <= 1'", study, [tends(x)], undefined(x=1, y=2, a=2), given=[initially(y <= 1)])
        refused("conclusion tends", study, [tends(x)], undefined(x=1, y=2, a=2), tends(x))

    def test_what_the_field_does_not_need(self):
        study, x = systems.scalar(lambda x: -x)
        refused("has a value here", study, [tends(x / x)], undefined(x=0))


def reading(rate):
    """v' = -v, and x' = -x + rate, which is a function of the study and v."""
    study, x, v = systems.duffing()
    study.motions[0], study.motions[1] = (x, -x + rate(study, v)), (v, -v)
    return study, x


class TestRates:
    """A rate has a value where its formula has one, and only there, if the formula is smooth where it is
    defined.
    """

    @pytest.mark.parametrize(
        "rate",
        [
            lambda study, y: 1 / study.rate(y * y),
            lambda study, y: study.rate(1 / y),
            lambda study, y: study.rate(sin(y) * exp(y) + cos(y)) / y,
            lambda study, y: study.rate(tanh(y) / (2 + atan(y))) / y,
            lambda study, y: study.rate(y) + 1 / y,
        ],
    )
    def test_of_what_is_smooth_where_it_is_defined(self, rate):
        study, x = reading(rate)
        found = refuted(study, [tends(x)], undefined(x=1, v=0))
        assert found.certificate["proof"]["then"] == "exists"

    @pytest.mark.parametrize(
        "rate",
        [
            lambda study, y: study.rate(sqrt(y * y)),
            lambda study, y: study.rate(sqrt(y * y + 1)) / y,
            lambda study, y: study.rate(absolute(y)) / y,
            lambda study, y: study.rate(maximum(y, 0)) / y,
        ],
    )
    def test_of_roots_and_absolute_values_are_declined(self, rate):
        study, x = reading(rate)
        why = "the field reads rates, which may have a value where their formula has none"
        refused(why, study, [tends(x)], undefined(x=1, v=0))

    def test_where_the_rate_has_a_value(self):
        study, x = reading(lambda study, y: study.rate(1 / (y * y + 1)))
        refused("has a value here", study, [tends(x)], undefined(x=1, v=0))

    def test_in_a_law(self):
        study, x, y = systems.duffing()
        u = study.input("u")
        study.motions[0], study.motions[1] = (x, -x + u), (y, -y)

        @study.law("law", u)
        def divided():
            return 1 / study.rate(y * y)

        refuted(study, [tends(x)], undefined(x=1, v=0))
        refused("has a value here", study, [tends(x)], undefined(x=1, v=2))
