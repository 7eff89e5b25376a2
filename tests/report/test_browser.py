"""Pages as Chromium lays them out: no sideways scroll on phones, screens and paper, light and dark."""

from pathlib import Path

import pytest

from symctrl.report import build, gainsblock, rendering, shelf
from symctrl.verify import verify
from tests.gains.samples import crossing, decaying, formation
from tests.report import sample
from tests.report.browser import CHROMIUM, chromium

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium: apt-get install chromium")

ROOT = Path(__file__).parents[2]
PAGES = ["sample", *sorted(path.name for path in (ROOT / "reports").glob("*.html"))]
BEYOND = "[document.documentElement.scrollWidth, document.documentElement.clientWidth]"
PAPER = 680  # px: A4 without the margins of the page


@pytest.fixture(scope="module")
def browser():
    with chromium() as made:
        yield made


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pages")

    def path(name):
        if name != "sample":
            return ROOT / "reports" / name
        made = folder / "sample.html"
        made.write_text(rendering.page(sample.page(), shelf.card(shelf.entry(sample.page(), made.name))))
        return made

    return path


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("width", [360, 700, 1200])
@pytest.mark.parametrize("page", PAGES)
def test_nothing_scrolls_sideways(browser, path, page, width, dark):
    browser.open(path(page), width, dark)
    needed, there = browser.value(BEYOND)
    assert needed <= there == width
    background = browser.value("getComputedStyle(document.body).backgroundColor")
    assert background == ("rgb(22, 23, 25)" if dark else "rgb(253, 252, 249)")


@pytest.mark.parametrize("page", PAGES)
def test_nothing_is_cut_off_on_paper(browser, path, page):
    browser.open(path(page), PAPER)
    browser.printed()
    needed, there = browser.value(BEYOND)
    assert needed <= there
    made = browser.pdf()
    assert made.startswith(b"%PDF")
    assert b"/MediaBox [0 0 594" in made or b"/MediaBox [0 0 595" in made  # A4


def test_the_graph_is_a_drawing_on_screens_and_a_list_on_phones(browser, path):
    shown = "document.querySelector('.{}').getBoundingClientRect().width > 100"
    for width, drawing in [(360, False), (1200, True)]:
        browser.open(path("sample"), width)
        assert browser.value(shown.format("pgs")) is drawing
        assert browser.value(shown.format("gl")) is not drawing


def test_formulas_are_laid_out_as_mathematics(browser, path):
    browser.open(path("sample"), 1200)
    tall = "[...document.querySelectorAll('mfrac')].every(f => f.getBoundingClientRect().height > 15)"
    assert browser.value(tall)


def test_text_has_contrast_where_it_stands(browser, path):
    """The computed colours of chips are those of the palette, on the page's own paper."""
    browser.open(path("sample"), 1200)
    colours = browser.value(
        "[...new Set([...document.querySelectorAll('.vd')].map(e => getComputedStyle(e).color))].sort()"
    )
    palette = {"rgb(11, 90, 134)", "rgb(116, 57, 138)", "rgb(119, 88, 0)", "rgb(168, 50, 15)"}
    assert set(colours) == palette


# Words of a map that are cut off, or that meet others
ASTRAY = """[...document.querySelectorAll('.gm')].flatMap(svg => {
  if (!svg.getBoundingClientRect().width) return []
  const texts = [...svg.querySelectorAll('text')], all = svg.viewBox.baseVal
  const boxes = texts.map(t => t.getBBox())
  const cut = b => b.x < 0 || b.y < 0 || b.x + b.width > all.width || b.y + b.height > all.height
  const meet = (a, b) => a.x < b.x + b.width && b.x < a.x + a.width &&
                         a.y + 3 < b.y + b.height && b.y + 3 < a.y + a.height
  return texts.filter((_, k) => cut(boxes[k]) || boxes.some((b, m) => m !== k && meet(b, boxes[k])))
              .map(t => t.textContent)
})"""


@pytest.mark.parametrize("build_study", [decaying, crossing, formation])
def test_a_map_of_gains_is_drawn_for_each_width(browser, tmp_path, build_study):
    study = build_study()
    report = verify(study)
    page = build.page(report, study, "own.py", "Own", gainsblock.block(report, study, "own.py"))
    (tmp_path / "own.html").write_text(rendering.page(page, shelf.card(shelf.entry(page, "own.html"))))
    shown = "[...document.querySelectorAll('.gm')].map(s => Math.round(s.getBoundingClientRect().width))"
    for width, dark in [(1200, False), (1200, True), (360, False)]:
        browser.open(tmp_path / "own.html", width, dark)
        wide, narrow = browser.value(shown)
        assert (wide > 600 and not narrow) if width == 1200 else (narrow == 328 and not wide)
        assert browser.value(ASTRAY) == []
        assert browser.value(BEYOND)[0] <= width
    fills = "[...document.querySelectorAll('.gm path.f')].map(p => getComputedStyle(p).fill)"
    assert set(browser.value(fills)) == {"rgb(207, 224, 234)"}
    browser.open(tmp_path / "own.html", PAPER)
    browser.printed()
    assert browser.value(ASTRAY) == []
