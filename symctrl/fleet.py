"""A fleet on any graph: symbols of a generic node i and its neighbour j, sums over neighbours and over nodes.

What is a sum over edges and nodes is written once for a generic node and edge, and holds for every undirected
graph. Matrices of a graph (Laplacian, adjacency) are those of the instance at hand.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from symctrl.context import current, graph_is_used
from symctrl.expr import Expr, Liftable, deferred, lift, symbol
from symctrl.latex import latex
from symctrl.quaternion import Quaternion
from symctrl.records import Sum, fingerprint, letters
from symctrl.statements import LaplacianBound

if TYPE_CHECKING:
    import networkx as nx

    from symctrl.spectral.bracket import Bracket


EIGENVALUE = "eigenvalue"


class Declared(Protocol):
    """A symbol of a study."""

    @property
    def expr(self) -> Expr: ...


class Declares(Protocol):
    """What a fleet needs of its study: where symbols, assumptions and motions are entered."""

    @property
    def symbols(self) -> Mapping[str, Declared]: ...
    def declare(self, expr: Expr, kind: str, unit: str | None) -> Expr: ...
    def assume_definite(self, M: Expr) -> None: ...
    def assume_unit(self, q: Quaternion) -> None: ...
    def bounded(self, signal: Expr, bound: Expr) -> None: ...
    def motion(self, x: Expr, xdot: Any) -> None: ...


@dataclass(frozen=True)
class Node:
    """The generic node i, or its generic neighbour j."""

    letter: str


@dataclass(frozen=True)
class FleetSymbol:
    """A symbol that every node has: `q[i]` is that of node i."""

    name: str
    shape: tuple[int, int]
    latex: str | None = None
    symmetric: bool = False

    def __getitem__(self, node: Node) -> Expr:
        if not isinstance(node, Node):
            raise TypeError(
                f"{self.name}[..] takes a node of the fleet (fleet.node or fleet.neighbour), not {node!r}"
            )
        tex = None if self.latex is None else rf"{self.latex}_{{{node.letter}}}"
        return symbol(f"{self.name}.{node.letter}", self.shape, tex, self.symmetric)


@dataclass(frozen=True)
class FleetQuaternion:
    """The attitude quaternion of every node: `q[i].vector` (3x1) and `q[i].scalar`."""

    vector: FleetSymbol
    scalar: FleetSymbol

    def __getitem__(self, node: Node) -> Quaternion:
        return Quaternion(self.vector[node], self.scalar[node])


class Fleet:
    """The fleet of a study. `node` is the generic node i, `neighbour` its generic neighbour j."""

    def __init__(self, study: Declares, name: str, default: str) -> None:
        self.study = study
        self.name = name
        self.default = default
        self.node = Node("i")
        self.neighbour = Node("j")

    # Symbols

    def state(self, name: str, size: int = 1, unit: str | None = None, tex: str | None = None) -> FleetSymbol:
        return self._symbol(name, (size, 1), "state", unit, tex)

    def input(self, name: str, size: int = 1, unit: str | None = None, tex: str | None = None) -> FleetSymbol:
        return self._symbol(name, (size, 1), "input", unit, tex)

    def parameter(
        self, name: str, size: int = 1, unit: str | None = None, tex: str | None = None
    ) -> FleetSymbol:
        return self._symbol(name, (size, 1), "parameter", unit, tex)

    def disturbance(
        self,
        name: str,
        size: int = 1,
        unit: str | None = None,
        bound: Expr | None = None,
        tex: str | None = None,
    ) -> FleetSymbol:
        """A signal; with `bound`, each component lies between -bound and bound at every node."""
        made = self._symbol(name, (size, 1), "signal", unit, tex)
        if bound is not None:
            self.study.bounded(made[self.node], bound)
        return made

    def inertia(self, name: str, unit: str | None = "kg*m^2") -> FleetSymbol:
        """A symmetric positive definite 3x3 matrix at every node."""
        made = self._symbol(name, (3, 3), "parameter", unit, None, symmetric=True)
        self.study.assume_definite(made[self.node])
        return made

    def unit_quaternion(self, vector: str, scalar: str) -> FleetQuaternion:
        """A unit quaternion at every node, vector part first."""
        pair = FleetQuaternion(
            self._symbol(vector, (3, 1), "state", "1", None), self._symbol(scalar, (1, 1), "state", "1", None)
        )
        self.study.assume_unit(pair[self.node])
        return pair

    def _symbol(
        self,
        name: str,
        shape: tuple[int, int],
        kind: str,
        unit: str | None,
        tex: str | None,
        symmetric: bool = False,
    ) -> FleetSymbol:
        made = FleetSymbol(name, shape, tex, symmetric)
        self.study.declare(symbol(f"{name}.*", shape, tex, symmetric), kind, unit)
        return made

    # Equations

    def motion(self, x: FleetSymbol, rate: Any) -> None:
        """The motion of a state at every node: `rate` takes a node and gives its time derivative."""
        self.study.motion(x[self.node], rate(self.node))

    def sum(self, over: Node, summand: Any, at: Node | None = None) -> Expr:
        """The sum over all nodes (over=fleet.node) or over the neighbours of node i (over=fleet.neighbour).

        Raises ValueError for a summand whose nodes do not fit.
        """
        body = lift(summand)
        at_nodes = letters(body)
        if over.letter == "i":
            if "j" in at_nodes:
                raise ValueError(
                    "a sum over the nodes i of an expression that speaks of a neighbour j: sum over j first"
                )
            label, tex, total = f"total_{fingerprint(body)}", rf"\sum_i {_bracketed(body)}", True
        else:
            if "i" not in at_nodes and at is not self.node:
                raise ValueError(
                    "a sum over neighbours j whose summand does not speak of the node i (a neighbour's own "
                    "sum has no name here): if it is meant, write fleet.sum(j, .., at=i)"
                )
            label, tex, total = f"sum_{fingerprint(body)}.i", rf"\sum_{{j}} {_bracketed(body)}", False
        return deferred(Sum(label, tex, body, total), body.shape)

    def eigenvalues_at_most(self, bound: Liftable) -> LaplacianBound:
        """The assumption that no eigenvalue of the graph's Laplacian exceeds a scalar of parameters."""
        return LaplacianBound(lift(bound))

    @property
    def eigenvalue(self) -> Expr:
        """Any eigenvalue of the Laplacian of the graph at hand, in a condition on gains.

        A matrix whose blocks are p_ij(L) (x) I, with polynomials p_ij of the Laplacian L, is definite exactly
        if the small matrix of the p_ij(lambda) is for every eigenvalue lambda of L, for an orthogonal basis
        of eigenvectors brings it to the block diagonal of these (Horn and Johnson, Matrix Analysis, 2.5).
        """
        if EIGENVALUE not in self.study.symbols:
            self.study.declare(symbol(EIGENVALUE, (1, 1), r"\lambda"), "parameter", "1")
        return self.study.symbols[EIGENVALUE].expr

    def degree(self, node: Node) -> Expr:
        """The number of neighbours of node i."""
        return self.sum(self.neighbour, 1, at=node)

    # Graphs and their matrices: of the instance at hand, or of a graph that is given

    @property
    def graph(self) -> nx.Graph:
        """The graph of the instance at hand."""
        from symctrl.graphs import parse  # networkx loads slowly

        graph_is_used()
        return current().graph or parse(self.default)

    @property
    def size(self) -> int:
        """The number of nodes of the instance at hand."""
        return len(self.graph)

    def adjacency(self, graph: nx.Graph | None = None) -> Expr:
        """The adjacency matrix, n x n."""
        return lift(self._rows(graph))

    def laplacian(self, graph: nx.Graph | None = None) -> Expr:
        """The Laplacian matrix (degrees minus adjacency), n x n."""
        return lift(self._laplacian(graph))

    def incidence(self, graph: nx.Graph | None = None) -> Expr:
        """An incidence matrix, n x edges: a column has 1 at one end of its edge and -1 at the other."""
        chosen = self.graph if graph is None else graph
        return lift([[(a == node) - (b == node) for a, b in chosen.edges] for node in chosen])

    def largest_eigenvalue(self, graph: nx.Graph | None = None) -> Bracket:
        """Exact rational bounds of the largest eigenvalue of the Laplacian."""
        from symctrl.spectral.bracket import extreme_eigenvalue  # numpy loads slowly

        return extreme_eigenvalue(self.graph if graph is None else graph)

    def _laplacian(self, graph: nx.Graph | None) -> list[list[int]]:
        rows = self._rows(graph)
        return [[sum(row) if r == c else -row[c] for c in range(len(row))] for r, row in enumerate(rows)]

    def _rows(self, graph: nx.Graph | None) -> list[list[int]]:
        chosen = self.graph if graph is None else graph
        nodes = list(chosen)
        return [[int(chosen.has_edge(a, b)) for b in nodes] for a in nodes]


def _bracketed(body: Expr) -> str:
    written = latex(body)
    return rf"\left({written}\right)" if body.op in ("add", "sub", "neg") else written
