"""Bad input through the real program: one clear message on standard error, exit 2, nothing written."""

import json
import os
import subprocess

import pytest

from tests.conftest import SYMCTRL

FLEET = """\
from symctrl import Study, equal
study = Study("pair")
fleet = study.fleet()
i, j = fleet.node, fleet.neighbour
x, u = fleet.state("x"), fleet.input("u")
k = study.gain("k", "1")
K = study.parameter("K", [["1", "2"], ["3", "4"]], shape=(2, 2))
fleet.motion(x, lambda i: u[i])

@study.claimed("a")
def consensus(i):
    "A claim."
    return equal(fleet.sum(j, x[i] - x[j]), fleet.degree(i) * x[i] - fleet.sum(j, x[j], at=i))
"""
SINGLE = """\
from symctrl import Study, equal
study = Study("single")
x = study.state("x")
k = study.gain("k", "1")

@study.claimed("a")
def same():
    "A claim."
    return equal(k * x, x * k)
"""


def said(folder, *args, exit_code=2):
    """What `symctrl ARGS` says on standard error, in a folder that it must leave as it is."""
    before = sorted(str(path) for path in folder.rglob("*"))
    done = subprocess.run(
        [SYMCTRL, *map(str, args)], cwd=folder, capture_output=True, text=True, check=False, timeout=60
    )
    assert done.returncode == exit_code, done.stderr
    assert done.stdout == ""
    assert done.stderr.startswith("symctrl: ")
    assert "symctrl/" not in done.stderr.replace(str(folder), "")
    assert sorted(str(path) for path in folder.rglob("*")) == before
    return done.stderr


def one_line(folder, *args):
    """The same, where the message must be one line without a traceback."""
    message = said(folder, *args)
    assert message.count("\n") == 1
    assert "Traceback" not in message
    assert len(message) < 400 + len(str(folder))
    return message


@pytest.fixture
def files(tmp_path):
    (tmp_path / "pair.py").write_text(FLEET)
    (tmp_path / "single.py").write_text(SINGLE)
    return tmp_path


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('{"matrix": [[1, 2], [3, 4]]}', ["m.json", "symmetric"]),
        ('{"matrix": [[1, 2]]}', ["m.json", "1 rows", "2 entries"]),
        ('{"matrix": [[1, 2], [2]]}', ["m.json"]),
        ('{"matrix": []}', ["m.json"]),
        ('{"matrix": [[]]}', ["m.json"]),
        ('{"matrix": [[NaN]]}', ["m.json", "NaN"]),
        ('{"matrix": [["nan"]]}', ["m.json", "nan"]),
        ('{"matrix": [[Infinity]]}', ["m.json", "Infinity"]),
        ('{"matrix": [["1/0"]]}', ["m.json", "1/0"]),
        ('{"matrix": [["1e999999999"]]}', ["m.json"]),
        ('{"matrix": [[true]]}', ["m.json"]),
        ('{"matrix": [[null]]}', ["m.json"]),
        ('{"matrix": 1}', ["m.json"]),
        ('{"matrices": [[1]]}', ["m.json", "matrix"]),
        ('{"matrix": [[1]], "matrix": [[-1]]}', ["m.json"]),
        ("[1]", ["m.json"]),
        ("no json", ["m.json"]),
        ("", ["m.json"]),
        ("[" * 100_000, ["m.json"]),
    ],
)
def test_a_matrix_that_is_none(tmp_path, text, says):
    (tmp_path / "m.json").write_text(text)
    message = one_line(tmp_path, "posdef", "m.json", "--json", "answer.json")
    assert all(word in message for word in says), message


@pytest.mark.parametrize(
    ("args", "says"),
    [
        (["pair.py", "--claim", "concensus"], ["concensus", "consensus"]),
        (["pair"], ["pair.py"]),
        (["liang2016_formatoin"], ["liang2016_formation"]),
        (["none.py"], ["none.py", "no such file"]),
        (["pair.py", "--set", "k=0"], ["k=0", "positive"]),
        (["pair.py", "--set", "k=-1/2"], ["k=-1/2", "positive"]),
        (["pair.py", "--set", "k=a"], ["k=a", "exact number"]),
        (["pair.py", "--set", "k=nan"], ["k=nan", "exact number"]),
        (["pair.py", "--set", "k=1/0"], ["k=1/0", "exact number"]),
        (["pair.py", "--set", "k=1e999999999"], ["exact number"]),
        (["pair.py", "--set", "kk=1"], ["kk", "k"]),
        (["pair.py", "--set", "K=1"], ["K[1,1], K[2,1], K[1,2], K[2,2]"]),
        (["pair.py", "--set", "K[3,3]=1"], ["K[3,3]", "K[2,2]"]),
        (["pair.py", "--set", "x=1"], ["no parameter x"]),
        (["single.py", "--set", "gain=1"], ["no parameter gain", "k"]),
        (["single.py", "pair.py", "--set", "K[1,1]=1"], ["no parameter K[1,1]"]),
        (["single.py", "--graph", "ring:4"], ["single", "takes no graph"]),
        (["pair.py", "--graph", "ring:2"], ["ring:2", "3 nodes"]),
        (["pair.py", "--graph", "ring:x"], ["ring:x", "whole number"]),
        (["pair.py", "--graph", "bush:4"], ["bush:4", "ring:N"]),
        (["pair.py", "--graph", "complete:1000000"], ["complete:1000000"]),
        (["pair.py", "--graph", "none.txt"], ["none.txt"]),
    ],
)
def test_what_a_study_does_not_know(files, args, says):
    message = one_line(files, "verify", *args, "--json", "answer.json", "--certificates", "proofs")
    assert all(word in message for word in says), message


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("a b\nb b\n", ["line 2", "b to itself"]),
        ("a b\nb c\na b\n", ["line 3", "line 1 already"]),
        ("a b\nb a\n", ["line 2", "no direction"]),
        ("a b 1.0\n", ["line 1", "3 words"]),
        ("a -> b\n", ["line 1"]),
        ("a b\n# no more\n\nc.1 b\n", ["line 4", "c.1"]),
        ("# nothing\n", ["names no node"]),
        ("a b\n\xff", ["UTF-8"]),
    ],
)
def test_a_graph_file_that_is_none(files, text, says):
    (files / "g.txt").write_bytes(text.encode("latin-1"))
    message = one_line(files, "verify", "pair.py", "--graph", "g.txt", "--json", "answer.json")
    assert all(word in message for word in ["g.txt", *says]), message


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("no json", "not JSON"),
        ("", "not JSON"),
        ('{"format": "symctrl-certificate/1", "format": "symctrl-certificate/1"}', "twice"),
        ('{"format": "symctrl-certificate/99"}', "symctrl-certificate/99"),
        ("{}", "format"),
        ("[]", "format"),
        ("NaN", "NaN"),
    ],
)
def test_a_certificate_that_is_none(tmp_path, text, says):
    (tmp_path / "c.json").write_text(text)
    message = said(tmp_path, "check", "c.json")
    assert message.startswith("symctrl: c.json: unreadable: ")
    assert message.count("\n") == 1
    assert says in message


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('{"format": "symctrl-certificate/1", "statement": "' + "x" * 70_000_000 + '"}', "longer than"),
        ("[" * 100_000, "nested too deeply"),
    ],
    ids=["long", "deep"],
)
def test_a_certificate_that_is_too_large(tmp_path, text, says):
    (tmp_path / "c.json").write_text(text)
    message = said(tmp_path, "check", "c.json")
    assert message.startswith("symctrl: c.json: unreadable: ")
    assert message.count("\n") == 1
    assert says in message


AUTHORS = {
    "a name": ("    return equal(x, y)", "NameError: name 'y' is not defined"),
    "nothing": ("    equal(x, x)", "the function returns nothing"),
    "an expression": ("    return x * x", "returns <Expr 1x1: x*x>"),
    "a float": ("    return equal(x, 0.1 + 0.2)", "0.30000000000000004"),
    "a truth value": ("    return equal(x, x) if x > 0 else equal(x, -x)", "TypeError: "),
    "a symbol twice": ("    return equal(x, study.state('x'))", "declared twice"),
}


@pytest.mark.parametrize("name", AUTHORS)
def test_an_error_of_the_author_is_shown_with_the_authors_lines(tmp_path, name):
    body, says = AUTHORS[name]
    (tmp_path / "own.py").write_text(
        "from symctrl import Study, equal\nstudy = Study('own')\nx = study.state('x')\n\n"
        f"@study.claimed('a')\ndef a():\n    'A claim.'\n{body}\n"
    )
    message = said(tmp_path, "verify", "own.py", "--json", "answer.json")
    assert says in message
    assert message.count("File ") <= 1


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("study = (\n", "SyntaxError"),
        ("import no_such_module\n", "ModuleNotFoundError"),
        ("1 / 0\n", "ZeroDivisionError"),
        ("raise SystemExit\n", "SystemExit"),
        ("pass\n", "has no `study`"),
        ("study = 1\n", "must be a Study"),
    ],
)
def test_a_file_that_is_no_study(tmp_path, text, says):
    (tmp_path / "own.py").write_text(text)
    assert says in said(tmp_path, "verify", "own.py", "--certificates", "proofs")


def test_a_needless_correction_is_an_error_of_the_study(tmp_path):
    (tmp_path / "own.py").write_text(
        SINGLE.replace("claimed", "printed")
        + "@study.corrected(same, why='It was fine.')\ndef again():\n    return equal(x, x)\n"
    )
    assert "again corrects same, which is proved as printed" in one_line(tmp_path, "verify", "own.py")


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
@pytest.mark.parametrize("option", ["--json", "--certificates"])
def test_a_folder_that_cannot_be_written(files, option):
    closed = files / "closed"
    closed.mkdir(mode=0o500)
    assert "cannot be written" in one_line(files, "verify", "single.py", option, "closed/answer")


@pytest.mark.parametrize(
    ("option", "path"), [("--json", "none/a.json"), ("--json", "."), ("--certificates", "single.py")]
)
def test_a_place_that_cannot_hold_the_answer(files, option, path):
    assert path in one_line(files, "verify", "single.py", option, path)


def test_a_store_that_cannot_be_written_is_no_error(files):
    """A run without a store is slower and otherwise the same."""
    environment = os.environ | {"SYMCTRL_CACHE": "/dev/null/store"}
    command = [SYMCTRL, "verify", "single.py", "--json", "-"]
    done = subprocess.run(
        command, cwd=files, env=environment, capture_output=True, text=True, check=False, timeout=60
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)["claims"][0]["stands"] is True
