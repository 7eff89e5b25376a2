from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from symctrl.domains.unit import BASE, PURE, Unit, UnitError, parse, unknown

EXPONENT = st.fractions(-3, 3, max_denominator=2)
UNITS = st.builds(lambda *e: Unit(tuple(e)), *[EXPONENT] * len(BASE))


@given(UNITS)
def test_text_reads_back(unit: Unit) -> None:
    assert parse(unit.text) == unit


@given(UNITS, UNITS, EXPONENT.filter(bool))
def test_units_form_a_vector_space(a: Unit, b: Unit, e: Fraction) -> None:
    assert a * b / b == a
    assert (a * b) ** e == a**e * b**e
    assert (a**e) ** (1 / e) == a
    assert a / a == PURE


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("N*m*s", "kg m^2 s^-1"),
        ("rad/s", "1/s"),
        ("kg m^2", "kg*m**2"),
        ("N m / rad", "J"),
        ("1/s^2", "s^-2"),
        ("kg m²s⁻²", "N·m"),
        ("W/(m^2 K)", "kg s^-3 K^-1"),
        ("m/s/s", "m/s^2"),
        ("Wb", "V s"),
        ("H A^2", "J"),
        ("ohm", "V/A"),
        ("F*V", "C"),
        ("S", "1/Ω"),
        ("T*m^2", "Wb"),
        ("(m^2)^(1/2)", "m"),
        ("1", "rad"),
    ],
)
def test_spellings(text: str, same: str) -> None:
    assert parse(text) == parse(same)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("km", "'km' is not one of"),
        ("deg/s", "'deg'"),
        ("m^", "ends"),
        ("m^x", "exponent was expected before 'x'"),
        ("N$m", r"'\$' was not expected"),
        ("(m s", r"\) was expected"),
        ("m)", r"'\)' was not expected"),
        ("", "ends"),
        ("3 m", "'3'"),
        ("m^(1/0)", "divides by zero"),
        ("/s", "'/'"),
    ],
)
def test_what_is_no_unit_is_refused_by_its_part(text: str, named: str) -> None:
    with pytest.raises(UnitError, match=named):
        parse(text)


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("N*m*s", "N m s"),
        ("kg*m^2", "kg m^2"),
        ("J", "N m"),
        ("1/(kg m^2)", "kg^-1 m^-2"),
        ("rad", "1"),
        ("m^(1/2)", "m^(1/2)"),
    ],
)
def test_shown_as_an_engineer_writes_it(text: str, shown: str) -> None:
    assert parse(text).text == shown


def test_unknown_units_are_shown_by_their_symbol() -> None:
    assert (unknown("k") ** Fraction(-2) * parse("m")).text == "[k]^-2 m"
