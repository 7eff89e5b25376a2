"""Witnesses: what is false by very little is found, what is true never has one."""

import json
from fractions import Fraction

import pytest

from symctrl import Study, equal
from symctrl.certify import certificate
from symctrl.decide.witness import refute
from symctrl.expr import lift
from symctrl.kernel.check import check_text
from symctrl.vectors import absolute, cos, cross, exp, sgn, sin, skew, sqrt
from tests.decide.problems import body, problem

TINY = ["1e-12", str(Fraction(1, 2**40)), "1e-30"]


def accepted(made, witness):
    return check_text(json.dumps(certificate(made.statement(), witness.proof(made)))).status == "valid"


@pytest.mark.parametrize("tiny", TINY)
def test_a_coefficient_that_is_off_by_little_is_found(tiny):
    study, q, w = body()
    v, s = q.vector, q.scalar
    made = problem(study, equal(cross(v, cross(v, w)), v * (v.T @ w) - w * (1 - s**2) + lift(tiny) * v))
    witness = refute(made)
    assert witness is not None
    assert accepted(made, witness)


@pytest.mark.parametrize("tiny", TINY)
def test_a_bound_that_fails_by_little_is_found(tiny):
    study = Study("s")
    x, y = study.parameter("x"), study.parameter("y")
    made = problem(study, x**2 + y**2 - (2 + lift(tiny)) * x * y >= 0, x >= 0, y >= 0, equal(x, y))
    witness = refute(made)
    assert witness is not None
    assert accepted(made, witness)


TRUE = {
    "norm": lambda q, w: equal(q.vector.T @ q.vector, 1 - q.scalar**2),
    "triple": lambda q, w: equal(cross(w, cross(w, q.vector)), skew(w) @ skew(w) @ q.vector),
    "switch": lambda q, w: equal(sgn(w[0]) * w[0], absolute(w[0])),
    "root": lambda q, w: equal(sqrt(w[0] ** 2), absolute(w[0])),
    "sine": lambda q, w: equal(sin(2 * w[0]), 2 * sin(w[0]) * cos(w[0])),
    "exponential": lambda q, w: equal(exp(w[0] + w[1]), exp(w[0]) * exp(w[1])),
}


@pytest.mark.parametrize("name", TRUE)
def test_a_true_identity_has_no_witness(name):
    study, q, w = body()
    assert refute(problem(study, TRUE[name](q, w))) is None


@pytest.mark.parametrize(
    "claim",
    [
        lambda q, w: equal(sgn(w[0]) ** 2, 1),
        lambda q, w: equal(sqrt(w[0] ** 2), w[0]),
        lambda q, w: equal(sin(2 * w[0]), 2 * sin(w[0])),
        lambda q, w: equal(exp(w[0]), 1 + w[0]),
        lambda q, w: w[0] ** 2 - absolute(w[0]) >= 0,
        lambda q, w: absolute(w[0]) > 0,
        lambda q, w: cos(w[0]) >= 0,
    ],
)
def test_a_near_miss_has_a_witness_that_the_kernel_accepts(claim):
    study, q, w = body()
    made = problem(study, claim(q, w))
    witness = refute(made)
    assert witness is not None
    assert accepted(made, witness)
