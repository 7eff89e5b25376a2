"""Malformed certificates: every field, index and digest that a careless reader would let pass."""

from __future__ import annotations

from tests.arena.changes import changed, more, relisted
from tests.arena.good import (
    CONFORMS,
    DIVISION,
    NUMBERS,
    RATE,
    SQUARES,
    X,
    bundle,
    sealed,
)
from tests.kernel.certificates import certificate, listing

FORM = {
    "digest_of_the_whole": changed(DIVISION, "tool", to="another", reseal=False),
    "digest_of_a_listing": sealed(
        changed(DIVISION, "statement", "listings", "claim", "outputs", to=[2, 1], reseal=False)
    ),
    "no_outputs": changed(CONFORMS, "statement", "listings", "claim", "outputs", to=[]),
    "empty_shape": changed(CONFORMS, "statement", "claim", "shape", to=[0, 1]),
    "output_out_of_range": changed(DIVISION, "statement", "listings", "claim", "outputs", to=[3, 9]),
    "output_repeated_in_place_of_another": changed(
        DIVISION, "statement", "listings", "claim", "outputs", to=[0, 0]
    ),
    "output_by_a_negative_index": changed(DIVISION, "statement", "listings", "claim", "outputs", to=[-1, 0]),
    "register_read_before_it_is_written": changed(
        CONFORMS, "statement", "listings", "claim", "code", to=[["INPUT", "x"], ["DIV", 0, 2], ["INPUT", "y"]]
    ),
    "register_reads_itself": changed(CONFORMS, "statement", "listings", "claim", "code", 2, to=["DIV", 0, 2]),
    "idle_instruction": more(DIVISION, "statement", "listings", "claim", "code", by=["SQ", 0]),
    "instruction_twice": relisted(
        DIVISION, "claim", "a = MUL x y\nb = MUL x y\nc = DIV a y\nd = ADD b c\nreturn d d"
    ),
    "idle_generator": more(DIVISION, "proof", "generators", by={"abs": X}),
    "idle_factor": more(DIVISION, "proof", "factors", by=X),
    "idle_hint": more(DIVISION, "proof", "hints", by={"inverse": ["1", [[0, 2]]]}),
    "idle_listing": changed(DIVISION, "statement", "listings", "more", to=listing("return x")),
    "idle_scalar": changed(DIVISION, "statement", "scalars", "z", to="state"),
    "idle_law": changed(RATE, "statement", "laws", "more", to={"u": ["L", 0]}),
    "unknown_field": changed(DIVISION, "statement", "note", to="trust me"),
    "missing_field": changed(DIVISION, "statement", "given", to=...),
    "condition_left_out": changed(DIVISION, "statement", "conditions", to=[]),
    "condition_too_many": more(DIVISION, "statement", "conditions", by={"kind": "nonzero", "of": "x"}),
    "condition_twice": changed(
        DIVISION, "statement", "conditions", to=DIVISION["statement"]["conditions"] * 2
    ),
    "condition_of_another_kind": changed(DIVISION, "statement", "conditions", 0, "kind", to="nonnegative"),
    "defined_through_itself": certificate(
        {"claim": "return V 0", "V": "a = ADD V 1\nreturn a"},
        {},
        scalars={},
        conditions=[],
        names={"V": {"is": "value", "of": ["V", 0]}},
    ),
    "name_is_also_a_scalar": changed(RATE, "statement", "scalars", "r", to="state"),
    "decimal": changed(NUMBERS, "proof", "matrix", "ldl", "diagonal", to=[2.0, 0.5]),
    "true_is_not_one": changed(NUMBERS, "proof", "matrix", "ldl", "diagonal", 0, to=True),
    "not_in_lowest_terms": changed(NUMBERS, "proof", "matrix", "ldl", "diagonal", 0, to="4/2"),
    "empty_bundle": bundle(),
    "bundle_with_one_bad_part": bundle(DIVISION, changed(DIVISION, "statement", "conditions", to=[])),
    "bundle_with_a_wrong_digest": {**bundle(DIVISION, RATE), "sha256": DIVISION["sha256"]},
    "wrong_kind_of_proof": changed(SQUARES, "statement", "claim", "kind", to="positive"),
    "conforms_proves_nothing_else": changed(DIVISION, "proof", to={"kind": "conforms"}),
}
