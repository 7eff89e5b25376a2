"""What the printers need of an expression: nodes with operation, arguments and shape; the walk over them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, Protocol, TypeVar

Shape = tuple[int, int]
SCALAR: Shape = (1, 1)


class Node(Protocol):
    """A node of an expression. `args` holds nodes and plain data."""

    @property
    def op(self) -> str: ...
    @property
    def args(self) -> tuple[Any, ...]: ...
    @property
    def shape(self) -> Shape: ...


AnyNode = TypeVar("AnyNode", bound=Node)


def is_node(x: object) -> bool:
    """Is an argument of a node a node itself?"""
    return hasattr(x, "op") and hasattr(x, "args")


def walk(expr: AnyNode, skip: Callable[[AnyNode], bool] = lambda node: False) -> Iterator[AnyNode]:
    """The distinct nodes of an expression, arguments before what uses them; `skip` leaves a node and what is
    below.
    """
    seen: set[AnyNode] = set()
    stack: list[tuple[AnyNode, bool]] = [(expr, False)]
    while stack:
        node, ready = stack.pop()
        if ready:
            yield node
        elif node not in seen and not skip(node):
            seen.add(node)
            stack.append((node, True))
            stack.extend((arg, False) for arg in reversed(node.args) if is_node(arg))
