"""False signs, definiteness and refutations."""

from __future__ import annotations

from tests.arena.changes import changed, from_given, more, relisted
from tests.arena.good import (
    CONFORMS,
    EDGE,
    LDL,
    NUMBERS,
    ONE,
    REFUTED,
    SMALL,
    SQUARES,
    SQUEEZE,
    TWO,
    X,
    matrix,
    signs,
    states,
    witness,
)
from tests.kernel.certificates import Json, free, given

SIGNS = {
    "negative_multiplier": changed(SQUARES, "proof", "entries", 0, "terms", 1, 0, to="-1"),
    "zero_multiplier": changed(SQUARES, "proof", "entries", 0, "terms", 1, 0, to="0"),
    "no_terms": changed(SQUARES, "proof", "entries", 0, "terms", to=[]),
    "no_entries": changed(SQUARES, "proof", "entries", to=[]),
    "an_entry_twice": changed(SQUARES, "proof", "entries", to=SQUARES["proof"]["entries"] * 2),
    "strict_from_squares": changed(SQUARES, "statement", "claim", "kind", to="positive"),
    "times_zero": changed(
        changed(SQUARES, "proof", "entries", 0, "times", to=[[]]), "proof", "entries", 0, "terms", to=[]
    ),
    "times_a_negative_number": signs(
        "nonnegative",
        {"claim": "a = SQ x\nb = NEG a\nreturn b"},
        [[["1", [], [X]]]],
        **states("x"),
        conditions=[],
        proof={"generators": free("x"), "entries": [{"times": [[["-1"]]], "terms": [["1", [], [X]]]}]},
    ),
    "times_a_square": signs(
        "nonnegative",
        {"claim": "return x"},
        [[["1", [], []]]],
        **states("x"),
        conditions=[],
        proof={"generators": free("x"), "entries": [{"times": [[["1", 0, 2]]], "terms": [["1", [X], [X]]]}]},
    ),
    "a_nonzero_number_taken_for_positive": from_given("nonzero", "return x", {"generators": free("x")}),
    "a_factor_of_the_wrong_assumption": signs(
        "nonnegative",
        {"claim": "return x", "g": "return y"},
        [[["1", [0], []]]],
        proof={"generators": free("x", "y")},
        **states("x", "y"),
        given=[given("nonnegative", "g")],
        conditions=[],
    ),
    "sign_of_an_inverse_without_its_own": signs(
        "positive",
        {"claim": "a = INV x\nreturn a"},
        [[["1", [], []]]],
        proof={"generators": free("x"), "factors": [X], "hints": [{"inverse": ["1", [[0, 1]]]}]},
        **states("x"),
        conditions=[{"kind": "nonzero", "of": "x"}],
    ),
    "squeeze_of_power_zero": changed(SQUEEZE, "proof", "entries", 0, "power", to=0),
    "squeeze_of_the_wrong_sign": changed(SQUEEZE, "proof", "entries", 0, "terms", to=[["1", [], [X]]]),
    "squeeze_without_its_assumption": changed(SQUEEZE, "statement", "given", 0, "kind", to="nonnegative"),
    "form_of_a_matrix_that_is_not_assumed": signs(
        "nonnegative",
        {"claim": "a = SQ x\nb = MUL a p\nreturn b", "g": "return p"},
        [[["1", [{"given": 0, "vector": [X]}], []]]],
        proof={"generators": free("x", "p")},
        scalars={"x": "state", "p": "parameter"},
        given=[given("nonnegative", "g")],
        conditions=[],
    ),
}


HALF = {
    "rows": [["1", "0"], ["0", "1"]],
    "proof": {"ldl": {"lower": [["1"], ["0", "1"]], "diagonal": ["1", "1"]}},
}
P = {"claim": "return p q r", "P": "return p q q r"}
PQR = {
    "scalars": dict.fromkeys("pqr", "parameter"),
    "proof": {"generators": free("p", "q", "r")},
    "conditions": [],
}


def assumed(kind: str) -> Json:
    return {"kind": kind, "size": 2, "of": [["P", k] for k in range(4)], "text": "", "about": "parameter"}


def scaled(*diagonal: str) -> Json:
    """A matrix of numbers by dominance with a scale."""
    dominant = {"dominant": {"lower": [["0"], ["0", "0"]], "scale": list(diagonal)}}
    return matrix("positive_definite", {"claim": "return 1 2 3"}, TWO, dominant, scalars={}, conditions=[])


MATRICES = {
    "zero_scale": scaled("0", "0"),
    "negative_scale": scaled("-1", "-1"),
    "no_scale": scaled(),
    "not_semidefinite": matrix(
        "positive_semidefinite", {"claim": "return 2 3 1"}, TWO, LDL, scalars={}, conditions=[]
    ),
    "singular_taken_for_definite": matrix(
        "positive_definite",
        {"claim": "return 2 1 1/2"},
        TWO,
        {"ldl": {"lower": [["1"], ["1/2", "1"]], "diagonal": ["2", "0"]}},
        scalars={},
        conditions=[],
    ),
    "not_symmetric": matrix(
        "positive_definite",
        {"claim": "return 2 1 -1"},
        {"entries": [[0, 1], [2, 0]]},
        LDL,
        scalars={},
        conditions=[],
    ),
    "empty_matrix": changed(NUMBERS, "statement", "claim", "matrix", to={"blocks": []}),
    "no_copies": changed(NUMBERS, "statement", "claim", "matrix", to={"kron_identity": TWO, "size": 0}),
    "a_block_without_a_proof": matrix(
        "positive_definite",
        {"claim": "return 2 1 -1"},
        {"blocks": [TWO, {"entries": [[2]]}]},
        {"blocks": [LDL]},
        scalars={},
        conditions=[],
    ),
    "entry_left_out_of_the_tree": changed(NUMBERS, "statement", "claim", "matrix", to={"entries": [[0]]}),
    "semidefinite_assumed_for_a_strict_claim": matrix(
        "positive_definite", P, TWO, {"given": 0}, **PQR, given=[assumed("positive_semidefinite")]
    ),
    "another_matrix_than_assumed": matrix(
        "positive_definite",
        {**P, "claim": "return r q p"},
        TWO,
        {"given": 0},
        **PQR,
        given=[assumed("positive_definite")],
    ),
    "singular_congruence": matrix(
        "positive_definite",
        {**P, "claim": "return p q r 1"},
        {"congruence": TWO, "factor": [[3, 3], [3, 3]]},
        {"congruence": {"given": 0}},
        **PQR,
        given=[assumed("positive_definite")],
    ),
    "congruence_that_is_not_square": matrix(
        "positive_definite",
        {**P, "claim": "return p q r 1 0"},
        {"congruence": TWO, "factor": [[3, 4, 3], [4, 3, 3]]},
        {"congruence": {"given": 0}},
        **PQR,
        given=[assumed("positive_definite")],
    ),
    "sum_with_a_multiple_of_unknown_sign": matrix(
        "positive_definite",
        {"claim": "return a 0"},
        {"entries": [[0, 1], [1, 0]]},
        {"sum": [{"of": X, **HALF}]},
        scalars={"a": "parameter"},
        proof={"generators": free("a")},
        conditions=[],
    ),
    "sum_of_nothing": matrix(
        "positive_semidefinite",
        {"claim": "return -1"},
        {"entries": [[0]]},
        {"sum": []},
        scalars={},
        conditions=[],
    ),
    "sum_that_is_semidefinite_only": matrix(
        "positive_definite",
        {"claim": "return a 0", "g": "return a"},
        {"entries": [[0, 1], [1, 0]]},
        {"sum": [{"of": X, **HALF}]},
        scalars={"a": "parameter"},
        proof={"generators": free("a")},
        conditions=[],
        given=[given("nonnegative", "g")],
    ),
    "rows_of_unknown_sign": matrix(
        "positive_definite",
        {"claim": "return 1 a"},
        {"entries": [[0, 1], [1, 0]]},
        {"rows": [ONE, ONE]},
        scalars={"a": "parameter"},
        proof={"generators": free("a")},
        conditions=[],
    ),
    "a_minor_left_out": matrix(
        "positive_definite",
        {"claim": "return -1 0"},
        {"entries": [[0, 1], [1, 0]]},
        {"minors": [ONE]},
        scalars={},
        conditions=[],
    ),
    "small_gain_of_the_wrong_sign": relisted(SMALL, "claim", "a = NEG b\nreturn 1 b a"),
    "small_gain_not_small_enough": relisted(SMALL, "claim", "a = SQ b\nreturn 1 b a"),
}


VALUES = {
    "claim_holds_at_the_witness": changed(REFUTED, "proof", "values", "x", to="1"),
    "witness_outside_the_assumptions": witness(
        {"claim": "return x", "g": "return x"},
        {"values": {"x": "-1"}, "at": 0},
        **states("x"),
        claim={"kind": "nonnegative", "shape": [1, 1], "listing": "claim"},
        given=[given("positive", "g")],
    ),
    "witness_where_nothing_is_defined": witness(
        {"claim": "a = DIV x x\nreturn a 1"}, {"values": {"x": "0"}, "at": 0}, **states("x")
    ),
    "witness_with_conditions": more(REFUTED, "statement", "conditions", by={"kind": "nonzero", "of": "x"}),
    "witness_for_a_symbol_too_many": changed(REFUTED, "proof", "values", "y", to="1"),
    "witness_without_a_value": changed(REFUTED, "proof", "values", to={}),
    "witness_at_no_entry": changed(REFUTED, "proof", "at", to=1),
    "witness_against_what_conforms": changed(CONFORMS, "proof", to=REFUTED["proof"]),
    "zero_vector": witness(
        {"claim": "return 1"},
        {"values": {}, "x": ["0"]},
        scalars={},
        claim={"kind": "positive_definite", "matrix": {"entries": [[0]]}, "listing": "claim"},
    ),
    "witness_against_a_small_gain": changed(
        SMALL, "proof", to={"kind": "witness", "values": {"b": "2"}, "x": ["1", "-1"]}
    ),
    "neighbour_that_is_none": witness(
        {"claim": "return q.i q.j"},
        {
            "values": {"q.1": "0", "q.2": "0", "q.3": "1"},
            "graph": [["1", "2"], ["2", "3"]],
            "node": "1",
            "neighbour": "3",
            "at": 0,
        },
        scalars={"q.*": "state"},
    ),
    "node_is_its_own_neighbour": witness(
        {"claim": "return q.i q.j"},
        {"values": {"q.1": "0", "q.2": "1"}, "graph": [["1", "2"]], "node": "1", "neighbour": "1", "at": 0},
        scalars={"q.*": "state"},
    ),
    "graph_in_two_pieces": witness(
        {"claim": "return S.i 0", "edge": EDGE},
        {
            "values": {f"q.{k}": str(k) for k in (1, 2, 3, 4)},
            "graph": [["1", "2"], ["3", "4"]],
            "node": "1",
            "at": 0,
        },
        scalars={"q.*": "state"},
        names={"S.*": {"is": "sum", "of": ["edge", 0]}},
    ),
}
