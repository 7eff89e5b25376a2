"""Known signs are right at every sampled point, and what is not known becomes a condition."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given as for_all
from hypothesis import strategies as st

from symctrl.kernel.certificate import Invalid
from symctrl.kernel.conditions import ANY, SIGNS, Signs, determinant, product, total
from symctrl.kernel.field import Field
from symctrl.kernel.generators import Generator, read_generators
from symctrl.kernel.polynomial import Poly, monomial
from symctrl.kernel.values import Condition

SIGN_SETS = st.sets(st.sampled_from([-1, 0, 1]), min_size=1).map(frozenset)


def x(exponent: int = 1) -> Poly:
    return {monomial([(0, exponent)]): 1}


def y(exponent: int = 1) -> Poly:
    return {monomial([(1, exponent)]): 1}


def signs(*extra: dict, factors: tuple[Poly, ...] = ()) -> Signs:
    field = Field(2 + len(extra), list(factors))
    table = read_generators([{"free": "x"}, {"free": "y"}, *extra], field)
    return Signs(field, table)


@for_all(SIGN_SETS, SIGN_SETS)
def test_sign_sets_contain_every_case(a, b):
    numbers = [Fraction(n, 2) for n in range(-3, 4)]
    of = {n: (n > 0) - (n < 0) for n in numbers}
    for p in numbers:
        for q in numbers:
            if of[p] in a and of[q] in b:
                s, t = p + q, p * q
                assert (s > 0) - (s < 0) in total(a, b)
                assert (t > 0) - (t < 0) in product(a, b)


def test_signs_of_sums_are_no_larger_than_they_must_be():
    assert total(frozenset((0, 1)), frozenset((1,))) == SIGNS["positive"]
    assert total(frozenset((0,)), frozenset((0,))) == SIGNS["zero"]
    assert total(frozenset((1,)), frozenset((-1,))) == ANY


KNOWN = st.sampled_from(["positive", "nonnegative", "nonzero", None])
NUMBER = st.fractions(-3, 3, max_denominator=4)


@for_all(
    KNOWN,
    KNOWN,
    NUMBER,
    NUMBER,
    st.dictionaries(st.tuples(st.integers(0, 3), st.integers(0, 3)), NUMBER, max_size=4),
)
def test_a_known_sign_holds_at_every_admissible_point(about_x, about_y, at_x, at_y, terms):
    at_point = {
        "positive": lambda n: n > 0,
        "nonnegative": lambda n: n >= 0,
        "nonzero": bool,
        None: lambda n: True,
    }
    if not at_point[about_x](at_x) or not at_point[about_y](at_y):
        return
    known = signs()
    for kind, p in ((about_x, x()), (about_y, y())):
        if kind is not None:
            known.learn(kind, {(): p})
    p = {monomial([(0, a), (1, b)]): c for (a, b), c in terms.items() if c}
    number = sum((c * at_x**a * at_y**b for (a, b), c in terms.items()), Fraction(0))
    assert (number > 0) - (number < 0) in known.of(p)


def test_nothing_is_known_of_a_free_symbol():
    known = signs()
    assert known.of(x()) == ANY
    assert known.of(x(2)) == SIGNS["nonnegative"]
    assert known.of({}) == SIGNS["zero"]
    assert known.of({0: -2}) == frozenset((-1,))


def test_a_symbol_named_like_a_function_has_no_sign():
    field = Field(1, [])
    assert Signs(field, [Generator("free", name="cosh")]).of({monomial([(0, 1)]): 1}) == ANY


def test_multiples_and_negatives_of_what_is_given():
    known = signs()
    known.learn("positive", {(): {**x(), monomial([(1, 1)]): -2}})  # x - 2 y > 0
    assert (
        known.of({monomial([(0, 1)]): Fraction(1, 3), monomial([(1, 1)]): Fraction(-2, 3)})
        == SIGNS["positive"]
    )
    assert known.of({monomial([(0, 1)]): -1, monomial([(1, 1)]): 2}) == frozenset((-1,))
    assert known.of({**x(), monomial([(1, 1)]): -2, **x(2)}) == SIGNS["positive"]
    assert known.of({**x(), monomial([(1, 1)]): 2}) == ANY


@pytest.mark.parametrize(
    ("definition", "of"),
    [
        ({"root": 2, "of": [["1", 0, 1]]}, "nonnegative"),
        ({"abs": [["1", 0, 1]]}, "nonnegative"),
        ({"exp": [[[], [["1", 0, 1]]]]}, "positive"),
        ({"function": "acos", "of": [[[[], [["1", 0, 1]]]]]}, "nonnegative"),
        ({"power": [["1", 0, 1]], "exponent": [[[], [["1", 1, 1]]]]}, "nonnegative"),
        ({"root": 2, "of": [["1"], ["1", 0, 2]]}, "positive"),
        ({"cos": [[[], [["1", 0, 1]]]]}, None),
        ({"function": "tanh", "of": [[[[], [["1", 0, 1]]]]]}, None),
    ],
)
def test_signs_by_definition(definition, of):
    assert signs(definition).of({monomial([(2, 1)]): 1}) == (ANY if of is None else SIGNS[of])


def test_what_is_not_known_becomes_a_condition():
    known = signs()
    known.require("nonzero", {monomial([(0, 2)]): -2, monomial([(0, 1), (1, 1)]): Fraction(4, 3)}, "this")
    known.require("nonnegative", {monomial([(1, 1)]): Fraction(-1, 2)}, "this")
    known.require("nonnegative", x(2), "this")
    assert set(known.needed) == {Condition("nonzero", "2*x*y - 3*x^2"), Condition("nonnegative", "-y")}


@pytest.mark.parametrize(
    ("kind", "p"), [("nonzero", {}), ("positive", {}), ("positive", {0: -1}), ("nonnegative", {0: -1})]
)
def test_what_is_never_so_is_refused(kind, p):
    with pytest.raises(Invalid, match="never"):
        signs().require(kind, p, "this")


def test_assumptions_that_cannot_be_met_are_refused():
    known = signs()
    known.learn("positive", {(): x()})
    with pytest.raises(Invalid, match="contradict"):
        known.learn("positive", {(): {monomial([(0, 1)]): -1}})
    with pytest.raises(Invalid, match="never be met"):
        known.learn("nonzero", {})


def test_a_quotient_has_the_sign_of_its_carrier():
    known = signs(factors=(y(),))
    known.learn("positive", {((0, 1),): x()})  # x / y > 0
    assert known.of({monomial([(0, 1), (1, 1)]): 1}) == SIGNS["positive"]
    assert known.of_value({((0, 1),): x()}) == SIGNS["positive"]
    assert known.of_value({((0, 2),): x(2)}) == SIGNS["nonnegative"]


@pytest.mark.parametrize("strict", [True, False])
def test_principal_minors_of_an_assumed_matrix(strict):
    known = signs()
    matrix = [[{(): x()}, {(): {0: 2}}], [{(): {0: 2}}, {(): y()}]]
    known.learn_matrix(matrix, strict)
    minor = determinant(known.field, matrix)[()]
    assert minor == {monomial([(0, 1), (1, 1)]): 1, 0: -4}
    for p in (x(), y(), minor):
        known.require("nonnegative", p, "this")
    assert not known.needed
    known.require("positive", minor, "this")
    assert set(known.needed) == (set() if strict else {Condition("positive", "x*y - 4")})
