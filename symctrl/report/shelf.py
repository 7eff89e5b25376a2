"""The index over all pages of a folder. Each page carries what the index says of it, so that an index can be
made again when one page is.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from html import unescape
from pathlib import Path

from symctrl.report.page import Page

INDEX = "index.html"
_CARD = re.compile(r'<meta name="symctrl-card" content="([^"]*)">')
_HEAD = 20_000  # characters in which the card stands


@dataclass(frozen=True)
class Entry:
    """One study in the index."""

    file: str
    study: str
    title: str
    source: str
    finding: str
    printed: dict[str, int]
    corrected: dict[str, int]


def entry(page: Page, file: str) -> Entry:
    head = page.header
    return Entry(
        file,
        head.study,
        head.title,
        head.source,
        head.lead[0] if head.lead else "",
        {count.chip.word: count.number for count in head.printed},
        {count.chip.word: count.number for count in head.corrected},
    )


def card(entry: Entry) -> str:
    """The entry as one line of JSON."""
    return json.dumps(asdict(entry), sort_keys=True, ensure_ascii=False)


def entries(folder: Path, fresh: Iterable[Entry]) -> tuple[Entry, ...]:
    """Those of the pages in the folder and the fresh ones, by study; other files are left alone."""
    found = {one.file: one for path in sorted(folder.glob("*.html")) if (one := _read(path)) is not None}
    found |= {one.file: one for one in fresh}
    return tuple(sorted(found.values(), key=lambda one: one.study))


def _read(path: Path) -> Entry | None:
    try:
        with path.open(encoding="utf-8") as file:
            match = _CARD.search(file.read(_HEAD))
        return Entry(**{**json.loads(unescape(match[1])), "file": path.name}) if match else None
    except (OSError, UnicodeDecodeError, ValueError, TypeError):
        return None
