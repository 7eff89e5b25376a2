"""An equation for a rate under one law was once taken in the loop that another law closes."""

import pytest

from symctrl import Study, bounded, claim, equal, tends
from symctrl.verify import verify
from symctrl.written import StudyError


def two_laws():
    """x' = u with u = -x (damped) or u = x (driven), s = 2 x, and what their rates are when damped."""
    study = Study("two_laws")
    x, u = study.state("x"), study.input("u")
    study.motion(x, u)

    @study.law("a", u)
    def damped():
        return -x

    @study.law("b", u)
    def driven():
        return 1 * x

    @study.definition("s")
    def s():
        return 2 * x

    @study.claimed("rate")
    def of_state():
        """Under the first law."""
        return equal(study.rate(x, damped), -x)

    @study.claimed("rate of s")
    def of_definition():
        """Under the first law."""
        return equal(study.rate(s, damped), -s())

    return study, x, s, {"damped": damped, "driven": driven, "none": None}, (of_state, of_definition)


def limit(study, law, using, what):
    """The theorem that what is rated vanishes in the loop of a law."""

    @study.claimed("theorem", using=[using])
    def vanishes():
        """It vanishes."""
        return claim(given=[bounded(study.symbols["x"].expr)], then=[tends(what)], laws=[law])

    @study.argument(vanishes)
    def by_decay(run):
        run.decays(what**2, a=2)
        run.exists()
        run.tends(what)

    return next(row for row in verify(study, ["vanishes"]).rows if row.id == "vanishes")


@pytest.mark.parametrize("which", [0, 1])
def test_in_a_theorem_about_another_loop_it_is_refused(which):
    study, x, s, laws, equations = two_laws()
    with pytest.raises(StudyError, match=r"is a rate under the law damped, and here .* under the law driven"):
        limit(study, laws["driven"], equations[which], (x, s())[which])


@pytest.mark.parametrize("which", [0, 1])
def test_in_its_own_loop_it_is_used(which):
    study, x, s, laws, equations = two_laws()
    row = limit(study, laws["damped"], equations[which], (x, s())[which])
    assert (row.verdict, row.stands) == ("proved", True)


@pytest.mark.parametrize(("law", "words"), [("driven", "under the law driven"), ("none", "without a law")])
@pytest.mark.parametrize("which", [0, 1])
def test_beside_another_rate_it_is_refused(which, law, words):
    study, x, s, laws, equations = two_laws()
    square = (x, s())[which] ** 2

    @study.claimed("square", using=[equations[which]])
    def of_square():
        """Its square falls."""
        return equal(study.rate(square, laws[law]), -2 * square)

    with pytest.raises(StudyError, match=rf"is a rate under the law damped, and here .* {words}"):
        verify(study, ["of_square"])


def test_a_rate_that_does_not_read_it_may_be_without_a_law():
    study, x, _, laws, (of_state, _) = two_laws()
    y = study.state("y")
    study.motion(y, -y)

    @study.claimed("both", using=[of_state])
    def of_both():
        """The rates of x and of y."""
        return equal(study.rate(x, laws["damped"]) + study.rate(y), -x - y)

    row = next(row for row in verify(study, ["of_both"]).rows if row.id == "of_both")
    assert (row.verdict, row.stands) == ("proved", True)
