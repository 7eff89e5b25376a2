"""Signs by cases: both cases must be shown, each by what holds in it alone."""

import pytest

from symctrl.kernel.certificate import Invalid
from tests.kernel.programs import assume, program, statement, verify

X = [["1", 0, 1]]
MINUS_X = [["-1", 0, 1]]
SIZE = [["1", 2, 1]]
ROOT = [["1", 3, 1]]
BOTH = [{"terms": [["2", [X], []]]}, {"terms": []}]  # of |x| + x


def prove(
    *entries, value=("+", ("FABS", "x"), "x"), kind="nonnegative", given=(), more=(), hints=(), **listings
):
    stated = statement(
        {"kind": kind, "shape": [1, 1]},
        {"claim": program(value), **listings},
        ["x", "y"] if "y" in str((value, listings)) else ["x"],
        given,
    )
    free = [{"free": name} for name in (("x", "y") if "y" in stated["scalars"] else ("x",))]
    size = len(free)
    table = [*free, {"abs": X}, *more]
    hint = {"is": [[[], [["1", size, 1]]]]}
    proof = {"kind": "combination", "generators": table, "factors": [], "hints": [hint, *hints]}
    verify(stated, {**proof, "entries": list(entries)})


def by(*cases, k=1):
    return {"by": k, "cases": list(cases)}


def test_both_cases_are_shown():
    prove(by(*BOTH))


@pytest.mark.parametrize(
    "cases",
    [
        BOTH[::-1],
        BOTH[:1],
        [*BOTH, BOTH[1]],
        [BOTH[0], None],
        [None, BOTH[1]],
        [None, None],
        [BOTH[0], BOTH[0]],
        [BOTH[1], BOTH[1]],
        [{"terms": [["2", [MINUS_X], []]]}, BOTH[1]],
        [{"terms": [["2", [X], []]], "times": [[["-1"]]]}, BOTH[1]],
    ],
)
def test_near_misses(cases):
    with pytest.raises(Invalid):
        prove(by(*cases))


@pytest.mark.parametrize("k", [0, 2, -1, True, "1", None])
def test_cases_are_of_an_absolute_value(k):
    with pytest.raises(Invalid):
        prove(by(*BOTH, k=k))


def test_an_entry_with_cases_has_nothing_else():
    with pytest.raises(Invalid, match="unknown field"):
        prove({**by(*BOTH), "terms": []})
    with pytest.raises(Invalid, match="unknown field"):
        prove({**by(*BOTH), "times": []})


def test_what_may_be_zero_in_a_case_is_not_positive_there():
    with pytest.raises(Invalid, match="certainly positive"):
        prove(by(*BOTH), kind="positive")


def test_a_case_that_never_occurs_is_left_out_and_only_that():
    """x > 0: there is no second case; x >= 0 leaves x = 0."""
    positive = {"given": [assume("positive", "g")], "g": program("x"), "value": ("-", ("FABS", "x"), "x")}
    prove(by({"terms": []}, None), **positive)
    with pytest.raises(Invalid, match="never occurs"):
        prove(by({"terms": []}, {"terms": [["2", [MINUS_X], []]]}), **positive)
    may_be_zero = {**positive, "given": [assume("nonnegative", "g")]}
    with pytest.raises(Invalid, match="not excluded"):
        prove(by({"terms": []}, None), **may_be_zero)
    prove(by({"terms": []}, {"terms": [["2", [MINUS_X], []]]}), **may_be_zero)


def test_what_a_case_supposes_is_forgotten_after_it():
    """Two entries: the second may not use that x >= 0."""
    value = program(("+", ("FABS", "x"), "x"), "x")
    stated = statement({"kind": "nonnegative", "shape": [2, 1]}, {"claim": value}, ["x"])
    table = {
        "generators": [{"free": "x"}, {"abs": X}],
        "factors": [],
        "hints": [{"is": [[[], [["1", 1, 1]]]]}],
    }
    entries = [by(*BOTH), {"terms": [["1", [X], []]]}]
    with pytest.raises(Invalid, match="not known"):
        verify(stated, {"kind": "combination", **table, "entries": entries})


def test_a_switch_that_is_on_in_a_case_is_forgotten_after_it():
    """1 - x - |x| is 1 where x <= 0, and 0 at x = 1/2: there the square of its sign is not 1."""
    turning = [["-1", 1, 1], ["-1", 0, 1], ["1"]]
    sign = ("SIGN", ("-", ("-", 1, "x"), ("FABS", "x")))
    value = program(("+", ("FABS", "x"), "x"), ("-", ("SQ", sign), 1))
    stated = statement({"kind": "nonnegative", "shape": [2, 1]}, {"claim": value}, ["x"])
    table = {
        "generators": [{"free": "x"}, {"abs": X}, {"abs": turning}, {"sign": turning, "abs": 2}],
        "factors": [],
        "hints": [{"is": [[[], [["1", k, 1]]]]} for k in (1, 3)],
    }
    with pytest.raises(Invalid, match="sides differ"):
        verify(stated, {"kind": "combination", **table, "entries": [by(*BOTH), {"terms": []}]})


def test_a_root_is_not_real_because_of_a_case():
    """sqrt x, used for the first time where x >= 0, would be used without a condition."""
    root = {"root": 2, "of": X}
    entries = by({"terms": [["2", [], [[["1", 2, 1]]]]]}, BOTH[1])
    with pytest.raises(Invalid, match="first time in a case"):
        prove(entries, more=[root])


def test_a_case_inside_its_own_case_says_no_more():
    inner = by(BOTH[0], BOTH[0])
    prove(by(inner, BOTH[1]))
    with pytest.raises(Invalid):
        prove(by(by(None, BOTH[1]), BOTH[1]))


def test_saturation_is_told_apart_by_nested_sizes():
    """min(|x|, 1) >= 0, as |x| + 1 - ||x| - 1| >= 0."""
    value = ("-", ("+", ("FABS", "x"), 1), ("FABS", ("-", ("FABS", "x"), 1)))
    inner = [["1", 1, 1], ["-1"]]
    table = [{"abs": inner}]
    hint = {"is": [[[], [["1", 2, 1]]]]}
    shown = by({"terms": [["2", [], []]]}, {"terms": [["2", [[["1", 1, 1]]], []]]}, k=2)
    prove(shown, value=value, more=table, hints=[hint])
    with pytest.raises(Invalid):
        prove(shown, value=("-", value, "1/100"), more=table, hints=[hint])


def of_logarithm(*lemmas, then=None, k=1):
    """log(1 + x^2) >= 0, after x^2 >= 0."""
    stated = statement(
        {"kind": "nonnegative", "shape": [1, 1]},
        {"claim": program(("LOG", ("+", ("SQ", "x"), "y")))},
        ["x", "y"],
    )
    inside = [["1", 0, 2], ["1", 1, 1]]
    table = [{"free": "x"}, {"free": "y"}, {"function": "log", "of": [[[[], inside]]]}]
    proof = {
        "kind": "combination",
        "generators": table,
        "factors": [],
        "hints": [{"is": [[[], [["1", 2, 1]]]]}],
    }
    entry = {"lemmas": list(lemmas), "then": then or {"terms": [["1", [[["1", 2, 1]]], []]]}}
    verify(stated, {**proof, "entries": [entry]})


ABOVE = [["1", 0, 2], ["1", 1, 1], ["-1"]]


@pytest.mark.parametrize(
    "lemma",
    [
        ["nonnegative", ABOVE, {"terms": [["1", [], [X]]]}],
        ["nonnegative", ABOVE, {"terms": []}],
        ["nonnegative", [["1", 0, 2]], {"terms": [["1", [], [X]]]}],
        ["nonzero", [["1", 0, 2]], {"terms": [["1", [], [X]]]}],
        ["positive", [["1", 0, 2]], {"terms": [["1", [], [X]]]}],
        ["nonnegative", [["-1", 0, 2]], {"terms": [["1", [], [X]]]}],
        ["nonnegative", [], {"terms": []}],
        ["nonnegative", ABOVE],
    ],
)
def test_a_lemma_that_is_false_or_says_too_little(lemma):
    """log(x^2 + y) has no sign."""
    with pytest.raises(Invalid):
        of_logarithm(lemma)


def test_a_lemma_is_shown_before_it_is_used():
    value = ("LOG", ("+", ("SQ", "x"), 1))
    stated = statement({"kind": "nonnegative", "shape": [1, 1]}, {"claim": program(value)}, ["x"])
    table = [{"free": "x"}, {"function": "log", "of": [[[[], [["1", 0, 2], ["1"]]]]]}]
    proof = {
        "kind": "combination",
        "generators": table,
        "factors": [],
        "hints": [{"is": [[[], [["1", 1, 1]]]]}],
    }
    then = {"terms": [["1", [[["1", 1, 1]]], []]]}
    lemma = ["nonnegative", [["1", 0, 2]], {"terms": [["1", [], [X]]]}]
    verify(stated, {**proof, "entries": [{"lemmas": [lemma], "then": then}]})
    circular = ["nonnegative", [["1", 1, 1]], {"lemmas": [], "then": {"terms": [["-1", [], [X]]]}}]
    with pytest.raises(Invalid):
        verify(stated, {**proof, "entries": [{"lemmas": [circular], "then": then}]})
