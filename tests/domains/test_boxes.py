"""Boxes enclose: every exact value at a point of the arguments' boxes lies in the box of the result."""

from fractions import Fraction
from math import nextafter

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.domains.boxes import Box, Boxes, exact_array, quiet, rounded
from symctrl.domains.domain import Unsupported
from symctrl.domains.fraction import FractionDomain, Irrational, Undefined
from symctrl.graph import ARITY

FLOATS, EXACT, POINT = Boxes(), Boxes(exact=True), FractionDomain()
ONE = ["NEG", "SQ", "INV", "FABS", "SQRT", "SIGN", "TWICE"]
TWO = ["ADD", "SUB", "MUL", "DIV", "FMIN", "FMAX"]
ENDS = (
    st.fractions(-4, 4, max_denominator=8)
    | st.fractions(max_denominator=10**9)
    | st.floats(allow_nan=False, allow_infinity=False).map(Fraction)
)
BOX = st.tuples(ENDS, ENDS).map(sorted)
PART = st.fractions(0, 1, max_denominator=50)


def enclosed(box, value):
    """Is the exact value in the box, or the box undecided?"""
    low, high = box.low[0], box.high[0]
    if is_nan(low) or is_nan(high):
        return True
    below = low == -np.inf or Fraction(low) <= value
    return below and (high == np.inf or value <= Fraction(high))


def is_nan(end):
    return not isinstance(end, Fraction) and np.isnan(end)


def evaluated(domain, op, boxes):
    with quiet():
        return domain.operation(op)(*boxes)


@pytest.mark.parametrize("domain", [FLOATS, EXACT], ids=["floats", "exact"])
@pytest.mark.parametrize("op", ONE + TWO)
@given(data=st.data())
@settings(max_examples=150, deadline=None)
def test_an_operation_encloses_its_exact_value(domain, op, data):
    sides = [data.draw(BOX) for _ in range(ARITY[op])]
    point = [low + (high - low) * data.draw(PART) for low, high in sides]
    boxes = [domain.between(*side) for side in sides]
    try:
        found = evaluated(domain, op, boxes)
    except Unsupported:
        assert domain.exact
        assert op in ("INV", "DIV", "SQRT")
        return
    try:
        assert enclosed(found, POINT.operation(op)(*point))
    except Undefined:
        assert np.isnan(float(found.low[0]))
        assert np.isnan(float(found.high[0]))
    except Irrational:
        low, high = float(found.low[0]), float(found.high[0])
        assert np.isnan(low) or Fraction(max(low, 0.0)) ** 2 <= point[0]
        assert np.isnan(high) or high == np.inf or point[0] <= Fraction(high) ** 2


@pytest.mark.parametrize("exponent", [Fraction(k, 2) for k in range(-6, 9)])
@given(data=st.data())
@settings(max_examples=80, deadline=None)
def test_a_power_encloses_its_exact_value(exponent, data):
    low, high = data.draw(BOX)
    x = low + (high - low) * data.draw(PART)
    for domain in (FLOATS, EXACT):
        try:
            found = evaluated(domain, "POW", [domain.between(low, high), domain.constant(exponent)])
        except Unsupported:
            assert domain.exact
            continue
        if exponent.denominator == 1 and (x or exponent >= 0):
            assert enclosed(found, x**exponent.numerator)
        elif x < 0 or (x == 0 and exponent < 0):
            assert np.isnan(found.low[0])
        else:
            with quiet():  # one step more is room for the rounding of the square
                low, high = np.nextafter(found.low, 0), np.nextafter(found.high, np.inf)
                square = Box(np.nextafter(low * low, 0), np.nextafter(high * high, np.inf))
            exact = x**exponent.numerator
            assert (
                is_nan(square.low[0])
                or (square.low[0] == 0 and exact >= 0)
                or Fraction(square.low[0]) <= exact
            )
            assert is_nan(square.high[0]) or square.high[0] == np.inf or exact <= Fraction(square.high[0])


@pytest.mark.parametrize("op", ONE + TWO)
def test_nan_stays_nan(op):
    nan, one = Box(np.array([np.nan]), np.array([np.nan])), FLOATS.between(Fraction(1), Fraction(2))
    for boxes in ([nan], [nan, one], [one, nan], [nan, FLOATS.constant(Fraction(0))]):
        if len(boxes) == ARITY[op]:
            found = evaluated(FLOATS, op, boxes)
            assert np.isnan(found.low[0])
            assert np.isnan(found.high[0])


@pytest.mark.parametrize("exponent", [Fraction(0), Fraction(2), Fraction(-1), Fraction(1, 2)])
def test_nan_stays_nan_in_a_power(exponent):
    nan = Box(np.array([np.nan]), np.array([np.nan]))
    found = evaluated(FLOATS, "POW", [nan, FLOATS.constant(exponent)])
    assert np.isnan(found.low[0])
    assert np.isnan(found.high[0])


@pytest.mark.parametrize("exponent", [Fraction(1, 3), Fraction(2, 5)])
def test_other_exponents_are_refused(exponent):
    with pytest.raises(Unsupported, match="whole exponents"):
        evaluated(FLOATS, "POW", [FLOATS.constant(Fraction(2)), FLOATS.constant(exponent)])


@pytest.mark.parametrize("op", ["EXP", "TANH", "SIN", "LOG", "FLOOR", "ATAN2"])
def test_an_operation_without_a_meaning_is_refused_by_name(op):
    with pytest.raises(Unsupported, match=op.lower()):
        FLOATS.operation(op)


@given(ENDS)
def test_a_number_is_rounded_to_its_neighbour_on_that_side(value):
    for towards in (-np.inf, np.inf):
        found = rounded(value, towards)
        if np.isinf(found):
            assert found == towards
            continue
        beyond = nextafter(found, -towards)
        assert (Fraction(found) - value) * (1 if towards > 0 else -1) >= 0
        assert np.isinf(beyond) or Fraction(found) == value or (Fraction(beyond) - value) * towards < 0


def test_ends_that_no_float_can_hold_are_unbounded_and_stay_enclosures():
    huge = Fraction(10) ** 400
    box = FLOATS.between(huge, huge)
    assert (box.low[0], box.high[0]) == (np.finfo(float).max, np.inf)
    inverse = evaluated(FLOATS, "INV", [box])
    assert inverse.low[0] <= 0
    assert Fraction(inverse.high[0]) >= 1 / huge
    product = evaluated(FLOATS, "MUL", [box, FLOATS.constant(Fraction(0))])
    assert product.low[0] <= 0 <= product.high[0]
    tiny = evaluated(FLOATS, "MUL", [inverse, inverse])
    assert enclosed(tiny, huge**-2)


def test_many_boxes_at_once_are_the_boxes_one_by_one():
    generator = np.random.default_rng(1)
    ends = np.sort(generator.uniform(-2, 2, (2, 2, 300)), axis=1)
    a, b = (Box(low, high) for low, high in ends)
    for op in ONE + TWO:
        args = [a, b][: ARITY[op]]
        whole = evaluated(FLOATS, op, args)
        for k in range(0, 300, 37):
            one = evaluated(FLOATS, op, [Box(x.low[k : k + 1], x.high[k : k + 1]) for x in args])
            np.testing.assert_array_equal([whole.low[k], whole.high[k]], [one.low[0], one.high[0]])


def test_the_exact_boxes_do_not_round():
    third = exact_array([Fraction(1, 3)])
    x = Box(third, third)
    found = evaluated(EXACT, "MUL", [x, EXACT.constant(Fraction(3))])
    assert found.low[0] == found.high[0] == 1
    assert isinstance(found.low[0], Fraction)
