"""The one error of the author's language: shapes that do not go together."""

from __future__ import annotations

from symctrl.nodes import Node
from symctrl.text import text


class Nonconforming(ValueError):  # noqa: N818, an author reads it as a word
    """Shapes that do not go together; the message has the shapes and the texts."""


def mismatch(what: str, left: Node, right: Node, hint: str = "") -> Nonconforming:
    """The error for two arguments whose shapes do not go together."""
    return Nonconforming(
        f"{what}: left is {size(left)}, right is {size(right)}: "
        f"({short_text(left)}) and ({short_text(right)})" + (f"; {hint}" if hint else "")
    )


def misfit(what: str, needed: str, given: Node, hint: str = "") -> Nonconforming:
    """The error for one argument of a wrong shape."""
    return Nonconforming(
        f"{what}: needs {needed}, given {size(given)}: ({short_text(given)})" + (f"; {hint}" if hint else "")
    )


def size(x: Node) -> str:
    """The shape in words: `3x1`."""
    return f"{x.shape[0]}x{x.shape[1]}"


def short_text(expr: Node, limit: int = 120) -> str:
    """The expression in plain mathematics, cut in its middle where it is long."""
    full = text(expr)
    return full if len(full) <= limit else f"{full[: limit // 2]} ... {full[-limit // 3 :]}"
