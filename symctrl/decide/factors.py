"""A sign by factors and by parts: what is known of a product from its factors, of a sum from its summands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from symctrl.decide.session import Session
from symctrl.domains.field import Poly

Term = list[Any]  # [number, factors, squares], as in docs/certificates.md
MAX_REPEATED = 4
SIGNED = ("positive", "nonnegative")


def as_product(session: Session, p: Poly, strict: bool) -> list[Term] | None:
    """p as one product of factors of known sign and squares; None where it is no such product."""
    field = session.domain.field
    c, exponents = session.domain.factor_polynomial(p)
    known: list[Any] = []
    squares: list[Any] = []
    for k, e in sorted(exponents.items()):
        side = _side(session, k) if e % 2 else 1
        f = field.factors[k] * side
        c *= side
        certain = _certain(session, f, k, e, strict)
        if certain is None:
            return None
        known += [field.json(f)] * certain
        if e > certain:
            squares.append(field.json(f ** (e // 2)))
    return [[str(c), known, squares]] if c > 0 else None


def _side(session: Session, k: int) -> int:
    """-1 where a factor is known never to be positive."""
    f, of = session.domain.field.factors[k], session.domain.signs.of
    return -1 if of(f) not in SIGNED and of(-f) in SIGNED else 1


def _certain(session: Session, f: Poly, k: int, e: int, strict: bool) -> int | None:
    """How often f, a factor or minus it, is written by its sign, the rest of its power being a square; None
    where the sign of the power is not known.
    """
    sign = session.domain.signs.of(f)
    if e % 2 and not (sign == "positive" or (sign == "nonnegative" and not strict)):
        return None
    not_zero = e % 2 or sign in ("positive", "nonzero") or k in session.domain.divided()
    if strict and not not_zero:
        return None
    return e if strict and sign == "positive" and e <= MAX_REPEATED else e % 2


@dataclass(frozen=True)
class Opened:
    """A polynomial as a positive number times factors of known sign, times squares, times what is left."""

    number: Any
    factors: list[Any]
    squares: list[Any]
    left: Poly

    def around(self, terms: Sequence[Term]) -> list[Term]:
        """The terms of what is left, with all that stands before it."""
        return [
            [str(Fraction(w) * self.number), [*self.factors, *given], [*self.squares, *own]]
            for w, given, own in terms
        ]


def opened(session: Session, p: Poly) -> Opened | None:
    """The factors of known sign and the squares taken out; None where nothing is, or nothing is left."""
    field, signs = session.domain.field, session.domain.signs
    c, exponents = session.domain.factor_polynomial(p)
    outside: list[Any] = []
    squares: list[Any] = []
    left = field.polynomial(1 if c > 0 else -1)
    for k, e in sorted(exponents.items()):
        f = field.factors[k]
        if signs.of(f) in SIGNED:
            outside += [field.json(f)] * e
            continue
        squares += [field.json(f ** (e // 2))] if e > 1 else []
        left = left * f if e % 2 else left
    if not (outside or squares) or left.is_constant():
        return None
    return Opened(abs(c), outside, squares, left)


def parts_of(session: Session, p: Poly) -> list[Poly]:
    """Parts that share no symbol of unknown sign; none where there is only one."""
    field = session.domain.field
    groups: list[tuple[set[int], dict[tuple[int, ...], Any]]] = []
    for exponents, c in p.terms():
        open_ = _open(session, {field.size - 1 - v for v, e in enumerate(exponents) if e})
        merged = {tuple(map(int, exponents)): c}
        rest = []
        for own, terms in groups:
            if own & open_ or (not own and not open_):
                open_ |= own
                merged |= terms
            else:
                rest.append((own, terms))
        groups = [*rest, (open_, merged)]
    return [field.context.from_dict(terms) for _, terms in groups] if len(groups) > 1 else []


def _open(session: Session, generators: set[int]) -> set[int]:
    """Those of unknown sign among generators and what they are made of, numbers of neighbours aside."""
    field, signs = session.domain.field, session.domain.signs
    made_of = (field.made_of(k) for k in generators if field.generators[k].kind != "sum")
    whole = generators.union(*made_of)
    return {k for k in whole if signs.generator.get(k) not in SIGNED and not _is_degree(session, k)}


def _is_degree(session: Session, k: int) -> bool:
    """Is the generator a number of neighbours, which ties no symbols together?"""
    g = session.domain.field.generators[k]
    return g.kind == "sum" and bool(g.argument.is_constant())


def is_tied(session: Session, p: Poly) -> bool:
    """Does an assumption speak of a symbol of unknown sign in p, or is there a part without one?

    If not, the sum of the parts is negative somewhere where one of them is.
    """
    field, signs = session.domain.field, session.domain.signs
    open_ = {k for k in field.occurring(p) if signs.generator.get(k) not in SIGNED}
    spoken = [*field.relations, *(fact for fact, _ in signs.facts)]
    alone = any(not any(e[field.size - 1 - k] for k in open_) for e in p.monoms())
    return alone or any(field.occurring(q) & open_ for q in spoken)
