"""What `symctrl sos` reads and prints."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from symctrl import files
from symctrl.files import InputError
from symctrl.sos.answer import LIMIT, answer_apart
from symctrl.sos.problem import Problem, read
from symctrl.sos.text import check_names, parse_names

_SHAPE = 'it must be like [{"id": "a", "poly": "x^2 + y^2 - x*y", "vars": ["x", "y"], "on": "x >= 0"}]'
EXIT_CODES = {"proved": 0, "refuted": 1, "undecided": 3}


def single(poly: str, names: str | None, on: str | None, limit: float | None) -> dict[str, Any]:
    """The answer to one problem from the command line. Raises InputError."""
    seconds = _limit(limit)
    chosen = None if names is None else parse_names(names)
    problem = read(poly, chosen, on or "")
    return answer_apart(problem, {"poly": poly, "vars": list(problem.names), "on": on or ""}, seconds)


def made_exact(path: Path | None, limit: float | None) -> dict[str, Any]:
    """The answer to --certify. Raises InputError."""
    from symctrl.sos.certifying import certify

    return certify(path or Path(), _limit(limit))


def batch(path: Path, limit: float | None, watch: Callable[[str], None]) -> Iterator[dict[str, Any]]:
    """The answers to the problems of a file, in its order; all are read before the first is tried."""
    seconds = _limit(limit)
    for problem, inputs in problems(path):
        watch(problem.id)
        yield answer_apart(problem, inputs, seconds)


def problems(path: Path) -> list[tuple[Problem, Any]]:
    """The problems of a file, with what their digests are taken over. Raises InputError."""
    try:
        entries = json.loads(files.read(path))
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        raise InputError(f"{path}: not JSON ({error.msg.lower()} at {where}); {_SHAPE}") from None
    except RecursionError:
        raise InputError(f"{path}: the JSON is nested too deeply; {_SHAPE}") from None
    if not isinstance(entries, list):
        raise InputError(f"{path}: is not a list of problems; {_SHAPE}")
    found = [_problem(entry, k, path) for k, entry in enumerate(entries, start=1)]
    ids = [problem.id for problem, _ in found]
    twice = next((name for name in ids if ids.count(name) > 1), None)
    if twice is not None:
        raise InputError(f"{path}: the id {twice!r} stands there twice")
    return found


def _problem(entry: Any, k: int, path: Path) -> tuple[Problem, Any]:
    where = f"{path}: problem {k}"
    if not isinstance(entry, dict) or not isinstance(entry.get("poly"), str):
        raise InputError(f"{where}: has no polynomial; {_SHAPE}")
    unknown = sorted(set(entry) - {"id", "poly", "vars", "on"})
    if unknown:
        raise InputError(f"{where}: has the unknown field {unknown[0]!r}; {_SHAPE}")
    id_ = entry.get("id", str(k))
    if not isinstance(id_, str | int) or isinstance(id_, bool):
        raise InputError(f"{where}: its id is not a text; {_SHAPE}")
    where = f"{where} ({id_})"
    names, on = entry.get("vars"), entry.get("on")
    if isinstance(names, str):
        chosen = parse_names(names, f"{where}: vars")
    elif names is None:
        chosen = None
    elif isinstance(names, list):
        chosen = check_names(names, f"{where}: vars")
    else:
        raise InputError(f"{where}: vars must be a list of names; {_SHAPE}")
    if isinstance(on, list) and all(isinstance(part, str) for part in on):
        on = ", ".join(on)
    if on is not None and not isinstance(on, str):
        raise InputError(f"{where}: on must be a text of constraints; {_SHAPE}")
    problem = read(entry["poly"], chosen, on or "", str(id_), where)
    return problem, {"poly": entry["poly"], "vars": list(problem.names), "on": on or ""}


def _limit(limit: float | None) -> float:
    if limit is None:
        return LIMIT
    if not 0 < limit < 1e6:
        raise InputError(f"--limit {limit:g}: must be a positive number of seconds")
    return limit


def line(found: dict[str, Any]) -> str:
    """One answer in words."""
    words = f"{found['verdict']}: {found['reason']}"
    if found["witness"]:
        shown = ", ".join(f"{name} = {_cut(value)}" for name, value in found["witness"].items())
        words += f": {shown}"
    if found["verdict"] == "undecided":
        if found["bound"] is not None:
            words += f"; at least {_cut(found['bound'])}"
        if found["tried"]:
            words += f"; tried: {'; '.join(found['tried'])}"
    return words


def _cut(text: str) -> str:
    return text if len(text) <= 60 else f"{text[:40]}.. ({len(text)} characters)"
