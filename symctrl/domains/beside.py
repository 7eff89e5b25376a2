"""Signs that the definitions of generators give to polynomials beside them: what the kernel knows of them too
(`symctrl.kernel.beside` states the theorems).
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations

from symctrl.domains.field import Exact, Field, Poly, merged

BOUNDS = {"tanh": Fraction(1), "erf": Fraction(1), "atan": Fraction(11, 7), "asin": Fraction(11, 7)}
SIDES = {"tanh": 1, "atan": 1, "asin": -1}  # 1: flatter than its argument, -1: steeper


def not_negative(field: Field, k: int) -> Iterator[tuple[Poly, bool]]:
    """Polynomials that are not negative; True where they are certainly positive."""
    g, own, one = field.generators[k], field.variable(k), field.polynomial(1)
    if g.kind in ("abs", "sign"):
        size, inner = (own, g.argument) if g.kind == "abs" else (one, own)
        yield from ((size - inner, False), (size + inner, False))
    elif g.kind == "function" and g.name in BOUNDS:
        bound = field.polynomial(BOUNDS[g.name])
        yield from ((bound + own, True), (bound - own, True))
    elif g.kind in ("exp", "sin") or (g.kind == "function" and g.name == "log"):
        a = _polynomial(field, g.argument[0] if g.kind == "function" else g.argument)
        if a is not None:
            yield {"exp": own - one - a, "sin": a * a - own * own}.get(g.kind, a - one - own), False


def pairs_of_one_sign(field: Field, k: int) -> Iterator[tuple[Poly, Poly]]:
    """Pairs of polynomials of one sign, of which none is zero alone."""
    g, own, one = field.generators[k], field.variable(k), field.polynomial(1)
    found: list[Poly] = []
    if g.kind == "function" and g.name in BOUNDS:
        found = [own, carrier(field, g.argument[0])]
        a = _polynomial(field, g.argument[0])
        if a is not None and g.name in SIDES:
            found.append((a - own) * field.polynomial(SIDES[g.name]))
    elif g.kind == "function" and g.name == "log":
        found = [own, carrier(field, g.argument[0], less=1)]
    elif g.kind == "exp":
        found = [own - one, carrier(field, g.argument)]
    return combinations([p for p in found if not p.is_zero()], 2)


def differences(field: Field, p: Poly, k: int) -> Iterator[tuple[Poly, Poly]]:
    """f a - f b and a - b, for generator k and a later one of the same increasing function in p."""
    g = field.generators[k]
    for j in sorted(field.occurring(p)) if g.kind == "function" and g.name in {*BOUNDS, "log"} else ():
        h = field.generators[j]
        if j > k and h.kind == "function" and h.name == g.name:
            less = {key: -q for key, q in h.argument[0].items()}
            apart = merged([*g.argument[0].items(), *less.items()])
            yield field.variable(k) - field.variable(j), carrier(field, apart)


def conjugate(field: Field, p: Poly, k: int) -> tuple[Poly, Poly, Poly, Poly] | None:
    """(c, r, c n - r, c^2 B - r^2) where p = c n + r for n = |b| with B = b^2 or a square root n of B."""
    g, n = field.generators[k], field.variable(k)
    if not (g.kind == "abs" or (g.kind == "root" and g.degree == 2)) or p.degrees()[field.size - 1 - k] != 1:
        return None
    c, r = divmod(p, n)
    square = g.argument * g.argument if g.kind == "abs" else g.argument
    return c, r, c * n - r, c * c * square - r * r


def _polynomial(field: Field, a: Exact) -> Poly | None:
    """The argument, if it divides by nothing."""
    return a.get((), field.polynomial(0)) if set(a) <= {()} else None


def carrier(field: Field, a: Exact, less: int = 0) -> Poly:
    """A polynomial with the sign of the argument less a number: over all denominators, of even exponent."""
    below = field.polynomial(1)
    for f, e in {f: max(dict(key).get(f, 0) for key in a) for key in a for f, _ in key}.items():
        below = below * field.factors[f] ** e
    total = -below * field.polynomial(less)
    for key, p in a.items():
        over = below
        for f, e in key:
            over = over / field.factors[f] ** e
        total = total + p * over
    for f in {f for key in a for f, _ in key}:
        if max(dict(key).get(f, 0) for key in a) % 2:
            total = total * field.factors[f]
    return total
