"""The exact domain: rational functions over Q in generators, reduced by relations.

A value is a sum of fractions, {denominator: numerator}, over a table of irreducible factors found when
something is inverted. Sums are not put over a common denominator; relations are applied where it must be
known whether a value is zero. What no ring operation covers becomes an opaque generator with its relations
(symctrl.domains.opaque).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from math import comb
from typing import Any

from flint.utils.flint_exceptions import DomainError

from symctrl.domains.domain import Domain, Unsupported
from symctrl.domains.field import Exact, Field, Key, Poly, coefficient, is_number, key_product, merged
from symctrl.domains.opaque import Knowledge, NowhereDefined, Opaque
from symctrl.domains.signs import Signs

MAX_TERMS = 200_000
MAX_SQUARED = 12  # sums whose squares are noted


@dataclass
class Recording:
    """What the kernel needs to repeat the evaluation: factors of inverted values, and opaque results."""

    inverses: list[tuple[Fraction, tuple[tuple[int, int], ...]]] = field(default_factory=list)
    results: list[Exact] = field(default_factory=list)


class ExactDomain(Domain[Exact]):
    """Exact values over one `Field`.

    Raises NowhereDefined, OutOfGenerators, Unsupported and opaque.Refine (evaluate again, knowing more).
    """

    name = "exact"

    def __init__(self, field_: Field, knowledge: Knowledge | None = None) -> None:
        self.field = field_
        self.signs = Signs(field_)
        self.recording = Recording()
        self.opaque = Opaque(self, knowledge or Knowledge())
        self.squared: list[Poly] = []
        self._factored: dict[tuple[tuple[Key, int], ...], list[tuple[Exact, Fraction, Key]]] = {}

    # Values

    def constant(self, value: Fraction) -> Exact:
        return {(): self.field.polynomial(value)} if value else {}

    def free(self, name: str) -> Exact:
        return {(): self.field.variable(self.field.index[name])}

    def polynomial(self, p: Poly) -> Exact:
        return {} if p.is_zero() else {(): p}

    def over(self, numerator: Poly, key: Key) -> Exact:
        """numerator / key, cancelled; exponents of the key may be negative."""
        for k, e in key:
            if e < 0:
                numerator = numerator * self.field.factors[k] ** (-e)
        return self._cancelled(tuple((k, e) for k, e in key if e > 0), numerator)

    # Ring operations

    def add_(self, a: Exact, b: Exact) -> Exact:
        if not (a and b):
            return a or b
        result = a.copy()
        for key, q in b.items():
            total = result.pop(key) + q if key in result else q
            if not total.is_zero():
                result[key] = total
        return result

    def sub_(self, a: Exact, b: Exact) -> Exact:
        if not b:
            return a
        result = a.copy()
        for key, q in b.items():
            total = result.pop(key) - q if key in result else -q
            if not total.is_zero():
                result[key] = total
        return result

    def neg_(self, a: Exact) -> Exact:
        return {key: -p for key, p in a.items()}

    def mul_(self, a: Exact, b: Exact) -> Exact:
        if not (a and b):
            return {}
        if len(a) == 1 == len(b):
            (((k, p),), ((j, q),)) = a.items(), b.items()
            if not k and p.is_one():
                return b
            if not j and q.is_one():
                return a
            return self._cancelled(key_product(k, j), p * q) if k or j else {(): p * q}
        products: Exact = {}
        for k, p in a.items():
            for j, q in b.items():
                key = key_product(k, j)
                products[key] = products[key] + p * q if key in products else p * q
        return merged([pair for key, p in products.items() for pair in self._cancelled(key, p).items()])

    def sq_(self, a: Exact) -> Exact:
        self._note_square(a)
        return self.mul_(a, a)

    def _note_square(self, a: Exact) -> None:
        """What is squared may be a part of a proof that something is not negative."""
        p = a.get(()) if len(a) == 1 else None
        if p is not None and len(p) > 1 and len(self.squared) < MAX_SQUARED and p not in self.squared:
            self.squared.append(p)

    def div_(self, a: Exact, b: Exact) -> Exact:
        if len(b) == 1 and () in b and is_number(b[()]):
            c = b[()].leading_coefficient()
            return {key: p / c for key, p in a.items()}
        return self.mul_(a, self.inv_(b))

    def scaled(self, a: Exact, factor: Fraction) -> Exact:
        return a if factor == 1 else self.mul_(self.constant(factor), a)

    def power(self, a: Exact, exponent: int) -> Exact:
        """a**exponent by squaring; a negative one inverts first. Raises Unsupported where it is too long."""
        if exponent < 0:
            return self.power(self.inv_(a), -exponent)
        length = max(1, sum(len(p) for p in a.values()))
        if comb(min(exponent, MAX_TERMS) + length - 1, length - 1) > MAX_TERMS:
            raise Unsupported(
                f"the exact domain does not expand the power {exponent} of a sum of {length} terms"
            )
        if len(a) == 1 and exponent:
            ((key, p),) = a.items()
            return {tuple((k, e * exponent) for k, e in key): p**exponent}
        result = self.constant(Fraction(1))
        while exponent:
            if exponent & 1:
                result = self.mul_(result, a)
            exponent >>= 1
            a = self.mul_(a, a) if exponent else a
        return result

    def inv_(self, a: Exact) -> Exact:
        """1/a through the irreducible factors of its numerator. Raises NowhereDefined."""
        if len(a) == 1 and () in a and is_number(a[()]):
            return {(): 1 / a[()]}
        c, key = self.factored(a)
        if c == 0:
            raise NowhereDefined("a division by what is zero on the whole domain")
        self.recording.inverses.append((c, key))
        return self.over(self.field.polynomial(1 / c), key)

    def _cancelled(self, key: Key, p: Poly) -> Exact:
        if p.is_zero():
            return {}
        if not key or is_number(p):
            return {key: p}
        kept = []
        for k, exponent in key:
            e = exponent
            while e:
                try:
                    p = p / self.field.factors[k]
                except DomainError:
                    break
                e -= 1
            if e:
                kept.append((k, e))
        return {tuple(kept): p}

    # Questions about values

    def rational(self, a: Exact) -> Fraction | None:
        """The number that a is without any relation, or None."""
        if not a:
            return Fraction(0)
        if len(a) == 1 and () in a and is_number(a[()]):
            return coefficient(a[()])
        return None

    def together(self, a: Exact) -> tuple[Poly, Key]:
        """Numerator in normal form, and denominator, of the whole sum."""
        numerator, key = self.fraction(a)
        return self.field.normal(numerator), key

    def fraction(self, a: Exact) -> tuple[Poly, Key]:
        """Numerator as it is, and denominator, of the whole sum."""
        if len(a) == 1:
            ((one, p),) = a.items()
            return p, one
        common: dict[int, int] = {}
        for key in a:
            for k, e in key:
                common[k] = max(common.get(k, 0), e)
        total = self.field.polynomial(0)
        for key, p in a.items():
            have, scaled = dict(key), p
            for k, e in common.items():
                if e > have.get(k, 0):
                    scaled = scaled * self.field.factors[k] ** (e - have.get(k, 0))
            total = total + scaled
        return total, tuple(sorted(common.items()))

    def is_zero(self, a: Exact) -> bool:
        """Is a zero wherever it is defined on the domain? False means: not shown by the relations."""
        if not a:
            return True
        if len(a) > 1:
            parts = self._components(a)
            if len(parts) > 1 and all(self.together(part)[0].is_zero() for part in parts):
                return True
        return bool(self.together(a)[0].is_zero())

    def simplified(self, a: Exact) -> Exact:
        """The same value over one denominator, in normal form and cancelled."""
        numerator, key = self.together(a)
        return self._cancelled(key, numerator)

    def factored(self, a: Exact) -> tuple[Fraction, Key]:
        """c and {factor: exponent} with a = c ∏ factor^exponent, exponents of either sign; c = 0 for zero."""
        shape = tuple(sorted((key, len(p)) for key, p in a.items()))
        for value, c, result in (known := self._factored.setdefault(shape, [])):
            if value == a:
                return c, result
        numerator, key = self.together(a)
        c, exponents = self.factor_polynomial(numerator)
        for k, e in key:
            exponents[k] = exponents.get(k, 0) - e
        known.append((a, c, tuple(sorted((k, e) for k, e in exponents.items() if e))))
        return known[-1][1:]

    def factor_polynomial(self, p: Poly) -> tuple[Fraction, dict[int, int]]:
        """c and {factor: exponent} with p = c ∏ factor^exponent; the factors enter the table."""
        if p.is_zero():
            return Fraction(0), {}
        number, pairs = p.factor()
        c = Fraction(int(number.p), int(number.q))
        exponents: dict[int, int] = {}
        for f, e in pairs:
            root, ratio = self._square_root(f)
            k = self.field.factor_index(f if root is None else root)
            exponents[k] = exponents.get(k, 0) + int(e) * (1 if root is None else 2)
            c *= ratio ** int(e)
        return c, exponents

    def _square_root(self, f: Poly) -> tuple[Poly | None, Fraction]:
        """A generator g and r with f = r g² by a relation, as 1 - qᵀq is q0² for a unit quaternion."""
        for relation in self.field.relations:
            lead = relation.monomial(0)
            if len(relation) == len(f) + 1 and sum(lead) == max(lead) == 2:
                g = self.field.context.gen(lead.index(2))
                tail = g * g - relation / relation.leading_coefficient()
                if is_number(tail):
                    continue
                ratio = f.leading_coefficient() / tail.leading_coefficient()
                if f == tail * ratio:
                    return g, Fraction(int(ratio.p), int(ratio.q))
        return None, Fraction(1)

    def _components(self, a: Exact) -> list[Exact]:
        """Groups whose denominators share factors, apart from the others."""
        parts: list[tuple[set[int], Exact]] = []
        for key, p in a.items():
            factors = {k for k, _ in key}
            joined: Exact = {key: p}
            rest = []
            for other, part in parts:
                if other & factors:
                    factors |= other
                    joined |= part
                else:
                    rest.append((other, part))
            parts = [*rest, (factors, joined)]
        return [part for _, part in parts]

    # Everything else is opaque

    def operation(self, op: str) -> Callable[..., Exact]:
        handler = self.opaque.handler(op)
        if handler is None:
            return super().operation(op)

        return lambda *args: self._recorded(lambda: handler(*args))

    def _recorded(self, work: Callable[[], Exact]) -> Exact:
        """The result of an opaque operation; what it inverts on the way is its own affair."""
        before = len(self.recording.inverses)
        result = work()
        del self.recording.inverses[before:]
        self.recording.results.append(result)
        return result

    def pow_(self, a: Exact, b: Exact) -> Exact:
        """a**b: repeated multiplication for an integer b, else symctrl.domains.opaque."""
        exponent = self.rational(b)
        if exponent is not None and exponent.denominator == 1:
            if exponent == 2:
                self._note_square(a)
            return self.power(a, int(exponent))
        return self._recorded(lambda: self.opaque.power(a, b))

    def fmin_(self, a: Exact, b: Exact) -> Exact:
        """(a + b - |a - b|)/2."""
        return self._extreme(a, b, -1)

    def fmax_(self, a: Exact, b: Exact) -> Exact:
        """(a + b + |a - b|)/2."""
        return self._extreme(a, b, 1)

    def _extreme(self, a: Exact, b: Exact, side: int) -> Exact:
        apart = self.operation("FABS")(self.sub_(a, b))
        total = self.add_(self.add_(a, b), self.scaled(apart, Fraction(side)))
        return self.scaled(total, Fraction(1, 2))

    def asinh_(self, a: Exact) -> Exact:
        """log(a + root(a² + 1))."""
        return self._log_with_root(a, 1)

    def acosh_(self, a: Exact) -> Exact:
        """log(a + root(a² - 1))."""
        return self._log_with_root(a, -1)

    def _log_with_root(self, a: Exact, side: int) -> Exact:
        under = self.add_(self.mul_(a, a), self.constant(Fraction(side)))
        return self.operation("LOG")(self.add_(a, self.operation("SQRT")(under)))

    def atanh_(self, a: Exact) -> Exact:
        """log((1 + a)/(1 - a))/2."""
        one = self.constant(Fraction(1))
        ratio = self.mul_(self.add_(one, a), self.inv_(self.sub_(one, a)))
        return self.scaled(self.operation("LOG")(ratio), Fraction(1, 2))

    def sinh_(self, a: Exact) -> Exact:
        return self._half_difference(a, -1)

    def cosh_(self, a: Exact) -> Exact:
        return self._half_difference(a, 1)

    def _half_difference(self, a: Exact, side: int) -> Exact:
        e = self.operation("EXP")(a)
        return self.scaled(self.add_(e, self.scaled(self.inv_(e), Fraction(side))), Fraction(1, 2))

    def divided(self) -> set[int]:
        """The factors that something was divided by, which are not zero on the domain."""
        found = {k for _, key in self.recording.inverses for k, _ in key}
        return found | {k for value in self.recording.results for key in value for k, _ in key}

    def proof_json(self) -> dict[str, Any]:
        """Generators, factors that something was divided by, each distinct inverse and opaque result once."""
        divided = self.divided()
        place = {k: n for n, k in enumerate(sorted(divided))}
        inverses = [
            {"inverse": [str(c), [[place[k], e] for k, e in key]]} for c, key in self.recording.inverses
        ]
        results = [{"is": self.field.value_json(value, place)} for value in self.recording.results]
        return {
            "generators": self.field.generators_json(place),
            "factors": [self.field.json(self.field.factors[k]) for k in sorted(divided)],
            "hints": _distinct(inverses) + _distinct(results),
        }


def _distinct(entries: list[dict[str, Any]]) -> list[dict[str, Any]]:
    kept: list[dict[str, Any]] = []
    for entry in entries:
        if entry not in kept:
            kept.append(entry)
    return kept
