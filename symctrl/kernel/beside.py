"""Signs that the definitions of generators give to polynomials beside them.

Soundness-critical. Last reviewed 2026-11-24.

Theorems, for real numbers wherever both sides are defined:

- |p| - p >= 0 and |p| + p >= 0; 1 - s >= 0 and 1 + s >= 0 for a switch s, which has values from -1 to 1.
- -1 < tanh a < 1 and -1 < erf a < 1; -11/7 < atan a < 11/7 and -11/7 < asin a < 11/7, for pi < 22/7.
- exp a >= 1 + a and log a <= a - 1 (both sides have the same value and slope at 0 and 1, and exp is convex,
  log concave); a^2 >= sin(a)^2.
- f a has the sign of a for f = tanh, atan, erf, asin, which are odd and increase; so have a - tanh a and a -
  atan a, and asin a - a, since tanh' and atan' are below 1 and asin' is above it except at 0. exp a - 1 has
  the sign of a, and log a that of a - 1. f a - f b has the sign of a - b for each of these functions and the
  logarithm, which increase. Two numbers of one sign have a product that is not negative, positive where one
  of them is not zero.
- If p r = q, and r is not zero, p has the sign of q r.
- Let n >= 0 and n^2 = B (n = |b| with B = b^2, or n = sqrt(B)), p = c n + r and D = c^2 B - r^2, that is p
  (c n - r) = D. Where c >= 0 and D >= 0 (D > 0), p >= 0 (p > 0): (c n)^2 >= r^2 with c n >= 0 gives c n >=
  |r|. Where r >= 0 and D <= 0 (D < 0), p >= 0 (p > 0) likewise. Where c n - r > 0, p has the sign of D.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations

from symctrl.kernel.field import Field, Value
from symctrl.kernel.generators import Generator
from symctrl.kernel.polynomial import Poly, monomial, powers, variables

BOUNDS: dict[str, Fraction] = {
    "tanh": Fraction(1),
    "erf": Fraction(1),
    "atan": Fraction(11, 7),
    "asin": Fraction(11, 7),
}
FLATTER = frozenset(("tanh", "atan"))  # |f a| < |a| for a != 0
STEEPER = frozenset(("asin",))  # |f a| > |a| for a != 0


def not_negative(field: Field, k: int, g: Generator) -> Iterator[tuple[Poly, bool]]:
    """Polynomials that are not negative; True where they are certainly positive."""
    ring, own = field.ring, _own(k)
    if g.kind in ("abs", "sign") and g.base is not None:
        one: Poly = {0: 1}
        size, inner = (own, g.base) if g.kind == "abs" else (one, own)
        for side in (1, -1):
            yield ring.add(size, ring.scale(inner, side)), False
        return
    if g.kind == "function" and g.name in BOUNDS:
        for side in (1, -1):
            yield ring.add(_number(BOUNDS[g.name]), ring.scale(own, side)), True
        return
    a = _polynomial(g.args[0]) if g.args else None
    if a is None:
        return
    if g.kind == "exp":
        yield ring.add(ring.add(own, {0: -1}), ring.scale(a, -1)), False
    elif g.kind == "sin":
        yield ring.add(ring.mul(a, a), ring.scale(ring.mul(own, own), -1)), False
    elif g.kind == "function" and g.name == "log":
        yield ring.add(ring.add(a, {0: -1}), ring.scale(own, -1)), False


def pairs_of_one_sign(field: Field, k: int, g: Generator) -> Iterator[tuple[Poly, Poly]]:
    """Pairs of polynomials of one sign, of which none is zero alone."""
    ring, own = field.ring, _own(k)
    found: list[Poly] = []
    if g.kind == "function" and g.name in BOUNDS:
        found = [own, _carrier(field, g.args[0])]
        a = _polynomial(g.args[0])
        if a is not None and g.name in FLATTER | STEEPER:
            side = 1 if g.name in FLATTER else -1
            found.append(ring.scale(ring.add(a, ring.scale(own, -1)), side))
    elif g.kind == "function" and g.name == "log":
        found = [own, _carrier(field, field.add(g.args[0], field.constant(-1)))]
    elif g.kind == "exp":
        found = [ring.add(own, {0: -1}), _carrier(field, g.args[0])]
    return combinations([p for p in found if p], 2)


def differences(field: Field, p: Poly, table: list[Generator], k: int) -> Iterator[tuple[Poly, Poly]]:
    """f a - f b and a - b, for generator k and a later one of the same increasing function in p."""
    g = table[k]
    for j in sorted(variables(p)) if g.kind == "function" and g.name in {*BOUNDS, "log"} else ():
        h = table[j]
        if j > k and h.kind == "function" and h.name == g.name:
            apart = _carrier(field, field.sub(g.args[0], h.args[0]))
            yield field.ring.add(_own(k), field.ring.scale(_own(j), -1)), apart


def conjugate(field: Field, p: Poly, k: int, g: Generator) -> tuple[Poly, Poly, Poly, Poly] | None:
    """(c, r, c n - r, c^2 B - r^2) where p = c n + r for the generator n; else None."""
    ring = field.ring
    if g.base is None or not (g.kind == "abs" or (g.kind == "root" and g.number == 2)):
        return None
    c: Poly = {}
    r: Poly = {}
    for m, number in p.items():
        exponent = dict(powers(m)).get(k, 0)
        if exponent > 1:
            return None
        if exponent:
            c[m - monomial([(k, 1)])] = number
        else:
            r[m] = number
    if not c:
        return None
    square = ring.mul(g.base, g.base) if g.kind == "abs" else g.base
    other = ring.add(ring.mul(c, _own(k)), ring.scale(r, -1))
    return c, r, other, ring.add(ring.mul(ring.mul(c, c), square), ring.scale(ring.mul(r, r), -1))


def _own(k: int) -> Poly:
    return {monomial([(k, 1)]): 1}


def _number(c: Fraction) -> Poly:
    return {0: c.numerator if c.denominator == 1 else c}


def _polynomial(a: Value) -> Poly | None:
    """The argument, if it divides by nothing."""
    return a.get((), {}) if a.keys() <= {()} else None


def _carrier(field: Field, a: Value) -> Poly:
    """A polynomial with the sign of the argument: numerator times the factors of odd exponent below it."""
    numerator, key = field.fraction(a)
    return field.ring.mul(numerator, field.denominator(tuple((f, 1) for f, e in key if e % 2)))
