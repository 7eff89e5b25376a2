"""Deciding whole studies: exactly what is false is refuted, and everything else is proved."""

import json
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from derivations.liang2016_formation import study
from symctrl import Study, equal, nonnegative, positive_definite, positive_semidefinite
from symctrl.context import within
from symctrl.decide.claims import parts, verdict_of
from symctrl.expr import terms
from symctrl.kernel.check import check_text
from symctrl.store import Store
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


def tiny_matrices(k, tiny):
    """Rows of [1, 1 - tiny; 1 - tiny, 1], as numbers and scaled by a gain."""
    for scale in (1, k):
        yield [[scale, scale * (1 - tiny)], [scale * (1 - tiny), scale]]


@given(power=st.integers(1, 60))
@example(power=60)
@settings(max_examples=4, deadline=None)
def test_definiteness_and_equality_by_tiny_amounts(power):
    tiny = Fraction(1, 10**power)
    small = Study("tiny")
    k, x = small.gain("k"), small.state("x")
    expected = {}

    def claim(name, made, holds):
        def function():
            """A claim by a tiny amount."""
            return made

        function.__name__ = name
        small.printed(name)(function)
        expected[name] = "proved" if holds else "refuted"

    for n, (above, on, below) in enumerate(
        zip(*(tiny_matrices(k, t) for t in (tiny, 0, -tiny)), strict=True)
    ):
        claim(f"definite_above_{n}", positive_definite(above), True)
        claim(f"definite_on_{n}", positive_definite(on), False)
        claim(f"semidefinite_on_{n}", positive_semidefinite(on), True)
        claim(f"semidefinite_below_{n}", positive_semidefinite(below), False)
    claim("same", equal(tiny * x - x, (tiny - 1) * x), True)
    claim("not_the_same", equal(x + tiny, x), False)
    claim("bound", nonnegative(x**2 - 2 * x + 1), True)
    claim("not_a_bound", nonnegative(x**2 - 2 * x + 1 - tiny), False)
    assert {row.id: row.verdict for row in verify(small).rows} == expected


def right_and_wrong():
    made = Study("two")
    x, m = made.state("x"), made.parameter("m")

    @made.claimed("1")
    def right():
        """Right."""
        return equal(m * x / m, x)

    @made.printed("2")
    def wrong():
        """Wrong."""
        return equal(2 * x, x)

    return made


def entries(folder):
    return {path: json.loads(path.read_text()) for path in folder.rglob("*.json")}


def test_a_second_run_finds_the_same(tmp_path):
    first = verify(right_and_wrong(), store=Store(tmp_path)).rows
    assert entries(tmp_path)
    second = verify(right_and_wrong(), store=Store(tmp_path)).rows
    assert [replace(row, seconds=0) for row in second] == [replace(row, seconds=0) for row in first]


@pytest.mark.parametrize(
    "change",
    [
        lambda verdict: {"outcome": "proved" if verdict["outcome"] == "refuted" else "refuted"},
        lambda verdict: {"conditions": []},
        lambda verdict: {"certificate": None},
        lambda verdict: {"outcome": "proved", "certificate": None, "conditions": []},
        lambda verdict: {"outcome": "ill-formed", "certificate": None},
    ],
)
def test_an_entry_of_the_store_that_was_altered_changes_no_verdict(tmp_path, change):
    """Whoever can write there can make any entry look whole; what it says is still checked by the kernel."""
    store = Store(tmp_path)
    honest = verify(right_and_wrong(), store=store).rows
    for entry in entries(tmp_path).values():
        store.put(entry["digest"], entry["verdict"] | change(entry["verdict"]))
    again = verify(right_and_wrong(), store=store).rows
    assert [replace(row, seconds=0) for row in again] == [replace(row, seconds=0) for row in honest]


def test_the_certificate_of_one_claim_is_none_for_another(tmp_path):
    store = Store(tmp_path)
    honest = verify(right_and_wrong(), store=store).rows
    kept = list(entries(tmp_path).values())
    proved = next(entry["verdict"] for entry in kept if entry["verdict"]["outcome"] == "proved")
    for entry in kept:
        store.put(entry["digest"], proved)
    again = verify(right_and_wrong(), store=store).rows
    assert [row.verdict for row in again] == [row.verdict for row in honest] == ["proved", "refuted"]
