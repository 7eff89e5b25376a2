"""Graphs from a few letters or a file: nothing is guessed, and a file's fault is named by its line."""

import networkx as nx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symctrl import graphs

FAMILIES = {
    "ring": (3, nx.cycle_graph),
    "path": (1, nx.path_graph),
    "star": (2, lambda n: nx.star_graph(n - 1)),
    "complete": (1, nx.complete_graph),
    "tree": (1, lambda n: nx.full_rary_tree(2, n)),
}


@given(st.sampled_from(sorted(FAMILIES)), st.integers(0, 12))
def test_families_are_those_of_networkx_with_nodes_from_1(family, extra):
    least, oracle = FAMILIES[family]
    n = least + extra
    graph = graphs.parse(f"{family}:{n}")
    assert list(graph) == [str(k) for k in range(1, n + 1)]
    assert graph.adj == nx.relabel_nodes(oracle(n), lambda k: str(k + 1)).adj
    assert graphs.name(graph) == f"{family}:{n}"


@pytest.mark.parametrize(
    ("spec", "says"),
    [
        ("ring:2", "ring has at least 3 nodes"),
        ("path:0", "path has at least 1 node"),
        ("star:1", "star has at least 2 nodes"),
        ("ring:", "whole number"),
        ("ring:-3", "whole number"),
        ("ring:3.0", "whole number"),
        ("ring:٣", "whole number"),
        ("ring:" + "9" * 5000, "whole number"),
        ("complete:100000", "more than"),
        ("tree:0", "tree has at least 1 node"),
        ("grid:0x3", "grid has at least 1 row and column"),
        ("grid:9", "rows and columns like 3x4, not '9'"),
        ("grid:3x", "rows and columns"),
        ("grid:3X4", "rows and columns"),
        ("grid:2000x2000", "more than"),
        ("wheel:5", "neither a file nor one of ring:N, path:N, star:N, complete:N, tree:N, grid:RxC"),
        ("ring", "neither a file"),
        ("", "neither a file"),
        (".", "neither a file"),
    ],
)
def test_a_wrong_spec_is_named_in_one_line(spec, says):
    with pytest.raises(graphs.GraphSpecError, match=says) as caught:
        graphs.parse(spec)
    assert "\n" not in str(caught.value)


@given(st.integers(1, 5), st.integers(1, 5))
def test_a_grid_is_that_of_networkx_row_by_row(rows, columns):
    graph = graphs.parse(f"grid:{rows}x{columns}")
    oracle = nx.grid_2d_graph(rows, columns)
    assert list(graph) == [str(k) for k in range(1, rows * columns + 1)]
    names = {(r, c): str(r * columns + c + 1) for r, c in oracle}
    assert graph.adj == nx.relabel_nodes(oracle, names).adj


names = st.from_regex(r"[A-Za-z0-9_]{1,3}", fullmatch=True)


@given(
    st.lists(st.tuples(names, names).filter(lambda e: e[0] != e[1]), max_size=12), st.lists(names, max_size=4)
)
def test_a_file_gives_back_the_graph_written_into_it(tmp_path_factory, edges, alone):
    graph = nx.Graph(edges)
    graph.add_nodes_from(alone)
    if not graph:
        graph.add_node("x")
    path = tmp_path_factory.mktemp("graph") / "fleet.txt"
    once = dict.fromkeys(frozenset(edge) for edge in edges)
    first = [next(edge for edge in edges if frozenset(edge) == key) for key in once]
    lines = ["# a fleet", *(f"  {a}\t{b}  # link" for a, b in first), "", *graph]
    path.write_text("\n".join(lines), encoding="utf-8")
    found = graphs.parse(str(path))
    assert found.adj == graph.adj
    assert list(found) == list(graph)
    assert graphs.name(found) == "fleet.txt"


@pytest.mark.parametrize(
    ("content", "line", "says"),
    [
        ("1 2\n2 2\n", 2, "from 2 to itself"),
        ("1 2\n\n1 2\n", 3, "in line 1 already"),
        ("1 2\n2 1\n", 2, "no direction"),
        ("# one\n1 2 3\n", 2, "3 words"),
        ("a b\na[1] b\n", 2, r"node name 'a\[1\]'"),
        ("q.1\n", 1, "letters, digits"),
        ("# only this\n\n", None, "names no node"),
        ("", None, "names no node"),
    ],
)
def test_a_wrong_file_is_named_with_its_line(tmp_path, content, line, says):
    path = tmp_path / "g.txt"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(graphs.GraphSpecError, match=says) as caught:
        graphs.parse(str(path))
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)
    if line is not None:
        assert f"line {line}:" in str(caught.value)


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ('<?xml version="1.0"?>\n<graphml/>\n', "XML"),
        ('{"nodes": []}\n', "JSON"),
        ("[[1, 2]]\n", "JSON"),
        ("\n# made by hand\n  strict graph {\n1 -- 2\n}\n", "DOT"),
        ('digraph "a"\n{\n', "DOT"),
        ("graph [\n  node [ id 1 ]\n]\n", "GML"),
        ("*Vertices 3\n", "Pajek"),
        ("%%MatrixMarket matrix coordinate\n", "Matrix Market"),
        ("source,target\n1,2\n", "commas"),
        ("1; 2\n", "commas"),
    ],
)
def test_a_file_of_another_format_is_told_which_is_wanted(tmp_path, content, says):
    path = tmp_path / "g.graph"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(graphs.GraphSpecError, match=f'{says}.*two node names a line, like "1 2"') as caught:
        graphs.parse(str(path))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("content", ["graph\na b\n", "graph a\n", "a b # not a, table\n", "Creator\n"])
def test_a_node_may_be_called_like_a_word_of_another_format(tmp_path, content):
    path = tmp_path / "g.txt"
    path.write_text(content, encoding="utf-8")
    assert list(graphs.parse(str(path))) == [
        word for word in ("graph", "a", "b", "Creator") if word in content.split("#")[0].split()
    ]


def test_a_file_that_is_not_text_is_refused(tmp_path):
    path = tmp_path / "g.bin"
    path.write_bytes(b"1 2\n\xff\xfe")
    with pytest.raises(graphs.GraphSpecError, match="not UTF-8 text: byte 5 is 0xff"):
        graphs.parse(str(path))


def test_a_byte_order_mark_is_no_part_of_a_node(tmp_path):
    path = tmp_path / "g.txt"
    path.write_bytes("\ufeff1 2\r\n".encode())
    assert list(graphs.parse(str(path))) == ["1", "2"]


def test_a_file_may_have_a_name_like_a_family(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "wheel:5").write_text("a b", encoding="utf-8")
    assert list(graphs.parse("wheel:5")) == ["a", "b"]


def test_a_graph_without_a_name_is_called_by_its_size():
    assert graphs.name(nx.cycle_graph(4)) == "4 nodes, 4 edges"
