import math
from fractions import Fraction

import pytest

from symctrl.domains.domain import Domain, Unsupported
from symctrl.graph import ARITY
from tests.domains.oracle import MEANING


class Minimal(Domain[float]):
    """Only what has no meaning in terms of anything else."""

    name = "minimal"
    exp_, log_, sin_, cos_, sqrt_, pow_ = (
        staticmethod(f) for f in (math.exp, math.log, math.sin, math.cos, math.sqrt, math.pow)
    )

    def constant(self, value: Fraction) -> float:
        return float(value)

    def add_(self, a: float, b: float) -> float:
        return a + b

    def mul_(self, a: float, b: float) -> float:
        return a * b

    def inv_(self, a: float) -> float:
        return 1 / a


COMPOSITE = ["NEG", "SUB", "DIV", "SQ", "TWICE", "TAN", "EXPM1", "LOG1P", "HYPOT", "CONSTPOW"]


@pytest.mark.parametrize("op", COMPOSITE)
def test_composite_operations_follow_from_the_basic_ones(op: str) -> None:
    point = [float(Fraction(lo) * 2 + Fraction(hi)) / 3 for lo, hi in MEANING[op].box]
    assert Minimal().operation(op)(*point) == pytest.approx(float(MEANING[op].value(*point)), rel=1e-14)


def test_an_operation_without_a_meaning_is_refused_by_name() -> None:
    basic = {"ADD", "MUL", "INV", "EXP", "LOG", "SIN", "COS", "SQRT", "POW"}
    for op in set(ARITY) - basic - set(COMPOSITE):
        with pytest.raises(Unsupported, match=f"the minimal domain gives no meaning to {op.lower()}$"):
            Minimal().operation(op)


def test_a_method_that_is_no_opcode_is_not_an_operation() -> None:
    class Odd(Minimal):
        def halve_(self, a: float) -> float:
            return a / 2

    with pytest.raises(Unsupported, match="halve"):
        Odd().operation("HALVE")
