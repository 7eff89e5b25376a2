"""Deciding the claims of one study in several processes.

The processes run the code that the caller would run, and hand their rows back; what they do not answer the
caller decides. So the result is that of one process, whatever happened to the others.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from symctrl import registry
from symctrl.store import Store

if TYPE_CHECKING:
    from symctrl.rows import Row
    from symctrl.study import Study

CLAIMS_FOR_A_PROCESS = 20


@dataclass(frozen=True)
class Request:
    """A study as the user named it, with its graph and values: what a process needs to build it again."""

    study: str
    graph: str | None
    values: Mapping[str, str]

    def build(self) -> Study:
        """Raises InputError, or StudyError for what the study does not know."""
        study = registry.load(self.study)
        if self.graph is None and not self.values:
            return study
        from symctrl import graphs  # networkx is slow to import

        with registry.locate(self.study).blamed():
            return study.at(graphs.parse(self.graph) if self.graph else None, self.values)


def processes(claims: int) -> int:
    """As many as there are processors and as pay: before it decides anything, each loads its libraries."""
    return max(1, min(_processors(), claims // CLAIMS_FOR_A_PROCESS))


def rows(
    request: Request, ids: Sequence[str], store: Store, jobs: int, progress: Callable[[str], None]
) -> dict[str, Row]:
    """The rows of `ids`, each decided in one of `jobs` processes; without those that failed there."""
    found: dict[str, Row] = {}
    context = multiprocessing.get_context("spawn")
    start = (request, store.folder, store.run)
    executor = ProcessPoolExecutor(jobs, mp_context=context, initializer=_start, initargs=start)
    try:
        futures = {executor.submit(_decide, name): name for name in ids}
        for future in as_completed(futures):
            if isinstance(future.exception(), BrokenProcessPool):
                break
            if future.exception() is None:
                found.update({row.id: row for row in future.result()})
            progress(futures[future])
    except BaseException:
        executor.shutdown(wait=False, cancel_futures=True)
        for child in multiprocessing.active_children():
            child.terminate()
        raise
    finally:
        executor.shutdown()
    return found


def _processors() -> int:
    """Those that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


_worker: tuple[Study, Store] | None = None


def _start(request: Request, folder: Path, run: str) -> None:
    # At Ctrl-C a process of the pool dies at once and silently; the caller has the word.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    global _worker  # noqa: PLW0603  (one study a process, built once)
    _worker = (request.build(), Store(folder, run))


def _decide(name: str) -> Sequence[Row]:
    from symctrl.verify import verify

    assert _worker is not None
    study, store = _worker
    return verify(study, {name}, store).rows
