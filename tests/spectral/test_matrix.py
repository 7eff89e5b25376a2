"""The largest eigenvalue between two rationals."""

from __future__ import annotations

from fractions import Fraction

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.decide.definiteness import decide_matrix
from symctrl.spectral.matrix import largest_eigenvalue


@given(st.integers(2, 7), st.randoms(use_true_random=False))
@settings(max_examples=40, deadline=None)
def test_both_bounds_hold_exactly_and_meet_the_float_eigenvalue(n: int, random: object) -> None:
    graph = nx.gnp_random_graph(n, 0.6, seed=random)  # type: ignore[arg-type]
    rows = nx.laplacian_matrix(graph).toarray().tolist() if graph.number_of_edges() else [[0] * n] * n
    found = largest_eigenvalue(rows)
    shifted = [[(found.high if r == c else 0) - Fraction(rows[r][c]) for c in range(n)] for r in range(n)]
    assert decide_matrix(shifted).definiteness != "not positive semidefinite"
    x = found.vector
    product = [sum(Fraction(e) * xi for e, xi in zip(row, x, strict=True)) for row in rows]
    form = sum(a * b for a, b in zip(x, product, strict=True))
    assert form >= found.low * sum(e * e for e in x) > -1
    assert found.high - found.low <= Fraction(1, 10**5)
    exact = np.linalg.eigvalsh(np.array(rows, dtype=float))[-1]
    assert float(found.low) - 1e-9 <= exact <= float(found.high) + 1e-9


def test_an_integer_is_exact() -> None:
    found = largest_eigenvalue([[2, 1], [1, 2]])
    assert (found.low, found.high) == (3, 3)


def test_a_matrix_that_is_not_symmetric_is_refused() -> None:
    with pytest.raises(ValueError, match="symmetric"):
        largest_eigenvalue([[1, 2], [3, 4]])
