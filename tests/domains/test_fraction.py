from fractions import Fraction

import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.domains.fraction import (
    FractionDomain,
    Irrational,
    NoExactValue,
    TooLarge,
    Undefined,
    rational_root,
)
from symctrl.graph import ARITY
from tests.domains.oracle import MEANING

D = FractionDomain()
SMALL = st.fractions(-4, 4, max_denominator=6)


def real(x: Fraction) -> mpmath.mpf:
    return mpmath.mpf(x.numerator) / x.denominator


@pytest.mark.parametrize("op", sorted(ARITY))
@given(data=st.data())
@settings(max_examples=40, deadline=None)
def test_a_value_is_right_and_a_refusal_has_a_reason(op: str, data: st.DataObject) -> None:
    """Against mpmath at 50 digits: undefined exactly where mpmath has no real number."""
    args = data.draw(st.tuples(*[SMALL] * ARITY[op]))
    with mpmath.workdps(50):
        try:
            expected = MEANING[op].value(*map(real, args))
        except (ZeroDivisionError, ValueError):
            expected = mpmath.nan
        if op == "POW" and args[0] < 0 and args[1].denominator > 1:
            expected = mpmath.nan  # mpmath takes the complex branch, whose imaginary part may round to zero
        if op == "ATAN2" and args == (0, 0):
            expected = mpmath.nan
        try:
            value = real(D.operation(op)(*args))
            defined = True
        except NoExactValue as error:
            value = expected
            defined = isinstance(error, Irrational)
        assert defined == (mpmath.im(expected) == 0 and mpmath.isfinite(expected))
        assert not defined or abs(value - mpmath.re(expected)) < mpmath.mpf(10) ** -40


@pytest.mark.parametrize("op", sorted(set(ARITY) - {"ERFINV"}))
@given(data=st.data())
@settings(max_examples=20, deadline=None)
def test_what_is_called_irrational_is_not_a_small_fraction(op: str, data: st.DataObject) -> None:
    args = data.draw(st.tuples(*[SMALL] * ARITY[op]))
    try:
        D.operation(op)(*args)
    except Irrational:
        with mpmath.workdps(50):
            value = mpmath.re(MEANING[op].value(*map(real, args)))
            assert all(abs(value * q - mpmath.nint(value * q)) > mpmath.mpf(10) ** -30 for q in range(1, 50))
    except Undefined:
        pass


@given(st.fractions(0, 50, max_denominator=60), st.integers(1, 7))
def test_roots_of_perfect_powers(r: Fraction, n: int) -> None:
    assert rational_root(r**n, n) == r
    assert D.pow_(r**n, Fraction(1, n)) == r
    assert D.sqrt_(r**2) == r


@given(st.fractions(0, 50, max_denominator=60), st.integers(2, 7))
def test_a_root_is_found_or_there_is_none(x: Fraction, n: int) -> None:
    root = rational_root(x, n)
    if root is not None:
        assert root**n == x
        assert root >= 0
    else:
        a, b = (round(float(part) ** (1 / n)) for part in (x.numerator, x.denominator))
        assert Fraction(a, b) ** n != x


def test_large_roots_are_exact() -> None:
    big = (10**400 + 7) ** 3
    assert rational_root(Fraction(big), 3) == 10**400 + 7
    assert rational_root(Fraction(big + 1), 3) is None


@given(SMALL, SMALL.filter(bool))
def test_remainders(a: Fraction, b: Fraction) -> None:
    for op, bound in (("FMOD", abs(b)), ("REMAINDER", abs(b) / 2)):
        rest = D.operation(op)(a, b)
        assert ((a - rest) / b).denominator == 1
        assert abs(rest) < bound or (op == "REMAINDER" and abs(rest) == bound)
    assert D.fmod_(a, b) * a >= 0


@pytest.mark.parametrize(
    ("op", "args", "error"),
    [
        ("SQRT", (Fraction(2),), Irrational),
        ("SQRT", (Fraction(-1),), Undefined),
        ("POW", (Fraction(1, 2), Fraction(1, 3)), Irrational),
        ("POW", (Fraction(0), Fraction(-1)), Undefined),
        ("POW", (Fraction(3), Fraction(10**9)), TooLarge),
        ("DIV", (Fraction(3), Fraction(0)), Undefined),
        ("FMOD", (Fraction(3), Fraction(0)), Undefined),
        ("INV", (Fraction(0),), Undefined),
        ("SIN", (Fraction(1, 2),), Irrational),
        ("ATAN2", (Fraction(0), Fraction(-1)), Irrational),
    ],
)
def test_errors_name_the_operation_and_the_value(op: str, args: tuple[Fraction, ...], error: type) -> None:
    with pytest.raises(error) as caught:
        D.operation(op)(*args)
    assert isinstance(caught.value, NoExactValue)
    named = "div" if op == "FMOD" else op.lower()
    assert f"{named}({', '.join(map(str, args))})" in str(caught.value)


def test_powers_of_minus_one_may_be_large() -> None:
    assert D.pow_(Fraction(-1), Fraction(10**30 + 1)) == -1
