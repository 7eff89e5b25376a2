"""Exact values in LaTeX: a residual, as a reader wants to see it."""

from __future__ import annotations

from symctrl.domains.field import Exact, Field, Generator, Poly
from symctrl.latex import name_latex

MAX_TERMS = 12


def value_latex(field: Field, value: Exact) -> str:
    """The sum of fractions; a long numerator is cut, with the number of its terms."""
    parts = []
    for key, p in value.items():
        numerator = polynomial_latex(field, p)
        below = " ".join(
            _powered(rf"\left({polynomial_latex(field, field.factors[k])}\right)", e) for k, e in key
        )
        parts.append(rf"\frac{{{numerator}}}{{{below}}}" if below else numerator)
    return " + ".join(parts) or "0"


def polynomial_latex(field: Field, p: Poly) -> str:
    """The polynomial by falling monomials."""
    text = ""
    for count, (exponents, c) in enumerate(p.terms()):
        if count == MAX_TERMS:
            return text + rf" + \cdots \text{{ ({len(p)} terms)}}"
        factors = [
            _powered(generator_latex(field, field.generators[field.size - 1 - v]), int(e))
            for v, e in enumerate(exponents)
            if e
        ]
        size = abs(c)
        number = str(size.p) if size.q == 1 else rf"\tfrac{{{size.p}}}{{{size.q}}}"
        term = " ".join(([number] if size != 1 or not factors else []) + factors)
        sign = ("-", " - ") if c < 0 else ("", " + ")
        text += sign[bool(text)] + term
    return text or "0"


def generator_latex(field: Field, g: Generator) -> str:
    """A free symbol by its name, an opaque generator by its definition."""
    match g.kind:
        case "free":
            return name_latex(g.name.rstrip("'")) + "'" * g.name.count("'")
        case "sum":
            return rf"\sum_{{j}} {polynomial_latex(field, g.argument)}"
        case "root":
            index = "" if g.degree == 2 else f"[{g.degree}]"
            return rf"\sqrt{index}{{{polynomial_latex(field, g.argument)}}}"
        case "abs":
            return rf"\left|{polynomial_latex(field, g.argument)}\right|"
        case "sign":
            return rf"\operatorname{{sgn}}\left({polynomial_latex(field, g.argument)}\right)"
        case "power":
            base = polynomial_latex(field, g.argument)
            return rf"\left({base}\right)^{{{value_latex(field, g.exponent)}}}"
        case "exp":
            return rf"e^{{{value_latex(field, g.argument)}}}"
        case "cos" | "sin":
            return rf"\{g.kind}\left({value_latex(field, g.argument)}\right)"
    arguments = ", ".join(value_latex(field, a) for a in g.argument)
    return rf"\operatorname{{{g.name}}}\left({arguments}\right)"


def _powered(base: str, exponent: int) -> str:
    return base if exponent == 1 else rf"{{{base}}}^{{{exponent}}}"
