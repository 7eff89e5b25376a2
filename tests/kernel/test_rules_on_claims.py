"""Rules of the kernel on certificates of real claims: each accepted, and refused with one thing changed."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from typing import Any

import pytest

from symctrl import Study, equal, nonnegative, positive_definite
from symctrl.certify import certificate
from symctrl.decide.claims import parts, verdict_of
from symctrl.kernel.check import check_text
from symctrl.vectors import absolute, atan2, cosh, eye, minimum, sinh, tanh

study = Study("rules", source="rules of the kernel")
x, y = study.parameter("x"), study.parameter("y")
k, J = study.gain("k"), study.inertia("J")
fleet = study.fleet("G")
i, j = fleet.node, fleet.neighbour
q = fleet.unit_quaternion("q", "q0")
squares = q[j].vector.T @ q[j].vector + q[j].scalar ** 2

CLAIMS = {
    "odd": equal(tanh(-x), -tanh(x)),
    "beside": nonnegative(k * absolute(x) - k * x),
    "assumed": positive_definite(k * J + eye(3)),
    "sum": equal(fleet.sum(j, squares, at=i), fleet.degree(i)),
    "hyperbolic": equal(cosh(x) ** 2 - sinh(x) ** 2, 1),
    "angle": equal(atan2(x * y, x**2 + 1) * 2, atan2(y * x, 1 + x**2) * 2),
    "least": nonnegative(x - minimum(x, y)),
}


def made(name: str) -> dict[str, Any]:
    verdict = verdict_of(parts(study, CLAIMS[name], name), None)
    assert verdict.certificate is not None, verdict.reason
    return copy.deepcopy(dict(verdict.certificate))


def status(changed: dict[str, Any]) -> str:
    whole = certificate(changed["statement"], changed["proof"])
    return check_text(json.dumps(whole)).status


@pytest.mark.parametrize("name", CLAIMS)
def test_the_rule_accepts(name: str) -> None:
    assert status(made(name)) == "valid"


def even_instead_of_odd(c: dict[str, Any]) -> None:
    (generator,) = [g for g in c["proof"]["generators"] if "function" in g]
    generator["function"] = "floor"


def sign_of_the_result(c: dict[str, Any]) -> None:
    for hint in [hint for hint in c["proof"]["hints"] if "is" in hint]:
        hint["is"][0][1][0][0] = str(-int(hint["is"][0][1][0][0]))


def twice_the_argument(c: dict[str, Any]) -> None:
    term = c["proof"]["entries"][0]["terms"][0]
    (beside,) = [g for g in term[1] if isinstance(g, list) and len(g) == 2]
    beside[-1][0] = "-2"


def another_assumption(c: dict[str, Any]) -> None:
    for part in c["proof"]["matrix"]["sum"]:
        if "given" in part:
            kinds = [g["kind"] for g in c["statement"]["given"]]
            part["given"] = kinds.index("positive")


def an_indefinite_multiple(c: dict[str, Any]) -> None:
    for part in c["proof"]["matrix"]["sum"]:
        if "given" in part:
            part["of"] = [["-1"]]


def no_relation(c: dict[str, Any]) -> None:
    c["statement"]["given"] = []


def another_node(c: dict[str, Any]) -> None:
    for generator in c["proof"]["generators"]:
        if "sum" in generator:
            generator["node"] = "j"


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("odd", even_instead_of_odd),
        ("beside", twice_the_argument),
        ("assumed", another_assumption),
        ("assumed", an_indefinite_multiple),
        ("sum", no_relation),
        ("sum", another_node),
        ("hyperbolic", sign_of_the_result),
    ],
)
def test_one_change_and_it_refuses(name: str, change: Callable[[dict[str, Any]], None]) -> None:
    changed = made(name)
    change(changed)
    assert status(changed) in ("invalid", "declined")


@pytest.mark.parametrize(
    "uses",
    [[], [{"id": "a"}], [{"id": "a", "sha256": "0" * 63}], [{"id": "a", "sha256": "G" * 64}], {}, [[]]],
)
def test_uses_are_read_strictly(uses: Any) -> None:
    changed = made("odd")
    changed["statement"]["uses"] = uses
    assert status(changed) == "invalid"
    changed["statement"]["uses"] = [{"id": "another claim", "sha256": "0" * 64}]
    assert status(changed) == "valid"


def test_an_angle_of_other_coordinates_is_another_one():
    changed = made("angle")
    generator = next(g for g in changed["proof"]["generators"] if g.get("function") == "atan2")
    generator["of"].reverse()
    assert status(changed) == "invalid"
    generator["of"].pop()
    assert status(changed) == "invalid"
