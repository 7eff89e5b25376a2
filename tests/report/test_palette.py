"""The contrast of the palette: AA of WCAG 2 on paper and on tinted boxes, in light, dark and print."""

import re
from importlib.resources import files

import pytest

STYLE = (files("symctrl.report") / "templates" / "page.css").read_text("utf-8")
TEXT = ("ink", "soft", "proved", "refuted", "ill", "und")
PALETTES = [
    dict(re.findall(r"--(\w+):(#\w+)", block)) for block in re.findall(r":root\{(.*?)\}", STYLE, re.S)
]


def luminance(colour):
    digits = colour[1:] if len(colour) == 7 else "".join(2 * digit for digit in colour[1:])
    parts = [int(digits[k : k + 2], 16) / 255 for k in (0, 2, 4)]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one, other):
    bright, dark = sorted((luminance(one), luminance(other)), reverse=True)
    return (bright + 0.05) / (dark + 0.05)


def test_black_on_white_is_as_it_is_known():
    assert contrast("#000000", "#fff") == pytest.approx(21)


@pytest.mark.parametrize("palette", PALETTES, ids=["light", "dark", "print"])
def test_text_can_be_read_on_everything_that_is_under_it(palette):
    assert set(TEXT) < set(palette)
    for under in ("paper", "tint"):
        assert all(contrast(palette[name], palette[under]) >= 4.5 for name in TEXT)
    for tint in ("ins", "del"):
        assert contrast(palette["ink"], palette[tint]) >= 4.5


@pytest.mark.parametrize("palette", PALETTES, ids=["light", "dark", "print"])
def test_names_on_a_map_can_be_read(palette):
    for name, under in [("ink", "gf"), ("ink", "gi"), ("proved", "gf"), ("soft", "gi")]:
        assert contrast(palette[name], palette[under]) >= 4.5
    assert contrast(palette["paper"], palette["gu"]) >= 4.5
