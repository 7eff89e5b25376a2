"""The conditions at a point: exact margins, witnesses of what fails, certificates that the kernel accepts."""

import json
import random
from fractions import Fraction

import pytest

from symctrl import Study, equal, positive_definite, positive_semidefinite
from symctrl.gains.definite import FAILS, HOLDS, OPEN
from symctrl.kernel.check import check_text
from symctrl.vectors import (
    absolute,
    block,
    diagonal,
    exp,
    eye,
    kron,
    maximum,
    power,
    row,
    sgn,
    sqrt,
    stack,
    tanh,
    zeros,
)
from tests.gains.samples import (
    answered,
    conditions,
    crossing,
    crossing_holds,
    decaying,
    formation,
    kinks,
    matrix,
    matrix_holds,
    powers,
    rational,
    rational_holds,
)


def single(function, **values):
    """The answer to one condition on gains with these values."""
    return answered(conditions("single", values, function)).conditions[0]


@pytest.mark.parametrize(
    ("build", "holds"), [(crossing, crossing_holds), (rational, rational_holds), (matrix, matrix_holds)]
)
def test_a_point_is_decided_as_exact_arithmetic_does(build, holds):
    generator = random.Random(4)
    for _ in range(40):
        a, b = (Fraction(generator.randint(1, 40), generator.randint(10, 20)) for _ in range(2))
        found = answered(build().at(values={"a": str(a), "b": str(b)}))
        if build is rational and b == 1:
            assert found.verdict == "undecided"
        else:
            assert found.verdict == ("feasible" if holds(a, b) else "infeasible")


@pytest.mark.parametrize("build", [crossing, rational, matrix, kinks, powers, formation, decaying])
def test_every_certificate_is_one_for_the_kernel(build):
    found = answered(build())
    certificates = [c for one in found.conditions for c in one.certificates]
    assert len(certificates) >= len(found.conditions) - 1
    for certificate in certificates:
        answer = check_text(json.dumps(certificate))
        assert (answer.status, answer.statement != "") == ("valid", True), answer.reason


# Margins are exact slacks


@pytest.mark.parametrize(
    ("function", "values", "margin"),
    [
        (lambda a: a > "1/3", {"a": "1"}, "2/3"),
        (lambda a: a <= "1/3", {"a": "1"}, "-2/3"),
        (lambda a, b: stack(a, 2 * b) >= stack(1, 1), {"a": "3", "b": "1"}, "1"),
        (lambda a: positive_definite(stack(row(a, 1), row(1, a))), {"a": "3"}, "2"),
        (lambda a: positive_semidefinite(stack(row(a, 1), row(1, a))), {"a": "1"}, "0"),
        (lambda a: positive_definite(stack(row(a, 1), row(1, a))), {"a": "1/3"}, "-2/3"),
        (lambda a: positive_definite(diagonal(a, a * eye(2))), {"a": "1/7"}, "1/7"),
    ],
)
def test_a_margin_is_the_slack_or_the_smallest_eigenvalue(function, values, margin):
    assert single(function, **values).margin == Fraction(margin)


def test_a_margin_of_an_irrational_eigenvalue_is_just_below_it():
    found = single(lambda a: positive_definite(stack(row(a, 1), row(1, 2 * a))), a="2")
    s = 3 - found.margin  # of [[2, 1], [1, 4]]: 3 - sqrt(2)
    assert s > 0
    assert 0 <= s * s - 2 < Fraction(1, 10**9)


def test_a_margin_of_a_root_is_rounded_down():
    found = single(lambda a: sqrt(a) > 1, a="2")
    assert 0 <= 2 - (1 + found.margin) ** 2 < Fraction(1, 10**12)


# Strict and weak, at the edge itself


@pytest.mark.parametrize(
    ("function", "state"),
    [
        (lambda a, b: a >= b, HOLDS),
        (lambda a, b: a > b, FAILS),
        (lambda a, b: a <= b, HOLDS),
        (lambda a, b: a < b, FAILS),
        (lambda a, b: positive_semidefinite(stack(row(a, b), row(b, a))), HOLDS),
        (lambda a, b: positive_definite(stack(row(a, b), row(b, a))), FAILS),
        (lambda a, b: sqrt(a) >= sqrt(b), OPEN),  # roots are rounded, and 1/3 has none that is rational
        (lambda a, b: stack(a, a) >= stack(b, 1), FAILS),
    ],
)
def test_equality_meets_what_is_weak_and_not_what_is_strict(function, state):
    assert single(function, a="1/3", b="1/3").state == state or state == OPEN


# Matrices as a study writes them


@pytest.mark.parametrize(
    "function",
    [
        lambda a, b: positive_definite(kron(stack(row(a, b), row(b, a)), eye(3))),
        lambda a, b: positive_definite(diagonal(a * eye(2), b)),
        lambda a, b: positive_definite(block([[a * eye(2), zeros(2, 1)], [zeros(1, 2), b * eye(1)]])),
        lambda a, b: positive_definite(stack(row(a, 1), row(0, b)).T @ stack(row(a, 1), row(0, b))),
        lambda a, b: positive_definite(a * eye(2) + stack(row(b, 0), row(0, 1))),
    ],
)
def test_products_blocks_and_kron_are_read(function):
    found = answered(conditions("made", {"a": "2", "b": "1"}, function), "a=1/2:3:5")
    assert found.verdict == "feasible"
    assert found.map.cells[0][-1] == "f"
    assert found.margin > Fraction(3, 10)


def test_a_matrix_that_fails_has_a_vector():
    found = single(lambda a: positive_definite(stack(row(a, 1), row(1, a))), a="1/2")
    x = [Fraction(v) for v in found.witness["x"]]
    assert found.witness["a"] == "1/2"
    assert x[0] ** 2 / 2 + 2 * x[0] * x[1] + x[1] ** 2 / 2 < 0


def test_a_matrix_with_roots_fails_without_a_vector_and_without_an_error():
    found = single(lambda a: positive_definite(stack(row(sqrt(a), 2), row(2, a))), a="2")
    assert (found.state, found.witness) == (FAILS, {"a": "2"})


# What boxes do not know


@pytest.mark.parametrize(
    ("function", "reason"),
    [
        (lambda a: exp(a) > 7, "exp"),
        (lambda a: tanh(a) < "9/10", "tanh"),
        (lambda a: power(a, "1/3") > 1, "whole exponents"),
        (lambda a: sgn(a - 1) * exp(a) > 0, "exp"),
    ],
)
@pytest.mark.parametrize("value", ["2", "1/100"])
def test_a_function_that_boxes_do_not_know_never_ends_in_an_error(function, reason, value):
    study = conditions("unknown", {"a": value}, function)
    found = answered(study, "a=1/2:3:4")
    assert found.map.cells == ["uuuu"]
    one = found.conditions[0]
    assert one.state in (HOLDS, FAILS) or reason in one.reason


def test_at_a_point_such_a_function_is_enclosed():
    """exp(2) = 7.389056098930650.."""
    assert single(lambda a: exp(a) > "7.38905609893065", a="2").state == HOLDS
    assert single(lambda a: exp(a) > "7.38905609893066", a="2").state == FAILS


def test_what_divides_by_zero_is_not_decided_as_a_claim_either():
    assert single(lambda a, b: exp(a) * (b - 1) / (b - 1) > 0, a="1", b="2").state == HOLDS
    assert single(lambda a, b: exp(a) * (b - 1) / (b - 1) > 0, a="1", b="1").state == OPEN


def test_what_fails_between_two_eigenvalues_does_not_fail():
    """The eigenvalues of the complete graph of four are 0 and 4."""
    study = Study("between")
    k, fleet = study.gain("k", "1"), study.fleet(default="complete:4")

    @study.condition("1")
    def apart():
        """It fails between."""
        return equal(exp(k) * fleet.eigenvalue, exp(k) * fleet.eigenvalue**2 / 4)

    assert answered(study).conditions[0].state == OPEN


def test_other_conditions_are_decided_beside_it():
    def unknown(a):
        return exp(a) > 7

    def known(a):
        return a > 2

    assert answered(conditions("both", {"a": "3"}, unknown, known), "a=1:3:4").map.cells == ["iiuu"]


@pytest.mark.parametrize(
    ("function", "values", "state"),
    [
        (lambda a, b: 1 / (a - b) > 0, ("1", "1"), OPEN),
        (lambda a, b: 1 / (a - b) > 0, ("2", "1"), HOLDS),
        (lambda a, b: sqrt(a - b) >= 0, ("1", "2"), OPEN),
        (lambda a, b: sqrt(a - b) >= 0, ("2", "2"), HOLDS),
        (lambda a, b: absolute(a - b) > 0, ("2", "2"), FAILS),
        (lambda a, b: sgn(a - b) >= 0, ("2", "2"), HOLDS),
        (lambda a, b: maximum(a, b) > 2, ("2", "2"), FAILS),
        (lambda a, b: power(a - b, 0) > 0, ("2", "2"), HOLDS),
    ],
)
def test_what_is_undefined_is_neither_feasible_nor_infeasible(function, values, state):
    found = answered(conditions("defined", dict(zip("ab", values, strict=True)), function))
    assert found.conditions[0].state == state


def test_numbers_beyond_floating_point_are_no_error():
    huge = "1e200"
    found = answered(conditions("huge", {"a": huge, "b": huge}, lambda a, b: a**2 * b >= a), f"a=1:{huge}:3")
    assert (found.verdict, found.map.cells) == ("feasible", ["fff"])
    found = single(lambda a: positive_definite(stack(row(a**2, 1), row(1, a))), a=huge)
    assert (found.state, found.margin) == (HOLDS, None)


def test_a_condition_without_a_gain_is_one_all_the_same():
    study = Study("fixed")
    k, m = study.gain("k", "2"), study.parameter("m", "3")

    @study.condition("1")
    def heavy():
        """m is at least 3."""
        return m >= 3

    @study.condition("2")
    def stiff():
        """k is positive and more."""
        return k > 1

    assert answered(study, "k=1/2:2:3").map.cells == ["iuf"]
    assert answered(study, "m=2:4:4").map.cells == ["iuff"]
