"""The study itself: its motion, definitions and laws in the paper's numbers, and its symbols."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from symctrl.latex import latex, name_latex
from symctrl.model import Symbol
from symctrl.report.mathml import differ, math, pair
from symctrl.report.names import Group, anchor, chip, numbers
from symctrl.report.page import Formula, StudyBlock, SymbolLine
from symctrl.rows import Report
from symctrl.study import Study

MANY = 6  # values of one symbol that are shown


def block(study: Study, grouped: Sequence[Group], units: Mapping[str, str]) -> StudyBlock:
    return StudyBlock(
        motions=tuple(math(rf"\dot{{{latex(x)}}} = {latex(xdot)}") for x, xdot in study.motions),
        formulas=tuple(_formula(g) for g in grouped if g.form in ("definition", "law")),
        symbols=tuple(_symbol(name, one, units) for name, one in study.symbols.items()),
    )


def _formula(group: Group) -> Formula:
    row = group.rows[0]
    corrected = next(iter(group.corrections), None)
    printed, other = math(row.latex), None
    if corrected is not None and row.latex and differ(row.latex, corrected.latex):
        printed, other = pair(row.latex, corrected.latex)
    elif corrected is not None:
        other = math(corrected.latex)
    return Formula(
        anchor=anchor(group.base, "d"),
        equation=row.equation,
        printed=printed,
        chip=chip(row),
        corrected=other,
        why=corrected.finding if corrected is not None else None,
        reason=numbers(row.reason) if row.verdict != "proved" else None,
    )


def _symbol(name: str, symbol: Symbol, units: Mapping[str, str]) -> SymbolLine:
    kind = "gain" if symbol.gain else symbol.kind
    rows, columns = symbol.expr.shape
    size = f", {rows} × {columns}" if columns > 1 else f", {rows} components" if rows > 1 else ""
    values = [str(value) for value in symbol.values.values()]
    shown = numbers(", ".join(values[:MANY])) + (", …" if len(values) > MANY else "")
    return SymbolLine(math(letter(name, symbol)), f"{kind}{size}", shown, units.get(_bare(name), ""))


def letter(name: str, symbol: Symbol) -> str:
    """The symbol in LaTeX, without the node that it may belong to."""
    return str(symbol.expr.args[1] or name_latex(name.removesuffix(".*")))


def units_of(study: Study, report: Report) -> dict[str, str]:
    """The unit of each symbol, by the name before its node: declared, or found from the equations."""
    found: dict[str, str] = {}
    for row in report.rows:
        for name, unit in (row.units.inferred if row.units is not None else {}).items():
            found.setdefault(_bare(name), unit)
    declared = {_bare(name): s.unit for name, s in study.symbols.items() if s.unit is not None}
    return {name: readable(unit) for name, unit in (found | declared).items()}


def latex_of(study: Study) -> dict[str, str]:
    """The LaTeX of the symbols to which their author has given one."""
    return {_bare(name): str(s.expr.args[1]) for name, s in study.symbols.items() if s.expr.args[1]}


def _bare(name: str) -> str:
    return name.partition("[")[0].partition(".")[0]


def readable(unit: str) -> str:
    """`kg*m^2/s` as kg m²/s; a pure number has no unit to show."""
    digits = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
    out, raised = "", False
    for sign in unit:
        if sign == "^":
            raised = True
        elif raised and (sign.isdigit() or sign == "-"):
            out += sign.translate(digits)
        else:
            raised = False
            out += "\N{NO-BREAK SPACE}" if sign == "*" else sign
    return "" if out == "1" else out
