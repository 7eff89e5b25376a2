"""`symctrl gains`: from what was asked on the command line to the answer and its picture."""

from __future__ import annotations

import uuid
from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from symctrl import files, registry
from symctrl.files import InputError
from symctrl.gains.answer import Gains, gains
from symctrl.gains.definite import FAILS, HOLDS, OPEN
from symctrl.gains.maps import parsed
from symctrl.parallel import Request
from symctrl.store import Store, folder

OBJECTIVES = ("decay", "margin")
PICTURES = (".png", ".svg", ".pdf")


@dataclass(frozen=True)
class Asked:
    study: str
    graph: str | None
    values: Mapping[str, str]
    sweeps: tuple[str, ...]
    maximize: str | None
    fresh: bool
    plot: Path | None
    json: str | None = None


def run(asked: Asked, watch: Callable[[str], AbstractContextManager[Callable[[str], None]]]) -> Gains:
    """The answer; the picture is written. Raises InputError, StudyError."""
    axes = [parsed(text) for text in asked.sweeps]
    if asked.maximize is not None and asked.maximize not in OBJECTIVES:
        raise InputError(f"--maximize {asked.maximize}: what can be made largest is decay or margin")
    if asked.plot is not None:
        _refuse_picture(asked.plot, bool(axes), asked.json)
    study = Request(asked.study, asked.graph, asked.values).build()
    store = Store(folder(), run=uuid.uuid4().hex if asked.fresh else "")
    with watch(study.name) as progress, registry.locate(asked.study).blamed():
        found = gains(study, axes, asked.maximize, store, progress)
    if asked.plot is not None:
        from symctrl.gains.plot import plot

        plot(found, asked.plot)
    return found


def _refuse_picture(path: Path, has_map: bool, json: str | None) -> None:
    if not has_map:
        raise InputError(f"--plot {path}: a picture needs a map; add --sweep NAME=LO:HI:COUNT")
    if path.suffix.lower() not in PICTURES:
        raise InputError(f"--plot {path}: the file must end in {', '.join(PICTURES)}")
    if json is not None and Path(json).absolute() == path.absolute():
        raise InputError(f"--plot {path}: is the file that --json writes")
    if find_spec("matplotlib") is None:
        raise InputError("--plot needs matplotlib: pip install 'symctrl[plot]'")
    files.refuse_unwritable(path)


def show(found: Gains) -> None:
    from rich.console import Console

    from symctrl.gains import show as table

    table.show(found, Console(highlight=False))


def exit_code(found: Gains) -> int:
    return {HOLDS: 0, FAILS: 1, OPEN: 3}[found.state]
