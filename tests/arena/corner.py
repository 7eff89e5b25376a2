"""What is vacuous, unknown, too large or no certificate: each with its answer."""

from __future__ import annotations

from tests.arena.changes import changed
from tests.arena.good import DIVISION, REFUTED, SMALL, SQUARES, TWO, matrix, states, v, witness
from tests.kernel.certificates import Json, certificate, free, given, seal

# Nothing is both greater than 0 and less than -x^2, so x = 0 follows.
VACUOUS = certificate(
    {"claim": "return x 0", "g": "a = SQ x\nb = NEG a\nc = SUB b y\nreturn c", "h": "return y"},
    {
        "kind": "squeeze",
        "generators": free("x", "y"),
        "entries": [{"power": 1, "terms": [["1", [0], []], ["1", [1], []]]}],
    },
    **states("x", "y"),
    given=[given("positive", "g"), given("positive", "h")],
)
TIED = matrix(
    "positive_definite",
    {"claim": "a = MUL k b\nc = SUB 1 a\nreturn 1 0 c", "g": "a = SQ b\nc = MUL k a\nd = SUB c 1\nreturn d"},
    TWO,
    {"minors": [{"terms": [["1", [], []]]}] * 2},
    scalars={"b": "parameter", "k": "parameter"},
    proof={"generators": free("b", "k")},
    more={"small": "b"},
    given=[given("zero", "g")],
    conditions=[],
)
CASES: dict[str, tuple[str, Json | str]] = {
    "another_version": ("unreadable", seal({**DIVISION, "format": "symctrl-certificate/2"})),
    "no_json": ("unreadable", "{"),
    "a_key_twice": ("unreadable", '{"format": "symctrl-certificate/1", "format": "symctrl-certificate/1"}'),
    "not_a_number": ("unreadable", '{"format": "symctrl-certificate/1", "tool": NaN}'),
    "deep": ("unreadable", "[" * 100_000),
    "rate_defined_through_itself": (
        "declined",
        certificate(
            {"claim": "return r 0", "V": "a = ADD x r\nreturn a", "f": "return x"},
            {"generators": free("x")},
            **states("x"),
            conditions=[],
            motion={"x": ["f", 0]},
            names={"r": {"is": "rate", "of": ["V", 0], "law": None}},
        ),
    ),
    "unknown_operation": (
        "declined",
        changed(DIVISION, "statement", "listings", "claim", "code", to=[["INPUT", "x"], ["MAGIC", 0]]),
    ),
    "unknown_proof": ("declined", changed(DIVISION, "proof", "kind", to="oracle")),
    "small_gain_tied_by_an_assumption": ("declined", TIED),
    "small_gain_beside_a_state": ("declined", changed(SMALL, "statement", "claim", "small", to="c")),
    "equal_irrational_numbers": (
        "declined",
        witness(
            {"claim": "a = SIN x\nb = SQ a\nc = COS x\nd = SQ c\ne = ADD b d\nreturn e 1"},
            {"values": {"x": "2/7"}, "at": 0},
            **states("x"),
        ),
    ),
    "assumptions_that_nothing_meets": ("valid", VACUOUS),
    "weaker_statement": ("valid", changed(SQUARES, "statement", "text", to="x and y are zero")),
    "one_point": ("valid", REFUTED),
    "zero_power": (
        "valid",
        certificate(
            {"claim": "a = SUB x x\nb = POW a 0\nreturn b 1"}, {"generators": free("x")}, **states("x")
        ),
    ),
    "root_of_zero": (
        "valid",
        certificate(
            {"claim": "a = SUB x x\nb = SQRT a\nreturn b 0"},
            {"generators": free("x"), "hints": [{"is": []}]},
            **states("x"),
        ),
    ),
    "sign_of_zero": (
        "valid",
        certificate(
            {"claim": "a = SUB x x\nb = SIGN a\nreturn b 0"},
            {"generators": free("x"), "hints": [{"is": []}]},
            **states("x"),
        ),
    ),
    "root_under_its_condition": (
        "valid",
        certificate(
            {"claim": "a = SQ x\nb = SQRT a\nreturn b x"},
            {"generators": free("x"), "hints": [{"is": v(["1", 0, 1])}]},
            **states("x"),
        ),
    ),
}
