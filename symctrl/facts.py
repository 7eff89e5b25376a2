"""The words of a theorem: what is said of every solution, or assumed of it.

A fact speaks of every solution of the closed loop on its maximal interval [0, T). Those that are about large
times (tends, enters, settles, eventually) say that T is infinite too.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from symctrl.bounds import Bound, Statement, claimed
from symctrl.expr import SCALAR, Comparison, Expr, Liftable, lift
from symctrl.latex import latex
from symctrl.statements import Equal
from symctrl.text import text
from symctrl.vectors import stack

WORDS = {
    "exists": "every solution exists for all time",
    "tends": "{} tends to zero",
    "exponentially": "{} decays exponentially",
    "stays": "{} is never left",
    "enters": "{} is reached",
    "settles": "{} is reached and kept",
    "eventually": "{} holds for all large times",
    "bounded": "{} stays bounded",
    "apart": "{} stays apart from zero",
    "summable": "the integral of |{}| is finite",
    "stable": "{} is stable",
}
SETS = frozenset(("stays", "enters", "settles", "eventually"))


@dataclass(frozen=True, eq=False, repr=False)
class Fact(Statement):
    """One sentence about every solution.

    word: a key of WORDS. of: what it is about, a column; for a set, expressions that are zero (`zero`) or not
    negative on it. by: the time by which, a bound, or a rate. at: the point, by symbol.
    """

    word: str
    of: Expr | None = None
    zero: bool = False
    by: Expr | None = None
    at: Mapping[str, tuple[Fraction, ...]] = field(default_factory=dict)
    written: str = ""

    @property
    def kind(self) -> str:
        return self.word

    def latex(self) -> str:
        if self.word == "tends" and self.of is not None:
            return rf"{latex(self.of)} \to 0"
        before, _, after = WORDS[self.word].partition("{}")
        inner = latex(self.of) if self.of is not None and not self.written else rf"\text{{{self._about()}}}"
        return rf"\text{{{before}}} {inner} \text{{{after}}}"

    def text(self) -> str:
        said = WORDS[self.word].format(self._about())
        return f"{said} by {text(self.by)}" if self.by is not None and self.word in SETS else said

    def _about(self) -> str:
        if self.written:
            return self.written
        if self.at:
            return ", ".join(f"{n} = {_numbers(v)}" for n, v in self.at.items())
        return text(self.of) if self.of is not None else ""


def exists() -> Fact:
    """Every solution exists for all time. A conclusion of every theorem, whether it is written or not."""
    return Fact("exists")


def tends(*of: Liftable) -> Fact:
    """Every component tends to zero as t grows."""
    return Fact("tends", _column(of, "tends"))


def exponentially(of: Liftable, rate: Liftable | None = None) -> Fact:
    """|e(t)| <= C exp(-rate t), with some C that depends on the initial state. Without rate: for some one."""
    return Fact("exponentially", _column((of,), "exponentially"), by=None if rate is None else lift(rate))


def bounded(*of: Liftable, by: Liftable | None = None) -> Fact:
    """Every component stays bounded; `by`: by this function of parameters and the initial state."""
    return Fact("bounded", _column(of, "bounded"), by=None if by is None else lift(by))


def apart(*of: Liftable) -> Fact:
    """The absolute value of every component has a positive infimum."""
    return Fact("apart", _column(of, "apart"))


def summable(*of: Liftable) -> Fact:
    """The integral of the absolute value of every component over all time is finite."""
    return Fact("summable", _column(of, "summable"))


def stays(claim: Comparison | Statement | Sequence[Any]) -> Fact:
    """A solution that begins in the set never leaves it."""
    return _about_set("stays", claim, None)


def enters(claim: Comparison | Statement | Sequence[Any], by: Liftable | None = None) -> Fact:
    """Every solution is in the set at some time; `by`: not later than this, or at the beginning where this is
    negative.
    """
    return _about_set("enters", claim, by)


def settles(claim: Comparison | Statement | Sequence[Any], by: Liftable | None = None) -> Fact:
    """Every solution is in the set from some time on; `by`: from a time not later than this."""
    return _about_set("settles", claim, by)


def eventually(claim: Comparison | Statement | Sequence[Any]) -> Fact:
    """Every solution is in the set for all large times."""
    return _about_set("eventually", claim, None)


def stable(**at: Any) -> Fact:
    """The point is stable in the sense of Lyapunov: stable(x=0, v=0). States that are not named are not part
    of it.
    """
    return Fact("stable", at=point(at, "stable"))


def point(at: Mapping[str, Any], what: str) -> dict[str, tuple[Fraction, ...]]:
    """Exact numbers by symbol. Raises TypeError for what is no number."""
    found = {}
    for name, value in at.items():
        entries = lift(value).entries
        if not all(isinstance(entry, Fraction) for entry in entries):
            raise TypeError(f"{what}: {name} = {value!r} is not exact numbers; write {name}='1/2' or a list")
        found[name] = tuple(entry for entry in entries if isinstance(entry, Fraction))
    if not found:
        raise TypeError(f"{what} names a point, like {what}(x=0, v=0)")
    return found


def _about_set(word: str, claim: Any, by: Liftable | None) -> Fact:
    claims = claimed(claim if isinstance(claim, list | tuple) else [claim])
    time = None if by is None else lift(by)
    written = " and ".join(c.text() if isinstance(c, Statement) else repr(c) for c in claims)
    if all(isinstance(c, Equal) for c in claims):
        difference = stack(*[c.left - c.right for c in claims])
        return Fact(word, difference, True, time, written=written)
    if all(isinstance(c, Bound) and not c.strict for c in claims):
        return Fact(word, stack(*[c.expr for c in claims]), False, time, written=written)
    raise TypeError(f"{word} is about a set: x <= r, equal(x, 0), or a list of one kind; not {written}")


def _column(parts: Sequence[Liftable | Statement], word: str) -> Expr:
    if not parts:
        raise TypeError(f"{word} is about at least one expression")
    for part in parts:
        if isinstance(part, Statement | Comparison):
            raise TypeError(f"{word} is about expressions, but was given the claim {claimed(part).text()}")
    exprs = [lift(part) for part in parts]  # type: ignore[arg-type]
    for expr in exprs:
        if expr.shape[1] != 1:
            raise TypeError(f"{word} is about scalars and columns, not {text(expr)}")
    return exprs[0] if len(exprs) == 1 and exprs[0].shape == SCALAR else stack(*exprs)


def _numbers(values: tuple[Fraction, ...]) -> str:
    return str(values[0]) if len(values) == 1 else f"({', '.join(map(str, values))})"
