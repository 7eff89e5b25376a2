"""Fields: normal forms, texts that do not depend on order, and the JSON forms of values."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.domains.field import Field, Generator, OutOfGenerators, is_number, key_product, merged

exponents = st.tuples(*[st.integers(0, 3)] * 3)
terms = st.dictionaries(exponents, st.fractions(-3, 3, max_denominator=5), max_size=5)


def polynomial(field, places, wanted):
    total = field.polynomial(0)
    for powers, c in wanted.items():
        term = field.polynomial(c)
        for k, e in zip(places, powers, strict=True):
            term = term * field.variable(k) ** e
        total = total + term
    return total


def circle():
    """z³ = x + y⁴ and y² = 1 - x², over x, y, z: the first brings back powers that the second lowers."""
    field = Field(["x", "y", "z"], 2)
    x, y, z = (field.variable(k) for k in range(3))
    field.add_relation(y**2 + x**2 - 1)
    field.add_relation(z**3 - x - y**4)
    return field


@given(terms, terms)
@settings(max_examples=60, deadline=None)
def test_a_normal_form_is_reduced_and_the_same_for_equal_values(p, q):
    field = circle()
    a, b = (polynomial(field, range(3), t) for t in (p, q))
    normal = field.normal(a)
    assert field.normal(normal) == normal
    assert all(e[field.size - 2] < 2 and e[field.size - 3] < 3 for e, _ in normal.terms())
    assert field.normal(a + b * field.relations[0] + a * b * field.relations[1]) == normal


@given(terms)
@settings(max_examples=40, deadline=None)
def test_no_term_of_a_normal_form_is_divisible_by_the_lead_of_a_relation(p):
    field = Field(["x", "y", "z"], 2)
    x, y, z = (field.variable(k) for k in range(3))
    for zero in (z * x - y, z * y - x, z**2 - 1, y**2 - x**2):
        field.add_relation(zero)
    leads = [next(iter(r.monoms())) for r in field.relations]
    for exponents, _ in field.normal(polynomial(field, range(3), p)).terms():
        assert not any(all(a >= b for a, b in zip(exponents, lead, strict=True)) for lead in leads)


@given(terms)
@settings(max_examples=40, deadline=None)
def test_a_text_does_not_depend_on_the_order_of_generators(p):
    one, other = Field(["x", "y", "z"], 2), Field(["z", "x", "y"], 5)
    assert one.text(polynomial(one, (0, 1, 2), p)) == other.text(polynomial(other, (1, 2, 0), p))


@given(terms, terms)
@settings(max_examples=40, deadline=None)
def test_different_polynomials_have_different_texts(p, q):
    field = Field(["x", "y", "z"], 2)
    a, b = (polynomial(field, range(3), t) for t in (p, q))
    assert (a == b) == (field.text(a) == field.text(b))


@given(terms)
@settings(max_examples=40, deadline=None)
def test_the_json_form_is_read_back(p):
    field = Field(["x", "y", "z"], 2)
    a, again = polynomial(field, range(3), p), field.polynomial(0)
    for c, *powers in field.json(a):
        term = field.polynomial(Fraction(c))
        for k, e in zip(powers[::2], powers[1::2], strict=True):
            term = term * field.variable(k) ** e
        again = again + term
    assert a == again


@given(terms)
@settings(max_examples=40, deadline=None)
def test_only_a_number_is_a_number(p):
    field = Field(["x", "y", "z"], 2)
    assert is_number(polynomial(field, range(3), p)) == all(e == (0, 0, 0) or not c for e, c in p.items())


def test_spare_generators_end():
    field = Field(["x"], 1)
    assert field.add_generator(Generator("abs", argument=field.variable(0))) == 1
    with pytest.raises(OutOfGenerators):
        field.add_generator(Generator("abs", argument=field.variable(1)))


def test_a_generator_knows_what_it_is_made_of():
    field = Field(["x.i", "y.j"], 3)
    x, y = field.variable(0), field.variable(1)
    k = field.add_generator(Generator("abs", argument=x * y))
    sign = field.add_generator(Generator("sign", argument=x * y, partner=k))
    assert field.made_of(sign) == {0, 1, k}
    assert field.letters(sign) == {"i", "j"}
    total = field.add_generator(Generator("sum", "i", y))
    assert field.letters(total) == {"i"}


def test_denominators_multiply_and_equal_ones_are_added():
    field = Field(["x"], 1)
    x = field.variable(0)
    assert key_product(((0, 1), (2, 3)), ((1, 1), (2, 2))) == ((0, 1), (1, 1), (2, 5))
    assert merged([(((0, 1),), x), (((0, 1),), -x), ((), x)]) == {(): x}
