"""Definiteness against the characteristic polynomial, which FLINT computes exactly.

All eigenvalues of a symmetric matrix are real, so by Descartes' rule it is semidefinite exactly where the
coefficients of its characteristic polynomial alternate in sign; its rank is the degree minus the multiplicity
of the root 0.
"""

from fractions import Fraction

import pytest
from flint import fmpq, fmpq_mat
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.decide.definiteness import decide_matrix
from symctrl.kernel.definite import prove_leaf

small = st.fractions(min_value=-3, max_value=3, max_denominator=6)


def rectangle(rows, columns):
    return st.lists(st.lists(small, min_size=columns, max_size=columns), min_size=rows, max_size=rows)


@st.composite
def symmetric(draw):
    n = draw(st.integers(1, 6))
    b = draw(rectangle(n, n))
    return [[b[max(i, j)][min(i, j)] for j in range(n)] for i in range(n)]


@st.composite
def gram(draw, max_size=6):
    """B B' with at most as many columns as rows: semidefinite, often singular."""
    n = draw(st.integers(1, max_size))
    return product(draw(rectangle(n, draw(st.integers(1, n)))))


def product(b):
    return [[sum((x * y for x, y in zip(r, s, strict=True)), Fraction(0)) for s in b] for r in b]


def oracle(rows):
    exact = fmpq_mat([[fmpq(a.numerator, a.denominator) for a in row] for row in rows])
    coefficients = [(-1) ** (len(rows) - k) * c for k, c in enumerate(exact.charpoly().coeffs())]
    zeros = next(k for k, c in enumerate(coefficients) if c != 0)
    if any(c < 0 for c in coefficients):
        return "not positive semidefinite", len(rows) - zeros
    return "positive semidefinite" if zeros else "positive definite", len(rows) - zeros


def form(rows, x):
    return sum(x[i] * rows[i][j] * x[j] for i in range(len(x)) for j in range(len(x)))


def check(rows):
    """The answer, with its evidence checked."""
    found = decide_matrix(rows)
    if found.witness is not None:
        assert found.leaf is None
        assert form(rows, found.witness) < 0
    else:
        prove_leaf(rows, found.leaf, strict=found.definiteness == "positive definite")
    return found


@settings(max_examples=150, deadline=None)
@given(st.one_of(symmetric(), gram()))
def test_as_the_characteristic_polynomial_says(rows):
    found = check(rows)
    assert (found.definiteness, found.rank) == oracle(rows)


@settings(max_examples=30, deadline=None)
@given(gram(max_size=5), st.lists(st.integers(-200, 200), min_size=5, max_size=5))
def test_scaling_rows_and_columns_changes_nothing(rows, exponents):
    scale = [Fraction(10) ** e for e in exponents]
    scaled = [
        [a * s * t for a, t in zip(row, scale, strict=False)] for row, s in zip(rows, scale, strict=False)
    ]
    found = check(scaled)
    assert (found.definiteness, found.rank) == oracle(rows)


@settings(max_examples=30, deadline=None)
@given(gram(), st.integers(20, 60))
def test_indefinite_by_next_to_nothing(rows, digits):
    """A singular matrix less 10^-digits times the identity has a negative eigenvalue as small as that."""
    shifted = [
        [a - (i == j) * Fraction(1, 10**digits) for j, a in enumerate(row)] for i, row in enumerate(rows)
    ]
    found = check(shifted)
    assert (found.definiteness, found.rank) == oracle(shifted)


def integers(n, columns, seed=1):
    state = seed
    b = []
    for _ in range(n):
        row = []
        for _ in range(columns):
            state = (1103515245 * state + 12345) % 2**31
            row.append(Fraction(state % 19 - 9))
        b.append(row)
    return product(b)


@pytest.mark.parametrize("n", [11, 25, 60])
def test_large_definite_has_a_short_dominant_leaf(n):
    found = check(integers(n, n + 5))
    assert (found.definiteness, found.rank) == ("positive definite", n)
    assert max(len(a) for row in found.leaf["dominant"]["lower"] for a in row) < 20


def test_large_singular_and_a_hair_below():
    rows = integers(40, 25)
    assert (check(rows).definiteness, check(rows).rank) == ("positive semidefinite", 25)
    rows[7][7] -= Fraction(1, 10**30)
    assert (check(rows).definiteness, check(rows).rank) == ("not positive semidefinite", 26)


def test_large_and_badly_scaled_with_empty_rows():
    scale = [Fraction(10) ** (200 * (k % 3 - 1)) for k in range(15)]
    core = [
        [a * s * t for a, t in zip(r, scale, strict=True)]
        for r, s in zip(integers(15, 20), scale, strict=True)
    ]
    rows = [[Fraction(0)] * 16] + [[Fraction(0), *row] for row in core]
    found = check(rows)
    assert (found.definiteness, found.rank, list(found.leaf)) == ("positive semidefinite", 15, ["dominant"])


@pytest.mark.parametrize("n", [5, 12, 30])
def test_hilbert_matrices_are_definite_until_the_corner_is_lowered(n):
    """The corner may fall by det H_n / det H_(n-1), the last pivot, before H_n is singular."""
    rows = [[Fraction(1, i + j + 1) for j in range(n)] for i in range(n)]
    assert check(rows).definiteness == "positive definite"
    pivot = corner_pivot(rows)
    rows[-1][-1] -= pivot
    assert (check(rows).definiteness, check(rows).rank) == ("positive semidefinite", n - 1)
    rows[-1][-1] -= pivot / 10**40
    assert check(rows).definiteness == "not positive semidefinite"


def corner_pivot(rows):
    exact = fmpq_mat([[fmpq(a.numerator, a.denominator) for a in row] for row in rows])
    inner = fmpq_mat([[fmpq(a.numerator, a.denominator) for a in row[:-1]] for row in rows[:-1]])
    ratio = exact.det() / inner.det()
    return Fraction(int(ratio.p), int(ratio.q))


def test_witness_is_short_where_it_can_be():
    rows = integers(30, 35)
    rows[3][3] -= 10**6
    assert max(abs(v) for v in decide_matrix(rows).witness) <= 8


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ([], "at least one row"),
        ([[1, 2]], "must have 1 entries a row, row 1 has 2"),
        ([[1, 2], [3, 4]], r"entry \(2, 1\) is 3 and entry \(1, 2\) is 2"),
    ],
)
def test_what_is_no_symmetric_matrix(rows, words):
    with pytest.raises(ValueError, match=words):
        decide_matrix([[Fraction(a) for a in row] for row in rows])


def test_zero_matrix():
    assert (check([[Fraction(0)] * 3] * 3).definiteness, decide_matrix([[Fraction(0)]]).rank) == (
        "positive semidefinite",
        0,
    )
