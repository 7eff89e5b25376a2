"""What a statement can claim: equations, bounds, definiteness, and claims under hypotheses, as values.

Every statement has a `kind`, and prints itself with `latex()` and `text()`. Statements have no truth value:
whether one holds is decided elsewhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from symctrl.bounds import Bound, Statement, bound, claimed
from symctrl.expr import SCALAR, Comparison, Expr, Liftable, lift
from symctrl.latex import latex
from symctrl.nonconforming import misfit, mismatch
from symctrl.text import text


@dataclass(frozen=True, eq=False, repr=False)
class Equal(Statement):
    """left = right, entry by entry; both have the same shape. kind: "equal", "symmetric" or "skew"."""

    left: Expr
    right: Expr
    kind: str = "equal"

    def latex(self) -> str:
        return f"{latex(self.left)} = {latex(self.right)}"

    def text(self) -> str:
        return f"{text(self.left)} = {text(self.right)}"


@dataclass(frozen=True, eq=False, repr=False)
class Definite(Statement):
    """The symmetric matrix is positive definite (strict) or positive semidefinite."""

    matrix: Expr
    strict: bool

    @property
    def kind(self) -> str:
        return "positive_definite" if self.strict else "positive_semidefinite"

    def latex(self) -> str:
        sign = r"\succ" if self.strict else r"\succeq"
        return f"{latex(self.matrix)} {sign} 0"

    def text(self) -> str:
        return f"{text(self.matrix)} is {self.kind.replace('_', ' ')}"


@dataclass(frozen=True, eq=False, repr=False)
class Nonzero(Statement):
    """The scalar is not zero."""

    expr: Expr

    @property
    def kind(self) -> str:
        return "nonzero"

    def latex(self) -> str:
        return rf"{latex(self.expr)} \ne 0"

    def text(self) -> str:
        return f"{text(self.expr)} != 0"


@dataclass(frozen=True, eq=False, repr=False)
class LaplacianBound(Statement):
    """Every eigenvalue of the Laplacian of the fleet's graph is at most the scalar: an assumption."""

    expr: Expr

    @property
    def kind(self) -> str:
        return "laplacian_bound"

    def latex(self) -> str:
        return rf"\lambda_{{\max}}(L) \le {latex(self.expr)}"

    def text(self) -> str:
        return f"no eigenvalue of the Laplacian exceeds {text(self.expr)}"


@dataclass(frozen=True, eq=False, repr=False)
class Conforms(Statement):
    """The expression is well formed: all that a definition or a law claims."""

    expr: Expr

    @property
    def kind(self) -> str:
        return "conforms"

    def latex(self) -> str:
        rows, columns = self.expr.shape
        return rf"{latex(self.expr)} \in \mathbb{{R}}^{{{rows} \times {columns}}}"

    def text(self) -> str:
        return f"{text(self.expr)} is well formed, {self.expr.shape[0]}x{self.expr.shape[1]}"


Small = Bound | Nonzero | Definite  # what can be claimed for small values
Plain = Equal | Bound | Nonzero | Definite  # what can be a hypothesis, a condition or the claim under them
Claimable = Statement | Comparison  # what an author writes for one


@dataclass(frozen=True, eq=False, repr=False)
class Implies(Statement):
    """The claim holds wherever all hypotheses hold.

    by: cofactors offered by the author, one for each equation among the hypotheses: then left - right of the
    claim is the sum of cofactor times (left - right) of the hypothesis.
    """

    hypotheses: tuple[Plain, ...]
    claim: Plain
    by: tuple[Expr, ...] = ()

    @property
    def kind(self) -> str:
        return "implies"

    def latex(self) -> str:
        return rf"{_listed_latex(self.hypotheses)} \implies {self.claim.latex()}"

    def text(self) -> str:
        return f"{_listed_text(self.hypotheses)} implies {self.claim.text()}"


@dataclass(frozen=True, eq=False, repr=False)
class Equivalent(Statement):
    """The claim holds exactly where all conditions hold."""

    conditions: tuple[Plain, ...]
    claim: Plain

    @property
    def kind(self) -> str:
        return "equivalent"

    def latex(self) -> str:
        return rf"{_listed_latex(self.conditions)} \iff {self.claim.latex()}"

    def text(self) -> str:
        return f"{_listed_text(self.conditions)} if and only if {self.claim.text()}"


@dataclass(frozen=True, eq=False, repr=False)
class SufficientlySmall(Statement):
    """There is a bound b > 0 such that the claim holds for every value of the gain in (0, b)."""

    gain: Expr
    claim: Small

    @property
    def kind(self) -> str:
        return "sufficiently_small"

    def latex(self) -> str:
        return rf"{self.claim.latex()} \text{{ for every sufficiently small }} {latex(self.gain)} > 0"

    def text(self) -> str:
        return f"{self.claim.text()} for every sufficiently small {text(self.gain)} > 0"


@dataclass(frozen=True, eq=False, repr=False)
class AtValues(Statement):
    """The claim at the exact values that the study gives its parameters."""

    claim: Statement

    @property
    def kind(self) -> str:
        return self.claim.kind

    def latex(self) -> str:
        return rf"{self.claim.latex()} \text{{ at the values of the study}}"

    def text(self) -> str:
        return f"{self.claim.text()} at the values of the study"


def at_values(claim: Statement | Comparison) -> AtValues:
    """The claim with every parameter that has an exact value replaced by it. Raises TypeError."""
    claim = claimed(claim)
    if not isinstance(claim, Statement):
        raise TypeError(f"at_values takes a claim, not {claim!r}; write at_values(positive_definite(M))")
    return AtValues(claim)


def equal(a: Liftable, b: Liftable) -> Equal:
    """The claim a = b for two expressions of the same shape. Raises Nonconforming."""
    left, right = _lifted(a, "equal"), _lifted(b, "equal")
    if left.shape != right.shape:
        raise mismatch("equal", left, right)
    return Equal(left, right)


def symmetric(M: Liftable) -> Equal:
    """The claim that a square matrix is its own transpose."""
    matrix = _square(M, "symmetric")
    return Equal(matrix, matrix.T, "symmetric")


def skew_symmetric(M: Liftable) -> Equal:
    """The claim that a square matrix is minus its transpose."""
    matrix = _square(M, "skew_symmetric")
    return Equal(matrix, -matrix.T, "skew")


def positive_definite(M: Liftable) -> Definite:
    """The claim that a square matrix is symmetric and x'Mx > 0 for every x other than 0."""
    return Definite(_square(M, "positive_definite"), strict=True)


def positive_semidefinite(M: Liftable) -> Definite:
    """The claim that a square matrix is symmetric and x'Mx >= 0 for every x."""
    return Definite(_square(M, "positive_semidefinite"), strict=False)


def nonnegative(x: Liftable) -> Bound:
    """The claim that every component of x is >= 0; the same as x >= 0."""
    return bound(Comparison(_lifted(x, "nonnegative"), ">=", lift(0)))


def positive(x: Liftable) -> Bound:
    """The claim that every component of x is > 0; the same as x > 0."""
    return bound(Comparison(_lifted(x, "positive"), ">", lift(0)))


def nonzero(x: Liftable) -> Nonzero:
    """The claim that a scalar is not zero. Raises Nonconforming for a vector, for which this has two
    readings.
    """
    value = _lifted(x, "nonzero")
    if value.shape != SCALAR:
        hint = "write nonzero(norm(v)), or one condition for each component"
        raise misfit("nonzero", "a scalar", value, hint)
    return Nonzero(value)


def implies(
    hypotheses: Claimable | Sequence[Claimable], claim: Claimable, by: Sequence[Liftable] = ()
) -> Implies:
    """The claim under one hypothesis or a list of them.

    by: cofactors for the equations among the hypotheses, in their order; a proof is looked for where there
    are none. Raises TypeError for anything but statements, ValueError for a wrong number of cofactors.
    """
    given = _plain_list(hypotheses, "implies", "hypothesis")
    cofactors = tuple(lift(x) for x in by)
    equations = sum(isinstance(h, Equal) for h in given)
    if cofactors and len(cofactors) != equations:
        raise ValueError(
            f"implies: {len(cofactors)} cofactors in by= for {equations} equations among the hypotheses"
        )
    return Implies(given, _plain(claim, "implies", "claim"), cofactors)


def equivalent(conditions: Claimable | Sequence[Claimable], claim: Claimable) -> Equivalent:
    """The claim that the conditions, one or a list, hold together exactly where the claim does.

    Raises TypeError for anything but statements.
    """
    return Equivalent(
        _plain_list(conditions, "equivalent", "condition"), _plain(claim, "equivalent", "claim")
    )


def sufficiently_small(gain: Expr, claim: Claimable) -> SufficientlySmall:
    """The claim, a bound or definiteness, for every small enough positive value of a gain.

    Raises TypeError if gain is no scalar symbol, and for an equation.
    """
    if not isinstance(gain, Expr) or gain.op != "symbol" or gain.shape != SCALAR:
        raise TypeError(f"sufficiently_small: the first argument is a gain, a scalar symbol, not {gain!r}")
    plain = _plain(claim, "sufficiently_small", "claim")
    if isinstance(plain, Equal):
        raise TypeError(
            f"sufficiently_small: {plain.text()} is an equation; claim it for all values, or a bound"
        )
    return SufficientlySmall(gain, plain)


def conforms(expr: Liftable) -> Conforms:
    """The claim that an expression is well formed."""
    return Conforms(_lifted(expr, "conforms"))


def _lifted(x: Liftable | Statement | Comparison, what: str) -> Expr:
    if isinstance(x, Statement | Comparison):
        raise TypeError(f"{what} is about expressions, but was given the claim {claimed(x).text()}")
    return lift(x)


def _square(M: Liftable, what: str) -> Expr:
    matrix = _lifted(M, what)
    if matrix.shape[0] != matrix.shape[1]:
        raise misfit(what, "a square matrix", matrix)
    return matrix


def _plain(x: object, what: str, role: str) -> Plain:
    x = claimed(x)
    if not isinstance(x, Plain):
        given = "a bare expression" if isinstance(x, Expr) else repr(x)
        raise TypeError(
            f"{what}: a {role} is an equation, a bound, nonzero or definiteness, not {given}; "
            "write equal(a, b), a >= b, nonzero(x) or positive_definite(M)"
        )
    return x


def _plain_list(x: object, what: str, role: str) -> tuple[Plain, ...]:
    items = tuple(x) if isinstance(x, (list, tuple)) else (x,)
    if not items:
        raise TypeError(f"{what}: needs at least one {role}")
    return tuple(_plain(item, what, role) for item in items)


def _listed_latex(statements: Sequence[Statement]) -> str:
    return r",\; ".join(s.latex() for s in statements)


def _listed_text(statements: Sequence[Statement]) -> str:
    return " and ".join(s.text() for s in statements)
