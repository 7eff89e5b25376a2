"""What definitions say of polynomials beside generators: at every point, and no more than that."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from symctrl.kernel.beside import not_negative, pairs_of_one_sign
from symctrl.kernel.conditions import ANY, SIGNS, Signs
from symctrl.kernel.field import Field
from symctrl.kernel.generators import read_generators
from symctrl.kernel.polynomial import Poly, monomial, powers

ROOT, SIZE, T = 2, 3, 4  # generators: x, y, a root of x, |x + y|, and one more
AS_WRITTEN = [[[], [["1", 0, 1]]]]
OF_SUM = [[[], [["1", 0, 1], ["1", 1, 1]]]]
FUNCTIONS = {
    "tanh": math.tanh,
    "erf": math.erf,
    "atan": math.atan,
    "asin": math.asin,
    "log": math.log,
}
DEFINITIONS = [
    *({"function": name, "of": [of]} for name in FUNCTIONS for of in (AS_WRITTEN, OF_SUM)),
    {"exp": OF_SUM},
    {"abs": [["2", 0, 1], ["-3", 1, 1]]},
]
NUMBER = st.floats(-3, 3)


def table(*more):
    field = Field(4 + len(more), [])
    first = [
        {"free": "x"},
        {"free": "y"},
        {"root": 2, "of": [["1", 0, 1]]},
        {"abs": [["1", 0, 1], ["1", 1, 1]]},
    ]
    return field, read_generators([*first, *more], field)


def value(p: Poly, at) -> float:
    return sum(float(c) * math.prod(at[k] ** e for k, e in powers(m)) for m, c in p.items())


def at_point(g, x, y):
    """The values of x, y, sqrt x, |x + y| and the generator g; None where it has none."""
    of = [x, y, math.sqrt(abs(x)), abs(x + y)]
    if g.kind == "abs":
        return [*of, abs(value(g.base, of))]
    a = value(g.args[0][()], of)
    try:
        return [*of, math.exp(a) if g.kind == "exp" else FUNCTIONS[g.name](a)]
    except ValueError:
        return None


@given(st.sampled_from(DEFINITIONS), NUMBER, NUMBER)
def test_what_is_not_negative_is_not_negative_at_any_point(definition, x, y):
    field, generators = table(definition)
    at = at_point(generators[T], x, y)
    assume(at is not None)
    for p, strict in not_negative(field, T, generators[T]):
        assert value(p, at) >= (1e-12 if strict else -1e-12) or (strict and abs(at[T]) > 0.99)


@given(st.sampled_from(DEFINITIONS), NUMBER, NUMBER)
def test_pairs_have_one_sign_at_every_point(definition, x, y):
    field, generators = table(definition)
    at = at_point(generators[T], x, y)
    assume(at is not None)
    for u, v in pairs_of_one_sign(field, T, generators[T]):
        assert value(u, at) * value(v, at) >= -1e-12


LINEAR = st.fixed_dictionaries({k: st.integers(-2, 2) for k in ("1", "x", "y", "n")})


@given(
    LINEAR,
    st.sampled_from([ROOT, SIZE]),
    st.lists(st.tuples(st.sampled_from(["positive", "nonnegative"]), LINEAR), max_size=2),
    st.fractions(-3, 3, max_denominator=3),
    st.fractions(-3, 3, max_denominator=3),
)
def test_signs_beside_roots_and_sizes_hold_wherever_what_is_known_does(terms, n, known, x, y):
    """c n + r for a root n of x and for n = |x + y|, with what is known of two other polynomials."""
    _, generators = table()
    signs = Signs(Field(4, []), generators)
    assume(n == SIZE or x >= 0)
    own = {"1": 0, **{k: monomial([(j, 1)]) for k, j in (("x", 0), ("y", 1), ("n", n))}}
    at = [float(x), float(y), math.sqrt(abs(x)), float(abs(x + y))]
    for kind, of in known:
        p = {own[k]: Fraction(c) for k, c in of.items() if c and k != "n"}
        assume(p and (value(p, at) > 0 or (kind == "nonnegative" and value(p, at) == 0)))
        try:
            signs.learn(kind, {(): p})
        except ValueError:
            assume(False)
    p = {own[k]: c for k, c in terms.items() if c}
    number = value(p, at)
    if abs(number) > 1e-9:
        assert (number > 0) - (number < 0) in signs.of(p)
    elif number == 0:
        assert 0 in signs.of(p)


def own(k, e=1):
    return {monomial([(k, e)]): 1}


def function(name, of=AS_WRITTEN):
    field, generators = table({"function": name, "of": [of]})
    return Signs(field, generators)


def times(k, j):
    return {monomial([(min(k, j), 1), (max(k, j), 1)]): 1}


@pytest.mark.parametrize("name", ["tanh", "atan", "erf", "asin"])
def test_a_function_has_the_sign_of_its_argument(name):
    signs = function(name)
    assert signs.of(times(0, T)) == SIGNS["nonnegative"]
    assert signs.of(times(1, T)) == ANY
    signs.learn("nonzero", {(): own(0)})
    assert signs.of(times(0, T)) == SIGNS["positive"]


@pytest.mark.parametrize("name", ["acos", "floor", "ceil", "log"])
def test_others_do_not(name):
    assert function(name).of(times(0, T)) == ANY


def less(a, p, q):
    return {**{m: Fraction(a) * c for m, c in p.items()}, **{m: -c for m, c in q.items()}}


@pytest.mark.parametrize(
    ("name", "p", "sign"),
    [
        ("tanh", {0: 1, **less(1, {}, own(T))}, "positive"),
        ("tanh", {0: Fraction(99, 100), **less(1, {}, own(T))}, None),
        ("atan", {0: Fraction(11, 7), **less(1, {}, own(T))}, "positive"),
        ("atan", {0: Fraction(3, 2), **less(1, {}, own(T))}, None),
        ("tanh", less(1, times(0, T), own(T, 2)), "nonnegative"),
        ("tanh", less("0.99", times(0, T), own(T, 2)), None),
        ("tanh", less(1, own(T, 2), times(0, T)), None),
        ("asin", less(1, own(T, 2), times(0, T)), "nonnegative"),
        ("asin", less(1, times(0, T), own(T, 2)), None),
        ("erf", less(1, times(0, T), own(T, 2)), None),  # erf'(0) is 2/sqrt(pi), above 1
        ("log", {0: -1, **less(1, own(0), own(T))}, "nonnegative"),
        ("log", {0: Fraction(-11, 10), **less(1, own(0), own(T))}, None),
    ],
)
def test_bounds_and_slopes(name, p, sign):
    found = function(name).of(p)
    assert -1 in found if sign is None else found == SIGNS[sign]


def test_a_logarithm_grows():
    signs = function("log")
    assert signs.of(own(T)) == ANY
    signs.learn("nonnegative", {(): {0: -1, **own(0)}})
    assert signs.of(own(T)) == SIGNS["nonnegative"]


def test_a_square_above_one_puts_the_size_above_one():
    """For |x + y|: (x + y)^2 >= 1."""
    _, generators = table()
    signs = Signs(Field(4, []), generators)
    p = {0: -1, **own(SIZE)}
    assert signs.of(p) == ANY
    square = {**own(0, 2), monomial([(0, 1), (1, 1)]): 2, **own(1, 2)}
    signs.learn("nonnegative", {(): {0: -1, **square}})
    assert signs.of(p) == SIGNS["nonnegative"]
    assert signs.of({0: -2, **own(SIZE)}) == ANY
    assert signs.of({0: -1, **own(0), **own(1)}) == ANY


def test_a_factor_beside_one_that_may_be_zero_has_no_sign():
    """x^2 - y^2 >= 0 says nothing of x - y where x + y may be zero or negative."""
    for kind, sign in ((None, ANY), ("nonnegative", ANY), ("positive", SIGNS["nonnegative"])):
        _, generators = table()
        signs = Signs(Field(4, []), generators)
        signs.learn("nonnegative", {(): less(1, own(0, 2), own(1, 2))})
        for k in (0, 1):
            if kind is not None:
                signs.learn(kind, {(): own(k)})
        assert signs.of(less(1, own(0), own(1))) == sign
