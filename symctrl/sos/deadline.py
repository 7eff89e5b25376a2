"""How much time is left for one problem; and that it is worked on by one thread."""

from __future__ import annotations

import time
from functools import cache
from typing import Any

from threadpoolctl import ThreadpoolController


@cache
def _controller() -> ThreadpoolController:
    return ThreadpoolController()


def one_thread() -> Any:
    """A context in which matrix products use one thread."""
    return _controller().limit(limits=1)


class Late(Exception):  # noqa: N818
    """The time for the problem is over."""


class Deadline:
    """`seconds` from now on."""

    def __init__(self, seconds: float) -> None:
        self.start = time.perf_counter()
        self.seconds = seconds

    @property
    def spent(self) -> float:
        return time.perf_counter() - self.start

    @property
    def left(self) -> float:
        return self.seconds - self.spent

    def check(self) -> None:
        """Raises Late when the time is over."""
        if self.left <= 0:
            raise Late(f"the limit of {self.seconds:g} s")
