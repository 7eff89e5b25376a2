"""The values that a counterexample brings, by scalar, completed by those of the study."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from difflib import get_close_matches
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from symctrl.counterexample import Counterexample
from symctrl.entries import component_names
from symctrl.expr import SCALAR, Expr
from symctrl.kernel.certificate import at_node, per_node
from symctrl.kernel.place import free_scalars, is_fleet
from symctrl.kernel.values import Statement
from symctrl.problem import split

if TYPE_CHECKING:
    from symctrl.study import Study


class NoCounterexample(ValueError):  # noqa: N818
    """Why what is offered is none."""


def values_of(study: Study, statement: Statement, offered: Counterexample) -> dict[str, Any]:
    """The value of every free scalar at its node, a number or a function. Raises NoCounterexample."""
    nodes = list(dict.fromkeys(node for edge in offered.graph for node in edge))
    if is_fleet(statement) != bool(nodes):
        wanted = (
            "a fleet's needs a graph, like graph='path:2'" if not nodes else "without a fleet has no graph"
        )
        raise NoCounterexample(f"a counterexample {wanted}")
    given: dict[str, Any] = {}
    for name, value in offered.values.items():
        given |= dict(_entries(study, name, value, nodes))
    law = statement.claim.law
    ruled = statement.laws[law] if law is not None else {}
    for name in given:
        if star_at(name, nodes) in ruled:
            raise NoCounterexample(f"{name} is given by the law {law}, and takes no value")
    known = study.all_values()
    found = {}
    for key in free_scalars(statement):
        for name in [at_node(key, node) for node in nodes] if per_node(key) else [key]:
            found[name] = given.get(name, known.get(name))
    missing = [name for name, value in found.items() if value is None]
    if missing:
        raise NoCounterexample(f"no value is given for {', '.join(missing)}")
    return found


def star_at(name: str, nodes: Sequence[str]) -> str:
    base, node, index = split(name)
    return f"{base}.*{index}" if node in nodes else name


def _entries(study: Study, name: str, value: Expr, nodes: Sequence[str]) -> Iterator[tuple[str, Any]]:
    """The components of a symbol, or one component `x[1]`, with their values."""
    base, node, index = split(name)
    key = base if node is None else f"{base}.*"
    declared = study.symbols.get(key)
    if declared is None or (node is not None and node not in nodes):
        known = [n.replace(".*", f".{nodes[0]}") if nodes else n for n in study.symbols]
        near = get_close_matches(name, known, 3, 0.4) or known[:8]
        raise NoCounterexample(f"{name} is no symbol of {study.name}; it has {', '.join(near)}")
    whole = base if node is None else f"{base}.{node}"
    names = component_names(whole, declared.expr.shape, declared.expr.args[2])
    if index:
        names = tuple(n for n in dict.fromkeys(names) if n == name)
    if len(names) != len(value.entries):
        many = "1 component" if len(names) == 1 else f"{len(names)} components"
        raise NoCounterexample(f"{name} has {many}, and {len(value.entries)} values were given")
    found: dict[str, Any] = {}
    for k, one in enumerate(names):
        entry: Any = value.entries[k]
        number = entry if isinstance(entry, Fraction) else _component(value, k)
        if number is None:
            raise NoCounterexample(f"{name} is a matrix, and its value is not one of exact numbers")
        if isinstance(number, Fraction) and found.setdefault(one, number) != number:
            raise NoCounterexample(f"{name} is symmetric, and the two values of {one} differ")
        yield one, number


def _component(value: Expr, k: int) -> Expr | None:
    if value.shape == SCALAR:
        return value
    return value[k] if value.shape[1] == 1 else None
