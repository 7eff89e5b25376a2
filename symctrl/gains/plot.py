"""The map of gains as a picture."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from symctrl.files import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from symctrl.gains.answer import Gains
    from symctrl.gains.maps import Map

# feasible, infeasible, undecided: as in the report
COLOURS = {1: "#cfe0ea", -1: "#f3efe6", 0: "#787267"}
INK = "#1c1b19"
WIDTH, HEIGHT, DPI = 6.4, 4.6, 150
MOST_PIXELS = 2000  # of the picture on a side: of finer cells one in a few is shown, undecided ones first


def plot(found: Gains, path: Path) -> None:
    """Write the picture in the format of the file's suffix. Raises InputError."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    assert found.map is not None
    figure, axes = plt.subplots(figsize=(WIDTH, HEIGHT), layout="constrained")
    _cells(axes, found.map)
    _point(axes, found)
    axes.set_title(_title(found), fontsize=10, loc="left")
    try:
        figure.savefig(path, dpi=DPI)
    except ValueError as error:
        raise InputError(f"--plot {path}: {error}") from None
    except OSError as error:
        raise InputError(f"--plot {path}: cannot be written: {error.strerror}") from None
    finally:
        plt.close(figure)


def _cells(axes: Axes, made: Map) -> None:
    from matplotlib.colors import ListedColormap

    states = _thinned(made.states)
    first, second = made.axes[0], made.axes[1] if len(made.axes) > 1 else None
    extent = (float(first.lo), float(first.hi), *((float(second.lo), float(second.hi)) if second else (0, 1)))
    colours = ListedColormap([COLOURS[k] for k in (-1, 0, 1)])
    axes.imshow(states, origin="lower", extent=extent, aspect="auto", cmap=colours, vmin=-1, vmax=1)
    axes.set_xlabel(first.name)
    if second is None:
        axes.set_yticks([])
    else:
        axes.set_ylabel(second.name)
    for state, word in ((1, "feasible"), (-1, "infeasible")):
        _label(axes, states, extent, state, word)


def _label(axes: Axes, states: Any, extent: tuple[float, ...], state: int, word: str) -> None:
    """A word in the middle of what it names."""
    import numpy as np

    rows, columns = np.nonzero(states == state)
    if not rows.size:
        return
    k = int(np.argmin((rows - np.median(rows)) ** 2 + (columns - np.median(columns)) ** 2))
    x = extent[0] + (extent[1] - extent[0]) * (columns[k] + 0.5) / states.shape[1]
    y = extent[2] + (extent[3] - extent[2]) * (rows[k] + 0.5) / states.shape[0]
    axes.text(x, y, word, ha="center", va="center", color=INK, fontsize=9)


def _point(axes: Axes, found: Gains) -> None:
    assert found.map is not None
    values = [found.gains.get(axis.name) for axis in found.map.axes]
    inside = all(
        value is not None and axis.lo <= value <= axis.hi
        for value, axis in zip(values, found.map.axes, strict=True)
    )
    if inside:
        x, y = float(values[0] or 0), float(values[1] or 0) if len(values) > 1 else 0.5
        axes.plot([x], [y], marker="o", color=INK, markersize=5)
        axes.annotate("the study", (x, y), xytext=(6, 6), textcoords="offset points", fontsize=9, color=INK)


def _thinned(states: Any) -> Any:
    """At most MOST_PIXELS on a side; a group of cells that are not alike is undecided."""
    import numpy as np

    steps = [max(1, -(-n // MOST_PIXELS)) for n in states.shape]
    if steps == [1, 1]:
        return states
    padded = np.pad(states, [(0, -n % s) for n, s in zip(states.shape, steps, strict=True)], mode="edge")
    parts = padded.reshape(padded.shape[0] // steps[0], steps[0], padded.shape[1] // steps[1], steps[1])
    low, high = parts.min(axis=(1, 3)), parts.max(axis=(1, 3))
    return np.where(low == high, low, 0)


def _title(found: Gains) -> str:
    where = f" on {found.graph}" if found.graph else ""
    edge = f"\nedge: {found.boundary}" if found.boundary else ""
    return f"{found.study}{where}{edge}"
