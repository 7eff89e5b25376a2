"""What `symctrl gains` answers: the point, the map, the edge and the margin, as text and as JSON."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from symctrl.certify import digest, tool
from symctrl.context import within
from symctrl.domains.boxes import Box, Boxes
from symctrl.domains.domain import Unsupported
from symctrl.files import InputError
from symctrl.gains import cases as the_cases
from symctrl.gains import point, search
from symctrl.gains.boundary import boundary
from symctrl.gains.conditions import Conditions, conditions, requirement
from symctrl.gains.definite import HOLDS, OPEN
from symctrl.gains.maps import Axis, Map, refuse_too_large, swept
from symctrl.gains.requirement import Cases, Requirement, outputs
from symctrl.gains.theorem import standing_theorem
from symctrl.inputs import inputs_digest
from symctrl.statements import nonnegative
from symctrl.theorem import Theorem
from symctrl.written import StudyError

if TYPE_CHECKING:
    import networkx as nx

    from symctrl.spectral.bracket import Bracket
    from symctrl.store import Store
    from symctrl.study import Study

FORMAT = "symctrl-gains/1"
MOST_AXES = 2


@dataclass(frozen=True)
class Gains:
    """One answer. margin: r such that all gains within the factors 1 - r and 1 + r are feasible; None where
    the point is not. best: what was asked to be made as large as possible, with the gains that do it.
    """

    study: str
    graph: str | None
    inputs_sha256: str
    theorem: str | None
    gains: Mapping[str, Fraction]
    state: int
    conditions: tuple[point.Answer, ...]
    assumes: tuple[tuple[str, str], ...]
    chosen: Mapping[str, Fraction]
    spectrum: Bracket | None
    boundary: str | None
    margin: Fraction | None
    map: Map | None
    best: tuple[str, search.Best] | None
    seconds: float

    @property
    def verdict(self) -> str:
        return point.WORDS[self.state]

    def as_json(self) -> dict[str, Any]:
        cells = None
        if self.map is not None:
            cells = {"axes": [axis.as_json() for axis in self.map.axes], "cells": self.map.cells}
        return {
            "format": FORMAT,
            "tool": tool(),
            "inputs_sha256": self.inputs_sha256,
            "study": self.study,
            "graph": self.graph,
            "theorem": self.theorem,
            "gains": _written(self.gains),
            "verdict": self.verdict,
            "conditions": [one.as_json() for one in self.conditions],
            "assumes": [{"text": text, "about": about} for text, about in self.assumes],
            "chosen": _written(self.chosen),
            "spectrum": _spectrum(self.spectrum),
            "boundary": self.boundary,
            "margin": None if self.margin is None else str(self.margin),
            "maximized": None if self.best is None else _best(*self.best),
            "map": cells,
            "seconds": self.seconds,
        }


def _written(values: Mapping[str, Fraction]) -> dict[str, str]:
    return {name: str(value) for name, value in values.items()}


def _spectrum(found: Bracket | None) -> dict[str, str] | None:
    return None if found is None else {"low": str(found.low), "high": str(found.high)}


def _best(what: str, best: search.Best) -> dict[str, Any]:
    return {"what": what, "gains": _written(best.gains), "value": str(best.objective)}


def gains(
    study: Study,
    axes: Sequence[Axis] = (),
    maximize: str | None = None,
    store: Store | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Gains:
    """The study's gains. maximize: "margin" or "decay". Raises StudyError, InputError."""
    began = time.perf_counter()
    theorem = standing_theorem(study, store, progress)
    with within(study.instance):
        found = conditions(study, theorem)
        values = study.all_values()
        _refuse_axes(study, found, axes)
        progress("eigenvalues of the graph")
        graph = study.of_fleet.graph if study.of_fleet is not None else None
        bracket = _bracket(found, graph, the_cases.thresholds(found, values))
        spectrum = None if bracket is None else (bracket.low, bracket.high)
        known = the_cases.of_graph(found, graph, spectrum)
        swept_names = [axis.name for axis in axes]
        chosen = the_cases.chosen(study, found, known, values)
        cases = {**known, **chosen}
        progress("conditions")
        answers = tuple(point.answer(study, one, values, cases) for one in found.each)
        state = min((a.state for a in answers if a.condition in found.deciding), default=OPEN)
        if state == HOLDS and the_cases.admissible_constants(found, values) is None:
            state = OPEN
        deciding = [one for condition in found.deciding for one in condition.requirements]
        varied = [name for name in _read(deciding) if name in values]
        progress("map")
        cells = _map(deciding, axes, values, cases) if axes else None
        progress("margin")
        margin = search.margin(deciding, values, varied, cases) if state == HOLDS else None
        best = _maximized(study, found, deciding, values, cases, axes, maximize) if maximize else None
        edge = boundary(study, found.deciding, cases, [*swept_names, *varied])
    return Gains(
        study.name,
        study.graph,
        digest([inputs_digest(study, set(study.statement_ids())), [axis.as_json() for axis in axes]]),
        found.theorem,
        {name: value for name, value in values.items() if name in _all_read(found)},
        state,
        answers,
        found.assumed.besides,
        {name: case.hull[0] for name, case in chosen.items()},
        bracket,
        edge,
        margin,
        cells,
        None if best is None or maximize is None else (maximize, best),
        round(time.perf_counter() - began, 6),
    )


def _bracket(found: Conditions, graph: nx.Graph | None, thresholds: Sequence[Fraction]) -> Bracket | None:
    from symctrl.spectral.bracket import extreme_eigenvalue

    if graph is None or not the_cases.needs_spectrum(found):
        return None
    return extreme_eigenvalue(graph, thresholds)


def _read(requirements: Sequence[Requirement]) -> list[str]:
    return list(dict.fromkeys(name for one in requirements for name in one.names))


def _all_read(found: Conditions) -> set[str]:
    return {name for one in found.each for name in one.names}


def _refuse_axes(study: Study, found: Conditions, axes: Sequence[Axis]) -> None:
    from difflib import get_close_matches

    if len(axes) > MOST_AXES:
        raise InputError(f"--sweep: a map has one or two gains, not {len(axes)}")
    if len({axis.name for axis in axes}) < len(axes):
        raise InputError(f"--sweep: {axes[0].name} is swept twice")
    known = sorted(name for name in _all_read(found) if name in study.symbols)
    for axis in axes:
        if axis.name not in known:
            near = get_close_matches(axis.name, known, 3, 0.4) or known
            raise InputError(
                f"--sweep {axis.name}: no condition reads a gain of this name; there are {', '.join(near)}"
            )
    if axes:
        refuse_too_large(axes)


def _map(
    deciding: Sequence[Requirement], axes: Sequence[Axis], values: Mapping[str, Fraction], cases: Cases
) -> Map:
    known = {*values, *cases, *(axis.name for axis in axes)}
    missing = [name for name in _read(deciding) if name not in known]
    if missing:
        raise InputError(f"--sweep: {missing[0]} has no value; give one with --set {missing[0]}=VALUE")
    try:
        return swept(deciding, axes, values, cases)
    except Unsupported as error:
        raise InputError(f"--sweep: the conditions cannot be evaluated over boxes: {error}") from None


def _maximized(
    study: Study,
    found: Conditions,
    deciding: Sequence[Requirement],
    values: Mapping[str, Fraction],
    cases: Cases,
    axes: Sequence[Axis],
    what: str,
) -> search.Best:
    """Within the ranges that are swept; without any, each gain between half and twice its value."""
    ranges = {axis.name: (axis.lo, axis.hi) for axis in axes}
    ranges = ranges or {n: (v / 2, 2 * v) for n, v in values.items() if n in _read(deciding)}
    if not ranges:
        raise InputError(f"--maximize {what}: no gain has a value or a range; add --sweep NAME=LO:HI:COUNT")
    if what == "margin":
        return search.largest_margin(deciding, values, ranges, cases)
    return search.fastest(deciding, _rate(study, found), values, ranges, cases)


def _rate(study: Study, found: Conditions) -> Callable[[Mapping[str, Box], Boxes], Box]:
    """The rate of the exponential bound that the theorem concludes."""
    claim = study.entries[found.theorem].call(study) if found.theorem else None
    rates = [f.by for f in claim.then if f.word == "exponentially"] if isinstance(claim, Theorem) else []
    if not rates or rates[0] is None:
        raise StudyError(
            f"--maximize decay: no theorem of the study {study.name} that stands concludes an exponential "
            "bound with a rate, like exponentially(x, rate=k)"
        )
    made = requirement(study, nonnegative(rates[0]), "rate")
    return lambda boxes, domain: outputs(made, boxes, domain)[0]
