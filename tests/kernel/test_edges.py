"""What the field divides by is not zero along a solution, and the sign that is kept by this."""

import pytest

from tests.kernel.test_argument import argument, available, ran


@pytest.mark.parametrize(
    ("rate", "edge", "known"),
    [
        ("1 x /", "x", True),
        ("1 x x * 1 - /", "x", False),
        ("1 x x * 1 - /", "x x * 1 -", True),
        ("x -1/2 ^", "x", False),
        ("x 1/2 ^", "x", False),
        ("x abs", "x abs", False),
        ("x", "x", False),
    ],
)
def test_what_the_field_divides_by_is_not_zero_along_a_solution(rate, edge, known):
    at = argument({"x": rate}, {"g": edge})
    at.begin({}, ["g"])
    assert at.judge.unmet == ([] if known else ["the field has no value where it is zero"])
    assert [(a.kind, a.of) for a in at.available] == [("nonzero", (("g", 0),))]


def test_the_sign_at_the_beginning_is_kept_where_it_is_strict():
    given = [("nonnegative", "x", "initial"), ("positive", "x", "initial"), ("positive", "y", "initial")]
    at = argument({"x": "1 x / y +", "y": "y neg"}, {"x": "x"}, given=given)
    assert ran(at, "keeps_sign", {"g": "x"}) == []
    assert available(at) == ["assumption 2"]
    assert [a.text for _, a in at.initial] == ["assumption 1", "assumption 3"]
