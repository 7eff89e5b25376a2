"""Expressions that are written down and not evaluated: values of the kernel's walk that are terms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from symctrl.kernel.certificate import Declined
from symctrl.kernel.chain import Domain

_EXACT = {"FABS": "abs", "SIGN": "sign"}
_REAL = {op: f"math.{op.lower()}" for op in ("SIN", "COS", "TAN", "EXP", "LOG", "TANH", "SQRT")}
_SUM, _PRODUCT, _POWER, _ATOM = range(4)  # how tightly what is written binds


@dataclass(frozen=True, eq=False)
class Term:
    """op: a symbol's name, a number's text, or + - * / neg ^ and functions with arguments."""

    op: str
    args: tuple[Term, ...] = ()
    number: Fraction | None = None


class Terms(Domain[Term]):
    """The same term is one object. `exact`: only what fractions can evaluate has been met."""

    def __init__(self) -> None:
        self.exact = True
        self.functions: set[str] = set()
        self._known: dict[tuple[object, ...], Term] = {}

    def symbol(self, name: str) -> Term:
        return self._term(name)

    def constant(self, value: Fraction) -> Term:
        return self._term(str(value), (), value)

    def add(self, a: Term, b: Term) -> Term:
        if a.number == 0 or b.number == 0:
            return b if a.number == 0 else a
        if b.op == "neg":
            return self._term("-", (a, b.args[0]))
        if _is_integer(a) and _is_integer(b):
            return self.constant((a.number or 0) + (b.number or Fraction(0)))
        return self._term("+", (a, b))

    def sub(self, a: Term, b: Term) -> Term:
        return self.add(a, self.neg(b))

    def neg(self, a: Term) -> Term:
        if a.number is not None and (_is_integer(a) or a.number < 0):
            return self.constant(-a.number)
        return a.args[0] if a.op == "neg" else self._term("neg", (a,))

    def mul(self, a: Term, b: Term) -> Term:
        if a.number == 0 or b.number == 0:
            return self.constant(Fraction(0))
        for one, other in ((a, b), (b, a)):
            if one.number in (1, -1):
                return other if one.number == 1 else self.neg(other)
        if _is_integer(a) and _is_integer(b):
            return self.constant((a.number or Fraction(0)) * (b.number or 0))
        if a.op == "neg" or b.op == "neg":
            inner = self.mul(*(x.args[0] if x.op == "neg" else x for x in (a, b)))
            return inner if a.op == b.op else self.neg(inner)
        if b.op == "/" and b.args[0].number == 1:
            return self._term("/", (a, b.args[1]))
        return self._term("*", (a, b))

    def inv(self, a: Term) -> Term:
        if a.number:
            return self.constant(1 / a.number)
        return self._term("/", (self.constant(Fraction(1)), a))

    def square(self, a: Term) -> Term:
        return self.power(a, 2)

    def power(self, a: Term, n: int) -> Term:
        if n == 1:
            return a
        return self.constant(a.number**n) if a.number is not None else self._term(f"**{n}", (a,))

    def function(self, op: str, args: Sequence[Term]) -> Term:
        if op not in _EXACT and op not in _REAL:
            raise Declined(f"{op} is not written down")
        self.exact &= op in _EXACT
        name = _EXACT.get(op) or _REAL[op]
        self.functions.add(name)
        return self._term(name, tuple(args))

    def nonzero(self, a: Term) -> None:
        pass

    def rational(self, a: Term) -> Fraction | None:
        return a.number

    def _term(self, op: str, args: tuple[Term, ...] = (), number: Fraction | None = None) -> Term:
        key = (op, *map(id, args))
        return self._known.setdefault(key, Term(op, args, number))


def _is_integer(a: Term) -> bool:
    return a.number is not None and a.number.denominator == 1


def written(results: Sequence[Term], names: Sequence[str]) -> list[str]:
    """Assignments in Python, in order: what is used more than once has a name; then the results."""
    uses: dict[Term, int] = {}
    order: list[Term] = []

    def visit(term: Term) -> None:
        uses[term] = uses.get(term, 0) + 1
        if uses[term] == 1:
            for arg in term.args:
                visit(arg)
            order.append(term)

    for result in results:
        visit(result)
    own: dict[Term, str] = {}
    lines = []
    for term in order:
        if uses[term] > 1 and term.args and term not in results:
            text = _text(term, own, _SUM)
            own[term] = f"t{len(own) + 1}"
            lines.append(f"{own[term]} = {text}")
    return lines + [f"{name} = {_text(r, own, _SUM)}" for r, name in zip(results, names, strict=True)]


def _text(term: Term, own: dict[Term, str], level: int) -> str:
    if term in own:
        return own[term]
    if term.number is not None:
        text = str(term.number)
        if term.number.denominator != 1:
            return f"F({term.number.numerator}, {term.number.denominator})"
        return f"({text})" if term.number < 0 and level > _SUM else text
    if not term.args:
        return term.op
    made, binds = _operation(term, own)
    return f"({made})" if binds < level else made


def _operation(term: Term, own: dict[Term, str]) -> tuple[str, int]:
    a = term.args[0]
    if term.op == "neg":
        return f"-{_text(a, own, _PRODUCT)}", _SUM
    if term.op.startswith("**"):
        return f"{_text(a, own, _ATOM)}{term.op}", _POWER
    if len(term.args) == 1:
        return f"{term.op}({_text(a, own, _SUM)})", _ATOM
    b = term.args[1]
    if term.op == "+":
        return f"{_text(a, own, _SUM)} + {_text(b, own, _SUM)}", _SUM
    if term.op == "-":
        return f"{_text(a, own, _SUM)} - {_text(b, own, _PRODUCT)}", _SUM
    right = _text(b, own, _POWER)
    return f"{_text(a, own, _PRODUCT)}{term.op}{right}", _PRODUCT
