"""Expressions as instruction lists, with every name that they reach: definitions, motions and laws."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

import casadi as ca

from symctrl.entries import component_names
from symctrl.expr import Expr, walk
from symctrl.graph import Instruction, Tape, read, unfolded
from symctrl.literals import as_sx, is_constant_name
from symctrl.problem import Meaning, Output, split, star
from symctrl.reach import Reach
from symctrl.records import Named, Rate, Record, Sum, Undefined

if TYPE_CHECKING:
    from symctrl.study import Study


class UndefinedLetter(ValueError):  # noqa: N818
    """The claim uses a letter that the paper never defines."""


class Listings:
    """Listings by name, and what their scalars mean. values: exact values of parameters that are bound, by
    scalar name. bodies: other formulas for laws, by their names.
    """

    def __init__(
        self,
        study: Study,
        values: Mapping[str, Fraction] | None = None,
        bodies: Mapping[str, Expr] | None = None,
    ) -> None:
        self.study = study
        self.bodies = dict(bodies or {})
        self.values = dict(values or {})
        self.listings: dict[str, Tape] = {}
        self.scalars: dict[str, str] = {}
        self.names: dict[str, Meaning] = {}
        self.motion: dict[str, Output] = {}
        self.laws: dict[str, dict[str, Output]] = {}
        self.labels: dict[str, str] = {}

    def add(self, name: str, exprs: Sequence[Expr], at_neighbour: bool = False) -> None:
        """The listing of expressions one after another, and all that it reaches.

        at_neighbour: the expressions are written for node j, and the listing shall be for node i.
        """
        if name in self.listings:
            return
        records: dict[str, Record] = {}
        for expr in exprs:
            for node in walk(expr):
                if node.op == "deferred":
                    records[node.args[0].label] = node.args[0]
        with unfolded():
            entries = ca.vertcat(*[as_sx(entry) for expr in exprs for entry in expr.entries])
            symbols = ca.symvar(entries)
            function = ca.Function("listing", [ca.vertcat(*symbols)], [ca.densify(entries)])
        shown = [self._shown(s.name(), records, at_neighbour) for s in symbols]
        self.listings[name] = self._bound(read(function, shown))
        for label, record in records.items():
            self._record(label, record)
        for scalar in self.listings[name].inputs:
            self._scalar(star(scalar))

    def _shown(self, scalar: str, records: Mapping[str, Record], at_neighbour: bool) -> str:
        """The name of a scalar in a listing: anonymous records get short names, and a lone neighbour is the
        node.
        """
        base, node, index = split(scalar)
        label = base if node is None else f"{base}.{node}"
        if label in records and not isinstance(records[label], Named):
            base = self._label(base)
        if node is None:
            return f"{base}{index}"
        return f"{base}.{'i' if at_neighbour and node == 'j' else node}{index}"

    def _label(self, base: str) -> str:
        if base not in self.labels:
            kind = base.partition("_")[0]
            count = 1 + sum(shown.startswith(kind) for shown in self.labels.values())
            self.labels[base] = f"{kind}{count}"
        return self.labels[base]

    def _bound(self, tape: Tape) -> Tape:
        """Named constants and bound parameters become literals."""
        code = []
        for step in tape.code:
            bound = step
            if step.op == "INPUT" and is_constant_name(step.name):
                bound = Instruction("CONST", value=Fraction(step.name))
            elif step.op == "INPUT" and step.name in self.values:
                bound = Instruction("CONST", value=self.values[step.name])
            code.append(bound)
        return _merged(code, tape.outputs)

    # Names

    def _record(self, label: str, record: Record) -> None:
        if isinstance(record, Undefined):
            raise UndefinedLetter(f"{record.label} is used and never defined")
        base, _, node = label.partition(".")
        shown = base if isinstance(record, Named) else self._label(base)
        key = f"{shown}.*" if node else shown
        for k, scalar in enumerate(component_names(key, record.body.shape)):
            if scalar in self.names:
                return
            self.names[scalar] = self._meaning(record, shown, k)
        before = record.law if isinstance(record, Rate) else None
        if before is not None:
            self._law(before)
        self.add(shown, [record.body], at_neighbour=isinstance(record, Rate) and node == "j")

    def _meaning(self, record: Record, listing: str, k: int) -> Meaning:
        if isinstance(record, Rate):
            return Meaning("rate", (listing, k), record.law)
        if isinstance(record, Sum):
            return Meaning("total" if record.total else "sum", (listing, k))
        return Meaning("value", (listing, k))

    def _scalar(self, name: str) -> None:
        if name in self.names or name in self.scalars:
            return
        base, node, _ = split(name)
        declared = self.study.symbols.get(base if node is None else f"{base}.*")
        if declared is None:
            raise UndefinedLetter(f"{name} is no symbol of the study {self.study.name}")
        self.scalars[name] = declared.kind

    # Motions and laws

    def _reach(self, listing: str) -> None:
        """Add every motion that the evaluation of the listing needs."""
        Reach(self, wanted=self._add_motion).listing(listing)

    def _add_motion(self, name: str) -> None:
        """The motion of a state or signal, if the study gives one."""
        base, node, _ = split(name)
        symbol = base if node is None else f"{base}.i"
        for x, xdot in self.study.motions:
            if x.args[0] == symbol:
                listing = f"motion {base}"
                self.add(listing, [xdot])
                key = symbol.replace(".i", ".*")
                for k, scalar in enumerate(component_names(key, x.shape)):
                    self.motion[scalar] = (listing, k)
                    self.scalars.setdefault(scalar, "state")
                return

    def _law(self, name: str) -> None:
        if name in self.laws:
            return
        law = self.study.laws[name]
        target = law.target
        base = target.args[0].replace(".i", ".*")
        self.laws[name] = {s: (f"law {name}", k) for k, s in enumerate(component_names(base, target.shape))}
        self.add(f"law {name}", [self.bodies[name] if name in self.bodies else law.body()])
        for scalar in self.laws[name]:
            self.scalars.setdefault(scalar, "input")


def _merged(code: Sequence[Instruction], outputs: Sequence[int]) -> Tape:
    """The tape with equal instructions merged again."""
    register: dict[Instruction, int] = {}
    new: list[Instruction] = []
    where: list[int] = []
    for step in code:
        moved = Instruction(step.op, tuple(where[a] for a in step.args), step.name, step.value)
        at = register.setdefault(moved, len(new))
        if at == len(new):
            new.append(moved)
        where.append(at)
    return Tape(tuple(new), tuple(where[r] for r in outputs))
