"""Certificates about polynomials: right ones, every way to fool the checker that we know, and large ones."""

from __future__ import annotations

from typing import Any

from symctrl.kernel.certificate import digest
from tests.kernel.certificates import Json

X2 = [["1", [0, 2]]]
ONE_MINUS_X2 = [["1", []], ["-1", [0, 2]]]
X2_MINUS_2 = [["-2", []], ["1", [0, 2]]]
X = [["1", [0, 1]]]
# x^2 - x y + y^2 = b' G b / 2 with b = (x, y), G = [[2, -1], [-1, 2]]
FORM = [["-1", [0, 1, 1, 1]], ["1", [0, 2]], ["1", [1, 2]]]
ROWS = [[2], [-1, 2]]
BASIS = [[[1, [0, 1]]], [[1, [1, 1]]]]


def sealed(whole: Json) -> Json:
    """With the digest of the whole recomputed."""
    rest = {key: value for key, value in whole.items() if key != "sha256"}
    return {**rest, "sha256": digest(rest)}


def case(proof: Json, polynomial: Any = FORM, claim: Any = "nonnegative", **changes: Any) -> Json:
    statement = {
        "study": "tests",
        "id": "one",
        "text": "a small polynomial",
        "variables": ["x", "y"],
        "polynomial": polynomial,
        "nonnegative": [],
        "zero": [],
        "claim": claim,
        **changes,
    }
    return sealed(
        {"format": "symctrl-certificate/1", "tool": "tests", "statement": statement, "proof": proof}
    )


def part(**changes: Any) -> Json:
    zeros = [[0], [0, 0]]
    form = {"product": [], "basis": BASIS, "gram": ROWS, "denominator": 2, "lower": zeros, "scale": 1}
    return form | changes


def square(basis: Any, product: Any = (), gram: int = 1, d: int = 1) -> Json:
    one = {"basis": [basis], "gram": [[gram]], "denominator": d, "lower": [[0]], "scale": 1}
    return {"product": list(product), **one}


ONE = [[1, []]]
UNIT: Json = {"constant": "1", "parts": []}


def squares(*parts: Json, multiplier: Any = UNIT, margin: Any = "0", multiples: Any = ()) -> Json:
    return {
        "kind": "squares",
        "multiplier": multiplier,
        "margin": margin,
        "parts": list(parts),
        "multiples": list(multiples),
    }


def empty(*parts: Json, margin: Any = "1", multiples: Any = ()) -> Json:
    return {"kind": "empty", "margin": margin, "parts": list(parts), "multiples": list(multiples)}


def witness(**values: Any) -> Json:
    return {"kind": "witness", "values": values}


def of_form(**changes: Any) -> Json:
    return case(squares(part(**changes)))


NOTHING = {"constant": "0", "parts": []}
WEAK = {"constant": "0", "parts": [square([[1, [0, 1]]])]}  # x^2
# Motzkin's polynomial times x^2 + y^2 + 1 would be long; x^2 (x^2 - x y + y^2) is as good a lesson.
LIFTED = part(basis=[[[1, [0, 2]]], [[1, [0, 1, 1, 1]]]])
DISC: Json = {"nonnegative": [ONE_MINUS_X2]}
ROOT: Json = {"zero": [X2_MINUS_2]}
NONE_: Json = {"nonnegative": [[["-1", []], ["-1", [0, 2]]]]}

GOOD: dict[str, Json] = {
    "polynomial_form": of_form(),
    "polynomial_form_by_a_factor": of_form(lower=[[2], [-1, 1]], scale=3),
    "polynomial_zero": case(squares(), []),
    "polynomial_positive": case(squares(square([[1, [0, 1]]]), margin="2"), [["2", []], *X2], "positive"),
    "polynomial_multiplier": case(squares(LIFTED, multiplier=WEAK)),
    "polynomial_on_a_disc": case(squares(square(ONE, [0])), ONE_MINUS_X2, **DISC),
    "polynomial_on_roots": case(squares(multiples=[[["1", []]]]), X2_MINUS_2, **ROOT),
    "polynomial_on_nothing": case(empty(square([[1, [0, 1]]]), square(ONE, [0])), [["-1", []]], **NONE_),
    "polynomial_on_nothing_positive": case(
        empty(square([[1, [0, 1]]]), square(ONE, [0])), [["-1", []]], "positive", **NONE_
    ),
    "polynomial_witness": case(witness(x="1/2", y="0"), X2_MINUS_2),
    "polynomial_witness_on_a_disc": case(witness(x="-1", y="0"), X, **DISC),
    "polynomial_witness_of_zero": case(witness(x="0", y="0"), X2, "positive"),
}
BAD: dict[str, Json] = {
    "polynomial_zero_gram": of_form(gram=[[0], [0, 0]], scale=1),
    "polynomial_scale_zero": of_form(gram=[[-2], [1, -2]], scale=0),
    "polynomial_scale_negative": of_form(scale=-1),
    "polynomial_denominator_zero": of_form(denominator=0),
    "polynomial_denominator_negative": of_form(gram=[[-2], [1, -2]], denominator=-2),
    "polynomial_denominator_wrong": of_form(denominator=3),
    "polynomial_gram_indefinite": case(
        squares(part(gram=[[1], [-2, 1]], denominator=1)),
        [["-4", [0, 1, 1, 1]], ["1", [0, 2]], ["1", [1, 2]]],
    ),
    "polynomial_gram_full_rows": of_form(gram=[[2, -1], [-1, 2]]),
    "polynomial_gram_asymmetric": of_form(gram=[[2, 1], [-1, 2]]),
    "polynomial_gram_of_strings": of_form(gram=[["2"], [-1, 2]]),
    "polynomial_gram_with_true": case(squares(square([[1, [0, 1]]]) | {"gram": [[True]]}), X2),
    "polynomial_gram_too_short": of_form(gram=[[2]]),
    "polynomial_lower_too_long": of_form(lower=[[0], [0, 0], [0, 0, 0]]),
    "polynomial_lower_too_large": of_form(lower=[[9], [0, 9]]),
    "polynomial_denominator_true": case(squares(square([[1, [0, 1]]]) | {"denominator": True}), X2),
    "polynomial_basis_wrong": of_form(basis=[[[1, [0, 1]]], [[1, [0, 1]]]]),
    "polynomial_basis_zero_coefficient": of_form(basis=[[[1, [0, 1]]], [[0, []], [1, [1, 1]]]]),
    "polynomial_basis_rational": of_form(basis=[[["1", [0, 1]]], [[1, [1, 1]]]]),
    "polynomial_basis_other_variable": of_form(basis=[[[1, [0, 1]]], [[1, [2, 1]]]]),
    "polynomial_exponent_negative": of_form(basis=[[[1, [0, -1]]], [[1, [1, 1]]]]),
    "polynomial_exponent_zero": case(squares(square([[1, [0, 0]]])), [["1", []]]),
    "polynomial_monomial_odd": case(squares(), [["1", [0]]]),
    "polynomial_monomial_turned": case(squares(), [["1", [1, 1, 0, 1]]]),
    "polynomial_terms_twice": case(squares(square([[1, [0, 1]]])), [["1/2", [0, 2]], ["1/2", [0, 2]]]),
    "polynomial_terms_unsorted": case(squares(square(ONE), square([[1, [0, 1]]])), [*X2, ["1", []]]),
    "polynomial_coefficient_zero": case(squares(), [["0", []]]),
    "polynomial_coefficient_unreduced": case(squares(square([[1, [0, 1]]])), [["2/2", [0, 2]]]),
    "polynomial_coefficient_no_string": case(squares(square([[1, [0, 1]]])), [[1, [0, 2]]]),
    "polynomial_variables_twice": case(squares(square([[1, [0, 1]]])), X2, variables=["x", "x"]),
    "polynomial_without_variables": case(squares(), [], variables=[]),
    "polynomial_variable_no_name": case(squares(), [], variables=["x", "x + 1"]),
    "polynomial_claim_unknown": case(squares(part()), claim="negative"),
    "polynomial_margin_negative": case(squares(square(ONE), margin="-1"), []),
    "polynomial_margin_for_strictness": case(squares(part()), claim="positive"),
    "polynomial_margin_not_there": case(squares(part(), margin="1"), claim="positive"),
    "polynomial_multiplier_zero": case(squares(multiplier=NOTHING)),
    "polynomial_multiplier_zero_for_all": case(squares(multiplier=NOTHING, margin="0"), [["-1", []]]),
    "polynomial_multiplier_with_zero_gram": case(
        squares(multiplier={"constant": "0", "parts": [square(ONE, gram=0)]}), [["-1", []]]
    ),
    "polynomial_multiplier_negative": case(
        squares(square(ONE), multiplier={"constant": "-1", "parts": []}), [["-1", []]]
    ),
    "polynomial_multiplier_not_semidefinite": case(
        squares(square(ONE), multiplier={"constant": "0", "parts": [square(ONE, gram=-1)]}), [["-1", []]]
    ),
    # On the line x = 0 the multiplier x^2 says nothing.
    "polynomial_multiplier_zero_on_the_set": case(
        squares(multiplier=WEAK, multiples=[[["-1", [0, 1]]]]), [["-1", []]], zero=[X]
    ),
    "polynomial_multiplier_weighted": case(
        squares(square(ONE, [0]), multiplier={"constant": "0", "parts": [square(ONE, [0])]}),
        [["1", []]],
        nonnegative=[X],
    ),
    "polynomial_constraint_not_used_right": case(squares(square(ONE)), X, nonnegative=[X]),
    "polynomial_constraint_of_none": case(squares(square(ONE, [1])), X, nonnegative=[X]),
    "polynomial_constraint_of_the_end": case(squares(square(ONE, [-1])), X, nonnegative=[X]),
    "polynomial_constraint_twice": case(squares(square(ONE, [0, 0])), X2, nonnegative=[X]),
    "polynomial_equation_as_a_weight": case(squares(square(ONE, [0])), X, zero=[X]),
    "polynomial_multiple_missing": case(squares(), X2_MINUS_2, **ROOT),
    "polynomial_multiple_wrong": case(squares(multiples=[[["2", []]]]), X2_MINUS_2, **ROOT),
    "polynomial_on_nothing_without_margin": case(empty(margin="0"), [["-1", []]]),
    "polynomial_on_something": case(empty(square(ONE, [0]), margin="1"), [["-1", []]], nonnegative=[X]),
    "polynomial_witness_outside": case(witness(x="-2", y="0"), X, **DISC),
    "polynomial_witness_beside_the_roots": case(witness(x="-7/5", y="0"), X, **ROOT),
    "polynomial_witness_of_nothing": case(witness(x="1", y="0"), FORM),
    "polynomial_witness_of_equality": case(witness(x="0", y="0"), FORM),
    "polynomial_witness_incomplete": case(witness(x="0"), X2_MINUS_2),
    "polynomial_witness_too_much": case(witness(x="0", y="0", z="0"), X2_MINUS_2),
    "polynomial_witness_nan": case(witness(x="nan", y="0"), X2_MINUS_2),
    "polynomial_witness_true": case(witness(x=True, y="0"), X2_MINUS_2),
    "polynomial_field_too_many": case(squares(part()) | {"hint": 1}),
    "polynomial_not_the_polynomial": case(squares(part()), [*FORM[:2], ["3/2", [1, 2]]]),
}
CORNER: dict[str, tuple[str, Any]] = {
    "polynomial_proof_of_another_kind": ("declined", case({"kind": "identity"})),
    "polynomial_of_a_vast_degree": ("declined", case(squares(), [["1", [0, 10**9]]])),
    "polynomial_of_many_variables": (
        "declined",
        case(squares(), [], variables=[f"x{k}" for k in range(3000)]),
    ),
    "polynomial_gram_without_rows": ("declined", of_form(basis=[], gram=[], lower=[])),
    "polynomial_with_decimals": (
        "invalid",
        '{"format": "symctrl-certificate/1", "statement": {"polynomial": [[0.5, []]]}, "proof": {}}',
    ),
    "polynomial_with_nan": (
        "unreadable",
        '{"format": "symctrl-certificate/1", "statement": {"polynomial": [[NaN, []]]}, "proof": {}}',
    ),
}
