"""Equations that follow from assumed ones: taken with their cofactors, refused with anything changed."""

from __future__ import annotations

import copy
import json
from typing import Any

import pytest

from symctrl import Study, equal, implies
from symctrl.certify import certificate
from symctrl.decide.claims import parts, verdict_of
from symctrl.kernel.check import check_text
from symctrl.vectors import det, eye

study = Study("ideal", source="equations that follow")
x, y, z = (study.parameter(name) for name in "xyz")
R = study.parameter("R", shape=(2, 2))


def made(claim: Any) -> dict[str, Any]:
    verdict = verdict_of(parts(study, claim, "claim"), None)
    assert verdict.certificate is not None, verdict.reason
    return copy.deepcopy(dict(verdict.certificate))


def status(changed: dict[str, Any]) -> str:
    return check_text(json.dumps(certificate(changed["statement"], changed["proof"]))).status


@pytest.mark.parametrize(
    "claim",
    [
        implies([equal(x * y, 1), equal(x * z, 1)], equal(y, z)),
        implies([equal(x * y, 0), equal(x * z, 1)], equal(y, 0)),
        implies(equal(R.T @ R, eye(2)), equal(R @ R.T, eye(2))),
        implies(equal(R.T @ R, eye(2)), equal(det(R) ** 2, 1)),
    ],
    ids=["equal inverses", "zero", "orthogonal", "determinant"],
)
def test_what_follows_is_proved_by_a_derived_relation(claim: Any) -> None:
    found = made(claim)
    assert status(found) == "valid"
    without = copy.deepcopy(found)
    relations = without["proof"].pop("relations", [])
    if relations:
        assert status(without) in ("invalid", "declined")


@pytest.mark.parametrize("change", ["poly", "cofactor", "assumption", "left out", "constant", "empty"])
def test_a_relation_that_does_not_follow_is_refused(change: str) -> None:
    found = made(implies([equal(x * y, 1), equal(x * z, 1)], equal(y, z)))
    relation = found["proof"]["relations"][0]
    if change == "poly":
        relation["poly"][0][0] = "7"
    elif change == "cofactor":
        relation["of"][0][1][0][0] = "7"
    elif change == "assumption":
        relation["of"][0][0] = 1 - relation["of"][0][0]
    elif change == "left out":
        relation["of"].pop()
    elif change == "constant":
        relation["poly"] = [["1"]]
    else:
        relation["poly"], relation["of"] = [], []
    assert status(found) == "invalid"


def test_what_does_not_follow_is_not_proved() -> None:
    verdict = verdict_of(parts(study, implies(equal(R.T @ R, eye(2)), equal(det(R), 1)), "claim"), None)
    assert verdict.outcome.value != "proved"
