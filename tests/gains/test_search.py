"""Margins and gains that are as good as is found: certified, and close to the best."""

import random
from fractions import Fraction

import pytest

from symctrl.files import InputError
from symctrl.written import StudyError
from tests.gains.samples import (
    answered,
    crossing,
    crossing_holds,
    decaying,
    formation,
    kinks,
    kinks_holds,
    matrix,
    matrix_holds,
    powers,
    powers_holds,
    rational,
    rational_holds,
)
from tests.gains.test_maps import formation_holds

STEP = Fraction(1, 10_000)
STUDIES = [
    (crossing, crossing_holds),
    (rational, rational_holds),
    (matrix, matrix_holds),
    (kinks, kinks_holds),
    (powers, powers_holds),
    (formation, formation_holds),
]


def within(gains, r, generator):
    """Gains within the factors 1 - r and 1 + r, the corners among them."""
    for corner in range(2 ** len(gains)):
        yield [v * (1 + r * (1 if corner >> k & 1 else -1)) for k, v in enumerate(gains)]
    for _ in range(300):
        yield [v * (1 + r * Fraction(generator.randint(-1000, 1000), 1000)) for v in gains]


@pytest.mark.parametrize(("build", "holds"), STUDIES)
def test_all_gains_within_the_margin_are_feasible_and_not_all_beyond(build, holds):
    found = answered(build())
    gains, generator = list(found.gains.values()), random.Random(1)
    assert all(holds(*point) for point in within(gains, found.margin, generator))
    beyond = found.margin + 2 * STEP
    assert not all(holds(*point) for point in within(gains, beyond, generator))


def test_the_margin_is_exact_where_the_edge_is_known():
    """b = a^2 at a = 2 (1 - r), b = 1 + r; a + b = 4 at 3 (1 + r) = 4."""
    assert answered(decaying()).margin == Fraction(3333, 10_000)


def test_a_margin_has_no_end_where_nothing_fails():
    from tests.gains.samples import conditions

    def sure(a):
        return a + 1 > 0

    assert answered(conditions("sure", {"a": "1"}, sure)).margin == 1 - STEP


def test_a_margin_is_one_however_few_parts_are_looked_at(monkeypatch):
    from symctrl.gains import search

    whole = answered(matrix()).margin
    monkeypatch.setattr(search, "MOST_PARTS", 0)
    found = answered(matrix())
    assert 0 < found.margin < whole
    generator = random.Random(5)
    assert all(matrix_holds(*p) for p in within(list(found.gains.values()), found.margin, generator))


def test_gains_that_are_not_feasible_have_no_margin():
    assert answered(crossing().at(values={"b": "5"})).margin is None


@pytest.mark.parametrize(("build", "holds"), STUDIES)
def test_the_largest_margin_is_certified_and_better_than_random_points(build, holds):
    first, second = list(answered(build()).gains)
    found = answered(build(), f"{first}=1/2:4:10", f"{second}=1/10:2:10", maximize="margin")
    best = found.best[1]
    assert set(best.gains) == {first, second}
    assert Fraction(1, 2) <= best.gains[first] <= 4
    assert Fraction(1, 10) <= best.gains[second] <= 2
    assert all(len(str(float(v)).strip("0.").replace(".", "")) <= 6 for v in best.gains.values())
    at_best = answered(build().at(values={name: str(v) for name, v in best.gains.items()}))
    assert at_best.margin == best.objective
    generator = random.Random(2)
    for _ in range(20):  # of ten points each
        at = [
            [
                Fraction(1, 2) + Fraction(generator.randint(0, 3500), 1000),
                Fraction(generator.randint(100, 2000), 1000),
            ]
            for _ in range(10)
        ]
        r = best.objective + Fraction(1, 50)
        assert not any(all(holds(*p) for p in within(point, r, generator)) for point in at)


def test_the_fastest_decay_is_certified_and_no_random_point_decays_faster():
    """The rate is a + b <= 4, for b <= a^2."""
    found = answered(decaying(), "a=1/2:3:10", "b=1/2:3:10", maximize="decay")
    what, best = found.best
    assert what == "decay"
    assert best.objective == sum(best.gains.values()) == 4
    assert best.gains["b"] <= best.gains["a"] ** 2
    generator = random.Random(3)
    for _ in range(200):
        a, b = (Fraction(generator.randint(500, 3000), 1000) for _ in range(2))
        assert not (b <= a * a and a + b <= 4) or a + b <= best.objective


def test_without_a_sweep_gains_between_half_and_twice_their_values_are_tried():
    found = answered(decaying(), maximize="decay").best[1]
    assert 1 <= found.gains["a"] <= 4
    assert Fraction(1, 2) <= found.gains["b"] <= 2
    assert found.objective == found.gains["a"] + found.gains["b"] >= Fraction(396, 100)


def test_where_no_gains_are_feasible_none_are_named():
    best = answered(decaying(), "a=1/10:1/5:10", "b=2:3:10", maximize="decay").best[1]
    assert (best.gains, best.objective) == ({}, None)
    json = answered(crossing(), "a=1/10:1/5:10", maximize="margin").as_json()
    assert json["maximized"] == {"what": "margin", "gains": {}, "value": None}


def test_decay_needs_a_theorem_with_a_rate():
    with pytest.raises(StudyError, match="concludes an exponential bound with a rate"):
        answered(crossing(), maximize="decay")


def test_nothing_is_made_largest_where_no_gain_has_a_value():
    from tests.gains.samples import conditions

    def some(a):
        return a > 1

    with pytest.raises(InputError, match="no gain has a value or a range"):
        answered(conditions("empty", {"a": None}, some), maximize="margin")


def test_the_margin_varies_the_gains_and_leaves_what_is_none():
    from symctrl import Study

    study = Study("plant")
    k, m = study.gain("k", "3"), study.parameter("m", "2")

    @study.condition("1")
    def stiff():
        """k exceeds m."""
        return k > m

    assert answered(study).margin == Fraction(3333, 10_000)
