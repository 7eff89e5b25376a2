"""A graph as arrays of integers: what exact checks and floating-point iterations both read."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy import sparse

if TYPE_CHECKING:
    import networkx as nx

Array = Any  # of numpy


@dataclass(frozen=True)
class Network:
    """Nodes 0 to nodes-1; edge k joins a[k] < b[k], and the edges are in increasing order.

    a, b: int64, shape (edges,).
    """

    nodes: int
    a: Array
    b: Array

    @property
    def edges(self) -> int:
        return len(self.a)

    @cached_property
    def degrees(self) -> Array:
        """int64, shape (nodes,)."""
        return np.bincount(self.a, minlength=self.nodes) + np.bincount(self.b, minlength=self.nodes)

    @cached_property
    def adjacency(self) -> Any:
        """The adjacency matrix of floats, sparse."""
        ones = np.ones(2 * self.edges)
        places = (np.concatenate([self.a, self.b]), np.concatenate([self.b, self.a]))
        return sparse.csr_matrix((ones, places), shape=(self.nodes, self.nodes))

    @cached_property
    def sides(self) -> Array | None:
        """1 and -1 on the two sides of a bipartite graph, int64, shape (nodes,); None for another graph."""
        side = _sides(self.adjacency)
        return None if (side[self.a] == side[self.b]).any() else side

    def neighbour_sums(self, x: Array) -> Array:
        """The sum of x over the neighbours of each node, exact for objects and where int64 holds it."""
        sums = np.zeros(self.nodes, dtype=x.dtype)
        np.add.at(sums, self.a, x[self.b])
        np.add.at(sums, self.b, x[self.a])
        return sums


def of_graph(graph: nx.Graph) -> Network:
    """The network of a graph, its nodes numbered in their order. Raises ValueError for what is none."""
    nodes = len(graph)
    if nodes == 0:
        raise ValueError("a graph without nodes has no eigenvalue")
    if graph.is_directed() or graph.is_multigraph():
        raise ValueError("the Laplacian is that of an undirected graph without parallel edges")
    number = {node: k for k, node in enumerate(graph)}
    ends = np.fromiter(
        (number[end] for edge in graph.edges() for end in edge), np.int64, 2 * graph.number_of_edges()
    )
    a, b = np.minimum(ends[::2], ends[1::2]), np.maximum(ends[::2], ends[1::2])
    if (a == b).any():
        raise ValueError("an edge joins two nodes; this graph has one from a node to itself")
    order = np.lexsort((b, a))
    return Network(nodes, a[order], b[order])


def _sides(adjacency: Any) -> Array:
    """1 and -1 by turns along a tree that spans each part, int64."""
    n = adjacency.shape[0]
    labels = sparse.csgraph.connected_components(adjacency, directed=False)[1]
    first = np.unique(labels, return_index=True)[1]
    to_first = sparse.csr_matrix((np.ones(len(first)), first, [0, len(first)]), shape=(1, n))
    rooted = sparse.vstack(
        [
            sparse.hstack([adjacency, sparse.csr_matrix((n, 1))]),
            sparse.hstack([to_first, sparse.csr_matrix((1, 1))]),
        ],
        format="csr",
    )
    order, before = sparse.csgraph.breadth_first_order(rooted, n)
    side = [1] * (n + 1)
    parents = before.tolist()
    for node in order[1:].tolist():
        side[node] = -side[parents[node]]
    return np.array(side[:n])
