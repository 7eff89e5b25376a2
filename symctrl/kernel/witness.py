"""A witness: exact values at which a claim is false.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: a claim "for all values that satisfy the assumptions, .." is false where one choice of values
satisfies them and contradicts the rest. Numbers are enclosed by intervals (`enclosure`), with more bits
until the comparison is decided; equality is only ever shown by exact rationals. A claim about fleets is
one about every connected undirected graph of at least two nodes without loops and repeated edges, so that
one is enough. A matrix A is not positive semidefinite where x'Ax <
0, and not definite where x'Ax <= 0, x != 0.

Proof fields: `values` {symbol at its node: number} for exactly the free symbols, where {"cos": c, "sin": s}
with c^2 + s^2 = 1 is the angle in (-pi, pi] with that cosine and sine; for fleets `graph`, the
edges of a connected graph, and `node` where the claim speaks of node i; then `at`, the position of the
entry that fails (from 0), or `x`, the vector, for definiteness. Where a Kronecker product A (x) I_n is
claimed, x has n entries for each row.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from symctrl.kernel.certificate import Declined, Invalid, at_node, fields, natural, per_node, rational, typed
from symctrl.kernel.enclosure import Enclosure
from symctrl.kernel.evaluation import Evaluation, GraphSums, NoSums
from symctrl.kernel.interval import Interval, Undecided, point
from symctrl.kernel.matrices import eliminate
from symctrl.kernel.values import Assumption, Condition, Statement

BITS = (64, 256, 1024)
MAX_EDGES = 10_000
_NODE = re.compile(r"\w{1,40}")
Graph = Mapping[str, Sequence[str]]
Number = Fraction | tuple[Fraction, Fraction]  # a pair is the cosine and sine of an angle


@dataclass(frozen=True, slots=True)
class Point:
    """Where the statement is evaluated; `binding` has the nodes that the letters of the claim stand for."""

    values: Mapping[str, Number]
    graph: Graph
    binding: Mapping[str, str]
    fails: Callable[[Sequence[Interval]], bool]


def needed_conditions(statement: Statement, proof: dict[str, Any]) -> set[Condition]:
    """None, if the witness shows the claim false. Raises Invalid if it does not, Declined if undecided."""
    place = _read(statement, proof)
    reason = ""
    for bits in BITS:
        try:
            _refute(statement, place, bits)
            return set()
        except Undecided as undecided:
            reason = str(undecided)
    raise Declined(f"the witness is not decided with {BITS[-1]} bits: {reason}")


def _refute(statement: Statement, place: Point, bits: int) -> None:
    domain = Enclosure(bits)
    walk: Evaluation[Interval] = Evaluation(
        statement,
        domain,
        lambda name: _enclosed(domain, place.values[name]),
        GraphSums(place.graph) if place.graph else NoSums(),
    )
    for k, assumption in enumerate(statement.given):
        for binding in _bindings(statement, assumption, place.graph):
            entries = [walk.output(ref, binding) for ref in assumption.of]
            if not _holds_on(place.graph, assumption, entries):
                raise Invalid(f"the values do not satisfy assumption {k + 1}, {assumption.text[:80]!r}")
    outputs = walk.outputs(statement.claim.listing, place.binding)
    if not place.fails(outputs):
        raise Invalid("the claim holds at the values of the witness")


def _enclosed(domain: Enclosure, value: Number) -> Interval:
    if isinstance(value, Fraction):
        return point(value)
    return domain.angle(*value)


def _bindings(statement: Statement, assumption: Assumption, graph: Graph) -> Iterator[dict[str, str]]:
    """Every node where the assumption speaks of one."""
    if any(statement.listings[name].letters for name, _ in assumption.of):
        yield from ({"i": node} for node in graph)
    else:
        yield {}


def _holds(assumption: Assumption, entries: Sequence[Interval]) -> bool:
    """Does the assumption hold at the enclosed values? Raises Undecided where that is open."""
    if assumption.kind.startswith("positive_"):
        return _is_definite(entries, assumption.size, assumption.kind == "positive_definite")
    a = entries[0]
    if assumption.kind == "nonnegative" and (a.lo >= 0 or a.hi < 0):
        return a.lo >= 0
    if a.sign is None:
        raise Undecided(f"whether {assumption.text[:80]!r} holds")
    return {"zero": a.sign == 0, "nonzero": a.sign != 0, "positive": a.sign > 0}[assumption.kind]


def _holds_on(graph: Graph, of: Assumption, values: Sequence[Interval]) -> bool:
    """A bound b of the eigenvalues of the graph's Laplacian L is b I - L positive semidefinite."""
    if of.kind != "laplacian_bound":
        return _holds(of, values)
    bound = values[0]
    if not bound.thin:
        raise Undecided("a bound of eigenvalues that is not rational")
    nodes = list(graph)
    rows = [[(bound.lo - len(graph[a])) if a == b else Fraction(b in graph[a]) for b in nodes] for a in nodes]
    entries = [point(rows[r][c]) for c in range(len(nodes)) for r in range(len(nodes))]
    return _is_definite(entries, len(nodes), strict=False)


def _is_definite(entries: Sequence[Interval], n: int, strict: bool) -> bool:
    if not all(entry.thin for entry in entries):
        raise Undecided("the definiteness of an assumed matrix whose entries are not rational")
    found = eliminate([[entries[i + n * j].lo for j in range(n)] for i in range(n)])
    return found is not None and (found.definite or not strict)


def _read(statement: Statement, proof: dict[str, Any]) -> Point:
    claim = statement.claim
    if claim.kind == "conforms":
        raise Invalid("that an expression conforms is not refuted by values")
    if statement.conditions:
        raise Invalid("a refutation has no conditions, for the kernel could not check that they hold")
    fleet = any(per_node(key) for key in (*statement.scalars, *statement.names)) or any(
        meaning.kind in ("sum", "total") for meaning in statement.names.values()
    )
    letters = statement.listings[claim.listing].letters
    wanted = [name for letter, name in (("i", "node"), ("j", "neighbour")) if letter in letters]
    which = "x" if claim.matrix is not None else "at"
    extra = ["graph"] if fleet else []
    fields(proof, ("kind", "values", which, *extra, *wanted), "proof")
    graph = _read_graph(proof["graph"]) if fleet else {}
    binding = {"i" if name == "node" else "j": typed(proof[name], str, name) for name in wanted}
    for node in binding.values():
        if node not in graph:
            raise Invalid(f"the graph has no node {node[:40]!r}")
    if len(binding) == 2 and binding["j"] not in graph[binding["i"]]:
        raise Invalid("the node and its neighbour are not joined by an edge")
    if claim.small is not None:
        raise Invalid("a claim about small values of a gain is not refuted at one value")
    fails = _failure(statement, proof[which])
    return Point(_values(statement, proof["values"], graph), graph, binding, fails)


def _read_graph(value: Any) -> Graph:
    """Node to neighbours, from a list of pairs of names. Raises Invalid for what is no connected graph."""
    edges = typed(value, list, "graph")
    if len(edges) > MAX_EDGES:
        raise Declined(f"a graph with more than {MAX_EDGES} edges")
    graph: dict[str, list[str]] = {}
    for edge in edges:
        for name in typed(edge, list, "an edge"):
            if type(name) is not str or not _NODE.fullmatch(name) or name in ("i", "j"):
                raise Invalid(f"graph: {str(name)[:40]!r} is not the name of a node, as i and j are not")
        if len(edge) != 2 or edge[0] == edge[1] or edge[1] in graph.get(edge[0], ()):
            raise Invalid(f"graph: {str(edge)[:80]} is not an edge between two nodes, or is there twice")
        for a, b in (edge, edge[::-1]):
            graph.setdefault(a, []).append(b)
    reached = todo = set(list(graph)[:1])
    while todo:
        todo = {node for old in todo for node in graph[old]} - reached
        reached = reached | todo
    if not graph or len(reached) < len(graph):
        raise Invalid("graph: not a connected graph with at least two nodes")
    return graph


def _values(statement: Statement, given: Any, graph: Graph) -> dict[str, Number]:
    """The number of each free symbol at each node; no other."""
    wanted = {
        name
        for key in statement.scalars
        for name in ([at_node(key, node) for node in graph] if per_node(key) else [key])
    }
    table = fields(given, wanted, "values")
    return {name: _number(value, f"the value of {name}") for name, value in table.items()}


def _number(value: Any, where: str) -> Number:
    if type(value) is not dict:
        return rational(value, where)
    table = fields(value, ("cos", "sin"), where)
    cos, sin = (rational(table[part], f"{where}, {part}") for part in ("cos", "sin"))
    if cos * cos + sin * sin != 1:
        raise Invalid(f"{where}: {cos} and {sin} are no cosine and sine of an angle")
    return cos, sin


def _failure(statement: Statement, where: Any) -> Callable[[Sequence[Interval]], bool]:
    """Does the claim fail for its enclosed outputs, at the entry or for the vector that the proof names?"""
    claim = statement.claim
    if claim.matrix is not None:
        x = [rational(entry, f"x[{k + 1}]") for k, entry in enumerate(typed(where, list, "x"))]
        if len(x) != claim.shape[0]:
            raise Invalid(f"x has {len(x)} entries, but the matrix has {claim.shape[0]} rows")
        return lambda outputs: _form_fails(claim.kind, claim.matrix, outputs, x)
    count = claim.shape[0] * claim.shape[1]
    at = natural(where, count, "at")
    if claim.kind == "equal":
        return lambda outputs: _differ(outputs[at], outputs[count + at])
    return lambda outputs: _sign_fails(claim.kind, outputs[at])


def _differ(a: Interval, b: Interval) -> bool:
    if a.hi < b.lo or b.hi < a.lo:
        return True
    if a.thin and b.thin:
        return False
    raise Undecided("whether the two sides differ")


def _sign_fails(kind: str, a: Interval) -> bool:
    """a >= 0 fails where a < 0, a > 0 where a <= 0."""
    strict = kind == "positive"
    if a.hi < 0 or (strict and a.hi == 0):
        return True
    if a.lo > 0 or (not strict and a.lo == 0):
        return False
    raise Undecided("the sign of the entry")


def _form_fails(kind: str, tree: Any, outputs: Sequence[Interval], x: Sequence[Fraction]) -> bool:
    strict = kind == "positive_definite"
    if strict and not any(x):
        raise Invalid("the vector x is zero")
    form, _ = _form(tree, outputs, x)
    return _sign_fails("positive" if strict else "nonnegative", form)


def _form(tree: Any, outputs: Sequence[Interval], x: Sequence[Fraction]) -> tuple[Interval, int]:
    """x'Ax for the matrix of a tree, which may take only the first entries of x; and how many it takes."""
    if "congruence" in tree:
        raise Declined("a witness against a congruence")
    domain = Enclosure(BITS[-1])
    total, size = point(0), 0
    if "entries" in tree:
        size = len(tree["entries"])
        for a, row in zip(x, tree["entries"], strict=False):
            for b, k in zip(x, row, strict=False):
                if a and b:
                    total = domain.add(total, domain.mul(point(a * b), outputs[k]))
        return total, size
    blocks, copies = tree.get("blocks", [tree.get("kron_identity")]), tree.get("size", 1)
    for block in blocks:
        for k in range(copies):
            part, taken = _form(block, outputs, x[size + k :: copies])
            total = domain.add(total, part)
        size += taken * copies
    return total, size
