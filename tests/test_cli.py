"""The command line: forms, exit codes, one line for what is wrong, and nothing half-written."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from symctrl import cli, registry
from symctrl.certify import certificate, tool
from symctrl.rows import Report, Row

SYMCTRL = Path(sys.executable).with_name("symctrl")
STUDY = """
from symctrl.study import Study
study = Study("{name}", source="own design")
k = study.gain("k", "2")
"""


def row(name, **changed):
    fields = {
        "equation": "(1)",
        "statement": "a = b",
        "latex": "a = b",
        "form": "printed",
        "corrects": None,
        "kind": "equal",
        "verdict": "proved",
        "stands": True,
        "conditional": False,
        "reason": "both sides agree",
        "method": "exact",
    }
    return Row(id=name, **{**fields, **changed})


@pytest.fixture
def run(capsys, tmp_path, monkeypatch):
    """Runs the command line in a folder of its own; gives exit code, standard output and standard error."""
    monkeypatch.chdir(tmp_path)

    def run(*args):
        code = cli.run([str(arg) for arg in args])
        out, err = capsys.readouterr()
        return code, out, err

    return run


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


def refused(result, says):
    code, out, err = result
    assert code == 2
    assert out == ""
    assert err.startswith("symctrl: ")
    assert err.count("\n") == 1
    assert says in err


# The whole program


def test_the_version_is_the_packages():
    done = subprocess.run([SYMCTRL, "--version"], capture_output=True, text=True, check=True)
    assert done.stdout == f"{tool()}\n"


def test_help_is_quick_because_nothing_heavy_is_imported():
    heavy = "casadi numpy flint networkx scipy sympy rich.table rich.progress"
    code = (
        "import sys; from symctrl import cli; code = cli.run(['--help'])\n"
        f"print(code, sorted(set(sys.modules) & set({heavy!r}.split())), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stderr == "0 []\n"
    for command in ("studies", "new", "verify", "check", "posdef"):
        assert command in done.stdout


def test_typers_own_runner_sees_the_same_help():
    result = CliRunner().invoke(cli.app, ["verify", "--help"])
    assert result.exit_code == 0
    options = "all claim graph set tree strict fresh jobs json certificates"
    assert {f"--{option}" for option in options.split()} <= set(result.stdout.split())


@pytest.mark.parametrize(
    ("args", "says"),
    [
        (["veryfy"], "No such command 'veryfy'"),
        (["verify", "--grpah", "ring:4"], "No such option: --grpah"),
        (["verify", "x", "--jobs", "0"], "greater than or equal to 1"),
        (["verify", "x", "--jobs", "two"], "valid integer"),
        (["verify"], "which study"),
        (["verify", "x", "--all"], "not both"),
        (["verify", "nosuch"], "there is none of that name"),
        (["verify", "no/such.py"], "no such file"),
        (["new"], "Missing argument 'NAME'"),
        (["posdef"], "Missing argument"),
        (["check"], "Missing argument"),
        (["check", "nosuch.json"], "nosuch.json"),
        (["posdef", "nosuch.json"], "nosuch.json"),
        (["studies", "--json", "no/folder/a.json"], "no/folder/a.json: cannot be written"),
        (["studies", "--json", "."], "is a folder"),
    ],
)
def test_a_usage_error_is_one_line_and_2(run, args, says):
    refused(run(*args), says)


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


# verify


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
    assert [line.split()[:2] for line in out.splitlines()[1:3]] == [["(1)", "a"], ["(1)", "b"]]
    assert run("verify", path, "--tree")[1].startswith("- (1) b: ✓ proved\n  - (1) a: ✓ proved\n")


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


def test_an_output_that_cannot_show_a_mark_is_no_error():
    code = "from symctrl import cli; cli.run(['--version']); print('\\N{CHECK MARK}')"
    ascii_ = os.environ | {"PYTHONIOENCODING": "ascii"}
    done = subprocess.run([sys.executable, "-c", code], env=ascii_, capture_output=True, check=True)
    assert done.stdout.endswith(b"\n?\n")


def test_a_reader_that_goes_away_is_no_traceback(tmp_path):
    (tmp_path / "m.json").write_text('{"matrix": [[1]]}')
    command = [SYMCTRL, "posdef", *["m.json"] * 3000]
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 1


# studies and new


def test_studies_lists_names_and_what_they_are_about(run, monkeypatch, tmp_path):
    (tmp_path / "plugged_in.py").write_text('"""Of a fleet.\n\nMore."""\nraise SystemExit\n')
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setattr(registry, "installed", lambda: {"fleet": "plugged_in", "gone": "no_such_module"})
    assert run("studies") == (0, "fleet  Of a fleet.\ngone\n", "")
    _, out, _ = run("studies", "--json", "-")
    answer = json.loads(out)
    assert answer["format"] == "symctrl-studies/1"
    assert answer["studies"][0] == {"study": "fleet", "module": "plugged_in", "summary": "Of a fleet."}


@pytest.mark.parametrize("name", ["2x", "a-b", "class", "a b", "../x", "x.py", "é"])
def test_a_new_study_needs_a_python_name(run, tmp_path, name):
    refused(run("new", name), "must be a Python name")
    assert not list(tmp_path.iterdir())


def test_new_never_overwrites(run, tmp_path):
    (tmp_path / "own.py").write_text("mine")
    refused(run("new", "own"), "own.py is there already")
    assert (tmp_path / "own.py").read_text() == "mine"


# posdef


MATRICES = {
    "good": ([["2", "1/3"], ["1/3", "0.5"]], "proved", 0),
    "bad": ([["1", "2"], ["2", "1"]], "refuted", 1),
}


@pytest.mark.parametrize("name", MATRICES)
def test_posdef_of_one_matrix_exits_by_its_verdict(run, tmp_path, name):
    matrix, verdict, expected = MATRICES[name]
    (tmp_path / "m.json").write_text(json.dumps({"matrix": matrix}))
    code, out, err = run("posdef", "m.json", "--json", "answer.json")
    assert (code, err) == (expected, "")
    assert out.startswith(f"m.json: {verdict}: ")
    assert json.loads((tmp_path / "answer.json").read_text())["verdict"] == verdict


def test_posdef_of_several_answers_each_in_order(run, tmp_path):
    for name, (matrix, _, _) in MATRICES.items():
        (tmp_path / f"{name}.json").write_text(json.dumps({"matrix": matrix}))
    code, out, _ = run("posdef", "bad.json", "good.json", "bad.json", "--json", "-")
    assert code == 0
    assert [answer["verdict"] for answer in json.loads(out)] == ["refuted", "proved", "refuted"]
    (tmp_path / "odd.json").write_text('{"matrix": [[1, 2], [3, 4]]}')
    refused(run("posdef", "good.json", "odd.json", "--json", "answer.json"), "odd.json")
    assert not (tmp_path / "answer.json").exists()


# check


@pytest.fixture
def graded(run, tmp_path):
    """Files whose certificates have the four statuses."""
    (tmp_path / "m.json").write_text('{"matrix": [["2", "1"], ["1", "2"]]}')
    run("posdef", "m.json", "--json", "answer.json")
    good = json.loads((tmp_path / "answer.json").read_text())["certificate"]
    statement, proof = good["statement"], good["proof"]
    made = {
        "valid": good,
        "invalid": certificate(statement, proof | {"matrix": {"ldl": {"lower": [], "diagonal": []}}}),
        "declined": certificate(statement, proof | {"kind": "by authority"}),
        "unreadable": good | {"format": "symctrl-certificate/99"},
    }
    for status, body in made.items():
        (tmp_path / f"{status}.json").write_text(json.dumps(body))
    return run


@pytest.mark.parametrize(
    ("statuses", "expected"),
    [
        ("valid", 0),
        ("valid valid", 0),
        ("invalid", 1),
        ("declined", 3),
        ("valid declined invalid", 1),
        ("declined valid", 3),
        ("invalid unreadable declined", 2),
    ],
)
def test_check_says_of_each_file_what_it_is_and_the_worst_counts(graded, statuses, expected):
    names = [f"{status}.json" for status in statuses.split()]
    code, out, err = graded("check", *names)
    assert code == expected
    said = [line.split(":")[:2] for line in out.splitlines() if not line.startswith(" ")]
    assert said == [[f"{s}.json", f" {s}"] for s in statuses.split() if s != "unreadable"]
    assert ("unreadable.json: unreadable: " in err) == ("unreadable" in statuses)


def test_check_prints_the_statement_that_was_checked(graded):
    _, out, _ = graded("check", "valid.json")
    assert "positive definite" in out.split("\n", 1)[1]


def test_check_needs_none_of_the_heavy_libraries(graded, tmp_path):
    heavy = "casadi numpy flint networkx scipy sympy rich"
    code = (
        "import sys; from symctrl import cli; code = cli.run(['check', 'valid.json'])\n"
        f"print(code, sorted(set(sys.modules) & set({heavy!r}.split())), file=sys.stderr)"
    )
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stderr == "0 []\n"
