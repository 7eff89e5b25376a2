"""The gains of a study on its page: the map as it is drawn, the words about it, the conditions in a table."""

import re
import shlex
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from html import unescape

import numpy as np
import pytest

from symctrl import Study, claim, nonnegative, tends
from symctrl.gains import theorem as of_theorem
from symctrl.gains.maps import Axis, Map, parsed
from symctrl.report import build, gainsblock, gainsmap, rendering, shelf
from symctrl.verify import verify
from tests.gains.samples import answered, conditions, crossing, decaying, formation
from tests.report import sample
from tests.report.markup import faults

RUN = re.compile(r"M(\d+) (\d+)h(\d+)v(\d+)H(\d+)")
WORDS = {"f": "feasible", "i": "not covered by the proof", "u": "undecided"}
REPORTS = {}


def made(build_study):
    """The study, its report and its block, each once."""
    if build_study not in REPORTS:
        study = build_study()
        report = verify(study)
        REPORTS[build_study] = study, report, gainsblock.block(report, study, "own.py")
    return REPORTS[build_study]


def painted(svg, shape):
    """How often each cell is painted in each class, read off the drawing."""
    found = {}
    for name, path in re.findall(r'<path class="(\w)" d="([^"]*)"', svg):
        assert name not in found
        assert RUN.sub("", path) == ""
        found[name] = np.zeros(shape, int)
        for x, y, w, h, back in (map(int, run) for run in RUN.findall(path)):
            assert back == x
            found[name][y : y + h, x : x + w] += 1
    return found


def sweeps_of(block):
    """Those of the command that the page shows."""
    words = shlex.split(" ".join(block.command))
    return [words[k + 1] for k, word in enumerate(words) if word == "--sweep"]


@pytest.mark.parametrize("build_study", [decaying, crossing, formation])
def test_the_drawings_show_the_cells_of_the_command(build_study):
    study, _, block = made(build_study)
    sweeps = sweeps_of(block)
    assert [parsed(sweep).count for sweep in sweeps] == [240, 160]
    rows = answered(study, *sweeps).map.cells
    letters = np.array([list(row) for row in rows])
    for svg in (block.wide, block.narrow):
        found = painted(svg, letters.shape)
        assert set(found) == set(letters.ravel())
        for name, count in found.items():
            assert (count == (letters == name)).all()


@pytest.mark.parametrize("seed", range(20))
def test_runs_cover_each_cell_once(seed):
    cells = np.random.default_rng(seed).random((1 + seed % 5, 7)) < 0.6
    count = np.zeros(cells.shape, int)
    for x, y, w, h in gainsmap.rectangles(cells):
        assert w > 0 < h
        count[y : y + h, x : x + w] += 1
    assert (count == cells).all()


def test_equal_runs_above_each_other_are_one():
    cells = np.array([[0, 1, 1, 0], [0, 1, 1, 0], [1, 1, 1, 0], [0, 1, 1, 0], [1, 0, 0, 1]], bool)
    runs = [(1, 0, 2, 2), (0, 2, 3, 1), (1, 3, 2, 1), (0, 4, 1, 1), (3, 4, 1, 1)]
    assert gainsmap.rectangles(cells) == runs
    assert gainsmap.rectangles(np.zeros((3, 3), bool)) == []
    assert gainsmap.rectangles(np.ones((3, 4), bool)) == [(0, 0, 4, 3)]


@pytest.mark.parametrize("build_study", [decaying, crossing])
def test_the_label_says_what_is_seen(build_study):
    study, _, block = made(build_study)
    label = unescape(re.search(r'role="img" aria-label="([^"]*)"', block.wide)[1])
    assert label == unescape(re.search(r'role="img" aria-label="([^"]*)"', block.narrow)[1])
    first, second = (parsed(sweep) for sweep in sweeps_of(block))
    assert f"Map of {first.name} from {float(first.lo):g} to {float(first.hi):g}" in label
    assert f"{second.name} from {float(second.lo):g} to {float(second.hi):g}" in label
    rows = answered(study, *sweeps_of(block)).map.cells
    count, total = Counter("".join(rows)), sum(map(len, rows))
    words = WORDS if build_study is decaying else WORDS | {"i": "a condition fails"}
    for letter, word in words.items():
        share = Fraction(re.search(rf"{word} ([\d.]+)\N{{NO-BREAK SPACE}}%", label)[1]) / 100
        there = Fraction(count[letter], total)
        assert (
            there <= share < there + Fraction(1, 1000)
            if letter == "u"
            else there - Fraction(1, 1000) < share <= there
        )
    assert re.search(r"The study's gains, a = 2\b.* and b = 1\b.*: feasible\.", label)


def test_the_caption_names_the_theorem_and_calls_its_conditions_sufficient():
    _, _, block = made(decaying)
    assert 'Where <a href="#c-decay">theorem</a> applies' in block.caption
    assert "conditions are sufficient" in block.caption
    assert "not thereby unstable" in block.caption
    _, _, named = made(formation)
    assert "on the graph ring:6" in named.caption
    assert "sufficient" not in named.caption
    assert "one of them fails" in named.caption


def test_axes_have_units_and_round_ends():
    _, _, block = made(decaying)
    text = unescape(re.sub(r"<[^>]*>", " ", block.wide))
    assert text.count("s⁻¹") == 2
    assert all(word in text for word in ("feasible", "not covered by the proof", "the study: feasible"))
    assert [sweep.partition("=")[2] for sweep in sweeps_of(block)] == ["1/20:5:240", "1/40:5/2:160"]


@pytest.mark.parametrize(
    ("value", "round_"), [("4", "4"), ("3/4", "4/5"), ("1/100", "1/100"), ("0.0101", "0.012"), ("101", "120")]
)
def test_round_ends(value, round_):
    assert gainsmap.ceiling(Fraction(value)) == Fraction(round_)


@pytest.mark.parametrize(
    ("lo", "hi", "values"),
    [
        ("1/25", "4", "1 2 3 4"),
        ("1/20", "5", "1 2 3 4 5"),
        ("1/125", "4/5", "1/5 2/5 3/5 4/5"),
        ("1/10000", "1/100", "1/500 1/250 3/500 1/125 1/100"),
        ("12", "1200", "200 400 600 800 1000 1200"),
    ],
)
def test_ticks_are_round_and_inside(lo, hi, values):
    assert gainsmap.ticks(Fraction(lo), Fraction(hi), 6) == [Fraction(v) for v in values.split()]


def test_numbers_are_short():
    assert [gainsmap.plain(Fraction(v)) for v in ("1/25", "4", "2000000", "1/200000")] == [
        "0.04", "4", "2 · 10⁶", "5 · 10⁻⁶",
    ]  # fmt: skip
    assert gainsmap.exact(Fraction(1, 3)) == "1/3"
    assert gainsmap.exact(Fraction(10**9, 10**9 * 3 + 1)) == "≈ 0.3333"


def test_margins_are_rounded_to_the_safe_side():
    value = Fraction(2 * 10**9, 3 * 10**9 + 1)
    assert Fraction(gainsblock.at_least(value)) <= value <= Fraction(gainsblock.at_most(value))
    assert gainsblock.at_least(value) == "0.6666"
    assert gainsblock.at_most(value) == "0.6667"
    assert gainsblock.at_least(-value) == "−0.6667"
    assert gainsblock.at_least(Fraction(2, 5)) == "2/5"


def test_conditions_have_verdict_margin_and_place():
    _, _, block = made(decaying)
    assert [(one.chip.shape, one.chip.word) for one in block.bounds] == [("proved", "holds")] * 3
    assert [one.margin for one in block.bounds] == ["≥ 3", "≥ 1", "≥ 1\N{NO-BREAK SPACE}s⁻¹"]
    assert [one.source.target for one in block.bounds] == ["c-decay", "c-decay", None]
    assert [fact.name for fact in block.facts] == ["Edge, exactly", "Relative margin"]
    assert "<msup><mi>a</mi><mn>2</mn></msup>" in block.facts[0].value


def test_a_sum_over_neighbours_has_the_unit_of_its_terms():
    def built():
        study = Study("measured")
        k, beta = study.gain("k", "2", unit="s^-2"), study.gain("beta", "3/10", unit="s^-2")
        fleet = study.fleet(default="ring:6")

        @study.condition("(2)")
        def damped(i):
            """Every craft is damped."""
            return k - beta * fleet.degree(i) >= 0

        return study

    _, _, block = made(built)
    assert block.bounds[0].margin == "≥ 7/5\N{NO-BREAK SPACE}s⁻²"


def test_gains_of_a_study_that_fail_are_shown_as_such():
    study = crossing().at(values={"b": "5"})
    block = gainsblock.block(verify(study), study, "own.py")
    assert {one.chip.word for one in block.bounds} == {"fails", "holds"}
    assert 'href="#refuted"' in block.wide
    assert "the study: a condition fails" in block.wide
    assert [fact.name for fact in block.facts] == ["Edge, exactly"]


def test_one_gain_is_a_bar():
    def small(a):
        return 3 - a > 0

    study = conditions("small", {"a": "2"}, small)
    block = gainsblock.block(verify(study), study, "own.py")
    assert sweeps_of(block) == ["a=1/20:5:240"]
    found = painted(block.wide, (1, 240))
    cells = Counter(answered(study, "a=1/20:5:240").map.cells[0])
    assert {name: int(count.sum()) for name, count in found.items()} == dict(cells)


def test_a_study_without_conditions_or_values_has_no_gains():
    assert gainsblock.block(sample.report(), sample.study(), "spring.py") is None

    def small(a, b):
        return a - b > 0

    study = conditions("unknown", {"a": None, "b": None}, small)
    assert gainsblock.block(verify(study), study, "own.py") is None
    half = conditions("half", {"a": "2", "b": None}, small)
    block = gainsblock.block(verify(half), half, "own.py")
    assert block is None or sweeps_of(block) == ["a=1/20:5:240"]


def test_a_report_decides_its_theorem_once(monkeypatch):
    study, report, _ = made(decaying)

    def known(study, only, store, progress, decided):
        assert {row.id for row in report.rows} <= set(decided)
        return verify(study, only, store, progress, decided)

    monkeypatch.setattr(of_theorem, "verify", known)
    monkeypatch.setattr("symctrl.verify.decide", lambda *_: pytest.fail("was decided again"))
    assert gainsblock.block(report, study, "own.py") is not None


def test_the_block_is_sound_in_a_page_and_the_same_again():
    study, report, block = made(decaying)
    page = build.page(report, study, "own.py", "Decay", block)
    text = rendering.page(page, shelf.card(shelf.entry(page, "own.html")))
    assert faults(text) == []
    assert text.count('class="gm" role="img"') == 2
    again = gainsblock.block(replace(report, seconds=9.0), decaying(), "own.py")
    assert again == block


def test_percentages_are_rounded_to_the_safe_side():
    axes = (Axis("a", Fraction(0), Fraction(1), 3000),)
    cells = np.ones((1, 3000), np.int8)
    assert gainsblock.shares(Map(axes, cells)) == {
        1: "100\N{NO-BREAK SPACE}%",
        -1: "0\N{NO-BREAK SPACE}%",
        0: "0\N{NO-BREAK SPACE}%",
    }
    cells[0, 0], cells[0, 1:32] = 0, -1
    assert list(gainsblock.shares(Map(axes, cells)).values()) == [
        f"{share}\N{NO-BREAK SPACE}%" for share in ("98.9", "1.0", "0.1")
    ]


def test_a_path_with_spaces_is_quoted():
    study, report, _ = made(decaying)
    block = gainsblock.block(report, study, "my folder/own.py")
    assert shlex.split(" ".join(block.command))[:3] == ["symctrl", "gains", "my folder/own.py"]


def test_what_is_written_is_text_and_no_markup():
    axes = (Axis("a", Fraction(0), Fraction(1), 4), Axis("b", Fraction(0), Fraction(1), 2))
    cells = Map(axes, np.array([[1, 1, 0, -1], [1, 0, -1, -1]], np.int8))
    scene = gainsmap.Scene(
        cells, ("a_{<b>}", r"\bar{\alpha}"), ("<s>", ""), (Fraction(1, 8), Fraction(1, 4)), 1,
        {1: "f & g", -1: "i", 0: "u"}, 'a "label"',
    )  # fmt: skip
    for size in (gainsmap.WIDE, gainsmap.NARROW):
        svg = gainsmap.draw(scene, size)
        assert "&lt;s&gt;" in svg
        assert "<s>" not in svg
        assert "<b>" not in svg
        assert "the study: f &amp; g" in svg
        assert 'aria-label="a &quot;label&quot;"' in svg
        assert "α\u0304" in svg
        assert painted(svg, (2, 4)).keys() == {"f", "i", "u"}


def test_subscripts_are_lowered_and_the_line_goes_on_where_it_was():
    text = gainsmap.spans("K_{o}")
    assert re.sub(r"<[^>]*>", "", text).strip("\N{ZERO WIDTH SPACE}") == "Ko"
    assert sum(int(move) for move in re.findall(r'dy="(-?\d+)"', text)) == 0
    assert "dy" not in gainsmap.spans("a")


def test_a_theorem_that_needs_what_has_no_value_has_a_map_all_the_same():
    """The constant is one that may be chosen."""
    study = Study("choosing")
    x = study.state("x")
    a, b = study.gain("a", "2"), study.gain("b", "1")
    e = study.gain("e")
    study.motion(x, -(a + b) * x)

    @study.claimed("theorem")
    def vanishes():
        """x tends to zero."""
        return claim(given=[nonnegative(a - b - e)], then=[tends(x)])

    @study.argument(vanishes)
    def by_barbalat(run):
        run.falls(x**2 / 2, by=(a + b) * x**2)
        run.barbalat(x, of=(a + b) * x**2)

    report = verify(study)
    block = gainsblock.block(report, study, "own.py")
    assert block is not None
    assert [sweep.partition("=")[0] for sweep in sweeps_of(block)] == ["a", "b"]
    chosen = next(fact for fact in block.facts if fact.name.startswith("Constants"))
    assert "<mi>e</mi><mo>=</mo>" in chosen.value
