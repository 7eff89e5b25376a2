"""Which rows and columns an index names: Python's rules, counted from 0, for shapes of rows x columns."""

from __future__ import annotations

from typing import Any

import numpy as np

Positions = tuple[int, ...]


def selection(shape: tuple[int, int], key: Any) -> tuple[Positions, Positions]:
    """The rows and the columns that `x[key]` names; a vector takes one index, a matrix two.

    Raises IndexError for one that is out of range or selects nothing, TypeError for one that is no index.
    """
    rows, cols = shape
    if isinstance(key, tuple):
        if len(key) != 2:
            raise IndexError(f"{len(key)} indices into a {rows}x{cols} expression; a matrix has two, M[r, c]")
        return _positions(shape, key[0], rows), _positions(shape, key[1], cols)
    if cols == 1:
        return _positions(shape, key, rows), (0,)
    if rows == 1:
        return (0,), _positions(shape, key, cols)
    raise TypeError(f"one index into a {rows}x{cols} matrix; write M[r, c], or M[r, :] for a row")


def _positions(shape: tuple[int, int], key: Any, size: int) -> Positions:
    of = f"a {shape[0]}x{shape[1]} expression"
    if isinstance(key, slice):
        chosen = tuple(range(size)[key])
        if not chosen:
            raise IndexError(f"the slice {key.start}:{key.stop} of {of} selects nothing")
        return chosen
    if isinstance(key, bool) or not isinstance(key, (int, np.integer)):
        raise TypeError(f"an index is an integer or a slice, not a {type(key).__name__}")
    if not -size <= key < size:
        raise IndexError(f"index {key} into {of}; here indices count from 0 to {size - 1}")
    return (int(key) % size,)
