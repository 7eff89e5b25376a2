"""Collecting a problem: it holds what the claim reaches, and of the assumptions those about what occurs."""

from fractions import Fraction

import pytest

from symctrl import Study, conforms, equal, nonnegative, positive_definite
from symctrl.collect import Collector, Used
from symctrl.expr import symbol
from symctrl.listings import UndefinedLetter
from symctrl.reach import closings, pruned
from symctrl.written import StudyError


@pytest.fixture
def study():
    made = Study("own")
    x, y, u = made.state("x"), made.state("y"), made.input("u")
    k, c = made.gain("k", "2"), made.gain("c")
    made.x, made.y, made.k, made.c = x, y, k, c
    made.motion(x, y)
    made.motion(y, u - x)
    made.assume(x**2 <= 1, about="initial")

    @made.law("law", u)
    def law():
        return -c * y

    @made.definition("V")
    def V():
        return k * x**2 + y**2

    made.law_, made.V = law, V
    return made


def problem(study, claim, **options):
    return Collector(study, **options).problem(claim, "claim")


def test_a_definition_is_a_name_with_a_listing_of_its_own(study):
    made = problem(study, nonnegative(study.V()))
    assert set(made.listings) >= {"claim", "V"}
    assert made.tape("claim").inputs == ("V",)
    assert {"x", "y", "k"} <= set(made.scalars)


def test_a_rate_brings_motion_and_law_and_nothing_else_does(study):
    still = problem(study, nonnegative(study.V()))
    assert not still.motion
    assert not still.laws
    made = problem(study, equal(study.rate(study.V, study.law_), 0))
    assert set(made.motion) == {"x", "y"}
    assert set(made.laws) == {"law"}
    assert "c" in made.scalars
    free = problem(study, equal(study.rate(study.V), 0))
    assert not free.laws
    assert free.scalars["u"] == "input"


def test_assumptions_are_those_about_what_occurs(study):
    def texts(claim):
        return {given.text for given in problem(study, claim).given}

    assert texts(equal(study.y, study.y)) == set()
    assert texts(equal(study.k, study.k)) == {"k > 0"}
    assert texts(equal(study.x, study.x)) == {"x^2 <= 1"}


def test_bound_values_are_literals(study):
    made = problem(study, nonnegative(study.V()), values={"k": Fraction(1, 3)})
    assert "k" not in made.scalars
    assert Fraction(1, 3) in {step.value for step in made.tape("V").code if step.op == "CONST"}


def test_equal_claims_have_equal_digests_and_other_claims_have_others(study):
    claims = [
        nonnegative(study.V()),
        nonnegative(study.V() + 1),
        nonnegative(study.x**2),
        equal(study.rate(study.V), 0),
        equal(study.rate(study.V, study.law_), 0),
        positive_definite([[study.k]]),
        conforms(study.V()),
    ]
    digests = [problem(study, claim).sha256 for claim in claims]
    assert digests == [problem(study, claim).sha256 for claim in claims]
    assert len(set(digests)) == len(claims)


def test_a_symbol_that_the_study_does_not_declare_is_named(study):
    with pytest.raises(UndefinedLetter, match="z is no symbol of the study own"):
        problem(study, equal(symbol("z"), 0))


def test_using_takes_what_has_a_name_on_its_left(study):
    used = study.rate(study.x * study.y)
    with pytest.raises(StudyError, match=r"^using: "):
        Collector(study).problem(equal(study.x, 0), "claim", using=[Used("other", equal(used, 0), "0" * 64)])


def test_using_an_equation_for_a_symbol_makes_it_a_name(study):
    using = [Used("other", equal(study.x, study.y**2), "0" * 64)]
    made = Collector(study).problem(equal(study.x, 0), "claim", using=using)
    assert set(made.scalars) == {"y"}
    assert made.names["x"].of == ("using x", 0)


def test_using_puts_the_right_side_in_the_place_of_the_name(study):
    claim = equal(study.V(), study.y)
    using = [Used("other", equal(study.V(), study.y), "0" * 64)]
    made = Collector(study).problem(claim, "claim", using=using)
    assert made.statement()["uses"] == [{"id": "other", "sha256": "0" * 64}]
    assert "V" not in made.listings
    assert set(made.scalars) == {"y"}


def test_a_hint_speaks_of_what_the_claim_speaks_of(study):
    with pytest.raises(StudyError, match="a hint of a proof speaks of "):
        problem(study, nonnegative(study.x**2).by(squares=[study.y]))


def test_pruning_changes_nothing_that_is_needed(study):
    made = problem(study, equal(study.rate(study.V, study.law_), 0))
    assert pruned(made) == made


def test_a_closed_definition_is_a_free_symbol(study):
    made = problem(study, equal(1 / study.V() * study.V(), 1))
    closed = list(closings(made))
    assert closed
    assert all(one.scalars["V"] == "signal" and "V" not in one.listings for one in closed)


def test_a_definition_whose_rate_is_taken_stays_open(study):
    made = problem(study, equal(study.rate(study.V) / study.V(), 0))
    assert all("V" in one.listings for one in closings(made))


def test_using_an_equation_whose_right_side_is_defined_by_its_left_is_refused(study):
    # V is defined by y: with y in turn a name for V no value could ever be found.
    using = [Used("other", equal(study.y, 2 * study.V()), "0" * 64)]
    with pytest.raises(StudyError, match=r"^using: y = 2\*V cannot be put in the place of its left side"):
        Collector(study).problem(nonnegative(study.V() + study.y), "claim", using=using)


def test_a_division_by_a_number_keeps_a_definition_open(study):
    # What holds because of the formula of `half` is lost where the names that divide are closed.
    @study.definition("half")
    def half():
        return study.x**2 / 2

    @study.definition("inverse")
    def inverse():
        return 1 / study.c

    made = problem(study, nonnegative(half() + inverse() * study.c))
    assert any("inverse" in one.scalars and "half" in one.names for one in closings(made))
