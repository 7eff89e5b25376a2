from fractions import Fraction

import casadi as ca
import mpmath
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.domains.domain import Unsupported
from symctrl.domains.fraction import FractionDomain, Irrational
from symctrl.domains.sympy_ import SympyDomain, to_sympy
from symctrl.graph import ARITY, Instruction, Tape, read, unfolded
from tests.domains.oracle import MEANING


@pytest.mark.parametrize("op", sorted(set(ARITY) - {"REMAINDER"}))
@given(data=st.data())
@settings(max_examples=8, deadline=None)
def test_the_expression_evaluates_to_the_exact_value(op: str, data: st.DataObject) -> None:
    box = [st.fractions(lo, hi, max_denominator=8) for lo, hi in MEANING[op].box]
    point = data.draw(st.tuples(*box))
    code = [Instruction("INPUT", name=f"x{k}") for k in range(ARITY[op])]
    tape = Tape((*code, Instruction(op, tuple(range(ARITY[op])))), (ARITY[op],))
    (expression,) = to_sympy(tape)
    at = {sympy.Symbol(f"x{k}", real=True): sympy.Rational(str(x)) for k, x in enumerate(point)}
    got = expression.subs(at)
    try:
        expected = FractionDomain().operation(op)(*point)
    except Irrational:
        assert got.is_rational is not True
    else:
        assert sympy.simplify(got - sympy.Rational(str(expected))) == 0


@pytest.mark.parametrize("op", sorted(op for op in ARITY if MEANING[op].smooth))
def test_functions_agree_with_mpmath(op: str) -> None:
    point = [(Fraction(lo) + 2 * Fraction(hi)) / 3 for lo, hi in MEANING[op].box]
    value = SympyDomain().operation(op)(*map(SympyDomain().constant, point))
    with mpmath.workdps(30):
        expected = MEANING[op].value(*(mpmath.mpf(x.numerator) / x.denominator for x in point))
        assert abs(mpmath.mpf(str(sympy.N(value, 30))) - expected) < mpmath.mpf(10) ** -25


def test_symbols_are_real_and_named_constants_are_numbers() -> None:
    x, third = ca.SX.sym("x"), ca.SX.sym("1/3")
    with unfolded():
        tape = read(ca.Function("f", [x, third], [ca.sqrt(x**2) + third]), ["x[1]", "1/3"])
    (expression,) = to_sympy(tape)
    assert expression == sympy.Abs(sympy.Symbol("x[1]", real=True)) + sympy.Rational(1, 3)


def test_symbols_may_be_given() -> None:
    x = ca.SX.sym("x")
    p = sympy.Symbol("p", positive=True)
    (expression,) = to_sympy(read(ca.Function("f", [x], [ca.fabs(x)]), ["x"]), {"x": p})
    assert expression == p


def test_derivatives_agree_with_casadi_symbolically() -> None:
    x = ca.SX.sym("x", 2)
    f = ca.sin(x[0] * x[1]) / (2 + x[1] ** 2) + ca.exp(-x[0])
    names = ["a", "b"]
    (value,) = to_sympy(read(ca.Function("f", [x], [f]), names))
    slopes = to_sympy(read(ca.Function("g", [x], [ca.jacobian(f, x)]), names))
    for name, slope in zip(names, slopes, strict=True):
        assert sympy.simplify(sympy.diff(value, sympy.Symbol(name, real=True)) - slope) == 0


def test_remainder_is_refused_by_name() -> None:
    with pytest.raises(Unsupported, match="the SymPy domain gives no meaning to remainder"):
        SympyDomain().operation("REMAINDER")
