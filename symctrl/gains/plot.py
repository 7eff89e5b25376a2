"""The map of gains as a picture: what is where is written where it is."""

from __future__ import annotations

import re
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
        _thinned(made.states),
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
    assert found.map is not None
    free = np.ones((COARSE, COARSE), bool)
    at = []
    for axis in found.map.axes:
        value = found.gains.get(axis.name)
        if value is None or not axis.lo <= value <= axis.hi:
            return free
        at.append(float((value - axis.lo) / (axis.hi - axis.lo)))
    x, y = at[0], at[1] if len(at) > 1 else 0.5
    right = x < 1 - 3 * POINT
    axes.plot([x], [y], "o", color=INK, markersize=5, transform=axes.transAxes, clip_on=False)
    axes.annotate(
        "the study",
        (x, y),
        xycoords="axes fraction",
        xytext=(7 if right else -7, 0),
        textcoords="offset points",
        ha="left" if right else "right",
        va="center",
        fontsize=9,
        color=INK,
    )
    grid = (np.arange(COARSE) + 0.5) / COARSE
    beside = (
        (grid > x - POINT) & (grid < x + 3 * POINT) if right else (grid > x - 3 * POINT) & (grid < x + POINT)
    )
    near = np.abs(grid - y) < POINT if len(at) > 1 else np.ones(COARSE, bool)
    free[np.ix_(near, beside)] = False
    return free


def _words(axes: Axes, made: Map, free: Any) -> None:
    """The name of each state in the middle of the largest room that it has."""
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
            colour = PAPER if state == OPEN else INK
            axes.text(
                (column + 0.5) / COARSE,
                y,
                word,
                transform=axes.transAxes,
                ha="center",
                va="center",
                color=colour,
                fontsize=10,
            )


def _coarse(states: Any) -> Any:
    """The cells under the points of a coarse grid."""
    rows, columns = ((np.arange(COARSE) * n) // COARSE for n in states.shape)
    return states[np.ix_(rows, columns)]


def _edge(axes: Axes, found: Gains) -> None:
    """The edge as a formula above the picture; of a map of one gain the numbers where the state changes."""
    assert found.map is not None
    where = f" on {found.graph}" if found.graph else ""
    edges = [_formula(text) for text in (found.boundary or "").split("; ") if text]
    title = f"{found.study}{where}" + (f"     edge: {',  '.join(edges)}" if edges else "")
    axes.set_title(title, fontsize=10, loc="left", color=INK, pad=16 if len(found.map.axes) == 1 else 8)
    if len(found.map.axes) > 1:
        return
    axis, states = found.map.axes[0], found.map.states[0]
    sure = np.flatnonzero(states != OPEN)
    turns = [(int(a), int(b)) for a, b in pairwise(sure) if states[a] != states[b]]
    for a, b in turns if len(turns) <= EDGES else ():
        low, high = float(axis.edge(a + 1)), float(axis.edge(b))
        words = f"{low:.4g}" if b == a + 1 else f"{low:.4g}–{high:.4g}"
        axes.text((low + high) / 2, 1.04, words, ha="center", va="bottom", fontsize=9, color=INK)


def _letter(name: str) -> str:
    return f"${name_latex(name)}$" if re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name) else name


def _formula(text: str) -> str:
    """An edge in the notation of mathematics, where matplotlib can set it."""
    made = re.sub(r"[A-Za-z_][A-Za-z0-9_]*", lambda m: name_latex(m.group()), text)
    made = re.sub(r"\^(\d+)", r"^{\1}", made).replace("*", r"\,")
    return f"${made}$" if "[" not in text else text


def _thinned(states: Any) -> Any:
    """At most MOST_PIXELS on a side; a group of cells that are not alike is undecided."""
    steps = [max(1, -(-n // MOST_PIXELS)) for n in states.shape]
    if steps == [1, 1]:
        return states
    padded = np.pad(states, [(0, -n % s) for n, s in zip(states.shape, steps, strict=True)], mode="edge")
    parts = padded.reshape(padded.shape[0] // steps[0], steps[0], padded.shape[1] // steps[1], steps[1])
    low, high = parts.min(axis=(1, 3)), parts.max(axis=(1, 3))
    return np.where(low == high, low, OPEN)
