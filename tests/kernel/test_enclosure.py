"""Enclosures against mpmath at many more digits: the value lies inside, and the ends are close."""

from fractions import Fraction

import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.kernel.certificate import Declined
from symctrl.kernel.chain import Chain
from symctrl.kernel.enclosure import Enclosure
from symctrl.kernel.interval import Interval, Undecided, Undefined, point, rounded_down

PRECISION = 3000
FUNCTIONS = {
    "EXP": (mpmath.exp, -50, 50),
    "LOG": (mpmath.log, Fraction(1, 1000), 10**6),
    "SIN": (mpmath.sin, -(10**6), 10**6),
    "COS": (mpmath.cos, -(10**6), 10**6),
    "TANH": (mpmath.tanh, -20, 20),
    "SINH": (mpmath.sinh, -50, 50),
    "COSH": (mpmath.cosh, -50, 50),
    "ASINH": (mpmath.asinh, 0, 10**6),  # by the logarithm: below zero it cancels
    "ACOSH": (mpmath.acosh, 1, 10**6),
    "ATANH": (mpmath.atanh, Fraction(-999, 1000), Fraction(999, 1000)),
    "ASIN": (mpmath.asin, -1, 1),
    "ACOS": (mpmath.acos, -1, 1),
    "ATAN": (mpmath.atan, -(10**6), 10**6),
    "SQRT": (mpmath.sqrt, 0, 10**6),
}
bits = st.sampled_from((64, 256))


def real(x):
    return mpmath.mpf(x.numerator) / x.denominator


def assert_inside(value, interval, slack):
    """`slack` is far above the error of mpmath and far below the width that is asked for."""
    assert real(interval.lo) - slack <= value <= real(interval.hi) + slack


@pytest.mark.parametrize("op", FUNCTIONS)
def test_functions_at_points(op):
    function, low, high = FUNCTIONS[op]

    @settings(max_examples=25, deadline=None)
    @given(st.fractions(low, high, max_denominator=10**9), bits)
    def check(x, b):
        found = Chain(Enclosure(b)).operation(op, 0, [point(x)])
        with mpmath.workprec(PRECISION):
            value = function(real(x))
            assert_inside(value, found, mpmath.mpf(2) ** -2000)
        assert found.hi - found.lo <= Fraction(1, 2 ** (b - 16)) * max(1, found.magnitude)

    check()


@pytest.mark.parametrize("op", FUNCTIONS)
def test_functions_on_intervals_contain_their_values_inside(op):
    function, low, high = FUNCTIONS[op]

    @settings(max_examples=25, deadline=None)
    @given(
        st.tuples(*[st.fractions(low, high, max_denominator=10**3)] * 2), st.fractions(0, 1), st.booleans()
    )
    def check(ends, t, near):
        lo, hi = min(ends), max(ends)
        hi = min(hi, lo + 4) if near else hi
        found = Chain(Enclosure(64)).operation(op, 0, [Interval(lo, hi)])
        with mpmath.workprec(PRECISION):
            assert_inside(function(real(lo + t * (hi - lo))), found, mpmath.mpf(2) ** -2000)

    check()


ends = st.fractions(-100, 100, max_denominator=1000)
intervals = st.tuples(ends, ends).map(lambda e: Interval(min(e), max(e)))
inside = st.fractions(0, 1, max_denominator=50)


def at(a, t):
    return a.lo + t * (a.hi - a.lo)


@settings(max_examples=100, deadline=None)
@given(intervals, intervals, inside, inside, st.integers(-4, 4))
def test_arithmetic_contains_every_result(a, b, s, t, n):
    domain = Enclosure(20)
    x, y = at(a, s), at(b, t)
    results = [
        (domain.add(a, b), x + y),
        (domain.sub(a, b), x - y),
        (domain.mul(a, b), x * y),
        (domain.square(a), x * x),
        (domain.neg(a), -x),
        (Chain(domain).operation("FABS", 0, [a]), abs(x)),
        (Chain(domain).operation("FMIN", 0, [a, b]), min(x, y)),
        (Chain(domain).operation("FMAX", 0, [a, b]), max(x, y)),
    ]
    if b.sign in (1, -1):
        results += [(domain.inv(b), 1 / y), (Chain(domain).operation("POW", 0, [b, point(n)]), y**n)]
    assert all(found.lo <= value <= found.hi for found, value in results)


@settings(max_examples=50, deadline=None)
@given(st.fractions(0, 50, max_denominator=100), st.fractions(-3, 3, max_denominator=12), bits)
def test_rational_powers(x, exponent, b):
    if x == 0 and exponent <= 0:
        return
    found = Chain(Enclosure(b)).operation("POW", 0, [point(x), point(exponent)])
    with mpmath.workprec(PRECISION):
        assert_inside(real(x) ** real(exponent), found, mpmath.mpf(2) ** -2000)


@settings(max_examples=50, deadline=None)
@given(st.fractions(Fraction(1, 9), 9, max_denominator=20), st.integers(2, 6), st.integers(-3, 3))
def test_powers_of_powers_are_exact(root, q, p):
    found = Chain(Enclosure(64)).operation("POW", 0, [point(root**q), point(Fraction(p, q))])
    assert (found.lo, found.hi) == (root**p, root**p)


@settings(max_examples=50, deadline=None)
@given(st.fractions(max_denominator=1000), bits)
def test_the_angle_of_a_point_of_the_unit_circle(t, b):
    cos, sin = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    for c, s in ((cos, sin), (-cos, -sin)):
        found = Enclosure(b).angle(c, s)
        with mpmath.workprec(PRECISION):
            assert_inside(mpmath.atan2(real(s), real(c)), found, mpmath.mpf(2) ** -2000)


@pytest.mark.parametrize(
    ("op", "args", "value"),
    [
        ("SIN", [0], 0),
        ("COS", [0], 1),
        ("EXP", [0], 1),
        ("LOG", [1], 0),
        ("ATAN", [0], 0),
        ("ACOS", [1], 0),
        ("TANH", [0], 0),
        ("SINH", [0], 0),
        ("SQRT", [Fraction(9, 4)], Fraction(3, 2)),
        ("SIGN", [0], 0),
        ("SIGN", [-3], -1),
        ("POW", [0, Fraction(1, 3)], 0),
        ("POW", [0, 0], 1),
    ],
)
def test_exact_values_stay_exact(op, args, value):
    found = Chain(Enclosure(64)).operation(op, 0, [point(a) for a in args])
    assert (found.lo, found.hi) == (value, value)


around_zero = Interval(Fraction(-1), Fraction(1))


@pytest.mark.parametrize(
    ("op", "args", "error"),
    [
        ("SQRT", [point(-1)], Undefined),
        ("SQRT", [around_zero], Undecided),
        ("LOG", [point(0)], Undefined),
        ("LOG", [around_zero], Undecided),
        ("ASIN", [point(2)], Undefined),
        ("ASIN", [Interval(Fraction(0), Fraction(2))], Undecided),
        ("ACOSH", [point(0)], Undefined),
        ("ATANH", [point(1)], Undefined),
        ("POW", [point(-1), point(Fraction(1, 2))], Undefined),
        ("POW", [point(0), point(Fraction(-1, 2))], Undefined),
        ("SIGN", [around_zero], Undecided),
        ("ERF", [point(1)], Declined),
        ("FLOOR", [point(1)], Declined),
        ("ATAN2", [point(1), point(1)], Declined),
        ("IF_ELSE_ZERO", [point(1), point(1)], Declined),
        ("EXP", [point(10**9)], Declined),
    ],
)
def test_what_has_no_value_or_may_have_none(op, args, error):
    with pytest.raises(error):
        Chain(Enclosure(64)).operation(op, 0, args)


def test_division_by_what_may_be_zero():
    with pytest.raises(Undefined):
        Enclosure(64).inv(point(0))
    with pytest.raises(Undecided):
        Enclosure(64).inv(around_zero)


def test_numbers_stay_short():
    domain = Enclosure(64)
    a = Interval(Fraction(1, 3), Fraction(1, 2))
    for _ in range(30):
        a = Chain(domain).operation("SQRT", 0, [domain.add(domain.square(a), point(Fraction(1, 7)))])
    assert max(a.lo.numerator.bit_length(), a.hi.denominator.bit_length()) < 100
    with pytest.raises(Declined):
        domain.power(domain.power(point(3), 100_000), 100_000)


@settings(max_examples=100)
@given(st.fractions(), st.integers(1, 200))
def test_rounding_down_is_below_and_close(x, b):
    low = rounded_down(x, b)
    assert low <= x
    assert x - low <= abs(x) * Fraction(2, 2 ** (b - 1))
