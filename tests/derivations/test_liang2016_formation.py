"""The formation study against what was derived by hand, and against independent numerics."""

from __future__ import annotations

import json
from dataclasses import replace

import networkx as nx
import numpy as np
import pytest

from derivations.liang2016_formation import study
from derivations.liang2016_formation.gains import GRAPHS
from symctrl.graphs import parse
from symctrl.kernel.check import check_text
from symctrl.rows import Report, Row
from symctrl.verify import verify

# By hand: what is false in the text, and whether it is false by itself or has no meaning as written.
REFUTED = {
    "scalar_part_range": "an angle beyond half a turn",
    "q_cross_is_skew": "the entry in row 3, column 2",
    "kinematics[the vector part]": "the same entry",
    "lagrange[the dot on J]": "B lacks the rate of Q",
    "lagrange[the dot on Q]": "the sign of the rate of Q",
    "B_is_skew[B as (3) needs it]": "only dA/dt - 2B is skew",
    "V_is_the_quadratic_form[every entry of Omega is beta]": "Omega is block diagonal in each block",
    "closed_loop": "the law does not cancel with the printed B",
    "rate_of_V_i_closed[K_p is K_q, K_v in each component]": "|tau| beside the disturbance",
    "M_is_that_of_the_rate": "degrees on the diagonal, beta beside it",
    "rate_of_V": "M and the disturbance",
    "equal_vectors_give_equal_attitude": "the sign of the scalar part",
    "rate_of_V_2": "a factor two",
    "rate_of_V_2_on_the_surface": "a factor two",
    "Pi_definite_at_the_gains[star:8]": "beta lambda_max = 0.3 * 8 > 1.6",
    "Pi_definite_at_the_gains[complete:8]": "beta lambda_max = 0.3 * 8 > 1.6",
    "tanh_in_the_place_of_sgn": "tanh is below one",
    "chart_takes_nothing_away": "the law divides by zero after half a turn",
    "lemma_2": "a constant",
    "theorem_1": "opposite quaternions at rest",
}
OF_ARGUMENTS = ("step", "obligation")
ILL_FORMED = {
    "kinematics[the whole quaternion]",
    "rate_of_V_i_closed[as printed]",
    "epsilon",
    "Pi_acts_on_zeta",
    "sum_of_squares[as printed]",
}
CONDITIONAL = {
    "lagrange_corrected",
    "rate_of_A_minus_2B_is_skew",
    "A_is_invertible",
    "Q_is_invertible",
    "closed_loop_corrected",
    "d_in_w",
    "d_is_bounded",
    "K_v_is_enough",
}


def test_the_verdicts_are_those_derived_by_hand(rows: dict[str, Row]) -> None:
    expected = dict.fromkeys(REFUTED, "refuted") | dict.fromkeys(ILL_FORMED, "ill-formed")
    claims = {id_: row for id_, row in rows.items() if row.form not in OF_ARGUMENTS}
    found = {id_: row.verdict for id_, row in claims.items() if row.verdict != "proved"}
    assert found == expected


def test_every_claim_is_settled_and_what_is_missing_is_named(report: Report) -> None:
    assert [row.id for row in report.rows if not row.settled] == []
    assert report.missing == ()


def test_what_needs_the_chart_is_conditional(rows: dict[str, Row]) -> None:
    assert {id_ for id_ in CONDITIONAL if not (rows[id_].stands and rows[id_].conditional)} == set()
    assert not rows["poisson"].conditional
    assert any(given.about == "trajectory" for given in rows["rate_of_V_corrected"].given)


def test_every_certificate_is_valid_on_its_own(report: Report) -> None:
    for row in report.rows:
        if row.verdict in ("proved", "refuted") and row.form not in OF_ARGUMENTS:
            assert row.certificate is not None, row.id
            assert check_text(json.dumps(row.certificate)).status == "valid", row.id


def test_no_twin_survives(report: Report) -> None:
    assert [row.id for row in report.rows if row.twins and row.twins.still_true] == []


def test_second_evidence_agrees_with_the_proofs(report: Report) -> None:
    residuals = [row.numeric.max_residual for row in report.rows if row.numeric]
    assert residuals
    assert max(residuals) < 1e-12


def test_gains_get_the_units_that_the_equations_force(rows: dict[str, Row]) -> None:
    units = rows["closed_loop_corrected"].units
    assert units is not None
    assert units.consistent
    assert units.inferred == {"K_o": "s^-1", "K_q": "s^-2", "K_v": "s^-2", "beta": "s^-1"}


@pytest.mark.parametrize("spec", GRAPHS)
def test_the_gain_boundary_is_that_of_the_float_eigenvalue(spec: str, rows: dict[str, Row]) -> None:
    """Pi is definite at K_o = 1.6, beta = 0.3 exactly where 0.3 lambda_max(L) < 1.6."""
    largest = np.linalg.eigvalsh(nx.laplacian_matrix(parse(spec)).toarray().astype(float))[-1]
    wanted = "proved" if 0.3 * largest < 1.6 else "refuted"
    assert rows[f"Pi_definite_at_the_gains[{spec}]"].verdict == wanted
    bound = study.of_fleet.largest_eigenvalue(parse(spec)) if study.of_fleet else None
    assert bound is not None
    assert float(bound.low) - 1e-9 <= largest <= float(bound.high) + 1e-9
    assert bound.high - bound.low < 1e-5


def test_another_gain_moves_the_verdict_about_numbers_and_no_other(rows: dict[str, Row]) -> None:
    ids = {"Pi_definite_at_the_gains[star:8]", "rate_of_V_2_doubled", "Pi_definite_exactly[star:8]"}
    found = {row.id: row.verdict for row in verify(study.at(values={"K_o": "2.5"}), ids).rows}
    assert found["Pi_definite_at_the_gains[star:8]"] == "proved"
    assert {id_: found[id_] for id_ in ids - {"Pi_definite_at_the_gains[star:8]"}} == {
        id_: rows[id_].verdict for id_ in ids - {"Pi_definite_at_the_gains[star:8]"}
    }


@pytest.mark.parametrize("spec", ["path:3", "star:4", "complete:3"])
def test_claims_about_any_graph_do_not_depend_on_the_instance(spec: str, rows: dict[str, Row]) -> None:
    ids = {"V_in_squares", "rate_of_V_2_doubled", "M_is_that_of_the_rate", "Pi_acts_on_zeta"}
    at = verify(study.at(graph=parse(spec)), ids)
    assert {row.id: row.verdict for row in at.rows} == {id_: rows[id_].verdict for id_ in ids}
    holds_for = {row.id: row.holds_for for row in at.rows}
    assert holds_for["V_in_squares"] == "all"
    assert holds_for["M_is_that_of_the_rate"] != "all"


def test_the_report_is_the_same_twice(report: Report) -> None:
    ids = {"V_in_squares", "rate_of_V_2", "lagrange_corrected", "Pi_definite_at_the_gains"}
    again = {row.id: row for row in verify(study, ids).rows}
    first = {row.id: row for row in report.rows if row.id in again}
    blank = {"seconds": 0.0, "settled": True, "stands": True}
    assert {k: replace(r, **blank).as_json() for k, r in again.items()} == {
        k: replace(r, **blank).as_json() for k, r in first.items()
    }
