"""LaTeX of expressions: well formed for every program, and as a reader of papers expects it."""

from __future__ import annotations

import re
from dataclasses import dataclass

import casadi as ca
import pytest
from hypothesis import given

from symctrl import vectors as sv
from symctrl.expr import Expr, deferred, foreign, lift, symbol
from symctrl.latex import latex, name_latex
from tests.programs import Program, programs

x, y, k = symbol("x"), symbol("y"), symbol("k")
v, w, M = symbol("v", (3, 1)), symbol("w", (3, 1)), symbol("M", (3, 3))
star = symbol("z", latex="z^{*}")


@dataclass(frozen=True)
class Named:
    label: str
    latex: str


def assert_well_formed(tex: str) -> None:
    """Braces and delimiters close in order, and nothing has two superscripts or two subscripts."""
    open_ones: list[str] = []
    partner = {"}": "{", r"\right": r"\left", r"\end": r"\begin"}
    for token in re.findall(r"\\left|\\right|\\begin|\\end|(?<!\\)[{}]", tex):
        if token in partner:
            assert open_ones.pop() == partner[token], tex
        else:
            open_ones.append(token)
    assert not open_ones, tex
    inner = tex
    while re.search(r"\{[^{}]*\}", inner):
        inner = re.sub(r"\{[^{}]*\}", "¤", inner)
        assert not re.search(r"[\^_]¤\s*\^¤\s*\^|\^¤\^|_¤_", inner), tex


@given(programs())
def test_every_program_prints_well_formed(program: Program) -> None:
    tex = latex(program.expr)
    assert_well_formed(tex)
    assert not re.search(r"\d \d", tex), "two numbers side by side would read as one"


WRITTEN: list[tuple[Expr, str]] = [
    (-k * v.T @ v, r"-k v^{\mathsf T} v"),
    (v.T @ M @ v / 2, r"\frac{v^{\mathsf T} M v}{2}"),
    (-x / y, r"-\frac{x}{y}"),
    ((x - y) / k, r"\frac{x - y}{k}"),
    ((x / y) ** 2, r"\left(\frac{x}{y}\right)^{2}"),
    (x ** lift("1/3"), r"x^{1/3}"),
    (x ** (y + 1), r"x^{y + 1}"),
    (x * 3, r"x \cdot 3"),
    (2 * x, "2 x"),
    (x * lift("-1/3"), r"x \left(-\frac{1}{3}\right)"),
    (lift("-2e-3") * x, r"-2 \cdot 10^{-3} x"),
    (k * (x + y), r"k \left(x + y\right)"),
    (sv.skew(v) @ w, r"v^{\times} w"),
    (sv.skew(v + w), r"\left(v + w\right)^{\times}"),
    (sv.inverse(M).T, r"\left(M^{-1}\right)^{\mathsf T}"),
    (sv.kron(M, sv.eye(3)) @ symbol("z", (9, 1)), r"\left(M \otimes I_{3}\right) z"),
    (sv.cross(v, sv.cross(v, w)), r"v \times \left(v \times w\right)"),
    (v - sv.cross(v, w), r"v - v \times w"),
    (sv.dot(v, w) * x, r"\left(v \cdot w\right) x"),
    (sv.absolute(x) + sv.norm(v, 1), r"\left|x\right| + \left\|v\right\|_{1}"),
    (sv.norm(v) + sv.norm(v, "inf"), r"\left\|v\right\| + \left\|v\right\|_{\infty}"),
    (sv.sqrt(x) * sv.sgn(x), r"\sqrt{x} \operatorname{sgn}\left(x\right)"),
    (sv.sin(x) ** 2, r"\left(\sin\left(x\right)\right)^{2}"),
    (sv.signed_power(v, k), r"\left|v\right|^{k} \operatorname{sgn}\left(v\right)"),
    (sv.saturate(v, k), r"\operatorname{sat}_{k}\left(v\right)"),
    (sv.power(v, 2), "v^{2}"),
    (sv.maximum(x, y), r"\max\left(x, y\right)"),
    (sv.atan2(x, y), r"\operatorname{atan2}\left(x, y\right)"),
    (sv.det(M) * sv.trace(M), r"\det\left(M\right) \operatorname{tr}\left(M\right)"),
    (sv.diagonal(M, x), r"\operatorname{diag}\left(M, x\right)"),
    (sv.zeros(2, 3), r"0_{2 \times 3}"),
    (v[0] * M[1, 2], "v_{1} M_{2,3}"),
    (symbol("q_d", (3, 1))[1:], "q_{d,2:3}"),
    ((v + w)[0], r"\left(v + w\right)_{1}"),
    (lift([[1, x], [y, 0]]), r"\begin{pmatrix} 1 & x \\ y & 0 \end{pmatrix}"),
    (star**2, r"\left(z^{*}\right)^{2}"),
    (star * 2, r"z^{*} \cdot 2"),
    (deferred(Named("rate1", r"\dot V")) / 2, r"\frac{\dot V}{2}"),
    (deferred(Named("s1", r"\sum_{j} e_{ij}")) * k, r"\left(\sum_{j} e_{ij}\right) k"),
    (foreign(ca.SX.sym("s"), "f_1{}"), r"\mathtt{f\_1\{\}}"),
]


@pytest.mark.parametrize(("expr", "tex"), WRITTEN)
def test_it_reads_like_a_paper(expr: Expr, tex: str) -> None:
    assert latex(expr) == tex
    assert_well_formed(tex)


@pytest.mark.parametrize(
    ("name", "tex"),
    [
        ("omega", r"\omega"),
        ("K_o", "K_{o}"),
        ("q.i", "q_{i}"),
        ("q_d.i[1]", "q_{d,i,1}"),
        ("q0", "q_{0}"),
        ("u_bar", r"\bar{u}"),
        ("q_tilde_dot", r"\dot{\tilde{q}}"),
        ("k_omega", r"k_{\omega}"),
        ("J[1,2]", "J_{1,2}"),
        ("mass", r"\mathrm{mass}"),
        ("theta12", r"\theta_{12}"),
    ],
)
def test_a_name_becomes_what_it_is_called(name: str, tex: str) -> None:
    assert name_latex(name) == tex


def test_a_large_matrix_is_elided_in_both_directions() -> None:
    tex = latex(sv.block([[symbol(f"a{r}c{c}") for c in range(20)] for r in range(20)]))
    assert tex.count(r"\\") == 7
    assert tex.count(r"\vdots") == 8
    assert tex.count(r"\cdots") == 7
