"""From expressions to a problem: every name that a claim reaches, as instruction lists and assumptions.

The problem holds exactly what is needed: the claim's graph, the definitions, motions and laws that it
reaches, and those of the study's assumptions that speak only of symbols that occur.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING

from symctrl.bounds import Bound, Hint, Statement
from symctrl.entries import component_names
from symctrl.expr import Expr, walk
from symctrl.listings import Listings
from symctrl.problem import ADVICE, PROVED, Advice, Assumption, Claim, Meaning, Problem, Use, star
from symctrl.reach import Reach, pruned, with_motion
from symctrl.records import Named, Rate
from symctrl.statements import Definite, Equal, LaplacianBound, Nonzero
from symctrl.structure import lowered
from symctrl.written import StudyError

if TYPE_CHECKING:
    from symctrl.study import Study


@dataclass(frozen=True)
class Used:
    """A proved statement that another uses: its id, its claim, and the digest of its problems."""

    id: str
    claim: Statement
    sha256: str


class Collector(Listings):
    """Gathers one problem."""

    def __init__(
        self,
        study: Study,
        values: Mapping[str, Fraction] | None = None,
        bodies: Mapping[str, Expr] | None = None,
    ) -> None:
        super().__init__(study, values, bodies)
        self.given: list[Assumption] = []

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
                refuse_circles(made, used.claim)
                reach = Reach(made)
                reach.listing("claim")
                listing = f"using {_label(used.claim.left)}"
                refuse_other_loops(used.claim, {law for name, _, law in reach.visits if name == listing})
        return pruned(made)

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

    # Proved statements that are used

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


def refuse_other_loops(used: Equal, laws: Set[str | None]) -> None:
    """An equation for a rate under a law is about the loop that this law closes; without a law it is about
    every loop. Raises StudyError where a rate is taken under another law.
    """
    record = used.left.args[0] if used.left.op == "deferred" else None
    if not isinstance(record, Rate) or record.law is None:
        return
    for other in sorted(str(law) for law in laws - {record.law}):
        taken = "without a law" if other == "None" else f"under the law {other}"
        raise StudyError(
            f"using: {used.text()} is a rate under the law {record.law}, and here a rate is taken {taken}"
        )


def refuse_circles(made: Problem, used: Equal) -> None:
    """Raises StudyError where the right side of an equation reads what it takes the place of."""
    listing = f"using {used.left.args[0] if used.left.op == 'symbol' else _label(used.left)}"
    seen: set[str] = set()
    waiting = [listing] if listing in made.listings else []
    while waiting:
        for scalar in made.listings[waiting.pop()].inputs:
            meaning = made.names.get(star(scalar))
            if meaning is not None and meaning.of is not None and meaning.of[0] not in seen:
                seen.add(meaning.of[0])
                waiting.append(meaning.of[0])
    if listing in seen:
        raise StudyError(
            f"using: {used.text()} cannot be put in the place of its left side, for its right side reads that"
        )


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
