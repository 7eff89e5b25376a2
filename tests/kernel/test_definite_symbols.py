"""Trees and leaf proofs of definiteness whose entries are symbols: each accepted, beside near misses."""

import pytest

from symctrl.kernel.certificate import Declined, Invalid
from tests.kernel.programs import assume, program, statement, verify

ONE = {"terms": [["1", [], []]]}
A = [["1", 0, 1]]  # the POLY of generator 0


def prove(stated, matrix, free=(), factors=(), hints=(), more=()):
    generators = [*({"free": name} for name in free), *more]
    proof = {"kind": "definite", "generators": generators, "factors": list(factors), "hints": list(hints)}
    verify(stated, {**proof, "matrix": matrix})


def claim(kind, tree, outputs, scalars=(), given=(), **listings):
    return statement({"kind": kind, "matrix": tree}, {"claim": program(*outputs), **listings}, scalars, given)


TWO = {"entries": [[0, 1], [1, 2]]}
UNIT = {"ldl": {"lower": [["1"], ["0", "1"]], "diagonal": ["1", "1"]}}


def test_products_with_identities_and_blocks():
    tree = {"blocks": [{"kron_identity": TWO, "size": 3}, {"entries": [[2]]}]}
    stated = claim("positive_definite", tree, [1, 0, 1])
    one = {"ldl": {"lower": [["1"]], "diagonal": ["1"]}}
    prove(stated, {"blocks": [{"kron_identity": UNIT, "size": 3}, one]})
    for wrong in (
        {"blocks": [{"kron_identity": UNIT, "size": 2}, one]},
        {"blocks": [{"kron_identity": UNIT, "size": 3}]},
        {"blocks": [one, {"kron_identity": UNIT, "size": 3}]},
        UNIT,
    ):
        with pytest.raises(Invalid):
            prove(stated, wrong)


def test_the_claim_must_be_one_of_definiteness():
    stated = statement({"kind": "nonnegative", "shape": [1, 1]}, {"claim": program(1)})
    with pytest.raises(Invalid, match="nonnegative"):
        prove(stated, UNIT)


class TestMinors:
    """[[a, 1], [1, 2/a]] with a > 0: the minors are a and 1."""

    tree = {"entries": [[0, 1], [1, 2]]}  # noqa: RUF012
    first = {"terms": [["1", [0], []]]}  # noqa: RUF012
    second = {"terms": [["1", [], []]]}  # noqa: RUF012
    inverse = {"factors": [[["1", 0, 1]]], "hints": [{"inverse": ["1", [[0, 1]]]}]}  # noqa: RUF012

    def stated(self, kind="positive"):
        outputs = ["a", 1, ("/", 2, "a")]
        return claim("positive_definite", self.tree, outputs, ["a"], [assume(kind, "g")], g=program("a"))

    def test_all_of_them_are_positive(self):
        prove(self.stated(), {"minors": [self.first, self.second]}, ["a"], **self.inverse)

    def test_one_that_is_missing_or_not_positive(self):
        for minors in ([self.first], [self.second, self.second], [self.first, {"terms": []}]):
            with pytest.raises(Invalid):
                prove(self.stated(), {"minors": minors}, ["a"], **self.inverse)
        with pytest.raises(Invalid):
            prove(self.stated("nonzero"), {"minors": [self.first, self.second]}, ["a"], **self.inverse)

    def test_a_matrix_that_is_not_symmetric(self):
        tree = {"entries": [[0, 1], [2, 0]]}
        stated = claim("positive_definite", tree, [1, "a", 0], ["a"])
        one = {"terms": [["1", [], []]]}
        with pytest.raises(Invalid, match="symmetry"):
            prove(stated, {"minors": [one, one]}, ["a"])


class TestCongruence:
    """C'PC for an assumed P of size 2 and C = [[0, c], [d, 0]]."""

    names = ("p", "q", "r", "c", "d")
    outputs = ("p", "q", "r", 0, "c", "d")
    tree = {"congruence": TWO, "factor": [[3, 4], [5, 3]]}  # noqa: RUF012
    proof = {"congruence": {"given": 0}}  # noqa: RUF012
    inverse = {"factors": [[["1", 3, 1, 4, 1]]], "hints": [{"inverse": ["-1", [[0, 1]]]}]}  # noqa: RUF012

    def stated(self, kind, given="positive_definite", tree=None, outputs=None, conditions=("nonzero",)):
        listings = {"P": program("p", "q", "q", "r")}
        one = claim(
            kind,
            tree or self.tree,
            outputs or self.outputs,
            self.names,
            [assume(given, "P", size=2)],
            **listings,
        )
        return {**one, "conditions": [{"kind": kind, "of": "c*d"} for kind in conditions]}

    def test_semidefinite_with_any_factor(self):
        for given in ("positive_definite", "positive_semidefinite"):
            stated = self.stated("positive_semidefinite", given, conditions=())
            prove(stated, self.proof, self.names)

    def test_definite_with_an_invertible_one(self):
        prove(self.stated("positive_definite"), self.proof, self.names, **self.inverse)

    def test_a_factor_that_may_be_singular(self):
        with pytest.raises(Invalid, match="not stated"):
            prove(self.stated("positive_definite", conditions=()), self.proof, self.names, **self.inverse)
        with pytest.raises(Invalid, match="no hint"):
            prove(self.stated("positive_definite"), self.proof, self.names)
        singular = {"congruence": TWO, "factor": [[4, 5], [4, 5]]}
        stated = self.stated("positive_definite", tree=singular, outputs=("p", "q", "r", 1, "c", "d"))
        with pytest.raises(Invalid):
            prove(stated, self.proof, self.names)

    def test_a_factor_that_is_not_square(self):
        for factor in ([[3], [4]], [[3, 4, 5], [4, 3, 5]]):
            tree = {"congruence": TWO, "factor": factor}
            outputs = self.outputs if len(factor[0]) == 3 else self.outputs[:5]
            names = self.names if len(factor[0]) == 3 else self.names[:4]
            for kind in ("positive_semidefinite", "positive_definite"):
                stated = claim(kind, tree, outputs, names, [assume("positive_definite", "P", size=2)],
                               P=program("p", "q", "q", "r"))  # fmt: skip
                if kind == "positive_semidefinite":
                    prove(stated, self.proof, names)
                else:
                    with pytest.raises(Invalid, match="not square"):
                        prove(stated, self.proof, names)

    def test_a_semidefinite_assumption_does_not_prove_a_strict_claim(self):
        with pytest.raises(Invalid, match="certainly definite"):
            prove(
                self.stated("positive_definite", "positive_semidefinite"),
                self.proof,
                self.names,
                **self.inverse,
            )

    @pytest.mark.parametrize(
        "proof",
        [
            {"given": 0},
            {"congruence": {"given": 1}},
            {"congruence": {"given": -1}},
            {"congruence": UNIT},
            {"congruence": {"given": 0}, "factor": []},
        ],
    )
    def test_another_proof(self, proof):
        with pytest.raises(Invalid):
            prove(self.stated("positive_semidefinite", conditions=()), proof, self.names)

    @pytest.mark.parametrize("factor", [[], [[3, 4]], [[3, 4], [5]], [[], []], [3, 4], [[3, 4], [5, 9]]])
    def test_a_factor_that_does_not_fit(self, factor):
        with pytest.raises(Invalid):
            prove(
                self.stated("positive_semidefinite", tree={"congruence": TWO, "factor": factor}), self.proof
            )


class TestGiven:
    """The matrix is an assumed one, entry by entry."""

    names = ("p", "q", "r")

    def stated(self, given, outputs=("p", "q", "r"), kind="positive_definite"):
        return claim(
            kind, TWO, outputs, self.names, [assume(given, "P", size=2)], P=program("p", "q", "q", "r")
        )

    def test_the_same(self):
        prove(self.stated("positive_definite"), {"given": 0}, self.names)
        prove(self.stated("positive_semidefinite", kind="positive_semidefinite"), {"given": 0}, self.names)

    def test_near_misses(self):
        for stated in (
            self.stated("positive_semidefinite"),
            self.stated("positive_definite", ("r", "q", "p")),
            self.stated("positive_definite", ("p", "q", ("-", "r", 1))),
        ):
            with pytest.raises(Invalid):
                prove(stated, {"given": 0}, self.names)

    def test_an_assumption_about_a_number(self):
        stated = claim(
            "positive_definite", TWO, ("p", 0, "p"), ["p"], [assume("positive", "g")], g=program("p")
        )
        with pytest.raises(Invalid, match="not what is claimed"):
            prove(stated, {"given": 0}, ["p"])


class TestRows:
    """[[a + 2, -a], [-a, a + 1]] with a > 0: each diagonal entry exceeds a."""

    outputs = (("+", "a", 2), ("NEG", "a"), ("+", "a", 1))
    two = {"terms": [["2", [], []]]}  # noqa: RUF012

    def stated(self, kind="positive", outputs=outputs, tree=TWO):
        return claim("positive_definite", tree, outputs, ["a"], [assume(kind, "g")], g=program("a"))

    def test_each_row_is_dominant(self):
        for kind in ("positive", "nonnegative"):
            prove(self.stated(kind), {"rows": [self.two, ONE]}, ["a"])

    @pytest.mark.parametrize("rows", [[], [ONE, ONE], [two], [two, ONE, ONE], [two, {"terms": []}]])
    def test_wrong_rows(self, rows):
        with pytest.raises(Invalid):
            prove(self.stated(), {"rows": rows}, ["a"])

    def test_signs_that_are_not_known(self):
        with pytest.raises(Invalid, match="sign of the entry"):
            prove(self.stated("nonzero"), {"rows": [self.two, ONE]}, ["a"])

    def test_a_row_that_is_only_weakly_dominant(self):
        stated = self.stated(outputs=("a", ("NEG", "a"), ("+", "a", 1)))
        for row in ({"terms": []}, {"terms": [["1", [0], []]]}):
            with pytest.raises(Invalid):
                prove(stated, {"rows": [row, ONE]}, ["a"])

    def test_a_matrix_that_is_not_symmetric(self):
        tree = {"entries": [[0, 1], [2, 0]]}
        with pytest.raises(Invalid, match="symmetry"):
            prove(self.stated(outputs=(("+", "a", 1), "a", 0), tree=tree), {"rows": [ONE, ONE]}, ["a"])


class TestSum:
    """a [[1, 1], [1, 1]] + b I with a >= 0, b > 0."""

    names = ("a", "b")
    outputs = (("+", "a", "b"), "a", ("+", "a", "b"))
    singular = {"ldl": {"lower": [["1"], ["1", "1"]], "diagonal": ["1", "0"]}}  # noqa: RUF012
    ones = {"rows": [["1", "1"], ["1", "1"]], "proof": singular}  # noqa: RUF012
    unit = {"rows": [["1", "0"], ["0", "1"]], "proof": UNIT}  # noqa: RUF012
    b = [["1", 1, 1]]  # noqa: RUF012

    def stated(self, of_a="nonnegative", of_b="positive", kind="positive_definite", outputs=outputs):
        given = [assume(of_a, "ga"), assume(of_b, "gb")]
        return claim(kind, TWO, outputs, self.names, given, ga=program("a"), gb=program("b"))

    def parts(self, **changes):
        return [{"of": A, **self.ones}, {"of": self.b, **self.unit, **changes}]

    def test_right_sums(self):
        prove(self.stated(), {"sum": self.parts()}, self.names)
        prove(
            self.stated(of_b="nonnegative", kind="positive_semidefinite"), {"sum": self.parts()}, self.names
        )

    def test_none_is_certainly_definite(self):
        for stated in (self.stated(of_a="positive", of_b="nonnegative"),):
            with pytest.raises(Invalid, match="certainly definite"):
                prove(stated, {"sum": self.parts()}, self.names)

    def test_a_multiple_of_unknown_sign(self):
        for of_a, of_b in (("nonzero", "positive"), ("nonnegative", "nonzero")):
            with pytest.raises(Invalid, match="not known to be nonnegative"):
                prove(self.stated(of_a, of_b), {"sum": self.parts()}, self.names)

    def test_a_part_that_is_not_semidefinite(self):
        swap = {"rows": [["0", "1"], ["1", "0"]], "proof": UNIT}
        stated = self.stated(outputs=("b", "a", "b"))
        with pytest.raises(Invalid):
            prove(stated, {"sum": [{"of": A, **swap}, {"of": self.b, **self.unit}]}, self.names)

    @pytest.mark.parametrize(
        "changes",
        [
            {"rows": [["1", "0"], ["0", "2"]]},
            {"rows": [["1", "0"]]},
            {"rows": [["1", "1"], ["0", "1"]]},
            {"proof": {"given": 0}},
            {"proof": {"minors": []}},
            {"of": [["-1", 1, 1]]},
            {"of": []},
            {"more": 1},
        ],
    )
    def test_wrong_parts(self, changes):
        with pytest.raises(Invalid):
            prove(self.stated(), {"sum": self.parts(**changes)}, self.names)
        with pytest.raises(Invalid):
            prove(self.stated(), {"sum": []}, self.names)


class TestSmall:
    """[[1, b], [b, b]] is definite for small b > 0: its minors are 1 and b - b^2."""

    outputs = (1, "b", "b")

    def stated(self, outputs=outputs, names=("b",), given=(), small="b", **listings):
        one = claim("positive_definite", TWO, outputs, names, given, **listings)
        return {**one, "claim": {**one["claim"], "small": small}}

    def test_the_lowest_coefficient_decides(self):
        prove(self.stated(), {"minors": [ONE, ONE]}, ["b"])

    def test_a_lowest_coefficient_that_is_not_positive(self):
        for outputs in ((1, "b", ("NEG", "b")), (1, 1, "b"), (1, "b", ("SQ", "b"))):
            with pytest.raises(Invalid):
                prove(self.stated(outputs), {"minors": [ONE, ONE]}, ["b"])

    def test_a_gain_inside_a_root(self):
        outputs = (1, 0, ("-", 1, ("SQRT", "b")))
        more = {"hints": [{"is": [[[], [["1", 1, 1]]]]}]}
        stated = self.stated(outputs, given=[assume("positive", "g")], g=program("b"))
        with pytest.raises(Declined, match="inside a root"):
            prove(stated, {"minors": [ONE, ONE]}, ["b"], more=[{"root": 2, "of": A}], **more)

    def test_rows(self):
        prove(self.stated((1, ("SQ", "b"), 1), given=[assume("positive", "g")], g=program("b")),
              {"rows": [ONE, ONE]}, ["b"])  # fmt: skip

    def test_what_is_given_may_not_tie_the_gain(self):
        """With a b^2 = 1, 1 - a b is 1 - 1/b, which is negative for every small b."""
        tie = program(("-", ("*", "a", ("SQ", "b")), 1))
        outputs = (1, 0, ("-", 1, ("*", "a", "b")))
        stated = self.stated(outputs, ("b", "a"), [assume("zero", "g")], g=tie)
        with pytest.raises(Declined, match="restricts how small"):
            prove(stated, {"minors": [ONE, ONE]}, ["b", "a"])

    def test_how_small_may_not_depend_on_a_state(self):
        outputs = (1, 0, ("-", 1, ("*", "x", "b")))
        stated = self.stated(outputs, {"b": "parameter", "x": "state"})
        with pytest.raises(Declined, match="depend on x"):
            prove(stated, {"minors": [ONE, ONE]}, ["b", "x"])
        prove(
            {**stated, "scalars": dict.fromkeys(("b", "x"), "parameter")}, {"minors": [ONE, ONE]}, ["b", "x"]
        )

    @pytest.mark.parametrize("small", ["c", "x", ""])
    def test_the_gain_is_a_parameter_of_the_claim(self, small):
        stated = self.stated((1, "x", 1), {"b": "parameter", "x": "state"}, small=small)
        with pytest.raises(Declined, match="no parameter"):
            prove(stated, {"minors": [ONE, ONE]}, ["b", "x"])
