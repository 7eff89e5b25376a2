"""Certificates about the eigenvalues of a graph's Laplacian: right ones, false ones, and those too large."""

from __future__ import annotations

from typing import Any

from symctrl.kernel.certificate import digest
from tests.kernel.certificates import Json

RING = [[1, 2], [1, 4], [2, 3], [3, 4]]  # eigenvalues 0, 2, 2, 4
TRIANGLE = [[1, 2], [1, 3], [2, 3]]  # 0, 3, 3; degrees plus adjacency have 4
STAR = [[1, 2], [1, 3], [1, 4]]  # 0, 1, 1, 4
COLUMNS = [[1, 19, 2, 14, 3, 14], [2, 12, 3, 5], [3, 11]]
FACTOR = {"kind": "factor", "x": [1, 1, 1], "unit": 16, "columns": COLUMNS}


def case(edges: Any, bound: Any, proof: Json, nodes: Any = 4, strict: bool = False) -> Json:
    graph = {"nodes": nodes, "edges": edges}
    kind = "eigenvalues_below" if strict else "eigenvalues_at_most"
    statement = {
        "study": "tests",
        "id": "one",
        "text": "a small graph",
        "graph": {**graph, "sha256": digest(graph)},
        "claim": {"kind": kind, "bound": bound},
    }
    return sealed(
        {"format": "symctrl-certificate/1", "tool": "tests", "statement": statement, "proof": proof}
    )


def sealed(whole: Json) -> Json:
    """With the digests of the graph and of the whole recomputed."""
    graph = {key: value for key, value in whole["statement"]["graph"].items() if key != "sha256"}
    statement = {**whole["statement"], "graph": {**graph, "sha256": digest(graph)}}
    rest = {key: value for key, value in whole.items() if key != "sha256"} | {"statement": statement}
    return {**rest, "sha256": digest(rest)}


def vector(*x: Any) -> Json:
    return {"kind": "vector", "x": list(x)}


def witness(*x: Any) -> Json:
    return {"kind": "witness", "x": list(x)}


def factor(**changes: Any) -> Json:
    return FACTOR | changes


def of_graph(edges: Any, nodes: Any = 4, bound: Any = "9") -> Json:
    """What would be right of any graph of four nodes, if this were one."""
    return case(edges, bound, vector(1, 1, 1, 1), nodes)


def wrong_digest() -> Json:
    whole = of_graph(RING)
    whole["statement"]["graph"]["sha256"] = digest(0)
    rest = {key: value for key, value in whole.items() if key != "sha256"}
    return {**rest, "sha256": digest(rest)}


ELIMINATION = {"kind": "elimination"}
SIZE = {"kind": "size"}
GOOD: dict[str, Json] = {
    "laplacian_vector": case(RING, "4", vector(1, 1, 1, 1)),
    "laplacian_vector_strict": case(STAR, "9/2", vector(13, 4, 4, 4), strict=True),
    "laplacian_factor": case(TRIANGLE, "7/2", factor(), 3, strict=True),
    "laplacian_elimination": case(TRIANGLE, "3", ELIMINATION, 3),
    "laplacian_elimination_strict": case(TRIANGLE, "301/100", ELIMINATION, 3, strict=True),
    "laplacian_size": case(TRIANGLE, "3", SIZE, 3),
    "laplacian_witness": case(TRIANGLE, "299/100", witness(1, -1, 0), 3),
    "laplacian_witness_strict": case(RING, "4", witness(1, -1, 1, -1), strict=True),
    "laplacian_lone_node": case([], "0", vector(1), 1),
}
BAD: dict[str, Json] = {
    "laplacian_bound_too_small": case(RING, "399/100", vector(1, 1, 1, 1)),
    "laplacian_bound_reached": case(RING, "4", vector(1, 1, 1, 1), strict=True),
    "laplacian_vector_of_signs": case(RING, "3", vector(1, -1, 1, -1)),
    "laplacian_vector_with_a_zero": case([[1, 2]], "1", vector(0, 0, 1), 3),
    "laplacian_vector_of_negatives": case(RING, "3", vector(-1, -1, -1, -1)),
    "laplacian_vector_too_short": case(RING, "4", vector(1, 1, 1)),
    "laplacian_vector_too_long": case(RING, "4", vector(1, 1, 1, 1, 1)),
    "laplacian_vector_with_true": case(RING, "4", vector(1, 1, 1, True)),
    "laplacian_vector_of_strings": case(RING, "4", vector(1, 1, 1, "1")),
    "laplacian_edge_twice": of_graph([[1, 2], [1, 2], [2, 3]]),
    "laplacian_edge_twice_turned": of_graph([[1, 2], [2, 1], [2, 3]]),
    "laplacian_edges_unsorted": of_graph([[2, 3], [1, 2]]),
    "laplacian_loop": of_graph([[1, 2], [2, 2]]),
    "laplacian_node_too_large": of_graph([[1, 5]]),
    "laplacian_node_zero": of_graph([[0, 1]]),
    "laplacian_node_negative": of_graph([[-1, 1]]),
    "laplacian_node_true": of_graph([[True, 2]]),
    "laplacian_edge_of_three": of_graph([[1, 2, 3]]),
    "laplacian_edge_no_list": of_graph([12]),
    "laplacian_no_nodes": case([], "0", vector(), 0),
    "laplacian_nodes_true": case([], "0", vector(1), True),
    "laplacian_bound_no_string": of_graph(RING, bound=9),
    "laplacian_bound_unreduced": of_graph(RING, bound="18/2"),
    "laplacian_digest_of_the_graph": wrong_digest(),
    "laplacian_factor_too_coarse": case(TRIANGLE, "7/2", factor(unit=15), 3),
    "laplacian_factor_unit_zero": case(TRIANGLE, "7/2", factor(unit=0), 3),
    "laplacian_factor_unit_negative": case(TRIANGLE, "7/2", factor(unit=-16), 3),
    "laplacian_factor_node_twice": case(TRIANGLE, "7/2", factor(columns=[[1, 9, 1, 10]]), 3),
    "laplacian_factor_node_of_none": case(TRIANGLE, "7/2", factor(columns=[*COLUMNS, [0, 5]]), 3),
    "laplacian_factor_of_odd_length": case(TRIANGLE, "7/2", factor(columns=[[1, 18, 2]]), 3),
    "laplacian_factor_below_the_eigenvalue": case(TRIANGLE, "29/10", factor(), 3),
    "laplacian_not_semidefinite": case(TRIANGLE, "299/100", ELIMINATION, 3),
    "laplacian_not_definite": case(TRIANGLE, "3", ELIMINATION, 3, strict=True),
    "laplacian_more_nodes_than_the_bound": case(TRIANGLE, "299/100", SIZE, 3),
    "laplacian_as_many_nodes_as_the_bound": case(TRIANGLE, "3", SIZE, 3, strict=True),
    "laplacian_witness_of_equality": case(RING, "4", witness(1, -1, 1, -1)),
    "laplacian_witness_zero": case(RING, "0", witness(0, 0, 0, 0), strict=True),
    "laplacian_witness_of_too_little": case(TRIANGLE, "2", witness(1, 1, 0), 3),
    "laplacian_field_too_many": case(RING, "4", vector(1, 1, 1, 1) | {"hint": 1}),
}
CORNER: dict[str, tuple[str, Json]] = {
    "laplacian_of_a_vast_graph": ("declined", case([], "0", vector(1), 10**12)),
    "laplacian_proof_of_another_kind": ("declined", case(RING, "4", {"kind": "identity"})),
    "laplacian_elimination_too_large": ("declined", case([], "1", ELIMINATION, 2000)),
}
