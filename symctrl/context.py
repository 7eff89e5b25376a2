"""Which instance of a study is being decided: the variant of its definitions, its graph, its exact values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import networkx as nx


@dataclass(frozen=True)
class Instance:
    """variant: "printed" or "corrected". graph: of the fleet, if there is one. values: of parameters, by
    scalar name.
    """

    variant: str = "printed"
    graph: nx.Graph | None = None
    values: Mapping[str, Fraction] = field(default_factory=dict)
    reading: tuple[tuple[str, object], ...] = ()


_current: ContextVar[Instance] = ContextVar("instance", default=Instance())  # noqa: B039  (nothing changes it)


def current() -> Instance:
    return _current.get()


@contextmanager
def within(instance: Instance) -> Iterator[None]:
    """Everything called inside speaks of `instance`."""
    token = _current.set(instance)
    try:
        yield
    finally:
        _current.reset(token)


_graph_used: ContextVar[list[bool] | None] = ContextVar("graph_used", default=None)


def graph_is_used() -> None:
    """What is being evaluated speaks of the instance's graph."""
    marks = _graph_used.get()
    if marks is not None:
        marks.append(True)


@contextmanager
def noticing_graph() -> Iterator[list[bool]]:
    """A list that is not empty once something inside has spoken of the instance's graph."""
    marks: list[bool] = []
    token = _graph_used.set(marks)
    try:
        yield marks
    finally:
        _graph_used.reset(token)
