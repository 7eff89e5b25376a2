"""Eigenvalues of Laplacians in the kernel: what it accepts is true, however a certificate is altered."""

from __future__ import annotations

import itertools
import json
from fractions import Fraction
from typing import Any

import networkx as nx
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from symctrl.kernel import laplacian
from symctrl.kernel.check import check_text
from tests.arena.laplacians import GOOD, RING, TRIANGLE, case, factor, sealed, vector, witness
from tests.kernel.certificates import Json
from tests.kernel.test_mutations import WORDS, alterations


def answer(certificate: Any) -> str:
    return check_text(json.dumps(certificate)).status


def is_true(certificate: Json) -> bool:
    """Is what a valid certificate states so, as floats have it?"""
    statement = certificate["statement"]
    nodes = statement["graph"]["nodes"]
    L = np.zeros((nodes, nodes))
    for a, b in statement["graph"]["edges"]:
        L[[a - 1, b - 1], [a - 1, b - 1]] += 1
        L[[a - 1, b - 1], [b - 1, a - 1]] -= 1
    excess = np.linalg.eigvalsh(L)[-1] - float(Fraction(statement["claim"]["bound"]))
    return excess > -1e-9 if certificate["proof"]["kind"] == "witness" else excess < 1e-9


@pytest.mark.parametrize("name", GOOD)
def test_an_altered_certificate_is_refused_or_right(name):
    certificate = GOOD[name]
    assert is_true(certificate)

    @settings(max_examples=150, deadline=None, database=None, suppress_health_check=list(HealthCheck))
    @given(alterations(certificate))
    def check(altered):
        path, other = altered
        if other == certificate:
            return
        assert answer(other) != "valid"
        try:
            again = sealed(other)
        except (KeyError, TypeError, AttributeError):
            return
        if path[-1] not in WORDS and answer(again) == "valid":
            assert is_true(again)

    check()


small = st.integers(-3, 20)


@given(
    st.lists(st.booleans(), min_size=6, max_size=6),
    st.fractions(0, 8, max_denominator=6),
    st.lists(st.integers(1, 6), min_size=4, max_size=4),
    st.booleans(),
    st.data(),
)
@settings(max_examples=300, deadline=None)
def test_what_is_accepted_is_true(chosen, bound, x, strict, data):
    pairs = itertools.combinations(range(1, 5), 2)
    edges = [list(pair) for pair, there in zip(pairs, chosen, strict=True) if there]
    proofs = [vector(*x), witness(*data.draw(st.lists(small, min_size=4, max_size=4)))]
    columns = data.draw(st.lists(st.lists(small, min_size=4, max_size=4), max_size=4))
    flat = [[a for k, value in enumerate(column, start=1) for a in (k, value)] for column in columns]
    proofs += [factor(x=x, unit=8, columns=flat), {"kind": "elimination"}, {"kind": "size"}]
    for proof in proofs:
        certificate = case(edges, str(bound), proof, strict=strict)
        assert answer(certificate) == "invalid" or is_true(certificate)


@given(st.integers(2, 8), st.integers(0, 10**6), st.integers(1, 10**4))
@settings(max_examples=60, deadline=None)
def test_a_rounded_factor_of_a_definite_matrix_is_accepted(nodes, seed, margin):
    graph = nx.gnp_random_graph(nodes, 0.5, seed=seed)
    L = nx.laplacian_matrix(graph, nodelist=range(nodes)).toarray().astype(float)
    largest = float(np.linalg.eigvalsh(L)[-1])
    bound = Fraction(int(largest * 10**4) + margin + 1, 10**4)
    F = np.linalg.cholesky((float(bound) + largest) / 2 * np.eye(nodes) - L)
    columns = [[a for i in range(k, nodes) for a in (i + 1, round(F[i, k] * 2**40))] for k in range(nodes)]
    edges = sorted([a + 1, b + 1] for a, b in graph.edges)
    proof = {"kind": "factor", "x": [1] * nodes, "unit": 2**40, "columns": columns}
    assert answer(case(edges, str(bound), proof, nodes, strict=True)) == "valid"


def test_a_statement_says_what_was_checked():
    text = check_text(json.dumps(case(TRIANGLE, "3", {"kind": "elimination"}, 3))).statement
    assert "each eigenvalue of the graph's Laplacian, degrees less adjacency, is at most 3" in text
    assert "3 nodes, 1 to 3, and 3 edges (sha256 " in text
    assert "1-2, 1-3, 2-3" in text
    refuted = check_text(json.dumps(case(RING, "4", witness(1, -1, 1, -1), strict=True))).statement
    assert "it is false that each eigenvalue" in refuted
    assert "is below 4" in refuted


def test_it_is_a_part_of_a_bundle():
    from tests.arena.good import RATE, bundle

    parts = bundle(RATE, case(RING, "4", vector(1, 1, 1, 1)))
    found = check_text(json.dumps(parts))
    assert (found.status, found.reason) == (
        "valid",
        "2 parts, verified by its identity, verified by its vector",
    )
    assert answer(bundle(RATE, case(RING, "3", vector(1, 1, 1, 1)))) == "invalid"


@pytest.mark.parametrize("limit", ["MAX_NODES", "MAX_EDGES", "MAX_BITS", "MAX_PRODUCTS", "MAX_FACTOR_BITS"])
def test_what_is_too_large_is_declined(monkeypatch, limit):
    certificate = case(TRIANGLE, "7/2", factor(), 3, strict=True)
    monkeypatch.setattr(laplacian, limit, 2)
    assert answer(certificate) == "declined"


def test_decimals_are_refused():
    assert answer(case(RING, "4", vector(1, 1, 1, 1.0))) == "invalid"
    assert answer(case([[1, 2.0]], "4", vector(1, 1, 1, 1))) == "invalid"
