"""The picture of a map: what is where is written where it is."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from symctrl.gains import plot
from symctrl.gains.definite import FAILS, HOLDS, OPEN
from tests.gains.samples import answered, crossing, formation


@pytest.fixture
def texts(monkeypatch):
    """The texts of a picture with their places, as parts of its width and height."""
    import matplotlib as mpl

    monkeypatch.setitem(mpl.rcParams, "svg.fonttype", "none")

    def read(found):
        root = ET.fromstring(plot.drawn(found, "svg"))
        return ["".join(one.itertext()) for one in root.iter("{http://www.w3.org/2000/svg}text")]

    return read


def test_a_map_of_two_gains_names_areas_point_and_edge(texts):
    said = texts(answered(crossing(), "a=1/8:3:60", "b=1/8:3:60"))
    assert {"feasible", "infeasible", "the study"} <= set(said)
    assert "undecided" not in said  # there is no room for the word on a line


def test_a_map_of_one_gain_is_a_strip_with_its_edges_as_numbers(texts):
    found = answered(formation(), "beta=1/10:1:9")
    said = texts(found)
    assert {"feasible", "infeasible", "the study", "0.4–0.5"} <= set(said)
    width, height = (
        float(re.search(f'{name}="([0-9.]+)pt"', plot.drawn(found, "svg").decode()).group(1))
        for name in ("width", "height")
    )
    assert width > 4 * height


def test_a_point_outside_is_not_drawn(texts):
    assert "the study" not in texts(answered(crossing(), "a=3:4:60", "b=1/8:3:60"))


def test_a_state_that_is_everywhere_is_named(texts):
    assert "feasible" in texts(answered(crossing(), "a=2:3:10", "b=1:2:10"))


@pytest.mark.parametrize(("form", "magic"), [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")])
def test_the_same_map_is_the_same_file(form, magic):
    found = answered(crossing(), "a=1/8:3:60", "b=1/8:3:60")
    content = plot.drawn(found, form)
    assert content.startswith(magic)
    assert plot.drawn(found, form) == content


def test_of_many_cells_a_group_that_is_not_alike_is_undecided():
    states = np.full((8, 8), HOLDS, np.int8)
    states[0, 0], states[7, 4:] = OPEN, FAILS
    thinned = plot.thinned(states, 4)
    assert thinned.shape == (4, 4)
    assert (thinned[0, 0], thinned[0, 1], thinned[3, 3]) == (OPEN, HOLDS, OPEN)


def test_names_are_set_as_mathematics():
    assert plot._formula("K_o = 4*beta^2") == r"$K_{o} = 4\,\beta^{2}$"
    assert plot._letter("beta") == r"$\beta$"
    assert plot._letter("k[1]") == "k[1]"
    assert plot.title(answered(crossing())) == "crossing     edge: $b = a^{2}$,  $a = 1/b$"
    assert plot.title(answered(formation("star:4"))).startswith("formation on star:4     edge: ")
