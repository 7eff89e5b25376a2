"""Polynomials in the kernel: what it accepts is true, however a certificate is altered."""

from __future__ import annotations

import json
from fractions import Fraction
from itertools import product
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from symctrl.kernel import sos
from symctrl.kernel.certificate import Declined
from symctrl.kernel.check import check_text
from tests.arena.polynomials import GOOD, case, of_form, part, sealed, square, squares
from tests.kernel.certificates import Json
from tests.kernel.test_mutations import WORDS, alterations

STEPS = [Fraction(a, b) for a in range(-9, 10) for b in (1, 2, 5)]


def answer(certificate: Any) -> Any:
    return check_text(json.dumps(certificate))


def at(table: Any, point: Any) -> Fraction:
    total = Fraction(0)
    for c, flat in table:
        value = Fraction(c)
        for v, e in zip(flat[::2], flat[1::2], strict=True):
            value *= point[v] ** e
        total += value
    return total


def is_true(certificate: Json) -> bool:
    """Is what a valid certificate states so, as far as many points of a grid can say?"""
    s = certificate["statement"]
    refuted = certificate["proof"]["kind"] == "witness"
    found = False
    names = s["variables"]
    points = list(product(STEPS, repeat=min(len(names), 2)))
    points = [(*point, *[Fraction(0)] * (len(names) - 2)) for point in points]
    if refuted:
        points.append(tuple(Fraction(certificate["proof"]["values"][name]) for name in names))
    for point in points:
        if any(at(g, point) < 0 for g in s["nonnegative"]) or any(at(h, point) != 0 for h in s["zero"]):
            continue
        value = at(s["polynomial"], point)
        found |= value < 0 or (value == 0 and s["claim"] == "positive")
    return found == refuted


@pytest.mark.parametrize("name", GOOD)
def test_an_altered_certificate_is_refused_or_right(name):
    certificate = GOOD[name]
    assert is_true(certificate)

    @settings(max_examples=100, deadline=None, database=None, suppress_health_check=list(HealthCheck))
    @given(alterations(certificate))
    def check(altered):
        path, other = altered
        if other == certificate:
            return
        assert answer(other).status != "valid"
        try:
            again = sealed(other)
        except (KeyError, TypeError, AttributeError):
            return
        if path[-1] not in WORDS and answer(again).status == "valid":
            assert is_true(again)

    check()


def test_what_is_printed():
    text = answer(GOOD["polynomial_on_a_disc"]).statement
    assert "1 - x^2 >= 0 for all real x, y with what is given" in text
    assert "given: 1 - x^2 >= 0" in text
    assert "it is false that x >= 0" in answer(GOOD["polynomial_witness_on_a_disc"]).statement


@settings(max_examples=200, deadline=None, database=None)
@given(st.lists(st.lists(st.integers(-(10**6), 10**6), min_size=4, max_size=4), min_size=4, max_size=4))
def test_dominance_is_that_of_the_matrix(entries):
    """Against plain arithmetic: t G - L L' row by row."""
    lower = [row[: i + 1] for i, row in enumerate(entries)]
    gram = [[a * b for b in entries[0][: i + 1]] for i, a in enumerate(entries[1])]
    for i in range(4):
        gram[i][i] = abs(gram[i][i]) + sum(map(abs, entries[2])) * 10**7 * (entries[3][0] % 2)
    t = 1 + abs(entries[3][1])
    full = [[gram[max(i, j)][min(i, j)] for j in range(4)] for i in range(4)]
    square_ = [
        [sum(a * b for a, b in zip(lower[i], lower[j], strict=False)) for j in range(4)] for i in range(4)
    ]
    rest = [[t * a - b for a, b in zip(*rows, strict=True)] for rows in zip(full, square_, strict=True)]
    wanted = all(row[i] >= sum(map(abs, row)) - abs(row[i]) for i, row in enumerate(rest))
    assert sos._dominant(gram, lower, t, "here") == wanted


def test_work_is_bounded_before_it_is_done():
    many = [[1, [0, k + 1, 1, 900 - k]] for k in range(800)]
    large = squares(*[square(many) for _ in range(90)])
    assert answer(case(large)).status == "declined"
    wide = part(gram=[[10**3900], [0, 10**3900]], lower=[[10**3900], [0, 1]])
    assert answer(case(squares(wide))).status in ("declined", "invalid")
    assert answer(of_form(scale=10**3900)).status == "valid"
    with pytest.raises(Declined):
        sos._dominant([[1] * (k + 1) for k in range(1400)], [[10**30] * (k + 1) for k in range(1400)], 1, "")
