"""From a page as data to HTML: the templates, with the style inside, so that a page is one file."""

from __future__ import annotations

from functools import cache
from importlib.resources import files as resources
from typing import Any

from markupsafe import Markup

from symctrl.report.page import Page
from symctrl.report.prose import prose
from symctrl.report.shelf import Entry


def page(made: Page, card: str) -> str:
    """The page. card: what an index says of it, as JSON."""
    return _rendered("page.html.j2", page=made, card=card)


def index(entries: tuple[Entry, ...], tool: str) -> str:
    return _rendered("index.html.j2", entries=entries, tool=tool)


def _rendered(template: str, **what: Any) -> str:
    text: str = _environment().get_template(template).render(style=_style(), **what)
    return text


@cache
def _environment() -> Any:
    import jinja2

    made = jinja2.Environment(
        loader=jinja2.PackageLoader("symctrl.report"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters["prose"] = prose
    return made


@cache
def _style() -> Markup:
    """The style sheet, without what only its readers need."""
    text = (resources("symctrl.report") / "templates" / "page.css").read_text("utf-8")
    return Markup("\n".join(line.strip() for line in text.splitlines() if line.strip()))
