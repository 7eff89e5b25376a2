"""The map of gains as a picture: what is where is written where it is."""

from __future__ import annotations

import re
from collections.abc import Iterator
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symctrl import files
from symctrl.files import InputError
from symctrl.gains.definite import FAILS, HOLDS, OPEN
from symctrl.latex import name_latex

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from symctrl.gains.answer import Gains
    from symctrl.gains.maps import Map

COLOURS = {FAILS: "#f3efe6", OPEN: "#787267", HOLDS: "#cfe0ea"}  # as in the report
WORDS = {HOLDS: "feasible", FAILS: "infeasible", OPEN: "undecided"}
INK, PAPER = "#1c1b19", "#ffffff"
WIDTH, HIGH, LOW, DPI = 6.4, 4.6, 1.5, 150  # a map of one gain is low
MOST_PIXELS = 2000  # of the picture on a side: of finer cells one in a few is shown, undecided ones first
COARSE = 160  # cells on a side, in which the room for words is looked for
TEXT = 0.035, 0.05  # half the width of a letter's line, as a part of the picture: for six letters, and across
POINT = 0.07  # the room of the study's point
EDGES = 3  # of a map of one gain that are written out


def plot(found: Gains, path: Path) -> None:
    """Write the picture in the format of the file's suffix. Raises InputError."""
    try:
        files.write_bytes(path, drawn(found, path.suffix.lower().lstrip(".")))
    except OSError as error:
        raise InputError(f"--plot {path}: cannot be written: {error.strerror}") from None


def drawn(found: Gains, form: str) -> bytes:
    """The picture as png, svg or pdf."""
    from matplotlib import rc_context
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    assert found.map is not None
    figure = Figure(figsize=(WIDTH, HIGH if len(found.map.axes) > 1 else LOW), dpi=DPI, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    _cells(axes, found.map)
    free = _study(axes, found)
    _words(axes, found.map, free)
    _edge(axes, found)
    content = BytesIO()
    with rc_context({"svg.hashsalt": "symctrl"}):
        figure.savefig(content, format=form, metadata=_METADATA.get(form))
    return content.getvalue()


_METADATA = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}


def _cells(axes: Axes, made: Map) -> None:
    from matplotlib.colors import ListedColormap

    colours = ListedColormap([COLOURS[k] for k in (FAILS, OPEN, HOLDS)])
    extent = _extent(made)
    axes.imshow(
        thinned(made.states, MOST_PIXELS),
        origin="lower",
        extent=extent,
        aspect="auto",
        cmap=colours,
        vmin=FAILS,
        vmax=HOLDS,
        interpolation="nearest",
    )
    axes.tick_params(colors=INK, labelsize=9)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    axes.set_xlabel(_letter(made.axes[0].name), fontsize=11)
    if len(made.axes) > 1:
        axes.set_ylabel(_letter(made.axes[1].name), fontsize=11, rotation=0, ha="right")
    else:
        axes.set_yticks([])
        axes.spines["left"].set_visible(False)


def _extent(made: Map) -> tuple[float, float, float, float]:
    first, second = made.axes[0], made.axes[1] if len(made.axes) > 1 else None
    return float(first.lo), float(first.hi), *((float(second.lo), float(second.hi)) if second else (0.0, 1.0))


def _study(axes: Axes, found: Gains) -> Any:
    """The study's own gains as a point; and what is free of it on a coarse grid."""
    at = place(found)
    if at is None:
        return beside(None)
    x, y = at
    right = is_left(x)
    axes.plot([x], [y], "o", color=INK, markersize=5, transform=axes.transAxes, clip_on=False)
    where: dict[str, Any] = {"xycoords": "axes fraction", "textcoords": "offset points", "va": "center"}
    where |= {"xytext": (7, 0), "ha": "left"} if right else {"xytext": (-7, 0), "ha": "right"}
    axes.annotate("the study", at, fontsize=9, color=INK, **where)
    return beside(at, len(found.map.axes) > 1 if found.map is not None else True)


def place(found: Gains) -> tuple[float, float] | None:
    """Where the study's own gains are, as parts of the map; None where they are outside."""
    assert found.map is not None
    at = []
    for axis in found.map.axes:
        value = found.gains.get(axis.name)
        if value is None or not axis.lo <= value <= axis.hi:
            return None
        at.append(float((value - axis.lo) / (axis.hi - axis.lo)))
    return at[0], at[1] if len(at) > 1 else 0.5


def is_left(x: float) -> bool:
    """Is there room for a point's name on its right?"""
    return x < 1 - 3 * POINT


def beside(at: tuple[float, float] | None, high: bool = True) -> Any:
    """What is free of a point and its name on a coarse grid; of a strip all of the height."""
    free = np.ones((COARSE, COARSE), bool)
    if at is None:
        return free
    x, y = at
    grid = (np.arange(COARSE) + 0.5) / COARSE
    before, after = (POINT, 3 * POINT) if is_left(x) else (3 * POINT, POINT)
    across = (grid > x - before) & (grid < x + after)
    near = np.abs(grid - y) < POINT if high else np.ones(COARSE, bool)
    free[np.ix_(near, across)] = False
    return free


def _words(axes: Axes, made: Map, free: Any) -> None:
    for state, x, y in rooms(made, free):
        colour = PAPER if state == OPEN else INK
        where: dict[str, Any] = {"transform": axes.transAxes, "ha": "center", "va": "center"}
        axes.text(x, y, WORDS[state], color=colour, fontsize=10, **where)


def rooms(made: Map, free: Any) -> Iterator[tuple[int, float, float]]:
    """The middle of the largest room of each state that has room for its word, as parts of the picture.

    free: where on a coarse grid there is nothing else.
    """
    from scipy.ndimage import distance_transform_edt

    coarse = _coarse(made.states)
    for state, word in WORDS.items():
        room = np.pad((coarse == state) & free, 1)
        if len(made.axes) == 1:
            room[:, :] = room[COARSE // 2]  # of a strip the height is no matter
        away = distance_transform_edt(room, sampling=(TEXT[0] / TEXT[1], 1))[1:-1, 1:-1]
        row, column = np.unravel_index(int(np.argmax(away)), away.shape)
        if away[row, column] > len(word) / 6 * TEXT[0] * COARSE:
            y = (row + 0.5) / COARSE if len(made.axes) > 1 else 0.5
            yield state, (column + 0.5) / COARSE, y


def _coarse(states: Any) -> Any:
    """The cells under the points of a coarse grid."""
    rows, columns = ((np.arange(COARSE) * n) // COARSE for n in states.shape)
    return states[np.ix_(rows, columns)]


def _edge(axes: Axes, found: Gains) -> None:
    """The edge as a formula above the picture; of a map of one gain the numbers where the state changes."""
    assert found.map is not None
    axes.set_title(title(found), fontsize=10, loc="left", color=INK, pad=8 if len(found.map.axes) > 1 else 16)
    if len(found.map.axes) > 1:
        return
    axis, states = found.map.axes[0], found.map.states[0]
    sure = np.flatnonzero(states != OPEN)
    turns = [(int(a), int(b)) for a, b in pairwise(sure) if states[a] != states[b]]
    for a, b in turns if len(turns) <= EDGES else ():
        low, high = float(axis.edge(a + 1)), float(axis.edge(b))
        words = f"{low:.4g}" if b == a + 1 else f"{low:.4g}–{high:.4g}"
        axes.text((low + high) / 2, 1.04, words, ha="center", va="bottom", fontsize=9, color=INK)


def title(found: Gains) -> str:
    where = f" on {found.graph}" if found.graph else ""
    edges = [_formula(text) for text in (found.boundary or "").split("; ") if text]
    return f"{found.study}{where}" + (f"     edge: {',  '.join(edges)}" if edges else "")


def _letter(name: str) -> str:
    return f"${name_latex(name)}$" if re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name) else name


def _formula(text: str) -> str:
    """An edge in the notation of mathematics, where matplotlib can set it."""
    made = re.sub(r"[A-Za-z_][A-Za-z0-9_]*", lambda m: name_latex(m.group()), text)
    made = re.sub(r"\^(\d+)", r"^{\1}", made).replace("*", r"\,")
    return f"${made}$" if "[" not in text else text


def thinned(states: Any, most: int) -> Any:
    """At most so many on a side; a group of cells that are not alike is undecided."""
    steps = [max(1, -(-n // most)) for n in states.shape]
    if steps == [1, 1]:
        return states
    padded = np.pad(states, [(0, -n % s) for n, s in zip(states.shape, steps, strict=True)], mode="edge")
    parts = padded.reshape(padded.shape[0] // steps[0], steps[0], padded.shape[1] // steps[1], steps[1])
    low, high = parts.min(axis=(1, 3)), parts.max(axis=(1, 3))
    return np.where(low == high, low, OPEN)
