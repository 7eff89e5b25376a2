"""Equations: left minus right is zero on the domain, decided in the exact domain.

In a fleet the claim holds for every undirected graph if it holds for a generic node and edge: the sum over all nodes of
sums over their neighbours is the sum over all edges, each taken in both directions.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from symctrl.decide.session import Session
from symctrl.domains.field import Exact, Key
from symctrl.problem import star

EDGE = {"i": "i", "j": "j"}
REVERSED = {"i": "j", "j": "i"}


def residuals(session: Session) -> list[Exact]:
    """Left minus right of each entry of the claim."""
    outputs = session.claim()
    half = len(outputs) // 2
    return [session.domain.sub_(a, b) for a, b in zip(outputs[:half], outputs[half:], strict=True)]


def vanishes(session: Session, value: Exact) -> bool:
    """Is the value zero on the domain, for every graph where it has sums?"""
    if session.domain.is_zero(value):
        return True
    totals = [k for k in session.sums if _is_total(session, k)]
    parts = _by_sums(session, value, totals)
    if parts is None:
        return False
    rest, linear = parts
    if not linear:
        return _vanishes_on_edge(session, [(value, EDGE)])
    if not session.domain.is_zero(rest) or any(_at_a_node(session, c) for c in linear.values()):
        return False
    node = _recombined(session, linear, {"i": "i"})
    if session.domain.is_zero(node):
        return True
    return _vanishes_on_edge(session, [(node, EDGE), (_recombined(session, linear, {"i": "j"}), REVERSED)])


def _vanishes_on_edge(session: Session, ends: Sequence[tuple[Exact, dict[str, str]]]) -> bool:
    """The parts free of sums are zero, and the linear ones add up to zero over the ends of the generic edge."""
    domain = session.domain
    edge: Exact = {}
    for value, binding in ends:
        here = [k for k, (name, _, _) in session.sums.items() if f".{binding['i']}" in name]
        parts = _by_sums(session, value, here)
        if parts is None or not domain.is_zero(parts[0]):
            return False
        edge = domain.add_(edge, _recombined(session, parts[1], binding))
    return domain.is_zero(edge)


def _recombined(session: Session, linear: dict[int, Exact], binding: dict[str, str]) -> Exact:
    """The linear combination with each sum replaced by what it sums."""
    total: Exact = {}
    for k, c in sorted(linear.items()):
        total = session.domain.add_(total, session.domain.mul_(c, _summand(session, k, binding)))
    return total


def _summand(session: Session, k: int, binding: dict[str, str]) -> Exact:
    """What a sum's generator sums: the summand, or its derivative of the generator's order."""
    name, order, law = session.sums[k]
    meaning = session.problem.names[star(name)]
    assert meaning.of is not None
    value = session.environment.output(meaning.of, binding, order, law)
    for _ in range(order):
        value = value.derivative if value.derivative is not None else {}
    result: Exact = value
    return result


def _by_sums(session: Session, value: Exact, sums: Sequence[int]) -> tuple[Exact, dict[int, Exact]] | None:
    """The part free of the sums and the coefficient of each; None where they occur otherwise than linearly."""
    field, domain = session.domain.field, session.domain
    columns = {field.size - 1 - k: k for k in sums}
    value = domain.simplified(value)
    if _hidden(session, value) & set(sums):
        return None
    parts: dict[int, dict[Key, dict[tuple[int, ...], Any]]] = {}
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
    waiting = [g for p in value.values() for g in field.occurring(p) if field.generators[g].kind != "free"]
    for key in value:
        for f, _ in key:
            occurring = field.occurring(field.factors[f])
            inside |= occurring
            waiting += list(occurring)
    while waiting:
        for g in field.made_of(waiting.pop()) - inside:
            inside.add(g)
            waiting.append(g)
    return inside


def _at_a_node(session: Session, value: Exact) -> bool:
    """Does the value speak of anything at a node?"""
    field = session.domain.field
    used = {g for p in value.values() for g in field.occurring(p)} | _hidden(session, value)
    return any("." in field.generators[k].name for k in used if field.generators[k].kind == "free")


def _is_total(session: Session, k: int) -> bool:
    return session.problem.names[star(session.sums[k][0])].is_ == "total"
