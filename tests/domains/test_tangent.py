from fractions import Fraction

import casadi as ca
import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.domains.floating import FloatDomain
from symctrl.domains.fraction import FractionDomain, Undefined
from symctrl.domains.tangent import NotDifferentiable, Pair, Tangent
from symctrl.graph import ARITY, interpret
from tests.domains.oracle import MEANING

SMOOTH = sorted(op for op, meaning in MEANING.items() if meaning.smooth)
JUMPS = sorted(set(ARITY) - set(SMOOTH) - {"COPYSIGN", "IF_ELSE_ZERO"})


def points(op: str) -> st.SearchStrategy[list[Fraction]]:
    box = [st.fractions(lo, hi, max_denominator=64) for lo, hi in MEANING[op].box]
    return st.tuples(*box).map(list)


def real(x: Fraction) -> mpmath.mpf:
    return mpmath.mpf(x.numerator) / x.denominator


@pytest.mark.parametrize("op", SMOOTH)
@given(data=st.data())
@settings(max_examples=15, deadline=None)
def test_chain_rule_agrees_with_mpmath_to_second_order(op: str, data: st.DataObject) -> None:
    """Nested tangents against numeric derivatives of mpmath's own function at 60 digits."""
    at = data.draw(points(op))
    speed = data.draw(st.tuples(*[st.fractions(-2, 2, max_denominator=8)] * len(at)))
    with mpmath.workdps(60):
        path = lambda t: MEANING[op].value(*(real(x) + t * real(v) for x, v in zip(at, speed, strict=True)))  # noqa: E731
        value, first, second = (float(mpmath.diff(path, 0, n)) for n in range(3))
    flat = Tangent(FloatDomain())
    nested = Tangent(flat)
    as_float = lambda x: np.asarray(float(x))  # noqa: E731
    args = [
        Pair(Pair(as_float(x), as_float(v)), Pair(as_float(v), None)) for x, v in zip(at, speed, strict=True)
    ]
    result = nested.operation(op)(*args)
    assert result.derivative is not None
    assert float(result.value.value) == pytest.approx(value, rel=1e-9, abs=1e-9)
    assert float(result.value.derivative) == pytest.approx(first, rel=1e-9, abs=1e-9)
    assert float(result.derivative.value) == pytest.approx(first, rel=1e-9, abs=1e-9)
    again = 0.0 if result.derivative.derivative is None else float(result.derivative.derivative)
    assert again == pytest.approx(second, rel=1e-8, abs=1e-8)


def test_a_long_expression_agrees_with_casadi() -> None:
    x = ca.SX.sym("x", 4)
    f = ca.sin(x[0] * x[1]) / (2 + ca.cos(x[2])) + ca.sqrt(1 + x[3] ** 2) * ca.tanh(x[0] - x[3]) ** 3
    f = f + ca.atan2(x[1], 3 + x[2]) * ca.exp(-x[0]) + ca.constpow(2 + x[1] ** 2, 0.7)
    jacobian = ca.Function("j", [x], [ca.jacobian(f, x)])
    at, speed = np.array([0.3, -1.2, 0.7, 0.4]), np.array([1.0, -2.0, 0.5, 3.0])
    pairs = [Pair(np.asarray(a), np.asarray(v)) for a, v in zip(at, speed, strict=True)]
    (result,) = interpret(ca.Function("f", [x], [f]), Tangent(FloatDomain()), pairs)
    assert result.derivative is not None
    assert float(result.derivative) == pytest.approx(float(jacobian(at) @ speed), rel=1e-12)


@given(st.fractions(-9, 9, max_denominator=9), st.fractions(-9, 9, max_denominator=9), st.integers(-4, 5))
def test_rational_rules_are_exact(a: Fraction, v: Fraction, n: int) -> None:
    domain = Tangent(FractionDomain())
    moving = Pair(a, v)
    if a == 0 and n < 0:
        with pytest.raises(Undefined):
            domain.pow_(moving, domain.constant(Fraction(n)))
        return
    power = domain.pow_(moving, domain.constant(Fraction(n)))
    slope = n * a ** (n - 1) if n else 0
    assert (power.value, power.derivative or 0) == (a**n, slope * v)
    if a:
        quotient = domain.div_(domain.constant(Fraction(3)), moving)
        assert (quotient.value, quotient.derivative) == (3 / a, -3 * v / a**2)


def test_root_of_a_square_is_exact() -> None:
    root = Tangent(FractionDomain()).sqrt_(Pair(Fraction(9, 4), Fraction(2)))
    assert (root.value, root.derivative) == (Fraction(3, 2), Fraction(2, 3))


def test_a_quotient_inverts_once() -> None:
    class Counting(FractionDomain):
        inversions = 0

        def inv_(self, a: Fraction) -> Fraction:
            self.inversions += 1
            return super().inv_(a)

    base = Counting()
    Tangent(base).div_(Pair(Fraction(1), Fraction(1)), Pair(Fraction(2), Fraction(1)))
    assert base.inversions == 1


@pytest.mark.parametrize("op", JUMPS)
def test_jumps_are_refused_by_name_unless_the_argument_is_still(op: str) -> None:
    domain = Tangent(FractionDomain())
    still = [Pair(Fraction(5, 2))] * ARITY[op]
    assert domain.operation(op)(*still) == Pair(FractionDomain().operation(op)(*[Fraction(5, 2)] * ARITY[op]))
    moving = [*still[:-1], Pair(Fraction(5, 2), Fraction(1))]
    with pytest.raises(NotDifferentiable, match=op.lower()):
        domain.operation(op)(*moving)


def test_switches_move_with_their_branch_only() -> None:
    domain, moving = Tangent(FractionDomain()), Pair(Fraction(-3), Fraction(7))
    on, off = domain.constant(Fraction(1)), domain.constant(Fraction(0))
    assert domain.if_else_zero_(on, moving).derivative == 7
    assert domain.if_else_zero_(off, moving).derivative == 0
    assert domain.copysign_(moving, on) == Pair(Fraction(3), Fraction(-7))
    for op in ("IF_ELSE_ZERO", "COPYSIGN"):
        args = (moving, on) if op == "IF_ELSE_ZERO" else (on, moving)
        with pytest.raises(NotDifferentiable, match=op.lower()):
            domain.operation(op)(*args)


@pytest.mark.parametrize("op", SMOOTH)
def test_constants_have_no_derivative_and_cost_none(op: str) -> None:
    domain = Tangent(FloatDomain())
    args = [domain.constant((Fraction(lo) + Fraction(hi)) / 2) for lo, hi in MEANING[op].box]
    assert domain.operation(op)(*args).derivative is None
