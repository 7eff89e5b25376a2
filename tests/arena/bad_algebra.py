"""Tricks with divisions, roots, signs, angles, rates and sums over a graph."""

from __future__ import annotations

from tests.arena.changes import changed, from_given, identity, relisted
from tests.arena.good import (
    DIVISION,
    EDGE,
    EDGES,
    RATE,
    X,
    states,
    v,
)
from tests.kernel.certificates import certificate, free, given

ROOT_OF_X = [*free("x"), {"root": 2, "of": X}]
SIGN_OF_X = [*free("x"), {"abs": X}, {"sign": X, "abs": 1}]

ALGEBRA = {
    "false_equation": relisted(DIVISION, "claim", "a = MUL x y\nb = DIV a y\nreturn b y"),
    "division_by_zero": identity(
        "a = SUB x x\nb = DIV a a\nreturn b 7",
        {"generators": free("x"), "factors": [[]], "hints": [{"inverse": ["1", [[0, 1]]]}]},
        **states("x"),
    ),
    "division_by_a_zero_factor": identity(
        "a = INV z\nb = MUL a z\nreturn b 1",
        {"generators": free("z"), "factors": [X], "hints": [{"inverse": ["1", [[0, 1]]]}]},
        listings={"g": "return z"},
        **states("z"),
        given=[given("zero", "g")],
    ),
    "inverse_with_scale_zero": changed(DIVISION, "proof", "hints", 0, to={"inverse": ["0", [[0, 1]]]}),
    "inverse_of_another_value": changed(DIVISION, "proof", "hints", 0, to={"inverse": ["1", [[0, 2]]]}),
    "factor_is_a_number": changed(DIVISION, "proof", "factors", 0, to=[["1"]]),
    "root_of_a_square": identity(
        "a = SQ x\nb = SQRT a\nreturn b x",
        {"generators": free("x"), "hints": [{"is": v(["1", 0, 1])}]},
        **states("x"),
    ),
    "negative_root": identity("a = SQRT 4\nreturn a -2", {"hints": [{"is": v(["-2"])}]}, scalars={}),
    "absolute_value_is_the_argument": identity(
        "a = FABS x\nreturn a x", {"generators": free("x"), "hints": [{"is": v(["1", 0, 1])}]}, **states("x")
    ),
    "absolute_value_over_argument": identity(
        "a = FABS x\nb = DIV a x\nreturn b 1",
        {
            "generators": [*free("x"), {"abs": X}],
            "factors": [X],
            "hints": [{"is": v(["1", 1, 1])}, {"inverse": ["1", [[0, 1]]]}],
        },
        **states("x"),
        conditions=[{"kind": "nonzero", "of": "x"}],
    ),
    "sign_squared_is_one": identity(
        "a = SIGN x\nb = SQ a\nreturn b 1",
        {"generators": SIGN_OF_X, "hints": [{"is": v(["1", 2, 1])}]},
        **states("x"),
    ),
    "sign_squared_by_an_idle_factor": identity(
        "a = SIGN x\nb = SQ a\nreturn b 1",
        {"generators": SIGN_OF_X, "factors": [X], "hints": [{"is": v(["1", 2, 1])}]},
        **states("x"),
        conditions=[{"kind": "nonzero", "of": "x"}],
    ),
    "sign_squared_from_what_needs_it": identity(
        "a = INV x\nb = MUL a x\nc = SIGN x\nd = SQ c\nreturn b d 1 1",
        {
            "generators": SIGN_OF_X,
            "factors": [X],
            "hints": [{"inverse": ["1", [[0, 1]]]}, {"is": v(["1", 2, 1])}],
        },
        listings={"g": "a = SIGN x\nb = SQ a\nc = ADD x 1\nd = SUB c b\nreturn d"},
        claim={"kind": "equal", "shape": [2, 1], "listing": "claim"},
        **states("x"),
        given=[given("positive", "g")],
    ),
    "sign_of_another_argument": identity(
        "a = SIGN y\nb = SIGN x\nreturn a b",
        {"generators": [*SIGN_OF_X, *free("y")], "hints": [{"is": v(["1", 2, 1])}]},
        **states("x", "y"),
    ),
    "absolute_value_is_the_square_of_a_root": from_given(
        "positive", "a = FABS x\nreturn a", {"generators": ROOT_OF_X, "hints": [{"is": v(["1", 1, 2])}]}
    ),
    "square_root_is_the_square_of_a_root": from_given(
        "positive",
        "a = SQ x\nb = SQRT a\nreturn b",
        {"generators": ROOT_OF_X, "hints": [{"is": v(["1", 1, 2])}]},
    ),
    "a_root_that_cancels": from_given(
        "positive",
        "a = FABS x\nb = INV a\nreturn b",
        {
            "generators": ROOT_OF_X,
            "factors": [X],
            "hints": [{"is": v(["1", 1, 2])}, {"inverse": ["1", [[0, 1]]]}],
        },
    ),
    "sine_without_its_cosine": identity(
        "a = SIN x\nb = SQ a\nreturn b 1",
        {"generators": [*free("x"), {"sin": v(["1", 0, 1]), "cos": 0}], "hints": [{"is": v(["1", 1, 1])}]},
        **states("x"),
    ),
    "half_an_angle": identity(
        "a = DIV x 2\nb = COS a\nc = COS x\nreturn b c",
        {
            "generators": [*free("x"), {"cos": v(["1", 0, 1])}, {"sin": v(["1", 0, 1]), "cos": 1}],
            "hints": [{"is": v(["1", 1, 1])}],
        },
        **states("x"),
    ),
    "rate_of_another_law": relisted(RATE, "L", "a = MUL k x\nreturn a"),
    "rate_of_an_input": changed(relisted(RATE, "V", "return u"), "statement", "names", "r", "law", to=None),
    "parameter_in_the_place_of_a_state": changed(RATE, "statement", "scalars", "x", to="parameter"),
    "rate_of_a_sign": certificate(
        {"claim": "return r 0", "V": "a = SIGN x\nreturn a", "f": "return 1"},
        {"generators": SIGN_OF_X, "hints": [{"is": v(["1", 2, 1])}]},
        **states("x"),
        conditions=[],
        motion={"x": ["f", 0]},
        names={"r": {"is": "rate", "of": ["V", 0], "law": None}},
    ),
    "assumption_that_contradicts_itself": identity(
        "return x 0",
        {"generators": free("x")},
        listings={"g": "a = SUB x x\nb = ADD a 1\nreturn b"},
        **states("x"),
        given=[given("zero", "g")],
    ),
    "assumption_that_a_square_is_negative": identity(
        "return x 0",
        {"generators": free("x")},
        listings={"g": "a = SQ x\nb = ADD a 1\nreturn b"},
        **states("x"),
        given=[given("zero", "g")],
    ),
    "assumptions_that_contradict_each_other": identity(
        "return x 0",
        {"generators": free("x")},
        listings={"g": "return x", "h": "a = NEG x\nreturn a"},
        **states("x"),
        given=[given("positive", "g"), given("positive", "h")],
    ),
    "sum_over_directed_edges": relisted(EDGES, "edge", "return q.j"),
    "sum_over_edges_with_a_part_of_the_node": relisted(EDGES, "node", "a = ADD S.i q.i\nreturn a"),
    "sum_over_edges_of_a_product": relisted(EDGES, "node", "a = MUL S.i q.i\nreturn a"),
    "sum_over_edges_squared": relisted(EDGES, "claim", "a = SQ T\nreturn a 0"),
    "sum_at_a_node_is_not_zero": certificate(
        {"claim": "return S.i 0", "edge": EDGE},
        {"generators": [*free("q.i", "q.j"), {"sum": [], "node": "i"}, {"sum": [[1, 1]], "node": "i"}]},
        scalars={"q.*": "state"},
        names={"S.*": {"is": "sum", "of": ["edge", 0]}},
        conditions=[],
    ),
    "sum_of_the_wrong_monomial": changed(EDGES, "proof", "generators", 4, "sum", to=[[2, 2]]),
    "sum_of_what_belongs_to_both": changed(EDGES, "proof", "generators", 4, "sum", to=[[1, 1], [2, 1]]),
    "sum_of_what_belongs_to_the_node": changed(EDGES, "proof", "generators", 4, "sum", to=[[1, 1]]),
    "neighbour_equals_node": certificate(
        {"claim": "return q.i q.j"},
        {"generators": free("q.i", "q.j")},
        scalars={"q.*": "state"},
        conditions=[],
    ),
}
