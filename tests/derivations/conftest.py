"""The formation study is verified once, for all tests of all processes that look at its report."""

from __future__ import annotations

import fcntl
import pickle
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from symctrl import runs
from symctrl.parallel import Request
from symctrl.rows import Report, Row

STUDY = "liang2016_formation"


@pytest.fixture(scope="session")
def report(tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Report:
    own = tmp_path_factory.getbasetemp()
    kept = (own if worker_id == "master" else own.parent) / f"{STUDY}.pickle"
    with _alone(kept.with_suffix(".lock")):
        if not kept.exists():
            kept.write_bytes(pickle.dumps(_verified()))
        return pickle.loads(kept.read_bytes())


@pytest.fixture(scope="session")
def rows(report: Report) -> dict[str, Row]:
    return {row.id: row for row in report.rows}


@contextmanager
def _alone(path: Path) -> Iterator[None]:
    with path.open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


@contextmanager
def _unwatched(_: str) -> Iterator[runs.Progress]:
    yield lambda _: None


def _verified() -> Report:
    ((_, report),) = runs.decide(
        [Request(STUDY, graph=None, values={})], None, jobs=None, fresh=True, watch=_unwatched
    )
    return report
