"""Runs of `verify`: which claims of which studies are decided, and where their certificates go."""

from __future__ import annotations

import re
import uuid
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from symctrl import files, parallel, registry
from symctrl.certify import canonical
from symctrl.files import InputError
from symctrl.parallel import Request
from symctrl.rows import Report
from symctrl.store import Store, folder

if TYPE_CHECKING:
    from symctrl.study import Study

Progress = Callable[[str], None]


def decide(
    requests: Sequence[Request],
    claims: Collection[str] | None,
    *,
    jobs: int | None,
    fresh: bool,
    watch: Callable[[str], AbstractContextManager[Progress]],
) -> Iterator[tuple[Study, Report]]:
    """Each requested study with its report, in order. All are built before the first claim is decided.

    claims: ids, each of which one study at least must have; None for all. fresh: verdicts of earlier runs are
    not used. jobs: processes; None for as many as pay. watch: given a study's name, the context in which its
    claims are reported to a progress display.
    Raises InputError.
    """
    studies = [request.build() for request in requests]
    _refuse_same_names(studies)
    wanted = _wanted(studies, claims)
    run = _Run(Store(folder(), run=uuid.uuid4().hex if fresh else ""), jobs, watch)
    return zip(studies, map(run.decide, requests, studies, wanted), strict=True)


def write_certificates(report: Report, target: Path) -> None:
    """Each certificate of the report in target/STUDY/ID.json; an older file of a claim that has none goes.

    Raises InputError where two ids have one file name, or a file cannot be written.
    """
    paths = {row.id: target / file_name(report.study) / f"{file_name(row.id)}.json" for row in report.rows}
    first: dict[Path, str] = {}
    for name, path in paths.items():
        if first.setdefault(path, name) != name:
            raise InputError(f"{path}: the claims {first[path]} and {name} have this one file; rename one")
    try:
        target.mkdir(parents=True, exist_ok=True)
        for row in report.rows:
            path = paths[row.id]
            path.parent.mkdir(exist_ok=True)
            if row.certificate is None:
                path.unlink(missing_ok=True)
            else:
                files.write(path, canonical(row.certificate) + "\n")
    except OSError as error:
        raise InputError(f"{error.filename}: cannot be written: {error.strerror}") from None


@dataclass(frozen=True)
class _Run:
    store: Store
    jobs: int | None
    watch: Callable[[str], AbstractContextManager[Progress]]

    def decide(self, request: Request, study: Study, only: Collection[str] | None) -> Report:
        from symctrl.verify import verify

        with self.watch(study.name) as progress, registry.locate(request.study).blamed():
            ids = study.statement_ids() if only is None else sorted(only)
            jobs = self.jobs or parallel.processes(len(ids))
            if jobs == 1:
                return verify(study, only, self.store, progress)
            found = parallel.rows(request, ids, self.store, jobs, progress)
            return verify(study, only, self.store, progress, found)


def _refuse_same_names(studies: Sequence[Study]) -> None:
    names = [study.name for study in studies]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"study {name}: is asked for twice; each name may stand once")


def _wanted(studies: Sequence[Study], claims: Collection[str] | None) -> list[Collection[str] | None]:
    """For each study those of the claims that it has. A single study is left to say what it does not know."""
    if claims is None or len(studies) == 1:
        return [claims] * len(studies)
    known = [_askable(study) for study in studies]
    for claim in claims:
        if not any(claim in ids for ids in known):
            names = ", ".join(study.name for study in studies)
            raise InputError(f"claim {claim}: none of the studies {names} has it")
    return [[claim for claim in claims if claim in ids] for ids in known]


def _askable(study: Study) -> set[str]:
    """Its ids, and for the readings `id[name]` of one statement the `id` that means them all."""
    ids = study.statement_ids()
    return {*ids, *(name.partition("[")[0] for name in ids)}


def file_name(name: str) -> str:
    """The name of a study or claim as that of a file or folder of certificates."""
    return re.sub(r"[^A-Za-z0-9._-]", "_", name)
