"""Definitions, laws and statements as functions: their names, sentences, arguments, readings and variants."""

import re

import pytest

from symctrl import Study, equal, positive_definite
from symctrl.context import Instance, within
from symctrl.expr import Nonconforming
from symctrl.verify import verify
from symctrl.written import StudyError


@pytest.fixture
def study():
    made = Study("own")
    made.x = made.state("x", 2)
    made.u = made.input("u", 2)
    made.k = made.gain("k", "2")
    made.motion(made.x, made.u)
    return made


def test_the_name_is_the_id_and_the_first_paragraph_the_sentence(study):
    @study.claimed("(3)")
    def same():
        """x is
        itself.

        More words.
        """
        return equal(study.x, study.x)

    assert (same.id, same.equation, same.form, same.sentence) == ("same", "(3)", "claimed", "x is itself.")
    assert study.statement_ids() == ["same"]


def test_a_correction_without_a_sentence_says_why(study):
    @study.printed("(1)")
    def doubled():
        """x is twice x."""
        return equal(study.x, 2 * study.x)

    @study.corrected(doubled, why="It is once x.")
    def once():
        return equal(study.x, study.x)

    assert (once.corrects, once.equation, once.sentence) == ("doubled", "(1)", "It is once x.")


def enter(study, **options):
    return study.claimed("a", **options)


def no_sentence():
    return equal(1, 1)


def takes_too_much(way):
    """A claim."""
    return equal(way, way)


def takes_a_node(i):
    """A claim."""
    return equal(1, 1)


def fine():
    """A claim."""
    return equal(1, 1)


@pytest.mark.parametrize(
    ("function", "options", "says"),
    [
        (no_sentence, {}, "no_sentence: the docstring must say the claim in a sentence"),
        (takes_too_much, {}, "takes_too_much: a function takes the nodes i and j of a fleet"),
        (fine, {"readings": {"one": 1}}, "fine: a function takes"),
        (takes_a_node, {}, "takes_a_node takes a node, but the study has no fleet"),
        (fine, {"finding": {"true": "So."}}, "true is none"),
    ],
)
def test_what_a_decorator_refuses(study, function, options, says):
    with pytest.raises(StudyError, match=re.escape(says)):
        enter(study, **options)(function)
    assert study.statement_ids() == []


def test_an_id_is_taken_once(study):
    enter(study)(fine)
    with pytest.raises(StudyError, match="two functions fine in the study own"):
        study.definition("b")(fine)


def test_corrected_takes_the_printed_statement_itself(study):
    @study.printed("(1)")
    def wrong():
        """A claim."""
        return equal(study.k, 0)

    with pytest.raises(StudyError, match="takes the printed statement, definition or law itself"):
        study.corrected("wrong", why="So.")
    first = study.corrected(wrong, why="So.")(fine)
    with pytest.raises(StudyError, match="takes the printed"):
        study.corrected(first, why="So.")


def test_a_function_that_returns_nothing_is_named(study):
    @study.definition("V")
    def V():
        study.x.T @ study.x

    with pytest.raises(StudyError, match="V: the function returns nothing; it must return the quantity"):
        V()


def test_each_reading_is_a_row_of_its_own(study):
    @study.printed("(1)", readings={"once": 1, "twice": 2})
    def scaled(factor):
        """x is some multiple of x."""
        return equal(study.x, factor * study.x)

    rows = {row.id: row for row in verify(study).rows}
    assert {id_: row.verdict for id_, row in rows.items()} == {
        "scaled[once]": "proved",
        "scaled[twice]": "refuted",
    }
    assert rows["scaled[twice]"].reading == "twice"
    assert all(row.settled for row in rows.values())
    assert [row.id for row in verify(study, ["scaled"]).rows] == list(rows)
    assert [row.id for row in verify(study, ["scaled[once]"]).rows] == ["scaled[once]"]


def test_a_definition_has_the_variant_of_the_instance(study):
    @study.definition("V")
    def V():
        return study.x.T @ study.x

    @study.corrected(V, why="Half of it.")
    def V_corrected():
        return study.x.T @ study.x / 2

    assert V_corrected is V
    assert V.variant().id == "V"
    with within(Instance(variant="corrected")):
        assert V.variant().id == "V_corrected"


def test_a_definition_that_does_not_conform_is_named_with_its_equation(study):
    @study.definition("(8)")
    def sum_of_shapes():
        return study.x + study.x.T

    with pytest.raises(Nonconforming, match=r"definition sum_of_shapes \(8\): "):
        sum_of_shapes()


def test_a_law_has_the_shape_of_its_input(study):
    @study.law("(4)", study.u)
    def short():
        return -study.k * study.x[0]

    with pytest.raises(Nonconforming, match=r"law short \(4\): the input is 2x1, the law 1x1"):
        short.body()
    (row,) = verify(study).rows
    assert row.verdict == "ill-formed"
    assert "the input is 2x1" in row.reason


def test_a_law_sets_a_declared_input(study):
    @study.law("(4)", 2 * study.u)
    def no_input():
        return study.x

    with pytest.raises(StudyError, match="the law no_input sets an input that the study declares"):
        no_input.body()


def test_a_definition_is_called_without_nodes_where_there_is_no_fleet(study):
    @study.definition("V")
    def V():
        return study.x

    with pytest.raises(StudyError, match=r"the definition V is called as V\(\)"):
        V(1)


@pytest.mark.parametrize("returned", [1, "a = b", None, [], [1]])
def test_a_statement_returns_a_claim(study, returned):
    def claim():
        """A claim."""
        return returned

    study.claimed("a")(claim)
    with pytest.raises(StudyError, match="claim"):
        verify(study)


def test_a_list_of_claims_is_proved_when_all_are(study):
    @study.claimed("a")
    def both():
        """Both."""
        return [equal(study.x, study.x), positive_definite([[study.k, 0], [0, 1]])]

    @study.claimed("b")
    def one_fails():
        """Both."""
        return [equal(study.x, study.x), positive_definite([[-study.k, 0], [0, 1]])]

    assert [row.verdict for row in verify(study).rows] == ["proved", "refuted"]
