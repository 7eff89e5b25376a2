"""Right proofs, one or more for each kind."""

from __future__ import annotations

from typing import Any

from symctrl.kernel.certificate import digest
from tests.kernel.certificates import Json, certificate, free, given, seal

X = [["1", 0, 1]]
Y = [["1", 1, 1]]
ONE = {"terms": [["1", [], []]]}


def v(*terms: list[Any]) -> list[Any]:
    """A VALUE without denominators."""
    return [[[], [list(term) for term in terms]]]


def states(*names: str) -> Json:
    return {"scalars": dict.fromkeys(names, "state")}


def signs(kind: str, listings: dict[str, str], entries: list[Any], **tables: Any) -> Json:
    """A claim that each output of the listing `claim` is of a sign, by a combination."""
    proof = {
        "kind": "combination",
        "entries": [{"terms": terms} for terms in entries],
        **tables.pop("proof", {}),
    }
    claim = {"kind": kind, "shape": [len(entries), 1], "listing": "claim"}
    return certificate(listings, proof, claim=claim, **tables)


def matrix(kind: str, listings: dict[str, str], tree: Any, leaf: Any, **tables: Any) -> Json:
    proof = {"kind": "definite", "matrix": leaf, **tables.pop("proof", {})}
    claim = {"kind": kind, "matrix": tree, "listing": "claim", **tables.pop("more", {})}
    return certificate(listings, proof, claim=claim, **tables)


def witness(listings: dict[str, str], proof: Json, **tables: Any) -> Json:
    one = certificate(listings, {}, conditions=[], **tables)
    one["proof"] = {"kind": "witness", **proof}
    return seal(one)


def bundle(*parts: Json) -> Json:
    return sealed({"format": "symctrl-certificates/1", "tool": "tests", "parts": list(parts)})


def sealed(whole: Json) -> Json:
    """With the outer digest alone recomputed."""
    rest = {key: value for key, value in whole.items() if key != "sha256"}
    return {**rest, "sha256": digest(rest)}


TWO = {"entries": [[0, 1], [1, 2]]}
LDL = {"ldl": {"lower": [["1"], ["1/2", "1"]], "diagonal": ["2", "1/2"]}}
EDGE = "a = SUB q.i q.j\nreturn a"
SUMS = [
    {"sum": [], "node": "i"},
    {"sum": [[2, 1]], "node": "i"},
    {"sum": [], "node": "j"},
    {"sum": [[1, 1]], "node": "j"},
]

DIVISION = certificate(
    {"claim": "a = MUL x y\nb = DIV a y\nreturn b x"},
    {"generators": free("x", "y"), "factors": [Y], "hints": [{"inverse": ["1", [[0, 1]]]}]},
    **states("x", "y"),
)
RATE = certificate(
    {
        "claim": "a = SQ x\nb = MUL k a\nc = NEG b\nreturn r c",
        "V": "a = SQ x\nb = DIV a 2\nreturn b",
        "f": "return u",
        "L": "a = MUL k x\nb = NEG a\nreturn b",
    },
    {"generators": free("x", "k")},
    scalars={"x": "state", "k": "parameter", "u": "input"},
    motion={"x": ["f", 0]},
    laws={"pd": {"u": ["L", 0]}},
    names={"r": {"is": "rate", "of": ["V", 0], "law": "pd"}},
)
SQUARES = signs(
    "nonnegative",
    {"claim": "a = SUB x y\nb = SQ a\nc = SQ y\nd = ADD b c\nreturn d"},
    [[["1", [], [[["1", 0, 1], ["-1", 1, 1]]]], ["1", [], [Y]]]],
    **states("x", "y"),
    proof={"generators": free("x", "y")},
)
EDGES = certificate(
    {"claim": "return T 0", "node": "return S.i", "edge": EDGE},
    {"generators": [*free("T", "q.i", "q.j"), *SUMS]},
    scalars={"q.*": "state"},
    names={"T": {"is": "total", "of": ["node", 0]}, "S.*": {"is": "sum", "of": ["edge", 0]}},
)
NUMBERS = matrix("positive_definite", {"claim": "return 2 1 1"}, TWO, LDL, scalars={})
REFUTED = witness({"claim": "a = SQ x\nreturn a x"}, {"values": {"x": "1/2"}, "at": 0}, **states("x"))
SMALL = matrix(
    "positive_definite",
    {"claim": "return 1 b b"},
    TWO,
    {"minors": [ONE, ONE]},
    scalars={"b": "parameter"},
    proof={"generators": free("b")},
    more={"small": "b"},
)
SQUEEZE = certificate(
    {"claim": "return x 0", "g": "a = SQ x\nb = SQ y\nc = ADD a b\nreturn c"},
    {"kind": "squeeze", "generators": free("x", "y"), "entries": [{"power": 1, "terms": [["1", [], [Y]]]}]},
    **states("x", "y"),
    given=[given("zero", "g")],
)
CONFORMS = certificate(
    {"claim": "a = DIV x y\nreturn a"}, {}, **states("x", "y"), conditions=[],
    claim={"kind": "conforms", "shape": [1, 1], "listing": "claim"},
)  # fmt: skip
CONFORMS["proof"] = {"kind": "conforms"}
CONFORMS = seal(CONFORMS)

CASES: dict[str, Json] = {
    "division_under_its_condition": DIVISION,
    "rate_along_a_law": RATE,
    "sum_of_squares": SQUARES,
    "sum_over_edges": EDGES,
    "numbers_ldl": NUMBERS,
    "refuted": REFUTED,
    "small_gain": SMALL,
    "squeeze": SQUEEZE,
    "conforms": CONFORMS,
    "bundle": bundle(DIVISION, RATE),
}
