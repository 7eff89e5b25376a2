"""What is learned from a value never justifies that the value exists."""

import pytest

from tests.kernel.certificates import certificate, explain, free, given, status

X = [["1", 0, 1]]
ROOT = [*free("x"), {"root": 2, "of": X}]
ROOT_SQUARED = [[[], [["1", 1, 2]]]]
IS_X = [[[], X]]


def sign_of_x(of, listing, proof):
    """Is x > 0 accepted by a proof that uses only what is given about `listing`?"""
    return certificate(
        {"claim": "return x", "g": listing},
        {"kind": "combination", "entries": [{"terms": [["1", [X], []]]}], **proof},
        scalars={"x": "state"},
        given=[given(of, "g")],
        claim={"kind": "positive", "shape": [1, 1], "listing": "claim"},
        conditions=[],
    )


@pytest.mark.parametrize(
    ("of", "listing"),
    [
        ("positive", "a = FABS x\nreturn a"),  # |x| as (root of x)^2 would say that x > 0
        ("zero", "a = FABS x\nb = SUB a 1\nreturn b"),
        ("positive", "a = SQ x\nb = SQRT a\nreturn b"),
        ("nonzero", "a = FABS x\nreturn a"),
    ],
)
def test_an_absolute_value_as_the_square_of_a_root(of, listing):
    one = sign_of_x(of, listing, {"generators": ROOT, "hints": [{"is": ROOT_SQUARED}]})
    assert status(one) == "invalid"


def test_an_absolute_value_as_its_argument():
    one = sign_of_x("positive", "a = FABS x\nreturn a", {"generators": free("x"), "hints": [{"is": IS_X}]})
    assert "not stated" in explain(one)


def test_an_inverse_of_an_absolute_value_by_a_root_that_cancels():
    """1/|x| > 0 would say that 1/x > 0 if |x| could be the square of a root that is then divided out."""
    proof = {
        "generators": ROOT,
        "factors": [X],
        "hints": [{"is": ROOT_SQUARED}, {"inverse": ["1", [[0, 1]]]}],
    }
    assert status(sign_of_x("positive", "a = FABS x\nb = INV a\nreturn b", proof)) == "invalid"


def test_the_square_of_a_sign_is_one_only_where_it_is_said_to_be():
    """sign(x)^2 < 1 + x holds at x = 0; with sign(x)^2 = 1 it would say x > 0, and so that sign(x)^2 = 1."""
    sign = {"generators": [*free("x"), {"abs": X}, {"sign": X, "abs": 1}]}
    one = certificate(
        {
            "claim": "a = INV x\nb = MUL a x\nc = SIGN x\nd = SQ c\nreturn b d 1 1",
            "g": "a = SIGN x\nb = SQ a\nc = ADD x 1\nd = SUB c b\nreturn d",
        },
        {**sign, "factors": [X], "hints": [{"inverse": ["1", [[0, 1]]]}, {"is": [[[], [["1", 2, 1]]]]}]},
        scalars={"x": "state"},
        given=[given("positive", "g")],
        claim={"kind": "equal", "shape": [2, 1], "listing": "claim"},
        conditions=[],
    )
    assert "x is nonzero is needed" in explain(one)


def test_what_a_given_divides_by_is_not_zero_where_it_is_met():
    one = certificate(
        {"claim": "a = MUL x y\nb = DIV a x\nreturn b y", "g": "a = INV x\nb = SUB a y\nreturn b"},
        {"generators": free("x", "y"), "factors": [X], "hints": [{"inverse": ["1", [[0, 1]]]}]},
        scalars={"x": "state", "y": "state"},
        given=[given("nonnegative", "g")],
    )
    assert status(one) == "valid"
    assert one["statement"]["conditions"] == []


def test_a_hint_that_is_refused_leaves_no_condition():
    """The first hint is the power of another exponent; only its check asks for x > 0 before it refuses."""
    one = certificate(
        {"claim": "a = FABS x\nb = POW a 1/2\nc = SQ b\nreturn c a"},
        {
            "generators": [*free("x"), {"abs": X}, {"root": 2, "of": [["1", 1, 1]]}],
            "hints": [{"is": [[[], [["1", 1, 1]]]]}, {"is": [[[], [["1", 2, 1]]]]}],
        },
        scalars={"x": "state"},
    )
    assert one["statement"]["conditions"] == []
    assert status(one) == "valid"


def test_plain_polynomials_are_learned_first():
    """The root of k is real because k > 0 is given, wherever in the list that stands."""
    listings = {
        "claim": "a = SQRT k\nb = SQ a\nreturn b k",
        "r": "a = SQRT k\nb = SUB a x\nreturn b",
        "k": "return k",
    }
    for order in (("r", "k"), ("k", "r")):
        one = certificate(
            listings,
            {
                "generators": [*free("x", "k"), {"root": 2, "of": [["1", 1, 1]]}],
                "hints": [{"is": [[[], [["1", 2, 1]]]]}],
            },
            scalars={"x": "state", "k": "parameter"},
            given=[given("positive", name) for name in order],
        )
        assert one["statement"]["conditions"] == []
