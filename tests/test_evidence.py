"""Second evidence, twins and units: what stands beside a verdict and would contradict a wrong one."""

from __future__ import annotations

import pytest

from symctrl import Study, equal, nonnegative, positive_definite
from symctrl import evidence as module
from symctrl.collect import Collector
from symctrl.dimensions import units_of
from symctrl.domains.tangent import Tangent
from symctrl.problem import Problem
from symctrl.statements import Statement
from symctrl.vectors import absolute, sgn, sin

study = Study("pendulum", source="a pendulum with a motor")
theta, omega = study.state("theta", unit="1"), study.state("omega", unit="1/s")
m, length = study.parameter("m", "2", unit="kg"), study.parameter("l", "1/2", unit="m")
g, c = study.parameter("g", "9.81", unit="m/s^2"), study.gain("c")
u = study.input("u", unit="N*m")
study.motion(theta, omega)
study.motion(omega, (u - m * g * length * sin(theta)) / (m * length**2))


@study.law("law", u)
def damping():
    return -c * omega


@study.definition("energy")
def kinetic():
    return m * length**2 * omega**2 / 2


POWER = -c * omega**2 - m * g * length * sin(theta) * omega


def problem(claim: Statement) -> Problem:
    return Collector(study).problem(claim, "claim")


def test_a_true_rate_agrees_with_floating_point_and_differences() -> None:
    found = module.numeric(problem(equal(study.rate(kinetic, damping), POWER)))
    assert found is not None
    assert 6 <= found.samples <= module.SAMPLES  # a mass of zero has no motion
    assert found.max_residual < 1e-12


@pytest.mark.parametrize("factor", ["1.000001", "-1", "0"])
def test_a_false_rate_is_seen(factor: str) -> None:
    found = module.numeric(problem(equal(study.rate(kinetic, damping), factor * POWER)))
    assert found is not None
    assert found.max_residual > module.TOLERANCE


def test_a_wrong_chain_rule_is_seen_by_differences(monkeypatch: pytest.MonkeyPatch) -> None:
    """Both sides take the same wrong rate and agree; the differences along the motion do not."""
    claim = problem(equal(study.rate(sin(theta) * omega, damping), study.rate(sin(theta) * omega, damping)))
    assert module.numeric(claim) == module.numeric(claim)
    right = module.numeric(claim)
    assert right is not None
    assert right.max_residual < 1e-12
    monkeypatch.setattr(Tangent, "sin_", lambda self, a: self._chain(self._of("SIN", a.value), self._one, a))
    wrong = module.numeric(claim)
    assert wrong is not None
    assert wrong.max_residual > module.TOLERANCE


def test_an_addend_that_vanishes_survives_as_a_twin() -> None:
    claim = equal(absolute(theta) + (absolute(theta) - sgn(theta) * theta) * omega, sgn(theta) * theta)
    found = module.twins(study, claim, "claim")
    assert found.tried == 4  # three addends, and the sides being the same
    assert [text for text in found.still_true if "omega" in text] == list(found.still_true) != []
    assert module.twins(study, equal(absolute(theta), sgn(theta) * theta), "claim").still_true == ()


def test_the_same_graph_on_both_sides_claims_nothing() -> None:
    found = module.twins(study, equal(theta * omega, theta * omega), "claim")
    assert any("same graph" in text for text in found.still_true)


def test_reversed_bounds_fail_unless_both_signs_hold() -> None:
    fails = module.reversed_twins(
        [problem(nonnegative(theta**2)), problem(positive_definite([[2, 1], [1, 2]]))]
    )
    assert fails is not None
    assert (fails.tried, fails.still_true) == (2, ())
    holds = module.reversed_twins([problem(nonnegative(theta - theta))])
    assert holds is not None
    assert holds.still_true == ("reversed: theta - theta <= 0",)
    assert module.reversed_twins([problem(equal(theta, theta))]) is None


def test_contradicting_assumptions_leave_no_point() -> None:
    empty = Study("empty")
    x = empty.parameter("x")
    empty.assume(x > 1, x < 0)
    assert not module.point_known([Collector(empty).problem(nonnegative(x), "claim")])
    assert module.point_known([problem(nonnegative(theta**2))])


def test_a_gain_gets_the_unit_that_the_equation_forces() -> None:
    found = units_of(study, problem(equal(study.rate(kinetic, damping), POWER)))
    assert found is not None
    assert found.consistent
    assert found.inferred == {"c": "N m s"}


@pytest.mark.parametrize(
    ("claim", "words"),
    [
        (equal(theta + omega, theta), "has unit"),
        (equal(kinetic(), omega), "has unit"),
        (equal(sin(omega), theta), "not a pure number"),
    ],
)
def test_the_first_mismatch_is_said_in_words(claim: Statement, words: str) -> None:
    found = units_of(study, problem(claim))
    assert found is not None
    assert not found.consistent
    assert found.mismatch is not None
    assert words in found.mismatch


def test_an_error_in_a_twin_is_said_of_the_twin(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> bool:
        raise ZeroDivisionError("a quotient by zero")

    monkeypatch.setattr(module, "_reversed_fails", broken)
    monkeypatch.setattr(module, "_vanishes", broken)
    turned = module.reversed_twins([problem(nonnegative(theta**2))])
    assert turned is not None
    assert turned.failed == ("reversed: theta^2 <= 0: ZeroDivisionError: a quotient by zero",)
    found = module.twins(study, equal(absolute(theta), sgn(theta) * theta), "claim")
    assert (len(found.failed), found.still_true) == (2, ())
