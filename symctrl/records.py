"""What a deferred quantity stands for: a definition's value, a rate, a sum over a fleet, an undefined
letter.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass

from symctrl.expr import Expr, deferred, walk
from symctrl.latex import latex
from symctrl.text import text


@dataclass(frozen=True)
class Named:
    """The value of a definition; in a fleet that at one node, where `body` is written for the node i."""

    label: str
    latex: str
    body: Expr


@dataclass(frozen=True)
class Rate:
    """The time derivative of `body` along the motion, under a law."""

    label: str
    latex: str
    body: Expr
    law: str | None

    @property
    def text(self) -> str:
        return f"rate({text(self.body)})"


@dataclass(frozen=True)
class Sum:
    """The sum of `body` over the neighbours j of node i, or (`total`) over all nodes i."""

    label: str
    latex: str
    body: Expr
    total: bool

    @property
    def text(self) -> str:
        return f"sum_{'i' if self.total else 'j'}({text(self.body)})"


@dataclass(frozen=True)
class Undefined:
    """A letter that the paper uses and never defines."""

    label: str
    latex: str


Record = Named | Rate | Sum | Undefined


def letters(expr: Expr) -> set[str]:
    """The node letters that the expression mentions (those inside sums and definitions are theirs)."""
    found = set()
    for node in walk(expr):
        if node.op in ("symbol", "deferred"):
            label = node.args[0] if node.op == "symbol" else node.args[0].label
            if "." in label:
                found.add(label.partition(".")[2])
    return found


def rate(body: Expr, law: str | None) -> Expr:
    """The deferred rate of an expression at no node or at one. Raises ValueError for one that speaks of
    two.
    """
    at = letters(body)
    if len(at) > 1:
        raise ValueError("the rate of an expression at two nodes: write the rates of its parts")
    where = f".{next(iter(at))}" if at else ""
    written = latex(body)
    dotted = (
        rf"\dot{{{written}}}"
        if body.op in ("symbol", "deferred")
        else rf"\frac{{d}}{{dt}}\left({written}\right)"
    )
    return deferred(Rate(f"rate_{fingerprint(body, law or '')}{where}", dotted, body, law), body.shape)


def fingerprint(expr: Expr, *more: str) -> str:
    """A short digest of the expression's structure: equal structures have equal fingerprints."""
    digests: dict[Expr, str] = {}
    for node in walk(expr):
        parts = [node.op, str(node.shape)]
        for arg in node.args:
            if isinstance(arg, Expr):
                parts.append(digests[arg])
            else:
                parts.append(arg.label if hasattr(arg, "label") else repr(arg))
        digests[node] = hashlib.sha256("\x1f".join(parts).encode()).hexdigest()
    return hashlib.sha256("\x1f".join([digests[expr], *more]).encode()).hexdigest()[:10]
