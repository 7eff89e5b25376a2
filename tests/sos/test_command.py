"""`symctrl sos`: forms, exit codes, fields and messages, as other programs rely on them."""

from __future__ import annotations

import json

import pytest

from symctrl.kernel.check import check_text

FIELDS = {
    "format",
    "tool",
    "inputs_sha256",
    "id",
    "verdict",
    "certificate",
    "witness",
    "reason",
    "seconds",
    "bound",
    "tried",
    "vacuous",
}


@pytest.mark.parametrize(
    ("args", "code", "verdict"),
    [
        (["x^4 - 2*x^2*y + y^2 + x^2", "--vars", "x,y"], 0, "proved"),
        (["x^2 - y", "--vars", "x,y"], 1, "refuted"),
        (["x + 1", "--vars", "x", "--on", "1-x^2>=0"], 0, "proved"),
        (["x", "--vars", "x", "--on", "x >= 1, x <= 0"], 0, "proved"),
        (["x^2 + 1 > 0"], 0, "proved"),
        (["x", "--vars", "x", "--on", "x^2 == 2"], 3, "undecided"),
    ],
)
def test_one_problem(run, args, code, verdict):
    exit_code, out, err = run("sos", *args, "--json", "-")
    found = json.loads(out)
    assert (exit_code, err, found["verdict"]) == (code, "", verdict)
    assert set(found) == FIELDS
    assert (found["certificate"] is None) == (verdict == "undecided")
    if found["certificate"]:
        assert check_text(json.dumps(found["certificate"])).status == "valid"
    assert (found["witness"] is not None) == (verdict == "refuted")
    assert found["vacuous"] == ("x >= 1" in args[-1])


def test_what_is_printed(run):
    assert run("sos", "x^2-y", "--vars", "x,y")[1].startswith(
        "refuted: the polynomial is negative (-1) at the"
    )
    code, out, _ = run("sos", "x", "--vars", "x", "--on", "x^2 == 2", "--limit", "5")
    assert code == 3
    assert "tried: the sign between all real roots; " in out


@pytest.mark.parametrize(
    ("args", "words"),
    [
        ([], "give one polynomial"),
        (["x", "--batch", "f.json"], "give one polynomial"),
        (["x*z", "--vars", "x,y"], "at character 3: z is not one of the variables x, y"),
        (["3"], "no variable"),
        (["", "--vars", "x"], "is empty"),
        (["x", "--vars", "x,x"], "x is named twice"),
        (["x", "--vars", "x", "--on", "x > 0"], "a constraint is >=, <= or =="),
        (["x", "--limit", "0"], "--limit 0: must be a positive number"),
        (["x", "--limit", "nan"], "must be a positive number"),
        (["--batch", "none.json"], "none.json: cannot be read"),
        (["x", "--json", "no/such/folder.json"], "cannot be written"),
    ],
)
def test_bad_input_is_one_clear_line(run, args, words):
    code, out, err = run("sos", *args)
    assert (code, out) == (2, "")
    assert words in err
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{", "not JSON"),
        ("{}", "is not a list of problems"),
        ("[1]", "problem 1: has no polynomial"),
        ('[{"poly": "x", "extra": 1}]', "unknown field 'extra'"),
        ('[{"poly": "x", "vars": 3}]', "vars must be a list"),
        ('[{"poly": "x+", "vars": ["x"]}]', "ends too early"),
        ('[{"poly": "x", "id": "a"}, {"poly": "x", "id": "a"}]', "the id 'a' stands there twice"),
        ('[{"poly": "x", "on": 1}]', "on must be a text"),
    ],
)
def test_a_bad_file_of_problems_is_one_clear_line(run, tmp_path, text, words):
    (tmp_path / "problems.json").write_text(text)
    code, out, err = run("sos", "--batch", "problems.json")
    assert (code, out) == (2, "")
    assert words in err
    assert err.count("\n") == 1


def test_a_batch_goes_on_after_a_hard_problem(run, tmp_path):
    hard = " + ".join(f"x{i}^4*x{j}^2 - x{i}*x{j}^3" for i in range(9) for j in range(9) if i != j)
    problems = [
        {"id": "easy", "poly": "x^2 + y^2 - x*y", "vars": ["x", "y"]},
        {"id": "hard", "poly": f"({hard})^2 + 1/7", "on": "x0*x1 >= 1"},
        {"id": "false", "poly": "x^3", "vars": "x", "on": ""},
        {"poly": "x", "vars": ["x"], "on": ["x >= 0", "x <= 1"]},
    ]
    (tmp_path / "problems.json").write_text(json.dumps(problems))
    code, _, _ = run("sos", "--batch", "problems.json", "--json", "answers.json", "--limit", "1")
    answers = json.loads((tmp_path / "answers.json").read_text())
    assert code == 0
    assert [answer["id"] for answer in answers] == ["easy", "hard", "false", "4"]
    assert [answer["verdict"] for answer in answers if answer["id"] != "hard"] == [
        "proved",
        "refuted",
        "proved",
    ]
    assert all(set(answer) == FIELDS for answer in answers)


def test_the_same_input_gives_the_same_bytes(run):
    def answer():
        found = json.loads(run("sos", "x^4 + y^4 - x*y + 1", "--vars", "x,y", "--json", "-")[1])
        del found["seconds"]
        return found

    assert answer() == answer()


GRAM = {"vars": ["x", "y"], "basis": ["x", "y"], "gram": [[1.0000001, -0.5], [-0.5, 0.9999999]]}
MOTION = {"vars": ["x", "y"], "lyapunov": "x^2 + y^2"}


@pytest.mark.parametrize(
    ("body", "code", "words"),
    [
        (GRAM | {"poly": "x^2 - x*y + y^2"}, 0, "the Gram matrix, rounded and corrected, is exact"),
        (GRAM | {"poly": "x^2 - 3*x*y + y^2"}, 1, "rounded, gives no proof"),
        (GRAM | {"poly": "x^2 + y^2", "gram": [[1, 3], [3, 1]]}, 0, "rounded, gives no proof"),
        (MOTION | {"field": {"x": "-x + y", "y": "-x - y^3"}}, 0, "-V': proved"),
        (MOTION | {"field": {"x": "x + y", "y": "-x - y^3"}}, 1, "-V': refuted"),
    ],
)
def test_what_somebody_found_in_floats(run, tmp_path, body, code, words):
    (tmp_path / "floats.json").write_text(json.dumps(body))
    exit_code, out, err = run("sos", "--certify", "floats.json", "--json", "-")
    found = json.loads(out)
    assert (exit_code, err) == (code, "")
    assert words in found["reason"]
    assert set(found) == FIELDS
    assert check_text(json.dumps(found["certificate"])).status == "valid"


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ({}, "must have"),
        (GRAM | {"poly": "x^2", "gram": [[1, 2], [3, 4]]}, "is not symmetric"),
        (GRAM | {"poly": "x^2", "gram": [[1, float("nan")], [0, 4]]}, "not finite"),
        (GRAM | {"poly": "x^2", "gram": [[1]]}, "must have 2 rows"),
        (GRAM | {"poly": "x^2", "basis": ["x", "2*y"]}, "is not a monomial"),
        (MOTION | {"field": {"x": "-x"}}, "the rate of each of x, y"),
    ],
)
def test_bad_floats_are_one_clear_line(run, tmp_path, body, words):
    (tmp_path / "floats.json").write_text(json.dumps(body))
    code, out, err = run("sos", "--certify", "floats.json")
    assert (code, out) == (2, "")
    assert words in err
    assert err.count("\n") == 1
