"""Leaf proofs of definiteness, accepted; and every way found to falsify one, refused."""

import copy
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.decide.definiteness import decide_matrix
from symctrl.kernel import definite
from symctrl.kernel.certificate import Invalid
from symctrl.kernel.definite import prove_leaf
from symctrl.kernel.matrices import eliminate
from tests.kernel.programs import assume, program, statement, verify

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


# Certificates whose entries are symbols.


def prove(stated, matrix, free=(), factors=(), hints=()):
    generators = [{"free": name} for name in free]
    proof = {"kind": "definite", "generators": generators, "factors": list(factors), "hints": list(hints)}
    verify(definite, stated, {**proof, "matrix": matrix})


def claim(kind, tree, outputs, scalars=(), given=(), **listings):
    return statement({"kind": kind, "matrix": tree}, {"claim": program(*outputs), **listings}, scalars, given)


TWO = {"entries": [[0, 1], [1, 2]]}
UNIT = {"ldl": {"lower": [["1"], ["0", "1"]], "diagonal": ["1", "1"]}}


def test_products_with_identities_and_blocks():
    tree = {"blocks": [{"kron_identity": TWO, "size": 3}, {"entries": [[2]]}]}
    stated = claim("positive_definite", tree, [1, 0, 1])
    one = {"ldl": {"lower": [["1"]], "diagonal": ["1"]}}
    prove(stated, {"blocks": [{"kron_identity": UNIT, "size": 3}, one]})
    for wrong in (
        {"blocks": [{"kron_identity": UNIT, "size": 2}, one]},
        {"blocks": [{"kron_identity": UNIT, "size": 3}]},
        {"blocks": [one, {"kron_identity": UNIT, "size": 3}]},
        UNIT,
    ):
        with pytest.raises(Invalid):
            prove(stated, wrong)


def test_the_claim_must_be_one_of_definiteness():
    stated = statement({"kind": "nonnegative", "shape": [1, 1]}, {"claim": program(1)})
    with pytest.raises(Invalid, match="nonnegative"):
        prove(stated, UNIT)


class TestMinors:
    """[[a, 1], [1, 2/a]] with a > 0: the minors are a and 1."""

    tree = {"entries": [[0, 1], [1, 2]]}  # noqa: RUF012
    first = {"terms": [["1", [0], []]]}  # noqa: RUF012
    second = {"terms": [["1", [], []]]}  # noqa: RUF012
    inverse = {"factors": [[["1", 0, 1]]], "hints": [{"inverse": ["1", [[0, 1]]]}]}  # noqa: RUF012

    def stated(self, kind="positive"):
        outputs = ["a", 1, ("/", 2, "a")]
        return claim("positive_definite", self.tree, outputs, ["a"], [assume(kind, "g")], g=program("a"))

    def test_all_of_them_are_positive(self):
        prove(self.stated(), {"minors": [self.first, self.second]}, ["a"], **self.inverse)

    def test_one_that_is_missing_or_not_positive(self):
        for minors in ([self.first], [self.second, self.second], [self.first, {"terms": []}]):
            with pytest.raises(Invalid):
                prove(self.stated(), {"minors": minors}, ["a"], **self.inverse)
        with pytest.raises(Invalid):
            prove(self.stated("nonzero"), {"minors": [self.first, self.second]}, ["a"], **self.inverse)

    def test_a_matrix_that_is_not_symmetric(self):
        tree = {"entries": [[0, 1], [2, 0]]}
        stated = claim("positive_definite", tree, [1, "a", 0], ["a"])
        one = {"terms": [["1", [], []]]}
        with pytest.raises(Invalid, match="symmetry"):
            prove(stated, {"minors": [one, one]}, ["a"])


class TestCongruence:
    """C'PC for a given P > 0 of size 2, with the columns of C exchanged and doubled, or one of them alone."""

    names = ("p", "q", "r")
    exchange = [["0", "2"], ["2", "0"]]  # noqa: RUF012

    def stated(self, kind, outputs, given="positive_definite", tree=TWO):
        listings = {"P": program("p", "q", "q", "r")}
        return claim(kind, tree, outputs, self.names, [assume(given, "P", size=2)], **listings)

    def twice(self, *names):
        return [("*", 4, name) for name in names]

    def test_full_rank(self):
        proof = {"congruence": [{"factor": self.exchange, "given": 0}]}
        prove(self.stated("positive_definite", self.twice("r", "q", "p")), proof, self.names)
        semidefinite = self.stated("positive_definite", self.twice("r", "q", "p"), "positive_semidefinite")
        with pytest.raises(Invalid, match="full rank"):
            prove(semidefinite, proof, self.names)

    def test_the_product_must_be_the_matrix(self):
        proof = {"congruence": [{"factor": self.exchange, "given": 0}]}
        with pytest.raises(Invalid, match="sum of C'PC"):
            prove(self.stated("positive_definite", self.twice("p", "q", "r")), proof, self.names)

    def test_a_projection_is_semidefinite_only(self):
        factor = [["1", "1"], ["0", "0"]]
        proof = {"congruence": [{"factor": factor, "given": 0}]}
        tree = {"entries": [[0, 0], [0, 0]]}
        prove(self.stated("positive_semidefinite", ["p"], tree=tree), proof, self.names)
        with pytest.raises(Invalid, match="full rank"):
            prove(self.stated("positive_definite", ["p"], tree=tree), proof, self.names)

    def test_polynomial_factors(self):
        factor = [[[["1", 0, 1]]], [[["1", 1, 1]]]]  # C = (p, q)'
        cubic = (
            "+",
            ("*", ("SQ", "p"), "p"),
            ("+", ("*", 2, ("*", "p", ("SQ", "q"))), ("*", ("SQ", "q"), "r")),
        )
        stated = self.stated("positive_semidefinite", [cubic], tree={"entries": [[0]]})
        prove(stated, {"congruence": [{"factor": factor, "given": 0}]}, self.names)

    @pytest.mark.parametrize(
        "part",
        [
            {"factor": exchange, "given": 1},
            {"factor": exchange[:1], "given": 0},
            {"factor": [["0"], ["2"]], "given": 0},
            {"factor": exchange},
            {"factor": exchange, "given": 0, "scale": "-1"},
        ],
    )
    def test_malformed_parts(self, part):
        with pytest.raises(Invalid):
            prove(
                self.stated("positive_definite", self.twice("r", "q", "p")),
                {"congruence": [part]},
                self.names,
            )
