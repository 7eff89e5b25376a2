"""A study: one paper, or a user's own design, written once as expressions, definitions, laws and
statements.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from symctrl.context import Instance, current
from symctrl.entries import component_names
from symctrl.expr import Expr, lift
from symctrl.facts import Fact
from symctrl.fleet import EIGENVALUE
from symctrl.model import Model
from symctrl.records import rate
from symctrl.theorem import ArgumentEntry, CounterexampleEntry, Run
from symctrl.written import Definition, Entry, Law, StudyError, enter

if TYPE_CHECKING:
    import networkx as nx


class Study(Model):
    """Symbols, model, laws, definitions and statements of one paper.

    A study is symbolic in sizes, graph and gains; `at` gives an instance.
    """

    def __init__(self, name: str, source: str = "") -> None:
        super().__init__()
        self.name = name
        self.source = source
        self.laws: dict[str, Law] = {}
        self.entries: dict[str, Entry] = {}
        self.conditions: dict[str, Entry] = {}
        self.numbers: list[str] = []
        self.rejections: dict[str, str] = {}
        self.arguments: list[ArgumentEntry] = []
        self.counterexamples: list[CounterexampleEntry] = []
        self.instance = Instance()

    # Statements

    def rate(self, x: Any, law: Law | None = None) -> Expr:
        """The time derivative of a definition or expression along the motion, under a law. It is never typed
        in.
        """
        return rate(x() if isinstance(x, Definition) else lift(x), law.name if law is not None else None)

    def law(self, equation: str, u: Any, **options: Any) -> Callable[[Callable[..., Any]], Law]:
        """Decorator: the function's result is what the input u is set to."""
        return lambda function: self._law(function, equation, u, options)

    def definition(self, equation: str, **options: Any) -> Callable[[Callable[..., Any]], Definition]:
        """Decorator: the function is a named quantity."""
        return lambda function: Definition(enter(self, function, "definition", equation, **options), self)

    def printed(self, equation: str, **options: Any) -> Callable[[Callable[..., Any]], Entry]:
        """Decorator: the claim as the paper has it, faults included."""
        return lambda function: enter(self, function, "printed", equation, **options)

    def claimed(self, equation: str, **options: Any) -> Callable[[Callable[..., Any]], Entry]:
        """Decorator: a claim of the author's own design, which must stand."""
        return lambda function: enter(self, function, "claimed", equation, **options)

    def corrected(self, printed: Any, why: str, **options: Any) -> Callable[[Callable[..., Any]], Any]:
        """Decorator: the smallest change that makes a printed statement, definition or law hold; `why` in one
        sentence.
        """
        entry: Entry = printed.entry if isinstance(printed, Definition | Law) else printed
        if not isinstance(entry, Entry) or entry.form == "corrected":
            raise StudyError(
                "corrected(..) takes the printed statement, definition or law itself, not its name"
            )

        def decorate(function: Callable[..., Any]) -> Any:
            made = enter(self, function, "corrected", entry.equation, corrects=entry.id, why=why, **options)
            if isinstance(printed, Definition | Law):
                printed.correct(made)
                return printed
            return made

        return decorate

    def condition(self, equation: str, **options: Any) -> Callable[[Callable[..., Any]], Entry]:
        """Decorator: what a step of the proof asks of the gains: one bound or matrix, or a list of these.

        It is no claim, for it holds for some gains and not for others; `symctrl gains` decides for which. It
        may speak of `fleet.eigenvalue`, and of `fleet.degree(i)` where it takes the node i.
        """
        return lambda function: enter(self, function, "condition", equation, **options)

    def argument(self, theorem: Entry | str) -> Callable[[Callable[[Run], Any]], ArgumentEntry]:
        """Decorator: a chain of rules for a theorem, line by line; the function takes every solution."""

        def decorate(function: Callable[[Run], Any]) -> ArgumentEntry:
            made = ArgumentEntry(self._theorem_id(theorem), function.__name__, function)
            self._unused(self.arguments, made)
            self.arguments.append(made)
            return made

        return decorate

    def counterexample(
        self, theorem: Entry | str, against: Fact | None = None
    ) -> Callable[[Callable[[], Any]], CounterexampleEntry]:
        """Decorator: what contradicts a conclusion of a theorem (all its conclusions, if `against` is left
        out).

        The function returns at(..), along(..), leaves(..), undefined(..) or unstable(..).
        """

        def decorate(function: Callable[[], Any]) -> CounterexampleEntry:
            made = CounterexampleEntry(self._theorem_id(theorem), function.__name__, function, against)
            self._unused(self.counterexamples, made)
            self.counterexamples.append(made)
            return made

        return decorate

    def rejected(self, claim: Entry, why: str) -> None:
        """The printed claim fails and nothing takes its place."""
        self.rejections[claim.id] = why

    def numbered(self, *equations: str) -> None:
        """What the paper numbers: "(1)-(22)", "lemma 1", .."""
        for text in equations:
            first, dash, last = text.replace("–", "-").partition("-")
            if dash and first.strip("() ").isdigit() and last.strip("() ").isdigit():
                self.numbers += [f"({k})" for k in range(int(first.strip("() ")), int(last.strip("() ")) + 1)]
            else:
                self.numbers.append(text)

    def statement_ids(self) -> list[str]:
        """The ids of all rows, in the order in which they are written."""
        return [id_ for entry in self.entries.values() for id_ in entry.ids]

    # Instances

    def at(self, graph: nx.Graph | None = None, values: Mapping[str, str] | None = None) -> Study:
        """The study on a graph and with other exact values. Raises StudyError for unknown names and gains
        that are not positive.
        """
        from symctrl.graphs import name

        if graph is not None and self.of_fleet is None:
            raise StudyError(f"the study {self.name} has no fleet, so it takes no graph")
        chosen = dict(self.instance.values)
        for key, text in (values or {}).items():
            chosen[key] = self._checked_value(key, text)
        made = object.__new__(Study)
        made.__dict__.update(self.__dict__)
        made.instance = replace(self.instance, graph=graph or self.instance.graph, values=chosen)
        made.graph = name(graph) if graph is not None else self.graph
        return made

    def value(self, scalar: str) -> Fraction | None:
        """The exact value of a parameter's scalar in the instance at hand, if it has one."""
        base = scalar.partition("[")[0]
        declared = self.symbols[base].values.get(scalar) if base in self.symbols else None
        return current().values.get(scalar, declared)

    def all_values(self) -> dict[str, Fraction]:
        """The exact values of all parameters that have one, in the instance at hand."""
        declared = {name: v for s in self.symbols.values() for name, v in s.values.items()}
        return declared | dict(current().values)

    def parameter_names(self) -> list[str]:
        """The scalars of all parameters that belong to no node."""
        return [
            name
            for base, symbol in self.symbols.items()
            if symbol.kind == "parameter" and "." not in base and base != EIGENVALUE
            for name in component_names(base, symbol.expr.shape, symbol.expr.args[2])
        ]

    def _checked_value(self, key: str, text: str) -> Fraction:
        from difflib import get_close_matches

        base = key.partition("[")[0]
        known = list(dict.fromkeys(name.partition("[")[0] for name in self.parameter_names()))
        if base not in known:
            near = get_close_matches(base, known, 3, 0.4) or known
            raise StudyError(f"{self.name} has no parameter {key}; it has {', '.join(near)}")
        expr = self.symbols[base].expr
        entries = list(dict.fromkeys(component_names(base, expr.shape, expr.args[2])))
        if key not in entries:
            raise StudyError(f"{self.name} has no parameter {key}; {base} has {', '.join(entries)}")
        try:
            value: Fraction = lift(text).args[0]
        except ValueError:
            raise StudyError(f"{key}={text}: not an exact number; write 0.4, 2/5 or 1e-3") from None
        if self.symbols[base].gain and value <= 0:
            raise StudyError(f"{key}={text}: the gain {key} must be positive")
        return value

    def _theorem_id(self, theorem: Entry | str) -> str:
        from difflib import get_close_matches

        if isinstance(theorem, Entry):
            return theorem.id
        if theorem not in self.entries:
            near = get_close_matches(theorem, self.entries, 3, 0.4) or list(self.entries)[-3:]
            raise StudyError(f"{theorem} is no theorem of {self.name}; it has {', '.join(near)}")
        return theorem

    def _unused(self, known: Sequence[Any], made: Any) -> None:
        if any((one.theorem, one.id) == (made.theorem, made.id) for one in known):
            raise StudyError(f"{made.theorem} has two functions {made.id}; a name is the id of one")

    def _law(self, function: Callable[..., Any], equation: str, u: Any, options: dict[str, Any]) -> Law:
        made = Law(enter(self, function, "law", equation, **options), self, u)
        self.laws[made.name] = made
        return made
