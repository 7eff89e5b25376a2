r"""Expressions in LaTeX, printed as they were written.

A symbol prints with its own LaTeX or by its name: `omega` is \omega, `K_o` K_{o}, `u_bar` \bar{u}, and the
node of a fleet, `q.i`, becomes the last subscript, q_{i}.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache
from typing import Any

from symctrl.nodes import Node
from symctrl.printing import ATOM, LOOSE, POWER, PRODUCT, SUM, Notation, Piece, elided, render

_GREEK = re.compile(
    "alpha|beta|gamma|delta|(var)?epsilon|zeta|eta|(var)?theta|iota|kappa|lambda|mu|nu|xi|pi|(var)?rho|sigma|tau|upsilon|"
    "(var)?phi|chi|psi|omega|ell|Gamma|Delta|Theta|Lambda|Xi|Pi|Sigma|Upsilon|Phi|Psi|Omega"
)
_ACCENTS = {
    "bar": r"\bar",
    "tilde": r"\tilde",
    "hat": r"\hat",
    "dot": r"\dot",
    "ddot": r"\ddot",
    "check": r"\check",
    "vec": r"\vec",
}
_COMMANDS = {
    **{name: rf"\{name}" for name in ("sin", "cos", "tan", "exp", "log", "sinh", "cosh", "tanh", "det")},
    "asin": r"\arcsin",
    "acos": r"\arccos",
    "atan": r"\arctan",
    "minimum": r"\min",
    "maximum": r"\max",
    "trace": r"\operatorname{tr}",
    "sgn": r"\operatorname{sgn}",
    "diagonal": r"\operatorname{diag}",
    "atan2": r"\operatorname{atan2}",
}
_SUBSCRIPTED = re.compile(r"(.*)_\{([^{}]*)\}")


def latex(expr: Node) -> str:
    """The expression in LaTeX, for mathematics mode."""
    return render(expr, _NOTATION)


@cache
def name_latex(name: str) -> str:
    r"""The LaTeX of a symbol's or scalar's name: `q_d.i[1]` is q_{d,i,1}."""
    base, *subscripts = [part for part in re.split(r"[_.\[\],]+", name) if part]
    accents = []
    while subscripts and subscripts[0] in _ACCENTS:
        accents.append(_ACCENTS[subscripts.pop(0)])
    match = re.fullmatch(r"([A-Za-z]+)(\d+)", base)
    if match:
        base, subscripts = match[1], [match[2], *subscripts]
    body = _word(base)
    for accent in accents:
        body = f"{accent}{{{body}}}"
    return body + (f"_{{{','.join(_word(s) for s in subscripts)}}}" if subscripts else "")


def _word(word: str) -> str:
    if _GREEK.fullmatch(word):
        return rf"\{word}"
    return word if len(word) == 1 or word.isdigit() else rf"\mathrm{{{word}}}"


class Latex(Notation):
    """The notation of `latex`."""

    ellipsis = r"\cdots"

    def bracketed(self, text: str) -> str:
        return rf"\left({text}\right)"

    def symbol(self, name: str, latex: str | None) -> Piece:
        return _opaque(name_latex(name) if latex is None else latex)

    def deferred(self, record: Any) -> Piece:
        return _opaque(record.latex)

    def literal(self, value: Fraction, text: str) -> Piece:
        sign, size = ("-", text[1:].strip()) if text.startswith("-") else ("", text)
        if "/" in size:
            above, below = size.split("/")
            return Piece(rf"{sign}\frac{{{above}}}{{{below}}}", POWER, bool(sign))
        if "e" in size.lower():
            mantissa, exponent = size.lower().split("e")
            return Piece(rf"{sign}{mantissa} \cdot 10^{{{int(exponent)}}}", PRODUCT, bool(sign))
        return Piece(text, ATOM, bool(sign))

    def product(self, left: str, right: str) -> str:
        number_follows = right[:1].isdigit() or right.startswith(r"\frac")
        return rf"{left} \cdot {right}" if number_follows else f"{left} {right}"

    def quotient(self, above: Piece, below: Piece) -> Piece:
        sign, numerator = ("-", above.text[1:]) if above.negative and above.level > SUM else ("", above.text)
        return Piece(rf"{sign}\frac{{{numerator}}}{{{below.text}}}", POWER, bool(sign))

    def power(self, base: Piece, exponent: Piece) -> Piece:
        shown = re.sub(r"^(-?)\\frac\{([^{}]*)\}\{([^{}]*)\}$", r"\1\2/\3", exponent.text)
        return Piece(f"{self.tight(base, ATOM)}^{{{shown}}}", POWER)

    def transpose(self, x: Piece) -> Piece:
        return Piece(rf"{self.tight(x, ATOM)}^{{\mathsf T}}", POWER)

    def component(self, x: Piece, indices: Sequence[str]) -> Piece:
        index = ",".join(indices)
        plain = x.level == ATOM and not x.negative and not x.text.startswith(r"\left")
        subscripted = _SUBSCRIPTED.fullmatch(x.text) if plain else None
        if subscripted:
            return Piece(f"{subscripted[1]}_{{{subscripted[2]},{index}}}")
        base = x.text if plain and "_" not in x.text else self.bracketed(x.text)
        return Piece(f"{base}_{{{index}}}")

    def matrix(self, rows: Sequence[Sequence[Piece]]) -> Piece:
        width = len(elided(len(rows[0])))
        lines = [
            " & ".join([r"\vdots"] * width) if r is None else self._line(rows[r]) for r in elided(len(rows))
        ]
        body = r" \\ ".join(lines)
        return Piece(rf"\begin{{pmatrix}} {body} \end{{pmatrix}}")

    def function(self, expr: Node, args: Sequence[Piece]) -> Piece:
        shape = _SHAPES.get(expr.op)
        if shape is not None:
            return shape(self, expr, args)
        inside = ", ".join(piece.text for piece in args)
        return Piece(f"{_COMMANDS[expr.op]}{self.bracketed(inside)}", POWER)

    def _line(self, row: Sequence[Piece]) -> str:
        return " & ".join(r"\cdots" if c is None else row[c].text for c in elided(len(row)))


def _opaque(latex: str) -> Piece:
    """A piece of foreign LaTeX: how tightly it binds is read from its signs outside of braces."""
    outside = latex
    while "{" in outside:
        outside, before = re.sub(r"\{[^{}]*\}", "", outside), outside
        if outside == before:
            break
    if re.search(r"[^\s]\s*[+-]|\\(sum|int|prod)", outside) or outside.startswith("-"):
        return Piece(latex, SUM, outside.startswith("-"))
    if re.search(r"\\(times|cdot|otimes)\b", outside):
        return Piece(latex, LOOSE)
    return Piece(latex, POWER if re.search(r"[\^']", outside) else ATOM)


def _between(sign: str) -> Callable[[Latex, Node, Sequence[Piece]], Piece]:
    def shape(notation: Latex, expr: Node, args: Sequence[Piece]) -> Piece:
        left, right = (notation.tight(x, POWER) for x in args)
        return Piece(f"{left} {sign} {right}", LOOSE)

    return shape


def _superscript(sign: str) -> Callable[[Latex, Node, Sequence[Piece]], Piece]:
    def shape(notation: Latex, expr: Node, args: Sequence[Piece]) -> Piece:
        return Piece(f"{notation.tight(args[0], ATOM)}^{{{sign}}}", POWER)

    return shape


def _absolute(notation: Latex, expr: Node, args: Sequence[Piece]) -> Piece:
    return Piece(rf"\left|{args[0].text}\right|")


def _norm(notation: Latex, expr: Node, args: Sequence[Piece]) -> Piece:
    subscript = {"1": "_{1}", "2": "", "inf": r"_{\infty}"}[expr.args[1]]
    return Piece(rf"\left\|{args[0].text}\right\|{subscript}")


def _sqrt(notation: Latex, expr: Node, args: Sequence[Piece]) -> Piece:
    return Piece(rf"\sqrt{{{args[0].text}}}")


def _signed_power(notation: Latex, expr: Node, args: Sequence[Piece]) -> Piece:
    size = notation.power(_absolute(notation, expr, args), args[1]).text
    return Piece(rf"{size} \operatorname{{sgn}}{notation.bracketed(args[0].text)}", LOOSE)


def _saturate(notation: Latex, expr: Node, args: Sequence[Piece]) -> Piece:
    return Piece(rf"\operatorname{{sat}}_{{{args[1].text}}}{notation.bracketed(args[0].text)}", POWER)


def _power(notation: Latex, expr: Node, args: Sequence[Piece]) -> Piece:
    return notation.power(*args)


def _eye(notation: Latex, expr: Node, args: Sequence[Piece]) -> Piece:
    return Piece(f"I_{{{expr.shape[0]}}}")


def _zeros(notation: Latex, expr: Node, args: Sequence[Piece]) -> Piece:
    return Piece(rf"0_{{{expr.shape[0]} \times {expr.shape[1]}}}")


def _foreign(notation: Latex, expr: Node, args: Sequence[Piece]) -> Piece:
    escaped = re.sub(r"([_#$%&{}^~])", r"\\\1", expr.args[0])
    return Piece(rf"\mathtt{{{escaped}}}")


_SHAPES: dict[str, Callable[[Latex, Node, Sequence[Piece]], Piece]] = {
    "kron": _between(r"\otimes"),
    "cross": _between(r"\times"),
    "dot": _between(r"\cdot"),
    "skew": _superscript(r"\times"),
    "inverse": _superscript("-1"),
    "absolute": _absolute,
    "norm": _norm,
    "sqrt": _sqrt,
    "signed_power": _signed_power,
    "saturate": _saturate,
    "power": _power,
    "eye": _eye,
    "zeros": _zeros,
    "foreign": _foreign,
}

_NOTATION = Latex()
