"""The command line: forms, exit codes, one line for what is wrong, and nothing half-written."""

import json
import os
import subprocess
import sys

import pytest
from typer.testing import CliRunner

from symctrl import cli, registry
from symctrl.certify import certificate, tool
from tests.conftest import SYMCTRL
from tests.samples import refused

# The whole program


def test_the_version_is_the_packages():
    done = subprocess.run([SYMCTRL, "--version"], capture_output=True, text=True, check=True)
    assert done.stdout == f"{tool()}\n"


def test_help_is_quick_because_nothing_heavy_is_imported():
    heavy = "casadi numpy flint networkx scipy sympy"
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
        (["verify", "x", "--jobs", "0"], "--jobs"),
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
    heavy = "casadi numpy flint networkx scipy sympy"
    code = (
        "import sys; from symctrl import cli; code = cli.run(['check', 'valid.json'])\n"
        f"print(code, sorted(set(sys.modules) & set({heavy!r}.split())), file=sys.stderr)"
    )
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stderr == "0 []\n"
