"""Known eigenvalues lie between the bounds, each bound has evidence, and no wrong verdict is given."""

from __future__ import annotations

import json
from fractions import Fraction

import mpmath
import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.graphs import parse
from symctrl.kernel.check import check_text
from symctrl.spectral.bracket import SMALL, Bracket, Decision, decide_at_most, extreme_eigenvalue
from symctrl.spectral.network import of_graph
from symctrl.spectral.witness import quotient
from symctrl.verdict import Outcome


def ring(n):
    return 2 - 2 * mpmath.cos(2 * mpmath.pi * (n // 2) / n)


def path(n):
    return 2 - 2 * mpmath.cos(mpmath.pi * (n - 1) / n)


def grid(rows, columns):
    return path(rows) + path(columns)


KNOWN = [
    *((ring, n) for n in (3, 8, 9, 250, 251, 20_000, 20_001)),
    *((path, n) for n in (1, 2, 9, 300, 20_000)),
    *((grid, *size) for size in ((3, 4), (1, 9), (20, 30), (60, 50))),
]
WHOLE = ["star:2", "star:7", "star:300", "star:20000", "complete:2", "complete:6", "complete:300"]


def checked(graph: nx.Graph, found: Bracket) -> Bracket:
    """The bracket, both of whose ends have their evidence."""
    assert quotient(of_graph(graph), np.array(found.vector, dtype=object)) >= found.low
    above = decide_at_most(graph, found.high)
    assert above.outcome is Outcome.PROVED
    assert accepted(above)
    below = decide_at_most(graph, found.low, strict=True)
    assert below.outcome is Outcome.REFUTED
    assert accepted(below)
    return found


def accepted(decision: Decision) -> bool:
    return check_text(json.dumps(decision.certificate)).status == "valid"


@pytest.mark.parametrize("case", KNOWN, ids=lambda case: f"{case[0].__name__}-{case[-1]}")
def test_a_known_eigenvalue_is_between_the_bounds(case):
    of, *size = case
    with mpmath.workdps(40):
        graph, known = parse(f"{of.__name__}:{'x'.join(map(str, size))}"), of(*size)
        found = checked(graph, extreme_eigenvalue(graph))
        slack = mpmath.mpf(10) ** -30  # of what mpmath has rounded
        assert mpmath.mpf(found.low.numerator) / found.low.denominator <= known + slack
        assert known - slack <= mpmath.mpf(found.high.numerator) / found.high.denominator
    assert found.high - found.low <= Fraction(1, 10**5)


@pytest.mark.parametrize("spec", WHOLE)
def test_the_eigenvalue_of_stars_and_complete_graphs_is_exact(spec):
    graph = parse(spec)
    found = checked(graph, extreme_eigenvalue(graph))
    assert found.low == found.high == len(graph)


@pytest.mark.parametrize("parts", [(3, 4), (1, 5), (150, 120)])
def test_a_complete_bipartite_graph_is_exact(parts):
    found = extreme_eigenvalue(nx.complete_bipartite_graph(*parts))
    assert found.low == found.high == sum(parts)


@given(st.integers(1, 40), st.floats(0, 1), st.integers(0, 10**6), st.fractions(-1, 2, max_denominator=50))
@settings(max_examples=60, deadline=None)
def test_a_small_graph_is_decided_and_rightly(n, density, seed, share):
    graph = nx.gnp_random_graph(n, density, seed=seed)
    t = share * n
    largest = np.linalg.eigvalsh(nx.laplacian_matrix(graph, range(n)).toarray().astype(float))[-1]
    for strict in (False, True):
        decision = decide_at_most(graph, t, strict)
        assert decision.outcome in (Outcome.PROVED, Outcome.REFUTED)
        assert accepted(decision)
        proved = decision.outcome is Outcome.PROVED
        assert largest < float(t) + 1e-7 if proved else largest > float(t) - 1e-7
        assert decision.bracket.low <= largest + 1e-7
        assert largest - 1e-7 <= decision.bracket.high


LARGE = {
    "regular": lambda n, seed: nx.random_regular_graph(4, n + n % 2, seed=seed),
    "preferential": lambda n, seed: nx.barabasi_albert_graph(n, 3, seed=seed),
    "random": lambda n, seed: nx.fast_gnp_random_graph(n, 6 / n, seed=seed),
    "tree": lambda n, seed: nx.random_labeled_tree(n, seed=seed),
    "geometric": lambda n, seed: nx.random_geometric_graph(n, 1.5 / n**0.5, seed=seed),
}


@given(st.sampled_from(sorted(LARGE)), st.integers(SMALL + 1, 500), st.integers(0, 10**6))
@settings(max_examples=6, deadline=None)
def test_a_graph_of_some_hundred_nodes_is_bounded_closely(kind, n, seed):
    graph = LARGE[kind](n, seed)
    found = checked(graph, extreme_eigenvalue(graph))
    largest = np.linalg.eigvalsh(nx.laplacian_matrix(graph).toarray().astype(float))[-1]
    assert float(found.low) - 1e-9 <= largest <= float(found.high) + 1e-9
    assert found.high - found.low <= Fraction(1, 10**3)


def test_thresholds_are_proved_or_refuted_on_the_way():
    graph = parse("grid:30x20")
    t = Fraction(799, 100)
    found = extreme_eigenvalue(graph, [t])
    assert found.high <= t or found.low > t


def test_a_strict_bound_that_is_not_reached_is_proved():
    for spec in ("path:3001", "ring:3001", "grid:60x50", "ring:9"):
        t = Fraction(8 if "grid" in spec else 4)
        decision = decide_at_most(parse(spec), t, strict=True)
        assert decision.outcome is Outcome.PROVED
        assert accepted(decision)


def test_a_large_expander_stays_open_between_its_bounds():
    graph = nx.random_regular_graph(4, 6000, seed=1)
    decision = decide_at_most(graph, Fraction(15, 2))
    assert decision.outcome is Outcome.UNDECIDED
    assert "too large for a factor" in decision.reason
    assert decision.bracket.high == 8
    assert decision.bracket.low > 7.4
    assert decision.certificate is None


def test_answers_are_the_same_each_time():
    graph = nx.barabasi_albert_graph(3000, 3, seed=1)
    assert extreme_eigenvalue(graph) == extreme_eigenvalue(graph)


@pytest.mark.parametrize(
    ("graph", "says"),
    [
        (nx.Graph(), "without nodes"),
        (nx.DiGraph([(1, 2)]), "undirected"),
        (nx.MultiGraph([(1, 2), (1, 2)]), "parallel"),
        (nx.Graph([(1, 1)]), "to itself"),
    ],
)
def test_what_has_no_laplacian_here_is_refused(graph, says):
    with pytest.raises(ValueError, match=says):
        extreme_eigenvalue(graph)


def test_a_graph_without_edges_has_the_eigenvalue_zero():
    for n in (1, 5, SMALL + 1):
        found = extreme_eigenvalue(nx.empty_graph(n))
        assert found.low == found.high == 0
