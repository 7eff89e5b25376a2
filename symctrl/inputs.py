"""The digest of what a report was made of: with the same digest the same was asked of the same text."""

from __future__ import annotations

from collections.abc import Callable, Collection
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

from symctrl.certify import digest
from symctrl.text import text

if TYPE_CHECKING:
    from symctrl.study import Study


def inputs_digest(study: Study, wanted: Collection[str]) -> str:
    """SHA-256 of the study's files, symbols with values, assumptions, motions and graph, and of the ids.

    It does not depend on where the files lie.
    """
    return digest(
        {
            "study": study.name,
            "files": files_of(study),
            "symbols": {name: _symbol(study, name) for name in sorted(study.symbols)},
            "assumed": [[assumed.claim.text(), assumed.about] for assumed in study.assumed],
            "motions": [[text(x), text(xdot)] for x, xdot in study.motions],
            "set": {name: str(value) for name, value in study.instance.values.items()},
            "graph": _graph(study),
            "claims": sorted(wanted),
        }
    )


def files_of(study: Study) -> list[str]:
    """The digests of the files in which the study's functions are written."""
    functions: list[Callable[..., Any]] = [entry.function for entry in study.entries.values()]
    functions += [entry.function for entry in study.arguments]
    functions += [entry.function for entry in study.counterexamples]
    written = {Path(function.__code__.co_filename) for function in functions}
    return sorted(sha256(path.read_bytes()).hexdigest() for path in written if path.is_file())


def _symbol(study: Study, name: str) -> list[Any]:
    symbol = study.symbols[name]
    return [symbol.kind, symbol.unit, list(symbol.expr.shape), {k: str(v) for k, v in symbol.values.items()}]


def _graph(study: Study) -> list[Any] | str | None:
    graph = study.instance.graph
    return study.graph if graph is None else [list(graph), [list(edge) for edge in graph.edges]]
