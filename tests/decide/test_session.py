"""Sessions: assumptions become relations and known signs, and what is learnt ends."""

import math

import pytest

from symctrl import Study, equal
from symctrl.decide.session import MAX_RESTARTS, exactly
from symctrl.domains.domain import Unsupported
from symctrl.domains.opaque import Refine
from symctrl.vectors import power, sin, sqrt
from tests.decide.problems import body, problem


def test_a_relation_of_the_state_is_known_at_the_node():
    study, q, _ = body()
    made = problem(study, equal(q.vector.T @ q.vector, 1 - q.scalar**2))
    assert exactly(made, lambda s: all(s.domain.is_zero(s.domain.sub_(*s.claim())) for _ in "1"))
    assert exactly(made, lambda s: [a.text for a, _ in s.zeros]) != []


def test_signs_of_assumptions_are_known():
    study = Study("s")
    x, y = study.parameter("x"), study.parameter("y")
    made = problem(study, equal(x, y), x > 0, x - y >= 0)

    def look(session):
        a, b = (session.free(name)[()] for name in ("x", "y"))
        return session.domain.signs.of(a), session.domain.signs.of(b), session.domain.signs.of(a - b)

    assert exactly(made, look) == ("positive", None, "nonnegative")


def test_finer_roots_and_angles_are_found_by_starting_again():
    study = Study("s")
    x = study.parameter("x", low="0")
    rooted = sum((power(x, f"1/{n}") for n in range(2, 8)), sqrt(x))
    turned = sum((sin(x / n) for n in range(2, 6)), rooted)
    made = problem(study, equal(turned - turned, 0))
    starts = []

    def count(session):
        starts.append(1)
        return all(session.domain.is_zero(v) for v in session.claim())

    assert exactly(made, count)
    assert len(starts) < MAX_RESTARTS


def test_more_generators_than_expected_are_found_by_starting_again():
    study = Study("s")
    x = study.parameter("x", low="0")
    product = math.prod((2, 3, 5, 7, 11, 13, 17, 19))  # one root for each prime
    made = problem(study, equal(sqrt(product * x) ** 2, product * x))
    sizes = []

    def look(session):
        sizes.append(session.domain.field.size)
        return session.domain.is_zero(session.domain.sub_(*session.claim()))

    assert exactly(made, look)
    assert len(sizes) > 1
    assert sizes == sorted(set(sizes))


def test_an_evaluation_that_always_starts_again_ends():
    study = Study("s")
    x = study.parameter("x")

    def never(session):
        raise Refine

    with pytest.raises(Unsupported, match="finer"):
        exactly(problem(study, equal(x, x)), never)
