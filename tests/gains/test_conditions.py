"""Which conditions a study has: of its standing theorem, of its functions, and what is no condition."""

import pytest

from symctrl import Study, claim, equal, exponentially, implies, initially, positive_definite
from symctrl.gains.conditions import conditions
from symctrl.gains.theorem import standing_theorem
from symctrl.vectors import row, stack
from symctrl.written import StudyError
from tests.gains.samples import answered, crossing, decaying


def loop(given=(), values=("2", "1")):
    """x' = -a x + b w with |w| <= 1 is no business of the gains: x' = -(a - b) x, for a > b."""
    study = Study("loop")
    x = study.state("x")
    a, b = study.gain("a", values[0]), study.gain("b", values[1])
    m = study.parameter("m")
    study.assume(m > 0)
    study.motion(x, -(a - b) * x / m)

    @study.claimed("theorem")
    def vanishes():
        """x decays exponentially."""
        return claim(given=[a > b, *(g(a, b, m) for g in given)], then=[exponentially(x)])

    @study.argument(vanishes)
    def by_square(run):
        run.decays(m * x**2, a=2 * (a - b) / m)
        run.exponentially(x, by=m * x**2, least=m)

    return study


def listed(study):
    theorem = standing_theorem(study, None, lambda _: None)
    return conditions(study, theorem)


def test_a_theorem_gives_its_assumptions_on_gains_and_lists_the_others():
    found = listed(loop())
    assert found.theorem == "vanishes"
    assert [(one.id, one.statement) for one in found.each] == [
        ("vanishes/1", "a > b"),
        ("vanishes/positive", "a, b > 0"),
    ]
    assert found.assumed.besides == (("m > 0", "parameter"),)


def test_what_mixes_a_gain_with_a_parameter_that_has_no_value_is_open_and_says_which():
    found = answered(loop([lambda a, b, m: a > m]))
    (mixed,) = [one for one in found.conditions if one.condition.statement == "a > m"]
    assert (found.verdict, mixed.reason) == (
        "undecided",
        "m has no value; give one with --set m=VALUE",
    )
    assert answered(loop([lambda a, b, m: a > m]).at(values={"m": "1"})).verdict == "feasible"
    assert answered(loop([lambda a, b, m: a > m]).at(values={"m": "3"})).verdict == "infeasible"


def test_a_study_without_a_theorem_has_those_that_it_names_and_positive_gains():
    found = listed(crossing())
    assert found.theorem is None
    assert [one.id for one in found.each] == ["below_the_parabola", "above_the_hyperbola", "positive"]
    assert found.deciding == found.each


def test_what_the_study_assumes_of_the_gains_is_a_condition_too():
    study = Study("assuming")
    a, b, c = study.gain("a", "2"), study.gain("b", "1"), study.gain("c", "1")
    study.assume(a > 3 * b, c < 5)

    @study.condition("1")
    def some():
        """a is large."""
        return a > 1

    found = answered(study)
    assert found.verdict == "infeasible"
    assert [(one.condition.id, one.state) for one in found.conditions] == [
        ("some", 1),
        ("positive", 1),
        ("assumed/1", -1),
    ]


def test_only_what_a_condition_reads_itself_is_asked_for():
    """The assumption beside it brings a symbol without a value into its problem."""
    study = Study("beside")
    a, m = study.gain("a", "2"), study.parameter("m")
    study.assume(m > a)

    @study.condition("1")
    def large():
        """a is large."""
        return a > 1

    found = answered(study)
    assert found.conditions[0].condition.names == ("a",)
    assert found.conditions[0].state == 1


# Which theorem


def test_a_theorem_that_does_not_stand_gives_no_condition():
    study = Study("false")
    x = study.state("x")
    a = study.gain("a", "2")
    study.motion(x, a * x)

    @study.claimed("theorem")
    def wrong():
        """x decays exponentially."""
        return claim(given=[a > 1], then=[exponentially(x)])

    @study.argument(wrong)
    def no_proof(run):
        run.decays(x**2, a=2 * a)

    with pytest.raises(StudyError, match="no condition on gains"):
        answered(study)


def test_a_theorem_that_uses_a_refuted_statement_gives_no_condition():
    study = Study("resting")
    x, y = study.state("x"), study.parameter("y")
    a = study.gain("a", "2")
    study.motion(x, -a * x + y * x)

    @study.claimed("lemma")
    def vanishing():
        """False: y is any number."""
        return equal(y, 0)

    @study.claimed("theorem", using=[vanishing])
    def rests():
        """x decays exponentially."""
        return claim(given=[a > 1], then=[exponentially(x)])

    @study.argument(rests)
    def by_square(run):
        run.decays(x**2, a=2 * a)
        run.exponentially(x, by=x**2, least=1)

    with pytest.raises(StudyError, match="no condition on gains"):
        answered(study)


def test_a_theorem_that_stands_at_the_studys_values_alone_gives_no_condition():
    """What it uses is true where a is not b, which the values 2 and 1 show: of a map it would be wrong."""
    study = Study("values")
    x = study.state("x")
    a, b = study.gain("a", "2"), study.gain("b", "1")

    @study.definition("g")
    def g():
        return x * (a - b) / (a - b)

    study.motion(x, -a * g())

    @study.claimed("lemma")
    def same():
        """g is x."""
        return equal(g(), x)

    @study.claimed("theorem", using=[same])
    def at_values():
        """x decays exponentially."""
        return claim(given=[a > "1/2"], then=[exponentially(x)])

    @study.argument(at_values)
    def by_square(run):
        run.decays(x**2, a=2 * a)
        run.exponentially(x, by=x**2, least=1)

    with pytest.raises(StudyError, match="no theorem that assumes one stands for all values"):
        answered(study)


def test_the_last_theorem_that_stands_is_taken():
    study = decaying()
    x, a = study.symbols["x"].expr, study.symbols["a"].expr

    @study.claimed("theorem 2")
    def later():
        """Without an argument it does not stand."""
        return claim(given=[a > 7], then=[exponentially(x)])

    assert listed(study).theorem == "decay"


def test_gains_at_which_no_state_is_admissible_are_undecided():
    study = decaying()
    x, a, b = (study.symbols[name].expr for name in "xab")

    @study.claimed("theorem 2")
    def near():
        """From small initial states x decays exponentially."""
        return claim(given=[a > 1, initially(x**2 <= 4 - a)], then=[exponentially(x)])

    @study.argument(near)
    def by_square(run):
        run.decays(x**2, a=2 * (a + b))
        run.exponentially(x, by=x**2, least=1)

    assert answered(study).verdict == "feasible"
    found = answered(study.at(values={"a": "5"}))
    assert {one.state for one in found.conditions} == {1}
    assert (found.verdict, found.margin) == ("undecided", None)
    assert found.reason.startswith("no state is known at which all that the theorem assumes holds")


# What is no condition


def of(function, **options):
    study = Study("wrong")
    a, b, x = study.gain("a", "2"), study.gain("b", "1"), study.state("x")
    fleet = study.fleet()

    @study.condition("1")
    def wrong():
        """Wrong."""
        return function(a, b, x)

    return study, fleet


@pytest.mark.parametrize(
    ("function", "says"),
    [
        (lambda a, b, x: implies(a > 0, b > 0), "the condition wrong must be a bound"),
        (lambda a, b, x: [], "the condition wrong is an empty list"),
        (lambda a, b, x: a + x > 0, "speaks of x, which is no parameter"),
        (lambda a, b, x: positive_definite(stack(row(a, b), row(0, a))), "the matrix is not symmetric"),
    ],
)
def test_a_condition_that_is_none_is_an_error_of_the_study(function, says):
    study, _ = of(function)
    with pytest.raises(StudyError, match=says):
        answered(study)


def test_a_condition_speaks_of_no_single_node():
    study = Study("nodes")
    fleet = study.fleet()
    k, mass = study.gain("k", "2"), fleet.parameter("mass")

    @study.condition("1")
    def heavy(i):
        """k exceeds each mass."""
        return k > mass[i]

    with pytest.raises(StudyError, match=r"speaks of mass\.\*, which is no parameter"):
        answered(study)


def test_a_study_without_any_says_how_to_name_one():
    with pytest.raises(StudyError, match=r"names none with @study\.condition"):
        answered(Study("bare"))
