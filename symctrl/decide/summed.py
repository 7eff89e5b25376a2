"""The sign of a sum over all nodes: a combination of sums that are assumed not to be negative.

Sums are compared as `identity` does: what belongs to a node by itself, and what a node and a neighbour share
summed over both directions of an edge.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import reduce
from itertools import combinations_with_replacement
from operator import mul
from typing import Any

from symctrl.decide.factors import Term
from symctrl.decide.identity import _at_node, _of_totals, vanishes
from symctrl.decide.programme import weights_of
from symctrl.decide.session import Session, exactly
from symctrl.domains.field import Exact, Poly
from symctrl.problem import Problem, star

Row = tuple[Any, ...]
MAX_FACTORS = 2  # positive constants that an assumption is taken times


def terms_of_totals(session: Session, value: Exact) -> list[Term] | None:
    """The terms of a combination of assumed sums that is the value, for every graph; None if none is.

    It is looked for in a session of its own, for a proof has only what its check evaluates.
    """
    field = session.domain.field
    at = {g.name: k for k, g in enumerate(field.generators) if g.kind == "free"}
    found = exactly(session.problem, _weights) if _assumes_sums(session.problem) else []
    terms: list[Term] = []
    left = session.domain.polynomial(session.carrier(value))
    for weight, k, names in found:
        factors = [field.variable(at[name]) for name in names]
        product = reduce(mul, factors, _assumed(session, k)) * field.polynomial(weight)
        terms.append([str(weight), [k, *map(field.json, factors)], []])
        left = session.domain.sub_(left, session.domain.polynomial(product))
    return terms if vanishes(session, left) else None


def _assumes_sums(problem: Problem) -> bool:
    """Does an assumption speak of sums, and the claim have one value?"""
    totals = {name for name, meaning in problem.names.items() if meaning.is_ == "total"}
    one = len(problem.listings[problem.claim.listing].outputs) == 1
    return one and any(totals & set(problem.listings[of[0]].inputs) for a in problem.given for of in a.of)


def _weights(session: Session) -> list[tuple[Fraction, int, tuple[str, ...]]]:
    """The assumed sums, by number, that add up to the claim, each with its weight and the constants that it
    is taken times; none where they do not.
    """
    (value,) = session.claim()
    target = _rows(session, session.carrier(value))
    if target is None:
        return []
    found = [(_rows(session, q), k, names) for q, k, names in _candidates(session)]
    usable = [one for one in found if one[0] is not None]
    chosen = weights_of([column or {} for column, _, _ in usable], target, [1.0] * len(usable))
    return [(weight, *usable[n][1:]) for n, weight in chosen or ()]


def _assumed(session: Session, k: int) -> Poly:
    return session.carrier(session.at(session.problem.given[k].of[0], {"i": "i"}))


def _candidates(session: Session) -> Iterator[tuple[Poly, int, tuple[str, ...]]]:
    """Each assumed sum times products of constants that are positive, by their names."""
    field, scalars = session.domain.field, session.problem.scalars
    positive = [
        g.name
        for k, g in enumerate(field.generators)
        if g.kind == "free"
        and scalars.get(star(g.name)) == "parameter"
        and session.domain.signs.generator.get(k) == "positive"
    ]
    at = {g.name: k for k, g in enumerate(field.generators) if g.kind == "free"}
    for k, assumption in enumerate(session.problem.given):
        if assumption.kind not in ("positive", "nonnegative"):
            continue
        p = _assumed(session, k)
        if not field.occurring(p) & session.totals.keys():
            continue
        for size in range(MAX_FACTORS + 1):
            for names in combinations_with_replacement(positive, size):
                yield reduce(mul, (field.variable(at[name]) for name in names), p), k, names


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
