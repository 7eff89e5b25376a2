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
    """A = sum of g P, known g >= 0, P assumed or rational and semidefinite; None where it is not shown.

    A known g may take the place of a monomial.
    """
    assumed, rest, definite = _without_assumed(session, rows)
    parts = _parts(rest)
    if parts is None:
        return None
    for chosen in _substituted(session, parts):
        found = _leaf(session, chosen)
        if found is not None and (definite or found[1] or not strict) and assumed + found[0]:
            return {"sum": assumed + found[0]}
    return None


def _without_assumed(session: Session, rows: list[list[Exact]]) -> tuple[list[Any], list[list[Exact]], bool]:
    """What is left after taking away multiples of assumed matrices that occur as a whole, and these parts.

    The last says whether one of them is definite and its multiple positive.
    """
    found, definite = [], False
    field, n = session.domain.field, len(rows)
    multiples = [field.polynomial(1)]
    signs = session.domain.signs.generator
    multiples += [field.variable(k) for k, sign in signs.items() if sign == "positive"]
    for k, assumption in enumerate(session.problem.given):
        if assumption.size != n or not assumption.kind.startswith("positive_"):
            continue
        matrix = [[session.at(assumption.of[r + n * c], {"i": "i"}) for c in range(n)] for r in range(n)]
        for g in multiples:
            left = _less(session, rows, matrix, g)
            if _terms(left) == _terms(rows) - _terms(matrix):
                rows = left
                found.append({"of": field.json(g), "given": k})
                definite = definite or assumption.kind == "positive_definite"
                break
    return found, rows, definite


def _less(session: Session, rows: list[list[Exact]], matrix: list[list[Exact]], g: Poly) -> list[list[Exact]]:
    domain, factor = session.domain, session.domain.polynomial(g)
    return [
        [domain.sub_(a, domain.mul_(factor, b)) for a, b in zip(row, other, strict=True)]
        for row, other in zip(rows, matrix, strict=True)
    ]


def _terms(rows: list[list[Exact]]) -> int:
    return sum(len(p) for row in rows for entry in row for p in entry.values())


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
    """The parts as they are, then with each known polynomial in the place of one of its terms."""
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


def _leaf(session: Session, chosen: list[tuple[Poly, Rows]]) -> tuple[list[Any], bool] | None:
    """The parts of a sum, and whether one is certainly definite; None where one is not semidefinite."""
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
    return found, definite


def _texts(rows: Rows) -> list[list[str]]:
    return [[str(x) for x in row] for row in rows]
