"""The theorem of the formation study and its lemmas, against what was worked out by hand."""

from __future__ import annotations

import pytest

from symctrl.rows import Row

THEOREMS = (
    "chart_takes_nothing_away",
    "chart_is_kept",
    "lemma_1",
    "lemma_2",
    "lemma_2_of_the_function",
    "theorem_1",
    "synchronisation",
)


def test_the_verdicts_are_those_worked_out_by_hand(rows: dict[str, Row]) -> None:
    # Lemma 2 is false for a constant; theorem 1 for two craft at rest with opposite quaternions. The law
    # divides by q0. From small initial states the chart is kept: V + delta sum |q_i|_1 does not rise.
    assert {id_: rows[id_].verdict for id_ in THEOREMS} == {
        "chart_takes_nothing_away": "refuted",
        "chart_is_kept": "proved",
        "lemma_1": "proved",
        "lemma_2": "refuted",
        "lemma_2_of_the_function": "proved",
        "theorem_1": "refuted",
        "synchronisation": "proved",
    }


def test_the_printed_argument_breaks_where_it_should(rows: dict[str, Row]) -> None:
    # The printed M is not that of the rate of V, and with free gains neither it nor V is definite.
    first = rows["theorem_1/with_definite_Pi/1"]
    assert first.verdict == "refuted"
    assert any(unmet.endswith("V falls") for unmet in first.unmet)
    assert rows["theorem_1/with_definite_Pi/2"].blocked_by == first.id


def test_what_the_corrected_theorem_assumes(rows: dict[str, Row]) -> None:
    row = rows["synchronisation"]
    about = {given.text: given.about for given in row.given}
    assert about["K_o >= beta*Lambda"] == "parameter"
    assert about["no eigenvalue of the Laplacian exceeds Lambda"] == "parameter"
    assert about["q0.i > 0"] == "initial"
    assert about["delta*c - V - delta*sum_i([1; 1; 1]'*absolute(q.i)) >= 0"] == "initial"
    assert row.certificate is not None


@pytest.mark.parametrize("id_", ["chart_is_kept", "synchronisation"])
def test_of_the_trajectory_nothing_is_assumed(rows: dict[str, Row], id_: str) -> None:
    row = rows[id_]
    assert [given.text for given in row.given if given.about == "trajectory"] == []
    assert row.stands
    assert not row.conditional


@pytest.mark.parametrize("id_", ["chart_is_kept", "synchronisation"])
def test_every_assumption_of_a_corrected_theorem_is_needed(rows: dict[str, Row], id_: str) -> None:
    twins = rows[id_].twins
    assert twins is not None
    assert twins.tried >= 5
    assert twins.still_true == ()


def test_the_chart_is_kept_from_initial_states_alone(rows: dict[str, Row]) -> None:
    about = {given.text: given.about for given in rows["chart_is_kept"].given}
    assert about["delta*c - V - delta*sum_i([1; 1; 1]'*absolute(q.i)) >= 0"] == "initial"
    assert "q0.i > 0" not in about


def test_the_counterexample_has_a_graph_and_opposite_scalar_parts(rows: dict[str, Row]) -> None:
    witness = rows["theorem_1"].witness
    assert witness is not None
    assert witness["graph"] == [["1", "2"]]
    assert witness["q0.1"] == "4/5"
    assert witness["q0.2"] == "-4/5"
