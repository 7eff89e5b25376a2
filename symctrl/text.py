"""Expressions in plain mathematics, for messages and tables: `-c*omega'*omega`, `x^2`, `[a, b; c, d]`,
`q[1]`.

A prime is the transpose, `*` is every product, components count from 1, functions have the names of
`vectors.py`.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from symctrl.nodes import SCALAR, Node
from symctrl.printing import ATOM, LOOSE, POWER, PRODUCT, Notation, Piece, elided, render


def text(expr: Node) -> str:
    """The expression in plain mathematics."""
    return render(expr, _NOTATION)


class PlainText(Notation):
    """The notation of `text`."""

    def bracketed(self, text: str) -> str:
        return f"({text})"

    def symbol(self, name: str, latex: str | None) -> Piece:
        return Piece(name)

    def deferred(self, record: Any) -> Piece:
        return Piece(getattr(record, "text", record.label))

    def literal(self, value: Fraction, text: str) -> Piece:
        return Piece(
            text, PRODUCT if "/" in text else POWER if "e" in text.lower() else ATOM, text.startswith("-")
        )

    def product(self, left: str, right: str) -> str:
        return f"{left}*{right}"

    def quotient(self, above: Piece, below: Piece) -> Piece:
        return Piece(f"{self.first(above, PRODUCT)}/{self.tight(below, POWER)}", PRODUCT, above.negative)

    def power(self, base: Piece, exponent: Piece) -> Piece:
        return Piece(f"{self.tight(base, ATOM)}^{self.tight(exponent, ATOM)}", POWER)

    def transpose(self, x: Piece) -> Piece:
        return Piece(f"{self.tight(x, ATOM)}'", POWER)

    def component(self, x: Piece, indices: Sequence[str]) -> Piece:
        return Piece(f"{self.tight(x, ATOM)}[{','.join(indices)}]")

    def matrix(self, rows: Sequence[Sequence[Piece]]) -> Piece:
        lines = ["..." if r is None else self._line(rows[r]) for r in elided(len(rows))]
        return Piece(f"[{'; '.join(lines)}]")

    def function(self, expr: Node, args: Sequence[Piece]) -> Piece:
        shown = [piece.text for piece in args]
        if expr.op in ("eye", "zeros"):
            shown = [str(n) for n in (expr.shape[:1] if expr.op == "eye" else expr.shape)]
        if expr.op == "foreign":
            return Piece(expr.args[0], LOOSE if expr.shape == SCALAR else ATOM)
        if expr.op == "norm" and expr.args[1] != "2":
            shown.append(expr.args[1])
        return Piece(f"{expr.op}({', '.join(shown)})")

    def _line(self, row: Sequence[Piece]) -> str:
        return ", ".join("..." if c is None else row[c].text for c in elided(len(row)))


_NOTATION = PlainText()
