"""What `symctrl gains` answers: the point, the map, the edge and the margin, as text and as JSON."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symctrl.certify import digest, tool
from symctrl.context import within
from symctrl.domains.boxes import Box, Boxes
from symctrl.files import InputError
from symctrl.gains import cases as the_cases
from symctrl.gains import point, search
from symctrl.gains.boundary import boundary
from symctrl.gains.conditions import Condition, Conditions, conditions, is_gain, requirement, variant_of
from symctrl.gains.definite import FAILS, HOLDS, OPEN
from symctrl.gains.maps import Axis, Map, parsed, refuse_too_large, swept
from symctrl.gains.requirement import Case, Cases, Requirement, tight
from symctrl.gains.theorem import NOTHING, standing_theorem
from symctrl.inputs import inputs_digest
from symctrl.statements import nonnegative
from symctrl.theorem import Theorem
from symctrl.written import Entry, StudyError

if TYPE_CHECKING:
    import networkx as nx

    from symctrl.rows import Row
    from symctrl.spectral.bracket import Bracket
    from symctrl.store import Store
    from symctrl.study import Study

FORMAT = "symctrl-gains/1"
MOST_AXES = 2


@dataclass(frozen=True, repr=False)
class Gains:
    """One answer. reason: why it is undecided although no condition is. chosen: values of gains that have
    none. margin: r such that all gains within the factors 1 - r and 1 + r are feasible; None where the point
    is not. best: what was asked to be made as large as possible, with the gains that do it.
    """

    study: str
    graph: str | None
    inputs_sha256: str
    theorem: str | None
    gains: Mapping[str, Fraction]
    state: int
    reason: str
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

    def __repr__(self) -> str:
        return f"<gains of {self.study}: {self.verdict}>"

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
            "reason": self.reason,
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

    def _repr_html_(self) -> str:
        from symctrl import notebook

        return notebook.gains(self)


def _written(values: Mapping[str, Fraction]) -> dict[str, str]:
    return {name: str(value) for name, value in values.items()}


def _spectrum(found: Bracket | None) -> dict[str, str] | None:
    return None if found is None else {"low": str(found.low), "high": str(found.high)}


def _best(what: str, best: search.Best) -> dict[str, Any]:
    value = None if best.objective is None else str(best.objective)
    return {"what": what, "gains": _written(best.gains), "value": value}


def gains(
    study: Study,
    sweeps: Sequence[Axis | str] = (),
    maximize: str | None = None,
    store: Store | None = None,
    progress: Callable[[str], None] = lambda _: None,
    decided: Mapping[str, Row] = NOTHING,
) -> Gains:
    """The study's gains. sweeps: of one or two gains, as "K=1/2:3:100". maximize: "margin" or "decay".

    decided: rows that are known already, by id.

    Raises StudyError, InputError.
    """
    began = time.perf_counter()
    axes = [parsed(sweep) if isinstance(sweep, str) else sweep for sweep in sweeps]
    _refuse_axes(study, axes)
    theorem = standing_theorem(study, store, progress, decided)
    inputs = inputs_digest(study, set(study.statement_ids()))
    with within(study.instance):
        found = conditions(study, theorem, {*study.all_values(), *(axis.name for axis in axes)})
        asked = Asked(study, found, tuple(axes), study.all_values())
        _refuse_unread(study, found, axes)
        progress("eigenvalues of the graph")
        bracket = asked.bracket()
        cases = asked.cases(bracket)
        progress("conditions")
        answers = asked.answers(cases)
        state, reason = asked.state(answers)
        progress("map")
        cells = asked.map(cases) if axes else None
        progress("margin")
        margin = search.margin(asked.deciding, asked.values, asked.varied, cases) if state == HOLDS else None
        best = asked.maximized(maximize, cases) if maximize else None
        edge = boundary(study, found.deciding, cases, [*(axis.name for axis in axes), *asked.varied])
    read = {name for one in found.each for name in one.names}
    written = [axis.as_json() for axis in axes]
    functions = [_source(entry) for entry in study.conditions.values()]
    return Gains(
        study.name,
        study.graph,
        digest([inputs, functions, written, maximize]),
        found.theorem,
        {name: value for name, value in asked.values.items() if name in read},
        state,
        reason,
        answers,
        found.assumed.besides,
        {name: case.hull[0] for name, case in cases.items() if is_gain(study, name)},
        bracket,
        edge,
        margin,
        cells,
        None if best is None or maximize is None else (maximize, best),
        round(time.perf_counter() - began, 6),
    )


def _source(entry: Entry) -> str:
    """The digest of the file in which a condition is written."""
    path = Path(entry.function.__code__.co_filename)
    return sha256(path.read_bytes()).hexdigest() if path.is_file() else ""


@dataclass(frozen=True)
class Asked:
    """What is asked of which study, and the parts of the answer."""

    study: Study
    found: Conditions
    axes: tuple[Axis, ...]
    values: Mapping[str, Fraction]

    @cached_property
    def deciding(self) -> list[Requirement]:
        return [one for condition in self.found.deciding for one in condition.requirements]

    @cached_property
    def varied(self) -> list[str]:
        """The gains that have a value; where what has one is no gain, all of it."""
        read = [name for name in _read(self.deciding) if name in self.values]
        return [name for name in read if is_gain(self.study, name)] or read

    @cached_property
    def graph(self) -> nx.Graph | None:
        return self.study.of_fleet.graph if self.study.of_fleet is not None else None

    @cached_property
    def is_covered(self) -> bool:
        return the_cases.covers(self.found, self.graph)

    @cached_property
    def at_point(self) -> Mapping[str, Fraction] | None:
        return the_cases.admissible_constants(self.found, self.values)

    def bracket(self) -> Bracket | None:
        from symctrl.spectral.bracket import extreme_eigenvalue

        if self.graph is None or not the_cases.needs_spectrum(self.found):
            return None
        try:
            return extreme_eigenvalue(self.graph, the_cases.thresholds(self.found, self.values))
        except ValueError as error:
            raise InputError(f"--graph: {error}") from None

    def cases(self, bracket: Bracket | None) -> dict[str, Case]:
        spectrum = None if bracket is None else (bracket.low, bracket.high)
        of_graph = the_cases.of_graph(self.found, self.graph, spectrum)
        return of_graph | the_cases.chosen(self.study, self.found, of_graph, self.values, self.at_point)

    def answers(self, cases: Cases) -> tuple[point.Answer, ...]:
        made = [point.answer(self.study, one, self.values, cases) for one in self.found.each]
        if self.found.assumed.of_fleet and self.graph is not None:
            text = "the graph is connected and has two nodes or more"
            id_ = f"{self.found.theorem}/graph"
            condition = Condition(id_, text, rf"\text{{{text}}}", "the graph", True, ())
            holds = HOLDS if self.is_covered else FAILS
            witness = None if self.is_covered else {"graph": str(self.study.graph)}
            made.append(point.Answer(condition, holds, None, witness, ()))
        return tuple(made)

    def state(self, answers: Sequence[point.Answer]) -> tuple[int, str]:
        """Of all that decides; and why it is open, if that is not for one of the conditions."""
        deciding = [a.state for a in answers if a.condition.of_theorem or self.found.theorem is None]
        state = min(deciding, default=OPEN)
        if state == HOLDS and self.at_point is None:
            return OPEN, "no state is known at which all that the theorem assumes holds with these gains"
        return state, ""

    def map(self, cases: Cases) -> Map:
        known = {*self.values, *cases, *(axis.name for axis in self.axes)}
        missing = [name for name in _read(self.deciding) if name not in known]
        if missing:
            raise InputError(f"--sweep: {missing[0]} has no value; give one with --set {missing[0]}=VALUE")
        made = swept(self.deciding, self.axes, self.values, cases)
        return made if self.is_covered else Map(made.axes, np.full_like(made.states, FAILS))

    def maximized(self, what: str, cases: Cases) -> search.Best:
        """Within the ranges that are swept; without any, each gain between half and twice its value."""
        ranges = {axis.name: (axis.lo, axis.hi) for axis in self.axes}
        ranges = ranges or {name: (self.values[name] / 2, 2 * self.values[name]) for name in self.varied}
        if not ranges:
            raise InputError(
                f"--maximize {what}: no gain has a value or a range; add --sweep NAME=LO:HI:COUNT"
            )
        cases = {name: case for name, case in cases.items() if name not in ranges}
        among = search.Among(self.deciding, self.values, ranges, cases)
        varied = list(dict.fromkeys([*ranges, *self.varied]))
        if what == "margin":
            return search.largest_margin(among, varied)
        return search.fastest(among, self.rate(cases, ranges))

    def rate(self, cases: Cases, ranges: search.Ranges) -> search.Rate:
        """The rate of the exponential bound that the theorem concludes, at the least over its cases."""
        made = _rate(self.study, self.found)
        missing = [
            n for n in made.names if n not in self.values and n not in cases and not is_gain(self.study, n)
        ]
        if missing:
            raise InputError(f"--maximize decay: {missing[0]} has no value; give one with --set")

        def rate(boxes: Mapping[str, Box], domain: Boxes) -> Box:
            hull = {n: domain.between(*cases[n].hull) for n in made.names if n in cases}
            return tight(made, {**boxes, **hull}, domain)[0]

        return rate


def _read(requirements: Sequence[Requirement]) -> list[str]:
    return list(dict.fromkeys(name for one in requirements for name in one.names))


def _all_read(found: Conditions) -> set[str]:
    return {name for one in found.each for name in one.names}


def _refuse_axes(study: Study, axes: Sequence[Axis]) -> None:
    if len(axes) > MOST_AXES:
        raise InputError(f"--sweep: a map has one or two gains, not {len(axes)}")
    if len({axis.name for axis in axes}) < len(axes):
        raise InputError(f"--sweep: {axes[0].name} is swept twice")
    known = study.parameter_names()
    for axis in axes:
        if axis.name not in known:
            near = _nearest(axis.name, known)
            raise InputError(
                f"--sweep {axis.name}: {study.name} has no parameter of this name; it has {near}"
            )
    if axes:
        refuse_too_large(axes)


def _refuse_unread(study: Study, found: Conditions, axes: Sequence[Axis]) -> None:
    read = {name for one in found.each for name in one.names}
    known = sorted(name for name in read if name in study.parameter_names())
    for axis in axes:
        if axis.name not in known:
            near = _nearest(axis.name, known)
            raise InputError(f"--sweep {axis.name}: no condition reads this gain; there are {near}")


def _nearest(name: str, known: Sequence[str]) -> str:
    from difflib import get_close_matches

    return ", ".join(get_close_matches(name, known, 3, 0.4) or known) or "none"


def _rate(study: Study, found: Conditions) -> Requirement:
    claim = None
    if found.theorem is not None:
        entry = study.entries[found.theorem]
        with within(replace(study.instance, variant=variant_of(entry))):
            claim = entry.call(study)
    facts = claim.then if isinstance(claim, Theorem) else ()
    rates = [fact.by for fact in facts if fact.word == "exponentially" and fact.by is not None]
    if not rates:
        raise StudyError(
            f"--maximize decay: no theorem of the study {study.name} that stands concludes an exponential "
            "bound with a rate, like exponentially(x, rate=k)"
        )
    return requirement(study, nonnegative(rates[0]), "rate")
