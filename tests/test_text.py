"""Plain text says what was written: read back by Python, with its own precedence, it has the same value."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given

from symctrl import vectors as sv
from symctrl.expr import Expr, deferred, lift, symbol
from symctrl.text import text
from tests.programs import SYMBOLS, Matrix, Program, crossing, mapped, programs, times, transposed, zipped

x, y, k = symbol("x"), symbol("y"), symbol("k")
v, w, M = symbol("v", (3, 1)), symbol("w", (3, 1)), symbol("M", (3, 3))


@dataclass(frozen=True)
class Value:
    """A matrix of fractions with one product for scaling and multiplying, as the text has."""

    rows: Matrix

    def __add__(self, other: Value) -> Value:
        return Value(zipped(lambda a, b: a + b, self.rows, other.rows))

    def __sub__(self, other: Value) -> Value:
        return Value(zipped(lambda a, b: a - b, self.rows, other.rows))

    def __neg__(self) -> Value:
        return Value(mapped(lambda a: -a, self.rows))

    def __mul__(self, other: Value) -> Value:
        if self.single is not None:
            return Value(mapped(lambda a: a * self.rows[0][0], other.rows))
        if other.single is not None:
            return other * self
        assert len(self.rows[0]) == len(other.rows), "the text multiplies what does not conform"
        return Value(times(self.rows, other.rows))

    def __truediv__(self, other: Value) -> Value:
        assert other.single is not None
        return Value(mapped(lambda a: a / other.rows[0][0], self.rows))

    def __pow__(self, other: Value) -> Value:
        return Value([[Fraction(self.rows[0][0] ** int(other.rows[0][0]))]])

    @property
    def single(self) -> Fraction | None:
        return self.rows[0][0] if len(self.rows) == len(self.rows[0]) == 1 else None

    @property
    def T(self) -> Value:
        return Value(transposed(self.rows))

    def at(self, where: str) -> Value:
        along = [range(len(self.rows)), range(len(self.rows[0]))]
        keys = where.split(",") if "," in where else [where, ":"] if len(self.rows) > 1 else [":", where]
        for axis, key in enumerate(keys):
            if key != ":":
                first, _, last = key.partition(":")
                along[axis] = range(int(first) - 1, int(last or first))
        return Value([[self.rows[r][c] for c in along[1]] for r in along[0]])


def number(written: str) -> Value:
    return Value([[Fraction(written)]])


def matrix(*lines: tuple[Value, ...]) -> Value:
    rows: Matrix = []
    for line in lines:
        rows += [[entry for part in line for entry in part.rows[r]] for r in range(len(line[0].rows))]
    return Value(rows)


NAMES: dict[str, Any] = {
    "number": number,
    "matrix": matrix,
    "skew": lambda a: Value(crossing(a.rows)),
    "cross": lambda a, b: Value(times(crossing(a.rows), b.rows)),
    "absolute": lambda a: Value(mapped(abs, a.rows)),
    **{p.expr.args[0]: Value(p.value) for p in SYMBOLS.values()},
}
TOKEN = re.compile(r"(?<=[\w)'\]])\[[^\]]*\]|\d+(?:\.\d+)?|\w+|.")


def read_back(plain: str) -> Value:
    """The text's value; Python's own parser decides what binds how."""
    code = ""
    for token in TOKEN.findall(plain):
        if token[0] == "[" and len(token) > 1:
            code += f".at({token[1:-1]!r})"
        elif token[0].isdigit():
            code += f"number({token!r})"
        else:
            code += {"[": "matrix((", ";": ",),(", "]": ",))", "'": ".T", "^": "**"}.get(token, token)
    value = eval(code, dict(NAMES))
    assert isinstance(value, Value)
    return value


@given(programs())
def test_the_text_read_back_has_the_same_value(program: Program) -> None:
    assert read_back(text(program.expr)).rows == program.value


WRITTEN: list[tuple[Expr, str]] = [
    (-k * v.T @ v, "-k*v'*v"),
    (k - (x - y), "k - (x - y)"),
    (k + (x + y), "k + (x + y)"),
    (-(-x), "-(-x)"),  # noqa: B002
    (x - -y, "x - (-y)"),
    (-(x + y), "-(x + y)"),
    ((x + y) * k, "(x + y)*k"),
    (k * (x * y), "k*(x*y)"),
    (x / (y * k), "x/(y*k)"),
    (x / y / k, "x/y/k"),
    (x / (y / k), "x/(y/k)"),
    ((-x) ** 2, "(-x)^2"),
    (-(x**2), "-x^2"),
    ((x**2) ** 3, "(x^2)^3"),
    (x ** lift("1/3"), "x^(1/3)"),
    (x**-2, "x^(-2)"),
    (v.T @ M @ v / 2, "v'*M*v/2"),
    (M @ (M @ v), "M*M*v"),
    (M @ ((v.T @ w) * v), "M*((v'*w)*v)"),
    (M @ (k * M @ v), "M*(k*M*v)"),
    ((v + w).T, "(v + w)'"),
    (M.T.T, "(M')'"),
    (sv.inverse(M) @ v, "inverse(M)*v"),
    (lift([[1, 2], [3, x]]), "[1, 2; 3, x]"),
    (sv.stack(M, v.T), "[M; v']"),
    (sv.block([[M, v], [w.T, 1]]), "[M, v; w', 1]"),
    ((v + w)[1:], "(v + w)[2:3]"),
    (M[0, 1] + v[2], "M[1,2] + v[3]"),
    (v[1:], "v[2:3]"),
    (M[:, 0], "M[:,1]"),
    (v[::2], "v[1:2:3]"),
    (sv.norm(v, 1) + sv.norm(v), "norm(v, 1) + norm(v)"),
    (sv.eye(3) + sv.zeros(3, 3), "eye(3) + zeros(3, 3)"),
    (sv.saturate(v, k), "saturate(v, k)"),
    (sv.power(v, 2), "power(v, 2)"),
    (x + 0.95 - 1, "x + 0.95 - 1"),
    (x * -2, "x*(-2)"),
]


@pytest.mark.parametrize(("expr", "plain"), WRITTEN)
def test_brackets_are_set_where_they_are_needed(expr: Expr, plain: str) -> None:
    assert text(expr) == plain


def test_a_large_matrix_is_elided() -> None:
    assert text(symbol("a", (20, 1))) == "a"
    assert text(lift(list(range(20)))) == "[0; 1; 2; 3; 4; 5; ...; 19]"
    assert text(lift([list(range(20))])) == "[0, 1, 2, 3, 4, 5, ..., 19]"


def test_a_text_does_not_grow_without_bound() -> None:
    shared = x
    for _ in range(200):
        shared = shared * shared
    assert len(text(shared)) < 300_000


def test_a_deferred_quantity_prints_its_label() -> None:
    @dataclass(frozen=True)
    class Named:
        label: str
        latex: str

    assert text(2 * deferred(Named("tau.i", r"\tau_i"), (3, 1))) == "2*tau.i"
