"""Equations: left minus right is zero on the domain, decided in the exact domain.

Sums over neighbours are polynomials in sums of monomials, so that what belongs to one node is an identity of
its own. The sum over all nodes of c(i) times a sum over the neighbours j of u(j) is a sum over all edges,
each taken in both
directions: it vanishes for every undirected graph if c(i) u(j) + c(j) u(i) does for a generic edge.
"""

from __future__ import annotations

from symctrl.decide.session import Session
from symctrl.domains.field import Exact
from symctrl.problem import star


def residuals(session: Session) -> list[Exact]:
    """Left minus right of each entry of the claim."""
    outputs = session.claim()
    half = len(outputs) // 2
    return [session.domain.sub_(a, b) for a, b in zip(outputs[:half], outputs[half:], strict=True)]


def vanishes(session: Session, value: Exact) -> bool:
    """Is the value zero on the domain, for every graph where it has sums?"""
    domain = session.domain
    if domain.is_zero(value):
        return True
    coefficients = _of_totals(session, value)
    if not coefficients:
        return False
    ends = [(_at_node(session, coefficients, node), node) for node in ("i", "j")]
    if domain.is_zero(ends[0][0]):
        return True
    edge: Exact = {}
    for end, node in ends:
        part = _along_edge(session, end, node)
        if part is None:
            return False
        edge = domain.add_(edge, part)
    return domain.is_zero(edge)


def _of_totals(session: Session, value: Exact) -> dict[int, Exact] | None:
    """The coefficients of a linear combination of totals, which belong to no node; None where it is none."""
    parts = _linear_parts(session, value, set(session.totals))
    if parts is None or not session.domain.is_zero(parts[0]):
        return None
    field = session.domain.field
    if any(field.letters(k) for c in parts[1].values() for p in c.values() for k in field.occurring(p)):
        return None
    return parts[1]


def _at_node(session: Session, coefficients: dict[int, Exact], node: str) -> Exact:
    """The combination of what the totals sum, at one node."""
    total: Exact = {}
    for k, c in sorted(coefficients.items()):
        name, order, law = session.totals[k]
        of = session.problem.names[star(name)].of
        assert of is not None
        term = session.environment.output(of, {"i": node}, order, law)
        for _ in range(order):
            term = term.derivative if term.derivative is not None else {}
        total = session.domain.add_(total, session.domain.mul_(c, term))
    return total


def _along_edge(session: Session, value: Exact, node: str) -> Exact | None:
    """A value at a node that is linear in sums over its neighbours, each replaced by its term; None where it
    is not.
    """
    field, domain = session.domain.field, session.domain
    sums = {k for k, g in enumerate(field.generators) if g.kind == "sum" and g.name == node}
    parts = _linear_parts(session, value, sums)
    if parts is None or not domain.is_zero(parts[0]):
        return None
    edge: Exact = {}
    for k, c in sorted(parts[1].items()):
        edge = domain.add_(edge, domain.mul_(c, domain.polynomial(field.generators[k].argument)))
    return edge


def _linear_parts(session: Session, value: Exact, wanted: set[int]) -> tuple[Exact, dict[int, Exact]] | None:
    """The part free of the wanted generators and the coefficient of each; None where they occur otherwise
    than linearly.
    """
    field = session.domain.field
    columns = {field.size - 1 - k: k for k in wanted}
    value = session.domain.simplified(value)
    if _hidden(session, value) & wanted:
        return None
    parts: dict[int, dict[tuple[tuple[int, int], ...], dict[tuple[int, ...], object]]] = {}
    for key, p in value.items():
        for exponents, c in p.terms():
            present = [v for v in columns if exponents[v]]
            if len(present) > 1 or any(exponents[v] > 1 for v in present):
                return None
            lowered = list(exponents)
            for v in present:
                lowered[v] = 0
            k = columns[present[0]] if present else -1
            parts.setdefault(k, {}).setdefault(key, {})[tuple(lowered)] = c
    made = {k: {key: field.context.from_dict(p) for key, p in groups.items()} for k, groups in parts.items()}
    return made.pop(-1, {}), made


def _hidden(session: Session, value: Exact) -> set[int]:
    """Generators in denominators, and those that opaque generators of the value are made of."""
    field = session.domain.field
    inside: set[int] = set()
    waiting = [g for p in value.values() for g in field.occurring(p)]
    for key in value:
        for f, _ in key:
            inside |= field.occurring(field.factors[f])
    waiting += list(inside)
    while waiting:
        g = waiting.pop()
        if field.generators[g].kind == "sum":
            continue
        for k in field.made_of(g) - inside:
            inside.add(k)
            waiting.append(k)
    return inside
