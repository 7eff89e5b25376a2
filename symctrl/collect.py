"""From expressions to a problem: every name that a claim reaches, as instruction lists and assumptions.

The problem holds exactly what is needed: the claim's graph, the definitions, motions and laws that it
reaches, and those of the study's assumptions that speak only of symbols that occur.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING

import casadi as ca

from symctrl.bounds import Bound, Hint, Statement
from symctrl.entries import component_names
from symctrl.expr import Expr, walk
from symctrl.graph import Instruction, Tape, read, unfolded
from symctrl.literals import as_sx, is_constant_name
from symctrl.problem import (
    ADVICE,
    PROVED,
    Advice,
    Assumption,
    Claim,
    Meaning,
    Output,
    Problem,
    Use,
    split,
    star,
)
from symctrl.reach import Reach, pruned, with_motion
from symctrl.records import Named, Rate, Record, Sum, Undefined
from symctrl.statements import Definite, Equal, LaplacianBound, Nonzero
from symctrl.structure import lowered
from symctrl.written import StudyError

if TYPE_CHECKING:
    from symctrl.study import Study


class UndefinedLetter(ValueError):  # noqa: N818
    """The claim uses a letter that the paper never defines."""


@dataclass(frozen=True)
class Used:
    """A proved statement that another uses: its id, its claim, and the digest of its problems."""

    id: str
    claim: Statement
    sha256: str


class Collector:
    """Gathers one problem. values: exact values of parameters that are bound, by scalar name. bodies: other
    formulas for laws, by their names.
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
        self.given: list[Assumption] = []
        self.labels: dict[str, str] = {}

    def problem(
        self,
        claim: Statement,
        id_: str,
        hypotheses: Sequence[Statement] = (),
        small: str | None = None,
        using: Sequence[Used] = (),
        expanded: bool = False,
    ) -> Problem:
        """The problem of an equation, a bound, definiteness or conformity, under hypotheses.

        small: the gain for all of whose small positive values the claim is made. using: proved statements: a
        bound is assumed, the right side of an equation takes the place of the name or rate on its left.
        """
        exprs, kind, shape = _sides(claim)
        matrix = None
        if isinstance(claim, Definite):
            matrix, exprs = lowered(claim.matrix, expanded)
        self.add("claim", exprs)
        self._reach("claim")
        for hypothesis in hypotheses:
            self.assume(hypothesis, "parameter")
        uses = []
        for used in using:
            if isinstance(used.claim, Equal):
                uses.append(Use(used.id, used.sha256, f"using {_label(used.claim.left)}"))
            else:
                uses.append(Use(used.id, used.sha256, f"given {len(self.given) + 1}"))
                self.assume(used.claim, PROVED)
        self._assume_what_occurs()
        advice = self._advice(claim.hint) if isinstance(claim, Bound) and claim.hint else None
        made = Problem(
            self.study.name,
            id_,
            claim.text(),
            self.listings,
            Claim(kind, "claim", shape, matrix, small),
            self.scalars,
            self.names,
            self.motion,
            self.laws,
            tuple(self.given),
            advice,
            tuple(uses),
        )
        for used in using:
            if isinstance(used.claim, Equal):
                made = self._replaced(made, used.claim)
        return pruned(made)

    def _replaced(self, made: Problem, used: Equal) -> Problem:
        """The problem with the right side of a proved equation in the place of the name, or of the rate, on
        its left.
        """
        if used.left.op == "symbol":
            return self._defined(made, used)
        record = used.left.args[0] if used.left.op == "deferred" else None
        if not isinstance(record, Named | Rate):
            raise StudyError(f"using: {used.text()} has no definition and no rate of one on its left")
        listing = f"using {record.label}"
        made = self._grown(made, listing, used.right)
        if isinstance(record, Named):
            shown = self._scalars_of(record, used.left)
            names = dict(made.names) | {
                n: replace(made.names[n], of=(listing, k)) for k, n in enumerate(shown) if n in made.names
            }
            return replace(made, names=names)
        if record.body.op == "symbol":
            shown = self._scalars_of_symbol(record.body)
            new = {name: (listing, k) for k, name in enumerate(shown) if name in made.motion}
            return replace(made, motion={**made.motion, **new})
        inner = record.body.args[0] if record.body.op == "deferred" else None
        if not isinstance(inner, Named | Rate):
            raise StudyError(f"using: {used.text()} is the rate of an expression without a name")
        shown = self._scalars_of(inner, record.body)
        reach = Reach(made)
        reach.listing("claim")
        if any(name in shown and law != record.law for name, law in reach.rated):
            raise StudyError(
                f"using: {used.text()} is a rate under the law {record.law}, and the claim takes another"
            )
        return with_motion(made, inner.label, shown, listing) if shown[0] in made.names else made

    def _defined(self, made: Problem, used: Equal) -> Problem:
        """The problem in which a symbol is a name for the right side of a proved equation."""
        shown = self._scalars_of_symbol(used.left)
        listing = f"using {used.left.args[0]}"
        made = self._grown(made, listing, used.right)
        names = {name: Meaning("value", (listing, k)) for k, name in enumerate(shown)}
        return replace(
            made,
            names=dict(made.names) | names,
            scalars={n: k for n, k in made.scalars.items() if n not in shown},
            motion={n: of for n, of in made.motion.items() if n not in shown},
        )

    def _grown(self, made: Problem, listing: str, expr: Expr) -> Problem:
        """The problem with one more listing and what it brings; what stands for names stays."""
        tables = ("listings", "scalars", "names", "motion", "laws")
        before = {table: set(getattr(self, table)) for table in tables}
        self.add(listing, [expr])
        self._reach(listing)
        grown = {
            table: dict(getattr(made, table))
            | {n: x for n, x in getattr(self, table).items() if n not in before[table]}
            for table in tables
        }
        return replace(
            made,
            listings=grown["listings"],
            scalars=grown["scalars"],
            names=grown["names"],
            motion=grown["motion"],
            laws=grown["laws"],
        )

    def _scalars_of(self, record: Named | Rate, expr: Expr) -> list[str]:
        """The starred scalars of a definition or rate."""
        base, _, node = record.label.partition(".")
        shown = base if isinstance(record, Named) else self._label(base)
        return list(component_names(f"{shown}.*" if node else shown, expr.shape))

    @staticmethod
    def _scalars_of_symbol(x: Expr) -> list[str]:
        return list(component_names(x.args[0].replace(".i", ".*"), x.shape, x.args[2]))

    def _reach(self, listing: str) -> None:
        """Add every motion that the evaluation of the listing needs."""
        Reach(self, wanted=self._add_motion).listing(listing)

    def _advice(self, hint: Hint) -> Advice:
        """The hint as a listing beside the statement. Raises StudyError where it says more than the claim."""
        exprs = [hint.times] if hint.times is not None else []
        exprs += [*hint.squares, *(part for form in hint.forms for part in form)]
        before = set(self.listings) | set(self.scalars) | set(self.names)
        self.add(ADVICE, exprs)
        new = (set(self.listings) | set(self.scalars) | set(self.names)) - before - {ADVICE}
        if new:
            raise StudyError(
                f"a hint of a proof speaks of {', '.join(sorted(new))}, which the claim does not"
            )
        sizes = tuple(x.shape[0] for _, x in hint.forms)
        return Advice(self.listings.pop(ADVICE), hint.times is not None, len(hint.squares), sizes)

    # Listings

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

    # Assumptions

    def assume(self, claim: Statement, about: str) -> None:
        """Enter an assumption: an equation or a bound gives one for each entry."""
        listing = f"given {len(self.given) + 1}"
        written = claim.text()
        if isinstance(claim, Equal):
            difference = claim.left - claim.right
            self.add(listing, [difference])
            self._each("zero", listing, difference, written, about)
        elif isinstance(claim, Bound):
            self.add(listing, [claim.expr])
            self._each("positive" if claim.strict else "nonnegative", listing, claim.expr, written, about)
        elif isinstance(claim, Nonzero | LaplacianBound):
            self.add(listing, [claim.expr])
            self._each(claim.kind, listing, claim.expr, written, about)
        elif isinstance(claim, Definite):
            self.add(listing, [claim.matrix])
            n = claim.matrix.shape[0]
            of = tuple((listing, k) for k in range(n * n))
            self.given.append(Assumption(claim.kind, of, written, about, n))
        else:
            raise StudyError(
                f"{written} cannot be assumed: an assumption is an equation, a bound, definiteness or nonzero"
            )

    def _each(self, kind: str, listing: str, expr: Expr, written: str, about: str) -> None:
        for k in range(expr.shape[0] * expr.shape[1]):
            self.given.append(Assumption(kind, ((listing, k),), written, about))

    def _assume_what_occurs(self) -> None:
        """The study's assumptions about symbols that occur; an assumption may bring a bound's own symbol with
        it.
        """
        waiting = [a for a in self.study.assumed if a.about != "trajectory" or self.study.on_trajectory]
        while True:
            ready = [a for a in waiting if self._occurs(a.claim)]
            if not ready:
                return
            for assumed in ready:
                waiting.remove(assumed)
                self.assume(assumed.claim, assumed.about)

    def _occurs(self, claim: Statement) -> bool:
        """Does a state or signal of the assumption occur in the problem, or any symbol of one about
        parameters?
        """
        known = {star(n) for n in self.scalars}
        occurring, kinds = set(), set()
        for expr in _sides(claim)[0]:
            for node in walk(expr):
                if node.op == "symbol":
                    name = node.args[0].replace(".i", ".*")
                    kind = self.study.symbols[name].kind
                    kinds.add(kind)
                    if known & set(component_names(name, node.shape, node.args[2])):
                        occurring.add(kind)
        return bool(occurring - {"parameter"}) or (kinds == {"parameter"} and bool(occurring))


def _label(left: Expr) -> str:
    """The label of a definition or rate; empty for another expression."""
    return str(left.args[0].label) if left.op == "deferred" else ""


def _sides(claim: Statement) -> tuple[list[Expr], str, tuple[int, int]]:
    """The expressions of a claim in the order of its listing's outputs, its kind, and the shape of its
    entries.
    """
    if isinstance(claim, Equal):
        return [claim.left, claim.right], "equal", claim.left.shape
    if isinstance(claim, Bound):
        return [claim.expr], claim.kind, claim.expr.shape
    if isinstance(claim, Definite):
        return [claim.matrix], claim.kind, claim.matrix.shape
    if isinstance(claim, Nonzero):
        return [claim.expr**2], "positive", claim.expr.shape  # x != 0 is x^2 > 0, for which there are proofs
    expr: Expr = claim.expr  # type: ignore[attr-defined]
    return [expr], claim.kind, expr.shape


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
