"""What an author writes as functions: statements, definitions and laws, entered by name and called when
needed.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

from symctrl.bounds import claimed
from symctrl.context import current
from symctrl.expr import Expr, Nonconforming, deferred, lift
from symctrl.fleet import Fleet
from symctrl.records import Named


class StudyError(ValueError):
    """Something in a study, or in what is asked of it, that must be put right; the message says what."""


class Entered(Protocol):
    """What an entry needs of its study: its name, its fleet, and the tables of claims and of conditions."""

    @property
    def name(self) -> str: ...
    @property
    def of_fleet(self) -> Fleet | None: ...
    @property
    def entries(self) -> dict[str, Entry]: ...
    @property
    def conditions(self) -> dict[str, Entry]: ...


@dataclass(frozen=True)
class Entry:
    """One function of a study. form: printed, corrected, claimed, definition, law or condition.

    id: the function's name. sentence: the first paragraph of its docstring. nodes: which of i and j it takes.
    readings: the values of its other argument, by name. when: the outcome that `finding` belongs to.
    """

    id: str
    equation: str
    form: str
    function: Callable[..., Any]
    sentence: str
    nodes: tuple[str, ...]
    readings: Mapping[str, Any] = field(default_factory=dict)
    reading: str | None = None
    corrects: str | None = None
    why: str | None = None
    using: tuple[Any, ...] = ()
    finding: Mapping[str, str] = field(default_factory=dict)

    @property
    def ids(self) -> list[str]:
        return [f"{self.id}[{name}]" for name in self.readings] or [self.id]

    def call(self, study: Entered, reading: str | None = None) -> Any:
        """The function's result, for the generic node i and its neighbour j."""
        fleet = study.of_fleet
        arguments: list[Any] = []
        for node in self.nodes:
            assert fleet is not None
            arguments.append(fleet.neighbour if node == "j" else fleet.node)
        if reading is not None:
            arguments.append(self.readings[reading])
        result = self.function(*arguments)
        if result is None:
            raise StudyError(
                f"{self.id}: the function returns nothing; it must return the {_product(self.form)}"
            )
        return claimed(result)


def enter(
    study: Entered,
    function: Callable[..., Any],
    form: str,
    equation: str,
    readings: Mapping[str, Any] | None = None,
    reading: str | None = None,
    corrects: str | None = None,
    why: str | None = None,
    using: Any = (),
    finding: Mapping[str, str] | None = None,
) -> Entry:
    """Enter a function under its name. Raises StudyError for a second id, a missing sentence, or wrong
    arguments.
    """
    name = function.__name__
    if name in study.entries or name in study.conditions:
        raise StudyError(f"there are two functions {name} in the study {study.name}; a name is the id of one")
    sentence = " ".join((inspect.getdoc(function) or "").split("\n\n")[0].split())
    sentence = sentence or why or ""
    if not sentence and form not in ("definition", "law"):
        raise StudyError(f"{name}: the docstring must say the claim in a sentence")
    parameters = list(inspect.signature(function).parameters)
    nodes = tuple(p for p in parameters if p in ("i", "j"))
    if nodes and study.of_fleet is None:
        raise StudyError(f"{name} takes a node, but the study has no fleet: fleet = study.fleet()")
    others = len(parameters) - len(nodes)
    if others != bool(readings) or (others and parameters[-1] in nodes):
        raise StudyError(
            f"{name}: a function takes the nodes i and j of a fleet and, last, the reading of readings="
        )
    outcomes = dict(finding or {})
    if unknown := set(outcomes) - {"proved", "refuted", "ill-formed", "undecided"}:
        raise StudyError(
            f"{name}: finding= has a sentence for each outcome; {', '.join(sorted(unknown))} is none"
        )
    entry = Entry(
        name,
        equation,
        form,
        function,
        sentence,
        nodes,
        dict(readings or {}),
        reading,
        corrects,
        why,
        tuple(using),
        outcomes,
    )
    (study.conditions if form == "condition" else study.entries)[name] = entry
    return entry


class Definition:
    """A named quantity: called, it gives its name as an expression whose value is the function's."""

    def __init__(self, entry: Entry, study: Entered) -> None:
        self.entry = entry
        self.study = study
        self.correction: Entry | None = None
        self._bodies: dict[Any, Expr] = {}

    def correct(self, entry: Entry) -> None:
        self.correction = entry

    def __call__(self, *nodes: Any) -> Expr:
        """The quantity, in a fleet at a node. Raises Nonconforming where its formula does not conform."""
        if len(nodes) != len(self.entry.nodes):
            wanted = f"{self.entry.id}({', '.join(self.entry.nodes)})"
            raise StudyError(f"the definition {self.entry.id} is called as {wanted}")
        if len(nodes) > 1:
            return lift(self.entry.function(*nodes))
        where = f".{nodes[0].letter}" if nodes else ""
        return deferred(
            Named(self.entry.id + where, _label_latex(self.entry.id, where), self.body()), self.body().shape
        )

    def variant(self) -> Entry:
        """The entry that holds in the instance at hand: the printed one, or its correction."""
        if self.correction is not None and current().variant == "corrected":
            return self.correction
        return self.entry

    def body(self) -> Expr:
        """The formula (at node i)."""
        entry, instance = self.variant(), current()
        key = (entry.id, instance.graph, instance.variant)
        if key not in self._bodies:
            try:
                self._bodies[key] = lift(entry.call(self.study))
            except Nonconforming as error:
                raise Nonconforming(f"definition {entry.id} {entry.equation}: {error}") from None
        return self._bodies[key]


class Law:
    """A control law: what an input is set to. In a fleet, at every node."""

    def __init__(self, entry: Entry, study: Entered, u: Any) -> None:
        self.entry = entry
        self.study = study
        self.u = u
        self.correction: Entry | None = None

    @property
    def name(self) -> str:
        return self.entry.id

    @property
    def target(self) -> Expr:
        """The input symbol (at node i)."""
        fleet = self.study.of_fleet
        made = self.u[fleet.node] if self.entry.nodes and fleet is not None else self.u
        if not isinstance(made, Expr) or made.op != "symbol":
            raise StudyError(f"the law {self.name} sets an input that the study declares, not {self.u!r}")
        return made

    def correct(self, entry: Entry) -> None:
        self.correction = entry

    def variant(self) -> Entry:
        if self.correction is not None and current().variant == "corrected":
            return self.correction
        return self.entry

    def body(self) -> Expr:
        """The formula (at node i). Raises Nonconforming, also where it has not the input's shape."""
        entry = self.variant()
        try:
            made = lift(entry.call(self.study))
        except Nonconforming as error:
            raise Nonconforming(f"law {entry.id} {entry.equation}: {error}") from None
        if made.shape != self.target.shape:
            raise Nonconforming(
                f"law {entry.id} {entry.equation}: the input is "
                f"{self.target.shape[0]}x{self.target.shape[1]}, the law {made.shape[0]}x{made.shape[1]}"
            )
        return made


def _label_latex(name: str, where: str) -> str:
    from symctrl.latex import name_latex

    return name_latex(name + where)


def _product(form: str) -> str:
    return {"definition": "quantity", "law": "input"}.get(form, "claim, like equal(a, b)")
