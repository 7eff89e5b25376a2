"""What each scalar opcode means: mpmath as an independent oracle, and where its arguments may lie."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import mpmath


@dataclass(frozen=True)
class Meaning:
    """An opcode's value by mpmath and a box of arguments on which it is smooth (or at least defined)."""

    value: Callable[..., Any]
    box: tuple[tuple[str, str], ...]
    smooth: bool = True


ANY = ("-3", "3")
POSITIVE = ("1/8", "3")
UNIT = ("-7/8", "7/8")


def _truth(value: object) -> Any:
    return mpmath.mpf(1 if value else 0)


def _fmod(a: Any, b: Any) -> Any:
    return a - b * mpmath.mpf(int(a / b))


def _remainder(a: Any, b: Any) -> Any:
    return a - b * mpmath.nint(a / b)


MEANING: dict[str, Meaning] = {
    "NEG": Meaning(lambda a: -a, (ANY,)),
    "EXP": Meaning(mpmath.exp, (ANY,)),
    "LOG": Meaning(mpmath.log, (POSITIVE,)),
    "SQRT": Meaning(mpmath.sqrt, (POSITIVE,)),
    "SQ": Meaning(lambda a: a**2, (ANY,)),
    "TWICE": Meaning(lambda a: 2 * a, (ANY,)),
    "SIN": Meaning(mpmath.sin, (ANY,)),
    "COS": Meaning(mpmath.cos, (ANY,)),
    "TAN": Meaning(mpmath.tan, (UNIT,)),
    "ASIN": Meaning(mpmath.asin, (UNIT,)),
    "ACOS": Meaning(mpmath.acos, (UNIT,)),
    "ATAN": Meaning(mpmath.atan, (ANY,)),
    "SINH": Meaning(mpmath.sinh, (ANY,)),
    "COSH": Meaning(mpmath.cosh, (ANY,)),
    "TANH": Meaning(mpmath.tanh, (ANY,)),
    "ASINH": Meaning(mpmath.asinh, (ANY,)),
    "ACOSH": Meaning(mpmath.acosh, (("9/8", "3"),)),
    "ATANH": Meaning(mpmath.atanh, (UNIT,)),
    "FABS": Meaning(abs, (POSITIVE,)),
    "SIGN": Meaning(mpmath.sign, (ANY,), smooth=False),
    "FLOOR": Meaning(mpmath.floor, (ANY,), smooth=False),
    "CEIL": Meaning(mpmath.ceil, (ANY,), smooth=False),
    "NOT": Meaning(lambda a: _truth(a == 0), (ANY,), smooth=False),
    "ERF": Meaning(mpmath.erf, (ANY,)),
    "ERFINV": Meaning(mpmath.erfinv, (UNIT,)),
    "INV": Meaning(lambda a: 1 / a, (POSITIVE,)),
    "LOG1P": Meaning(mpmath.log1p, (UNIT,)),
    "EXPM1": Meaning(mpmath.expm1, (ANY,)),
    "ADD": Meaning(lambda a, b: a + b, (ANY, ANY)),
    "SUB": Meaning(lambda a, b: a - b, (ANY, ANY)),
    "MUL": Meaning(lambda a, b: a * b, (ANY, ANY)),
    "DIV": Meaning(lambda a, b: a / b, (ANY, POSITIVE)),
    "POW": Meaning(lambda a, b: a**b, (POSITIVE, ANY)),
    "CONSTPOW": Meaning(lambda a, b: a**b, (POSITIVE, ANY)),
    "LT": Meaning(lambda a, b: _truth(a < b), (ANY, ANY), smooth=False),
    "LE": Meaning(lambda a, b: _truth(a <= b), (ANY, ANY), smooth=False),
    "EQ": Meaning(lambda a, b: _truth(a == b), (ANY, ANY), smooth=False),
    "NE": Meaning(lambda a, b: _truth(a != b), (ANY, ANY), smooth=False),
    "AND": Meaning(lambda a, b: _truth(a != 0 and b != 0), (ANY, ANY), smooth=False),
    "OR": Meaning(lambda a, b: _truth(a != 0 or b != 0), (ANY, ANY), smooth=False),
    "FMOD": Meaning(_fmod, (ANY, POSITIVE), smooth=False),
    "REMAINDER": Meaning(_remainder, (ANY, POSITIVE), smooth=False),
    "COPYSIGN": Meaning(lambda a, b: -abs(a) if b < 0 else abs(a), (ANY, ANY), smooth=False),
    "IF_ELSE_ZERO": Meaning(lambda a, b: b if a else mpmath.mpf(0), (ANY, ANY), smooth=False),
    "FMIN": Meaning(min, (("-3", "-1/8"), POSITIVE)),
    "FMAX": Meaning(max, (("-3", "-1/8"), POSITIVE)),
    "ATAN2": Meaning(mpmath.atan2, (ANY, POSITIVE)),
    "HYPOT": Meaning(mpmath.hypot, (ANY, POSITIVE)),
}
