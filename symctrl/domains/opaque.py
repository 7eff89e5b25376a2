"""Operations that leave the rational functions: each result is a product of powers of opaque generators.

Roots, absolute values and signs go factor by factor through the irreducible factors of their argument, so
that sqrt(x) sqrt(y) and sqrt(x y) meet; exponentials, powers with a symbolic exponent, sines and cosines go
term by term through their argument, so that exp(x + y), sin(2 x + y) and |x|^(g - 1) meet exp(x), sin(x) and
|x|^g. The generators must be fine enough for everything that occurs (a cube root and a square root need a
sixth root): where they are not, `Refine` asks for the evaluation to start again with what has been learnt.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import permutations
from math import lcm
from typing import Protocol

import flint

from symctrl.domains.domain import Unsupported
from symctrl.domains.field import Exact, Field, Generator, Key, Poly
from symctrl.domains.signs import Signs

FUNCTIONS = frozenset(["LOG", "TANH", "ASIN", "ACOS", "ATAN", "ERF", "FLOOR", "CEIL", "ATAN2"])
MAX_MULTIPLE = 32  # of an angle: sin(32 x) is a polynomial of degree 32 in sin(x), cos(x)
Turn = tuple[Exact, Exact]  # the cosine and the sine of an angle
ODD = frozenset(["TANH", "ASIN", "ATAN", "ERF"])


class NowhereDefined(ValueError):  # noqa: N818
    """An operation that has no value anywhere on the domain."""


class Refine(Exception):  # noqa: N818
    """More is known than when the evaluation began: start again with the same `Knowledge`."""


@dataclass
class Knowledge:
    """What an evaluation learns for the next, by texts: common denominators, and what is not negative."""

    denominators: dict[str, int] = field(default_factory=dict)
    nonnegative: list[str] = field(default_factory=list)

    def denominator(self, of: str, wanted: int) -> int:
        """The common denominator known for `of`. Raises Refine if `wanted` does not divide it."""
        known = self.denominators.get(of, 0)
        if known and known % wanted == 0:
            return known
        self.denominators[of] = lcm(known or 1, wanted)
        if known:
            raise Refine
        return wanted

    def learn_nonnegative(self, of: str) -> None:
        if of not in self.nonnegative:
            self.nonnegative.append(of)
            raise Refine


class Rational(Protocol):
    """What opaque operations need of the exact domain: its field and signs, and arithmetic on its values."""

    field: Field
    signs: Signs

    def constant(self, value: Fraction) -> Exact: ...
    def polynomial(self, p: Poly) -> Exact: ...
    def add_(self, a: Exact, b: Exact) -> Exact: ...
    def sub_(self, a: Exact, b: Exact) -> Exact: ...
    def mul_(self, a: Exact, b: Exact) -> Exact: ...
    def power(self, a: Exact, exponent: int) -> Exact: ...
    def scaled(self, a: Exact, factor: Fraction) -> Exact: ...
    def simplified(self, a: Exact) -> Exact: ...
    def factored(self, a: Exact) -> tuple[Fraction, Key]: ...
    def rational(self, a: Exact) -> Fraction | None: ...
    def is_zero(self, a: Exact) -> bool: ...


class Opaque:
    """The opaque operations of one exact domain."""

    def __init__(self, domain: Rational, knowledge: Knowledge) -> None:
        self.domain = domain
        self.field = domain.field
        self.knowledge = knowledge
        self._turns: list[tuple[Exact, Turn]] = []

    def handler(self, op: str) -> Callable[..., Exact] | None:
        if op in FUNCTIONS:
            return lambda *args: self.function(op.lower(), *args)
        return {
            "SQRT": self.sqrt,
            "FABS": self.fabs,
            "SIGN": self.sign,
            "EXP": self.exp,
            "SIN": self.sin,
            "COS": self.cos,
        }.get(op)

    # Factor by factor

    def sqrt(self, a: Exact) -> Exact:
        return self._rational_power(a, Fraction(1, 2))

    def power(self, a: Exact, b: Exact) -> Exact:
        """a**b for a base that must not be negative: a rational or symbolic exponent."""
        exponent = self.domain.rational(b)
        if exponent is not None:
            return self._rational_power(a, exponent)
        c, key = self._factored(a)
        if c == 0:
            raise Unsupported("the exact domain gives no meaning to a symbolic power of zero")
        if c < 0 or any(not self._nonnegative(self.field.factors[k]) for k, _ in key):
            whole = self._polynomial_part(a)
            self.knowledge.learn_nonnegative(self.field.text(whole))
            return self._symbolic_power(whole, 1, b)
        result = self.domain.constant(Fraction(1))
        for base, e in self._primes(c):
            result = self.domain.mul_(result, self._symbolic_power(self.field.polynomial(base), e, b))
        for k, e in key:
            result = self.domain.mul_(result, self._symbolic_power(self.field.factors[k], e, b))
        return result

    def fabs(self, a: Exact) -> Exact:
        c, key = self._factored(a)
        result = self.domain.constant(abs(c))
        for k, e in key:
            result = self.domain.mul_(result, self._absolute_power(k, e))
        return result

    def sign(self, a: Exact) -> Exact:
        """The product of the signs of the factors; zero where a is."""
        c, key = self._factored(a)
        result = self.domain.constant(Fraction((c > 0) - (c < 0)))
        for k, e in key:
            f = self.field.factors[k]
            known = self._sign(f)
            if known == "positive" or (e % 2 == 0 and known == "nonzero"):
                continue
            s = self.domain.polynomial(self.field.variable(self._sign_generator(f)))
            result = self.domain.mul_(result, s if e % 2 else self.domain.mul_(s, s))
        return result

    def _rational_power(self, a: Exact, exponent: Fraction) -> Exact:
        c, key = self._factored(a)
        if c == 0 and exponent < 0:
            raise NowhereDefined("a division by what is zero on the whole domain")
        if c == 0:
            return self.domain.constant(Fraction(0))
        domain = self.domain
        known: list[tuple[int, int]] = []
        unknown: list[tuple[int, int]] = []
        for k, e in key:
            (known if self._nonnegative(self.field.factors[k]) else unknown).append((k, e))
        if c < 0 and all(e % 2 == 0 for _, e in unknown):
            self._refuse_negative(key)
        result = domain.constant(Fraction(1))
        if exponent.denominator == 2 and unknown:
            odd = [(k, 1) for k, e in unknown if e % 2]
            for k, e in unknown:
                result = domain.mul_(result, self._absolute_to(k, (e - e % 2) // 2 * exponent.numerator))
            unknown = odd
        c, result = (c, result) if unknown else (abs(c), result)
        if unknown:
            self._learn_whole(c, unknown)
            result = domain.mul_(result, self._root(self._product(c, unknown), 1, exponent))
        for base, e in self._primes(abs(c)):
            result = domain.mul_(result, self._root(self.field.polynomial(base), e, exponent))
        for k, e in known:
            result = domain.mul_(result, self._root(self.field.factors[k], e, exponent))
        return result

    def _learn_whole(self, c: Fraction, unknown: list[tuple[int, int]]) -> None:
        """A root is defined where its radicand is not negative: a single factor is then known not to be."""
        if len(unknown) == 1 and unknown[0][1] % 2 and c > 0:
            self.knowledge.learn_nonnegative(self.field.text(self.field.factors[unknown[0][0]]))

    def _refuse_negative(self, key: Key) -> None:
        """A root of what is never positive: it has a value at most where a factor vanishes."""
        signs = {k: self._sign(self.field.factors[k]) for k, _ in key}
        if all(signs[k] == "positive" or (signs[k] == "nonzero" and e % 2 == 0) for k, e in key):
            raise NowhereDefined("a root of what is negative on the whole domain")
        raise Unsupported("the exact domain gives no meaning to a root of what is never positive")

    def _product(self, c: Fraction, unknown: list[tuple[int, int]]) -> Poly:
        """The factors of unknown sign, with the sign of c."""
        if any(e < 0 for _, e in unknown):
            raise Unsupported(
                "the exact domain gives a quotient of unknown sign no power other than multiples of a half"
            )
        product = self.field.polynomial(-1 if c < 0 else 1)
        for k, e in unknown:
            product = product * self.field.factors[k] ** e
        return product

    def _root(self, base: Poly, e: int, exponent: Fraction) -> Exact:
        """base**(e*exponent) as a power of one root generator."""
        total = e * exponent
        degree = self.knowledge.denominator(f"root {self.field.text(base)}", total.denominator)
        whole, part = divmod(total.numerator * (degree // total.denominator), degree)
        result = self.domain.power(self.domain.polynomial(base), whole)
        if part:
            g = self.generator(Generator("root", argument=base, degree=degree))
            result = self.domain.mul_(result, self.domain.polynomial(self.field.variable(g) ** part))
        return result

    def _symbolic_power(self, base: Poly, e: int, exponent: Exact) -> Exact:
        result = self.domain.constant(Fraction(1))
        for atom, c in self._atoms(exponent):
            total = c * e
            if atom is None:
                result = self.domain.mul_(result, self._root(base, 1, total))
                continue
            unit = self.knowledge.denominator(
                f"power {self.field.text(base)} {self.field.value_text(atom)}", total.denominator
            )
            value = self.domain.scaled(atom, Fraction(1, unit))
            g = self.generator(Generator("power", argument=base, exponent=value))
            p = self.domain.polynomial(self.field.variable(g))
            result = self.domain.mul_(result, self.domain.power(p, int(total * unit)))
        return result

    def _absolute_power(self, k: int, e: int) -> Exact:
        f = self.field.factors[k]
        if e % 2 == 0 or self._nonnegative(f):
            return self.domain.power(self.domain.polynomial(f), e)
        return self._absolute_to(k, e)

    def _absolute_to(self, k: int, e: int) -> Exact:
        """|f|^e = |f| f^(e-1) for odd e."""
        f = self.domain.polynomial(self.field.factors[k])
        if e % 2 == 0:
            return self.domain.power(f, e)
        m = self.field.variable(self._abs_generator(self.field.factors[k]))
        return self.domain.mul_(self.domain.polynomial(m), self.domain.power(f, e - 1))

    # Term by term

    def exp(self, a: Exact) -> Exact:
        result = self.domain.constant(Fraction(1))
        for atom, c in self._atoms(a):
            base, unit = self._unit("exp", atom, c)
            g = self.generator(Generator("exp", argument=base))
            e = self.domain.polynomial(self.field.variable(g))
            result = self.domain.mul_(result, self.domain.power(e, int(c * unit)))
        return result

    def cos(self, a: Exact) -> Exact:
        return self._turn(a)[0]

    def sin(self, a: Exact) -> Exact:
        return self._turn(a)[1]

    def _turn(self, a: Exact) -> Turn:
        a = self.domain.simplified(a)
        for known, turn in self._turns:
            if known == a:
                return turn
        self._turns.append((a, self._new_turn(a)))
        return self._turns[-1][1]

    def _new_turn(self, a: Exact) -> Turn:
        """(cos a, sin a) by the addition theorems."""
        domain = self.domain
        result = (domain.constant(Fraction(1)), domain.constant(Fraction(0)))
        multiples = 1
        for atom, c in self._atoms(a):
            base, unit = self._unit("angle", atom, c)
            multiples *= abs(int(c * unit))
            if multiples > MAX_MULTIPLE:
                raise Unsupported(
                    "the exact domain gives no meaning to the sine of so large a multiple of an angle"
                )
            k = self.generator(Generator("cos", argument=base))
            j = self.generator(Generator("sin", argument=base, partner=k))
            side = 1 if c > 0 else -1
            step = (
                domain.polynomial(self.field.variable(k)),
                domain.polynomial(side * self.field.variable(j)),
            )
            for _ in range(abs(int(c * unit))):
                result = self._rotated(result, step)
        return result

    def _rotated(self, a: Turn, b: Turn) -> Turn:
        d = self.domain
        return (
            d.sub_(d.mul_(a[0], b[0]), d.mul_(a[1], b[1])),
            d.add_(d.mul_(a[1], b[0]), d.mul_(a[0], b[1])),
        )

    def function(self, name: str, *args: Exact) -> Exact:
        """An opaque function: equal arguments give equal values; an odd one is known by one of ±argument."""
        values = tuple(self.domain.simplified(a) for a in args)
        for k, g in enumerate(self.field.generators):
            if g.kind != "function" or g.name != name:
                continue
            variable = self.field.variable(k)
            if all(
                self.domain.is_zero(self.domain.sub_(a, b)) for a, b in zip(values, g.argument, strict=True)
            ):
                return self.domain.polynomial(variable)
            if name.upper() in ODD and self.domain.is_zero(self.domain.add_(values[0], g.argument[0])):
                return self.domain.polynomial(-variable)
        made = self.field.add_generator(Generator("function", name, argument=values))
        return self.domain.polynomial(self.field.variable(made))

    def _atoms(self, a: Exact) -> list[tuple[Exact | None, Fraction]]:
        """a as a sum of rational multiples of single terms; None is the term 1."""
        result: list[tuple[Exact | None, Fraction]] = []
        for key, p in sorted(self.domain.simplified(a).items()):
            for exponents, c in p.terms():
                monomial = self.field.context.from_dict({exponents: 1})
                constant = not key and monomial.is_constant()
                result.append((None if constant else {key: monomial}, Fraction(int(c.p), int(c.q))))
        return result

    def _unit(self, kind: str, atom: Exact | None, c: Fraction) -> tuple[Exact, int]:
        value = self.domain.constant(Fraction(1)) if atom is None else atom
        unit = self.knowledge.denominator(f"{kind} {self.field.value_text(value)}", c.denominator)
        return self.domain.scaled(value, Fraction(1, unit)), unit

    # Generators and what is known

    def generator(self, wanted: Generator) -> int:
        """The index of the generator, made with its relations if it is new."""
        for k, g in enumerate(self.field.generators):
            if g.kind == wanted.kind and g == wanted:
                return k
        k = self.field.add_generator(wanted)
        g = self.field.variable(k)
        if wanted.kind == "root":
            self.field.add_relation(g**wanted.degree - wanted.argument)
        elif wanted.kind == "abs":
            self.field.add_relation(g * g - wanted.argument * wanted.argument)
        elif wanted.kind == "sin":
            cosine = self.field.variable(wanted.partner)
            self.field.add_relation(g * g + cosine * cosine - 1)
        elif wanted.kind == "sign":
            m = self.field.variable(wanted.partner)
            self.field.add_relation(g * wanted.argument - m)
            self.field.add_relation(g * m - wanted.argument)
            if self._sign(wanted.argument) in ("positive", "nonzero"):
                self.field.add_relation(g * g - 1)
        if wanted.kind in ("root", "power", "sign"):
            self._add_switched(k)
        return k

    def _add_switched(self, new: int) -> None:
        """s² r = r for a switch s on x and a root r of |x|, or a power with a positive exponent: r(0) = 0."""
        pairs = permutations(enumerate(self.field.generators), 2)
        for (r, g), (s, h) in ((a, b) for a, b in pairs if new in (a[0], b[0]) and b[1].kind == "sign"):
            plain = g.kind == "power" and set(g.exponent) == {()}
            growing = plain and self.domain.signs.of(g.exponent[()]) == "positive"
            if (g.kind == "root" or growing) and g.argument == self.field.variable(h.partner):
                root, switch = self.field.variable(r), self.field.variable(s)
                self.field.add_relation(switch * switch * root - root)

    def _abs_generator(self, f: Poly) -> int:
        return self.generator(Generator("abs", argument=f))

    def _sign_generator(self, f: Poly) -> int:
        return self.generator(Generator("sign", argument=f, partner=self._abs_generator(f)))

    def _sign(self, f: Poly) -> str | None:
        known = self.domain.signs.of(f)
        if known is None and self.knowledge.nonnegative and self.field.text(f) in self.knowledge.nonnegative:
            return "nonnegative"
        return known

    def _nonnegative(self, f: Poly) -> bool:
        return self._sign(f) in ("positive", "nonnegative")

    def _factored(self, a: Exact) -> tuple[Fraction, Key]:
        constant = self.domain.rational(a)
        return (constant, ()) if constant is not None else self.domain.factored(a)

    def _polynomial_part(self, a: Exact) -> Poly:
        value = self.domain.simplified(a)
        if set(value) != {()}:
            raise Unsupported(
                "the exact domain gives no meaning to a symbolic power of a quotient of unknown sign"
            )
        return value[()]

    def _primes(self, c: Fraction) -> list[tuple[int, int]]:
        """The prime factors of a positive rational with their exponents."""
        powers: dict[int, int] = {}
        for n, side in ((c.numerator, 1), (c.denominator, -1)):
            for p in _prime_factors(n):
                powers[p] = powers.get(p, 0) + side
        return [(p, e) for p, e in sorted(powers.items()) if e]


def _prime_factors(n: int) -> list[int]:
    return [int(p) for p, e in flint.fmpz(n).factor() for _ in range(int(e))] if n > 1 else []
