"""Leaf proofs of definiteness, accepted; and every way found to falsify one, refused."""

import copy
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.decide.definiteness import decide_matrix
from symctrl.kernel.certificate import Invalid
from symctrl.kernel.definite import prove_leaf
from symctrl.kernel.matrices import eliminate

small = st.fractions(-2, 2, max_denominator=4)


def rational(rows):
    return [[Fraction(a) for a in row] for row in rows]


def leaf_of(kind, n=12):
    """A definite matrix with a leaf proof of this kind."""
    size = 3 if kind == "ldl" else n
    rows = rational([[1 + (i == j) * (i + 2) for j in range(size)] for i in range(size)])
    leaf = decide_matrix(rows).leaf
    assert kind in leaf
    return rows, leaf


def places(value, path=()):
    """The path of every string in a JSON value."""
    if isinstance(value, str):
        yield path
    for key, part in (
        value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    ):
        yield from places(part, (*path, key))


def changed(value, path, new):
    result = copy.deepcopy(value)
    inner = result
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = new
    return result


def test_every_number_of_an_ldl_proof_counts():
    rows, leaf = leaf_of("ldl")
    prove_leaf(rows, leaf, strict=True)
    for path in places(leaf):
        for new in ("7/11", "-1", "0"):
            with pytest.raises(Invalid):
                prove_leaf(rows, changed(leaf, path, new), strict=False)


def test_numbers_of_a_dominance_proof_must_be_right():
    """L may be any other matrix that leaves a dominant remainder; the scale is positive."""
    rows, leaf = leaf_of("dominant")
    prove_leaf(rows, leaf, strict=True)
    for path in places(leaf):
        for new in ["100"] if "lower" in path else ["0", "-1", "1000000"]:
            with pytest.raises(Invalid):
                prove_leaf(rows, changed(leaf, path, new), strict=False)


@pytest.mark.parametrize("kind", ["ldl", "dominant"])
def test_malformed_leaves(kind):
    rows, leaf = leaf_of(kind)
    body = leaf[kind]
    second = "diagonal" if kind == "ldl" else "scale"
    for wrong in (
        {},
        {kind: {**body, "more": 1}},
        {kind: {"lower": body["lower"]}},
        {kind: {**body, "lower": body["lower"][:-1]}},
        {kind: {**body, "lower": [[*row, "0"] for row in body["lower"]]}},
        {kind: {**body, second: body[second][:-1]}},
        {kind: {**body, second: [1.5, *body[second][1:]]}},
        {kind: {**body, second: [True, *body[second][1:]]}},
        {**leaf, "minors": []},
        {"magic": body},
    ):
        with pytest.raises(Invalid):
            prove_leaf(rows, wrong, strict=False)


@pytest.mark.parametrize("kind", ["ldl", "dominant"])
def test_a_matrix_that_is_not_symmetric(kind):
    rows, leaf = leaf_of(kind)
    rows[1][0] += 1
    with pytest.raises(Invalid, match="not symmetric"):
        prove_leaf(rows, leaf, strict=False)


def test_a_singular_matrix_is_semidefinite_only():
    rows = rational([[1, 1], [1, 1]])
    ldl = {"ldl": {"lower": [["1"], ["1", "1"]], "diagonal": ["1", "0"]}}
    dominant = {"dominant": {"lower": [["0"], ["0", "0"]], "scale": ["1", "1"]}}
    for leaf in (ldl, dominant):
        prove_leaf(rows, leaf, strict=False)
        with pytest.raises(Invalid):
            prove_leaf(rows, leaf, strict=True)


def test_the_zero_proof_proves_nothing():
    rows = rational([[-1]])
    for leaf in (
        {"dominant": {"lower": [["0"]], "scale": ["0"]}},
        {"dominant": {"lower": [["0"]], "scale": ["1"]}},
        {"dominant": {"lower": [["0"]], "scale": ["-1"]}},
        {"ldl": {"lower": [["1"]], "diagonal": ["-1"]}},
        {"ldl": {"lower": [["1"]], "diagonal": ["0"]}},
    ):
        with pytest.raises(Invalid):
            prove_leaf(rows, leaf, strict=False)


def test_scaling_makes_a_remainder_dominant():
    rows = rational([[1, 3], [3, 10]])
    lower = [["0"], ["0", "0"]]
    prove_leaf(rows, {"dominant": {"lower": lower, "scale": ["19", "6"]}}, strict=True)
    with pytest.raises(Invalid):
        prove_leaf(rows, {"dominant": {"lower": lower, "scale": ["1", "1"]}}, strict=False)


@settings(max_examples=60, deadline=None)
@given(
    st.integers(1, 4).flatmap(
        lambda n: st.lists(st.lists(small, min_size=n, max_size=n), min_size=n, max_size=n)
    )
)
def test_elimination_multiplies_back(b):
    n = len(b)
    rows = [[sum(x * y for x, y in zip(r, s, strict=True)) for s in b] for r in b]
    found = eliminate(rows)
    lower = [[Fraction(i == k) for k in range(n)] for i in range(n)]
    diagonal, last = [], 1
    for k, (pivot, column) in enumerate(zip(found.pivots, found.columns, strict=True)):
        diagonal.append(Fraction(pivot, last * found.denominator))
        for i, c in enumerate(column, start=k + 1):
            lower[i][k] = Fraction(c, pivot) if pivot else Fraction(0)
        last = pivot or last
    again = [
        [sum(lower[i][k] * diagonal[k] * lower[j][k] for k in range(n)) for j in range(n)] for i in range(n)
    ]
    assert again == rows
