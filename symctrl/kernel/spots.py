"""Exact values at one point, with what can be read off their instructions there, and gradients.

Soundness-critical. Last reviewed 2026-11-24.

Relies on the theorems of `enclosure`, `traits` and `chain`. Near the point a switch whose argument is not
zero there is constant, and |a|, roots and powers are smooth where their argument is not at the edge of its
domain. A switch whose argument is zero there is active; it takes the value that is asked for, 0 if none is. A
gradient that is not defined, or not known to be, is LOST, and so is all that is made of it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.chain import Chain, Domain
from symctrl.kernel.enclosure import Enclosure
from symctrl.kernel.interval import Interval, Undecided, point
from symctrl.kernel.traits import NOT_AFFINE, Reading, Traits

LOST = Interval(Fraction(1), Fraction(-1))
_EDGED = frozenset(("SQRT", "POW", "LOG", "ASIN", "ACOS"))


@dataclass(frozen=True, slots=True)
class Spot:
    """slopes: the derivatives by the directions, None for zero. nonnegative: for certain, everywhere."""

    number: Interval
    traits: Traits
    slopes: tuple[Interval | None, ...]
    nonnegative: bool = False

    def gradient(self) -> list[Fraction] | None:
        """Exact, or None."""
        numbers = [point(0) if slope is None else slope for slope in self.slopes]
        if any(x is LOST or not x.thin for x in numbers):
            return None
        return [x.lo for x in numbers]


class Lossy(Domain[Interval]):
    """Intervals for gradients, beside values that are known to exist: what has no value is LOST."""

    def __init__(self, bits: int) -> None:
        self.real = Enclosure(bits)

    def _kept(self, work: Callable[..., Interval], *args: Interval) -> Interval:
        if any(a is LOST for a in args):
            return LOST
        try:
            return work(*args)
        except (Invalid, Declined):
            return LOST

    def constant(self, value: Fraction) -> Interval:
        return point(value)

    def add(self, a: Interval, b: Interval) -> Interval:
        return self._kept(self.real.add, a, b)

    def mul(self, a: Interval, b: Interval) -> Interval:
        return self._kept(self.real.mul, a, b)

    def inv(self, a: Interval) -> Interval:
        return self._kept(self.real.inv, a)

    def function(self, op: str, args: Sequence[Interval]) -> Interval:
        if op == "SIGN" and args[0] is not LOST and args[0].sign == 0:
            return LOST
        return self._kept(lambda *of: self.real.function(op, of), *args)

    def nonzero(self, a: Interval) -> None:
        """The sign that is then asked for is LOST at zero."""

    def rational(self, a: Interval) -> Fraction | None:
        return None if a is LOST else self.real.rational(a)


class Spots(Domain[Spot]):
    """The domain. values: of all free symbols. directions: those by which derivatives are taken.

    fixed: is the symbol constant? switches: values of active switches, by the key of their argument.
    active: arguments that were zero in a switch, by key. at_edge: was a root, a power or a logarithm taken at
    the edge of its domain?
    """

    def __init__(
        self,
        bits: int,
        values: Mapping[str, Fraction],
        fixed: Callable[[str], bool],
        directions: Sequence[str] = (),
        switches: Mapping[str, Fraction] | None = None,
    ) -> None:
        self.values, self.directions, self.switches = values, directions, switches or {}
        self.real, self.along = Enclosure(bits), Chain(Lossy(bits))
        self.read = Reading(lambda _: False, lambda _: False, fixed)
        self.active: dict[str, Spot] = {}
        self.at_edge = False

    def free(self, name: str) -> Spot:
        slopes = tuple(point(1) if name == other else None for other in self.directions)
        return Spot(point(self.values[name]), self.read.free(name), slopes)

    def constant(self, value: Fraction) -> Spot:
        return Spot(point(value), self.read.constant(value), (None,) * len(self.directions), value >= 0)

    def add(self, a: Spot, b: Spot) -> Spot:
        number, traits = self.real.add(a.number, b.number), self.read.add(a.traits, b.traits)
        return Spot(number, traits, self._slopes("ADD", [a, b]), a.nonnegative and b.nonnegative)

    def mul(self, a: Spot, b: Spot) -> Spot:
        number, traits = self.real.mul(a.number, b.number), self.read.mul(a.traits, b.traits)
        return Spot(number, traits, self._slopes("MUL", [a, b]), a.nonnegative and b.nonnegative)

    def square(self, a: Spot) -> Spot:
        return replace(self.mul(a, a), nonnegative=True)

    def inv(self, a: Spot) -> Spot:
        return Spot(self.real.inv(a.number), self.read.inv(a.traits), self._slopes("INV", [a]), a.nonnegative)

    def function(self, op: str, args: Sequence[Spot]) -> Spot:
        if op == "SIGN":
            return self._sign(args[0])
        number = self.real.function(op, [x.number for x in args])
        traits = self.read.function(op, [x.traits for x in args])
        if op in _EDGED or op == "FABS":
            traits = self._within(op, args, traits)
        return Spot(number, traits, self._slopes(op, args), op in ("FABS", "SQRT", "EXP"))

    def _within(self, op: str, args: Sequence[Spot], traits: Traits) -> Traits:
        """What is smooth away from its edge is smooth near the point, if the point is away from it."""
        a = args[0].number
        between = op in ("ASIN", "ACOS")
        inside = a.magnitude < 1 if between else a.lo > 0 or (op == "FABS" and a.hi < 0)
        if inside:
            return replace(traits, level=max(x.traits.level for x in args))
        if op != "FABS" and not args[0].nonnegative:
            self.at_edge = True
        return traits

    def _sign(self, a: Spot) -> Spot:
        traits = self.read.function("SIGN", [a.traits])
        sign = a.number.sign
        if sign is None:
            raise Undecided("the sign of what may be zero")
        if sign:
            degree = NOT_AFFINE if a.traits.degree else 0
            traits = replace(traits, jumps=a.traits.jumps, degree=degree)
            slopes = tuple(LOST if a.traits.jumps and s is not None else None for s in a.slopes)
            return Spot(point(sign), traits, slopes)
        self.active.setdefault(a.traits.key, a)
        slopes = tuple(None if s is None else LOST for s in a.slopes)
        return Spot(point(self.switches.get(a.traits.key, Fraction(0))), traits, slopes)

    def _slopes(self, op: str, args: Sequence[Spot]) -> tuple[Interval | None, ...]:
        """By the chain rule, one direction after another."""
        found: list[Interval | None] = []
        for k in range(len(self.directions)):
            levels = [(x.number, x.slopes[k]) for x in args]
            still = all(slope is None for _, slope in levels)
            found.append(None if still else self.along.operation(op, 1, levels)[1])
        return tuple(found)

    def nonzero(self, a: Spot) -> None:
        """Asked before a rate of |a|, which has no single value where a = 0."""
        if a.number.sign == 0:
            raise Declined("a rate of |.| at zero")
        self.real.nonzero(a.number)

    def rational(self, a: Spot) -> Fraction | None:
        """Of what is constant: an exponent that is a whole number only at this point is none."""
        return a.number.lo if a.number.thin and self.read.is_constant(a.traits) else None
