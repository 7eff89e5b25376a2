"""Units of every expression of a tape, judged beside the verdict and never instead of it.

A symbol without a unit has an unknown one, which the equations force: each sum, comparison or equation is a
linear equation between exponents. The first mismatch is recorded in words and the evaluation goes on.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from symctrl.domains.domain import Domain
from symctrl.domains.fraction import FractionDomain, NoExactValue
from symctrl.domains.text import Text, TextDomain
from symctrl.domains.unit import PURE, Unit, parse, unknown
from symctrl.graph import ARITY, Tape, prebound


@dataclass(frozen=True, slots=True)
class UnitsResult:
    """consistent: no mismatch; mismatch: the first one in words; inferred: units that were found, as text."""

    consistent: bool
    mismatch: str | None
    inferred: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Measured:
    """What is known of a scalar: its unit (None, of a literal 0, fits every unit), text and literal value."""

    unit: Unit | None
    text: Text
    literal: Fraction | None = None


def judge(
    tape: Tape, units: Mapping[str, str | None], equal_pairs: Sequence[tuple[int, int]] = ()
) -> UnitsResult:
    """Whether the units of a tape are consistent, and which units its symbols must have.

    units: by scalar name, like "N*m*s"; a missing name or None is a unit to be found. A name that is a number
    (`1/3`) is a constant. equal_pairs: positions in `tape.outputs` that must have the same unit.
    Raises UnitError for a text that is no unit.
    """
    domain = UnitsDomain()
    outputs = prebound(tape, domain)([domain.symbol(name, units.get(name)) for name in tape.inputs])
    for left, right in equal_pairs:
        domain.same("equation", outputs[left], outputs[right])
    found = {name: domain.solved[name].text for name in tape.inputs if name in domain.found}
    return UnitsResult(domain.mismatch is None, domain.mismatch, found)


_WORDS = {
    "ADD": "sum",
    "SUB": "difference",
    "FMIN": "minimum",
    "FMAX": "maximum",
    "FMOD": "remainder",
    "REMAINDER": "remainder",
    "HYPOT": "norm",
    "ATAN2": "angle",
    **dict.fromkeys(("LT", "LE", "EQ", "NE"), "comparison"),
}
_PURE_RESULT = frozenset(("LT", "LE", "EQ", "NE", "ATAN2"))
_KEEPS = frozenset(("NEG", "TWICE", "FABS"))
_SCALES = {"SQ": Fraction(2), "SQRT": Fraction(1, 2), "INV": Fraction(-1)}


class UnitsDomain(Domain[Measured]):
    """Values are `Measured`. Never raises: the first mismatch is in `mismatch`."""

    name = "units"

    def __init__(self) -> None:
        self.solved: dict[str, Unit] = {}
        self.mismatch: str | None = None
        self._texts = TextDomain()
        self._numbers = FractionDomain()

    @property
    def found(self) -> frozenset[str]:
        """The symbols whose unit is known completely."""
        return frozenset(name for name, unit in self.solved.items() if not unit.unknown)

    def symbol(self, name: str, unit: str | None) -> Measured:
        """A symbol with its unit as text, or with an unknown one. Raises UnitError."""
        if name[:1].isdigit() or name[:1] == "-":
            return self.constant(Fraction(name))
        return Measured(unknown(name) if unit is None else parse(unit), Text(name))

    def constant(self, value: Fraction) -> Measured:
        return Measured(PURE if value else None, self._texts.constant(value), value)

    def resolve(self, unit: Unit) -> Unit:
        """The unit with every unknown that has been found replaced."""
        result = Unit(unit.si)
        for name, exponent in unit.unknown:
            result = result * self.solved.get(name, unknown(name)) ** exponent
        return result

    def same(self, where: str, a: Measured, b: Measured) -> Unit | None:
        """The common unit of a and b, made equal if an unknown allows it; else the mismatch is recorded."""
        if a.unit is None or b.unit is None:
            return b.unit if a.unit is None else a.unit
        if not self._equate(a.unit, b.unit):
            left, right = self.resolve(a.unit).text, self.resolve(b.unit).text
            self._record(f"{where}: {a.text.text} has unit {left}, {b.text.text} has {right}")
        return a.unit

    def _pure(self, where: str, a: Measured) -> None:
        if a.unit is not None and not self._equate(a.unit, PURE):
            self._record(f"{where}: {a.text.text} has unit {self.resolve(a.unit).text}, not a pure number")

    def _record(self, mismatch: str) -> None:
        if self.mismatch is None:
            self.mismatch = mismatch

    def _equate(self, a: Unit, b: Unit) -> bool:
        """One step of elimination: the ratio must be 1, so it gives one unknown by the others."""
        ratio = self.resolve(a / b)
        if not ratio.unknown:
            return ratio == PURE
        name, exponent = ratio.unknown[0]
        self.solved[name] = unknown(name) / ratio ** (1 / exponent)
        self.solved = {symbol: self.resolve(unit) for symbol, unit in self.solved.items()}
        return True

    def operation(self, op: str) -> Callable[..., Measured]:
        if op not in ARITY:
            return super().operation(op)
        rule, write, number = self._rule(op), self._texts.operation(op), self._numbers.operation(op)

        def evaluate(*args: Measured) -> Measured:
            literals = [a.literal for a in args if a.literal is not None]
            try:
                if len(literals) == len(args):
                    return self.constant(number(*literals))
            except NoExactValue:
                pass
            return Measured(rule(*args), write(*(a.text for a in args)))

        return evaluate

    def add_(self, a: Measured, b: Measured) -> Measured:
        return self.operation("ADD")(a, b)

    def sub_(self, a: Measured, b: Measured) -> Measured:
        return self.operation("SUB")(a, b)

    def mul_(self, a: Measured, b: Measured) -> Measured:
        return self.operation("MUL")(a, b)

    def div_(self, a: Measured, b: Measured) -> Measured:
        return self.operation("DIV")(a, b)

    def inv_(self, a: Measured) -> Measured:
        return self.operation("INV")(a)

    def neg_(self, a: Measured) -> Measured:
        return self.operation("NEG")(a)

    def sq_(self, a: Measured) -> Measured:
        return self.operation("SQ")(a)

    def twice_(self, a: Measured) -> Measured:
        return self.operation("TWICE")(a)

    def _rule(self, op: str) -> Callable[..., Unit | None]:
        """The unit of the result of `op` from its arguments."""
        special: dict[str, Callable[..., Unit | None]] = {
            "MUL": self._product,
            "DIV": self._quotient,
            "POW": self._power,
            "CONSTPOW": self._power,
            "COPYSIGN": lambda a, b: a.unit,
            "IF_ELSE_ZERO": lambda a, b: b.unit,
            "SIGN": lambda a: PURE,
        }
        if op in special:
            return special[op]
        if op in _KEEPS:
            return lambda a: a.unit
        if op in _SCALES:
            return lambda a: None if a.unit is None else a.unit ** _SCALES[op]
        if op in _WORDS:
            return lambda a, b: self._alike(op, a, b)
        return lambda *args: self._function(op, *args)

    def _alike(self, op: str, a: Measured, b: Measured) -> Unit | None:
        unit = self.same(_WORDS[op], a, b)
        return PURE if op in _PURE_RESULT else unit

    def _function(self, op: str, *args: Measured) -> Unit:
        for a in args:
            self._pure(op.lower(), a)
        return PURE

    def _product(self, a: Measured, b: Measured) -> Unit | None:
        return None if a.unit is None or b.unit is None else a.unit * b.unit

    def _quotient(self, a: Measured, b: Measured) -> Unit | None:
        return None if a.unit is None or b.unit is None else a.unit / b.unit

    def _power(self, a: Measured, b: Measured) -> Unit | None:
        """A constant exponent scales the unit; with any other, base and exponent are pure."""
        if b.literal == 0:
            return PURE
        if b.literal is not None:
            return None if a.unit is None else a.unit**b.literal
        self._pure("base of a power", a)
        self._pure("exponent", b)
        return PURE
