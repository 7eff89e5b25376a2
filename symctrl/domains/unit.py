"""Units: exponents of the seven SI base units, possibly times powers of units that are not known yet.

An angle is a pure number, so `rad` is 1. Only coherent units are read (no km, no deg): a factor would change
numbers behind the author's back.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction

BASE = ("kg", "m", "s", "A", "K", "mol", "cd")
Exponents = tuple[Fraction, ...]
_NONE: Exponents = (Fraction(0),) * len(BASE)


class UnitError(ValueError):
    """A text that is no unit; the message says which part was not understood."""


@dataclass(frozen=True, slots=True)
class Unit:
    """A product of powers: `si` of the base units in the order of BASE, `unknown` of units by symbol."""

    si: Exponents = _NONE
    unknown: tuple[tuple[str, Fraction], ...] = ()

    def __mul__(self, other: Unit) -> Unit:
        return Unit(tuple(a + b for a, b in zip(self.si, other.si, strict=True)), _merged(self, other))

    def __pow__(self, exponent: Fraction) -> Unit:
        if not exponent:
            return PURE
        return Unit(tuple(a * exponent for a in self.si), tuple((n, e * exponent) for n, e in self.unknown))

    def __truediv__(self, other: Unit) -> Unit:
        return self * other ** Fraction(-1)

    @property
    def text(self) -> str:
        """Like `N m s`, `kg^-1 m^-2`, `1`; a unit that is not known is its symbol in brackets."""
        si = min((_base_text(self.si), *_with_newton(self.si)), key=lambda shown: shown[0])[1]
        return " ".join([*(_power(f"[{n}]", e) for n, e in self.unknown), *si]) or "1"


PURE = Unit()


def unknown(symbol: str) -> Unit:
    """The unit of a symbol of which no unit is given."""
    return Unit(unknown=((symbol, Fraction(1)),))


def _merged(*units: Unit) -> tuple[tuple[str, Fraction], ...]:
    total: dict[str, Fraction] = {}
    for unit in units:
        for name, exponent in unit.unknown:
            total[name] = total.get(name, Fraction(0)) + exponent
    return tuple(sorted((name, e) for name, e in total.items() if e))


def _power(name: str, e: Fraction) -> str:
    if e == 1:
        return name
    return f"{name}^{e}" if e.denominator == 1 else f"{name}^({e})"


def _product(named: Iterable[tuple[str, Fraction]]) -> tuple[Fraction, list[str]]:
    """How long a product is, and its factors as texts."""
    parts = [(name, e) for name, e in named if e]
    return sum((abs(e) for _, e in parts), Fraction(0)), [_power(name, e) for name, e in parts]


def _base_text(si: Exponents) -> tuple[Fraction, list[str]]:
    return _product(zip(BASE, si, strict=True))


def _with_newton(si: Exponents) -> list[tuple[Fraction, list[str]]]:
    """The same with the newton in place of the kilogram, where there are both mass and time."""
    mass, length, time = si[:3]
    if not mass or not time:
        return []
    rest = zip(BASE[1:], (length - mass, time + 2 * mass, *si[3:]), strict=True)
    return [_product([("N", mass), *rest])]


def _si(**exponents: int) -> Unit:
    return Unit(tuple(Fraction(exponents.get(name, 0)) for name in BASE))


NAMED: Mapping[str, Unit] = {
    **{name: _si(**{name: 1}) for name in BASE},
    "rad": PURE,
    "sr": PURE,
    "Hz": _si(s=-1),
    "N": _si(kg=1, m=1, s=-2),
    "Pa": _si(kg=1, m=-1, s=-2),
    "J": _si(kg=1, m=2, s=-2),
    "W": _si(kg=1, m=2, s=-3),
    "C": _si(A=1, s=1),
    "V": _si(kg=1, m=2, s=-3, A=-1),
    "F": _si(kg=-1, m=-2, s=4, A=2),
    "ohm": _si(kg=1, m=2, s=-3, A=-2),
    "S": _si(kg=-1, m=-2, s=3, A=2),
    "Wb": _si(kg=1, m=2, s=-2, A=-1),
    "T": _si(kg=1, s=-2, A=-1),
    "H": _si(kg=1, m=2, s=-2, A=-2),
}
_TOKEN = re.compile(r"\s*(?:(?P<name>[A-Za-z]+)|(?P<number>\d+)|(?P<sign>\*\*|[-+*/^()]))")
_PLAIN = str.maketrans({"·": "*", "⋅": "*", "Ω": "ohm"})
_SUPERSCRIPT = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")


def parse(text: str) -> Unit:
    """The unit written as `N*m*s`, `N m s`, `rad/s`, `kg m^2`, `1/s^2`, `m^(1/2)`.

    A blank or `*` multiplies; `/` divides by the one factor after it. Raises UnitError.
    """
    return _Parser(text).unit()


class _Parser:
    """unit = factor {['*' | '/'] factor}; factor = atom ['^' exponent]; atom = name | '1' | '(' unit ')'."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.tokens: list[str] = []
        plain = re.sub("[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+", lambda m: "^" + m[0].translate(_SUPERSCRIPT), text).translate(_PLAIN)
        end = 0
        while plain[end:].strip():
            match = _TOKEN.match(plain, end)
            if match is None:
                raise self.error(f"'{plain[end:].strip()[0]}' was not expected")
            self.tokens.append("^" if match[0].strip() == "**" else match[0].strip())
            end = match.end()

    def error(self, what: str) -> UnitError:
        return UnitError(f"the unit '{self.text}' cannot be read: {what}; write it like N*m*s or kg m^2/s")

    def peek(self) -> str:
        return self.tokens[0] if self.tokens else ""

    def take(self, wanted: str = "") -> str:
        if not self.tokens:
            raise self.error(f"it ends where {wanted or 'a unit or number'} was expected")
        if wanted and self.tokens[0] != wanted:
            raise self.error(f"'{wanted}' was expected before '{self.tokens[0]}'")
        return self.tokens.pop(0)

    def unit(self) -> Unit:
        result = self.product()
        if self.tokens:
            raise self.error(f"'{self.tokens[0]}' was not expected")
        return result

    def product(self) -> Unit:
        result = self.factor()
        while self.tokens and self.peek() not in (")", "^", "-", "+"):
            sign = self.take() if self.peek() in ("*", "/") else "*"
            factor = self.factor()
            result = result * factor if sign == "*" else result / factor
        return result

    def factor(self) -> Unit:
        base = self.atom()
        if self.peek() != "^":
            return base
        self.take()
        if self.peek() != "(":
            return base ** self.integer()
        self.take()
        exponent = self.integer()
        if self.peek() == "/":
            self.take()
            below = self.integer()
            if not below:
                raise self.error("an exponent divides by zero")
            exponent /= below
        self.take(")")
        return base**exponent

    def atom(self) -> Unit:
        token = self.take()
        if token == "(":
            inner = self.product()
            self.take(")")
            return inner
        if token == "1":
            return PURE
        if token not in NAMED:
            raise self.error(f"'{token}' is not one of the coherent SI units {', '.join(NAMED)}")
        return NAMED[token]

    def integer(self) -> Fraction:
        sign = -1 if self.peek() == "-" else 1
        if self.peek() in ("-", "+"):
            self.take()
        token = self.take()
        if not token.isdigit():
            raise self.error(f"an exponent was expected before '{token}'")
        return Fraction(sign * int(token))
