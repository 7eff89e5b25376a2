"""The exact domain: its values against mpmath and SymPy."""

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
    cos,
    exp,
    log,
    maximum,
    minimum,
    power,
    sgn,
    sin,
    sinh,
    sqrt,
    tanh,
)
from tests.domains.exactly import Meant, Numbers, Undefined, exactly, is_zero, tape, values

x, y, z, g = (symbol(name) for name in "xyzg")
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
        for place in data.draw(st.lists(st.tuples(rational, rational, rational), min_size=6, max_size=6)):
            try:
                rough, fine = (residual(domain, found, place, digits) for digits in (50, 100))
            except Undefined:
                continue
            # What is zero shrinks with the rounding errors, however large the terms that cancel.
            assert abs(rough) < 1e-30 or abs(fine) < 1e-30 * abs(rough), (expr, place)

    def residual(domain: Any, found: list[Any], place: Any, digits: int) -> Any:
        with mpmath.workdps(digits):
            point = {name: Numbers().constant(v) for name, v in zip("xyg", place, strict=True)}
            Meant(domain.field, point).value(found[0])
            return values(listing, Numbers(), point.__getitem__)[0]

    try:
        exactly(look, expr)
    except (Unsupported, NowhereDefined, OverflowError):
        assume(False)
