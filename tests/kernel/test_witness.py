"""Witnesses that refute, beside those that do not."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symctrl.kernel import witness
from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.interval import point
from tests.kernel.programs import assume, program, statement, verify

EQUAL = {"kind": "equal", "shape": [1, 1]}


def refute(stated, **proof):
    verify(stated, {"kind": "witness", **proof})


def sign(kind, expression, scalars, given=(), **listings):
    return statement(
        {"kind": kind, "shape": [1, 1]}, {"claim": program(expression), **listings}, scalars, given
    )


def equal(left, right, scalars, given=(), **listings):
    return statement(EQUAL, {"claim": program(left, right), **listings}, scalars, given)


class TestEquality:
    stated = equal(("SQ", ("+", "x", 1)), ("+", ("SQ", "x"), 1), ["x"])

    def test_values_at_which_the_sides_differ(self):
        refute(self.stated, values={"x": "1/3"}, at=0)

    def test_values_at_which_they_do_not(self):
        with pytest.raises(Invalid, match="the claim holds"):
            refute(self.stated, values={"x": "0"}, at=0)

    def test_a_difference_in_the_thirtieth_digit(self):
        close = equal(("EXP", "x"), ("+", ("EXP", "x"), f"1/{10**60}"), ["x"])
        refute(close, values={"x": "2/7"}, at=0)

    def test_equal_irrational_numbers_are_not_decided(self):
        angle = equal(("+", ("SQ", ("SIN", "x")), ("SQ", ("COS", "x"))), 1, ["x"])
        with pytest.raises(Declined, match="1024 bits"):
            refute(angle, values={"x": "2/7"}, at=0)

    def test_a_division_by_zero_is_no_refutation(self):
        quotient = equal(("/", "x", "x"), 1, ["x"])
        with pytest.raises(Invalid, match="division by zero"):
            refute(quotient, values={"x": "0"}, at=0)

    @pytest.mark.parametrize(
        "proof",
        [
            {"values": {}, "at": 0},
            {"values": {"x": "1", "y": "1"}, "at": 0},
            {"values": {"x": "2/2"}, "at": 0},
            {"values": {"x": 0.5}, "at": 0},
            {"values": {"x": "1"}, "at": 1},
            {"values": {"x": "1"}, "at": -1},
            {"values": {"x": "1"}, "x": ["1"]},
            {"values": {"x": "1"}, "at": 0, "graph": [["1", "2"]]},
            {"values": {"x": "1"}, "at": 0, "node": "1"},
            {"values": {"x": "1"}},
        ],
    )
    def test_malformed_proofs(self, proof):
        with pytest.raises(Invalid):
            refute(self.stated, **proof)

    def test_conditions_are_not_checked_and_so_not_accepted(self):
        with pytest.raises(Invalid, match="no conditions"):
            refute({**self.stated, "conditions": [{"kind": "nonzero", "of": "x"}]}, values={"x": "1"}, at=0)


class TestSigns:
    def test_nonnegative(self):
        stated = sign("nonnegative", ("-", "x", 1), ["x"])
        refute(stated, values={"x": "1/2"}, at=0)
        for holds in ("1", "2"):
            with pytest.raises(Invalid, match="the claim holds"):
                refute(stated, values={"x": holds}, at=0)

    def test_positive(self):
        stated = sign("positive", ("-", "x", 1), ["x"])
        refute(stated, values={"x": "1"}, at=0)
        with pytest.raises(Invalid, match="the claim holds"):
            refute(stated, values={"x": "2"}, at=0)

    def test_roots_and_logarithms_are_enclosed(self):
        refute(sign("nonnegative", ("-", ("SQRT", "x"), "3/2"), ["x"]), values={"x": "2"}, at=0)
        refute(sign("positive", ("LOG", "x"), ["x"]), values={"x": "1"}, at=0)


class TestAssumptions:
    @pytest.mark.parametrize(
        ("kind", "holds", "fails"),
        [
            ("positive", "1", "0"),
            ("nonnegative", "0", "-1"),
            ("nonzero", "-1", "0"),
            ("zero", "0", "1/1000"),
        ],
    )
    def test_must_hold(self, kind, holds, fails):
        stated = sign("positive", ("-", ("SQ", "x"), 9), ["x"], [assume(kind, "g")], g=program("x"))
        refute(stated, values={"x": holds}, at=0)
        with pytest.raises(Invalid, match="assumption 1"):
            refute(stated, values={"x": fails}, at=0)

    def test_a_zero_that_is_not_rational_is_not_decided(self):
        circle = program(("-", ("+", ("SQ", ("SIN", "x")), ("SQ", ("COS", "x"))), 1))
        stated = sign("positive", ("-", "x", 9), ["x"], [assume("zero", "g")], g=circle)
        with pytest.raises(Declined):
            refute(stated, values={"x": "1"}, at=0)

    @pytest.mark.parametrize(
        ("kind", "corner", "right"),
        [
            ("positive_definite", "2", True),
            ("positive_definite", "1", False),
            ("positive_semidefinite", "1", True),
            ("positive_semidefinite", "99/100", False),
        ],
    )
    def test_matrices(self, kind, corner, right):
        given = [assume(kind, "P", size=2)]
        stated = sign("nonnegative", ("-", "a", 9), ["a"], given, P=program(1, 1, 1, "a"))
        if right:
            refute(stated, values={"a": corner}, at=0)
        else:
            with pytest.raises(Invalid, match="assumption 1"):
                refute(stated, values={"a": corner}, at=0)


class TestDefiniteness:
    @staticmethod
    def matrix(kind, corner="a"):
        tree = {"kind": kind, "matrix": {"entries": [[0, 1], [1, 2]]}}
        return statement(tree, {"claim": program(1, ("SQRT", 2), corner)}, ["a"])

    def test_a_vector_on_which_the_form_is_negative(self):
        refute(self.matrix("positive_semidefinite"), values={"a": "1"}, x=["-1", "1"])

    def test_a_vector_on_which_it_is_not(self):
        with pytest.raises(Invalid, match="the claim holds"):
            refute(self.matrix("positive_semidefinite"), values={"a": "1"}, x=["1", "1"])

    def test_zero_refutes_only_the_strict_claim_and_only_off_the_origin(self):
        matrix = {"claim": program(1, "a")}
        strict = statement(
            {"kind": "positive_definite", "matrix": {"entries": [[0, 1], [1, 0]]}}, matrix, ["a"]
        )
        refute(strict, values={"a": "1"}, x=["1", "-1"])
        with pytest.raises(Invalid, match="zero"):
            refute(strict, values={"a": "1"}, x=["0", "0"])
        weak = {**strict, "claim": {**strict["claim"], "kind": "positive_semidefinite"}}
        with pytest.raises(Invalid, match="the claim holds"):
            refute(weak, values={"a": "1"}, x=["1", "-1"])

    def test_products_with_identities_and_blocks(self):
        tree = {"blocks": [{"entries": [[0]]}, {"kron_identity": {"entries": [[0, 1], [1, 0]]}, "size": 2}]}
        stated = statement(
            {"kind": "positive_semidefinite", "matrix": tree}, {"claim": program(1, "a")}, ["a"]
        )
        refute(stated, values={"a": "2"}, x=["0", "1", "0", "-1", "0"])
        with pytest.raises(Invalid, match="the claim holds"):
            refute(stated, values={"a": "2"}, x=["0", "1", "0", "0", "-1"])
        with pytest.raises(Invalid, match="5 rows"):
            refute(stated, values={"a": "2"}, x=["1", "-1"])


class TestRates:
    """V = q^2 with q' = -q u: the rate is -2 q^2 u, which is not always negative."""

    stated = statement(
        {"kind": "nonnegative", "shape": [1, 1]},
        {
            "claim": program(("NEG", "Vdot")),
            "V": program(("SQ", "q")),
            "m": program(("NEG", ("*", "q", "u"))),
        },
        {"q": "state", "u": "parameter"},
        names={"Vdot": {"is": "rate", "of": ["V", 0], "law": None}},
        motion={"q": ["m", 0]},
    )

    def test_the_rate_is_formed_by_the_kernel(self):
        refute(self.stated, values={"q": "1", "u": "-1"}, at=0)
        with pytest.raises(Invalid, match="the claim holds"):
            refute(self.stated, values={"q": "1", "u": "1"}, at=0)


class TestFleets:
    """The sum over the neighbours of q.i - q.j is zero: true for one edge with equal ends, not otherwise."""

    stated = statement(
        EQUAL,
        {"claim": program("S.i", 0), "term": program(("-", "q.i", "q.j"))},
        {"q.*": "state"},
        names={"S.*": {"is": "sum", "of": ["term", 0]}},
    )
    path = (["1", "2"], ["2", "3"])
    values = {"q.1": "1", "q.2": "0", "q.3": "-1"}  # noqa: RUF012

    def test_on_a_path_the_ends_refute_it_and_the_middle_does_not(self):
        refute(self.stated, values=self.values, graph=self.path, node="1", at=0)
        with pytest.raises(Invalid, match="the claim holds"):
            refute(self.stated, values=self.values, graph=self.path, node="2", at=0)

    def test_assumptions_hold_at_every_node(self):
        given = [assume("nonnegative", "g")]
        stated = {**self.stated, "given": given, "listings": {**self.stated["listings"], "g": program("q.i")}}
        with pytest.raises(Invalid, match="assumption 1"):
            refute(stated, values=self.values, graph=self.path, node="1", at=0)
        refute(stated, values={**self.values, "q.3": "0"}, graph=self.path, node="1", at=0)

    @pytest.mark.parametrize(
        "graph",
        [
            [],
            [["1", "1"], ["1", "2"], ["2", "3"]],
            [["1", "2"], ["2", "1"], ["2", "3"]],
            [["1", "2"], ["2", "3"], ["2", "3"]],
            [["1", "2", "3"]],
            [["1"], ["2", "3"]],
            [["1", "2"], ["3", "4"]],
            [["1", "i"], ["1", "2"], ["2", "3"]],
            [[1, 2], [2, 3]],
        ],
    )
    def test_what_is_no_graph(self, graph):
        with pytest.raises(Invalid):
            refute(self.stated, values={**self.values, "q.4": "0"}, graph=graph, node="1", at=0)

    def test_values_are_for_exactly_the_nodes_of_the_graph(self):
        for values in ({"q.1": "1", "q.2": "0"}, {**self.values, "q.4": "0"}):
            with pytest.raises(Invalid, match="values"):
                refute(self.stated, values=values, graph=self.path, node="1", at=0)

    @pytest.mark.parametrize("node", ["4", "*", "i", 1])
    def test_the_node_is_one_of_the_graph(self, node):
        with pytest.raises(Invalid):
            refute(self.stated, values=self.values, graph=self.path, node=node, at=0)


class TestAngles:
    """A symbol may stand for the angle with a rational cosine and sine."""

    @pytest.mark.parametrize(
        "turn", [("3/5", "4/5"), ("-3/5", "4/5"), ("-3/5", "-4/5"), ("0", "1"), ("-1", "0")]
    )
    def test_it_has_that_cosine_and_sine(self, turn):
        cos, sin = turn
        angle = {"x": {"cos": cos, "sin": sin}}
        for function, value in (("COS", cos), ("SIN", sin)):
            for margin in (1, -1):
                bound = str(Fraction(value) + Fraction(margin, 10**40))
                sides = ((function, "x"), bound) if margin > 0 else (bound, (function, "x"))
                off = ("-", *sides)
                refute(sign("nonnegative", off, ["x"]), values=angle, at=0)

    def test_it_is_the_principal_one(self):
        for low, cos in (("3", "-1"), ("-1/100", "1")):
            refute(sign("nonnegative", ("-", low, "x"), ["x"]), values={"x": {"cos": cos, "sin": "0"}}, at=0)
        below_pi = sign("nonnegative", ("-", "x", "22/7"), ["x"])
        refute(below_pi, values={"x": {"cos": "-1", "sin": "0"}}, at=0)

    @pytest.mark.parametrize(
        "angle",
        [
            {"cos": "3/5", "sin": "3/5"},
            {"cos": "0", "sin": "0"},
            {"cos": "1"},
            {"cos": "1", "sin": "0", "tan": "0"},
            {"cos": 0.6, "sin": 0.8},
            ["3/5", "4/5"],
        ],
    )
    def test_what_is_no_angle(self, angle):
        with pytest.raises(Invalid):
            refute(sign("nonnegative", ("-", ("COS", "x"), 2), ["x"]), values={"x": angle}, at=0)


class TestNeighbours:
    """q.i = q.j for a node and its neighbour."""

    stated = statement(EQUAL, {"claim": program("q.i", "q.j")}, {"q.*": "state"})
    path = (["1", "2"], ["2", "3"])
    values = {"q.1": "1", "q.2": "0", "q.3": "0"}  # noqa: RUF012

    def test_an_edge_refutes_it(self):
        refute(self.stated, values=self.values, graph=self.path, node="1", neighbour="2", at=0)
        with pytest.raises(Invalid, match="the claim holds"):
            refute(self.stated, values=self.values, graph=self.path, node="2", neighbour="3", at=0)

    @pytest.mark.parametrize(
        "at",
        [{"node": "1"}, {"neighbour": "2"}, *({"node": "1", "neighbour": n} for n in ("1", "3", "4", 2))],
    )
    def test_only_an_edge_does(self, at):
        with pytest.raises(Invalid):
            refute(self.stated, values=self.values, graph=self.path, at=0, **at)


def test_a_definition_is_not_refuted_by_values():
    stated = statement({"kind": "conforms", "shape": [1, 1]}, {"claim": program("x")}, ["x"])
    with pytest.raises(Invalid, match="conforms"):
        refute(stated, values={"x": "1"}, at=0)


def dense(tree):
    """The matrix of a tree whose outputs are the numbers 0, 1, .."""
    if "entries" in tree:
        return np.array(tree["entries"])
    if "kron_identity" in tree:
        return np.kron(dense(tree["kron_identity"]), np.eye(tree["size"], dtype=int))
    parts = [dense(block) for block in tree["blocks"]]
    ends = np.cumsum([0, *(len(part) for part in parts)])
    whole = np.zeros((ends[-1], ends[-1]), dtype=int)
    for part, a, b in zip(parts, ends, ends[1:], strict=False):
        whole[a:b, a:b] = part
    return whole


squares = st.integers(1, 3).flatmap(
    lambda n: st.lists(st.lists(st.integers(0, 9), min_size=n, max_size=n), min_size=n, max_size=n)
)
trees = st.recursive(
    squares.map(lambda rows: {"entries": rows}),
    lambda inner: (
        st.lists(inner, min_size=1, max_size=3).map(lambda blocks: {"blocks": blocks})
        | st.tuples(inner, st.integers(1, 3)).map(lambda pair: {"kron_identity": pair[0], "size": pair[1]})
    ),
    max_leaves=4,
)


@given(trees, st.data())
def test_the_form_of_a_tree_is_that_of_its_matrix(tree, data):
    matrix = dense(tree)
    x = data.draw(st.lists(st.integers(-3, 3), min_size=len(matrix), max_size=len(matrix)))
    form, size = witness._form(tree, [point(k) for k in range(10)], list(map(Fraction, x)))
    assert (form.lo, form.hi, size) == (np.array(x) @ matrix @ x, form.lo, len(matrix))
