"""The committed page of the formation study: what its verdicts make, and every witness has its program."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from dataclasses import replace
from html import unescape
from pathlib import Path

import pytest

from derivations.liang2016_formation import study
from symctrl.certify import tool
from symctrl.report import build, gainsblock, rendering, shelf, writing
from symctrl.report.names import numbers
from symctrl.report.page import Page
from symctrl.report.scripts import LINES, PROGRAM, script
from symctrl.rows import Report, Row
from tests.report.markup import Markup, faults

NAME = "liang2016_formation"
COMMITTED = Path(__file__).parents[2] / "reports" / f"{NAME}.html"


@pytest.fixture(scope="module")
def page(report: Report) -> Page:
    gains = gainsblock.block(report, study, NAME, None, lambda _: None)
    return build.page(report, study, NAME, writing.title(NAME, NAME), gains)


@pytest.fixture(scope="module")
def text(page: Page) -> str:
    return rendering.page(page, shelf.card(shelf.entry(page, COMMITTED.name)))


def test_the_committed_page_is_what_the_verdicts_make(text):
    """Where it is not, `symctrl report liang2016_formation` writes it anew."""
    committed = COMMITTED.read_text("utf-8")
    if tool() in committed:
        assert committed == text
    assert without_versions(committed) == without_versions(text)


def without_versions(text: str) -> str:
    """A certificate holds the version of the tool, so that its digest and size change with it."""
    text = re.sub(r"symctrl \d[\w.]*", "symctrl", text)
    text = re.sub(r"\d+ bytes|(?<=<td class=\"r\">)\d+", "bytes", text)
    return re.sub(r"\b[0-9a-f]{64}\b|\b[0-9a-f]{12}\b", "digest", text)


def test_the_page_is_sound_and_small(text):
    assert faults(text) == []
    assert len(text.encode()) < 400_000


def test_every_outcome_is_on_the_page(report, text):
    shown = unescape(Markup(text).text)
    for row in report.rows:
        if row.form in ("step", "obligation", "fact"):
            continue
        for side in re.findall(r"(?:left|right) is (?:about )?(-?[\d/.]+\d)", row.reason.partition(";")[0]):
            assert numbers(side) in shown, row.id
        assert row.certificate is None or row.certificate["sha256"][:12] in text
        assert row.finding is None or row.verdict == "proved" or row.finding.split()[0] in shown


def test_every_exact_witness_has_a_program_that_says_what_the_verdict_says(report, tmp_path):
    program = tmp_path / "witness.py"
    program.write_text(PROGRAM)
    asked = [row for row in report.rows if _is_exact(row)]
    assert len(asked) >= 14
    for row in asked:
        made = script(NAME, row)
        certificate = tmp_path / "certificate.json"
        certificate.write_text(json.dumps(row.certificate))
        general = _printed(str(program), str(certificate))
        assert general in row.reason or "x'Ax" in general
        if made.text:
            assert len(made.text.splitlines()) <= LINES
            assert _printed("-c", made.text) == general
        else:
            assert made.command.startswith("python3 -I witness.py certificates/")


def test_a_changed_witness_changes_the_outcome(report, tmp_path):
    program = tmp_path / "witness.py"
    program.write_text(PROGRAM)
    for row in report.rows:
        if not _is_exact(row):
            continue
        outcomes = set()
        for change in (0, 1):
            made = json.loads(json.dumps(row.certificate))
            if "x" in made["proof"]:
                made["proof"]["x"][0] = str(1 + change)
            for k, (name, value) in enumerate(made["proof"]["values"].items()):
                made["proof"]["values"][name] = f"{value}" if not change else f"{k + 2}/{k + 3}"
            path = tmp_path / f"{change}.json"
            path.write_text(json.dumps(made))
            outcomes.add(_printed(str(program), str(path)))
        assert len(outcomes) == 2, row.id


def test_theorems_and_enclosures_say_why_they_have_no_program(page):
    for failure in page.failures:
        for reading in failure.readings:
            made = reading.witness.script if reading.witness is not None else None
            assert made is None or made.text or made.command or made.why_not


def test_the_title_and_the_finding_come_from_the_study(page):
    assert page.header.title.startswith("Decentralised attitude synchronisation")
    assert any(
        entry.finding.get("refuted", "-") in " ".join(page.header.lead) for entry in study.entries.values()
    )
    assert page == replace(page)


def _is_exact(row: Row) -> bool:
    made = row.certificate or {}
    return made.get("proof", {}).get("kind") == "witness" and "about" not in row.reason


def _printed(*command: str) -> str:
    done = subprocess.run([sys.executable, "-I", *command], capture_output=True, text=True, check=True)
    return done.stdout.strip()
