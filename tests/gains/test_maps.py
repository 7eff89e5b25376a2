"""What a map says of a cell is true of every point of it: decided here by independent exact code."""

import random
from fractions import Fraction

import pytest

from symctrl import Study, positive_definite, positive_semidefinite
from symctrl.vectors import diagonal
from tests.gains.samples import (
    answered,
    corners,
    crossing,
    crossing_holds,
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

POINTS = 20_000


def formation_holds(k, beta, low=Fraction(2), high=Fraction(4)):
    """On a ring of six: the eigenvalues reach from 0 to 4, every node has two neighbours."""
    return k > 0 and beta > 0 and k > beta * high and k * k >= beta * low


def points(axes, count, seed=1):
    """Random points of the map, and for each the cells that contain it: a point on an edge is in several."""
    generator, edges = random.Random(seed), corners(axes)
    for _ in range(count):
        point, cells = [], []
        for axis, known in zip(axes, edges, strict=True):
            k = generator.randrange(axis.count)
            t = Fraction(generator.choice((0, 1, generator.randrange(1, 1000) * Fraction(1, 1000))))
            point.append(known[k] + (known[k + 1] - known[k]) * t)
            inside = [k] + [k - 1] * (t == 0 and k > 0) + [k + 1] * (t == 1 and k + 1 < axis.count)
            cells.append(inside)
        yield point, [(x, y) for y in cells[1] for x in cells[0]]


MAPS = [
    (crossing, crossing_holds, "a=1/8:3:97", "b=1/8:3:101", POINTS),
    (crossing, crossing_holds, "a=-1:3:64", "b=-1/2:3:64", POINTS),
    (rational, rational_holds, "a=1/10:5:120", "b=1/10:4:90", POINTS),
    (rational, rational_holds, "a=1:5:64", "b=0:4:64", POINTS),
    (matrix, matrix_holds, "a=1/10:3:80", "b=1/10:2:80", 3000),
    (kinks, kinks_holds, "a=0:4:100", "b=0:3:100", POINTS),
    (powers, powers_holds, "a=1/10:2:100", "b=1/10:2:100", POINTS),
    (formation, formation_holds, "k=0:4:100", "beta=0:1:80", POINTS),
]


@pytest.mark.parametrize(("build", "holds", "first", "second", "count"), MAPS)
def test_random_points_agree_with_their_cells(build, holds, first, second, count):
    made = answered(build(), first, second).map
    letters = made.cells
    seen = {"f": 0, "i": 0, "u": 0}
    for point, cells in points(made.axes, count):
        truth = holds(*point)
        for x, y in cells:
            letter = letters[y][x]
            seen[letter] += 1
            assert letter == "u" or (letter == "f") == truth, (point, letter)
    assert min(seen["f"], seen["i"]) > count // 50


@pytest.mark.parametrize(("build", "holds", "first", "second", "count"), MAPS)
def test_only_cells_near_the_boundary_are_undecided(build, holds, first, second, count):
    """At most three times as many as have corners that differ, and a row or column where something is
    undefined.
    """
    made = answered(build(), first, second).map
    edges = corners(made.axes)
    at = [[holds(x, y) for x in edges[0]] for y in edges[1]]
    crossed = sum(
        len({at[y][x], at[y][x + 1], at[y + 1][x], at[y + 1][x + 1]}) > 1
        for y in range(made.axes[1].count)
        for x in range(made.axes[0].count)
    )
    undecided = sum(row.count("u") for row in made.cells)
    assert crossed / 2 <= undecided <= 3 * crossed + 2 * max(axis.count for axis in made.axes)


def test_the_map_has_a_row_for_each_cell_of_the_second_gain():
    made = answered(crossing(), "a=1:2:7", "b=1/2:3:11").map
    assert (len(made.cells), {len(row) for row in made.cells}) == (11, {7})
    assert made.cells[2][-1] == "f"  # a large, b small
    assert made.cells[-1][0] == "i"


@pytest.mark.parametrize("count", [2, 3, 511, 512, 513, 1300])
def test_counts_that_are_no_powers_of_two_are_filled_to_the_last_cell(count):
    made = answered(crossing(), f"a=1/8:3:{count}", "b=1/8:3:3").map
    one = made.cells[1]
    edges = corners(made.axes)
    for k in {0, 1, count // 2, count - 2, count - 1}:
        middle = (edges[0][k] + edges[0][k + 1]) / 2
        assert one[k] in "u" + "if"[crossing_holds(middle, (edges[1][1] + edges[1][2]) / 2)]
    assert len(one) == count


def test_a_map_of_one_gain_is_one_row():
    made = answered(crossing(), "a=1/2:4:70").map
    assert len(made.cells) == 1
    assert made.cells[0] == "i" * 10 + "u" + "f" * 59  # b = 1: a > 1, and a = 1 is an edge


# Cells are closed: the edge of a cell belongs to it


def test_a_cell_that_touches_a_strict_bound_from_outside_is_infeasible():
    cells = answered(formation("ring:6"), "beta=1/10:1:9").map.cells[0]  # k = 2: beta < 1/2
    assert cells == "fff" + "u" + "iiiii"  # the cell up to 1/2 has its edge, the one from 1/2 on has no other


def test_a_cell_that_touches_a_weak_bound_from_inside_is_feasible():
    cells = answered(crossing(), "b=1/10:1:9").map.cells[0]  # a = 2: b >= 1/2
    assert cells == "iii" + "u" + "fffff"


def test_touching_is_decided_exactly_where_no_edge_is_a_floating_point_number():
    """b = 1/a with a = 3: the edge b = 1/3 is that of cell 10 of 30."""
    study = crossing().at(values={"a": "3"})
    assert answered(study, "b=0:1:30").map.cells[0] == "i" * 9 + "u" + "f" * 20


def test_a_diagonal_through_corners_is_decided_on_both_sides():
    """Below a + b = 4 all cells are feasible, above all are infeasible but those that touch it."""
    from tests.gains.samples import decaying

    made = answered(decaying(), "a=3:4:10", "b=1/10:1:9").map
    for y, row in enumerate(made.cells):
        for x, letter in enumerate(row):
            last = Fraction(3) + Fraction(x + 1, 10) + Fraction(1, 10) + Fraction(y + 1, 10)
            first = last - Fraction(2, 10)
            assert letter == ("f" if last <= 4 else "i" if first > 4 else "u")


def test_a_map_is_the_same_however_it_is_cut(monkeypatch):
    from symctrl.gains import maps

    whole = answered(matrix(), "a=1/10:3:70", "b=1/10:2:50").map.cells
    monkeypatch.setattr(maps, "LARGEST_BLOCK", 8)
    monkeypatch.setattr(maps, "AT_ONCE", 100)
    monkeypatch.setattr(maps, "MOST_OPEN", 500)
    assert answered(matrix(), "a=1/10:3:70", "b=1/10:2:50").map.cells == whole


def test_an_equation_holds_nowhere_in_a_cell_and_fails_off_its_line():
    from symctrl import equal
    from tests.gains.samples import conditions

    def tied(a, b):
        return equal(a, 2 * b)

    made = answered(conditions("tied", {"a": "2", "b": "1"}, tied), "a=1:3:20", "b=1:3:20").map
    for point, cells in points(made.axes, 2000):
        for x, y in cells:
            assert made.cells[y][x] in ("u" if point[0] == 2 * point[1] else "iu")
    assert "f" not in "".join(made.cells)


def test_what_is_not_zero_is_undecided_only_at_its_zeros():
    from symctrl import nonzero
    from tests.gains.samples import conditions

    def apart(a):
        return nonzero(a - 2)

    cells = answered(conditions("apart", {"a": "1"}, apart), "a=1:3:10").map.cells[0]
    assert cells == "ffff" + "uu" + "ffff"


@pytest.mark.parametrize(
    ("bound", "sweep", "cells"),
    [
        (lambda m: m <= 0, "m=-1:1e-400:2", "fu"),
        (lambda m: m >= 0, "m=-1e-400:1:2", "uf"),
        (lambda m: m < 0, "m=-1:-1e-400:2", "ff"),
    ],
)
def test_an_edge_that_no_floating_point_number_is_stays_inside_its_cell(bound, sweep, cells):
    """The cell reaches beyond zero, or ends before it, by less than the smallest number of floating point."""
    assert answered(of_parameter(bound), sweep).map.cells == [cells]


@pytest.mark.parametrize(("form", "cells"), [(positive_definite, "iiuf"), (positive_semidefinite, "iuuf")])
def test_a_matrix_is_decided_at_the_edge_where_it_is_singular(form, cells):
    """diag(m, 1) at m = 0, the edge of the second and of the third cell; semidefinite is shown by pivots that
    are positive, so that its third cell is open.
    """
    found = answered(of_parameter(lambda m: form(diagonal(m, 1))), "m=-1:1:4").map.cells[0]
    assert found == cells


def of_parameter(function):
    """A study with one condition on a parameter, which may be negative."""
    study = Study("parameter")
    m = study.parameter("m", "1")

    @study.condition("1")
    def asked():
        """It holds."""
        return function(m)

    return study


def test_a_condition_that_stands_still_and_is_open_leaves_no_cell_feasible():
    from tests.gains.samples import conditions

    def moving(a, b):
        return a > 1

    def still(a, b):
        return 1 / (b - 1) > 0

    cells = answered(conditions("still", {"a": "2", "b": "1"}, moving, still), "a=0:2:4").map.cells
    assert cells == ["iiuu"]
