"""`symctrl report`: which files it writes, and what it says of bad input."""

import json
import os
from pathlib import Path

import pytest

from symctrl import files
from symctrl.report import shelf
from tests.report.markup import faults
from tests.samples import refused

STUDY = '''"""{title}"""
from symctrl import Study, equal
study = Study("{name}", source="own design")
x = study.state("x")

@study.claimed("a")
def same():
    "x is x."
    return equal(x + x, 2 * x)
'''


@pytest.fixture
def put(tmp_path):
    def put(name, title="A study."):
        (tmp_path / f"{name}.py").write_text(STUDY.format(name=name, title=title))
        return f"{name}.py"

    return put


def test_a_page_and_an_index_are_written(run, put, tmp_path):
    code, out, err = run("report", put("own", "A <study> & more."))
    assert (code, err) == (0, "")
    assert out == "wrote reports/own.html\nwrote reports/index.html\n"
    page, index = ((tmp_path / "reports" / name).read_text() for name in ("own.html", "index.html"))
    assert faults(page) == faults(index) == []
    assert "<h1>A &lt;study&gt; &amp; more</h1>" in page
    assert '<a href="own.html">A &lt;study&gt; &amp; more</a>' in index


def test_the_index_is_over_all_pages_in_the_folder(run, put, tmp_path):
    run("report", put("one"), "--out", "pages")
    (tmp_path / "pages" / "foreign.html").write_text('<meta name="symctrl-card" content="{oops">')
    (tmp_path / "pages" / "other.html").write_bytes(b"\xff\xfe")
    run("report", put("two"), "--out", "pages")
    index = (tmp_path / "pages" / "index.html").read_text()
    assert index.index("one.html") < index.index("two.html")
    assert "foreign" not in index
    assert (tmp_path / "pages" / "other.html").read_bytes() == b"\xff\xfe"


def test_the_same_input_gives_the_same_bytes(run, put, tmp_path):
    study = put("own")
    run("report", study)
    first = {path.name: path.read_bytes() for path in (tmp_path / "reports").iterdir()}
    run("report", study)
    assert {path.name: path.read_bytes() for path in (tmp_path / "reports").iterdir()} == first


@pytest.mark.skipif(os.geteuid() == 0, reason="root writes everywhere")
def test_a_folder_without_permission_is_refused(run, put, tmp_path):
    (tmp_path / "closed").mkdir(mode=0o500)
    refused(run("report", put("own"), "--out", "closed"), "closed: is not a folder that can be written")


def test_a_file_in_the_place_of_the_folder_is_refused_before_anything_is_decided(
    run, put, monkeypatch, tmp_path
):
    (tmp_path / "reports").write_text("mine")
    monkeypatch.setattr("symctrl.verify.verify", lambda *_: pytest.fail("was decided"))
    refused(run("report", put("own")), "reports: is not a folder that can be written")
    assert (tmp_path / "reports").read_text() == "mine"


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ([], "report: which study?"),
        (["--all", "x"], "report: give the names of studies or --all, not both"),
        (["nowhere"], "study nowhere: there is none of that name"),
        (["--outt", "x"], "No such option"),
    ],
)
def test_what_cannot_be_meant_is_one_line(run, arguments, says, tmp_path):
    refused(run("report", *arguments), says)
    assert not (tmp_path / "reports").exists()


def test_a_study_that_would_be_the_index_is_refused(run, put, tmp_path):
    refused(run("report", put("index")), "study index: its page would be the index")
    assert not (tmp_path / "reports").exists()


def test_an_interrupt_leaves_no_half_page(run, put, monkeypatch, tmp_path):
    run("report", put("own"))
    before = {path.name: path.read_bytes() for path in (tmp_path / "reports").iterdir()}
    whole = os.replace

    def interrupted(source, target):
        if str(target).endswith("two.html"):
            raise KeyboardInterrupt
        whole(source, target)

    monkeypatch.setattr(files.os, "replace", interrupted)
    code, _, err = run("report", put("two"))
    assert (code, err) == (130, "symctrl: interrupted\n")
    assert {path.name: path.read_bytes() for path in (tmp_path / "reports").iterdir()} == before


def test_what_a_page_says_of_itself_is_read_again():
    entry = shelf.Entry("a.html", "a", 'A "quoted" <title>', "s", "f", {"proved": 1}, {})
    assert shelf.Entry(**json.loads(shelf.card(entry))) == entry
    assert shelf.entries(Path("/nowhere"), [entry]) == (entry,)
