"""Bounds as claims: every component is nonnegative, or positive; and what all statements are."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NoReturn

from symctrl.expr import SCALAR, Comparison, Expr, Liftable, Relation, lift
from symctrl.latex import latex
from symctrl.nonconforming import mismatch
from symctrl.text import text

_LATEX_SIGN: dict[str, str] = {">=": r"\ge", "<=": r"\le", ">": ">", "<": "<"}


class Statement(ABC):
    """Base of all statements."""

    @property
    @abstractmethod
    def kind(self) -> str: ...

    @abstractmethod
    def latex(self) -> str: ...

    @abstractmethod
    def text(self) -> str: ...

    def __bool__(self) -> NoReturn:
        raise TypeError(
            f"the claim {self.text()} has no truth value; write two conditions instead of a chain "
            "a <= x <= b, and a list of conditions instead of 'and'"
        )

    def __repr__(self) -> str:
        return f"<{self.kind}: {self.text()}>"

    def _repr_latex_(self) -> str:
        from symctrl import notebook

        return notebook.formula(self.latex())


@dataclass(frozen=True, eq=False)
class Hint:
    """What an author knows of a proof of a bound: times * expr is a combination in which these squares and
    forms occur.

    times: known to be positive. squares: scalars whose squares occur. forms: (P, x) for terms xᵀPx with P
    assumed definite.
    """

    times: Expr | None = None
    squares: tuple[Expr, ...] = ()
    forms: tuple[tuple[Expr, Expr], ...] = ()


@dataclass(frozen=True, eq=False, repr=False)
class Bound(Statement):
    """Every component of expr is >= 0, or > 0 if strict; printed as it was written, `left relation right`."""

    expr: Expr
    strict: bool
    left: Expr
    relation: Relation
    right: Expr
    hint: Hint | None = None

    def by(
        self,
        times: Liftable | None = None,
        squares: Sequence[Liftable] = (),
        forms: Sequence[tuple[Liftable, Liftable]] = (),
    ) -> Bound:
        """The same claim with a hint for its proof; a hint proposes and proves nothing.

        Raises Nonconforming for a form (P, x) whose shapes do not go together.
        """
        pairs = tuple((lift(matrix), lift(x)) for matrix, x in forms)
        for matrix, x in pairs:
            if matrix.shape != (x.shape[0], x.shape[0]) or x.shape[1] != 1:
                raise mismatch("form (P, x)", matrix, x)
        flat = tuple(entry for square in squares for entry in _components(lift(square)))
        return replace(self, hint=Hint(None if times is None else lift(times), flat, pairs))

    @property
    def kind(self) -> str:
        return "positive" if self.strict else "nonnegative"

    def latex(self) -> str:
        return f"{latex(self.left)} {_LATEX_SIGN[self.relation]} {latex(self.right)}"

    def text(self) -> str:
        return f"{text(self.left)} {self.relation} {text(self.right)}"


def bound(comparison: Comparison) -> Bound:
    """The claim of a comparison as it was written."""
    left, relation, right = comparison.left, comparison.relation, comparison.right
    larger, smaller = (left, right) if relation.startswith(">") else (right, left)
    if _is_zero(smaller):
        difference = larger
    elif _is_zero(larger):
        difference = -smaller
    else:
        difference = larger - smaller
    return Bound(difference, not relation.endswith("="), left, relation, right)


def claimed(x: Any) -> Any:
    """What an author wrote as a claim, with comparisons as bounds; also in a list of claims."""
    if isinstance(x, Comparison):
        return bound(x)
    return [claimed(one) for one in x] if isinstance(x, list | tuple) else x


def _components(x: Expr) -> list[Expr]:
    return [x] if x.shape == SCALAR else list(x)


def _is_zero(x: Expr) -> bool:
    return x.op == "literal" and x.args[0] == 0
