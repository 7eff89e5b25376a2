"""A study: instances with other values or another graph, its numbered equations, its digest."""

from fractions import Fraction

import pytest

from symctrl import Study, at_values, equal, positive_definite
from symctrl.graphs import parse
from symctrl.inputs import inputs_digest
from symctrl.verify import verify
from symctrl.written import StudyError


@pytest.fixture
def study():
    made = Study("own")
    made.state("x", 2)
    made.gain("k", "2")
    made.parameter("m", "1/3")
    made.inertia("J", [[2, 0, 0], [0, 3, 0], [0, 0, 4]])
    return made


@pytest.mark.parametrize(
    ("values", "says"),
    [
        ({"k": "0"}, "the gain k must be positive"),
        ({"k": "-1e-3"}, "the gain k must be positive"),
        ({"k": "two"}, "not an exact number"),
        ({"kk": "1"}, "own has no parameter kk; it has k"),
        ({"x[1]": "1"}, r"own has no parameter x\[1\]; it has k, m, J"),
        ({"J": "1"}, r"J has J\[1,1\], J\[1,2\], "),
        ({"J[2,1]": "1"}, r"no parameter J\[2,1\]"),
    ],
)
def test_values_that_the_study_cannot_have(study, values, says):
    with pytest.raises(StudyError, match=says):
        study.at(values=values)


def test_an_instance_leaves_the_study_as_it_is(study):
    @study.claimed("a")
    def small():
        """m is small, and J definite."""
        return at_values(positive_definite([[1, study.symbols["m"].expr], [study.symbols["m"].expr, 1]]))

    other = study.at(values={"m": "1"})
    assert [verify(s).rows[0].verdict for s in (study, other, study)] == ["proved", "refuted", "proved"]
    assert verify(other.at(values={"m": "-0.999999999"})).rows[0].verdict == "proved"
    assert other.instance.values == {"m": Fraction(1)}


def test_values_do_not_touch_what_holds_for_all(study):
    @study.claimed("a")
    def sign():
        """k is not zero."""
        return study.symbols["k"].expr > 0

    assert verify(study.at(values={"k": "1/1000000"})).rows[0].verdict == "proved"


def test_a_graph_is_for_a_fleet(study):
    with pytest.raises(StudyError, match="the study own has no fleet, so it takes no graph"):
        study.at(graph=parse("ring:4"))


def test_numbers_of_the_paper_that_are_not_entered_are_missing():
    study = Study("numbers")
    study.numbered("(1)-(4)", "lemma 1")
    x = study.state("x")

    @study.claimed("(2), (3)")
    def both():
        """A claim."""
        return equal(x, x)

    assert study.numbers == ["(1)", "(2)", "(3)", "(4)", "lemma 1"]
    assert verify(study).missing == ("(1)", "(4)", "lemma 1")


def test_the_digest_of_the_inputs_tells_what_was_asked(study):
    @study.claimed("a")
    def same():
        """A claim."""
        return equal(study.symbols["x"].expr, study.symbols["x"].expr)

    def fresh(**changes):
        made = Study("own")
        made.state("x", 2, unit=changes.get("unit"))
        made.gain("k", changes.get("k", "2"))
        if "more" in changes:
            made.assume(made.symbols["k"].expr > 1)
        return inputs_digest(made, {"same"})

    assert fresh() == fresh()
    digests = [fresh(), fresh(k="3"), fresh(unit="m"), fresh(more=True), inputs_digest(study, {"same"})]
    digests += [inputs_digest(study, {"other"}), inputs_digest(study.at(values={"k": "5"}), {"same"})]
    assert len(set(digests)) == len(digests)


def test_the_digest_changes_with_the_text_of_the_study(tmp_path):
    def digest(text):
        path = tmp_path / "own.py"
        path.write_text(text)
        names = {}
        exec(compile(text, str(path), "exec"), names)
        return verify(names["study"]).inputs_sha256

    text = (
        "from symctrl import Study, equal\nstudy = Study('own')\nx = study.state('x')\n"
        "@study.claimed('a')\ndef a():\n    'A claim.'\n    return equal(x, x)\n"
    )
    assert digest(text) == digest(text)
    assert digest(text) != digest(text.replace("equal(x, x)", "equal(x + 0, x)"))
