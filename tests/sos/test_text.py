"""Polynomials from text: what is read exactly, and the one line that says what is wrong and where."""

from fractions import Fraction

import pytest

from symctrl.files import InputError
from symctrl.sos.ring import terms
from symctrl.sos.text import names_in, parse_claim, parse_constraints, parse_names


@pytest.mark.parametrize(
    ("written", "wanted"),
    [
        ("2/3*x^2 - 0.1*y", {(2, 0): Fraction(2, 3), (0, 1): Fraction(-1, 10)}),
        ("1e-3", {(0, 0): Fraction(1, 1000)}),
        ("-x**2", {(2, 0): Fraction(-1)}),
        ("--x", {(1, 0): Fraction(1)}),
        ("(x + y)^2/4", {(2, 0): Fraction(1, 4), (1, 1): Fraction(1, 2), (0, 2): Fraction(1, 4)}),
        ("x - x", {}),
        ("x^0", {(0, 0): Fraction(1)}),
        ("x^(2)", {(2, 0): Fraction(1)}),
        ("x^2 >= y", {(2, 0): Fraction(1), (0, 1): Fraction(-1)}),
        ("x^2 <= y", {(2, 0): Fraction(-1), (0, 1): Fraction(1)}),
        ("(" * 3000 + "x" + ")" * 3000, {(1, 0): Fraction(1)}),
    ],
)
def test_a_polynomial_is_read_exactly(written, wanted):
    assert terms(parse_claim(written, ("x", "y")).polynomial) == wanted


def test_a_strict_claim_is_told_apart():
    assert parse_claim("x^2 > -1", ("x",)).sign == ">"
    assert parse_claim("x^2", ("x",)).sign == ">="


@pytest.mark.parametrize(
    ("written", "words"),
    [
        ("", "is empty"),
        ("  ", "is empty"),
        ("x+", "it ends too early"),
        ("(x", "it ends too early"),
        ("2x", r"at character 2 .*a product is written with \*"),
        ("sin(x)", "functions are not polynomials"),
        ("x^y", "'y' is not expected"),
        ("x^-1", "'-' is not expected"),
        ("x^1.5", "an exponent must be a whole number from 0, instead got 1.5"),
        ("1/x", "a division by x, which is no number"),
        ("x/0", "a division by zero"),
        ("x*z", "at character 3: z is not one of the variables x, y"),
        ("x = 1", "an equation is not decided"),
        ("(x+y)^1000", "too large"),
        ("2e9999", "digits"),
        ("x $ 1", r"'\$' is not expected"),
        ("__import__('os')", "not expected"),
        ("x;y", "';' is not expected"),
    ],
)
def test_what_is_no_polynomial_is_one_clear_line(written, words):
    with pytest.raises(InputError, match=words) as caught:
        parse_claim(written, ("x", "y"))
    assert "\n" not in str(caught.value)


def test_constraints():
    found = parse_constraints("x >= 0, y <= 1, x == y,", ("x", "y"))
    assert [r.sign for r in found] == [">=", ">=", "=="]
    assert terms(found[1].polynomial) == {(0, 1): Fraction(-1), (0, 0): Fraction(1)}
    assert parse_constraints("", ("x",)) == []


@pytest.mark.parametrize(
    ("written", "words"),
    [
        ("x", "a relation like >= 0 is missing"),
        ("x > 0", "a constraint is >=, <= or ==, instead got >"),
        ("x >= 0 y >= 0", "'y' is not expected"),
        ("x >= 1 >= y", "'>=' is not expected"),
        ("x >= 0,,y >= 0", "',' is not expected"),
    ],
)
def test_what_is_no_constraint_is_one_clear_line(written, words):
    with pytest.raises(InputError, match=words):
        parse_constraints(written, ("x", "y"))


def test_names():
    assert parse_names("x, q[1,2],y") == ("x", "q[1,2]", "y")
    assert names_in("b*a + q[1,2]*b", "claim", "POLY") == ["b", "a", "q[1,2]"]
    for written, words in (("", "no variable"), ("x,x", "named twice"), ("x,2", "'2' is not a name")):
        with pytest.raises(InputError, match=words):
            parse_names(written)
