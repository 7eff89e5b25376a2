"""The equations that a problem assumes, completed so that rewriting by leading monomials decides membership.

Buchberger's algorithm (Cox, Little and O'Shea, Ideals, Varieties, and Algorithms, chapter 2) on the assumed
equations, with the cofactors of each new equation over them: the kernel checks these and takes the equation
as one more relation.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from symctrl.domains.field import Field, Poly

MAX_PAIRS = 120
MAX_TERMS = 80
MAX_NEW = 24

Monomial = tuple[int, ...]


@dataclass(frozen=True)
class Derived:
    """An equation that follows: polynomial = sum of cofactors[k] * (assumed equation k)."""

    polynomial: Poly
    cofactors: tuple[Poly, ...]


def completed(field: Field, zeros: list[Poly]) -> list[Derived]:
    """New equations that complete the assumed ones; none if they are complete or the work is too much."""
    one, nothing = field.polynomial(1), field.polynomial(0)
    basis = [
        Derived(p, tuple(one if n == k else nothing for n in range(len(zeros)))) for k, p in enumerate(zeros)
    ]
    pairs = [(a, b) for b in range(len(basis)) for a in range(b)]
    found: list[Derived] = []
    for count, (a, b) in enumerate(pairs):
        if count == MAX_PAIRS or len(found) == MAX_NEW:
            return []
        made = _s_polynomial(field, basis[a], basis[b])
        if made is None:
            continue
        rest = _reduced(made, basis)
        if rest.polynomial.is_zero():
            continue
        if len(rest.polynomial) > MAX_TERMS or rest.polynomial.is_constant():
            return []
        pairs += [(n, len(basis)) for n in range(len(basis))]
        basis.append(rest)
        found.append(rest)
    return found


def _s_polynomial(field: Field, f: Derived, g: Derived) -> Derived | None:
    """The combination in which the leading terms cancel; None where the leading monomials are coprime."""
    a, b = _lead(f.polynomial), _lead(g.polynomial)
    if not any(x and y for x, y in zip(a, b, strict=True)):
        return None
    common = [max(x, y) for x, y in zip(a, b, strict=True)]
    left, right = (
        _monomial(field, [c - x for c, x in zip(common, lead, strict=True)]) / p.leading_coefficient()
        for lead, p in ((a, f.polynomial), (b, g.polynomial))
    )
    cofactors = tuple(left * x - right * y for x, y in zip(f.cofactors, g.cofactors, strict=True))
    return Derived(left * f.polynomial - right * g.polynomial, cofactors)


def _reduced(made: Derived, basis: list[Derived]) -> Derived:
    p, cofactors = made.polynomial, list(made.cofactors)
    while True:
        before = p
        for element in basis:
            quotient, p = divmod(p, element.polynomial)
            if not quotient.is_zero():
                cofactors = [c - quotient * e for c, e in zip(cofactors, element.cofactors, strict=True)]
        if p == before:
            return Derived(p, tuple(cofactors))


def _lead(p: Poly) -> Monomial:
    return tuple(map(int, next(iter(p.monoms()))))


def _monomial(field: Field, exponents: list[int]) -> Any:
    return field.context.from_dict({tuple(exponents): 1})
