"""Random programs in the author's language, each with two meanings: an `Expr`, and exact entries by plain
lists.

A program is drawn together with its value at one rational point, so a partial operation (a division) is drawn
only where it is defined. The oracle below knows nothing of CasADi, `Expr` or its entries.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from hypothesis import strategies as st

from symctrl import vectors as sv
from symctrl.expr import Expr, lift, symbol

Matrix = list[list[Fraction]]

NUMBERS = st.builds(Fraction, st.integers(-4, 4), st.sampled_from([1, 1, 1, 2, 3, 10]))
SHAPES = [(1, 1), (1, 1), (2, 1), (3, 1), (1, 3), (2, 2), (3, 3), (3, 2)]
POINT: dict[str, Fraction] = {}  # scalar name: value; the same for all programs


@dataclass(frozen=True)
class Program:
    expr: Expr
    value: Matrix

    @property
    def shape(self) -> tuple[int, int]:
        return len(self.value), len(self.value[0])


def _symbols() -> dict[tuple[int, int], Program]:
    found = {}
    for number, (rows, cols) in enumerate(sorted(set(SHAPES) | {(2, 3), (1, 2)})):
        name = "abcdefghij"[number]
        value = [
            [Fraction((7 * r + 3 * c + 5 * number) % 11 - 4, r + 2) for c in range(cols)] for r in range(rows)
        ]
        found[rows, cols] = Program(symbol(name, (rows, cols)), value)
        for r in range(rows):
            for c in range(cols):
                where = "" if (rows, cols) == (1, 1) else f"[{r + 1}]" if cols == 1 else f"[{r + 1},{c + 1}]"
                POINT[name + where] = value[r][c]
    return found


SYMBOLS = _symbols()


@st.composite
def literals(draw: st.DrawFn, shape: tuple[int, int]) -> Program:
    value = [[draw(NUMBERS) for _ in range(shape[1])] for _ in range(shape[0])]
    if shape != (1, 1):
        return Program(lift([[str(x) for x in row] for row in value]), value)
    (number,) = value[0]
    written = draw(st.sampled_from([number, str(number), int(number) if number.denominator == 1 else number]))
    return Program(lift(written), value)


@st.composite
def programs(
    draw: st.DrawFn, shape: tuple[int, int] | None = None, depth: int = 4, symbols: bool = True
) -> Program:
    """A random program of a shape; without symbols it is made of literals only."""
    rows, cols = shape = shape or draw(st.sampled_from(SHAPES))

    def sub(shape: tuple[int, int]) -> Program:
        return draw(programs(shape, depth - 1, symbols))

    if depth == 0 or draw(st.integers(0, 5)) == 0:
        return SYMBOLS[shape] if symbols and draw(st.booleans()) else draw(literals(shape))
    choice = draw(
        st.sampled_from(["add", "sub", "neg", "scale", "elacs", "divide", "matmul", "T", "index", "more"])
    )
    if choice in ("add", "sub"):
        a, b = sub(shape), sub(shape)
        plus = choice == "add"
        return Program(
            a.expr + b.expr if plus else a.expr - b.expr,
            zipped(lambda x, y: x + y if plus else x - y, a.value, b.value),
        )
    if choice == "neg":
        a = sub(shape)
        return Program(-a.expr, mapped(lambda x: -x, a.value))
    if choice in ("scale", "elacs"):
        k, a = sub((1, 1)), sub(shape)
        product = k.expr * a.expr if choice == "scale" else a.expr * k.expr
        return Program(product, mapped(lambda x: x * k.value[0][0], a.value))
    if choice == "divide":
        a, k = sub(shape), sub((1, 1))
        (divisor,) = k.value[0]
        return Program(a.expr / k.expr, mapped(lambda x: x / divisor, a.value)) if divisor else a
    if choice == "matmul":
        inner = draw(st.sampled_from([n for n in (1, 2, 3) if (rows, n) in SYMBOLS and (n, cols) in SYMBOLS]))
        a, b = sub((rows, inner)), sub((inner, cols))
        return Program(a.expr @ b.expr, times(a.value, b.value))
    if choice == "T" and (cols, rows) in SYMBOLS:
        a = sub((cols, rows))
        return Program(a.expr.T, transposed(a.value))
    if choice == "index" and shape == (1, 1):
        a = sub((3, 1))
        k = draw(st.integers(-3, 2))
        return Program(a.expr[k], [a.value[k]])
    return _more(draw, shape, sub)


def _more(draw: st.DrawFn, shape: tuple[int, int], sub: Callable[[tuple[int, int]], Program]) -> Program:
    """Functions and constructors, as far as the shape has one."""
    if shape == (1, 1):
        a = sub(shape)
        n = draw(st.integers(0, 3))
        return Program(a.expr**n, [[a.value[0][0] ** n]])
    if shape == (3, 1):
        a, b = sub(shape), sub(shape)
        return Program(sv.cross(a.expr, b.expr), times(crossing(a.value), b.value))
    if shape == (3, 3):
        a = sub((3, 1))
        return Program(sv.skew(a.expr), crossing(a.value))
    if shape == (2, 1) and draw(st.booleans()):
        a = sub((3, 1))
        return Program(a.expr[1:], a.value[1:])
    if shape == (2, 1):
        a, b = sub((1, 1)), sub((1, 1))
        return Program(sv.stack(a.expr, b.expr), [a.value[0], b.value[0]])
    if shape == (2, 2):
        blocks = [[sub((1, 1)) for _ in range(2)] for _ in range(2)]
        return Program(
            sv.block([[x.expr for x in line] for line in blocks]),
            [[x.value[0][0] for x in line] for line in blocks],
        )
    a = sub(shape)
    return Program(sv.absolute(a.expr), mapped(abs, a.value))


def mapped(f: Callable[[Fraction], Fraction], a: Matrix) -> Matrix:
    return [[f(x) for x in row] for row in a]


def zipped(f: Callable[[Fraction, Fraction], Fraction], a: Matrix, b: Matrix) -> Matrix:
    return [[f(x, y) for x, y in zip(r, s, strict=True)] for r, s in zip(a, b, strict=True)]


def transposed(a: Matrix) -> Matrix:
    return [list(column) for column in zip(*a, strict=True)]


def times(a: Matrix, b: Matrix) -> Matrix:
    return [
        [sum((x * y for x, y in zip(r, c, strict=True)), Fraction(0)) for c in zip(*b, strict=True)]
        for r in a
    ]


def crossing(v: Matrix) -> Matrix:
    (x,), (y,), (z,) = v
    zero = Fraction(0)
    return [[zero, -z, y], [z, zero, -x], [-y, x, zero]]
