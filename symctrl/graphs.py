"""Graphs of a fleet: `ring:5` and its like, or a file with two node names a line."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path

import networkx as nx

from symctrl import files

MAX_EDGES = 2_000_000  # a slip of the finger like complete:100000 must not fill the memory

Edges = Iterator[tuple[int, int]]


class GraphSpecError(files.InputError):
    """A graph that cannot be read; the message names the file and line, or the family and its least size."""


def parse(spec: str) -> nx.Graph:
    """The graph that `spec` means: ring:N, path:N, star:N or complete:N, or a file.

    The nodes of a family are "1" to "N", the centre of a star is "1". A file has two node names a line, blank
    between, and `#` comments; a single name is a node without edges. Nodes and edges are in the order in
    which they are first seen. Raises GraphSpecError.
    """
    family, colon, size = spec.partition(":")
    if colon and family in _FAMILIES:
        return _of_family(spec, family, size)
    if not Path(spec).is_file():
        known = ", ".join(f"{known}:N" for known in _FAMILIES)
        raise GraphSpecError(f"graph {spec!r}: is neither a file nor one of {known}")
    return _of_file(Path(spec))


def name(graph: nx.Graph) -> str:
    """What the graph is called in a report: as `parse` was asked for it, or its size."""
    given = str(graph.name)
    return given or f"{graph.number_of_nodes()} nodes, {graph.number_of_edges()} edges"


def _ring(n: int) -> Edges:
    yield from _path(n)
    yield n, 1


def _path(n: int) -> Edges:
    return ((k, k + 1) for k in range(1, n))


def _star(n: int) -> Edges:
    return ((1, k) for k in range(2, n + 1))


def _complete(n: int) -> Edges:
    return ((j, k) for j in range(1, n + 1) for k in range(j + 1, n + 1))


_FAMILIES: dict[str, tuple[int, Callable[[int], Edges]]] = {
    "ring": (3, _ring),
    "path": (1, _path),
    "star": (2, _star),
    "complete": (1, _complete),
}


def _of_family(spec: str, family: str, size: str) -> nx.Graph:
    least, edges = _FAMILIES[family]
    if not re.fullmatch("[0-9]{1,9}", size):
        raise GraphSpecError(f"graph {spec}: the number of nodes must be a whole number like 5, not {size!r}")
    n = int(size)
    if n < least:
        raise GraphSpecError(f"graph {spec}: a {family} has at least {least} node{'s' * (least > 1)}")
    if max(n, n * (n - 1) // 2 if family == "complete" else n) > MAX_EDGES:
        raise GraphSpecError(f"graph {spec}: has more than {MAX_EDGES} nodes or edges")
    graph = nx.Graph(name=f"{family}:{n}")
    graph.add_nodes_from(str(k) for k in range(1, n + 1))
    graph.add_edges_from((str(j), str(k)) for j, k in edges(n))
    return graph


def _of_file(path: Path) -> nx.Graph:
    try:
        text = files.read(path)
    except files.InputError as error:
        raise GraphSpecError(f"graph {error}") from None
    graph = nx.Graph(name=path.name)
    seen: dict[frozenset[str], int] = {}
    for number, line in enumerate(text.splitlines(), start=1):
        words = re.sub(r"(^|\s)#.*", "", line).split()
        try:
            _add(graph, words, seen, number)
        except GraphSpecError as error:
            raise GraphSpecError(f"graph {path}, line {number}: {error}") from None
    if not graph:
        raise GraphSpecError(f"graph {path}: names no node; write two node names a line")
    return graph


def _add(graph: nx.Graph, words: list[str], seen: dict[frozenset[str], int], number: int) -> None:
    if len(words) > 2:
        raise GraphSpecError(f"{len(words)} words; an edge is two node names with a blank between")
    for word in words:
        # A node's name becomes a part of symbol names like q.2[1].
        if not re.fullmatch(r"\w[\w-]*", word):
            raise GraphSpecError(f"the node name {word!r} must consist of letters, digits, _ and -")
    if len(words) == 2:
        edge = frozenset(words)
        if len(edge) == 1:
            raise GraphSpecError(f"an edge from {words[0]} to itself; an edge joins two nodes")
        if edge in seen:
            raise GraphSpecError(
                f"the edge {words[0]} {words[1]} is in line {seen[edge]} already; "
                "edges have no direction, so each is written once"
            )
        seen[edge] = number
        graph.add_edge(*words)
    graph.add_nodes_from(words)
