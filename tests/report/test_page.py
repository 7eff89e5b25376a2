"""A page: its HTML, its numbers, and that a block without data is absent."""

import json
import re
from dataclasses import fields, is_dataclass, replace
from html import unescape
from pathlib import Path

import pytest
from markupsafe import Markup as Made

from symctrl.report import build, rendering, shelf
from symctrl.report.names import certificate_size, groups, numbers
from symctrl.report.page import Chip, GainLine, Gains, Link, Page
from tests.report import sample
from tests.report.markup import Markup, faults

LARGEST = 400_000
COMMITTED = sorted((Path(__file__).parents[2] / "reports").glob("*.html"))


def html(page):
    return rendering.page(page, shelf.card(shelf.entry(page, "spring.html")))


@pytest.fixture(scope="module")
def text():
    return html(sample.page())


@pytest.mark.parametrize("path", COMMITTED, ids=lambda path: path.name)
def test_committed_pages_are_sound(path):
    text = path.read_text("utf-8")
    assert faults(text) == []
    assert len(text.encode()) < LARGEST


def test_a_page_is_sound_and_needs_nothing_else(text):
    assert faults(text) == []
    assert not re.search(r"<(script|link|iframe|img)\b|url\(|@import|https?://", text)


def test_what_is_wrong_with_a_page_is_seen(text):
    for broken, fault in [
        (text.replace("</table>", "", 1), "closes what is not open"),
        (text.replace('id="study"', 'id="claims"'), "twice"),
        (text.replace('id="study"', ""), "leads nowhere"),
        (text.replace("<h2>", "<h4>", 1), "h4 after h1"),
        (text.replace(' scope="row"', "", 1), "without a scope"),
        (text.replace(' role="img" aria-label="Proof', ' role="img" title="Proof', 1), "without a label"),
    ]:
        assert any(fault in one for one in faults(broken)), fault


def test_every_block_with_data_is_there_and_no_other(text):
    blocks = ["claims", "study", "graph", "failures", "evidence", "assumptions", "scope", "check", "means"]
    assert all(f'<section class="grid" id="{b}"' in text or f'<section id="{b}"' in text for b in blocks)
    assert "Gains" not in text
    bare = replace(
        sample.page(), claims=(), proofs=(), failures=(), notes=(), assumptions=(),
        evidence=replace(sample.page().evidence, lines=()),
        study=replace(sample.page().study, motions=(), formulas=(), symbols=()),
        check=replace(sample.page().check, certificates=(), program=""),
    )  # fmt: skip
    ids = Markup(html(bare)).ids
    assert not {"claims", "graph", "failures", "evidence", "assumptions", "means", "program"} & set(ids)


def test_a_map_of_gains_has_its_place(text):
    line = GainLine("c is large", Made(""), Chip("proved", "holds"), "", "≥ 2", Link("all gains"))
    gains = Gains("<svg>", "<svg>", "caption of it", (line,), ("c", "true"), ("symctrl gains", "--sweep"))
    made = html(replace(sample.page(), gains=gains))
    assert made.index('id="failures"') < made.index('id="gains"') < made.index('id="evidence"')
    assert faults(made) == []
    assert "&lt;svg&gt;" in made  # what is no markup is not taken for it


def test_the_order_of_the_blocks_is_that_of_the_look(text):
    ids = ["means", "claims", "study", "graph", "failures", "evidence", "assumptions", "scope", "check"]
    assert [one for one in Markup(text).ids if one in ids] == ids


def test_every_verdict_is_on_the_page_in_shape_and_word(text):
    for group in groups(sample.report().rows):
        for row in group.rows:
            if group.form in ("definition", "law"):
                continue
            start = text.index(f'<tr id="{build.anchor(row.id)}">')
            line = text[start : text.index("</tr>", start)]
            word = "proof broken" if row.unmet else row.verdict
            assert f"<span>{word}" in line
            shape = {"ill-formed": "illformed", "proof broken": "broken"}.get(word, word)
            assert f'<use href="#{shape}"/>' in line
            assert f'class="vd {shape}"' in line


def test_every_number_of_a_verdict_is_on_the_page(text):
    shown = unescape(Markup(text).text)
    for row in sample.report().rows:
        for value in (row.witness or {}).values():
            assert numbers(str(value)) in shown
        for side in re.findall(r"(?:left|right) is (?:about )?(-?[\d/.]+)", row.reason.partition(";")[0]):
            assert numbers(side) in shown
        if row.certificate:
            assert str(certificate_size(row)) in shown
            assert row.certificate["sha256"][:12] in shown


def test_every_chip_has_a_shape_and_a_word():
    shapes = {"proved", "refuted", "illformed", "undecided", "broken"}
    assert {chip.shape for chip in chips(sample.page())} == shapes
    assert all(chip.word for chip in chips(sample.page()))


def chips(value):
    if isinstance(value, Chip):
        yield value
    elif is_dataclass(value):
        for one in fields(value):
            yield from chips(getattr(value, one.name))
    elif isinstance(value, tuple):
        for one in value:
            yield from chips(one)


def test_a_finding_belongs_to_its_outcome(text):
    assert "does not fall at this rate" in text
    rows = tuple(
        replace(row, verdict="proved", stands=True, finding=None) if row.id == "energy_rate" else row
        for row in sample.report().rows
        if row.id != "energy_rate_corrected"
    )
    other = build.page(replace(sample.report(), rows=rows), sample.study(), "spring.py", "A spring")
    assert "does not fall at this rate" not in html(other)


def test_words_of_a_study_are_text_and_no_markup(text):
    assert "A textbook &lt;with&gt; signs &amp; such, 1999" in text
    assert json.loads(unescape(re.search(r'symctrl-card" content="([^"]*)"', text)[1]))["study"] == "spring"


def test_the_same_verdicts_give_the_same_page(text):
    again = build.page(
        replace(
            sample.report(), seconds=7.0, rows=tuple(replace(r, seconds=9.0) for r in sample.report().rows)
        ),
        sample.study(),
        "spring.py",
        "A spring & its damper",
    )
    assert html(again) == text


def test_a_page_is_data():
    assert isinstance(sample.page(), Page)
    assert sample.page().gains is None
    assert {line.verdict for line in sample.page().scope} == {"out"}
