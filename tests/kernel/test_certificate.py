"""Certificates are read strictly: everything malformed is refused, and nothing makes the checker raise."""

from __future__ import annotations

import copy
import json

import pytest
from hypothesis import given as for_all
from hypothesis import settings
from hypothesis import strategies as st

from symctrl.kernel.certificate import Declined, Invalid, Unreadable, digest, rational, split_name
from symctrl.kernel.check import Answer, check_file, check_text, exit_code
from symctrl.kernel.loading import load
from tests.kernel.certificates import certificate, explain, free, given, seal, status

GOOD = certificate(
    {
        "claim": "a = MUL x K\nb = MUL K x\nc = ADD a b\nd = TWICE V\nreturn c d",
        "V": "a = MUL x K\nreturn a",
        "K": "return K",
    },
    {"generators": free("x", "K")},
    scalars={"x": "state", "K": "parameter"},
    names={"V": {"is": "value", "of": ["V", 0]}},
    given=[given("positive", "K")],
)
CONFORMS = {"kind": "conforms", "listing": "claim", "shape": [1, 2]}


def changed(*path, to, source=GOOD):
    other = copy.deepcopy(source)
    place = other
    for key in path[:-1]:
        place = place[key]
    if to is None:
        del place[path[-1]]
    else:
        place[path[-1]] = to
    return seal(other)


def test_a_good_one_is_valid_and_printed():
    answer = check_text(json.dumps(GOOD))
    assert answer.status == "valid"
    for part in ("(x * K)", "where V is", "positive", "for all state: x", "a small claim"):
        assert part in answer.statement


def test_a_definition_conforms():
    conforms = changed("statement", "claim", to=CONFORMS)
    conforms["proof"] = {"kind": "conforms"}
    assert status(seal(conforms)) == "valid"
    assert "does not prove" in explain(changed("proof", to={"kind": "conforms"}))
    conforms["proof"]["more"] = 1
    assert status(seal(conforms)) == "invalid"
    with_conditions = changed("statement", "conditions", to=[{"kind": "nonzero", "of": "x"}], source=conforms)
    with_conditions["proof"] = {"kind": "conforms"}
    assert status(seal(with_conditions)) == "invalid"


@pytest.mark.parametrize(
    "text",
    ["", " ", "{", "null", "[]", "3", '"x"', "NaN", "{}", '{"format": "symctrl-certificate/2"}',
     '{"a": 1, "a": 2}', "\ufeff{}", '{"format": NaN}', "[" * 50 + "]" * 50],
)  # fmt: skip
def test_what_is_no_certificate_is_unreadable(text):
    assert check_text(text).status == "unreadable"


def test_limits_are_kept_before_any_work(monkeypatch):
    assert check_text("[" * 100_000).status == "unreadable"
    assert check_text('{"a":' * 100_000).status == "unreadable"
    assert check_text('{"format": ' + "7" * 5000 + "}").status == "declined"
    monkeypatch.setattr("symctrl.kernel.loading.MAX_TEXT", 10)
    assert "longer than" in check_text("x" * 11).reason


@pytest.mark.parametrize(
    ("path", "to"),
    [
        (("more",), 1),
        (("tool",), 3),
        (("proof",), []),
        (("proof", "more"), []),
        (("proof", "hints"), None),
        (("statement", "more"), 1),
        (("statement", "motion"), None),
        (("statement", "text"), ["x"]),
        (("statement", "listings"), {}),
        (("statement", "given", 0, "kind"), "likely"),
        (("statement", "given", 0, "of"), ["K", 1]),
        (("statement", "given", 0, "of"), ["claim", -1]),
        (("statement", "given", 0, "more"), 1),
        (("statement", "claim", "shape"), [0, 1]),
        (("statement", "claim", "shape"), [1, 2]),
        (("statement", "claim", "shape"), [True, 1]),
        (("statement", "claim", "listing"), "none"),
        (("statement", "claim", "kind"), "true"),
        (("statement", "claim", "matrix"), {}),
        (("statement", "scalars", "y"), "state"),
        (("statement", "scalars", "x"), "number"),
        (("statement", "scalars", "x"), None),
        (("statement", "scalars", "V"), "state"),
        (("statement", "scalars", "x.i"), "state"),
        (("statement", "scalars", "not a name"), "state"),
        (("statement", "names", "W"), {"is": "constant", "value": "1"}),
        (("statement", "names", "V", "is"), "rate"),
        (("statement", "names", "V", "is"), "total"),
        (("statement", "names", "V", "is"), "sum"),
        (("statement", "names", "V"), {"is": "constant", "value": 1}),
        (("statement", "names", "V"), {"is": "rate", "of": ["V", 0], "law": "none"}),
        (("statement", "motion", "x"), ["K", 0]),
        (("statement", "motion", "K"), ["K", 0]),
        (("statement", "laws", "pd"), {}),
        (("statement", "conditions"), [{"kind": "nonzero", "of": "K"}]),
        (("statement", "conditions"), [{"kind": "nonzero", "of": "K"}] * 2),
        (("statement", "listings", "V", "code", 0), ["INPUT", "V"]),
        (("statement", "listings", "V", "code", 0), ["INPUT", "x.*"]),
        (("statement", "listings", "V", "code", 0), ["INPUT", "x.i"]),
        (("statement", "listings", "V", "code", 0), ["CONST", "2/4"]),
        (("statement", "listings", "V", "code", 0), ["CONST", 2]),
        (("statement", "listings", "V", "code", 1), ["INPUT", "x"]),
        (("statement", "listings", "V", "code", 2), ["MUL", 0, 2]),
        (("statement", "listings", "V", "code", 2), ["MUL", 0]),
        (("statement", "listings", "V", "code", 2), ["MUL", 0, True]),
        (("statement", "listings", "V", "code", 2), []),
        (("statement", "listings", "V", "outputs"), []),
        (("statement", "listings", "V", "outputs"), [3]),
        (("statement", "listings", "V", "outputs"), [0]),
        (("statement", "listings", "V", "more"), 1),
    ],
)
def test_a_fault_of_form_is_invalid(path, to):
    faulty = changed(*path, to=to)
    assert status(faulty) == "invalid", explain(faulty)


def test_an_unknown_operation_or_proof_is_declined():
    assert status(changed("statement", "listings", "V", "code", 2, to=["FMOD", 0, 1])) == "declined"
    assert status(changed("proof", "kind", to="faith")) == "declined"
    assert status(changed("proof", "kind", to=None)) == "declined"


def test_a_lone_surrogate_is_refused():
    faulty = json.dumps(GOOD).replace("a small claim", "\\ud800")
    assert check_text(faulty).status == "invalid"


def test_digests_are_recomputed():
    outer = copy.deepcopy(GOOD)
    outer["statement"]["text"] = "another claim"
    assert "sha256" in explain(outer)
    inner = copy.deepcopy(GOOD)
    inner["statement"]["listings"]["V"]["code"][2] = ["ADD", 0, 1]
    inner["sha256"] = digest({key: value for key, value in inner.items() if key != "sha256"})
    assert explain(inner).startswith("invalid: listing 'V': the sha256")


def test_a_name_through_itself_is_refused():
    text = {"claim": "return V 0", "V": "return W", "W": "return V"}
    names = {"V": {"is": "value", "of": ["V", 0]}, "W": {"is": "value", "of": ["W", 0]}}
    assert "through itself" in explain(certificate(text, {}, scalars={}, names=names, conditions=[]))


def test_too_many_names_inside_each_other_are_declined():
    count = 150
    text = {"claim": "return V0 0", **{f"V{k}": f"return V{k + 1}" for k in range(count)}}
    names = {f"V{k}": {"is": "value", "of": [f"V{k}", 0]} for k in range(count)}
    names[f"V{count}"] = {"is": "constant", "value": "0"}
    assert status(certificate(text, {}, scalars={}, names=names, conditions=[])) == "declined"


@pytest.mark.parametrize(("text", "value"), [("0", 0), ("-3", -3), ("3/4", 0.75), (7, 7), ("-1/2", -0.5)])
def test_rationals(text, value):
    assert rational(text, "here") == value


@pytest.mark.parametrize(
    "text",
    [
        "",
        "-0",
        "+1",
        "01",
        "1/1",
        "2/4",
        "1/0",
        "1/-2",
        " 1",
        "1 ",
        "1e3",
        "0.5",
        "1_0",
        "٣",
        "0/2",
        "-0/3",
        True,
        None,
        1.5,
        "1/2\n",
    ],
)
def test_loose_rationals_are_refused(text):
    with pytest.raises(Invalid):
        rational(text, "here")


def test_long_rationals_are_declined():
    with pytest.raises(Declined):
        rational("1" * 5000, "here")


@pytest.mark.parametrize(
    ("name", "parts"),
    [
        ("q", ("q", "")),
        ("q[1]", ("q[1]", "")),
        ("J[1,2]", ("J[1,2]", "")),
        ("q.i[1]", ("q.*[1]", "i")),
        ("S.j", ("S.*", "j")),
        ("q.2[1]", ("q.2[1]", "")),
    ],
)
def test_names(name, parts):
    assert split_name(name) == parts


@pytest.mark.parametrize(
    "name", ["", "q[0]", "q[01]", "q[1", "q.", "q.i.j", "1q", "q 1", "q'", "q[1,2,3]", "q[1]\n", "q" * 201]
)
def test_what_is_no_name(name):
    with pytest.raises(Invalid):
        split_name(name)


JSON = st.recursive(
    st.none() | st.integers() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
)


@settings(max_examples=60)
@for_all(st.text(max_size=30) | JSON.map(json.dumps))
def test_any_text_has_an_answer(text):
    """A bare decimal is readable JSON, and refused as such."""
    assert check_text(text).status in ("unreadable", "invalid")


@settings(max_examples=200, deadline=None)
@for_all(st.data())
def test_any_change_of_the_json_has_an_answer(data):
    """With digests recomputed, a changed certificate is refused or proves the statement that is printed."""
    other = copy.deepcopy(GOOD)
    place = other
    while True:
        keys = list(place) if isinstance(place, dict) else list(range(len(place)))
        key = data.draw(st.sampled_from(keys))
        if not isinstance(place[key], dict | list) or not place[key] or data.draw(st.integers(0, 3)) == 0:
            break
        place = place[key]
    place[key] = data.draw(
        st.sampled_from([0, 1, -1, 2, "", "x", "K", "1", [], {}, None, True, [0], ["V", 0], ["INPUT", "x"]])
    )
    try:
        sealed = seal(other)
    except (KeyError, TypeError, AttributeError):
        sealed = other
    assert isinstance(check_text(json.dumps(sealed)), Answer)


def test_loading_raises_only_its_own_errors():
    for error, text in ((Unreadable, "{"), (Unreadable, "[]")):
        with pytest.raises(error):
            load(text)


def test_files_and_exit_codes(tmp_path):
    (tmp_path / "good.json").write_text(json.dumps(GOOD))
    (tmp_path / "bytes.json").write_bytes(b"\xff\xfe")
    assert check_file(tmp_path / "good.json").status == "valid"
    assert check_file(tmp_path / "bytes.json").status == "unreadable"
    assert check_file(tmp_path / "missing.json").status == "unreadable"
    assert check_file(tmp_path).status == "unreadable"
    answers = {name: Answer(name, "", "") for name in ("valid", "invalid", "declined", "unreadable")}
    assert exit_code([answers["valid"]]) == 0
    assert exit_code([answers["valid"], answers["declined"]]) == 3
    assert exit_code([answers["declined"], answers["invalid"]]) == 1
    assert exit_code([answers["invalid"], answers["unreadable"]]) == 2
    assert exit_code([]) == 2


def test_words_cannot_break_out_of_their_line():
    answer = check_text(json.dumps(changed("statement", "text", to='x"\nclaim: [1] = [1]\u2028\u202e')))
    assert answer.status == "valid"
    assert answer.statement.splitlines()[0].startswith("statement one")
    assert sum(part.startswith("claim") for part in answer.statement.splitlines()) == 1


def bundle(*parts):
    body = {"format": "symctrl-certificates/1", "tool": "tests", "parts": list(parts)}
    return {**body, "sha256": digest(body)}


class TestBundles:
    bad = changed("proof", "generators", to=[])

    def test_all_parts_count(self):
        answer = check_text(json.dumps(bundle(GOOD, GOOD)))
        assert answer.status == "valid"
        assert answer.statement.count("a small claim") == 2
        assert "part 2 of 2" in answer.statement

    def test_the_worst_part_counts(self):
        declined = changed("proof", "kind", to="magic")
        for parts, worst in (
            ((GOOD, self.bad), "invalid"),
            ((GOOD, declined), "declined"),
            ((declined, self.bad, GOOD), "invalid"),
            ((self.bad, {**GOOD, "format": "symctrl-certificate/2"}), "unreadable"),
            ((GOOD, None), "unreadable"),
            ((GOOD, bundle(GOOD)), "unreadable"),
            ((), "invalid"),
            ((GOOD,) * 1001, "declined"),
        ):
            assert status(bundle(*parts)) == worst

    def test_its_fields_are_strict(self):
        good = bundle(GOOD)
        assert status(good) == "valid"
        for wrong in (
            {**good, "sha256": GOOD["sha256"]},
            {**good, "tool": "another"},
            {**good, "more": 1},
            {key: value for key, value in good.items() if key != "tool"},
            {**good, "parts": {"1": GOOD}},
            {**good, "parts": [GOOD, GOOD]},
        ):
            assert status(wrong) == "invalid"
        assert status({**good, "format": "symctrl-certificates/2"}) == "unreadable"


def test_the_print_says_how_a_gain_is_meant():
    """A claim about small values must not read as one about all."""
    leaf = {"minors": [{"terms": [["1", [], []]]}]}
    small = certificate(
        {"claim": "return 1 b"},
        {"kind": "definite", "generators": free("b"), "matrix": {"blocks": [leaf, leaf]}},
        scalars={"b": "parameter"},
        claim={"kind": "positive_definite", "matrix": {"blocks": [{"entries": [[0]]}, {"entries": [[1]]}]},
               "listing": "claim", "small": "b"},
        conditions=[],
    )  # fmt: skip
    answer = check_text(json.dumps(small))
    assert answer.status == "valid"
    assert "for all positive b below a bound" in answer.statement
    assert "diag((1), (b)) positive definite" in answer.statement.replace("[", "").replace("]", "")
