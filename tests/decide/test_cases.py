"""Functions through zero, saturations and sizes: bounds that hold are proved, those that do not never are."""

import json

import pytest

from symctrl import Study
from symctrl.decide.decision import decide
from symctrl.kernel.check import check_text
from symctrl.vectors import absolute, atan, exp, log, maximum, minimum, saturate, sin, sqrt, tanh
from symctrl.verdict import Outcome
from tests.decide.problems import problem


def outcome(build):
    study = Study("s")
    x, y = study.state("x"), study.state("y")
    k, m = study.gain("k"), study.gain("m")
    claim, *given = build(x, y, k, m)
    found = decide(problem(study, claim, *given))
    if found.certificate is not None:
        assert check_text(json.dumps(found.certificate)).status == "valid"
    return found.outcome


TRUE = {
    "tanh": lambda x, y, k, m: [x * tanh(x) >= 0],
    "tanh of a multiple": lambda x, y, k, m: [x * tanh(k * x) >= 0],
    "tanh of a sum": lambda x, y, k, m: [(x + y) * tanh(x + y) + x**2 >= 0],
    "strictly": lambda x, y, k, m: [x * tanh(x) > 0, x > 0],
    "atan": lambda x, y, k, m: [x * atan(x) >= 0],
    "asinh": lambda x, y, k, m: [x * log(x + sqrt(x**2 + 1)) >= 0],
    "below one": lambda x, y, k, m: [1 - tanh(x) ** 2 > 0],
    "below its argument": lambda x, y, k, m: [x**2 - x * tanh(x) >= 0],
    "sine": lambda x, y, k, m: [x**2 >= sin(x) ** 2],
    "exponential": lambda x, y, k, m: [exp(x) >= 1 + x],
    "logarithm": lambda x, y, k, m: [log(x) >= 0, x >= 1],
    "logarithm of a quotient": lambda x, y, k, m: [log(1 + x**2 / y**2) >= 0, y > 0],
    "logarithm of what is below one": lambda x, y, k, m: [-log(y) >= 0, y > 0, x**2 + y**2 <= 1],
    "logarithm of cosh": lambda x, y, k, m: [log((exp(x) + exp(-x)) / 2) >= 0],
    "logarithms grow": lambda x, y, k, m: [log(2 + x**2) - log(1 + x**2) > 0],
    "functions grow": lambda x, y, k, m: [tanh(x) >= tanh(y), x >= y],
    "below a part of the ball": lambda x, y, k, m: [x**2 - x**3 >= x**2 / 2, x**2 + y**2 <= "1/4"],
    "saturation": lambda x, y, k, m: [x * saturate(x, m) >= 0],
    "saturation of a multiple": lambda x, y, k, m: [x * saturate(k * x, m) >= 0],
    "saturated": lambda x, y, k, m: [m - absolute(saturate(x, m)) >= 0],
    "minimum": lambda x, y, k, m: [minimum(x, 1) >= 0, x >= 0],
    "maximum": lambda x, y, k, m: [maximum(x, y) - x >= 0],
    "outside of the layer": lambda x, y, k, m: [x * saturate(x, 1) >= absolute(x), x**2 >= 1],
    "a size above": lambda x, y, k, m: [absolute(x) >= m, x**2 >= m**2],
    "a size below": lambda x, y, k, m: [absolute(x) <= m, x**2 <= m**2],
    "a root above": lambda x, y, k, m: [sqrt(x) >= m, x >= m**2],
    "a size above, times": lambda x, y, k, m: [
        k * absolute(x) - y * x >= (k - m) * 2,
        x**2 >= 4,
        y <= m,
        y >= -m,
        k >= m,
    ],
}
FALSE = {
    "another argument": lambda x, y, k, m: [x * tanh(y) >= 0],
    "a difference": lambda x, y, k, m: [x * tanh(x - y) >= 0],
    "strictly at zero": lambda x, y, k, m: [x * tanh(x) > 0, x >= 0],
    "above its argument": lambda x, y, k, m: [x * tanh(x) >= x**2],
    "a lower bound": lambda x, y, k, m: ["1/2" - tanh(x) ** 2 >= 0],
    "a steeper one": lambda x, y, k, m: [x * atan(2 * x) <= x**2],
    "logarithm below one": lambda x, y, k, m: [log(x) >= 0, x >= "0.9"],
    "exponential": lambda x, y, k, m: [exp(x) >= 1 + 2 * x],
    "logarithm of what is above": lambda x, y, k, m: [-log(y) >= 0, y > 0, x**2 + y**2 <= "1.01"],
    "logarithms the other way": lambda x, y, k, m: [log(1 + x**2) - log(2 + x**2) >= 0],
    "functions of different arguments": lambda x, y, k, m: [tanh(x) >= tanh(y), x >= y - "0.01"],
    "different functions": lambda x, y, k, m: [tanh(x) >= atan(x), x >= 0],
    "below too small a part": lambda x, y, k, m: [x**2 - x**3 >= x**2 * "0.51", x**2 + y**2 <= "1/4"],
    "saturation of another": lambda x, y, k, m: [y * saturate(x, m) >= 0],
    "saturated too soon": lambda x, y, k, m: [m - absolute(saturate(x, 2 * m)) >= 0],
    "minimum": lambda x, y, k, m: [minimum(x, 1) >= 0, x >= "-0.01"],
    "outside of a smaller layer": lambda x, y, k, m: [x * saturate(x, 1) >= absolute(x), x**2 >= "0.99"],
    "a size above": lambda x, y, k, m: [absolute(x) >= m, x**2 >= m**2 - "0.01"],
    "no size": lambda x, y, k, m: [x >= m, x**2 >= m**2],
    "of unknown sign": lambda x, y, k, m: [absolute(x) > y, x**2 >= y**2],
    "a size above, times": lambda x, y, k, m: [
        k * absolute(x) - y * x >= (k - m) * 2,
        x**2 >= 4,
        y <= m,
        y >= -m,
    ],
}


@pytest.mark.parametrize("build", TRUE.values(), ids=TRUE)
def test_a_bound_that_holds_is_proved(build):
    assert outcome(build) is Outcome.PROVED


@pytest.mark.parametrize("build", FALSE.values(), ids=FALSE)
def test_a_bound_that_does_not_hold_is_not(build):
    assert outcome(build) is not Outcome.PROVED
