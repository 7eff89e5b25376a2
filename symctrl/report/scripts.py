"""A program for each witness that evaluates the claim there, of Python's standard library alone.

A short claim is written out in at most ten lines. A longer one is evaluated by `PROGRAM`, which reads the
certificate and runs its instruction lists; that is the same program for every witness.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from importlib.resources import files as resources
from typing import Any

from symctrl.kernel.certificate import Refused
from symctrl.kernel.evaluation import Evaluation, GraphSums, NoSums
from symctrl.kernel.form import read_statement
from symctrl.kernel.values import Statement
from symctrl.report.names import certificate_path
from symctrl.report.page import Script
from symctrl.report.terms import Term, Terms, written
from symctrl.rows import Row

LINES, WIDTH = 10, 110
PROGRAM = (resources("symctrl.report") / "templates" / "witness.py.txt").read_text("utf-8").rstrip()
NAME = "witness.py"
KNOWN = {"INPUT", "CONST", *re.findall(r'"([A-Z]+)": ', PROGRAM)}  # what the program evaluates
_ZERO = Fraction(0)
_SIGN = "sign = lambda a: (a > 0) - (a < 0)"


def script(study: str, row: Row) -> Script:
    """What evaluates the witness of a row, or why there is nothing."""
    made = row.certificate
    if row.witness is None or made is None:
        return Script()
    if made["proof"]["kind"] != "witness":
        return Script(
            why_not="The claim is about whole solutions: values alone do not show it, the certificate does."
        )
    try:
        text = _written_out(made)
    except Refused:
        text = None
    if text is not None:
        return Script(text=text)
    if _operations(made) <= KNOWN and all(type(value) is str for value in made["proof"]["values"].values()):
        return Script(command=f"python3 -I {NAME} {certificate_path(study, row)}")
    return Script(why_not="Its value is no fraction: the kernel encloses it, and a short program would not.")


def _operations(made: Mapping[str, Any]) -> set[str]:
    """The operations of the certificate's instruction lists."""
    return {step[0] for listing in made["statement"]["listings"].values() for step in listing["code"]}


@dataclass(frozen=True)
class _Sides:
    """The terms that a witness is about, their names, and what is printed of them."""

    terms: tuple[Term, ...]
    names: tuple[str, ...]
    says: str


def _written_out(made: Mapping[str, Any]) -> str | None:
    """The program, if it is short enough."""
    given, proof = _without_constants(made["statement"], made["proof"])
    statement, domain = read_statement(given), Terms()
    sides = _sides(statement, proof, domain)
    if sides is None or any(type(value) is not str for value in proof["values"].values()):
        return None
    values = {**proof["values"], **{f"x_{k}": entry for k, entry in enumerate(proof.get("x", []), start=1)}}
    lines = [_header(domain), *_values(values, sides.terms)]
    if "sign" in domain.functions:
        lines.append(_SIGN)
    lines += _packed(written(sides.terms, sides.names), "; ")
    lines.append(f'print(f"{sides.says}")')
    short = len(lines) <= LINES and all(len(line) <= WIDTH for line in lines)
    return "\n".join(lines) if short else None


def _without_constants(
    statement: Mapping[str, Any], proof: Mapping[str, Any]
) -> tuple[Mapping[str, Any], Mapping[str, Any]]:
    """The same with constants as symbols that have a value, so that they are seen by name."""
    names = statement["names"]
    constants = {
        key: one["value"] for key, one in names.items() if one["is"] == "constant" and "*" not in key
    }
    kept = {key: one for key, one in names.items() if key not in constants}
    scalars = statement["scalars"] | dict.fromkeys(constants, "parameter")
    return (
        {**statement, "names": kept, "scalars": scalars},
        {**proof, "values": {**proof["values"], **constants}},
    )


def _header(domain: Terms) -> str:
    return (
        "from fractions import Fraction as F"
        if domain.exact
        else "import math; from fractions import Fraction as F"
    )


def _sides(statement: Statement, proof: Mapping[str, Any], domain: Terms) -> _Sides | None:
    graph: dict[str, list[str]] = {}
    for edge in proof.get("graph", []):
        for a, b in (edge, edge[::-1]):
            graph.setdefault(a, []).append(b)
    walk: Evaluation[Term] = Evaluation(
        statement,
        domain,
        lambda name: domain.symbol(_variable(name)),
        GraphSums(graph) if graph else NoSums(),
    )
    binding = {letter: proof[key] for letter, key in (("i", "node"), ("j", "neighbour")) if key in proof}
    claim = statement.claim
    outputs = walk.outputs(claim.listing, binding)
    about, form = ("", "") if domain.exact else ("about ", ":.6g")
    if claim.matrix is not None:
        x = [
            domain.constant(_ZERO) if entry == "0" else domain.symbol(f"x_{k}")
            for k, entry in enumerate(proof["x"], 1)
        ]
        value = _form(claim.matrix, outputs, x, domain)
        return None if value is None else _Sides((value,), ("value",), f"x'Ax is {about}{{value{form}}}")
    count, at = claim.shape[0] * claim.shape[1], proof["at"]
    if claim.kind == "equal":
        says = f"left is {about}{{left{form}}}, right is {about}{{right{form}}}"
        return _Sides((outputs[at], outputs[count + at]), ("left", "right"), says)
    return _Sides((outputs[at],), ("left",), f"left is {about}{{left{form}}}, right is 0")


def _form(tree: Any, outputs: Sequence[Term], x: Sequence[Term], domain: Terms) -> Term | None:
    """x'Ax for a matrix of entries, or of blocks and Kronecker products of such."""
    parts = _leaves(tree, x)
    if parts is None:
        return None
    total = domain.constant(_ZERO)
    for entries, chosen in parts:
        for a, line in zip(chosen, entries, strict=True):
            for b, k in zip(chosen, line, strict=True):
                total = domain.add(total, domain.mul(domain.mul(a, b), outputs[k]))
    return total


def _leaves(tree: Any, x: Sequence[Term]) -> list[tuple[Any, Sequence[Term]]] | None:
    """The blocks on the diagonal with the entries of x that belong to each."""
    if "entries" in tree:
        return [(tree["entries"], x)]
    if "congruence" in tree:
        return None
    found: list[tuple[Any, Sequence[Term]]] = []
    at = 0
    blocks, copies = tree.get("blocks", [tree.get("kron_identity")]), tree.get("size", 1)
    for block in blocks:
        size = _size(block) * copies
        for k in range(copies):
            inner = _leaves(block, x[at + k : at + size : copies])
            if inner is None:
                return None
            found += inner
        at += size
    return found


def _size(tree: Any) -> int:
    if "entries" in tree:
        return len(tree["entries"])
    if "blocks" in tree:
        return sum(map(_size, tree["blocks"]))
    return (
        _size(tree["kron_identity"]) * int(tree["size"])
        if "kron_identity" in tree
        else _size(tree["congruence"])
    )


def _variable(name: str) -> str:
    """`q.1[3]` as q1_3."""
    return re.sub(r"[\[,]", "_", name).replace("]", "").replace(".", "")


def _values(values: dict[str, str], results: Sequence[Term]) -> list[str]:
    """The values of the symbols that are read, as many in a line as fit."""
    read = _symbols(results)
    told = [(name, values[key]) for key in values if (name := _variable(key)) in read]
    lines: list[list[tuple[str, str]]] = []
    for one in told:
        if lines and len(_assigned([*lines[-1], one])) <= WIDTH:
            lines[-1].append(one)
        else:
            lines.append([one])
    return [_assigned(line) for line in lines]


def _assigned(pairs: Sequence[tuple[str, str]]) -> str:
    left = ", ".join(name for name, _ in pairs)
    if len(pairs) == 1:
        return f'{left} = F("{pairs[0][1]}")'
    return f'{left} = map(F, "{" ".join(value for _, value in pairs)}".split())'


def _symbols(results: Sequence[Term]) -> set[str]:
    found: set[str] = set()
    seen: set[int] = set()
    todo = list(results)
    while todo:
        term = todo.pop()
        if id(term) not in seen:
            seen.add(id(term))
            todo += term.args
            if not term.args and term.number is None:
                found.add(term.op)
    return found


def _packed(statements: Sequence[str], glue: str) -> list[str]:
    """The statements, as many in a line as fit."""
    lines: list[str] = []
    for one in statements:
        if lines and len(lines[-1]) + len(glue) + len(one) <= WIDTH:
            lines[-1] += glue + one
        else:
            lines.append(one)
    return lines
