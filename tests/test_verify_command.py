"""`symctrl verify`: what it asks of the studies, what it prints and writes, and how it ends."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest

from symctrl import registry
from symctrl.certify import certificate, tool
from symctrl.rows import Report, Row
from tests.conftest import SYMCTRL
from tests.samples import refused, row

STUDY = """
from symctrl.study import Study
study = Study("{name}", source="own design")
k = study.gain("k", "2")
"""
CLAIM = """
from pathlib import Path
from symctrl import Study, equal
study = Study("own", source="own design")
x = study.state("x")

@study.claimed("a")
def a():
    'A claim.'
    Path("reached").touch()
    {body}
    return equal(x, x)
"""


@pytest.fixture
def decides(monkeypatch, tmp_path):
    """Puts studies in files and lets `verify` answer with the given rows, without deciding anything."""
    rows: dict[str, tuple[Row, ...]] = {}
    asked = []

    def verify(study, only, store, progress):
        asked.append(only)
        chosen = [r for r in rows[study.name] if only is None or r.id in only]
        return Report(study.name, study.source, study.graph, tuple(chosen), (), "0" * 64, 0.5)

    def put(name, *its_rows):
        rows[name] = its_rows
        (tmp_path / f"{name}.py").write_text(STUDY.format(name=name))
        return f"{name}.py"

    monkeypatch.setattr("symctrl.verify.verify", verify)
    monkeypatch.setattr("symctrl.study.Study.statement_ids", lambda self: [r.id for r in rows[self.name]])
    put.asked = asked
    return put


# What is wrong is said before anything is decided


@pytest.mark.parametrize(
    ("args", "says"),
    [
        (["--set", "k"], "must be like NAME=VALUE"),
        (["--set", "k="], "must be like NAME=VALUE"),
        (["--set", "k=1", "--set", "k=2"], "k is set twice"),
        (["--set", "q=1"], "no parameter q"),
        (["--set", "k=-1"], "must be positive"),
        (["--set", "k=nan"], "not an exact number"),
        (["--graph", "ring:2"], "at least 3 nodes"),
        (["--graph", "ring:4"], "takes no graph"),
        (["own.py"], "asked for twice"),
    ],
)
def test_a_wrong_option_of_verify_is_one_line_and_2(run, decides, tmp_path, args, says):
    refused(run("verify", decides("own", row("a")), *args), says)
    assert decides.asked == []
    refused(run("verify", "own.py", *args, "--certificates", "out"), "")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["own.py"]


@pytest.mark.parametrize(
    ("args", "says"),
    [(["--json", "no/folder.json"], "cannot be written"), (["--certificates", "own.py"], "is not a folder")],
)
def test_what_cannot_be_written_is_refused_before_anything_is_decided(run, decides, args, says):
    refused(run("verify", decides("own", row("a")), *args), says)
    assert decides.asked == []


def test_the_answer_may_lie_beside_the_certificates(run, decides, tmp_path):
    assert run("verify", decides("own", row("a")), "--certificates", "out", "--json", "out/all.json")[0] == 0
    assert json.loads((tmp_path / "out" / "all.json").read_text())["study"] == "own"


def test_an_error_in_a_study_is_the_authors_own_traceback_and_2(run, tmp_path):
    (tmp_path / "own.py").write_text("def f(x):\n    return 1 / x\nf(0)\n")
    command = [SYMCTRL, "verify", "own.py"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith(f"symctrl: {tmp_path / 'own.py'}: the study's code failed:")
    assert done.stderr.endswith("ZeroDivisionError: division by zero\n")
    assert "symctrl/" not in done.stderr.replace(str(tmp_path), "")


def test_an_error_while_a_claim_is_decided_is_the_authors_too(run, decides, monkeypatch, tmp_path):
    path = decides("own", row("a"))
    with (tmp_path / path).open("a") as file:
        file.write("def claim():\n    return undefined_name\nstudy.body = claim\n")
    monkeypatch.setattr("symctrl.verify.verify", lambda study, *_: study.body())
    code, out, err = run("verify", path)
    assert (code, out) == (2, "")
    assert "line 6, in claim" in err
    assert err.endswith("NameError: name 'undefined_name' is not defined\n")


# What is decided is shown and written


@pytest.mark.parametrize(
    ("rows", "plain", "strict"),
    [
        ([row("a")], 0, 0),
        ([row("a"), row("b", conditional=True)], 0, 1),
        ([row("a", verdict="refuted", stands=False)], 0, 0),
        ([row("a"), row("b", settled=False)], 1, 1),
        ([], 0, 0),
    ],
)
def test_the_exit_code_says_whether_all_is_settled(run, decides, rows, plain, strict):
    path = decides("own", *rows)
    assert run("verify", path)[0] == plain
    assert run("verify", path, "--strict")[0] == strict
    assert run("verify", decides("fine", row("a")), path)[0] == plain


def test_verify_prints_a_table_or_a_tree(run, decides):
    path = decides("own", row("a"), row("b", rests_on=("a",)))
    _, out, err = run("verify", path)
    assert err == ""
    assert [line.split()[:2] for line in out.splitlines()[1:3]] == [["(7)", "a"], ["(7)", "b"]]
    assert run("verify", path, "--tree")[1].startswith("- (7) b: ✓ proved\n  - (7) a: ✓ proved\n")


def test_json_is_an_object_for_one_study_and_a_list_for_several(run, decides, tmp_path):
    one, two = decides("one", row("a", witness={"x": "1/2"})), decides("two", row("b"))
    run("verify", one, "--json", "one.json")
    answer = json.loads((tmp_path / "one.json").read_text())
    assert {**answer, "claims": None} == {
        "format": "symctrl-verify/1",
        "tool": tool(),
        "study": "one",
        "graph": None,
        "inputs_sha256": "0" * 64,
        "claims": None,
        "missing": [],
        "seconds": 0.5,
    }
    assert answer["claims"][0]["witness"] == {"x": "1/2"}
    _, out, _ = run("verify", one, two, "--json", "-")
    assert [study["study"] for study in json.loads(out)] == ["one", "two"]
    assert out.count("\n") == 1


def test_an_old_answer_stays_when_the_new_one_fails(run, decides, tmp_path, monkeypatch):
    path = decides("own", row("a"))
    target = tmp_path / "answer.json"
    target.write_text("old")

    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("symctrl.verify.verify", interrupted)
    code, _, err = run("verify", path, "--json", target)
    assert (code, err) == (130, "symctrl: interrupted\n")
    assert target.read_text() == "old"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["answer.json", "own.py"]


def test_claims_are_asked_of_the_studies_that_have_them(run, decides):
    one, two = decides("one", row("a[first]"), row("b")), decides("two", row("b"), row("c"))
    run("verify", one, two, "--claim", "a", "--claim", "b")
    assert [list(only) for only in decides.asked] == [["a", "b"], ["b"]]
    refused(run("verify", one, two, "--claim", "d"), "claim d: none of the studies one, two has it")


def test_certificates_are_written_by_study_and_id(run, decides, tmp_path):
    proof = certificate({"id": "a"}, {"kind": "conforms"})
    folder = tmp_path / "out" / "own"
    folder.mkdir(parents=True)
    (folder / "c.json").write_text("of an earlier run")
    rows = row("a[first reading]/é", certificate=proof), row("b.2-x", certificate=proof), row("c")
    assert run("verify", decides("own", *rows), "--certificates", "out")[0] == 0
    written = {path.name: json.loads(path.read_text()) for path in folder.iterdir()}
    assert written == {"a_first_reading___.json": proof, "b.2-x.json": proof}


def test_two_claims_with_one_file_name_are_refused_before_one_is_lost(run, decides, tmp_path):
    path = decides("own", row("a[b]", certificate={}), row("a_b_", certificate={}))
    code, _, err = run("verify", path, "--certificates", tmp_path / "out")
    assert code == 2
    assert "a[b] and a_b_" in err
    assert not list((tmp_path / "out").rglob("*.json"))


def test_all_is_every_installed_study(run, decides, monkeypatch):
    monkeypatch.setattr(registry, "installed", dict)
    refused(run("verify", "--all"), "no study is installed")
    decides("plugged", row("a"))
    monkeypatch.syspath_prepend(".")
    monkeypatch.setattr(registry, "installed", lambda: {"plugged": "plugged"})
    code, out, _ = run("verify", "--all", "--json", "-")
    assert code == 0
    assert [study["study"] for study in json.loads(out)] == ["plugged"]
    sys.modules.pop("plugged")


# With nothing replaced


@pytest.fixture
def spring(run):
    run("new", "spring")
    return run


def test_a_new_study_verifies_and_its_certificates_are_valid(spring, tmp_path):
    assert spring("verify", "spring.py", "--strict", "--certificates", "proofs")[0] == 0
    files = sorted((tmp_path / "proofs" / "spring").iterdir())
    assert [path.name for path in files] == ["E.json", "damping.json", "energy_falls.json"]
    assert spring("check", *files)[0] == 0


def test_processes_give_what_one_process_gives(spring, tmp_path):
    def answer(*options):
        command = [SYMCTRL, "verify", "spring.py", "--fresh", "--json", "-", *options]
        text = subprocess.check_output(command, cwd=tmp_path, text=True)
        return json.loads(text, object_hook=lambda d: {k: v for k, v in d.items() if k != "seconds"})

    assert answer("--jobs", "2") == answer()


def test_a_claim_of_its_own_and_one_that_is_not_there(spring):
    _, out, _ = spring("verify", "spring.py", "--claim", "energy_falls", "--json", "-")
    assert [claim["id"] for claim in json.loads(out)["claims"]] == ["energy_falls"]
    refused(spring("verify", "spring.py", "--claim", "energy_fals"), "energy_falls")


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_an_interrupt_is_one_line_and_130_and_ends_all_processes(tmp_path, jobs):
    (tmp_path / "own.py").write_text(CLAIM.format(body="while True: pass"))
    command = [SYMCTRL, "verify", "own.py", "--jobs", jobs]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, cwd=tmp_path, start_new_session=True, **pipes) as process:
        _wait_for(tmp_path / "reached")
        os.kill(process.pid, signal.SIGINT)
        out, err = process.communicate(timeout=20)
    assert (process.returncode, out, err) == (130, "", "symctrl: interrupted\n")
    _wait_for_the_end_of(process.pid)


def _wait_for(path):
    end = time.monotonic() + 20
    while not path.exists() and time.monotonic() < end:
        time.sleep(0.02)
    assert path.exists()


def _wait_for_the_end_of(group):
    end = time.monotonic() + 20
    while time.monotonic() < end:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return
        time.sleep(0.02)
    raise AssertionError("a process was left behind")
