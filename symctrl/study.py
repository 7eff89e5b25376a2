"""A study: one paper, or a user's own design, written once as expressions, definitions, laws and
statements.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from symctrl.bounds import Bound, Statement, claimed
from symctrl.context import Instance, current
from symctrl.entries import component_names
from symctrl.expr import Comparison, Expr, Liftable, deferred, foreign, lift, symbol
from symctrl.facts import Fact
from symctrl.fleet import Fleet
from symctrl.quaternion import Quaternion
from symctrl.records import Undefined, rate
from symctrl.statements import Definite, Equal, Nonzero, equal
from symctrl.theorem import ArgumentEntry, CounterexampleEntry, Run
from symctrl.written import Definition, Entry, Law, StudyError, enter

if TYPE_CHECKING:
    import casadi as ca
    import networkx as nx

__all__ = ["Quaternion", "Study", "StudyError", "Symbol"]


@dataclass(frozen=True)
class Symbol:
    """A declared symbol. kind: state, parameter, input or signal. unit: None where the equations shall say
    it. system: of a state that is not one of the study's model, the name of the system that it belongs to.
    """

    expr: Expr
    kind: str
    unit: str | None
    values: Mapping[str, Fraction] = field(default_factory=dict)
    gain: bool = False
    system: str | None = None


@dataclass(frozen=True)
class Assumed:
    """An assumption of the whole study and what it is about."""

    claim: Statement
    about: str


class Study:
    """Symbols, model, laws, definitions and statements of one paper.

    A study is symbolic in sizes, graph and gains; `at` gives an instance.
    """

    def __init__(self, name: str, source: str = "") -> None:
        self.name = name
        self.source = source
        self.symbols: dict[str, Symbol] = {}
        self.assumed: list[Assumed] = []
        self.motions: list[tuple[Expr, Expr]] = []
        self.laws: dict[str, Law] = {}
        self.entries: dict[str, Entry] = {}
        self.numbers: list[str] = []
        self.rejections: dict[str, str] = {}
        self.arguments: list[ArgumentEntry] = []
        self.counterexamples: list[CounterexampleEntry] = []
        self.of_fleet: Fleet | None = None
        self.instance = Instance()
        self.graph: str | None = None
        self.on_trajectory = False

    # Symbols

    def declare(
        self,
        expr: Expr,
        kind: str,
        unit: str | None,
        values: Sequence[Fraction] = (),
        gain: bool = False,
        system: str | None = None,
    ) -> Expr:
        """Enter a symbol. Raises StudyError for a name that is taken."""
        name, _, symmetric = expr.args
        if name in self.symbols:
            raise StudyError(f"the symbol {name} is declared twice; a symbol has one meaning in a study")
        names = component_names(name, expr.shape, symmetric)
        known = dict(zip(names, values, strict=bool(values)))
        self.symbols[name] = Symbol(expr, kind, unit, known, gain, system)
        return expr

    def state(
        self,
        name: str,
        size: int = 1,
        unit: str | None = None,
        tex: str | None = None,
        system: str | None = None,
    ) -> Expr:
        """A state (size x 1); its time derivative is given by `motion`.

        system: of an abstract quantity, as in a lemma, the name of the system that it belongs to. A theorem
        is about all states of the systems of which it reads one, or of the study's own model.
        """
        return self.declare(symbol(name, (size, 1), tex), "state", unit, system=system)

    def input(self, name: str, size: int = 1, unit: str | None = None, tex: str | None = None) -> Expr:
        """A control input (size x 1), free until a law gives it."""
        return self.declare(symbol(name, (size, 1), tex), "input", unit)

    def disturbance(
        self,
        name: str,
        size: int = 1,
        unit: str | None = None,
        bound: Liftable | None = None,
        tex: str | None = None,
    ) -> Expr:
        """A signal that may take any value; with `bound`, each component lies between -bound and bound."""
        made = self.declare(symbol(name, (size, 1), tex), "signal", unit)
        if bound is not None:
            self.bounded(made, lift(bound))
        return made

    def parameter(
        self,
        name: str,
        value: Any = None,
        unit: str | None = None,
        tex: str | None = None,
        shape: tuple[int, int] = (1, 1),
        low: Liftable | None = None,
        high: Liftable | None = None,
        within: str | None = None,
    ) -> Expr:
        """A constant: symbolic in decisions, with an exact value or a range where it is given.

        value: a number, a string like "0.95" or "1/3", or a list. low, high: assumed bounds. within: "10%" of
        the value.
        """
        numbers = _numbers(value)
        made = self.declare(symbol(name, shape, tex), "parameter", unit, numbers)
        if within is not None:
            low, high = _range(name, numbers, within)
        if low is not None:
            self.assume(made >= lift(low))
        if high is not None:
            self.assume(lift(high) >= made)
        return made

    def gain(self, name: str, value: Any = None, unit: str | None = None, tex: str | None = None) -> Expr:
        """A positive constant that a designer chooses. Without a unit it gets the one that the equations
        force.
        """
        made = self.declare(symbol(name, (1, 1), tex), "parameter", unit, _numbers(value), gain=True)
        self.assume(made > 0)
        return made

    def inertia(self, name: str, value: Any = None, unit: str | None = "kg*m^2") -> Expr:
        """A symmetric positive definite 3x3 matrix. value: its rows. Raises StudyError for rows that are not
        symmetric.
        """
        rows = [[Fraction(str(x)) for x in row] for row in value] if value is not None else []
        if rows != [list(column) for column in zip(*rows, strict=True)]:
            raise StudyError(f"the inertia {name} must be symmetric; got {value}")
        made = self.declare(
            symbol(name, (3, 3), symmetric=True), "parameter", unit, [x for row in rows for x in row]
        )
        self.assume_definite(made)
        return made

    def unit_quaternion(self, name: str) -> Quaternion:
        """An attitude quaternion of norm one: vector part `name`, scalar part `name`0."""
        made = Quaternion(self.state(name, 3, "1"), self.state(f"{name}0", 1, "1"))
        self.assume_unit(made)
        return made

    def undefined(self, name: str, shape: tuple[int, int] = (1, 1)) -> Expr:
        """A letter that the paper uses and never defines: what uses it is ill-formed."""
        return deferred(Undefined(name, name), shape)

    def wrap(self, sx: ca.SX, text: str = "wrapped") -> Expr:
        """An expression built with CasADi itself; what CasADi folded in it was not seen."""
        return foreign(sx, text)

    def fleet(self, name: str = "G", default: str = "ring:8") -> Fleet:
        """The study's fleet: an undirected graph that the user gives (`default` otherwise)."""
        self.of_fleet = Fleet(self, name, default)
        self.graph = default
        return self.of_fleet

    # Assumptions and equations

    def assume(self, *claims: Statement | Comparison, about: str = "parameter") -> None:
        """Assumptions of the whole study. about: parameter, initial, signal or trajectory."""
        for claim in claimed(claims):
            if not isinstance(claim, Equal | Bound | Definite | Nonzero):
                raise TypeError(
                    f"an assumption is an equation, a bound, definiteness or nonzero(x), not {claim!r}"
                )
            self.assumed.append(Assumed(claim, about))

    def assume_definite(self, M: Expr) -> None:
        self.assume(Definite(M, True))

    def assume_unit(self, q: Quaternion) -> None:
        """qᵀq + q0² = 1."""
        self.assume(equal(q.vector.T @ q.vector + q.scalar**2, 1), about="initial")

    def bounded(self, signal: Expr, bound: Expr) -> None:
        """-bound <= each component <= bound."""
        for component in signal:
            self.assume(bound - component >= 0, bound + component >= 0, about="signal")

    def motion(self, x: Expr | Quaternion, xdot: Expr) -> None:
        """The time derivative of a state. Raises StudyError where the shapes differ or x has a motion
        already.
        """
        if isinstance(x, Quaternion):
            self.motion(x.vector, xdot[:3])
            self.motion(x.scalar, xdot[3])
            return
        xdot = lift(xdot)
        if x.op != "symbol" or x.shape != xdot.shape:
            raise StudyError(
                f"motion takes a state and its time derivative of the same shape, not {x!r} and {xdot!r}"
            )
        if any(known.args[0] == x.args[0] for known, _ in self.motions):
            raise StudyError(f"the state {x.args[0]} has a motion already")
        self.motions.append((x, xdot))

    def rate(self, x: Any, law: Law | None = None) -> Expr:
        """The time derivative of a definition or expression along the motion, under a law. It is never typed
        in.
        """
        return rate(x() if isinstance(x, Definition) else lift(x), law.name if law is not None else None)

    # Statements

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

    def trajectory_assumptions(self) -> list[Assumed]:
        """What the study assumes of the whole trajectory."""
        return [a for a in self.assumed if a.about == "trajectory"]

    @contextmanager
    def along_trajectory(self, assumed: bool) -> Iterator[None]:
        """Inside, the assumptions about the trajectory count as given."""
        before = self.on_trajectory
        self.on_trajectory = assumed
        try:
            yield
        finally:
            self.on_trajectory = before

    def all_values(self) -> dict[str, Fraction]:
        """The exact values of all parameters that have one, in the instance at hand."""
        declared = {name: v for s in self.symbols.values() for name, v in s.values.items()}
        return declared | dict(current().values)

    def _checked_value(self, key: str, text: str) -> Fraction:
        from difflib import get_close_matches

        base = key.partition("[")[0]
        known = [n for n, s in self.symbols.items() if s.kind == "parameter" and "." not in n]
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


def _numbers(value: Any) -> list[Fraction]:
    if value is None:
        return []
    return [entry for entry in lift(value).entries if isinstance(entry, Fraction)]


def _range(name: str, numbers: list[Fraction], within: str) -> tuple[Fraction, Fraction]:
    if len(numbers) != 1 or not within.endswith("%"):
        raise StudyError(f'{name}: within= takes a percentage of the one value, like within="10%"')
    spread = abs(numbers[0]) * Fraction(within[:-1]) / 100
    return numbers[0] - spread, numbers[0] + spread
