"""Claims whose truth is known, decided from the author's words to the certificate that the kernel accepts."""

from __future__ import annotations

import json
from typing import Any

import pytest

from symctrl import (
    Study,
    equal,
    equivalent,
    implies,
    nonnegative,
    nonzero,
    positive,
    positive_definite,
    positive_semidefinite,
    skew_symmetric,
    sufficiently_small,
    symmetric,
)
from symctrl.decide.claims import parts, verdict_of
from symctrl.kernel.check import check_text
from symctrl.vectors import (
    absolute,
    cos,
    det,
    exp,
    eye,
    inverse,
    maximum,
    minimum,
    norm,
    power,
    sgn,
    sin,
    skew,
    sqrt,
    tan,
)

study = Study("known", source="claims of known truth")
q = study.unit_quaternion("q")
w, u = study.state("w", 3), study.input("u", 3)
x, y, z = (study.parameter(n) for n in "xyz")
g, k, b, gamma = (study.gain(n) for n in ("g", "k", "b", "gamma"))
J = study.inertia("J")
v, p = study.parameter("v", shape=(3, 1)), study.parameter("p", shape=(3, 1))
s, d = study.state("s"), study.disturbance("d", bound=g)
study.motion(q.vector, (q.scalar * eye(3) + skew(q.vector)) @ w / 2)
study.motion(q.scalar, -q.vector.T @ w / 2)
study.motion(w, inverse(J) @ (u - skew(w) @ J @ w))
study.motion(s, -k * s + d)

R = (q.scalar**2 - q.vector.T @ q.vector) * eye(3) + 2 * q.vector @ q.vector.T - 2 * q.scalar * skew(q.vector)
ENERGY = w.T @ J @ w / 2

fleet = study.fleet("G")
i, j = fleet.node, fleet.neighbour
a, c, h = fleet.state("a"), fleet.state("c", 2), fleet.parameter("h")
fleet.motion(a, lambda node: -fleet.sum(j, a[i] - a[j]))
SQUARES = fleet.sum(i, a[i] ** 2) / 2
EDGES = fleet.sum(i, fleet.sum(j, (a[i] - a[j]) ** 2))

TRUE = [
    equal(R @ R.T, eye(3)),
    equal(det(R), 1),
    equal(skew(v) @ p, -skew(p) @ v),
    equal(skew(R @ v), R @ skew(v) @ R.T),
    equal(study.rate(ENERGY), w.T @ u),
    equal(sqrt(x**2 + 2 * x * y + y**2), absolute(x + y)),
    equal(power(absolute(x), gamma) * absolute(x), power(absolute(x), gamma + 1)),
    equal(study.rate(absolute(s)), sgn(s) * (-k * s + d)),
    equal(
        study.rate(power(absolute(s), gamma + 1)),
        (gamma + 1) * power(absolute(s), gamma) * sgn(s) * (-k * s + d),
    ),
    equal(tan(x), sin(x) / cos(x)),
    equal(cos(3 * x), 4 * cos(x) ** 3 - 3 * cos(x)),
    equal(exp(x) ** 2 * exp(-2 * x), 1),
    equal(x / x, 1),
    equal(minimum(x, y) + maximum(x, y), x + y),
    equal(norm(R @ v), norm(v)),
    nonnegative(x**2 - 2 * x * y + y**2),
    positive(x**2 + 1),
    nonzero(exp(x) + y**2),
    nonzero(-1 - x**2),
    nonzero(det(R)),
    nonnegative(g * x**2 + k * y**2),
    nonnegative(k * absolute(x) - k * x),
    nonnegative(g * absolute(s) - d * s),
    nonnegative(v.T @ v * (p.T @ p) - (v.T @ p) ** 2),
    positive_definite([["2", "1"], ["1", "2"]]),
    positive_semidefinite([["1", "1"], ["1", "1"]]),
    positive_definite(J),
    positive_definite(J + g * eye(3)),
    positive_semidefinite(v @ v.T),
    positive_definite(R.T @ J @ R),
    equivalent(g * k - b**2 > 0, positive_definite([[g, b], [b, k]])),
    sufficiently_small(b, positive_definite([[g, b], [b, k]])),
    sufficiently_small(b, nonnegative(1 - b)),
    sufficiently_small(b, nonzero(1 - b)),
    sufficiently_small(b, positive([1 - b, g - b])),
    sufficiently_small(b, nonnegative(b - b**2)),
    implies(equal(x, y), equal(x**2, y**2)),
    implies([equal(x**2, y**2), x >= 0, y >= 0], equal(x, y)),
    implies(equal(v.T @ v, 0), equal(v, [0, 0, 0])),
    implies([x >= y, y >= z], x >= z),
    implies([x >= 1, y >= 1], x * y >= 1),
    implies(equal(x * y, 1), equal(1 / x, y)),
    symmetric(J),
    skew_symmetric(skew(v)),
    equal(study.rate(fleet.sum(i, a[i])), 0),
    equal(study.rate(SQUARES), -EDGES / 2),
    equal(fleet.sum(i, fleet.sum(j, a[i] ** 3 - a[j] ** 3)), 0),
    equal(fleet.sum(j, a[i] - a[j]), fleet.degree(i) * a[i] - fleet.sum(j, a[j], at=i)),
    equal(fleet.sum(i, fleet.sum(j, a[j], at=i)), fleet.sum(i, fleet.degree(i) * a[i])),
    equal(fleet.sum(j, h[i] * c[j].T @ c[i]), h[i] * c[i].T @ fleet.sum(j, c[j], at=i)),
]

FALSE = [
    nonzero(x**2 - 4 * y),
    nonzero(x),
    implies(x >= 0, nonzero(x)),
    equal(R @ R, eye(3)),
    equal(det(R), "1.000000000000000000000000000001"),
    equal(skew(R @ v), R.T @ skew(v) @ R),
    equal(study.rate(ENERGY), w.T @ u + "1e-20" * w.T @ w),
    equal(sqrt(x**2 + y**2), absolute(x) + absolute(y)),
    equal(sqrt(x**2), x),
    equal(power(absolute(x), gamma) * x, power(absolute(x), gamma + 1)),
    equal(study.rate(power(absolute(s), gamma + 1)), (gamma + 1) * power(absolute(s), gamma) * (-k * s + d)),
    equal(cos(3 * x), 4 * cos(x) ** 3 - 3 * cos(x) + "1e-12"),
    equal(exp(x + y), exp(x) + exp(y)),
    equal(minimum(x, y), x),
    nonnegative(x**2 - "2.0000001" * x * y + y**2),
    positive(x**2),
    positive(g - k),
    nonnegative("0.9" * g * absolute(s) - d * s),
    positive_definite([["1", "1"], ["1", "1"]]),
    positive_semidefinite([["1", "1"], ["1", "0.999999999999999999999999999999"]]),
    positive_definite(J - g * eye(3)),
    positive_definite(v @ v.T),
    equivalent(g * k - 2 * b**2 > 0, positive_definite([[g, b], [b, k]])),
    equivalent(g * k - b**2 / 2 > 0, positive_definite([[g, b], [b, k]])),
    implies(equal(x**2, y**2), equal(x, y)),
    implies([x >= y, z >= y], x >= z),
    implies([x >= 0], x * y >= 0),
    symmetric(R),
    equal(study.rate(SQUARES), -EDGES),
    equal(study.rate(SQUARES), -EDGES * "0.500000000001"),
    equal(fleet.sum(i, fleet.sum(j, a[i] ** 3 + a[j] ** 3)), 0),
    equal(fleet.sum(i, fleet.sum(j, a[j], at=i)), fleet.sum(i, a[i])),
    equal(fleet.sum(j, a[i] * a[j]), fleet.sum(j, a[j] ** 2, at=i)),
    nonnegative(fleet.sum(j, a[i] - a[j])),
]


def decided(claim: Any) -> str:
    verdict = verdict_of(parts(study, claim, "claim"), None)
    if verdict.certificate is not None:
        assert check_text(json.dumps(verdict.certificate)).status == "valid"
    return (
        f"{verdict.outcome.value}: {verdict.reason}" if verdict.certificate is None else verdict.outcome.value
    )


@pytest.mark.parametrize("claim", TRUE, ids=[claim.text()[:60] for claim in TRUE])
def test_what_is_true_is_proved(claim: Any) -> None:
    assert decided(claim) == "proved"


@pytest.mark.parametrize("claim", FALSE, ids=[claim.text()[:60] for claim in FALSE])
def test_what_is_false_is_refuted(claim: Any) -> None:
    assert decided(claim) == "refuted"


def test_a_division_by_what_is_zero_everywhere_is_ill_formed() -> None:
    nowhere = 1 / (q.vector.T @ q.vector + q.scalar**2 - 1)
    assert decided(equal(nowhere, nowhere)).startswith("ill-formed: a division by what is zero")
