"""SymPy expressions: interoperation, and an independent oracle for the other domains.

SymPy is slow to import and optional, so it is imported when the domain is made.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any, TypeAlias

from symctrl.domains.domain import Operators
from symctrl.graph import Tape, interpret

Expression: TypeAlias = Any  # sympy.Expr, which has no type information

# CasADi's opcode: the SymPy function of the same meaning.
_SAME = {
    **{op: op.lower() for op in ("EXP", "LOG", "SQRT", "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "ATAN2")},
    **{op: op.lower() for op in ("SINH", "COSH", "TANH", "ASINH", "ACOSH", "ATANH", "ERF", "ERFINV", "SIGN")},
    "FLOOR": "floor",
    "CEIL": "ceiling",
    "FABS": "Abs",
    "FMIN": "Min",
    "FMAX": "Max",
}
_RELATIONS = {"LT": "Lt", "LE": "Le", "EQ": "Eq", "NE": "Ne"}


def to_sympy(tape: Tape, symbols: Mapping[str, Expression] | None = None) -> list[Expression]:
    """The outputs of a tape as SymPy expressions; a name that is not in `symbols` is a real symbol.

    Raises Unsupported for REMAINDER, and ImportError without SymPy.
    """
    domain = SympyDomain()
    given = symbols or {}
    return interpret(tape, domain, {n: given[n] if n in given else domain.symbol(n) for n in tape.inputs})


class SympyDomain(Operators[Expression]):
    """Values are SymPy expressions, evaluated by SymPy as they are built (x/x becomes 1).

    A truth value is 0 or 1, by a Piecewise. REMAINDER, which rounds halves to even, has no SymPy function.
    """

    name = "SymPy"

    def __init__(self) -> None:
        import sympy

        self._sympy: Any = sympy

    def symbol(self, name: str) -> Expression:
        """A real symbol; the number itself for a name that is a number (`1/3`)."""
        if name[:1].isdigit() or name[:1] == "-":
            return self.constant(Fraction(name))
        return self._sympy.Symbol(name, real=True)

    def operation(self, op: str) -> Callable[..., Expression]:
        if op in _SAME:
            function: Callable[..., Expression] = getattr(self._sympy, _SAME[op])
            return function
        if op in _RELATIONS:
            relation = getattr(self._sympy, _RELATIONS[op])
            return lambda a, b: self._truth(relation(a, b))
        return super().operation(op)

    def _truth(self, condition: Any) -> Expression:
        return self._sympy.Piecewise((1, condition), (0, True))

    def _true(self, a: Expression) -> Any:
        return self._sympy.Ne(a, 0)

    def constant(self, value: Fraction) -> Expression:
        return self._sympy.Rational(value.numerator, value.denominator)

    def pow_(self, a: Expression, b: Expression) -> Expression:
        return a**b

    def fmod_(self, a: Expression, b: Expression) -> Expression:
        """a - n b with n = a/b rounded towards zero; SymPy's Mod rounds down."""
        return self._sympy.sign(a) * self._sympy.Mod(self._sympy.Abs(a), self._sympy.Abs(b))

    def copysign_(self, a: Expression, b: Expression) -> Expression:
        size = self._sympy.Abs(a)
        return self._sympy.Piecewise((size, b >= 0), (-size, True))

    def not_(self, a: Expression) -> Expression:
        return self._truth(self._sympy.Eq(a, 0))

    def and_(self, a: Expression, b: Expression) -> Expression:
        return self._truth(self._sympy.And(self._true(a), self._true(b)))

    def or_(self, a: Expression, b: Expression) -> Expression:
        return self._truth(self._sympy.Or(self._true(a), self._true(b)))

    def if_else_zero_(self, a: Expression, b: Expression) -> Expression:
        return self._sympy.Piecewise((b, self._true(a)), (0, True))
