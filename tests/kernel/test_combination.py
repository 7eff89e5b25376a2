"""Signs by combinations: proofs that hold beside near misses."""

import pytest

from symctrl.kernel.certificate import Invalid
from tests.kernel.programs import assume, program, statement, verify

X = [["1", 0, 1]]  # the POLY of generator 0
Y = [["1", 1, 1]]
X_LESS_Y = [["1", 0, 1], ["-1", 1, 1]]


def prove(stated, *entries, free=("x", "y"), factors=(), hints=(), more=()):
    generators = [*({"free": name} for name in free), *more]
    proof = {"kind": "combination", "generators": generators, "factors": list(factors), "hints": list(hints)}
    verify(stated, {**proof, "entries": [{"terms": list(terms)} for terms in entries]})


def claim(kind, *outputs, scalars=("x", "y"), given=(), **listings):
    shape = [len(outputs), 1]
    return statement({"kind": kind, "shape": shape}, {"claim": program(*outputs), **listings}, scalars, given)


SQUARE = ("+", ("-", ("SQ", "x"), ("*", 2, ("*", "x", "y"))), ("*", 2, ("SQ", "y")))  # (x-y)^2 + y^2


class TestSquares:
    def test_a_sum_of_squares(self):
        prove(claim("nonnegative", SQUARE), [["1", [], [X_LESS_Y]], ["1", [], [Y]]])

    @pytest.mark.parametrize(
        "terms",
        [
            [],
            [["1", [], [X_LESS_Y]]],
            [["1", [], [X_LESS_Y]], ["2", [], [Y]]],
            [["1", [], [X_LESS_Y]], ["-1", [], [Y]], ["2", [], [Y]]],
            [["1", [], [X_LESS_Y]], ["1", [], [Y]], ["0", [], [X]]],
            [["1", [], [X_LESS_Y]], ["1", [Y], [Y]]],
            [["1", [], [X_LESS_Y]], ["1", [0], [Y]]],
            [["1", [], [X_LESS_Y]], ["1", [], [[["1", 2, 1]]]]],
            [["1", [], [X_LESS_Y]], ["1", []]],
        ],
    )
    def test_near_misses(self, terms):
        with pytest.raises(Invalid):
            prove(claim("nonnegative", SQUARE), terms)

    def test_squares_alone_do_not_prove_a_strict_claim(self):
        with pytest.raises(Invalid, match="certainly positive"):
            prove(claim("positive", SQUARE), [["1", [], [X_LESS_Y]], ["1", [], [Y]]])
        prove(claim("positive", ("+", SQUARE, 1)), [["1", [], [X_LESS_Y]], ["1", [], [Y]], ["1", [], []]])

    def test_each_entry_has_its_own_proof(self):
        two = claim("nonnegative", ("SQ", "x"), ("SQ", "y"))
        prove(two, [["1", [], [X]]], [["1", [], [Y]]])
        with pytest.raises(Invalid, match="2 entries"):
            prove(two, [["1", [], [X]]])
        with pytest.raises(Invalid):
            prove(two, [["1", [], [Y]]], [["1", [], [X]]])


class TestAssumptions:
    product = ("*", "x", "y")
    listings = {"gx": program("x"), "gy": program("y")}  # noqa: RUF012

    def stated(self, kind, of_x, of_y):
        return claim(kind, self.product, given=[assume(of_x, "gx"), assume(of_y, "gy")], **self.listings)

    def test_products_of_assumptions(self):
        prove(self.stated("nonnegative", "nonnegative", "positive"), [["1", [0, 1], []]])
        prove(self.stated("positive", "positive", "positive"), [["1", [0, 1], []]])

    def test_a_product_is_positive_only_if_each_factor_is(self):
        with pytest.raises(Invalid, match="certainly positive"):
            prove(self.stated("positive", "nonnegative", "positive"), [["1", [0, 1], []]])

    def test_nonzero_says_nothing_about_the_sign(self):
        with pytest.raises(Invalid, match="nonzero"):
            prove(self.stated("nonnegative", "nonzero", "positive"), [["1", [0, 1], []]])

    def test_a_square_is_positive_where_its_root_is_not_zero(self):
        stated = claim("positive", ("SQ", "x"), scalars=["x"], given=[assume("nonzero", "g")], g=program("x"))
        prove(stated, [["1", [], [X]]], free=["x"])

    def test_a_zero_assumption_is_a_relation(self):
        on_circle = program(("-", ("+", ("SQ", "x"), ("SQ", "y")), 1))
        stated = claim("nonnegative", ("-", 1, ("SQ", "x")), given=[assume("zero", "g")], g=on_circle)
        prove(stated, [["1", [], [Y]]])


class TestQuotients:
    """1/x has the sign of x, whose square is positive."""

    hints = [{"inverse": ["1", [[0, 1]]]}]  # noqa: RUF012

    def stated(self, kind, of_x):
        return claim(kind, ("INV", "x"), scalars=["x"], given=[assume(of_x, "g")], g=program("x"))

    def test_the_denominator_counts_with_its_sign(self):
        for terms in ([["1", [0], []]], [["1", [], []]]):
            prove(self.stated("positive", "positive"), terms, free=["x"], factors=[X], hints=self.hints)

    def test_an_unknown_sign_is_not_taken_for_positive(self):
        with pytest.raises(Invalid):
            prove(
                self.stated("positive", "nonzero"), [["1", [], []]], free=["x"], factors=[X], hints=self.hints
            )


class TestKnownSigns:
    """|x| is nonnegative by definition; x is not."""

    stated = claim("nonnegative", ("*", 3, ("FABS", "x")), scalars=["x"])
    hints = [{"is": [[[], [["1", 1, 1]]]]}]  # noqa: RUF012
    more = [{"abs": X}]  # noqa: RUF012

    def test_a_generator_with_a_known_sign(self):
        prove(self.stated, [["3", [[["1", 1, 1]]], []]], free=["x"], hints=self.hints, more=self.more)

    def test_a_generator_without_one(self):
        with pytest.raises(Invalid, match="the sign of x"):
            prove(self.stated, [["3", [X], []]], free=["x"], hints=self.hints, more=self.more)


def test_only_signs_are_proved_by_combinations():
    stated = statement({"kind": "equal", "shape": [1, 1]}, {"claim": program("x", "x")}, ["x"])
    with pytest.raises(Invalid, match="equal"):
        prove(stated, [["1", [], [X]]], free=["x"])


class TestTimes:
    """The quantity times a positive polynomial is a combination."""

    square = [["1", [], [X_LESS_Y]]]  # noqa: RUF012

    def prove(self, times, terms, kind="positive"):
        """x (x - y)^2 >= 0 where x > 0."""
        listings = {"g": program("x")}
        stated = claim(
            "nonnegative", ("*", ("SQ", ("-", "x", "y")), "x"), given=[assume(kind, "g")], **listings
        )
        proof = {
            "kind": "combination",
            "generators": [{"free": "x"}, {"free": "y"}],
            "factors": [],
            "hints": [],
        }
        verify(stated, {**proof, "entries": [{"terms": terms, "times": [times]}]})

    def test_a_positive_multiple(self):
        self.prove(X, [["1", [0, 0], [X_LESS_Y]]])
        self.prove([["3"]], [["3", [0], [X_LESS_Y]]])

    @pytest.mark.parametrize("times", [[], [["-1"]], Y, [["1", 0, 1], ["-1", 1, 1]], [["1", 1, 2]], [["0"]]])
    def test_what_is_not_known_to_be_positive(self, times):
        for terms in ([["1", [0, 0], [X_LESS_Y]]], []):
            with pytest.raises(Invalid):
                self.prove(times, terms)

    def test_a_multiple_that_may_be_zero_says_nothing(self):
        with pytest.raises(Invalid, match="positive"):
            self.prove(X, [["1", [0, 0], [X_LESS_Y]]], "nonnegative")


class TestForms:
    """x'Px for an assumed P is nonnegative, never certainly positive."""

    names = ("x", "y", "p", "q", "r")
    vector = [X, Y]  # noqa: RUF012
    value = (
        "+",
        ("*", "p", ("SQ", "x")),
        ("+", ("*", 2, ("*", "q", ("*", "x", "y"))), ("*", "r", ("SQ", "y"))),
    )

    def prove(self, kind="nonnegative", given="positive_semidefinite", form=None, value=value):
        listings = {"P": program("p", "q", "q", "r")}
        stated = claim(kind, value, scalars=self.names, given=[assume(given, "P", size=2)], **listings)
        prove(stated, [["1", [form or {"given": 0, "vector": self.vector}], []]], free=self.names)

    def test_of_an_assumed_matrix(self):
        for given in ("positive_semidefinite", "positive_definite"):
            self.prove(given=given)

    def test_a_form_may_be_zero(self):
        with pytest.raises(Invalid, match="certainly positive"):
            self.prove("positive", "positive_definite")

    @pytest.mark.parametrize(
        "form",
        [
            {"given": 0, "vector": [Y, X]},
            {"given": 0, "vector": [X]},
            {"given": 0, "vector": [X, Y, Y]},
            {"given": 0, "vector": []},
            {"given": 1, "vector": vector},
            {"given": -1, "vector": vector},
            {"given": 0},
            {"given": 0, "vector": vector, "scale": "-1"},
        ],
    )
    def test_near_misses(self, form):
        with pytest.raises(Invalid):
            self.prove(form=form)

    def test_a_number_is_no_matrix(self):
        stated = claim(
            "nonnegative", ("SQ", "x"), scalars=["x"], given=[assume("positive", "g")], g=program("x")
        )
        with pytest.raises(Invalid, match="definite"):
            prove(stated, [["1", [{"given": 0, "vector": [X]}], []]], free=["x"])
