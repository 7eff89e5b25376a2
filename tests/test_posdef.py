"""Matrices from files: what is read exactly, what is refused and how, and what the kernel accepts."""

import json
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.kernel import check
from symctrl.kernel.loading import load
from symctrl.posdef import PosdefError, answer, parse, read


def text(rows):
    return json.dumps({"matrix": rows})


def verify(found):
    """The kernel on the certificate, as a file would hold it."""
    certificate = load(json.dumps(found["certificate"]))
    check.verify(certificate)
    return certificate.statement


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ('"2/3"', Fraction(2, 3)),
        ('"-0.125"', Fraction(-1, 8)),
        ("0.1", Fraction(1, 10)),
        ("1e-3", Fraction(1, 1000)),
        ("12345678901234567890.5", Fraction(24691357802469135781, 2)),
        ('"+.5e2"', Fraction(50)),
    ],
)
def test_numbers_mean_what_is_written(written, value):
    assert parse(f'{{"matrix": [[{written}]]}}', "m.json") == [[value]]


@pytest.mark.parametrize(
    ("given_text", "words"),
    [
        ("", "not JSON"),
        ("[[1]]", 'the field "matrix" is missing'),
        ("[" * 100_000, "nested too deeply"),
        ('{"matrix": [[1]], "matrix": [[2]]}', 'the field "matrix" stands there twice'),
        ('{"matrix": [[1]], "name": 1}', 'unknown field "name"'),
        ('{"matrix": []}', "at least one row"),
        ('{"matrix": 3}', "at least one row"),
        ('{"matrix": [[1, 2], [3]]}', "2 rows, but row 2 has 1 entries"),
        ('{"matrix": [1]}', "row 1 must be a list"),
        ('{"matrix": [[1, 2], [3, 4]]}', r"entry \(2, 1\) is 3 and entry \(1, 2\) is 2; they must be equal"),
        ('{"matrix": [[1, 0], [0, NaN]]}', r"entry \(2, 2\) is NaN; it must be a finite number"),
        ('{"matrix": [[-Infinity]]}', r"entry \(1, 1\) is -Infinity; it must be a finite number"),
        ('{"matrix": [["1/0"]]}', r'entry \(1, 1\) is "1/0"; its denominator must not be zero'),
        ('{"matrix": [["x"]]}', r'entry \(1, 1\) is "x"; it must be a finite number'),
        ('{"matrix": [[true]]}', r"entry \(1, 1\) is true; it must be a finite number"),
        ('{"matrix": [["٣"]]}', r"entry \(1, 1\) is .*; it must be a finite number"),
        ('{"matrix": [[1e99999]]}', r"entry \(1, 1\) is 1e99999; a number may have at most"),
    ],
)
def test_what_is_no_matrix_is_refused_in_one_line(given_text, words):
    with pytest.raises(PosdefError, match=words) as error:
        answer(given_text, "m.json")
    assert str(error.value).startswith("m.json: ")
    assert "\n" not in str(error.value)


def test_files(tmp_path):
    with pytest.raises(PosdefError, match="there is no such file"):
        read(tmp_path / "none.json")
    (tmp_path / "latin.json").write_bytes(b'{"matrix": [["\xe9"]]}')
    with pytest.raises(PosdefError, match="not UTF-8"):
        read(tmp_path / "latin.json")
    (tmp_path / "crlf.json").write_bytes(b'{"matrix":\r\n [[1]]}')
    assert read(tmp_path / "crlf.json") == '{"matrix":\r\n [[1]]}'


def test_the_answer_for_a_definite_matrix():
    found = answer(text([["2", "1/3"], ["1/3", "0.5"]]), "dir/m.json")
    assert (found["verdict"], found["definiteness"], found["rank"]) == ("proved", "positive definite", 2)
    assert found["witness"] is None
    assert verify(found).claim.kind == "positive_definite"


def test_the_answer_for_a_semidefinite_matrix():
    found = answer(text([[1, -1], [-1, 1]]), "m.json")
    assert (found["verdict"], found["definiteness"], found["rank"]) == ("proved", "positive semidefinite", 1)
    assert verify(found).claim.kind == "positive_semidefinite"


def test_the_answer_for_an_indefinite_matrix():
    found = answer(text([["1", "1"], ["1", "0.99999999999999999999"]]), "m.json")
    assert (found["verdict"], found["definiteness"], found["rank"]) == (
        "refuted",
        "not positive semidefinite",
        2,
    )
    a = Fraction("0.99999999999999999999")
    x, y = map(Fraction, found["witness"]["x"])
    assert x * x + 2 * x * y + a * y * y < 0
    assert verify(found).claim.kind == "positive_semidefinite"


entries = st.fractions(min_value=-2, max_value=2, max_denominator=4)


@settings(max_examples=40, deadline=None)
@given(
    st.integers(1, 5).flatmap(
        lambda n: st.lists(st.lists(entries, min_size=n, max_size=n), min_size=n, max_size=n)
    )
)
def test_every_certificate_is_accepted_and_the_same_again(b):
    n = len(b)
    rows = [[str(b[max(i, j)][min(i, j)] + 2 * (i == j)) for j in range(n)] for i in range(n)]
    first, again = (answer(text(rows), "m.json") for _ in range(2))
    verify(first)
    assert {**first, "seconds": 0} == {**again, "seconds": 0}


def test_a_large_matrix_has_a_certificate_by_dominance():
    rows = [[2 + (i == j) * (i + 1) for j in range(30)] for i in range(30)]
    found = answer(text(rows), "m.json")
    assert "dominant" in found["certificate"]["proof"]["matrix"]
    assert verify(found).claim.shape == (30, 30)


def test_no_certificate_no_proof():
    """The pivots of this singular matrix have more digits than a certificate may hold."""
    n, digits = 4, 1200
    rows = [[Fraction(10) ** digits // (7 * i + 11 * j + 3) for j in range(n - 1)] for i in range(n)]
    gram = [[str(sum(a * b for a, b in zip(r, s, strict=True))) for s in rows] for r in rows]
    found = answer(text(gram), "m.json")
    assert (found["verdict"], found["definiteness"], found["rank"]) == (
        "undecided",
        "positive semidefinite",
        3,
    )
    assert found["certificate"] is None


def test_a_certificate_that_the_kernel_declines_is_no_proof(monkeypatch):
    monkeypatch.setattr("symctrl.kernel.matrices.MAX_WORK", 1)
    found = answer(text([[2, 1], [1, 2]]), "m.json")
    assert (found["verdict"], found["certificate"]) == ("undecided", None)
    assert "too much work" in found["reason"]
