"""Admissible points: every assumption holds exactly at every point drawn."""

from itertools import islice

import pytest

from symctrl import Study, equal
from symctrl.decide.definiteness import decide_matrix
from symctrl.decide.place import SMALL_GRAPHS
from symctrl.decide.points import admissible, points
from symctrl.decide.solve import NoPoint
from symctrl.vectors import absolute, sqrt
from tests.decide.problems import body, problem

COUNT = 12


def drawn(made, seed=1):
    return list(islice(points(made, seed), COUNT))


def test_a_unit_quaternion_has_norm_one():
    study, q, _ = body()
    made = problem(study, equal(q.scalar, q.scalar + q.vector[0]))
    for place in drawn(made):
        assert sum(place.values[f"q[{k}]"] ** 2 for k in (1, 2, 3)) + place.values["q0"] ** 2 == 1
    assert len({tuple(place.values.items()) for place in drawn(made)}) > COUNT // 2


def test_points_move_unless_only_rest_is_admissible():
    # At rest the false closed loop of a law holds: a first look that sees rest alone refutes nothing.
    study, q, w = body()
    speeds = ("w[1]", "w[2]", "w[3]")
    moving = problem(study, equal(w[0] + w[1] + w[2], 0))
    assert all(any(place.values[speed] for speed in speeds) for place in drawn(moving))
    still = absolute(w[0]) + absolute(w[1]) + absolute(w[2]) <= 0
    resting = problem(study, equal(w[0], q.scalar), still, q.scalar > 0)
    for place in drawn(resting):
        assert place.values["q0"] > 0
        assert not any(place.values[speed] for speed in speeds)


def test_a_linear_relation_is_solved():
    study = Study("s")
    x, y, z = (study.parameter(name) for name in "xyz")
    made = problem(study, equal(x, y + z), equal(x * z + 2 * y, 1), z > 0)
    for place in drawn(made):
        v = place.values
        assert v["x"] * v["z"] + 2 * v["y"] == 1
        assert v["z"] > 0


def test_a_definite_matrix_is_symmetric_and_definite():
    study = Study("s")
    J, w = study.inertia("J"), study.state("w", 3)
    made = problem(study, (w.T @ J @ w) >= 0)
    for place in drawn(made):
        entry = lambda r, c: place.values.get(f"J[{r},{c}]", place.values.get(f"J[{c},{r}]"))  # noqa: B023, E731
        rows = [[entry(r, c) for c in (1, 2, 3)] for r in (1, 2, 3)]
        assert decide_matrix(rows).definiteness == "positive definite"


def test_a_bounded_signal_lies_within_its_bound():
    study = Study("s")
    bound = study.parameter("b", low="0")
    d = study.disturbance("d", 2, bound=bound)
    made = problem(study, d[0] + d[1] <= bound)
    for place in drawn(made):
        assert all(abs(place.values[f"d[{k}]"]) <= place.values["b"] for k in (1, 2))


def test_roots_are_rational_at_enough_points():
    study = Study("s")
    x, y = study.parameter("x"), study.parameter("y")
    made = problem(study, equal(sqrt(x) * absolute(y), y), x >= 0)
    assert all(place.values["x"] >= 0 for place in drawn(made))


def test_nodes_of_a_fleet_have_values_of_their_own():
    study = Study("s")
    fleet = study.fleet()
    x = fleet.state("x", 2)
    made = problem(study, equal(x[fleet.node], 2 * x[fleet.node]))
    graphs = {place.edges for place in drawn(made)}
    assert graphs == set(SMALL_GRAPHS)
    for place in drawn(made):
        assert {name.split(".")[1][0] for name in place.values} == set(place.neighbours)


def test_the_points_are_the_same_again_and_others_with_another_seed():
    study, q, w = body()
    made = problem(study, equal(q.vector, w))
    assert drawn(made) == drawn(made)
    assert drawn(made) != drawn(made, seed=2)


def test_all_points_are_admissible():
    study, q, w = body()
    made = problem(study, equal(q.vector, w), w[0] > w[1], q.scalar > 0)
    assert all(admissible(made, place) is None for place in drawn(made))


def test_where_nothing_is_admissible_the_assumption_is_named():
    study = Study("s")
    x = study.parameter("x")
    with pytest.raises(NoPoint, match="x"):
        drawn(problem(study, equal(x, 1), x > 1, x < 0))
