"""What stands on what: printed and corrected variants, conditions and assumptions, rejections."""

import pytest

from symctrl import Study, at_values, equal, implies, nonnegative, nonzero, positive_definite
from symctrl.verify import verify
from symctrl.written import StudyError


def rows_of(study, **options):
    return {row.id: row for row in verify(study, **options).rows}


def paper(wrong_definition=False, wrong_claim=False, correct_claim=False):
    """A decaying scalar: V' = -2 k V, with a slip in the definition of V, in the claim, or in both."""
    study = Study("paper")
    x, k, u = study.state("x"), study.gain("k"), study.input("u")
    study.motion(x, u)

    @study.law("(1)", u)
    def law():
        return -k * x

    @study.definition("(2)")
    def V():
        return x**3 / 2 if wrong_definition else x**2 / 2

    if wrong_definition:

        @study.corrected(V, why="The exponent is 2.")
        def V_corrected():
            return x**2 / 2

    @study.printed("(3)")
    def decay():
        """V decays."""
        return equal(study.rate(V, law), (-1 if wrong_claim else -2) * k * V())

    if correct_claim:

        @study.corrected(decay, why="The rate is 2 k V.")
        def decay_corrected():
            return equal(study.rate(V, law), -2 * k * V())

    return study


def test_what_is_right_stands():
    rows = rows_of(paper())
    assert all(row.verdict == "proved" and row.stands and row.settled for row in rows.values())
    assert set(rows["decay"].rests_on) == {"V", "law"}


def test_a_printed_statement_is_decided_with_printed_definitions_and_blamed_on_them():
    row = rows_of(paper(wrong_definition=True))["decay"]
    assert row.verdict == "refuted"
    assert "wrong only through what it uses" in row.reason


def test_a_statement_that_fails_with_the_corrected_definitions_too_is_wrong_by_itself():
    row = rows_of(paper(wrong_definition=True, wrong_claim=True))["decay"]
    assert row.verdict == "refuted"
    assert "fails with the corrected definitions too" in row.reason


def test_without_corrections_nothing_is_said_of_them():
    row = rows_of(paper(wrong_claim=True))["decay"]
    assert row.verdict == "refuted"
    assert "corrected" not in row.reason
    assert not row.settled


@pytest.mark.parametrize("wrong_definition", [False, True])
def test_a_corrected_statement_is_decided_with_corrected_definitions_and_settles_the_printed_one(
    wrong_definition,
):
    rows = rows_of(paper(wrong_definition, wrong_claim=True, correct_claim=True))
    assert rows["decay_corrected"].stands
    assert rows["decay"].settled
    assert not rows["decay"].stands


def test_a_correction_of_what_is_proved_is_an_error_of_the_study():
    with pytest.raises(StudyError, match="decay_corrected corrects decay, which is proved as printed"):
        verify(paper(correct_claim=True))


def test_a_rejected_claim_is_settled():
    study = paper(wrong_claim=True)
    study.rejected(study.entries["decay"], "Nothing takes its place.")
    assert rows_of(study)["decay"].settled


def test_a_printed_definition_that_does_not_conform_is_stood_in_for():
    study = Study("paper")
    x = study.state("x", 2)

    @study.definition("(1)")
    def V():
        return x.T @ x + x

    @study.corrected(V, why="The vector is no part of it.")
    def V_corrected():
        return x.T @ x

    @study.printed("(2)")
    def nonnegative_V():
        """V is not negative."""
        return nonnegative(V())

    @study.printed("(3)")
    def V_is_one():
        """V is one."""
        return equal(V(), 1)

    rows = rows_of(study)
    assert rows["V"].verdict == "ill-formed"
    assert rows["nonnegative_V"].verdict == "proved"
    assert "definition V (1)" in rows["nonnegative_V"].reason
    assert rows["V_is_one"].verdict == "refuted"


def test_an_undefined_letter_makes_ill_formed_what_uses_it_and_nothing_else():
    study = Study("paper")
    x = study.state("x")
    mu = study.undefined("mu")

    @study.definition("(1)")
    def V():
        return mu * x**2

    @study.printed("(2)", readings={"as printed": mu, "mu is 1": 1})
    def uses_it(factor):
        """A claim."""
        return equal(factor * x, x)

    @study.claimed("(3)")
    def does_not():
        """A claim."""
        return equal(x, x)

    rows = rows_of(study)
    assert {id_: row.verdict for id_, row in rows.items()} == {
        "V": "ill-formed",
        "uses_it[as printed]": "ill-formed",
        "uses_it[mu is 1]": "proved",
        "does_not": "proved",
    }
    assert "mu is used and never defined" in rows["V"].reason


def quotient(*, assumed=None, values=None):
    study = Study("quotient")
    x, m = study.state("x"), study.parameter("m", values)
    study.motion(x, -x)
    if assumed == "parameter":
        study.assume(nonzero(m))
    if assumed == "trajectory":
        study.assume(nonzero(x), about="trajectory")

    @study.claimed("a")
    def cancels():
        """The factor cancels."""
        factor = x if assumed == "trajectory" else m
        return equal(factor * x / factor, x)

    return rows_of(study)["cancels"]


def test_a_condition_that_nobody_vouches_for_keeps_a_proof_from_standing():
    row = quotient()
    assert (row.verdict, row.stands, row.settled) == ("proved", False, False)
    assert [(c.condition, c.by) for c in row.conditions] == [("m != 0", None)]


def test_an_assumption_vouches_for_a_condition():
    row = quotient(assumed="parameter")
    assert (row.stands, row.conditional) == (True, False)


def test_exact_values_vouch_for_a_condition():
    row = quotient(values="2")
    assert row.stands
    assert [c.by for c in row.conditions] == ["the exact values of the study"]
    assert not quotient(values="0").stands


def test_an_assumption_about_the_trajectory_makes_a_verdict_conditional():
    row = quotient(assumed="trajectory")
    assert (row.stands, row.conditional) == (True, True)
    assert [(given.text, given.about) for given in row.given] == [("x != 0", "trajectory")]


def test_using_a_proved_statement_rests_on_it():
    study = Study("chain")
    x, y = study.state("x"), study.state("y")

    @study.definition("(1)")
    def V():
        return x**2 + y**2

    @study.claimed("(2)")
    def V_squared():
        """Another form."""
        return equal(V(), (x + y) ** 2 - 2 * x * y)

    @study.claimed("(3)", using=[V_squared])
    def used():
        """By the other form."""
        return equal(V() + 2 * x * y, (x + y) ** 2)

    @study.printed("(4)")
    def wrong():
        """A wrong form."""
        return equal(V(), (x + y) ** 2)

    @study.claimed("(5)", using=[wrong])
    def on_sand():
        """By the wrong form."""
        return equal(V(), (x + y) ** 2)

    study.rejected(wrong, "It lacks a term.")
    rows = rows_of(study)
    assert "V_squared" in rows["used"].rests_on
    assert rows["used"].stands
    assert rows["on_sand"].verdict == "proved"
    assert not rows["on_sand"].stands


def test_at_values_is_about_the_numbers_of_the_study():
    study = Study("numbers")
    a, b = study.parameter("a", "1"), study.parameter("b", "2")

    @study.claimed("(1)")
    def at_these():
        """Definite here."""
        return at_values(positive_definite([[b, a], [a, b]]))

    @study.printed("(2)")
    def everywhere():
        """Definite everywhere."""
        return positive_definite([[b, a], [a, b]])

    study.rejected(everywhere, "Not for large a.")
    assert [row.verdict for row in verify(study).rows] == ["proved", "refuted"]
    assert [row.verdict for row in verify(study.at(values={"a": "2"})).rows] == ["refuted", "refuted"]
    just_below = study.at(values={"a": "1999999999/1000000000"})
    assert verify(just_below, ["at_these"]).rows[0].verdict == "proved"


def test_hypotheses_count():
    study = Study("hypotheses")
    x, y = study.state("x"), study.state("y")

    @study.claimed("(1)")
    def with_it():
        """Equal squares."""
        return implies(equal(x, y), equal(x**2, y**2))

    @study.printed("(2)")
    def converse():
        """Equal roots."""
        return implies(equal(x**2, y**2), equal(x, y))

    study.rejected(converse, "The signs may differ.")
    assert [row.verdict for row in verify(study).rows] == ["proved", "refuted"]


def test_a_single_claim_is_not_kept_from_standing_by_what_was_not_asked():
    assert rows_of(paper(), only=["decay"])["decay"].stands
