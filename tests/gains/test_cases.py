"""What the graph decides and what a designer may choose: for all of the one, for some of the other."""

from dataclasses import replace
from fractions import Fraction

import networkx as nx
import pytest

from symctrl import Study, claim, positive_definite, tends
from symctrl.gains.definite import FAILS, HOLDS, OPEN
from symctrl.vectors import diagonal
from tests.gains.samples import answered, formation


def coupled(default="ring:6"):
    """A fleet whose theorem assumes a bound of the graph's eigenvalues, and a constant of choice."""
    study = Study("coupled")
    fleet = study.fleet(default=default)
    i, j = fleet.node, fleet.neighbour
    x, u = fleet.state("x"), fleet.input("u")
    K, beta = study.gain("K", "2"), study.gain("beta", "3/10")
    bound, c = study.gain("Lambda"), study.gain("c")
    fleet.motion(x, lambda i: u[i])

    @study.law("law", u)
    def feedback(i):
        return -K * x[i] - beta * fleet.sum(j, x[i] - x[j])

    squares = fleet.sum(i, x[i] ** 2)

    @study.claimed("theorem")
    def vanishes():
        """All x tend to zero."""
        given = [beta * bound <= K, c < 1, fleet.eigenvalues_at_most(bound)]
        return claim(given=given, then=[tends(x[i])])

    @study.argument(vanishes)
    def by_barbalat(run):
        run.falls(squares / 2, by=K * squares)
        run.bounded(x[i], by=squares / 2, least="1/2")
        run.exists()
        run.barbalat(x[i], of=K * squares, least=K)

    return study


def states(found):
    return {one.condition.id: one.state for one in found.conditions}


def graph(*edges, nodes=()):
    made = nx.Graph(name="drawn")
    made.add_nodes_from(nodes)
    made.add_edges_from(edges)
    return made


# A condition on eigenvalues holds for all of them


@pytest.mark.parametrize(("spec", "top"), [("ring:6", 4), ("path:2", 2), ("star:5", 5), ("complete:7", 7)])
def test_the_largest_eigenvalue_decides(spec, top):
    """k = 2 > beta times the largest."""
    for beta, expected in ((f"{2 * top - 1}/{top * top}", HOLDS), (f"2/{top}", FAILS)):
        study = formation(spec).at(values={"beta": beta})
        assert states(answered(study))["stiff"] == expected


def test_zero_is_an_eigenvalue_of_every_graph():
    study = Study("zero")
    k, fleet = study.gain("k", "2"), study.fleet(default="complete:4")

    @study.condition("1")
    def beyond():
        """It fails at the eigenvalue zero alone."""
        return k * fleet.eigenvalue > 0

    found = answered(study)
    assert found.verdict == "infeasible"
    assert found.conditions[0].witness == {"k": "2", "eigenvalue": "0"}


def test_between_the_bounds_of_an_eigenvalue_nothing_is_claimed():
    """That of a path of 7 is irrational; the gains put the condition's zero between its bounds."""
    found = answered(formation("path:7"))
    middle = (found.spectrum.low + found.spectrum.high) / 2
    study = formation("path:7").at(values={"beta": str(2 / middle)})
    found = answered(study)  # the bounds are made so that this number is on one side
    assert states(found)["stiff"] in (HOLDS, FAILS)
    low, high = found.spectrum.low, found.spectrum.high
    assert (2 / middle <= 2 / high) == (states(found)["stiff"] == HOLDS) or middle in (low, high)


@pytest.mark.parametrize(
    ("beta", "stiff", "theorem"),
    [
        ("1/3", HOLDS, HOLDS),  # 2 > 4 beta
        ("1/2", OPEN, HOLDS),  # 2 = 4 beta: weak at the theorem's bound, which 4 is in any case
        ("4/7", OPEN, OPEN),  # 3 beta < 2 < 4 beta
        ("2/3", FAILS, OPEN),  # 2 = 3 beta
        ("7/10", FAILS, FAILS),  # 2 < 3 beta
    ],
)
def test_of_an_eigenvalue_between_3_and_4_nothing_is_claimed_in_between(beta, stiff, theorem, monkeypatch):
    from symctrl.gains.answer import Asked
    from symctrl.spectral.bracket import extreme_eigenvalue

    def wide(_):
        return replace(extreme_eigenvalue(nx.path_graph(4)), low=Fraction(3), high=Fraction(4))

    monkeypatch.setattr(Asked, "bracket", wide)
    assert states(answered(formation().at(values={"beta": beta})))["stiff"] == stiff
    assert states(answered(coupled().at(values={"beta": beta})))["vanishes/1"] == theorem


def test_the_margin_of_a_matrix_is_one_for_all_eigenvalues():
    study = Study("matrix")
    k, fleet = study.gain("k", "2"), study.fleet(default="ring:6")

    @study.condition("1")
    def definite():
        """The smallest eigenvalue is k - 3/10 lambda, least at lambda = 4."""
        return positive_definite(diagonal(k - "3/10" * fleet.eigenvalue, k))

    assert answered(study).conditions[0].margin == Fraction(4, 5)


@pytest.mark.parametrize(("spec", "least", "most"), [("star:5", 1, 4), ("path:5", 1, 2), ("ring:5", 2, 2)])
def test_every_number_of_neighbours_is_a_case(spec, least, most):
    study = Study("degrees")
    k, fleet = study.gain("k", "3"), study.fleet(default=spec)

    @study.condition("1")
    def below(i):
        """It fails where there are most neighbours."""
        return k > fleet.degree(i)

    @study.condition("2")
    def above(i):
        """It fails where there are fewest."""
        return k * fleet.degree(i) > 3

    found = states(answered(study))
    assert found["below"] == (HOLDS if most < 3 else FAILS)
    assert found["above"] == (HOLDS if 3 * least > 3 else FAILS)


def test_the_witness_names_the_number_of_neighbours_at_which_it_fails():
    study = Study("degrees")
    k, fleet = study.gain("k", "3"), study.fleet(default="star:5")

    @study.condition("1")
    def above(i):
        """It fails at the ends of the star."""
        return k * fleet.degree(i) > 3

    assert answered(study).conditions[0].witness == {"k": "3", "neighbours of i": "1"}


@pytest.mark.parametrize("drawn", [graph(nodes=["a"]), graph(nodes=["a", "b", "c"]), "path:1"])
def test_a_graph_without_edges_divides_by_no_neighbours(drawn):
    study = Study("lonely")
    k, fleet = study.gain("k", "3"), study.fleet()

    @study.condition("1")
    def shared(i):
        """Each neighbour has its share."""
        return k / fleet.degree(i) > 1

    @study.condition("2")
    def stiff():
        """The only eigenvalue is zero."""
        return k - fleet.eigenvalue > 0

    from symctrl.graphs import parse

    found = answered(study.at(graph=parse(drawn) if isinstance(drawn, str) else drawn), "k=1:2:4")
    assert states(found) == {"shared": OPEN, "stiff": HOLDS, "positive": HOLDS}
    assert found.verdict == "undecided"
    assert found.map.cells == ["uuuu"]


# The bound of the eigenvalues that a theorem assumes


def test_a_bound_that_a_theorem_assumes_is_the_largest_eigenvalue():
    found = answered(coupled())
    assert (found.verdict, found.boundary) == ("feasible", "K = 4*beta")
    assert found.chosen["Lambda"] == 4
    assert answered(coupled().at(values={"beta": "51/100"})).verdict == "infeasible"
    assert answered(coupled().at(values={"beta": "1/2"})).verdict == "feasible"


def test_a_bound_that_is_set_must_be_one():
    assert answered(coupled().at(values={"Lambda": "5"})).verdict == "feasible"
    found = answered(coupled().at(values={"Lambda": "39/10"}))
    assert (found.verdict, found.chosen.get("Lambda")) == ("infeasible", None)
    assert states(found)["vanishes/3"] == FAILS
    assert answered(coupled().at(values={"Lambda": "7"})).verdict == "infeasible"  # K < beta Lambda


def test_a_bound_that_is_swept_is_one_from_the_largest_eigenvalue_on():
    cells = answered(coupled(), "Lambda=1:9:16").map.cells[0]  # 4 <= Lambda <= 20/3
    assert cells == "iiiii" + "u" + "fffff" + "u" + "iiii"


# Gains without a value: there are some


def test_a_gain_without_a_value_is_chosen():
    found = answered(coupled())
    assert 0 < found.chosen["c"] < 1
    assert "c" not in found.gains


def test_a_gain_that_is_set_is_not_chosen():
    found = answered(coupled().at(values={"c": "3/2"}))
    assert (found.verdict, found.chosen.get("c")) == ("infeasible", None)


def test_a_gain_without_a_value_is_swept_as_it_is_and_not_as_it_was_chosen():
    assert answered(coupled(), "c=1/4:9/4:8").map.cells == ["ff" + "u" + "iiiii"]  # c = 1 is an edge


def test_no_choice_helps_where_all_fail():
    study = Study("choice")
    a, c = study.gain("a", "2"), study.gain("c")

    @study.condition("1")
    def either():
        """No positive c does it."""
        return -a - c >= 0

    @study.condition("2")
    def far():
        """A large c does it."""
        return c > 10**6 * a

    found = answered(study)
    assert (found.verdict, states(found)["either"], states(found)["far"]) == ("infeasible", FAILS, OPEN)
    assert found.conditions[1].reason.startswith("it does not hold with the c that was chosen")


# Which graphs a theorem is about


def two_pairs():
    return graph(("a", "b"), ("c", "d"))


def test_a_theorem_on_a_fleet_says_nothing_of_a_graph_in_two_parts():
    found = answered(coupled().at(graph=two_pairs()), "K=1:2:4")
    assert (found.verdict, found.margin, found.map.cells) == ("infeasible", None, ["iiii"])
    assert states(found)["vanishes/graph"] == FAILS


def test_nor_of_a_single_node():
    assert answered(coupled("path:1")).verdict == "infeasible"
    assert answered(coupled("path:2")).verdict == "feasible"


def test_conditions_alone_are_decided_on_every_graph():
    assert answered(formation().at(graph=two_pairs())).verdict == "feasible"
