"""Deciding whole studies: exactly what is false is refuted, and everything else is proved."""

import json
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from derivations.liang2016_formation import study
from symctrl import equal
from symctrl.context import within
from symctrl.decide.claims import parts, verdict_of
from symctrl.expr import terms
from symctrl.kernel.check import check_text
from symctrl.verdict import Outcome
from symctrl.verify import verify
from tests.altered import STUDIES

CASES = [(build, factor) for build, factors in STUDIES.items() for factor in factors]


@pytest.mark.parametrize("build", STUDIES, ids=lambda build: build.__name__)
def test_the_textbook_is_right(build):
    report = verify(build())
    assert report.settled
    assert {row.verdict for row in report.rows} == {"proved"}
    for row in report.rows:
        assert check_text(json.dumps(row.certificate)).status == "valid"


@pytest.mark.parametrize(("build", "factor"), CASES, ids=lambda x: x if isinstance(x, str) else x.__name__)
@given(value=st.fractions(-3, 3, max_denominator=1000).filter(lambda value: value != 1))
@example(value=Fraction(-1))
@example(value=Fraction(10**15 + 1, 10**15))
@settings(max_examples=3, deadline=None)
def test_one_altered_coefficient_turns_exactly_the_claims_that_it_decides(build, factor, value):
    """A flipped sign, another number, or a coefficient that is wrong by a part in 10^15."""
    rows = verify(build(**{factor: value})).rows
    assert {row.id for row in rows if row.verdict == "refuted"} == STUDIES[build][factor]
    for row in rows:
        assert row.verdict in ("proved", "refuted")
        assert check_text(json.dumps(row.certificate)).status == "valid"


FORMATION = [
    "kinematics_scalar",
    "euler",
    "poisson",
    "V_is_the_quadratic_form[Omega has the blocks beta I]",
    "V_in_squares",
    "both_directions",
    "rate_of_V_2_in_differences",
]


@pytest.mark.parametrize("id_", FORMATION)
@pytest.mark.parametrize("factor", [Fraction(-1), Fraction(10**12 + 1, 10**12)], ids=["sign", "tiny"])
def test_an_altered_addend_of_the_formation_study_is_found(id_, factor):
    """The last addend of a proved equation, as it is written on either side, with another coefficient."""
    base, _, reading = id_.partition("[")
    with within(replace(study.instance, variant="corrected")):
        claim = study.entries[base].call(study, reading.rstrip("]") or None)
        assert verdict_of(parts(study, claim, id_), None).outcome is Outcome.PROVED
        side = claim.right if len(terms(claim.right)) > 1 else claim.left
        other = claim.left if side is claim.right else claim.right
        altered = equal(other, side + (factor - 1) * terms(side)[-1])
        verdict = verdict_of(parts(study, altered, id_), None)
    assert verdict.outcome is Outcome.REFUTED
    assert check_text(json.dumps(verdict.certificate)).status == "valid"
