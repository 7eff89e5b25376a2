"""Graphs of a fleet: `ring:5` and its like, or a file with two node names a line."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from math import prod
from pathlib import Path

import networkx as nx

from symctrl import files

MAX_EDGES = 2_000_000  # a slip of the finger like complete:100000 must not fill the memory

Edges = Iterator[tuple[int, int]]


class GraphSpecError(files.InputError):
    """A graph that cannot be read; the message names the file and line, or the family and its least size."""


def parse(spec: str) -> nx.Graph:
    """The graph that `spec` means: ring:N, path:N, star:N, complete:N, tree:N or grid:RxC, or a file.

    The nodes of a family are "1" to "N", row by row in a grid; the centre of a star is "1", and in the binary
    tree node k > 1 hangs from k // 2. A file has two node names a line, blank between, and `#` comments; a
    single name is a node without edges. Nodes are in the order in which they are first seen. Raises
    GraphSpecError.
    """
    family, colon, size = spec.partition(":")
    if colon and family in _FAMILIES:
        return _of_family(spec, family, size)
    if not Path(spec).is_file():
        known = ", ".join(f"{known}:{_form(known)}" for known in _FAMILIES)
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


def _tree(n: int) -> Edges:
    return ((k // 2, k) for k in range(2, n + 1))


def _grid(rows: int, columns: int) -> Edges:
    for k in range(1, rows * columns + 1):
        if k % columns:
            yield k, k + 1
        if k + columns <= rows * columns:
            yield k, k + columns


# The least number of nodes (of rows and of columns), and the edges.
_FAMILIES: dict[str, tuple[int, Callable[..., Edges]]] = {
    "ring": (3, _ring),
    "path": (1, _path),
    "star": (2, _star),
    "complete": (1, _complete),
    "tree": (1, _tree),
    "grid": (1, _grid),
}


def _form(family: str) -> str:
    return "RxC" if family == "grid" else "N"


def _sizes(spec: str, family: str, size: str) -> list[int]:
    """The numbers that the size consists of."""
    least = _FAMILIES[family][0]
    if family == "grid":
        if not re.fullmatch("[0-9]{1,9}x[0-9]{1,9}", size):
            raise GraphSpecError(f"graph {spec}: the size must be rows and columns like 3x4, not {size!r}")
    elif not re.fullmatch("[0-9]{1,9}", size):
        raise GraphSpecError(f"graph {spec}: the number of nodes must be a whole number like 5, not {size!r}")
    sizes = [int(part) for part in size.split("x")]
    if min(sizes) < least:
        what = "row and column" if family == "grid" else f"node{'s' * (least > 1)}"
        raise GraphSpecError(f"graph {spec}: a {family} has at least {least} {what}")
    return sizes


def _of_family(spec: str, family: str, size: str) -> nx.Graph:
    sizes = _sizes(spec, family, size)
    n = prod(sizes)
    edges = {"complete": n * (n - 1) // 2, "grid": 2 * n}.get(family, n)
    if max(n, edges) > MAX_EDGES:
        raise GraphSpecError(f"graph {spec}: has more than {MAX_EDGES} nodes or edges")
    graph = nx.Graph(name=f"{family}:{'x'.join(map(str, sizes))}")
    names = [str(k) for k in range(n + 1)]
    graph.add_nodes_from(names[1:])
    graph.add_edges_from((names[j], names[k]) for j, k in _FAMILIES[family][1](*sizes))
    return graph


# How a graph in another format begins.
_FOREIGN = {
    r"<": "XML, like GraphML or GEXF",
    r"[{\[]": "JSON",
    r"(strict\s+)?(di)?graph\b[^\n{]*\s*\{": "DOT",
    r"graph\s*\[|Creator\s+\"": "GML",
    r"\*": "Pajek",
    r"%": "Matrix Market",
    r"[^#\n]*[,;]": "a table with commas",
}


def _of_file(path: Path) -> nx.Graph:
    try:
        text = files.read(path)
    except files.InputError as error:
        raise GraphSpecError(f"graph {error}") from None
    _refuse_foreign(path, text)
    lines = _Lines()
    for number, line in enumerate(text.splitlines(), start=1):
        words = (re.sub(r"(^|\s)#.*", "", line) if "#" in line else line).split()
        try:
            lines.add(words, number)
        except GraphSpecError as error:
            raise GraphSpecError(f"graph {path}, line {number}: {error}") from None
    if not lines.names:
        raise GraphSpecError(f"graph {path}: names no node; write two node names a line")
    graph = nx.Graph(name=path.name)
    graph.add_nodes_from(lines.names)
    graph.add_edges_from(lines.seen)
    return graph


def _refuse_foreign(path: Path, text: str) -> None:
    content = re.search(r"^[^\S\n]*[^\s#]", text, re.M)
    start = text[content.end() - 1 :][:1000] if content else ""
    for pattern, what in _FOREIGN.items():
        if re.match(pattern, start, re.I):
            raise GraphSpecError(
                f'graph {path}: looks like {what}; a graph file has two node names a line, like "1 2"'
            )


class _Lines:
    """What the lines of a file name: nodes, and edges with the number of their line."""

    def __init__(self) -> None:
        self.names: dict[str, str] = {}
        self.seen: dict[tuple[str, str], int] = {}

    def add(self, words: list[str], number: int) -> None:
        if len(words) > 2:
            raise GraphSpecError(f"{len(words)} words; an edge is two node names with a blank between")
        known = [self.names.get(word) or self._name(word) for word in words]
        if len(known) == 2:
            a, b = known
            edge = (a, b) if a < b else (b, a)
            if a == b:
                raise GraphSpecError(f"an edge from {a} to itself; an edge joins two nodes")
            if edge in self.seen:
                raise GraphSpecError(
                    f"the edge {a} {b} is in line {self.seen[edge]} already; "
                    "edges have no direction, so each is written once"
                )
            self.seen[edge] = number

    def _name(self, word: str) -> str:
        # A node's name becomes a part of symbol names like q.2[1].
        if not re.fullmatch(r"\w[\w-]*", word):
            raise GraphSpecError(f"the node name {word!r} must consist of letters, digits, _ and -")
        self.names[word] = word
        return word
