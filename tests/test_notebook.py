"""What docs/notebook.ipynb shows is what its cells give, times aside; and how a notebook shows each thing.

The cells are run in order by Python alone: of the last expression of a cell what a notebook would show is
kept. `python tests/test_notebook.py` writes what the cells give now into the notebook.
"""

import ast
import contextlib
import io
import json
import re
import struct
import zlib
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from symctrl import equal, notebook, positive_definite
from symctrl.expr import symbol
from symctrl.gains.plot import COLOURS
from symctrl.verdict import Condition, Outcome, Verdict
from tests.gains.samples import answered, crossing, formation
from tests.samples import row

PAGE = Path(__file__).parents[1] / "docs" / "notebook.ipynb"
SHOWN = {"text/html": "_repr_html_", "text/latex": "_repr_latex_"}


def executed(source, names):
    """The outputs of a cell, in the form of a notebook."""
    tree = ast.parse(source)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "<cell>", "exec"), names)
        value = None if last is None else eval(compile(ast.Expression(last.value), "<cell>", "eval"), names)
    outputs = []
    if printed.getvalue():
        outputs.append({"name": "stdout", "output_type": "stream", "text": lines(printed.getvalue())})
    if value is not None:
        outputs.append({"data": shown(value), "metadata": {}, "output_type": "execute_result"})
    return outputs


def shown(value):
    made = {"text/plain": lines(repr(value))}
    for kind, method in SHOWN.items():
        if hasattr(value, method):
            made[kind] = lines(getattr(value, method)())
    return dict(sorted(made.items()))


def lines(text):
    return text.splitlines(keepends=True)


def run_again():
    """The notebook with the outputs that its cells give now."""
    made = json.loads(PAGE.read_text(encoding="utf-8"))
    names, count = {}, 0
    for cell in made["cells"]:
        if cell["cell_type"] == "code":
            count += 1
            cell["outputs"] = executed("".join(cell["source"]), names)
            cell["execution_count"] = count
            for output in cell["outputs"]:
                if output["output_type"] == "execute_result":
                    output["execution_count"] = count
    return made


def as_text(made):
    return json.dumps(made, indent=1, ensure_ascii=False) + "\n"


def test_the_notebook_shows_what_its_cells_give():
    text = PAGE.read_text(encoding="utf-8")
    without_times = re.compile(r"seconds=\d+(\.\d+)?")
    assert without_times.sub("", as_text(run_again())) == without_times.sub("", text)
    kinds = {
        kind
        for cell in json.loads(text)["cells"]
        for o in cell.get("outputs", ())
        for kind in o.get("data", ())
    }
    assert kinds == {"text/plain", "text/html", "text/latex"}


# What is shown


class Balanced(HTMLParser):
    """Raises where tags do not close each other; gathers the text."""

    def __init__(self, html):
        super().__init__()
        self.open, self.text, self.tags = [], "", []
        self.feed(html)
        assert not self.open

    def handle_starttag(self, tag, attrs):
        self.open.append(tag)
        self.tags.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data


def test_statements_are_formulas():
    a, b = symbol("a"), symbol("b")
    assert equal(a, b)._repr_latex_() == r"$\displaystyle a = b$"
    assert positive_definite(a)._repr_latex_() == r"$\displaystyle a \succ 0$"


def test_a_verdict_says_why_and_where():
    found = Verdict(
        Outcome.REFUTED,
        "left < right",
        conditions=(Condition("nonzero", "m"),),
        witness={"x": "1/2"},
        residual="x < y",
    )
    seen = Balanced(found._repr_html_())
    for text in ("✗ refuted", "left < right", "x = 1/2", "m != 0", r"$\displaystyle x < y$"):
        assert text in seen.text
    assert "certificate" not in repr(found)


def test_a_row_is_a_table_and_its_text_is_escaped():
    seen = Balanced(row("lemma", statement="<b> & c", reason="")._repr_html_())
    assert "lemma: ✓ proved" in seen.text
    assert "<b> & c" in seen.text
    assert "does not stand" in Balanced(row("lemma", stands=False)._repr_html_()).text


def test_gains_are_a_table_and_a_map():
    found = answered(crossing(), "a=1/8:3:40", "b=1/8:3:30")
    seen = Balanced(found._repr_html_())
    for text in ("crossing: feasible at a = 2, b = 1", "✓ holds", "≥ 3", "b = a^2; a = 1/b", "29.28 %"):
        assert text in seen.text
    assert {"svg", "image", "circle"} <= set(seen.tags)
    assert {"feasible", "infeasible", "the study"} <= set(re.findall(r">([^<]+)</text>", found._repr_html_()))
    assert repr(found) == "<gains of crossing: feasible>"


def test_gains_without_a_map_have_no_picture():
    assert "<svg" not in answered(formation())._repr_html_()


def test_the_picture_holds_each_cell_from_below():
    states = np.array([[1, 0, -1], [0, 0, 1]], np.int8)
    content = notebook.png(states, COLOURS)
    width, height = struct.unpack(">II", content[16:24])
    start = content.index(b"IDAT") + 4
    (length,) = struct.unpack(">I", content[start - 8 : start - 4])
    rows = zlib.decompress(content[start : start + length])
    assert (width, height) == (3, 2)
    assert rows == bytes([0, 1, 1, 2, 0, 2, 1, 0])


@pytest.mark.parametrize(("change", "status"), [({}, "valid"), ({"sha256": "0" * 64}, "invalid")])
def test_a_certificate_is_shown_as_the_kernel_sees_it(change, status):
    found = answered(crossing()).conditions[0].certificates[0]
    seen = Balanced(notebook.Certificate({**found, **change})._repr_html_())
    assert f"certificate: {status}" in seen.text


if __name__ == "__main__":
    PAGE.write_text(as_text(run_again()), encoding="utf-8")
