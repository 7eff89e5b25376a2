"""A witness's program: it says what the verdict says, and something else where a value is changed."""

import json
import re
import subprocess
import sys

import pytest

from symctrl.report import scripts
from symctrl.report.scripts import LINES, PROGRAM, WIDTH, script
from tests.report import sample

REFUTED = [row for row in sample.report().rows if row.verdict == "refuted" and row.certificate]


def printed(*command):
    """What an isolated Python prints: nothing of symctrl can be imported by accident."""
    done = subprocess.run([sys.executable, "-I", *command], capture_output=True, text=True, check=True)
    return done.stdout.strip()


@pytest.mark.parametrize("row", REFUTED, ids=lambda row: row.id)
def test_a_short_claim_is_written_out(row):
    text = script("spring", row).text
    assert 0 < len(text.splitlines()) <= LINES
    assert max(map(len, text.splitlines())) <= WIDTH
    assert "symctrl" not in text
    said = printed("-c", text)
    assert said.replace("right is 0", "right about 0") in row.reason or said in row.reason


@pytest.mark.parametrize("row", REFUTED, ids=lambda row: row.id)
def test_another_value_gives_another_outcome(row):
    text = script("spring", row).text
    values = next(line for line in text.splitlines() if '"' in line)
    changed = re.sub(r'"(-?\d+)', lambda m: f'"{int(m[1]) + 7}', values)
    assert changed != values
    assert printed("-c", text.replace(values, changed)) != printed("-c", text)


@pytest.mark.parametrize("row", [r for r in REFUTED if r.id != "cosine"], ids=lambda row: row.id)
def test_the_general_program_says_the_same(row, tmp_path):
    program, certificate = tmp_path / "witness.py", tmp_path / "c.json"
    program.write_text(PROGRAM)
    certificate.write_text(json.dumps(row.certificate))
    assert printed(str(program), str(certificate)) == printed("-c", script("spring", row).text)


def test_what_the_general_program_cannot_evaluate_is_not_offered_to_it(monkeypatch):
    monkeypatch.setattr(scripts, "LINES", 0)
    by_id = {row.id: script("spring", row) for row in REFUTED}
    assert by_id["cosine"].why_not
    assert not by_id["cosine"].command
    assert by_id["energy_rate"].command.endswith("certificates/spring/energy_rate.json")


def test_what_has_no_witness_has_no_program():
    assert {script("spring", row) for row in sample.report().rows if row.witness is None} == {
        scripts.Script()
    }
