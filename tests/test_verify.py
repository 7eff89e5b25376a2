"""Deciding whole studies: exactly what is false is refuted, and everything else is proved."""

import json
from fractions import Fraction

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from symctrl.kernel.check import check_text
from symctrl.verify import verify
from tests.altered import STUDIES

CASES = [(build, factor) for build, factors in STUDIES.items() for factor in factors]


def verdicts(study):
    return {row.id: row.verdict for row in verify(study).rows}


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
