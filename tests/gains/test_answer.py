"""What is answered as JSON and on a terminal, against the contract of other programs."""

import io
import json
from dataclasses import replace
from fractions import Fraction

import pytest
from rich.console import Console

from symctrl.gains.command import exit_code
from symctrl.gains.show import show
from tests.gains.samples import answered, conditions, crossing, decaying, formation

KEYS = {"study", "graph", "gains", "verdict", "conditions", "boundary", "map", "seconds"}
ALWAYS = {"format", "tool", "inputs_sha256"}
CONDITION = {"id", "statement", "verdict", "margin", "witness"}


def through_json(found):
    return json.loads(json.dumps(found.as_json(), allow_nan=False))


def shown(found, width=100):
    console = Console(file=io.StringIO(), width=width, highlight=False)
    show(found, console)
    return console.file.getvalue()


@pytest.mark.parametrize("build", [crossing, formation, decaying])
def test_the_json_is_that_of_the_contract(build):
    first, second = list(answered(build()).gains)
    body = through_json(answered(build(), f"{first}=1/2:4:6", f"{second}=0.25:2:5"))
    assert set(body) >= KEYS | ALWAYS
    assert body["format"] == "symctrl-gains/1"
    assert len(body["inputs_sha256"]) == 64
    assert all(Fraction(v) for v in body["gains"].values())
    assert body["verdict"] in ("feasible", "infeasible", "undecided")
    for condition in body["conditions"]:
        assert set(condition) >= CONDITION
        assert condition["verdict"] in ("feasible", "infeasible", "undecided")
        assert condition["margin"] is None or str(Fraction(condition["margin"])) == condition["margin"]
        assert condition["witness"] is None or isinstance(condition["witness"], dict)
    assert body["boundary"] is None or isinstance(body["boundary"], str)
    assert body["map"]["axes"] == [
        {"name": first, "lo": "1/2", "hi": "4", "count": 6},
        {"name": second, "lo": "1/4", "hi": "2", "count": 5},
    ]
    assert [len(line) for line in body["map"]["cells"]] == [6] * 5
    assert set("".join(body["map"]["cells"])) <= set("fixu")
    assert isinstance(body["seconds"], float)


def test_the_graph_and_its_largest_eigenvalue_are_in_the_json():
    body = through_json(answered(formation("star:5")))
    assert (body["graph"], body["spectrum"]) == ("star:5", {"low": "5", "high": "5"})
    assert through_json(answered(crossing()))["spectrum"] is None


def test_the_same_inputs_give_the_same_bytes_but_for_the_time():
    one, two = (answered(decaying(), "a=1:3:9", maximize="decay").as_json() for _ in range(2))
    assert one | {"seconds": 0} == two | {"seconds": 0}


def test_the_digest_is_one_of_values_sweeps_and_what_is_asked():
    made = [
        answered(crossing()),
        answered(crossing().at(values={"a": "3"})),
        answered(crossing(), "a=1:3:9"),
        answered(crossing(), "a=1:3:10"),
        answered(crossing(), maximize="margin"),
    ]
    assert len({one.inputs_sha256 for one in made}) == len(made)


def test_exit_codes():
    def unknown(a):
        return 1 / (a - 2) > 0

    assert exit_code(answered(crossing())) == 0
    assert exit_code(answered(crossing().at(values={"b": "5"}))) == 1
    assert exit_code(answered(conditions("open", {"a": "2"}, unknown))) == 3


def test_without_a_sweep_there_is_no_map_and_no_maximum():
    body = through_json(answered(crossing()))
    assert (body["map"], body["maximized"]) == (None, None)


def test_the_terminal_shows_verdict_edge_margin_and_map():
    text = shown(answered(crossing(), "a=1/2:3:8", maximize="margin"))
    assert text.startswith("crossing: ✓ feasible at a = 2, b = 1\n")
    assert "edge: b = a^2; a = 1/b\n" in text
    assert "margin: feasible for all gains within 29.28 % of these\n" in text
    assert "largest margin found: " in text
    assert "of 8 cells\n" in text


def test_a_sentence_is_no_markup():
    study = conditions("marked", {"a": "2"}, lambda a: a > 1)
    sentence = replace(study.conditions["asked"], sentence="The [bold]gain[/bold] is [/] large.")
    study.conditions["asked"] = sentence
    assert "The [bold]gain[/bold] is [/] large.  ✓ holds" in shown(answered(study))
    console = Console(file=io.StringIO(), width=60, force_terminal=True, highlight=False)
    show(answered(study), console)
    assert "[/] large." in console.file.getvalue()


def test_the_terminal_says_what_was_chosen_and_why_it_is_open():
    from tests.gains.test_cases import coupled

    text = shown(answered(coupled()))
    assert "chosen: " in text
    assert "Lambda = 4" in text
    assert "the largest eigenvalue of the Laplacian is 4\n" in text
    open_ = shown(answered(conditions("open", {"a": "2"}, lambda a: 1 / (a - 2) > 0)))
    assert "undecided: an exact box divides by what may be zero" in open_.replace("\n", " ")
