"""Fleets: sums over neighbours and nodes, proved for every graph, and matrices of the graph at hand."""

import itertools
import json
import subprocess

import networkx as nx
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl import Study, equal
from symctrl.graphs import parse
from symctrl.verify import verify
from tests.conftest import SYMCTRL


def graphs():
    """Any graph of up to five nodes, with lone nodes and several parts among them."""
    pairs = list(itertools.combinations("abcde", 2))

    def made(chosen):
        graph = nx.Graph(name="any")
        graph.add_nodes_from("abcde")
        graph.add_edges_from(pair for pair, there in zip(pairs, chosen, strict=True) if there)
        return graph

    return st.lists(st.booleans(), min_size=len(pairs), max_size=len(pairs)).map(made)


@pytest.fixture
def study():
    made = Study("fleet")
    fleet = made.fleet(default="path:3")
    x = fleet.state("x")
    i, j = fleet.node, fleet.neighbour

    @made.claimed("1")
    def handshake():
        """What leaves one node arrives at another."""
        return equal(fleet.sum(i, fleet.sum(j, x[i] - x[j])), 0)

    @made.printed("2")
    def every_node_has_two_neighbours(i):
        """Every node has two neighbours."""
        return equal(fleet.degree(i), 2)

    @made.claimed("3")
    def rows_of_the_laplacian():
        """The rows of the Laplacian sum to zero."""
        ones = [1] * fleet.size
        return equal(fleet.laplacian() @ ones, [0] * fleet.size)

    made.rejected(every_node_has_two_neighbours, "On a path the ends have one.")
    return made


@given(graph=graphs())
@settings(max_examples=12, deadline=None)
def test_a_matrix_is_that_of_the_graph_at_hand(graph):
    study = Study("matrices")
    fleet = study.fleet()

    @study.claimed("1")
    def laplacian():
        """The Laplacian is that of an independent library."""
        wanted = nx.laplacian_matrix(graph).toarray().astype(int).tolist()
        return equal(fleet.laplacian(), wanted)

    @study.claimed("2")
    def adjacency():
        """The adjacency matrix too."""
        return equal(fleet.adjacency(), nx.to_numpy_array(graph).astype(int).tolist())

    report = verify(study.at(graph=graph))
    assert [row.verdict for row in report.rows] == ["proved", "proved"]
    assert report.graph == "any"


def test_what_holds_along_each_edge_holds_for_every_graph(study):
    rows = {row.id: row for row in verify(study).rows}
    assert rows["handshake"].verdict == "proved"
    assert rows["handshake"].holds_for == "all"
    assert rows["rows_of_the_laplacian"].holds_for == "path:3"
    assert rows["every_node_has_two_neighbours"].verdict == "refuted"
    assert rows["every_node_has_two_neighbours"].witness["graph"]


def test_an_instance_is_on_the_graph_of_a_file(study, tmp_path):
    path = tmp_path / "net.txt"
    path.write_text("# a triangle with a tail\na b\nb c\nc a\nc d\ne\n")
    report = verify(study.at(graph=parse(str(path))))
    assert report.graph == "net.txt"
    assert {row.id: row.holds_for for row in report.rows}["rows_of_the_laplacian"] == "net.txt"


def test_the_command_line_takes_the_graph_of_a_file(tmp_path):
    (tmp_path / "net.txt").write_text("a b\nb c\n\nd\n")
    (tmp_path / "own.py").write_text(
        "from symctrl import Study, equal\nstudy = Study('own')\nfleet = study.fleet()\n"
        "@study.claimed('a')\ndef four():\n    'Four nodes.'\n    return equal(fleet.size, 4)\n"
    )

    def answer(*options):
        command = [SYMCTRL, "verify", "own.py", "--json", "-", *options]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        return done.returncode, json.loads(done.stdout)

    code, found = answer("--graph", "net.txt")
    assert (code, found["graph"], found["claims"][0]["verdict"]) == (0, "net.txt", "proved")
    code, found = answer("--graph", "star:5")
    assert (code, found["graph"], found["claims"][0]["verdict"]) == (1, "star:5", "refuted")


def test_what_a_sum_cannot_be_over():
    study = Study("fleet")
    fleet = study.fleet()
    x = fleet.state("x")
    i, j = fleet.node, fleet.neighbour
    with pytest.raises(ValueError, match="sum over j first"):
        fleet.sum(i, x[i] - x[j])
    with pytest.raises(ValueError, match=r"write fleet.sum\(j, .., at=i\)"):
        fleet.sum(j, x[j])
    with pytest.raises(TypeError, match=r"x\[..\] takes a node of the fleet"):
        x[0]
    with pytest.raises(ValueError, match="the rate of an expression at two nodes"):
        study.rate(x[i] - x[j])
