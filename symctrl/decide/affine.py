"""Definiteness of symbolic matrices of any size: by dominance, or as a sum of multiples of rational ones."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from symctrl.decide.combination import Known, entry_of
from symctrl.decide.definiteness import decide_matrix
from symctrl.decide.session import Session
from symctrl.domains.field import Exact, Poly

Monomial = tuple[int, ...]
Rows = list[list[Fraction]]


def by_rows(session: Session, rows: list[list[Exact]], small: str | None) -> Any:
    """Each diagonal entry exceeds the absolute values beside it (Gershgorin); None where it is not shown."""
    domain, entries = session.domain, []
    for r, row in enumerate(rows):
        left = row[r]
        for c, entry in enumerate(row):
            if c == r or not entry:
                continue
            if not domain.is_zero(domain.sub_(entry, rows[c][r])):
                return None
            side = _side(session, entry)
            if side == 0:
                return None
            left = domain.sub_(left, entry) if side > 0 else domain.add_(left, entry)
        if small is not None:
            left = lowest(session, left, small)
        proof = entry_of(session, left, True, Known())
        if proof is None:
            return None
        entries.append(proof)
    return {"rows": entries}


def by_sum(session: Session, rows: list[list[Exact]], strict: bool) -> Any:
    """A = sum of g P, known g >= 0, rational semidefinite P; a known g may take the place of a monomial."""
    parts = _parts(rows)
    if parts is None:
        return None
    for chosen in _substituted(session, parts):
        leaf = _leaf(session, chosen, strict)
        if leaf is not None:
            return leaf
    return None


def lowest(session: Session, value: Exact, small: str) -> Exact:
    """The coefficient of the lowest power of a gain in a polynomial with the sign of the value."""
    field = session.domain.field
    p = field.normal(session.carrier(value))
    if small not in field.index or p.is_zero():
        return session.domain.polynomial(p)
    column = field.size - 1 - field.index[small]
    least = min(int(exponents[column]) for exponents in p.monoms())
    kept = {
        tuple(0 if v == column else int(x) for v, x in enumerate(e)): c
        for e, c in p.terms()
        if int(e[column]) == least
    }
    return session.domain.polynomial(field.context.from_dict(kept))


def _side(session: Session, entry: Exact) -> int:
    """1 or -1 where the entry is known not to be negative or not to be positive, else 0."""
    p = session.domain.field.normal(session.carrier(entry))
    if session.domain.signs.of(p) in ("positive", "nonnegative"):
        return 1
    return -1 if session.domain.signs.of(-p) in ("positive", "nonnegative") else 0


def _parts(rows: list[list[Exact]]) -> dict[Monomial, Rows] | None:
    """The rational matrix beside each monomial; None where an entry is no polynomial."""
    n = len(rows)
    parts: dict[Monomial, Rows] = {}
    for r, row in enumerate(rows):
        for c, entry in enumerate(row):
            if set(entry) - {()}:
                return None
            for exponents, k in entry[()].terms() if entry else ():
                at = parts.setdefault(tuple(map(int, exponents)), [[Fraction(0)] * n for _ in range(n)])
                at[r][c] += Fraction(int(k.p), int(k.q))
    return parts


def _substituted(session: Session, parts: dict[Monomial, Rows]) -> Iterator[list[tuple[Poly, Rows]]]:
    """The parts as they are, then with each known polynomial in the place of one of its monomials."""
    context = session.domain.field.context
    yield [(context.from_dict({m: 1}), rows) for m, rows in parts.items()]
    for fact, kind in session.domain.signs.facts:
        terms = {tuple(map(int, e)): Fraction(int(c.p), int(c.q)) for e, c in fact.terms()}
        if kind == "nonzero" or not set(terms) <= set(parts):
            continue
        for pivot, factor in terms.items():
            changed = [(fact, [[x / factor for x in row] for row in parts[pivot]])]
            for m, rows in parts.items():
                if m != pivot:
                    share = terms.get(m, Fraction(0)) / factor
                    moved = [
                        [x - share * y for x, y in zip(a, b, strict=True)]
                        for a, b in zip(rows, parts[pivot], strict=True)
                    ]
                    changed.append((context.from_dict({m: 1}), moved))
            yield changed


def _leaf(session: Session, chosen: list[tuple[Poly, Rows]], strict: bool) -> Any:
    found, definite = [], False
    for g, rows in chosen:
        if not any(any(row) for row in rows):
            continue
        sign = session.domain.signs.of(g)
        answer = decide_matrix(rows)
        if sign not in ("positive", "nonnegative") or answer.leaf is None:
            return None
        definite = definite or (sign == "positive" and answer.definiteness == "positive definite")
        found.append({"of": session.domain.field.json(g), "rows": _texts(rows), "proof": answer.leaf})
    return {"sum": found} if found and (definite or not strict) else None


def _texts(rows: Rows) -> list[list[str]]:
    return [[str(x) for x in row] for row in rows]
