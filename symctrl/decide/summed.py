"""The sign of a sum over all nodes: a combination of sums that are assumed not to be negative.

Sums are compared as `identity` does: what belongs to a node by itself, and what a node and a neighbour share
summed over both directions of an edge.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations_with_replacement
from typing import Any

from symctrl.decide.factors import Term
from symctrl.decide.identity import _at_node, _of_totals, vanishes
from symctrl.decide.programme import weights_of
from symctrl.decide.session import Session
from symctrl.domains.field import Exact, Poly
from symctrl.problem import star

Row = tuple[Any, ...]
MAX_FACTORS = 2  # positive constants that an assumption is taken times


def terms_of_totals(session: Session, value: Exact) -> list[Term] | None:
    """The terms of a combination of assumed sums that is the value, for every graph; None if none is."""
    if vanishes(session, value):
        return []
    domain = session.domain
    p = session.carrier(value)
    target = _rows(session, p)
    if target is None:
        return None
    found = list(_candidates(session))
    columns = [_rows(session, q) for q, _ in found]
    usable = [n for n, column in enumerate(columns) if column is not None]
    chosen = weights_of([columns[n] or {} for n in usable], target, [1.0] * len(usable))
    if chosen is None:
        return None
    terms: list[Term] = []
    left = domain.polynomial(p)
    for n, weight in chosen:
        q, given = found[usable[n]]
        terms.append([str(weight), given, []])
        left = domain.sub_(left, domain.mul_(domain.constant(weight), domain.polynomial(q)))
    return terms if vanishes(session, left) else None


def _candidates(session: Session) -> Iterator[tuple[Poly, list[Any]]]:
    """Each assumed sum times products of constants that are positive, with its factors as in a term."""
    field, scalars = session.domain.field, session.problem.scalars
    positive = [
        field.variable(k)
        for k, g in enumerate(field.generators)
        if g.kind == "free"
        and scalars.get(star(g.name)) == "parameter"
        and session.domain.signs.generator.get(k) == "positive"
    ]
    for k, assumption in enumerate(session.problem.given):
        if assumption.kind not in ("positive", "nonnegative"):
            continue
        p = session.carrier(session.at(assumption.of[0], {"i": "i"}))
        if not field.occurring(p) & session.totals.keys():
            continue
        for size in range(MAX_FACTORS + 1):
            for factors in combinations_with_replacement(positive, size):
                product = p
                for factor in factors:
                    product = product * factor
                yield product, [k, *map(field.json, factors)]


def _rows(session: Session, p: Poly) -> dict[Row, Any] | None:
    """The coefficients of a combination of sums; two that are equal for every graph have the same."""
    coefficients = _of_totals(session, session.domain.polynomial(p))
    if not coefficients:
        return None
    rows: dict[Row, Any] = {}
    for node in ("i", "j"):
        for key, q in session.domain.simplified(_at_node(session, coefficients, node)).items():
            for row, c in _split(session, q, node):
                rows[key, *row] = rows.get((key, *row), 0) + c
    return {row: c for row, c in rows.items() if c != 0}


def _split(session: Session, q: Poly, node: str) -> Iterator[tuple[Row, Any]]:
    """What is linear in sums over the neighbours, by the terms of an edge; all else as it is, at i alone."""
    field = session.domain.field
    sums = {k for k, g in enumerate(field.generators) if g.kind == "sum" and g.name == node}
    for exponents, c in q.terms():
        inside = [k for k in sums if exponents[field.size - 1 - k]]
        if len(inside) != 1 or exponents[field.size - 1 - inside[0]] != 1:
            if node == "i":
                yield ("node", *map(int, exponents)), c
            continue
        rest = list(exponents)
        rest[field.size - 1 - inside[0]] = 0
        edge = field.context.from_dict({tuple(rest): c}) * field.generators[inside[0]].argument
        for more, d in field.normal(edge).terms():
            yield ("edge", *map(int, more)), d
