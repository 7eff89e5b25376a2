"""The exact domain: its values against mpmath and SymPy, identities that it must prove, and near misses."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import mpmath
import pytest
import sympy
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from symctrl.domains.domain import Unsupported
from symctrl.domains.fraction import FractionDomain, NoExactValue
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
from tests.domains.exactly import Meant, Numbers, Undefined, exactly, is_zero, tape, values

x, y, z, g, t = (symbol(name) for name in "xyzgt")
TINY = lift("1/1000000000000000000000000000000")
small = st.sampled_from([-3, -2, -1, 1, 2, 3]).map(lift)
rational = st.fractions(-3, 3, max_denominator=7)
RATIONAL = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
}
OPAQUE: dict[str, Callable[[Expr], Expr]] = {
    "sqrt": sqrt,
    "|.|": absolute,
    "sgn": sgn,
    "exp": exp,
    "sin": sin,
    "cos": cos,
    "tanh": tanh,
    "sinh": sinh,
    "log": log,
    "^1/3": lambda a: power(a, "1/3"),
    "^-3/2": lambda a: power(a, "-3/2"),
    "^2/3": lambda a: power(a, "2/3"),
    "^g": lambda a: power(a, g),
    "^(g-1)": lambda a: power(a, g - 1),
    "^2": lambda a: a**2,
    "^-1": lambda a: a**-1,
    "-": lambda a: -a,
    "min": lambda a: minimum(a, y),
    "max": lambda a: maximum(x, a),
    "2": lambda a: a / 2,
}


def trees(leaves: st.SearchStrategy[Expr], unary: bool, size: int) -> st.SearchStrategy[Expr]:
    def grown(inner: st.SearchStrategy[Expr]) -> st.SearchStrategy[Expr]:
        binary = st.builds(lambda op, a, b: RATIONAL[op](a, b), st.sampled_from(list(RATIONAL)), inner, inner)
        if not unary:
            return binary
        return binary | st.builds(lambda op, a: OPAQUE[op](a), st.sampled_from(list(OPAQUE)), inner)

    return st.recursive(leaves, grown, max_leaves=size)


quotients = trees(st.sampled_from([x, y, z]) | small, False, 7)
anything = trees(st.sampled_from([x, y, x, y, x * y, x + y]) | small, True, 4)


def symbolic(expr: Expr) -> sympy.Expr:
    """The expression in SymPy."""
    from symctrl.domains.sympy_ import SympyDomain

    listing = tape(expr)
    return values(listing, SympyDomain(), sympy.Symbol)[0]


def written(expr: sympy.Expr) -> Expr:
    """A rational expression of SymPy as an Expr."""
    if expr.is_Rational:
        return lift(str(expr))
    if expr.is_Symbol:
        return symbol(expr.name)
    if expr.is_Pow:
        return written(expr.base) ** int(expr.exp)
    parts = [written(a) for a in expr.args]
    result = parts[0]
    for part in parts[1:]:
        result = result + part if expr.is_Add else result * part
    return result


# Rational functions


@given(quotients)
@settings(max_examples=120, deadline=None)
def test_a_quotient_equals_its_forms_by_sympy(expr: Expr) -> None:
    """cancel and factor of SymPy are the same function, and a changed one is another."""
    try:
        is_zero(expr)
    except NowhereDefined:
        assert _divides_by_zero(expr)
        return
    for form in (sympy.cancel(symbolic(expr)), sympy.factor(symbolic(expr))):
        assert is_zero(expr - written(form))
        assert not is_zero(expr - written(form) - TINY * x)


def _divides_by_zero(expr: Expr) -> bool:
    """Has the expression no value at many points?"""
    listing = tape(expr)
    for k in range(1, 40):
        try:
            values(listing, FractionDomain(), lambda name, k=k: Fraction(k * k + 7 * ord(name) + 1, k + 2))
        except NoExactValue:
            continue
        return False
    return True


@given(quotients, st.tuples(rational, rational, rational))
@settings(max_examples=120, deadline=None)
def test_a_quotient_has_the_value_of_fractions(expr: Expr, at: tuple[Fraction, ...]) -> None:
    point = dict(zip("xyz", at, strict=True))
    listing = tape(expr)
    try:
        direct = values(listing, FractionDomain(), point.__getitem__)[0]
    except NoExactValue:
        assume(False)

    def evaluate(domain: Any, found: list[Any]) -> Fraction:
        simple = domain.simplified(found[0])
        total = Fraction(0)
        for key, p in simple.items():
            below = Fraction(1)
            for k, e in key:
                below *= _number(domain.field, domain.field.factors[k], point) ** e
            total += _number(domain.field, p, point) / below
        return total

    assert exactly(evaluate, expr) == direct


def _number(field: Any, p: Any, point: dict[str, Fraction]) -> Fraction:
    total = Fraction(0)
    for exponents, c in p.terms():
        term = Fraction(int(c.p), int(c.q))
        for v, e in enumerate(exponents):
            if e:
                term *= point[field.generators[field.size - 1 - v].name] ** int(e)
        total += term
    return total


# Everything else


@given(anything, st.lists(st.tuples(rational, rational, rational), min_size=1, max_size=4))
@settings(max_examples=250, deadline=None)
def test_a_value_stands_for_the_number_that_mpmath_finds(
    expr: Expr, places: list[tuple[Fraction, ...]]
) -> None:
    """Where every root, power and quotient of the exact value is defined, it is the value of the expression,
    and all relations between the generators hold there: what is claimed to be zero vanishes."""

    def look(domain: Any, found: list[Any]) -> None:
        with mpmath.workdps(60):
            for place in places:
                point = {name: Numbers().constant(v) for name, v in zip("xyg", place, strict=True)}
                try:
                    meant = Meant(domain.field, point)
                    shown = meant.value(found[0])
                    direct = values(listing, Numbers(), point.__getitem__)[0]
                except Undefined:
                    continue
                size = mpmath.mpf(10) ** -30 * (1 + abs(direct))
                assert abs(shown - direct) <= size, (expr, place)
                for relation in domain.field.relations:
                    assert (
                        abs(meant.polynomial(relation))
                        <= mpmath.mpf(10) ** -30 * max(1, *map(abs, meant.known)) ** 8
                    )
                if domain.is_zero(found[0]):
                    assert abs(direct) <= size

    listing = tape(expr)
    try:
        exactly(look, expr)
    except (Unsupported, NowhereDefined, OverflowError):
        assume(False)


ALIKE: dict[str, Callable[[Callable[[Expr], Expr], Expr, Expr], Expr]] = {
    "f(a b) = f(a) f(b)": lambda f, a, b: f(a * b) - f(a) * f(b),
    "f(a/b) = f(a)/f(b)": lambda f, a, b: f(a / b) - f(a) / f(b),
    "f(a + b) = f(a) + f(b)": lambda f, a, b: f(a + b) - f(a) - f(b),
    "f(a + b) = f(a) f(b)": lambda f, a, b: f(a + b) - f(a) * f(b),
    "f(f(a)) = f(a)": lambda f, a, b: f(f(a)) - f(a),
    "f(f(a)) = a": lambda f, a, b: f(f(a)) - a,
    "f(-a) = f(a)": lambda f, a, b: f(-a) - f(a),
    "f(-a) = -f(a)": lambda f, a, b: f(-a) + f(a),
    "f(1/a) = 1/f(a)": lambda f, a, b: f(1 / a) * f(a) - 1,
    "f(a^2) = f(a)^2": lambda f, a, b: f(a**2) - f(a) ** 2,
    "f(a)^2 = 1": lambda f, a, b: f(a) ** 2 - 1,
    "f(a) a = |a|": lambda f, a, b: f(a) * a - absolute(a),
    "f(a^2) = |a|": lambda f, a, b: f(a**2) - absolute(a),
    "f(a) = a": lambda f, a, b: f(a) - a,
}


@pytest.mark.parametrize("law", ALIKE)
@given(st.data())
@settings(max_examples=60, deadline=None)
def test_what_is_claimed_to_be_zero_vanishes(law: str, data: st.DataObject) -> None:
    """Laws that hold for some operations and not for others."""
    f = OPAQUE[data.draw(st.sampled_from(list(OPAQUE)))]
    inner = trees(st.sampled_from([x, y, -x, x * y, x + y, x**2, lift(2), lift(-3)]), True, 2)
    expr = ALIKE[law](f, data.draw(inner), data.draw(inner))
    listing = tape(expr)

    def look(domain: Any, found: list[Any]) -> None:
        if not domain.is_zero(found[0]):
            return
        with mpmath.workdps(50):
            for place in data.draw(st.lists(st.tuples(rational, rational, rational), min_size=6, max_size=6)):
                point = {name: Numbers().constant(v) for name, v in zip("xyg", place, strict=True)}
                try:
                    Meant(domain.field, point).value(found[0])
                    direct = values(listing, Numbers(), point.__getitem__)[0]
                except Undefined:
                    continue
                assert abs(direct) < 1e-30, (expr, place)

    try:
        exactly(look, expr)
    except (Unsupported, NowhereDefined, OverflowError):
        assume(False)


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
