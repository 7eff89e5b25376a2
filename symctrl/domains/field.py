"""The algebra under the exact domain: polynomials in generators, a table of factors, and relations.

Generators rank by their index (a later one is higher, lexicographic order): free symbols, and opaque ones (a
root, a sine, an absolute value), each defined over earlier generators. FLINT fixes the number of variables of
a context, so spare ones are reserved and taken from the lowest up.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

import flint

from symctrl.problem import split

Poly = Any  # flint.fmpq_mpoly
Key = tuple[tuple[int, int], ...]  # (factor, exponent), increasing: the denominator of one group
Exact = dict[Key, Any]  # the sum of the groups numerator / denominator; no group is zero


class OutOfGenerators(Exception):  # noqa: N818
    """More opaque generators are needed than were reserved."""


@dataclass(frozen=True)
class Generator:
    """One variable. kind: free, sum, root, abs, sign, cos, sin, exp, power or function.

    name: of a free symbol or a function, or the node of a sum. argument: the defining polynomial (root, abs,
    sign, power), the monomial that is summed over the node's neighbours, or values.
    """

    kind: str
    name: str = ""
    argument: Any = None
    degree: int = 0
    exponent: Any = None
    partner: int = -1


@dataclass
class Field:
    """The polynomial ring with its tables; grows while one claim is evaluated."""

    free: Sequence[str]
    spare: int = 16
    generators: list[Generator] = field(default_factory=list)
    factors: list[Poly] = field(default_factory=list)
    relations: list[Poly] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.size = len(self.free) + self.spare
        names = [f"g{k}" for k in reversed(range(self.size))]
        self.context = flint.fmpq_mpoly_ctx.get(names, "lex")
        self.generators = [Generator("free", name) for name in self.free]
        self.index = {name: k for k, name in enumerate(self.free)}
        self._labels: dict[int, str] = {}
        self._led: set[int] = set()
        self._triangular = True

    def variable(self, k: int) -> Poly:
        return self.context.gen(self.size - 1 - k)

    def polynomial(self, value: Fraction | int) -> Poly:
        if value.denominator == 1:
            return self.context.constant(value.numerator)
        return self.context.constant(flint.fmpq(value.numerator, value.denominator))

    def add_generator(self, generator: Generator) -> int:
        """Its index. Raises OutOfGenerators."""
        if len(self.generators) == self.size:
            raise OutOfGenerators
        self.generators.append(generator)
        return len(self.generators) - 1

    def add_relation(self, zero: Poly) -> None:
        """The polynomial vanishes on the domain; its leading monomial is rewritten from now on."""
        if zero.is_zero():
            return
        self.relations.append(zero)
        self.relations.sort(key=lambda p: p.monomial(0), reverse=True)
        led = [v for v, e in enumerate(zero.monomial(0)) if e]
        self._triangular = self._triangular and len(led) == 1 and led[0] not in self._led
        self._led.update(led)

    def kept(self) -> tuple[list[Poly], set[int], bool]:
        """The relations so far, for `restore`."""
        return list(self.relations), set(self._led), self._triangular

    def restore(self, kept: tuple[list[Poly], set[int], bool]) -> None:
        """Forget the relations that have been added since."""
        self.relations, self._led, self._triangular = kept

    def normal(self, p: Poly) -> Poly:
        """The normal form: no term is divisible by the leading monomial of a relation.

        Where the leading monomials are powers of different generators, dividing by a relation brings back no
        power of a higher generator, so that one pass from the top is enough.
        """
        while True:
            before = p
            for relation in self.relations:
                if p.is_zero():
                    return p
                p = divmod(p, relation)[1]
            if self._triangular or p == before:
                return p

    def factor_index(self, f: Poly) -> int:
        """The place of an irreducible polynomial in the table, entered if it is new."""
        for k, known in enumerate(self.factors):
            if known == f:
                return k
        self.factors.append(f)
        return len(self.factors) - 1

    def occurring(self, p: Poly) -> set[int]:
        """Indices of the generators that occur in p."""
        return {self.size - 1 - c for c, degree in enumerate(p.degrees()) if degree}

    def letters(self, k: int) -> frozenset[str]:
        """The generic nodes that a generator belongs to: i, j, both or none."""
        g = self.generators[k]
        if g.kind in ("free", "sum"):
            node = g.name if g.kind == "sum" else split(g.name)[1]
            return frozenset((node,) if node else ())
        return frozenset().union(*(self.letters(v) for v in self.made_of(k)))

    def made_of(self, k: int) -> set[int]:
        """Indices of the generators that an opaque generator is defined over."""
        g = self.generators[k]
        found = {g.partner} if g.partner >= 0 else set()
        for part in g.argument if isinstance(g.argument, tuple) else (g.argument, g.exponent):
            for key, p in (
                (part if isinstance(part, dict) else {(): part}).items() if part is not None else ()
            ):
                found |= self.occurring(p)
                for f, _ in key:
                    found |= self.occurring(self.factors[f])
        return found

    def text(self, p: Poly) -> str:
        """The polynomial in words that do not depend on the order in which generators were made."""
        terms = []
        for exponents, c in p.terms():
            powers = sorted(f"{self._label(self.size - 1 - v)}^{e}" for v, e in enumerate(exponents) if e)
            terms.append(" ".join([str(c), *powers]))
        return " + ".join(sorted(terms))

    def value_text(self, value: Exact) -> str:
        """The value likewise."""
        groups = [
            (sorted((self.text(self.factors[k]), e) for k, e in key), self.text(p))
            for key, p in value.items()
        ]
        return str(sorted(groups))

    def _label(self, k: int) -> str:
        if k not in self._labels:
            g = self.generators[k]
            made = [self._part_text(part) for part in (g.argument, g.exponent)]
            self._labels[k] = g.name if g.kind == "free" else f"{g.kind}({g.name} {g.degree} {made})"
        return self._labels[k]

    def _part_text(self, part: Any) -> str:
        if isinstance(part, tuple):
            return str([self.value_text(value) for value in part])
        if isinstance(part, dict):
            return self.value_text(part)
        return "" if part is None else self.text(part)

    def json(self, p: Poly) -> list[list[Any]]:
        """The POLY form of docs/certificates.md."""
        result = []
        for exponents, coefficient in p.terms():
            term: list[Any] = [str(coefficient)]
            for k in range(self.size):
                if e := exponents[self.size - 1 - k]:
                    term += [k, int(e)]
            result.append(term)
        return result

    def value_json(self, value: Exact, place: Mapping[int, int]) -> list[Any]:
        """The VALUE form, with factors by their place in the proof."""
        groups = [([[place[k], e] for k, e in key], self.json(p)) for key, p in value.items()]
        return [[key, p] for key, p in sorted(groups, key=lambda group: group[0])]

    def generators_json(self, place: Mapping[int, int]) -> list[dict[str, Any]]:
        return [self._generator_json(g, place) for g in self.generators]

    def _generator_json(self, g: Generator, place: Mapping[int, int]) -> dict[str, Any]:
        match g.kind:
            case "free":
                return {"free": g.name}
            case "sum":
                ((_, *powers),) = self.json(g.argument)
                pairs = [list(pair) for pair in zip(powers[::2], powers[1::2], strict=True)]
                return {"sum": pairs, "node": g.name}
            case "root":
                return {"root": g.degree, "of": self.json(g.argument)}
            case "abs":
                return {"abs": self.json(g.argument)}
            case "sign":
                return {"sign": self.json(g.argument), "abs": g.partner}
            case "cos":
                return {"cos": self.value_json(g.argument, place)}
            case "sin":
                return {"sin": self.value_json(g.argument, place), "cos": g.partner}
            case "exp":
                return {"exp": self.value_json(g.argument, place)}
            case "power":
                return {"power": self.json(g.argument), "exponent": self.value_json(g.exponent, place)}
            case _:
                return {"function": g.name, "of": [self.value_json(a, place) for a in g.argument]}


def merged(groups: Mapping[Key, Poly] | Sequence[tuple[Key, Poly]]) -> Exact:
    """The value with equal denominators added up and zero groups left out."""
    result: Exact = {}
    for key, p in groups.items() if isinstance(groups, Mapping) else groups:
        result[key] = result[key] + p if key in result else p
    return {key: p for key, p in result.items() if not p.is_zero()}


def key_product(a: Key, b: Key) -> Key:
    if not a:
        return b
    if not b:
        return a
    exponents = dict(a)
    for k, e in b:
        exponents[k] = exponents.get(k, 0) + e
    return tuple(sorted(exponents.items()))


def is_number(p: Poly) -> bool:
    """Is the polynomial constant? Asked of more than one term, FLINT would go through them all."""
    return len(p) < 2 and bool(p.is_constant())


def coefficient(p: Poly) -> Fraction:
    """The rational that a constant polynomial is."""
    c = p.leading_coefficient() if not p.is_zero() else flint.fmpq(0)
    return Fraction(int(c.p), int(c.q))
