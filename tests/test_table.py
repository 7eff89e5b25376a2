"""The table says of every row its verdict in words, at any width, with or without colour."""

import io
import re
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console

from symctrl import table
from symctrl.rows import Discharged, Given, Report, Twins, Units
from tests.samples import row

ANSI = re.compile(r"\x1b\[[0-9;]*m")


def report(*rows, missing=(), graph=None):
    return Report("demo", "A Paper", graph, rows, missing, "0" * 64, 1.0)


def shown(what, *, terminal=None, **options):
    file = io.StringIO()
    console = Console(file=file, width=terminal, force_terminal=terminal is not None, highlight=False)
    table.show(what, console, **options)
    return file.getvalue()


SIDES = "the left side is 4/3, the right is 0"
REFUTED = row("rate", equation="(12)", verdict="refuted", stands=False, reason=SIDES)
VAGUE = row("size", verdict="undecided", stands=False, reason="no certificate up to degree 6", settled=False)
IF = row("end", conditional=True, given=(Given("w is bounded", "signal"), Given("|s| < 1", "trajectory")))


def test_a_pipe_gets_one_line_a_row_without_colour_or_boxes():
    long = row("long", verdict="undecided", stands=False, reason="word " * 30)
    text = shown(report(REFUTED, IF, long))
    lines = text.splitlines()
    assert not ANSI.search(text)
    assert not re.search("[\u2500-\u257f]", text)
    assert [line.split()[:2] for line in lines[1:4]] == [["(12)", "rate"], ["(7)", "end"], ["(7)", "long"]]
    assert lines[1].endswith(SIDES)
    assert lines[3].endswith("word word")
    assert all(line == line.rstrip() for line in lines)


@given(
    st.integers(60, 220),
    st.lists(
        st.tuples(st.sampled_from(sorted(table.MARKS)), st.text("abc é(=1", max_size=300), st.booleans()),
        min_size=1,
        max_size=5,
    ),
)
def test_no_terminal_line_is_too_long_and_every_verdict_stands_in_words(width, kinds):
    rows = [
        row(f"claim{k}", verdict=verdict, reason=reason, stands=stands)
        for k, (verdict, reason, stands) in enumerate(kinds)
    ]
    lines = ANSI.sub("", shown(report(*rows), terminal=width)).splitlines()
    assert max(map(len, lines[:-2])) <= max(width, 62)
    for r in rows:
        (line,) = [line for line in lines if re.search(rf"\b{r.id}\b", line)]
        assert f"{table.MARKS[r.verdict]} {r.verdict}" in line
        assert ("yes" if r.stands else "no") in line.split()


@pytest.mark.parametrize("width", [80, 200])
def test_on_a_terminal_a_verdict_has_a_colour_and_its_reason(width):
    text = shown(report(REFUTED), terminal=width)
    assert "\x1b[31m✗ refuted\x1b[0m" in text
    assert SIDES in ANSI.sub("", text)
    beside = re.search("✗ refuted.*the left side", ANSI.sub("", text))
    assert bool(beside) == (width == 200)


def test_a_condition_about_the_trajectory_is_shown_and_others_are_not():
    line = shown(report(IF)).splitlines()[1]
    assert " if " in line
    assert line.endswith("if |s| < 1")
    assert "w is bounded" not in line


def test_a_proof_that_does_not_stand_says_what_it_needs():
    conditions = (Discharged("m != 0", None), Discharged("s != 0", "an assumption"))
    line = shown(report(row("rate", stands=False, conditions=conditions))).splitlines()[1]
    assert line.endswith("  needs m != 0")


def test_what_is_odd_beside_a_proof_is_shown():
    odd = row("odd", units=Units(False, "sum: m and s"), twins=Twins(3, ("a = -b",)))
    line = shown(report(odd)).splitlines()[1]
    assert line.endswith("units: sum: m and s; twins that hold too: a = -b")


def test_the_summary_counts_and_names_what_is_open():
    text = shown(report(REFUTED, VAGUE, IF, row("fine"), missing=("(3)", "(9)"), graph="ring:4"), numbered=48)
    assert "demo on ring:4: 2 proved, 1 refuted, 1 undecided; 2 of 4 stand (1 conditionally)" in text
    assert "of 48 numbered items of the paper 46 are entered; missing: (3), (9)\n" in text
    assert "not settled: size\n" in text
    assert "not settled: size, end\n" in shown(report(VAGUE, IF), strict=True)
    assert "not settled" not in shown(report(REFUTED, IF))
    assert "of 3 numbered items of the paper 3 are entered\n" in shown(report(IF), numbered=3)
    assert "numbered" not in shown(report(IF))


def test_a_report_without_rows_says_so():
    assert "demo: no claims; 0 of 0 stand" in shown(report())


def test_the_tree_nests_what_a_claim_rests_on():
    rows = (
        row("V", form="definition"),
        row("rate", rests_on=("V",), verdict="refuted", stands=False),
        row("end", rests_on=("rate", "V", "elsewhere"), conditional=True),
    )
    assert shown(report(*rows), tree=True).splitlines()[:5] == [
        "- (7) end: ✓ proved, stands conditionally",
        "  - (7) rate: ✗ refuted, does not stand",
        "    - (7) V: ✓ proved",
        "  - (7) V: ✓ proved",
        "  - elsewhere: not decided in this run",
    ]


@given(st.dictionaries(st.integers(0, 5), st.lists(st.integers(0, 5), max_size=3), min_size=1))
def test_every_claim_is_in_the_tree_and_the_tree_ends(graph):
    rows = [row(f"c{k}", rests_on=tuple(f"c{j}" for j in below)) for k, below in graph.items()]
    text = shown(report(*rows), tree=True)
    for r in rows:
        assert f"(7) {r.id}: " in text


def test_what_is_said_of_a_row_is_cut_and_never_lost_in_the_middle_of_the_table():
    formula = "x*" * 400
    row_ = replace(IF, verdict="refuted", stands=False, reason=formula, settled=True)
    needy = row("needy", stands=False, conditions=(Discharged(formula + "y != 0", None),))
    lines = shown(report(row_, needy)).splitlines()
    assert all(len(line) < 260 for line in lines)
    assert [line.endswith("…") for line in lines[1:3]] == [True, True]


def test_a_finding_is_said_once_with_all_that_it_is_about():
    found = [replace(REFUTED, id=name, finding="Check twice.") for name in ("first", "other")]
    holds = row("third", finding="Never said.")
    text = shown(report(*found, holds))
    assert "  first, other: Check twice.\n" in text
    assert text.count("Check twice.") == 1
    assert "Never said." not in text
