"""What the exact domain must show to be zero, near misses that it must not, and what has no value."""

from __future__ import annotations

from typing import Any

import pytest

from symctrl.domains.domain import Unsupported
from symctrl.domains.opaque import NowhereDefined
from symctrl.expr import Expr, lift, symbol
from symctrl.vectors import (
    absolute,
    atan,
    cos,
    cosh,
    cross,
    exp,
    eye,
    log,
    maximum,
    minimum,
    power,
    sgn,
    signed_power,
    sin,
    sinh,
    skew,
    sqrt,
    stack,
    tan,
    tanh,
)
from tests.domains.exactly import exactly, is_zero

x, y, z, g, t = (symbol(name) for name in "xyzgt")
TINY = lift("1/1000000000000000000000000000000")

TRUE = {
    "sin(x + y)": sin(x + y) - sin(x) * cos(y) - cos(x) * sin(y),
    "cos(x - y)": cos(x - y) - cos(x) * cos(y) - sin(x) * sin(y),
    "cos(2 x)": cos(2 * x) - 2 * cos(x) ** 2 + 1,
    "sin(3 x)": sin(3 * x) - 3 * sin(x) + 4 * sin(x) ** 3,
    "half angles": 2 * sin(x / 2) ** 2 - 1 + cos(x),
    "a third of an angle": cos(x) - 4 * cos(x / 3) ** 3 + 3 * cos(x / 3),
    "tan(x + y)": tan(x + y) * (1 - tan(x) * tan(y)) - tan(x) - tan(y),
    "1 + tan^2": 1 + tan(x) ** 2 - 1 / cos(x) ** 2,
    "sqrt(x) sqrt(y)": sqrt(x) * sqrt(y) - sqrt(x * y),
    "sqrt(x/y)": sqrt(x / y) * sqrt(y) - sqrt(x),
    "sqrt(8)": sqrt(lift(8)) - 2 * sqrt(lift(2)),
    "sqrt(1/2)": sqrt(lift("1/2")) - sqrt(lift(2)) / 2,
    "sqrt(x^2)": sqrt(x**2) - absolute(x),
    "sqrt(x^2 y^3)": sqrt(x**2 * y**3) - absolute(x) * y * sqrt(y),
    "sqrt of a square of a sum": sqrt(x**2 - 2 * x * y + y**2) - absolute(x - y),
    "a root below": 1 / (sqrt(x) + sqrt(y)) - (sqrt(x) - sqrt(y)) / (x - y),
    "nested roots": sqrt(sqrt(x)) - power(x, "1/4"),
    "roots of several degrees": power(x, "1/2") * power(x, "1/3") - power(x, "5/6"),
    "(x^(1/3))^3": power(x, "1/3") ** 3 - x,
    "x^(-3/2)": power(x, "-3/2") * x * sqrt(x) - 1,
    "|x y|": absolute(x * y) - absolute(x) * absolute(y),
    "|x/y|": absolute(x / y) * absolute(y) - absolute(x),
    "|x|^2": absolute(x) ** 2 - x**2,
    "|-x|": absolute(-x) - absolute(x),
    "||x||": absolute(absolute(x)) - absolute(x),
    "sgn(x) x": sgn(x) * x - absolute(x),
    "sgn(x) |x|": sgn(x) * absolute(x) - x,
    "sgn(x y)": sgn(x * y) - sgn(x) * sgn(y),
    "sgn(-2 x)": sgn(-2 * x) + sgn(x),
    "sgn(1/x)": sgn(1 / x) - sgn(x),
    "sgn(exp(x))": sgn(exp(x)) - 1,
    "|x| |x|^(g - 1)": absolute(x) * power(absolute(x), g - 1) - power(absolute(x), g),
    "signed powers": signed_power(x, g) * x - power(absolute(x), g + 1),
    "x^g y^g": power(x**2 + 1, g) * power(y**2 + 1, g) - power((x**2 + 1) * (y**2 + 1), g),
    "4^g": power(lift(4), g) - power(lift(2), g) ** 2,
    "x^(g/2)": power(absolute(x), g / 2) ** 2 - power(absolute(x), g),
    "exp(x + y)": exp(x + y) - exp(x) * exp(y),
    "exp(x)^-1": exp(-x) * exp(x) - 1,
    "exp(x/2)": exp(x / 2) ** 2 - exp(x),
    "cosh^2 - sinh^2": cosh(x) ** 2 - sinh(x) ** 2 - 1,
    "sinh(2 x)": sinh(2 * x) - 2 * sinh(x) * cosh(x),
    "tanh(-x)": tanh(-x) + tanh(x),
    "tanh((x^2 - 1)/(x - 1))": tanh((x**2 - 1) / (x - 1)) - tanh(x + 1),
    "atan is odd": atan(x - y) + atan(y - x),
    "log of equal arguments": log((x + y) ** 2) - log(x**2 + 2 * x * y + y**2),
    "min + max": minimum(x, y) + maximum(x, y) - x - y,
    "max - min": maximum(x, y) - minimum(x, y) - absolute(x - y),
    "x/x": x / x - 1,
    "(x/y) y": (x / y) * y - x,
    "cube": (x - y) * (x**2 + x * y + y**2) - x**3 + y**3,
}

FALSE = {
    "sqrt(x^2) = x": sqrt(x**2) - x,
    "sqrt(x + y) = sqrt(x) + sqrt(y)": sqrt(x + y) - sqrt(x) - sqrt(y),
    "sqrt(x^2 + y^2) = |x| + |y|": sqrt(x**2 + y**2) - absolute(x) - absolute(y),
    "(x^2)^(3/2) = x^3": power(x**2, "3/2") - x**3,
    "(x^2)^(1/3) = x": power(x**2, "1/3") - x,
    "sgn(x)^2 = 1": sgn(x) ** 2 - 1,
    "sgn(x^2) = 1": sgn(x**2) - 1,
    "sgn(x + y) = sgn(x) + sgn(y)": sgn(x + y) - sgn(x) - sgn(y),
    "sgn(|x|) = 1": sgn(absolute(x)) - 1,
    "sgn(x)^2 sgn(y)^2 = 1": sgn(x) ** 2 * sgn(y) ** 2 - 1,
    "|x + y| = |x| + |y|": absolute(x + y) - absolute(x) - absolute(y),
    "|x| = x": absolute(x) - x,
    "|x - y| = x - y": absolute(x - y) - x + y,
    "sin(2 x) = 2 sin(x)": sin(2 * x) - 2 * sin(x),
    "sin(x) = sqrt(1 - cos^2)": sin(x) - sqrt(1 - cos(x) ** 2),
    "cos(x/2) = sqrt((1 + cos x)/2)": cos(x / 2) - sqrt((1 + cos(x)) / 2),
    "cos(x) = cos(y)": cos(x) - cos(y),
    "exp(x y) = exp(x) exp(y)": exp(x * y) - exp(x) * exp(y),
    "tanh is even": tanh(-x) - tanh(x),
    "tanh is linear": tanh(2 * x) - 2 * tanh(x),
    "log is odd": log(x) + log(-x),
    "x^g x = x^g": power(absolute(x), g) * x - power(absolute(x), g),
    "|x|^g = x^g sgn": signed_power(x, g) - power(absolute(x), g),
    "2^g = 3^g": power(lift(2), g) - power(lift(3), g),
    "0^g = 0": power(absolute(x), g) - absolute(x),
    "min is the first": minimum(x, y) - x,
    "1e-30": x + TINY * y - x,
}


@pytest.mark.parametrize("name", TRUE)
def test_a_true_identity_is_proved(name: str) -> None:
    assert is_zero(TRUE[name])


@pytest.mark.parametrize("name", [*TRUE])
def test_a_true_identity_with_a_term_more_is_not(name: str) -> None:
    assert not is_zero(TRUE[name] + TINY * t)


@pytest.mark.parametrize("name", FALSE)
def test_a_near_miss_is_not_proved(name: str) -> None:
    assert not is_zero(FALSE[name])


UNDER = {
    "sqrt(x^2) = x": (sqrt(x**2) - x, "nonnegative"),
    "|x| = x": (absolute(x) - x, "nonnegative"),
    "sgn(x) = 1": (sgn(x) - 1, "positive"),
    "sgn(x^2) = 1": (sgn(x**2) - 1, "nonzero"),
    "sgn(x)^2 = 1": (sgn(x) ** 2 - 1, "nonzero"),
    "|x + y^2| = x + y^2": (absolute(x + y**2) - x - y**2, "nonnegative"),
    "x^g x^(1 - g)": (power(x, g) * power(x, 1 - g) - x, "positive"),
    "(x y)^g": (power(x * (y**2 + 1), g) - power(x, g) * power(y**2 + 1, g), "nonnegative"),
}
WEAKER = {"positive": "nonnegative", "nonzero": "nonnegative", "nonnegative": "nonzero"}


@pytest.mark.parametrize("name", UNDER)
def test_a_known_sign_is_used(name: str) -> None:
    expr, kind = UNDER[name]
    assert is_zero(expr, signs={"x": kind})


@pytest.mark.parametrize(
    "name", ["sqrt(x^2) = x", "|x| = x", "sgn(x) = 1", "sgn(x^2) = 1", "sgn(x)^2 = 1", "|x + y^2| = x + y^2"]
)
def test_a_weaker_sign_is_not_enough(name: str) -> None:
    expr, kind = UNDER[name]
    assert not is_zero(expr, signs={"x": WEAKER[kind]})


def test_what_is_learnt_of_one_symbol_is_not_said_of_another() -> None:
    """|x| goes away when x is known not to be negative, and other generators move up."""
    assert not is_zero(
        absolute(x) + sqrt(x) + absolute(exp(y) - z) + sqrt(y) - x - sqrt(x) - exp(y) + z - sqrt(y)
    )
    assert is_zero(absolute(x) + sqrt(x) + absolute(y) + sqrt(y) - x - sqrt(x) - y - sqrt(y))


@pytest.mark.parametrize(
    "expr",
    [
        1 / (x - x),
        x / (x * y - y * x),
        sqrt(lift(-2)),
        sqrt(-exp(x)),
        power(x - x, "-1/2"),
        1 / (absolute(x) ** 2 - x**2),
        1 / (sin(x) ** 2 + cos(x) ** 2 - 1),
        sqrt(-1 - x**2),
    ],
)
def test_what_has_no_value_anywhere_is_said_to_have_none(expr: Expr) -> None:
    with pytest.raises(NowhereDefined):
        is_zero(expr)


@pytest.mark.parametrize("expr", [sqrt(-(x**2)), sqrt(-absolute(x)), sqrt(x) + sqrt(-x), power(x - x, g)])
def test_what_has_a_value_at_a_few_points_is_not_decided(expr: Expr) -> None:
    with pytest.raises(Unsupported):
        is_zero(expr)


# Relations


q = symbol("q", (3, 1))
q0 = symbol("q0")
w = symbol("w", (3, 1))
UNIT = (q.T @ q + q0**2 - 1,)


def test_a_division_by_a_relation_is_nowhere_defined() -> None:
    with pytest.raises(NowhereDefined):
        is_zero(1 / (q.T @ q + q0**2 - 1), zero=UNIT)


def test_the_direction_cosine_matrix_of_a_unit_quaternion_is_a_rotation() -> None:
    R = (q0**2 - q.T @ q) * eye(3) + 2 * (q @ q.T) - 2 * q0 * skew(q)
    entries = _entries(R @ R.T - eye(3))
    assert exactly(lambda d, v: all(map(d.is_zero, v)), *entries, zero=UNIT)
    assert not exactly(lambda d, v: any(map(d.is_zero, v[:1])), *entries)


def test_the_scalar_part_comes_back_from_a_root() -> None:
    assert is_zero(sqrt(1 - q.T @ q) - absolute(q0), zero=UNIT)
    assert not is_zero(sqrt(1 - q.T @ q) - q0, zero=UNIT)
    assert is_zero(sqrt(1 - q.T @ q) - q0, zero=UNIT, signs={"q0": "nonnegative"})


def test_a_quotient_by_the_scalar_part() -> None:
    assert is_zero((1 - q.T @ q) / q0 - q0, zero=UNIT)
    assert is_zero(1 / (1 - q.T @ q) - 1 / q0**2, zero=UNIT)


def _entries(M: Expr) -> list[Expr]:
    return [M[r, c] for c in range(M.shape[1]) for r in range(M.shape[0])]


def test_poisson_for_the_angles_3_2_1() -> None:
    """The rate of R = R1(phi) R2(theta) R3(psi) is -w^x R."""
    names = ("phi", "theta", "psi")
    angles = stack(*[symbol(n) for n in names])
    phi, theta, psi = (angles[k] for k in range(3))
    R = _first(phi) @ _second(theta) @ _third(psi)
    rates = stack(
        w[0] + sin(phi) * tan(theta) * w[1] + cos(phi) * tan(theta) * w[2],
        cos(phi) * w[1] - sin(phi) * w[2],
        (sin(phi) * w[1] + cos(phi) * w[2]) / cos(theta),
    )
    rate = _along(R, angles, rates)
    assert exactly(lambda d, v: all(map(d.is_zero, v)), *_entries(rate + skew(w) @ R))
    assert not exactly(lambda d, v: any(map(d.is_zero, v[:3])), *_entries(rate - skew(w) @ R))


def _first(a: Expr) -> Expr:
    return stack(*[_row(*r) for r in ((1, 0, 0), (0, cos(a), sin(a)), (0, -sin(a), cos(a)))])


def _second(a: Expr) -> Expr:
    return stack(*[_row(*r) for r in ((cos(a), 0, -sin(a)), (0, 1, 0), (sin(a), 0, cos(a)))])


def _third(a: Expr) -> Expr:
    return stack(*[_row(*r) for r in ((cos(a), sin(a), 0), (-sin(a), cos(a), 0), (0, 0, 1))])


def _row(*entries: Any) -> Expr:
    from symctrl.vectors import row

    return row(*entries)


def _along(M: Expr, at: Expr, rates: Expr) -> Expr:
    """The derivative of M by CasADi, along rates."""
    import casadi as ca

    from symctrl.expr import foreign

    change = ca.reshape(ca.mtimes(ca.jacobian(ca.vec(M.sx), at.sx), rates.sx), *M.shape)
    return foreign(change, "rate")


def test_modified_rodrigues_parameters_turn_into_a_rotation() -> None:
    """R(s) = I + (8 s^x s^x - 4 (1 - s's) s^x)/(1 + s's)^2 (Schaub and Junkins) is orthogonal."""
    s = symbol("s", (3, 1))
    n = s.T @ s
    R = eye(3) + (8 * (skew(s) @ skew(s)) - 4 * (1 - n) * skew(s)) / (1 + n) ** 2
    assert exactly(lambda d, v: all(map(d.is_zero, v)), *_entries(R.T @ R - eye(3)))


def test_cross_products_of_turned_vectors() -> None:
    """A rotation goes through cross products, and a triple product is expanded."""
    a, b, c = (symbol(n, (3, 1)) for n in ("a", "b", "c"))
    R = (q0**2 - q.T @ q) * eye(3) + 2 * (q @ q.T) - 2 * q0 * skew(q)
    left = R @ cross(a, cross(b, c)) / (1 + a.T @ a) + cross(w, cross(w, b)) / q0
    right = cross(R @ a, cross(R @ b, R @ c)) / (1 + a.T @ a) + (w * (w.T @ b) - b * (w.T @ w)) / q0
    assert exactly(lambda d, v: all(map(d.is_zero, v)), *_entries(left - right), zero=UNIT)
    assert not exactly(lambda d, v: any(map(d.is_zero, v)), *_entries(left - right))
