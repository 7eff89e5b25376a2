"""Polynomials and constraints as text, read by a grammar: `2/3*x^2*y - 0.1*(x+1)**2`, `1 - x^2 >= 0, x == y`.

Numbers are exact: 0.1 is 1/10 and 1e-3 is 1/1000. Nothing is evaluated as code.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import comb
from typing import Any

from lark import Lark, Token, Tree, UnexpectedInput
from lark.exceptions import UnexpectedCharacters, UnexpectedEOF

from symctrl.files import InputError
from symctrl.sos.ring import Poly, Ring, degree, ring, to_fmpq

MAX_DEGREE = 400
MAX_TERMS = 100_000
MAX_LENGTH = 5_000_000  # characters
MAX_DIGITS = 2000  # of a number written out
MAX_VARIABLES = 2000

_GRAMMAR = r"""
claim: sum [RELATION sum]
constraints: constraint ("," constraint)* [","]
constraint: sum RELATION sum
sum: product (PLUS_MINUS product)*
product: signed (TIMES_OVER signed)*
signed: PLUS_MINUS* power
power: atom [_POWER exponent]
exponent: NUMBER | "(" NUMBER ")"
atom: NUMBER | NAME | "(" sum ")"
RELATION: ">=" | "<=" | "==" | "=" | ">" | "<"
PLUS_MINUS: "+" | "-"
_POWER.2: "**" | "^"
TIMES_OVER: "*" | "/"
NUMBER: /([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]{1,6})?/
NAME: /[^\W\d]\w*(\[[1-9][0-9]*(,[1-9][0-9]*)?\])?/
%ignore /\s+/
"""
_NAME = re.compile(r"[^\W\d]\w*(\[[1-9][0-9]*(,[1-9][0-9]*)?\])?")


@dataclass(frozen=True)
class Relation:
    """`polynomial` is >= 0, > 0 or == 0."""

    polynomial: Poly
    sign: str


@cache
def _parser() -> Lark:
    return Lark(_GRAMMAR, parser="lalr", start=["claim", "constraints"], propagate_positions=True)


def parse_names(text: str, where: str = "--vars") -> tuple[str, ...]:
    """The variables of a list like `x, y, q[1]`. Raises InputError."""
    names = [name.strip() for name in re.split(r",(?![^\[]*\])", text)]
    if names and not names[-1]:
        names.pop()
    if not names:
        raise InputError(f"{where}: no variable is named; it must be like x,y")
    return check_names(names, where)


def check_names(names: Sequence[Any], where: str) -> tuple[str, ...]:
    """The names, if they are those of different variables. Raises InputError."""
    for name in names:
        if not isinstance(name, str) or not _NAME.fullmatch(name) or len(name) > 100:
            raise InputError(f"{where}: {str(name)[:40]!r} is not a name of a variable like x, y2 or q[1]")
        if list(names).count(name) > 1:
            raise InputError(f"{where}: {name} is named twice")
    if not names:
        raise InputError(f"{where}: no variable is named; it must be like x,y")
    if len(names) > MAX_VARIABLES:
        raise InputError(f"{where}: {len(names)} variables; at most {MAX_VARIABLES} can be decided here")
    return tuple(names)


def names_in(text: str, start: str, where: str) -> list[str]:
    """The names in a claim or in constraints (`start`), in the order in which they come."""
    tree = _parse(text, start, where)
    found = (token for token in tree.scan_values(lambda t: isinstance(t, Token) and t.type == "NAME"))
    return list(dict.fromkeys(str(token) for token in sorted(found, key=lambda t: t.start_pos or 0)))


def parse_claim(text: str, names: Sequence[str], where: str = "POLY") -> Relation:
    """A polynomial, of which `>= 0` is meant; or `P >= Q`, `P > Q`, `P <= Q`, `P < Q`. Raises InputError."""
    tree = _parse(text, "claim", where)
    reader = _Reader(ring(names), where)
    left, sign, right = (*tree.children, None, None)[:3]
    if sign is None:
        return Relation(reader.value(left), ">=")
    if sign in ("==", "="):
        raise InputError(
            f"{where}: an equation is not decided here; a claim is P, P >= Q, P > Q, P <= Q or P < Q"
        )
    return reader.relation(left, str(sign), right)


def parse_constraints(text: str, names: Sequence[str], where: str = "--on") -> list[Relation]:
    """Constraints with commas between them; an empty text has none. Raises InputError."""
    if not text.strip():
        return []
    reader = _Reader(ring(names), where)
    found = []
    for part in _parse(text, "constraints", where).children:
        if not isinstance(part, Tree):
            continue
        left, sign, right = part.children
        if sign in (">", "<"):
            raise InputError(
                f"{where}: {_place(text, sign)}: a constraint is >=, <= or ==, instead got {sign}"
            )
        found.append(reader.relation(left, str(sign), right))
    return found


def _parse(text: str, start: str, where: str) -> Any:
    if len(text) > MAX_LENGTH:
        raise InputError(f"{where}: longer than {MAX_LENGTH} characters")
    if not text.strip():
        raise InputError(f"{where}: is empty; it must be a polynomial like x^2 - 2*x*y + 3/2")
    try:
        return _parser().parse(text, start=start)
    except UnexpectedInput as error:
        raise InputError(f"{where}: {_unexpected(text, error, start)}") from None


def _unexpected(text: str, error: UnexpectedInput, start: str) -> str:
    token = getattr(error, "token", None)
    if isinstance(error, UnexpectedEOF) or (token is not None and token.type == "$END"):
        what = "a relation like >= 0 is missing at the end" if start == "constraints" else "it ends too early"
        return f"{what}: ...{text.strip()[-20:]}"
    position = error.pos_in_stream or 0
    got = text[position] if isinstance(error, UnexpectedCharacters) or token is None else str(token)
    hint = ""
    before = text[:position].rstrip()[-1:]
    if token is not None and token.type in ("NAME", "NUMBER") and (before.isalnum() or before in ")]"):
        hint = " (a product is written with *)"
    if got == "(" and (before.isalnum() or before in ")]"):
        hint = " (functions are not polynomials, and a product is written with *)"
    return f"{_place(text, position)}: {got[:20]!r} is not expected here{hint}"


def _place(text: str, at: Any) -> str:
    position = at if isinstance(at, int) else (getattr(at, "start_pos", 0) or 0)
    return f"at character {position + 1} ({text[max(0, position - 10) : position + 10].strip()!r})"


class _Reader:
    """Evaluates parsed text in a ring, from the leaves up and without recursion."""

    def __init__(self, over: Ring, where: str) -> None:
        self.over = over
        self.where = where
        self.gens = dict(zip(over.names(), over.gens(), strict=True))
        self.values: dict[int, Any] = {}

    def relation(self, left: Any, sign: str, right: Any) -> Relation:
        p, q = self.value(left), self.value(right)
        difference = q - p if sign[0] == "<" else p - q
        return Relation(difference, "==" if sign in ("==", "=") else sign.replace("<", ">"))

    def value(self, tree: Any) -> Poly:
        for node in tree.iter_subtrees():
            self.values[id(node)] = getattr(self, f"_{node.data}")(node.children)
        result = self.values[id(tree)]
        return self.over.constant(result) if not hasattr(result, "monoms") else result

    def _of(self, child: Any) -> Poly:
        return self.values[id(child)]

    def _sum(self, children: list[Any]) -> Poly:
        total = self._of(children[0])
        for sign, child in zip(children[1::2], children[2::2], strict=True):
            total = total + self._of(child) if sign == "+" else total - self._of(child)
        return total

    def _product(self, children: list[Any]) -> Poly:
        total = self._of(children[0])
        for sign, child in zip(children[1::2], children[2::2], strict=True):
            other = self._of(child)
            if sign == "/":
                if not other.is_constant():
                    raise InputError(f"{self.where}: a division by {str(other)[:40]}, which is no number")
                if other == 0:
                    raise InputError(f"{self.where}: a division by zero")
                other = 1 / other.leading_coefficient()
            elif self._size(total, other) > MAX_TERMS or degree(total) + degree(other) > MAX_DEGREE:
                self._too_large()
            total = total * other
        return total

    def _size(self, p: Poly, q: Poly) -> int:
        n = len(self.gens)
        return min(len(p) * len(q), comb(n + degree(p) + degree(q), n))

    def _too_large(self) -> None:
        limits = f"{MAX_TERMS} terms or degree {MAX_DEGREE}"
        raise InputError(f"{self.where}: a polynomial with more than {limits} is too large")

    def _signed(self, children: list[Any]) -> Poly:
        value = self._of(children[-1])
        return -value if sum(sign == "-" for sign in children[:-1]) % 2 else value

    def _power(self, children: list[Any]) -> Poly:
        base = self._of(children[0])
        if children[1] is None:
            return base
        exponent = self.values[id(children[1])]
        d, n = degree(base) * exponent, len(self.gens)
        if d > MAX_DEGREE or min(len(base) ** min(exponent, 400), comb(n + d, n)) > MAX_TERMS:
            self._too_large()
        bits = max((int(c.p).bit_length() + int(c.q).bit_length() for c in base.coeffs()), default=0)
        if exponent * (bits - 2) > 4 * MAX_DIGITS:
            raise InputError(f"{self.where}: a power has too many digits")
        return base**exponent

    def _exponent(self, children: list[Any]) -> int:
        value = self._number(children[0])
        if value.denominator != 1 or value > 10_000:
            raise InputError(
                f"{self.where}: an exponent must be a whole number from 0, instead got {children[0]}"
            )
        return int(value)

    def _atom(self, children: list[Any]) -> Poly:
        child = children[0]
        if not isinstance(child, Token):
            return self._of(child)
        if child.type == "NUMBER":
            return self.over.constant(to_fmpq(self._number(child)))
        if child not in self.gens:
            known = ", ".join(list(self.gens)[:8]) + (", .." if len(self.gens) > 8 else "")
            place = f"at character {(child.start_pos or 0) + 1}"
            raise InputError(f"{self.where}: {place}: {child[:40]} is not one of the variables {known}")
        return self.gens[str(child)]

    def _number(self, token: Any) -> Fraction:
        exponent = token.lower().partition("e")[2]
        if len(token) + abs(int(exponent or "0")) > MAX_DIGITS:
            raise InputError(f"{self.where}: the number {token[:20]} has more than {MAX_DIGITS} digits")
        return Fraction(str(token))
