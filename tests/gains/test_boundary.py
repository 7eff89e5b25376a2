"""The edge as a formula: where it says that a gain lies, the condition is zero."""

import re

import pytest
import sympy

from symctrl import Study
from tests.gains.samples import answered, conditions, crossing, decaying, formation, kinks, matrix, rational

a, b, k, beta = sympy.symbols("a b k beta", positive=True)


def edges(study, *sweeps):
    text = answered(study, *sweeps).boundary
    return [] if text is None else [tuple(map(read, e.split(" = "))) for e in text.split("; ")]


def read(formula):
    return sympy.sympify(formula, locals={"a": a, "b": b, "k": k, "beta": beta})


def substituted(expression, edge):
    return sympy.simplify(expression.subs(*edge))


@pytest.mark.parametrize(
    ("build", "zeros"),
    [
        (crossing, [a**2 - b, a * b - 1]),
        (rational, [a / (b - 1) - 2]),
        (formation, [k - 4 * beta]),
        (decaying, [a**2 - b, 4 - a - b]),
    ],
)
def test_the_condition_is_zero_on_its_edge(build, zeros):
    found = edges(build())
    assert [substituted(zero, edge) for zero, edge in zip(zeros, found, strict=True)] == [0] * len(zeros)


def test_the_gain_that_is_swept_first_is_solved_for():
    assert edges(rational(), "b=1:2:3")[0][0] == b
    assert edges(rational(), "a=1:2:3")[0][0] == a


def test_what_is_not_affine_or_no_polynomial_has_no_formula():
    assert answered(kinks()).boundary is None
    assert answered(matrix()).boundary is None

    def squares(a, b):
        return a**2 + b**2 > 1

    assert answered(conditions("squares", {"a": "2", "b": "1"}, squares)).boundary is None


def test_the_edge_is_at_the_eigenvalue_that_decides():
    """What rises with the eigenvalue is decided at the least one, which is zero."""
    study = Study("rising")
    k, beta = study.gain("k", "2"), study.gain("beta", "1")
    fleet = study.fleet(default="ring:6")

    @study.condition("1")
    def rising():
        """It is least where the eigenvalue is zero."""
        return k - beta + fleet.eigenvalue * beta > 0

    @study.condition("2")
    def either():
        """It is least in between."""
        return k + beta - 3 * fleet.eigenvalue * k + fleet.eigenvalue**2 * k > 0

    assert answered(study).boundary == "k = beta"


def test_an_eigenvalue_that_is_not_known_exactly_has_no_edge():
    """That of a path of 7 is irrational."""
    found = answered(formation("path:7"))
    assert found.spectrum.low < found.spectrum.high
    assert found.boundary is None


def test_a_formula_is_short_and_has_no_idle_brackets():
    assert answered(crossing()).boundary == "b = a^2; a = 1/b"
    assert answered(decaying()).boundary == "b = a^2; a = 4 - b"

    def longer(a, b, c):
        return (b + c) * a - b + c >= 0

    text = answered(conditions("longer", {"a": "2", "b": "1", "c": "1"}, longer), "a=1:2:2").boundary
    assert re.fullmatch(r"a = \([^()]*\)/\([^()]*\)", text)
