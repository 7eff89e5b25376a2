"""`symctrl report`: studies are decided, their pages made, and files written, each whole or not at all."""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from pathlib import Path

from symctrl import files, registry, runs
from symctrl.certify import tool
from symctrl.files import InputError
from symctrl.parallel import Request
from symctrl.report import build, gainsblock, rendering, shelf
from symctrl.report.page import Gains
from symctrl.report.shelf import INDEX
from symctrl.rows import Report
from symctrl.store import Store, folder
from symctrl.study import Study

Watch = Callable[[str], AbstractContextManager[Callable[[str], None]]]


def write(names: Sequence[str], out: Path, watch: Watch) -> list[Path]:
    """A page for each study in `out`, and the index over all pages there; the paths written.

    Raises InputError: for a folder that cannot be written before anything is decided.
    """
    requests = [Request(name, None, {}) for name in names]
    decided = runs.decide(requests, None, jobs=None, fresh=False, watch=watch)
    files.refuse_unwritable_folder(out)
    pages: list[tuple[str, shelf.Entry, str]] = []
    for name, (study, report) in zip(names, decided, strict=True):
        made = build.page(report, study, name, title(name, study.name), _gains(name, study, report, watch))
        file = f"{runs.file_name(study.name)}.html"
        if file == INDEX:
            raise InputError(f"study {study.name}: its page would be the index; give the study another name")
        entry = shelf.entry(made, file)
        pages.append((file, entry, rendering.page(made, shelf.card(entry))))
    return _written(out, pages)


def _gains(name: str, study: Study, report: Report, watch: Watch) -> Gains | None:
    with watch(study.name) as progress, registry.locate(name).blamed():
        return gainsblock.block(report, study, name, Store(folder()), progress)


def title(asked: str, study: str) -> str:
    """The first line of the study's text, or its name."""
    text = ast.get_docstring(ast.parse(registry.locate(asked).origin.read_bytes())) or ""
    return text.strip().split("\n")[0].rstrip(".") or study.replace("_", " ")


def _written(out: Path, pages: Sequence[tuple[str, shelf.Entry, str]]) -> list[Path]:
    try:
        out.mkdir(parents=True, exist_ok=True)
        for file, _, text in pages:
            files.write(out / file, text)
        entries = shelf.entries(out, [entry for _, entry, _ in pages])
        files.write(out / INDEX, rendering.index(entries, tool()))
    except OSError as error:
        raise InputError(f"{error.filename or out}: cannot be written: {error.strerror}") from None
    return [*(out / file for file, _, _ in pages), out / INDEX]
