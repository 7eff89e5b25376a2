import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.domains.floating import FloatDomain
from symctrl.graph import ARITY
from tests.domains.oracle import MEANING


@pytest.mark.parametrize("op", sorted(ARITY))
@given(data=st.data())
@settings(max_examples=15, deadline=None)
def test_each_sample_agrees_with_mpmath(op: str, data: st.DataObject) -> None:
    box = [st.floats(float(Fraction(lo)), float(Fraction(hi))) for lo, hi in MEANING[op].box]
    samples = data.draw(st.lists(st.tuples(*box), min_size=1, max_size=5))
    columns = [np.array(column) + 0.0 for column in zip(*samples, strict=True)]  # no negative zero
    got = FloatDomain().operation(op)(*columns)
    with mpmath.workdps(400):
        expected = [float(MEANING[op].value(*map(mpmath.mpf, sample))) for sample in samples]
    np.testing.assert_allclose(got, expected, rtol=1e-14, atol=1e-300)


@given(st.lists(st.tuples(st.floats(-1e6, 1e6), st.floats(-1e3, 1e3)), min_size=1, max_size=9))
def test_remainder_is_the_ieee_remainder(samples: list[tuple[float, float]]) -> None:
    a, b = (np.array(column) for column in zip(*samples, strict=True))
    got = FloatDomain().remainder_(a, b)
    for x, y, r in zip(a, b, got, strict=True):
        assert np.isnan(r) if y == 0 else r == math.remainder(x, y)


def test_the_largest_magnitude_is_kept_for_each_sample() -> None:
    domain = FloatDomain()
    x = np.array([1.0, 1e9, 3.0])
    difference = domain.sub_(domain.add_(x, domain.constant(Fraction(1))), x)
    np.testing.assert_array_equal(difference, 1.0)
    np.testing.assert_array_equal(domain.largest, [2.0, 1e9 + 1, 4.0])


def test_undefined_branches_are_silent_and_not_counted() -> None:
    domain = FloatDomain()
    x = np.array([0.0, 4.0])
    guarded = domain.if_else_zero_(domain.ne_(x, np.zeros(())), domain.inv_(x))
    np.testing.assert_array_equal(guarded, [0.0, 0.25])
    np.testing.assert_array_equal(domain.largest, [0.0, 4.0])
    assert np.isnan(domain.sqrt_(np.array(-1.0)))
