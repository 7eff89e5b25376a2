"""Scalars that stay exact: a rational number, or a CasADi scalar that is no plain number.

CasADi holds constants as doubles and folds constant with constant even with its simplification off (0.1*0.2,
sin(1)). Here two numbers are combined as fractions, and where the result is no rational number, or the number
is no short decimal, it enters the graph as a symbol named by the number: `1/3`, `-2/7`. Names that begin with
a digit or a minus sign are constants by convention.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import cache, lru_cache

import casadi as ca

from symctrl.graph import GraphError, exact_literal

Scalar = Fraction | ca.SX

MAX_FOLDED_EXPONENT = 64


@cache
def named(name: str) -> ca.SX:
    """The scalar symbol of that name: one object for one name."""
    return ca.SX.sym(name)


def is_constant_name(name: str) -> bool:
    """Whether a symbol of this name stands for the number that it is named by."""
    return name[:1].isdigit() or name[:1] == "-"


@lru_cache(maxsize=4096)
def constant(value: Fraction) -> ca.SX:
    """A number in a graph: a CasADi constant if that reads back exactly, else a symbol named by it."""
    try:
        if exact_literal(float(value)) == value:
            return ca.SX(float(value))
    except (GraphError, OverflowError):
        pass
    return named(str(value))


def as_sx(value: Scalar) -> ca.SX:
    """The CasADi scalar of a value."""
    return constant(value) if isinstance(value, Fraction) else value


def unary(op: str, a: Scalar) -> Scalar:
    """CasADi's opcode `op` of one scalar; exact for a number, where the result is rational."""
    if isinstance(a, Fraction):
        fold = _FOLD_ONE.get(op)
        return fold(a) if fold else ca.SX.unary(_opcode(op), named(str(a)))
    return ca.SX.unary(_opcode(op), a)


def binary(op: str, a: Scalar, b: Scalar) -> Scalar:
    """CasADi's opcode `op` of two scalars; exact for two numbers, where the result is rational.

    An operation that has no rational value (1/0, 2^(1/2)) stays in the graph, with its numbers as named
    constants.
    """
    if isinstance(a, Fraction) and isinstance(b, Fraction):
        folded = _fold_two(op, a, b)
        return ca.SX.binary(_opcode(op), named(str(a)), named(str(b))) if folded is None else folded
    return ca.SX.binary(_opcode(op), as_sx(a), as_sx(b))


def _fold_two(op: str, a: Fraction, b: Fraction) -> Fraction | None:
    if op == "DIV":
        return a / b if b else None
    if op == "POW":
        small = b.denominator == 1 and abs(b) <= MAX_FOLDED_EXPONENT
        return Fraction(a ** int(b)) if small and (a or b >= 0) else None
    fold = _FOLD_TWO.get(op)
    return fold(a, b) if fold else None


_FOLD_ONE: dict[str, Callable[[Fraction], Fraction]] = {
    "NEG": lambda a: -a,
    "SQ": lambda a: a * a,
    "FABS": abs,
    "SIGN": lambda a: Fraction((a > 0) - (a < 0)),
}
_FOLD_TWO: dict[str, Callable[[Fraction, Fraction], Fraction]] = {
    "ADD": lambda a, b: a + b,
    "SUB": lambda a, b: a - b,
    "MUL": lambda a, b: a * b,
    "FMIN": min,
    "FMAX": max,
}


@cache
def _opcode(op: str) -> int:
    return int(getattr(ca, f"OP_{op}"))
