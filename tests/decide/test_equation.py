"""Equations end to end: the verdict, its certificate, its conditions."""

import json

import pytest

from symctrl import Study, equal
from symctrl.decide.decision import decide
from symctrl.kernel.check import check_text
from symctrl.vectors import absolute, exp, power, sgn, sqrt, tanh
from symctrl.verdict import Outcome
from tests.decide.problems import body, problem
from tests.domains.test_exact_identities import FALSE, TRUE


def start():
    study = Study("s")
    return study, *(study.parameter(name) for name in "xyzgt")


def verdict(study, claim, *hypotheses):
    found = decide(problem(study, claim, *hypotheses))
    if found.certificate is not None:
        assert check_text(json.dumps(found.certificate)).status == "valid"
    return found


# What the domain proves and the kernel has no rule for: powers of products with a symbolic exponent.
WITHOUT_RULE = ("x^g y^g", "4^g")


@pytest.mark.parametrize("name", [name for name in TRUE if name not in WITHOUT_RULE])
def test_the_kernel_accepts_what_the_domain_proves(name):
    found = verdict(start()[0], equal(TRUE[name], 0))
    assert found.outcome is Outcome.PROVED, found.reason


@pytest.mark.parametrize("name", WITHOUT_RULE)
def test_what_the_kernel_has_no_rule_for_is_undecided(name):
    found = verdict(start()[0], equal(TRUE[name], 0))
    assert found.outcome is Outcome.UNDECIDED
    assert "the kernel does not accept" in found.reason


@pytest.mark.parametrize("name", sorted(set(FALSE) - {"log is odd"}))
def test_a_near_miss_is_refuted(name):
    assert verdict(start()[0], equal(FALSE[name], 0)).outcome is Outcome.REFUTED


def test_a_quotient_is_a_condition():
    study, x, *_ = start()
    (condition,) = verdict(study, equal(x / x, 1)).conditions
    assert (condition.kind, condition.of) == ("nonzero", "x")


def test_an_assumed_sign_is_no_condition():
    study, x, *_ = start()
    assert verdict(study, equal(x / x, 1), x > 0).conditions == ()
    assert verdict(study, equal(sqrt(x) ** 2, x), x >= 0).conditions == ()


def test_a_root_is_a_condition():
    study, x, *_ = start()
    (condition,) = verdict(study, equal(sqrt(x) ** 2, x)).conditions
    assert (condition.kind, condition.of) == ("nonnegative", "x")


def test_what_has_no_point_is_not_decided():
    assert verdict(start()[0], equal(FALSE["log is odd"], 0)).outcome is Outcome.UNDECIDED


def test_what_is_nowhere_defined_is_ill_formed():
    study, q, _ = body()
    norm = q.vector.T @ q.vector + q.scalar**2 - 1
    assert verdict(study, equal(1 / norm, 1)).outcome is Outcome.ILL_FORMED


def test_signs_decide_what_relations_do_not():
    study, x, y, _, g, _ = start()
    assert verdict(study, equal(sgn(x * y**2), 1), x > 0, y > 0).outcome is Outcome.PROVED
    assert verdict(study, equal(absolute(x * y), x * y), x >= 0, y >= 0).outcome is Outcome.PROVED
    assert verdict(study, equal(power(x, g) * exp(g), tanh(g)), x > 0).outcome is Outcome.REFUTED
