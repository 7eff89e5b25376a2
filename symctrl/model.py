"""The model of a study: its symbols, what is assumed of them, and how states move."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from symctrl.bounds import Bound, Statement, claimed
from symctrl.entries import component_names
from symctrl.expr import Comparison, Expr, Liftable, deferred, foreign, lift, symbol
from symctrl.fleet import Fleet
from symctrl.quaternion import Quaternion
from symctrl.records import Undefined
from symctrl.statements import Definite, Equal, Nonzero, equal
from symctrl.written import StudyError

if TYPE_CHECKING:
    import casadi as ca


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


class Model:
    """Symbols, assumptions and motions, symbolic in sizes, graph and gains."""

    def __init__(self) -> None:
        self.symbols: dict[str, Symbol] = {}
        self.assumed: list[Assumed] = []
        self.motions: list[tuple[Expr, Expr]] = []
        self.of_fleet: Fleet | None = None
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

    # Assumptions

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

    # Motions

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


def _numbers(value: Any) -> list[Fraction]:
    if value is None:
        return []
    return [entry for entry in lift(value).entries if isinstance(entry, Fraction)]


def _range(name: str, numbers: list[Fraction], within: str) -> tuple[Fraction, Fraction]:
    if len(numbers) != 1 or not within.endswith("%"):
        raise StudyError(f'{name}: within= takes a percentage of the one value, like within="10%"')
    spread = abs(numbers[0]) * Fraction(within[:-1]) / 100
    return numbers[0] - spread, numbers[0] + spread
