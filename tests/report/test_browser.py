"""Pages as Chromium lays them out: no sideways scroll on phones, screens and paper, light and dark."""

from pathlib import Path

import pytest

from symctrl.report import rendering, shelf
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
