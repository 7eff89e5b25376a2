"""What can be offered against a theorem, as an author writes it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from symctrl.expr import Expr, lift, symbol

t = symbol("t")  # time, in closed forms of trajectories


@dataclass(frozen=True, eq=False)
class Counterexample:
    """kind: at, along, leaves, undefined, unstable or enclosed. values: by symbol, exact numbers or functions
    of time (at a node of a fleet `q.1`). graph: the edges, for a fleet. until: of a trajectory, its last
    time.
    """

    kind: str
    values: Mapping[str, Expr] = field(default_factory=dict)
    graph: tuple[tuple[str, str], ...] = ()
    until: Expr | None = None


def at(_values: Mapping[str, Any] | None = None, graph: Any = None, **values: Any) -> Counterexample:
    """A rest point: every rate is zero there, and the conclusion fails."""
    return _made("at", _values, values, graph)


def along(_values: Mapping[str, Any] | None = None, until: Any = None, **values: Any) -> Counterexample:
    """A solution in closed form: functions of `symctrl.counterexample.t`, with polynomials, exp, sin and cos.

    until: the time up to which it is a solution; all times, if left out.
    """
    return _made("along", _values, values, None, until)


def leaves(_values: Mapping[str, Any] | None = None, graph: Any = None, **values: Any) -> Counterexample:
    """A state on the boundary of the set, from which every solution leaves it."""
    return _made("leaves", _values, values, graph)


def undefined(_values: Mapping[str, Any] | None = None, graph: Any = None, **values: Any) -> Counterexample:
    """A state of the domain at which the law, or the field, has no value."""
    return _made("undefined", _values, values, graph)


def unstable(_values: Mapping[str, Any] | None = None, **values: Any) -> Counterexample:
    """A rest point at which the linearised field has an eigenvalue with a positive real part."""
    return _made("unstable", _values, values, None)


def enclosed(until: Any, _values: Mapping[str, Any] | None = None, **values: Any) -> Counterexample:
    """The solution from exact initial values, rigorously enclosed up to a time, at which the conclusion
    fails.
    """
    return _made("enclosed", _values, values, None, until)


def _made(
    kind: str, table: Mapping[str, Any] | None, values: Mapping[str, Any], graph: Any, until: Any = None
) -> Counterexample:
    merged = {**(table or {}), **values}
    return Counterexample(
        kind,
        {name: lift(value) for name, value in merged.items()},
        _edges(graph),
        None if until is None else lift(until),
    )


def _edges(graph: Any) -> tuple[tuple[str, str], ...]:
    if graph is None:
        return ()
    if isinstance(graph, str):
        from symctrl.graphs import parse

        graph = parse(graph)
    edges = graph.edges if hasattr(graph, "edges") else graph
    return tuple((str(a), str(b)) for a, b in edges)
