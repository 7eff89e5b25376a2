from fractions import Fraction

import casadi as ca
import flint
import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.domains.fraction import FractionDomain, Irrational, Undefined
from symctrl.domains.interval import IntervalDomain, ball, bounds
from symctrl.graph import ARITY, read
from tests.domains.oracle import MEANING

D, EXACT = IntervalDomain(), FractionDomain()
ENDS = st.fractions(-4, 4, max_denominator=8)
BOX = st.tuples(ENDS, ENDS).map(sorted)
THIN = ENDS.map(lambda x: [x, x])


def value(op: str, point: tuple[Fraction, ...]) -> mpmath.mpf:
    """The exact value, or mpmath's at 60 digits. Raises Undefined."""
    try:
        result = EXACT.operation(op)(*point)
        return mpmath.mpf(result.numerator) / result.denominator
    except Irrational:
        return mpmath.re(MEANING[op].value(*(mpmath.mpf(x.numerator) / x.denominator for x in point)))


def samples(box: list[Fraction]) -> list[Fraction]:
    low, high = box
    return [low + (high - low) * Fraction(k, 6) for k in range(7)] + [Fraction(0)] * (low <= 0 <= high)


@pytest.mark.parametrize("op", sorted(ARITY))
@given(data=st.data())
@settings(max_examples=60, deadline=None)
def test_contains_every_value_and_says_nothing_where_one_is_missing(op: str, data: st.DataObject) -> None:
    boxes = [data.draw(BOX | THIN) for _ in range(ARITY[op])]
    with D.working(), mpmath.workdps(60):
        found = bounds(D.operation(op)(*(ball(*box) for box in boxes)))
        points = [(x,) for x in samples(boxes[0])] if len(boxes) == 1 else []
        if len(boxes) == 2:
            points = [(x, y) for x in samples(boxes[0]) for y in samples(boxes[1])]
        for point in points:
            try:
                expected = value(op, point)
            except Undefined:
                assert found is None
                return
            if found is not None:
                low, high = (mpmath.mpf(x.numerator) / x.denominator for x in found)
                slack = mpmath.mpf(10) ** -50
                assert low - slack <= expected <= high + slack


@pytest.mark.parametrize("op", sorted(op for op in ARITY if MEANING[op].smooth))
@given(data=st.data())
@settings(max_examples=25, deadline=None)
def test_wide_boxes_inside_the_domain_are_decided_and_tight(op: str, data: st.DataObject) -> None:
    """Where the function is smooth, at most 2.2 times the range that samples show (powers bend most)."""
    inside = [st.fractions(lo, hi, max_denominator=8) for lo, hi in MEANING[op].box]
    boxes = [sorted(data.draw(st.tuples(s, s))) for s in inside]
    with D.working(), mpmath.workdps(60):
        found = bounds(D.operation(op)(*(ball(*box) for box in boxes)))
        assert found is not None
        points = [(x,) for x in samples(boxes[0])]
        if len(boxes) == 2:
            points = [(x, y) for x in samples(boxes[0]) for y in samples(boxes[1])]
        values = [value(op, point) for point in points]
        spread = max(values) - min(values)
        scale = max(abs(v) for v in values)
        assert float(found[1] - found[0]) <= 2.2 * spread + 1e-6 * scale + 1e-30


@given(BOX)
def test_squares_powers_and_roots_are_never_negative(box: list[Fraction]) -> None:
    with D.working():
        x = ball(*box)
        two, four = D.constant(Fraction(2)), D.constant(Fraction(4))
        powers = (D.sq_(x), D.fabs_(x), D.pow_(x, two), D.pow_(x, four))
        for result in (*powers, *map(D.sqrt_, powers), D.hypot_(x, x)):
            found = bounds(result)
            assert found is not None
            assert found[0] >= 0


@given(BOX, BOX)
def test_a_norm_has_a_root_although_its_box_contains_zero(a: list[Fraction], b: list[Fraction]) -> None:
    with D.working():
        x, y = ball(*a), ball(*b)
        found = bounds(D.sqrt_(D.add_(D.add_(D.sq_(x), D.mul_(D.fabs_(x), D.fabs_(y))), D.sq_(y))))
    assert found is not None
    assert found[0] >= 0


@given(BOX)
def test_bounds_contain_the_box_and_little_more(box: list[Fraction]) -> None:
    low, high = box
    found = bounds(ball(low, high))
    assert found is not None
    assert found[0] <= low <= high <= found[1]
    assert found[1] - found[0] <= (high - low) * (1 + Fraction(1, 2**25)) + abs(high) * Fraction(1, 2**50)


@pytest.mark.parametrize("op", sorted(ARITY))
def test_undecided_arguments_stay_undecided(op: str) -> None:
    nan = flint.arb("nan")
    for k in range(ARITY[op]):
        args = [ball(Fraction(1, 2), Fraction(1, 2))] * ARITY[op]
        args[k] = nan
        assert bounds(D.operation(op)(*args)) is None


def test_infinities_are_no_values() -> None:
    one, zero = flint.arb(1), flint.arb(0)
    wide = ball(Fraction(1), Fraction(2))
    poles = (D.atanh_(one), D.log_(zero), D.erfinv_(one), D.log1p_(-one), D.tan_(wide))
    for pole in poles:
        for op in ("TANH", "ATAN", "ERF", "INV", "ASIN", "ACOS", "SIGN", "COSH"):
            assert bounds(D.operation(op)(pole)) is None


def test_an_untaken_branch_may_be_undecided() -> None:
    no, yes, nan = (flint.arb(x) for x in (0, 1, "nan"))
    assert D.if_else_zero_(no, nan) == 0
    assert D.if_else_zero_(yes, nan).is_nan()
    assert D.and_(no, D.lt_(yes, flint.arb(1, 1))) == 0


def test_straddling_switches_give_the_hull() -> None:
    x = ball(Fraction(-1), Fraction(2))
    one = flint.arb(1)
    with D.working():
        assert D.sign_(x).contains(-1)
        assert D.sign_(x).contains(1)
        comparisons = [D.operation(op)(x, one) for op in ("LT", "LE", "EQ", "NE", "AND")]
        for truth in (*comparisons, D.not_(x), D.or_(x, one - 1)):
            assert truth.contains(0)
            assert truth.contains(1)
        assert D.le_(x, one + 1 + flint.arb(1) / 1000) == 1
        low, high = bounds(D.floor_(ball(Fraction(1, 2), Fraction(3, 2)))) or (None, None)
        assert low is not None
        assert -Fraction(1, 100) < low <= 0
        assert 1 <= high < Fraction(101, 100)


def test_the_walk_works_at_its_own_precision_and_restores_it() -> None:
    x = ca.SX.sym("x", 2)
    tape = read(ca.Function("f", [x], [ca.sqrt(x[0]) * ca.exp(x[1]) / 3]))
    before = flint.ctx.prec
    for bits in (64, 128, 400):
        (result,) = IntervalDomain(bits).walk(tape)([flint.arb(2), flint.arb(1)])
        low, high = bounds(result) or (Fraction(0), Fraction(1))
        assert 0 < high - low < Fraction(1, 2 ** (bits - 8))
    assert flint.ctx.prec == before
