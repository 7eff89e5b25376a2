"""One printer for expressions; what it writes is chosen by a notation (`text.py`, `latex.py`).

A notation says how a product, a fraction or a function looks and how tightly each binds; the printer goes
through the nodes, arguments first, and sets brackets where an argument binds less tightly than its place
asks.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from symctrl.nodes import SCALAR, Node, is_node, walk

SUM, LOOSE, PRODUCT, POWER, ATOM = range(5)  # LOOSE: needs brackets as a factor, none as an addend
LARGEST_PRINTED = 8  # rows or columns of a matrix; larger ones are elided
SHOWN_OF_LARGE = 6
LONGEST_PIECE = 100_000  # characters; nodes that are used many times can make a text without bound


@dataclass(frozen=True, slots=True)
class Piece:
    """A printed expression: how tightly it binds, and whether it begins with a minus sign."""

    text: str
    level: int = ATOM
    negative: bool = False


class Notation:
    """How operations look. Subclasses give the methods below; `Piece` arguments are bracketed by them."""

    ellipsis = "..."

    def bracketed(self, text: str) -> str:
        raise NotImplementedError

    def symbol(self, name: str, latex: str | None) -> Piece:
        raise NotImplementedError

    def deferred(self, record: Any) -> Piece:
        raise NotImplementedError

    def literal(self, value: Fraction, text: str) -> Piece:
        raise NotImplementedError

    def product(self, left: str, right: str) -> str:
        raise NotImplementedError

    def quotient(self, above: Piece, below: Piece) -> Piece:
        raise NotImplementedError

    def power(self, base: Piece, exponent: Piece) -> Piece:
        raise NotImplementedError

    def transpose(self, x: Piece) -> Piece:
        raise NotImplementedError

    def component(self, x: Piece, indices: Sequence[str]) -> Piece:
        """x with indices that count from 1; a range is `a:b` with both ends."""
        raise NotImplementedError

    def matrix(self, rows: Sequence[Sequence[Piece]]) -> Piece:
        raise NotImplementedError

    def function(self, expr: Node, args: Sequence[Piece]) -> Piece:
        """Every other operation."""
        raise NotImplementedError

    def tight(self, x: Piece, level: int) -> str:
        """The text of x where something that binds as tightly as `level` and has no minus sign is needed."""
        return self.bracketed(x.text) if x.level < level or x.negative else x.text

    def first(self, x: Piece, level: int) -> str:
        """As `tight`, at the beginning of a sum or product, where a minus sign needs no brackets."""
        return self.bracketed(x.text) if x.level < level else x.text


def render(expr: Node, notation: Notation) -> str:
    """The expression in a notation."""
    pieces: dict[Node, Piece] = {}
    for node in walk(expr):
        args = [pieces[arg] for arg in node.args if is_node(arg)]
        if node.op in ("stack", "row"):
            piece = notation.matrix([[pieces[x] for x in line] for line in matrix_rows(node)])
        else:
            piece = _RULES.get(node.op, _function)(notation, node, args)
        pieces[node] = piece if len(piece.text) <= LONGEST_PIECE else Piece(notation.ellipsis)
    return pieces[expr].text


def matrix_rows(expr: Node) -> list[list[Node]]:
    """The parts of a stack or row as the lines of a matrix; parts that form no grid stay whole."""
    if expr.op == "row":
        return [list(expr.args)]
    lines = [list(part.args) if part.op == "row" else [part] for part in expr.args]
    widths = {tuple(x.shape[1] for x in line) for line in lines}
    return lines if len(widths) == 1 else [[part] for part in expr.args]


def elided(size: int) -> list[int | None]:
    """The positions of a long list that are printed; None stands for those left out."""
    if size <= LARGEST_PRINTED:
        return list(range(size))
    return [*range(SHOWN_OF_LARGE), None, size - 1]


def _literal(notation: Notation, node: Node, args: list[Piece]) -> Piece:
    return notation.literal(*node.args)


def _symbol(notation: Notation, node: Node, args: list[Piece]) -> Piece:
    return notation.symbol(node.args[0], node.args[1])


def _deferred(notation: Notation, node: Node, args: list[Piece]) -> Piece:
    return notation.deferred(node.args[0])


def _add(notation: Notation, node: Node, args: list[Piece]) -> Piece:
    left, right = args
    sign = "+" if node.op == "add" else "-"
    text = f"{notation.first(left, SUM)} {sign} {notation.tight(right, LOOSE)}"
    return Piece(text, SUM, left.negative)


def _neg(notation: Notation, node: Node, args: list[Piece]) -> Piece:
    return Piece(f"-{notation.tight(args[0], LOOSE)}", PRODUCT, negative=True)


def _product(notation: Notation, node: Node, args: list[Piece]) -> Piece:
    a, b = node.args
    left, right = args
    if node.op == "scale" and a.op == "matmul" and b.shape != SCALAR:
        left = Piece(notation.bracketed(left.text))  # (w' w) v
    elif left.level < PRODUCT:
        left = Piece(notation.bracketed(left.text))
    bare = node.op == "matmul" and not right.negative and _keeps_together(b)
    after = right.text if bare else notation.tight(right, POWER)
    return Piece(notation.product(left.text, after), PRODUCT, left.negative)


def _keeps_together(expr: Node) -> bool:
    """Whether X (A B) may be printed X A B: true for a product of matrices that does not begin with k A or
    A/k.
    """
    if expr.op != "matmul":
        return False
    while expr.op == "matmul":
        expr = expr.args[0]
    return expr.op not in ("scale", "divide", "neg")


def _divide(notation: Notation, node: Node, args: list[Piece]) -> Piece:
    return notation.quotient(*args)


def _power(notation: Notation, node: Node, args: list[Piece]) -> Piece:
    return notation.power(*args) if node.shape == SCALAR else notation.function(node, args)


def _transpose(notation: Notation, node: Node, args: list[Piece]) -> Piece:
    return notation.transpose(args[0])


def _index(notation: Notation, node: Node, args: list[Piece]) -> Piece:
    x, rows, cols = node.args
    along = [rows] if x.shape[1] == 1 else [cols] if x.shape[0] == 1 else [rows, cols]
    sizes = [x.shape[0]] if x.shape[1] == 1 else [x.shape[1]] if x.shape[0] == 1 else list(x.shape)
    return notation.component(args[0], [_range(k, size) for k, size in zip(along, sizes, strict=True)])


def _range(positions: tuple[int, ...], size: int) -> str:
    first, last = positions[0] + 1, positions[-1] + 1
    if len(positions) == 1:
        return str(first)
    if positions == tuple(range(size)):
        return ":"
    step = positions[1] - positions[0]
    return f"{first}:{last}" if step == 1 else f"{first}:{step}:{last}"


def _function(notation: Notation, node: Node, args: list[Piece]) -> Piece:
    return notation.function(node, args)


_RULES: dict[str, Callable[[Notation, Node, list[Piece]], Piece]] = {
    "literal": _literal,
    "symbol": _symbol,
    "deferred": _deferred,
    "add": _add,
    "sub": _add,
    "neg": _neg,
    "scale": _product,
    "matmul": _product,
    "divide": _divide,
    "power": _power,
    "transpose": _transpose,
    "index": _index,
}
