"""Scalar expressions in plain mathematics, bounded in length: for messages about a part of a tape."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import partial

from symctrl.domains.domain import Domain

LIMIT = 60
RELATION, SUM, PRODUCT, POWER, ATOM = range(5)
_RELATIONS = {"LT": "<", "LE": "<=", "EQ": "==", "NE": "!=", "AND": "and", "OR": "or"}
_WRITTEN = frozenset(("ADD", "SUB", "MUL", "DIV", "NEG", "INV", "SQ", "TWICE", "POW", "CONSTPOW"))
_NAMES = {"FABS": "abs", "SIGN": "sgn", "FMIN": "min", "FMAX": "max", "IF_ELSE_ZERO": "if"}


@dataclass(frozen=True, slots=True)
class Text:
    """A text and how tightly its outermost operation binds."""

    text: str
    level: int = ATOM

    def at(self, level: int) -> str:
        """The text, in parentheses if it binds less tightly than `level`."""
        return self.text if self.level >= level else f"({self.text})"


ELIDED = Text("...")


class TextDomain(Domain[Text]):
    """Values are texts of at most `limit` characters (names may be longer); what is too long is elided.

    Of two arguments the longer one becomes `...`, so that parentheses stay balanced.
    """

    name = "text"

    def __init__(self, limit: int = LIMIT) -> None:
        self.limit = limit

    def operation(self, op: str) -> Callable[..., Text]:
        if op in _WRITTEN:
            return partial(self._bounded, super().operation(op))
        if op in _RELATIONS:
            sign = _RELATIONS[op]
            return partial(self._bounded, lambda a, b: Text(f"{a.at(SUM)} {sign} {b.at(SUM)}", RELATION))
        name = _NAMES.get(op, op.lower())
        return partial(self._bounded, lambda *args: Text(f"{name}({', '.join(a.text for a in args)})"))

    def _bounded(self, write: Callable[..., Text], *args: Text) -> Text:
        result = write(*args)
        while len(result.text) > self.limit and any(a is not ELIDED for a in args):
            longest = max(range(len(args)), key=lambda k: len(args[k].text) if args[k] is not ELIDED else 0)
            args = tuple(ELIDED if k == longest else a for k, a in enumerate(args))
            result = write(*args)
        return result

    def constant(self, value: Fraction) -> Text:
        return Text(str(value), ATOM if value >= 0 and value.denominator == 1 else PRODUCT)

    def add_(self, a: Text, b: Text) -> Text:
        if b.text.startswith("-") and b.level >= PRODUCT:
            return Text(f"{a.at(SUM)} - {b.text[1:]}", SUM)
        return Text(f"{a.at(SUM)} + {b.at(SUM)}", SUM)

    def sub_(self, a: Text, b: Text) -> Text:
        return Text(f"{a.at(SUM)} - {b.at(PRODUCT)}", SUM)

    def mul_(self, a: Text, b: Text) -> Text:
        return Text(f"{a.at(PRODUCT)}*{b.at(POWER)}", PRODUCT)

    def div_(self, a: Text, b: Text) -> Text:
        return Text(f"{a.at(PRODUCT)}/{b.at(POWER)}", PRODUCT)

    def neg_(self, a: Text) -> Text:
        return Text(f"-{a.at(POWER) if a.text.startswith('-') else a.at(PRODUCT)}", PRODUCT)

    def inv_(self, a: Text) -> Text:
        return Text(f"1/{a.at(POWER)}", PRODUCT)

    def sq_(self, a: Text) -> Text:
        return Text(f"{a.at(ATOM)}^2", POWER)

    def twice_(self, a: Text) -> Text:
        return Text(f"2*{a.at(POWER)}", PRODUCT)

    def pow_(self, a: Text, b: Text) -> Text:
        return Text(f"{a.at(ATOM)}^{b.at(ATOM)}", POWER)
