"""The graph of a witness.

Soundness-critical. Last reviewed 2026-11-24.

A fleet's claim is about every connected undirected graph without loops and repeated edges that has at
least two nodes. Relies on no theorem.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from symctrl.kernel.certificate import Declined, Invalid, typed

MAX_EDGES = 10_000
_NODE = re.compile(r"\w{1,40}")


def read_graph(value: Any) -> Mapping[str, Sequence[str]]:
    """Node to neighbours, from a list of pairs of names. Raises Invalid for what is no such graph."""
    edges = typed(value, list, "graph")
    if len(edges) > MAX_EDGES:
        raise Declined(f"a graph with more than {MAX_EDGES} edges")
    neighbours: dict[str, list[str]] = {}
    for edge in edges:
        ends = [_node(name) for name in typed(edge, list, "an edge")]
        if len(ends) != 2 or ends[0] == ends[1] or ends[1] in neighbours.get(ends[0], ()):
            raise Invalid(f"graph: {str(edge)[:80]} is not an edge between two nodes, or is there twice")
        for a, b in (ends, ends[::-1]):
            neighbours.setdefault(a, []).append(b)
    _require_connected(neighbours)
    return neighbours


def _node(name: Any) -> str:
    if type(name) is not str or not _NODE.fullmatch(name) or name in ("i", "j"):
        raise Invalid(
            f"graph: {str(name)[:40]!r} is not the name of a node; i and j stand for nodes in listings"
        )
    return name


def _require_connected(neighbours: Mapping[str, Sequence[str]]) -> None:
    todo = list(neighbours)[:1]
    reached = set(todo)
    while todo:
        new = [node for node in neighbours[todo.pop()] if node not in reached]
        reached.update(new)
        todo += new
    if not neighbours or len(reached) < len(neighbours):
        raise Invalid("graph: not a connected graph with at least two nodes")
