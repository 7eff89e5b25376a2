"""The model of a study: what can be declared, and what is assumed with it."""

from fractions import Fraction

import pytest

from symctrl import Study
from symctrl.verify import verify
from symctrl.written import StudyError


@pytest.fixture
def study():
    made = Study("own")
    made.state("x", 2)
    made.gain("k", "2")
    return made


@pytest.mark.parametrize(
    ("declare", "error", "says"),
    [
        (lambda s: s.state("k"), StudyError, "the symbol k is declared twice"),
        (
            lambda s: s.inertia("I", [[1, 2, 0], [0, 1, 0], [0, 0, 1]]),
            StudyError,
            "the inertia I must be symmetric",
        ),
        (lambda s: s.motion(s.state("y"), [1, 2]), StudyError, "of the same shape"),
        (lambda s: s.motion(2 * s.state("y"), 1), StudyError, "motion takes a state"),
        (
            lambda s: [s.motion(s.symbols["x"].expr, [0, 0]) for _ in "ab"],
            StudyError,
            "x has a motion already",
        ),
        (lambda s: s.parameter("p", "1", within="a tenth"), StudyError, 'within="10%"'),
        (lambda s: s.assume(s.symbols["k"].expr), TypeError, "an assumption is an equation, a bound"),
        (lambda s: s.gain("g", "one"), ValueError, "one"),
        (lambda s: s.parameter("p", 1 / 3), ValueError, "digits"),
    ],
)
def test_what_cannot_be_declared(study, declare, error, says):
    with pytest.raises(error, match=says):
        declare(study)


def test_a_range_is_assumed():
    study = Study("range")
    p = study.parameter("p", "2", within="50%")

    @study.claimed("inside")
    def inside():
        """p is at most 3."""
        return 3 - p >= 0

    @study.printed("outside")
    def outside():
        """p is at most 5/2."""
        return Fraction("5/2") - p >= 0

    study.rejected(outside, "p may be 3.")
    assert [row.verdict for row in verify(study).rows] == ["proved", "refuted"]
