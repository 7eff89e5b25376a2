"""Proofs that no eigenvalue of a graph's Laplacian exceeds a number, and vectors that show the contrary.

Soundness-critical. Last reviewed 2026-11-24.

L is the Laplacian of an undirected graph without loops: d_i, the number of neighbours of node i, on the
diagonal, and -1 for each edge. t is the number. Its eigenvalues are real.

Theorem (`vector`). If x > 0 and (t - d_i) x_i >= the sum of x_j over the neighbours j of i, for each node
i, no eigenvalue of L exceeds t; where all the inequalities are strict, none reaches it. Proof: let L y = m y
and y not be zero, and i a node at which |y_i| / x_i is largest, c > 0. Then |m - d_i| |y_i| is at most the
sum of |y_j|, that at most c times the sum of x_j, that at most c (t - d_i) x_i = (t - d_i) |y_i|, and
|y_i| > 0, so that m - d_i <= t - d_i. (Gershgorin 1931; Collatz 1942, for degrees plus adjacency.)

Theorem (`factor`). Let F be any matrix and R = t I - L - F F'. If x > 0 and R_ii x_i >= the sum of |R_ij| x_j
over all j other than i, for each i, no eigenvalue of L exceeds t; where all are strict, none reaches it.
Proof: R is positive semidefinite (`matrices`), so t I - L is, and definite where R is. Without columns this
is the theorem above.

Theorem (`size`). No eigenvalue exceeds the number of nodes n: x'Lx, the sum of (x_i - x_j)^2 over the edges,
is at most that over all pairs of nodes, n x'x - (the sum of x)^2.

Theorem (`elimination`). No eigenvalue exceeds t exactly where t I - L is positive semidefinite, and none
reaches t exactly where it is definite: `matrices` decides that.

Theorem (`witness`). If x is not zero and x'Lx exceeds t x'x, an eigenvalue exceeds t; if it is at least
t x'x, an eigenvalue reaches t (Rayleigh).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from symctrl.kernel.certificate import Declined, Invalid, digest, fields, rational, text_field, typed
from symctrl.kernel.matrices import eliminate
from symctrl.kernel.printing import line

MAX_NODES = 2_000_000
MAX_EDGES = 2_000_000
MAX_BITS = 10**9  # nodes and edges times the bits of the longest number
MAX_PRODUCTS = 10**8  # pairs of entries in the columns of a factor
MAX_FACTOR_BITS = 256
MAX_ROWS = 1000  # of a matrix that is eliminated
PRINTED_EDGES = 30
CLAIMS = ("eigenvalues_at_most", "eigenvalues_below")

Edges = list[list[int]]
Vector = list[int]


@dataclass(frozen=True, slots=True)
class Statement:
    """Whether every eigenvalue is at most (strict: below) the bound; nodes are 1 to `nodes`."""

    study: str
    id: str
    text: str
    nodes: int
    edges: Edges
    sha256: str
    bound: Fraction
    strict: bool


def is_meant(statement: Any) -> bool:
    """Is this the JSON of a statement about a graph's Laplacian, right or wrong?"""
    return type(statement) is dict and "graph" in statement


def read_statement(value: Any) -> Statement:
    """The statement from its JSON. Raises Invalid, or Declined for one that is too large."""
    s = fields(value, ("study", "id", "text", "graph", "claim"), "statement")
    study, id_, words = (text_field(s[field], field) for field in ("study", "id", "text"))
    graph = fields(s["graph"], ("nodes", "edges", "sha256"), "graph")
    nodes, edges = typed(graph["nodes"], int, "nodes"), typed(graph["edges"], list, "edges")
    if nodes < 1:
        raise Invalid("a graph has at least one node")
    if nodes > MAX_NODES or len(edges) > MAX_EDGES:
        raise Declined(f"a graph of more than {MAX_NODES} nodes or {MAX_EDGES} edges")
    _require_edges(edges, nodes)
    if graph["sha256"] != digest({"nodes": nodes, "edges": edges}):
        raise Invalid("the sha256 of the graph is not that of its nodes and edges")
    claim = fields(s["claim"], ("kind", "bound"), "claim")
    if claim["kind"] not in CLAIMS:
        raise Invalid(f"claim: {str(claim['kind'])[:60]!r} is not one of {', '.join(CLAIMS)}")
    bound = rational(typed(claim["bound"], str, "bound"), "bound")
    strict = claim["kind"] == "eigenvalues_below"
    return Statement(study, id_, words, nodes, edges, graph["sha256"], bound, strict)


def _require_edges(edges: list[Any], nodes: int) -> None:
    """Raises Invalid unless they are pairs a < b of nodes, each greater than the one before it."""
    last = [0, 0]
    for edge in edges:
        if type(edge) is not list or len(edge) != 2 or type(edge[0]) is not int or type(edge[1]) is not int:
            raise Invalid(f"graph: {str(edge)[:60]} is not a pair of node numbers")
        if not 1 <= edge[0] < edge[1] <= nodes:
            raise Invalid(f"graph: {str(edge)[:60]} is not a pair a < b of nodes from 1 to {nodes}")
        if edge <= last:
            raise Invalid(f"graph: the edge {str(edge)[:60]} is not greater than the one before it")
        last = edge


def print_statement(s: Statement, refuted: bool) -> str:
    """All that the statement says."""
    return "\n".join(_lines(s, refuted))


def _lines(s: Statement, refuted: bool) -> Iterator[str]:
    yield f'statement {line(s.id)} of {line(s.study)}, in the words of the certificate: "{line(s.text)}"'
    false = "it is false that " if refuted else ""
    claim = f"is {'below' if s.strict else 'at most'} {s.bound}"
    yield f"{false}each eigenvalue of the graph's Laplacian, degrees less adjacency, {claim}"
    yield (
        f"where the graph is undirected, of {s.nodes} nodes, 1 to {s.nodes}, and {len(s.edges)} edges "
        f"(sha256 {s.sha256})"
    )
    if len(s.edges) <= PRINTED_EDGES:
        yield "where its edges are " + (", ".join(f"{a}-{b}" for a, b in s.edges) or "none")


def verify(s: Statement, proof: dict[str, Any]) -> None:
    """Raises Invalid or Declined unless the proof shows the claim, or a witness that it is false."""
    kind = proof.get("kind")
    if kind == "vector":
        x = _vector(fields(proof, ("kind", "x"), "proof")["x"], s)
        _require_dominance(s, x, _slacks(s, x))
    elif kind == "factor":
        _verify_factor(s, fields(proof, ("kind", "x", "unit", "columns"), "proof"))
    elif kind == "size":
        fields(proof, ("kind",), "proof")
        if s.nodes > s.bound or (s.strict and s.nodes == s.bound):
            raise Invalid("the graph has too many nodes for the bound")
    elif kind == "elimination":
        fields(proof, ("kind",), "proof")
        _verify_elimination(s)
    elif kind == "witness":
        _verify_witness(s, _vector(fields(proof, ("kind", "x"), "proof")["x"], s))
    else:
        raise Declined(f"a proof of the kind {str(kind)[:60]!r} is not known for a Laplacian")


def _vector(value: Any, s: Statement) -> Vector:
    """One integer for each node. Raises Invalid, or Declined where they are too long."""
    x = typed(value, list, "x")
    if len(x) != s.nodes:
        raise Invalid(f"x has {len(x)} entries, and the graph {s.nodes} nodes")
    if any(type(a) is not int for a in x):
        raise Invalid("an entry of x is not an integer")
    longest = max(*map(abs, x), abs(s.bound.numerator), s.bound.denominator).bit_length()
    if longest * (s.nodes + len(s.edges)) > MAX_BITS:
        raise Declined(f"a graph of this size with numbers of {longest} bits is too much work")
    return x


def _degrees(s: Statement) -> Vector:
    """By node number; the entry 0 belongs to no node."""
    degrees = [0] * (s.nodes + 1)
    for a, b in s.edges:
        degrees[a] += 1
        degrees[b] += 1
    return degrees


def _slacks(s: Statement, x: Vector) -> Vector:
    """q ((t - d_i) x_i - the sum of x_j over the neighbours j) by node, for t = p/q."""
    p, q = s.bound.numerator, s.bound.denominator
    at = [0, *x]
    sums = [0] * (s.nodes + 1)
    for a, b in s.edges:
        sums[a] += at[b]
        sums[b] += at[a]
    degrees = _degrees(s)
    return [(p - q * degrees[k]) * at[k] - q * sums[k] for k in range(1, s.nodes + 1)]


def _require_dominance(s: Statement, x: Vector, slacks: Vector) -> None:
    if min(x) <= 0:
        raise Invalid(f"entry {x.index(min(x)) + 1} of x is not positive")
    least = min(slacks)
    if least < 0 or (s.strict and least == 0):
        raise Invalid(f"the inequality of node {slacks.index(least) + 1} does not hold")


def _verify_factor(s: Statement, proof: dict[str, Any]) -> None:
    """F has the entries `columns[k]` = [node, value, node, value, ..] over `unit`, with increasing nodes."""
    x = _vector(proof["x"], s)
    unit = typed(proof["unit"], int, "unit")
    if unit < 1:
        raise Invalid("the unit of the factor is not positive")
    columns = [_column(column, s) for column in typed(proof["columns"], list, "columns")]
    if sum(len(column) ** 2 for column in columns) > MAX_PRODUCTS:
        raise Declined(f"the columns of the factor have more than {MAX_PRODUCTS} products of their entries")
    longest = max((abs(v) for column in columns for _, v in column), default=0).bit_length()
    if max(longest, unit.bit_length()) > MAX_FACTOR_BITS:
        raise Declined(f"a factor with numbers of {longest} bits is too much work")
    _require_dominance(s, x, _remainder_slacks(s, x, unit**2, columns))


def _column(value: Any, s: Statement) -> list[tuple[int, int]]:
    flat = typed(value, list, "column")
    if any(type(a) is not int for a in flat) or len(flat) % 2:
        raise Invalid("a column of the factor is not a list of nodes and integers by turns")
    nodes = flat[::2]
    if any(not 1 <= k <= s.nodes for k in nodes) or any(a >= b for a, b in pairwise(nodes)):
        raise Invalid(f"a column of the factor does not have increasing nodes from 1 to {s.nodes}")
    return list(zip(nodes, flat[1::2], strict=True))


def _remainder_slacks(s: Statement, x: Vector, square: int, columns: list[list[tuple[int, int]]]) -> Vector:
    """q u^2 (R_ii x_i - the sum of |R_ij| x_j) by node, u being the unit of F; R is kept where i >= j."""
    p, q = s.bound.numerator, s.bound.denominator
    degrees = _degrees(s)
    rows: list[dict[int, int]] = [{k: square * (p - q * d)} for k, d in enumerate(degrees)]
    for a, b in s.edges:
        rows[b][a] = square * q
    for column in columns:
        for place, (i, v) in enumerate(column):
            row, factor = rows[i], q * v
            for j, w in column[: place + 1]:
                row[j] = row.get(j, 0) - factor * w
    slacks = [0] * s.nodes
    for i, row in enumerate(rows[1:]):
        for j, r in row.items():
            if j == i + 1:
                slacks[i] += r * x[i]
            else:
                slacks[i] -= abs(r) * x[j - 1]
                slacks[j - 1] -= abs(r) * x[i]
    return slacks


def _verify_elimination(s: Statement) -> None:
    if s.nodes > MAX_ROWS:
        raise Declined(f"a matrix of more than {MAX_ROWS} rows is not eliminated")
    rows = [[Fraction(0)] * s.nodes for _ in range(s.nodes)]
    for k, d in enumerate(_degrees(s)[1:]):
        rows[k][k] = s.bound - d
    for a, b in s.edges:
        rows[a - 1][b - 1] = rows[b - 1][a - 1] = Fraction(1)
    found = eliminate(rows)
    if found is None or (s.strict and not found.definite):
        raise Invalid("the bound times the identity less the Laplacian is not definite as claimed")


def _verify_witness(s: Statement, x: Vector) -> None:
    square = sum(a * a for a in x)
    if square == 0:
        raise Invalid("the witness is zero")
    at = [0, *x]
    form = sum((at[a] - at[b]) ** 2 for a, b in s.edges)
    excess = s.bound.denominator * form - s.bound.numerator * square
    if excess < 0 or (not s.strict and excess == 0):
        raise Invalid("the witness does not contradict the claim")
