from collections.abc import Sequence
from fractions import Fraction

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.domains.floating import FloatDomain
from symctrl.domains.unit import BASE, PURE, UnitError, parse
from symctrl.domains.units import UnitsDomain, judge
from symctrl.graph import Tape, interpret, prebound, read, unfolded

NAMES = ("a", "b", "c", "d", "2", "1/2")
GIVEN = {"a": "kg m^2", "b": "rad/s", "c": "1/s", "d": "m^2", "2": "1", "1/2": "1"}


def tape(outputs: Sequence[ca.SX], symbols: Sequence[ca.SX]) -> Tape:
    return read(ca.Function("f", list(symbols), [ca.vertcat(*outputs)]), [s.name() for s in symbols])


def scalars(*names: str) -> list[ca.SX]:
    return [ca.SX.sym(name) for name in names]


@st.composite
def expressions(draw: st.DrawFn, symbols: list[ca.SX], depth: int = 3) -> ca.SX:
    if depth == 0:
        return draw(st.sampled_from(symbols))
    x = draw(expressions(symbols, depth - 1))
    y = draw(expressions(symbols, depth - 1))
    with unfolded():
        return draw(
            st.sampled_from(
                [
                    x * y,
                    x / y,
                    x + y,
                    x - y,
                    ca.fmin(x, y),
                    ca.sqrt(x),
                    x**2,
                    x**-1.5,
                    1 / x,
                    ca.sign(x),
                    ca.fabs(x),
                    ca.tanh(x),
                    ca.atan2(x, y),
                    ca.hypot(x, y),
                    ca.if_else(x < y, x, y),
                    2 * x,
                    x**y,
                ]
            )
        )


@given(st.data())
@settings(max_examples=200, deadline=None)
def test_what_is_consistent_does_not_depend_on_the_choice_of_units(data: st.DataObject) -> None:
    """Change the size of the base units: all values of a consistent expression scale by their unit."""
    symbols = scalars(*NAMES)
    graph = tape([data.draw(expressions(symbols))], symbols)
    domain = UnitsDomain()
    (result,) = prebound(graph, domain)([domain.symbol(name, GIVEN[name]) for name in graph.inputs])
    if domain.mismatch is not None:
        return
    sizes = np.array([3.0, 0.7, 1.9, 1.0, 1.0, 1.0, 1.0])
    scale = {name: float(np.prod(sizes ** np.array(parse(GIVEN[name]).si, dtype=float))) for name in NAMES}
    values = {"a": 1.3, "b": 0.4, "c": 2.1, "d": 0.9, "2": 2.0, "1/2": 0.5}
    (before,) = interpret(graph, FloatDomain(), {n: np.array(v) for n, v in values.items()})
    (after,) = interpret(graph, FloatDomain(), {n: np.array(v * scale[n]) for n, v in values.items()})
    if result.unit is None:
        assert before == 0 or not np.isfinite(before)
    elif np.isfinite(before):
        expected = before * float(np.prod(sizes ** np.array(result.unit.si, dtype=float)))
        np.testing.assert_allclose(after, expected, rtol=1e-6, atol=1e-6 * abs(expected) + 1e-12)


@given(st.data())
@settings(max_examples=100, deadline=None)
def test_a_planted_mismatch_is_found(data: st.DataObject) -> None:
    symbols = scalars(*NAMES)
    graph = tape([data.draw(expressions(symbols))], symbols)
    domain = UnitsDomain()
    (result,) = prebound(graph, domain)([domain.symbol(name, GIVEN[name]) for name in graph.inputs])
    if domain.mismatch is not None or result.unit is None:
        return
    wrong = domain.operation("ADD")(result, domain.symbol("extra", (result.unit * parse("K")).text))
    assert domain.mismatch is not None
    assert domain.mismatch.startswith("sum: ")
    assert wrong.unit == result.unit


def test_gains_get_the_unit_that_the_equations_force() -> None:
    k, c, q, omega, u = scalars("k", "c", "q[1]", "omega[1]", "u[1]")
    law = tape([-k * q - c * omega, u], [k, c, q, omega, u])
    result = judge(law, {"q[1]": "1", "omega[1]": "rad/s", "u[1]": "N*m", "k": None}, [(0, 1)])
    assert result.consistent
    assert result.inferred == {"k": "N m", "c": "N m s"}


def test_units_are_found_through_powers_roots_and_other_unknowns() -> None:
    k, m, x, gamma = scalars("k", "m", "x", "gamma")
    result = judge(tape([ca.tanh(ca.sqrt(k * x) + gamma), k / m, x], [k, m, x, gamma]), {"x": "m"}, [(1, 2)])
    assert result.inferred == {"k": "m^-1", "m": "m^-2", "gamma": "1"}


def test_what_stays_open_is_not_inferred() -> None:
    k, m, x = scalars("k", "m", "x")
    result = judge(tape([k * m + x], [k, m, x]), {"x": "kg"})
    assert result.consistent
    assert result.inferred == {}


def test_the_first_mismatch_is_told_in_words() -> None:
    length, k, q, omega = scalars("l", "k", "q[1]", "omega[1]")
    with unfolded():
        left = q + length * (omega + k * q)
    result = judge(tape([left], [length, k, q, omega]), {"l": "s/(kg m^2)", "q[1]": "1", "omega[1]": "rad/s"})
    assert not result.consistent
    assert result.mismatch == "sum: q[1] has unit 1, l*(omega[1] + k*q[1]) has kg^-1 m^-2"
    assert result.inferred == {"k": "s^-1"}


@pytest.mark.parametrize(
    ("write", "mismatch"),
    [
        (lambda x, t: ca.sin(x), "sin: x has unit m, not a pure number"),
        (lambda x, t: x < t, "comparison: x has unit m, t has s"),
        (ca.fmin, "minimum: x has unit m, t has s"),
        (lambda x, t: x + 1, "sum: x has unit m, 1 has 1"),
        (lambda x, t: x - t**2, "difference: x has unit m, t^2 has s^2"),
        (lambda x, t: x ** (t / t), "base of a power: x has unit m, not a pure number"),
        (lambda x, t: ca.exp(-t), "exp: -t has unit s, not a pure number"),
        (
            lambda x, t: ca.if_else(x < 2 * x, x, t),
            "sum: if(x < 2*x, x) has unit m, if(not(x < 2*x), t) has s",
        ),
    ],
)
def test_mismatches(write: object, mismatch: str) -> None:
    x, t = scalars("x", "t")
    with unfolded():
        graph = tape([write(x, t)], [x, t])  # type: ignore[operator]
    assert judge(graph, {"x": "m", "t": "s"}).mismatch == mismatch


def test_an_equation_between_outputs() -> None:
    x, t = scalars("x", "t")
    result = judge(tape([x, x / t], [x, t]), {"x": "m", "t": "s"}, [(0, 1)])
    assert result.mismatch == "equation: x has unit m, x/t has m s^-1"


def test_zero_fits_every_unit_and_numbers_are_pure() -> None:
    x, third = scalars("x", "1/3")
    with unfolded():
        root = x**third
        graph = tape([x + 0, ca.fmax(x, 0), 0 * x + x, root, root * x ** (1 - third), x], [x, third])
    domain = UnitsDomain()
    outputs = prebound(graph, domain)([domain.symbol(name, "m") for name in graph.inputs])
    assert domain.mismatch is None
    assert [out.unit for out in outputs] == [parse(u) for u in ("m", "m", "m", "m^(1/3)", "m", "m")]


def test_texts_are_short_and_balanced() -> None:
    names = [f"variable_{k}" for k in range(12)]
    x = scalars(*names)
    with unfolded():
        long = x[0]
        for other in x[1:]:
            long = ca.tanh(long * other) - other / (long + 1)
    units: dict[str, str | None] = dict.fromkeys(names, "1")
    result = judge(tape([long, x[0]], x), units | {"variable_11": "m"}, [])
    assert result.mismatch is not None
    parts = result.mismatch.split(" has unit ")
    assert len(parts[0]) <= 80
    assert result.mismatch.count("(") == result.mismatch.count(")")


def test_a_text_that_is_no_unit_is_an_error() -> None:
    (x,) = scalars("x")
    with pytest.raises(UnitError, match="'mile'"):
        judge(tape([x], [x]), {"x": "mile"})


def test_pure_is_the_unit_of_signs_and_quotients() -> None:
    domain = UnitsDomain()
    x = domain.symbol("x", "m")
    assert domain.operation("SIGN")(x).unit == PURE
    assert domain.operation("ATAN2")(x, x).unit == PURE
    assert domain.operation("CONSTPOW")(x, domain.constant(Fraction(5, 3))).unit == parse("m^(5/3)")
    assert len(BASE) == len(PURE.si)
