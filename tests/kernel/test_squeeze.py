"""Equalities from squares that are not positive, beside near misses."""

import pytest

from symctrl.kernel.certificate import Invalid
from tests.kernel.programs import assume, program, statement, verify

NAMES = ("x", "y")
X_TIMES_Y = [["1", 0, 1, 1, 1]]


def prove(stated, *entries):
    proof = {"kind": "squeeze", "generators": [{"free": name} for name in NAMES], "factors": [], "hints": []}
    verify(stated, {**proof, "entries": list(entries)})


def equal(*sides, given=(), **listings):
    shape = [len(sides) // 2, 1]
    return statement({"kind": "equal", "shape": shape}, {"claim": program(*sides), **listings}, NAMES, given)


class TestZeroSumOfSquares:
    """x^2 + y^2 = 0: -x^2 is y^2, so x = 0."""

    listings = {"g": program(("+", ("SQ", "x"), ("SQ", "y")))}  # noqa: RUF012
    y_squared = {"power": 1, "terms": [["1", [], [[["1", 1, 1]]]]]}  # noqa: RUF012

    def stated(self, *sides, kind="zero"):
        return equal(*(sides or ("x", 0)), given=[assume(kind, "g")], **self.listings)

    def test_each_is_zero(self):
        prove(self.stated(), self.y_squared)

    @pytest.mark.parametrize(
        "entry",
        [
            {"power": 0, "terms": [["1", [], [[["1", 1, 1]]]]]},
            {"power": 5, "terms": [["1", [], [[["1", 1, 1]]]]]},
            {"power": -1, "terms": [["1", [], [[["1", 1, 1]]]]]},
            {"power": 2, "terms": [["1", [], [[["1", 1, 1]]]]]},
            {"power": 1, "terms": []},
            {"power": 1, "terms": [["-1", [], [[["1", 0, 1]]]]]},
            {"power": 1, "terms": [["1", [], [[["1", 0, 1]]]]]},
            {"power": 1, "terms": [["2", [], [[["1", 1, 1]]]]]},
            {"terms": [["1", [], [[["1", 1, 1]]]]]},
        ],
    )
    def test_near_misses(self, entry):
        with pytest.raises(Invalid):
            prove(self.stated(), entry)

    def test_the_assumption_is_needed(self):
        with pytest.raises(Invalid):
            prove(self.stated(kind="nonnegative"), self.y_squared)

    def test_other_sides(self):
        with pytest.raises(Invalid):
            prove(self.stated("x", 1), self.y_squared)

    def test_one_entry_for_each_of_the_claim(self):
        for entries in ((), (self.y_squared, self.y_squared)):
            with pytest.raises(Invalid, match="entries"):
                prove(self.stated(), *entries)


class TestEqualSquares:
    """x^2 = y^2 with x, y >= 0: -(x - y)^4 is 4 x y (x - y)^2."""

    listings = {  # noqa: RUF012
        "squares": program(("-", ("SQ", "x"), ("SQ", "y"))),
        "x": program("x"),
        "y": program("y"),
    }

    def stated(self, of_x="nonnegative", of_y="nonnegative"):
        given = [assume("zero", "squares"), assume(of_x, "x"), assume(of_y, "y")]
        return equal("x", "y", given=given, **self.listings)

    def test_signs_are_needed(self):
        terms = [["4", [1, 2], [[["1", 0, 1], ["-1", 1, 1]]]]]
        prove(self.stated(), {"power": 2, "terms": terms})
        for of_x, of_y in (("nonzero", "nonnegative"), ("nonnegative", "nonzero")):
            with pytest.raises(Invalid):
                prove(self.stated(of_x, of_y), {"power": 2, "terms": terms})


def test_a_squeeze_proves_only_equality():
    stated = statement({"kind": "nonnegative", "shape": [1, 1]}, {"claim": program("x")}, ["x"])
    with pytest.raises(Invalid, match="nonnegative"):
        prove(stated)
