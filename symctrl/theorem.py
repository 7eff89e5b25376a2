"""Theorems as an author writes them: a claim, and arguments for it as chains of rules.

An argument only records its lines; they are decided by `symctrl.rules`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from symctrl.bounds import Bound, Statement, claimed
from symctrl.expr import Comparison, Expr, lift
from symctrl.facts import Fact, point
from symctrl.quaternion import Quaternion
from symctrl.statements import Definite, Equal, LaplacianBound, Nonzero
from symctrl.text import text
from symctrl.written import Definition, Law

SUPPOSABLE = frozenset(("tends", "bounded", "apart", "summable"))


@dataclass(frozen=True, eq=False, repr=False)
class About(Statement):
    """An assumption and what it is about: parameter, initial, signal or trajectory."""

    claim: Statement
    about: str

    @property
    def kind(self) -> str:
        return self.claim.kind

    def latex(self) -> str:
        return self.claim.latex()

    def text(self) -> str:
        where = {"initial": " at the beginning", "trajectory": " along the trajectory"}
        return f"{self.claim.text()}{where.get(self.about, '')}"


@dataclass(frozen=True, eq=False, repr=False)
class Theorem(Statement):
    """What holds for every solution of the closed loop, under what is given.

    given: assumptions by what they are about. suppose: facts assumed of solutions or signals. then: the
    conclusions. laws: those that close the loop; None for all of the study. free: definitions whose formulas
    are not looked at: the theorem is for all their values. trajectory: with the study's assumptions about the
    trajectory.
    """

    given: tuple[About, ...]
    suppose: tuple[Fact, ...]
    then: tuple[Fact, ...]
    laws: tuple[Law, ...] | None = None
    free: tuple[Definition, ...] = ()
    trajectory: bool = True

    @property
    def kind(self) -> str:
        return "theorem"

    def latex(self) -> str:
        then = r",\; ".join(fact.latex() for fact in self.then)
        given = r",\; ".join(one.latex() for one in (*self.given, *self.suppose))
        return rf"{given} \implies {then}" if given else then

    def text(self) -> str:
        then = " and ".join(fact.text() for fact in self.then)
        given = " and ".join(one.text() for one in (*self.given, *self.suppose))
        return f"if {given}, then {then}" if given else then


def claim(
    given: Any = (), then: Any = (), laws: Any = None, free: Any = (), trajectory: bool = True
) -> Theorem:
    """A theorem: under what is given, every solution exists for all time and does what `then` says.

    given: assumptions (about parameters, or signals where they speak of one), `initially(..)`,
    `along_trajectory(..)`, and facts like summable(w). then: facts. laws: the laws that close the loop, all
    of the study if left out. free: definitions that are signals here, with any values. trajectory: are the
    study's assumptions about the trajectory made too? Raises TypeError.
    """
    assumptions: list[About] = []
    suppose: list[Fact] = []
    for one in _listed(given):
        plain = claimed(one)
        if isinstance(plain, Fact):
            if plain.word not in SUPPOSABLE:
                raise TypeError(
                    f"given: {plain.text()} cannot be assumed; tends, bounded, apart, summable can"
                )
            suppose.append(plain)
        elif isinstance(plain, About):
            assumptions.append(plain)
        elif isinstance(plain, Equal | Bound | Definite | Nonzero | LaplacianBound):
            assumptions.append(About(plain, "parameter"))
        else:
            raise TypeError(f"given: an assumption is an equation, a bound, .. or a fact, not {one!r}")
    conclusions = _listed(then)
    for fact in conclusions:
        if not isinstance(fact, Fact):
            raise TypeError(f"then: a conclusion is a fact like tends(x), not {fact!r}")
    if not conclusions:
        raise TypeError("then: a theorem concludes something, like then=[tends(x)]")
    closing, signals = _laws(laws), _definitions(free)
    return Theorem(tuple(assumptions), tuple(suppose), tuple(conclusions), closing, signals, trajectory)


def initially(claim: Statement | Comparison) -> About:
    """An assumption about the initial state."""
    return About(_plain(claim, "initially"), "initial")


def along_trajectory(claim: Statement | Comparison) -> About:
    """An assumption about the whole trajectory: the theorem then stands conditionally."""
    return About(_plain(claim, "along_trajectory"), "trajectory")


@dataclass(frozen=True, eq=False)
class ArgumentEntry:
    """An argument for a theorem, by the ids of both."""

    theorem: str
    id: str
    function: Callable[[Run], Any]


@dataclass(frozen=True, eq=False)
class CounterexampleEntry:
    """What is offered against a theorem, or against one of its conclusions."""

    theorem: str
    id: str
    function: Callable[[], Any]
    against: Fact | None = None


@dataclass(frozen=True, eq=False)
class Line:
    """One line of an argument. what: the arguments of the rule, by name."""

    rule: str
    what: Mapping[str, Any]

    @property
    def given(self) -> dict[str, Any]:
        """What the author did not leave out."""
        return {
            name: value
            for name, value in self.what.items()
            if value is not None and not (isinstance(value, tuple | dict) and not value)
        }

    def text(self) -> str:
        """The line as it was written, in short."""
        return f"{self.rule}({'; '.join(f'{name}: {_shown(value)}' for name, value in self.given.items())})"


class Run:
    """Every solution of the closed loop, as an argument speaks of it: each method is one line.

    What a line takes is an expression, a definition, or a column of them; `by` lists what already has a fact.
    """

    def __init__(self) -> None:
        self.lines: list[Line] = []

    def falls(self, V: Any, by: Any = (), plus: Any = (), above: Any = None) -> None:
        """V' <= -(sum of by) + (sum of plus): V is bounded, each of `by` summable.

        plus: summable inputs. above: a constant lower bound of V; 0 if left out.
        """
        self._line("falls", V=_one(V), by=_some(by), plus=_some(plus), above=_maybe(above))

    def decays(
        self,
        V: Any,
        a: Any = None,
        power: tuple[Any, Any, Any] | None = None,
        c: Any = None,
        input: Any = None,
        outside: Any = None,
        rate: Any = None,
        radius: Any = None,
        time: Any = None,
    ) -> None:
        """V' <= -a V - b rho^(1+gamma) + c + input, with power = (b, gamma, rho) and rho^2 = V.

        outside: a radius r; then V >= r gives V' <= -rate. radius: an r at which V falls, for a c that is not
        zero. time: a bound of the time in which zero, or the radius, is reached.
        """
        if outside is not None:
            if rate is None:
                raise TypeError(
                    "decays(V, outside=r, rate=d): the rate d > 0 at which V falls outside is missing"
                )
            self._line("outside", V=_one(V), radius=lift(outside), rate=lift(rate), time=_maybe(time))
            return
        b, gamma, rho = (_maybe(x) for x in power) if power else (None, None, None)
        self._line(
            "decays",
            V=_one(V),
            a=_maybe(a),
            b=b,
            gamma=gamma,
            rho=rho,
            c=_maybe(c),
            input=_maybe(input),
            radius=_maybe(radius),
            time=_maybe(time),
        )

    def holds(self, claim: Any) -> None:
        """What is true of every state: an inequality, equation or nonzero(x), an assumption of the lines
        below.
        """
        plain = claimed(claim)
        if isinstance(plain, Equal):
            kind, e = "zero", plain.left - plain.right
        elif isinstance(plain, Nonzero):
            kind, e = "nonzero", plain.expr
        elif isinstance(plain, Bound):
            kind, e = "positive" if plain.strict else "nonnegative", plain.expr
        else:
            raise TypeError(f"holds takes an equation, a bound or nonzero(x), not {claim!r}")
        self._line("holds", e=_some(e), kind=kind)

    def part(self, term: Any, of: Any) -> None:
        """A term that is not negative is not above its sum over all nodes, for the lines below."""
        self._line("part", term=_one(term), of=_one(of))

    def keeps(self, g: Any, a: Any = None) -> None:
        """g' >= -a g, or g is not zero wherever the field has a value: where g >= 0 (g > 0) at the beginning
        it stays so, and is an assumption of the lines below.
        """
        if isinstance(g, Comparison | Bound):
            g = claimed(g).expr
        self._line("keeps", g=_some(g), a=_maybe(a))

    def exists(self) -> None:
        """Every solution exists for all time, for every state is bounded and no edge is met."""
        self._line("exists")

    def barbalat(
        self, *e: Any, of: Any = None, least: Any = None, power: Any = None, rate: Any = None
    ) -> None:
        """e tends to zero: |e|^power (2, or 1) times `least` is below the summable `of`, and its rate is
        bounded, or below the summable `rate`. What is left out is looked for.
        """
        self._line(
            "barbalat",
            e=_column(e),
            of=_maybe(of),
            least=_maybe(least),
            power=_power(power),
            rate=_maybe(rate),
        )

    def barbalat_rate(self, *e: Any) -> None:
        """The rate of e tends to zero, for e does and its second rate is bounded."""
        self._line("barbalat_rate", e=_column(e))

    def lasalle(self, V: Any, zero: Any, limit: Any = None) -> None:
        """V' <= 0, and zero only where `zero` is: the solutions tend to where it stays so; `limit` vanishes
        there.
        """
        zeros = _some(zero)
        self._line("lasalle", V=_one(V), zero=zeros, limit=zeros if limit is None else _some(limit))

    def lyapunov(self, V: Any, at: Mapping[str, Any], least: Any = None, radius: Any = None) -> None:
        """The point is stable: V is zero there, V >= least |x - at|^2, V' <= 0, wherever |x - at|^2 <=
        radius.
        """
        self._line(
            "lyapunov", V=_one(V), at=point(at, "lyapunov"), least=_maybe(least), radius=_maybe(radius)
        )

    def bounded(self, *e: Any, by: Any = (), least: Any = None, offset: Any = None, rate: Any = None) -> None:
        """e is bounded: composed of what is, or least e^2 <= offset + (sum of by), or by a summable rate."""
        self._carries(
            "bounded", e, by=_some(by), least=_maybe(least), offset=_maybe(offset), rate=_maybe(rate)
        )

    def tends(self, *e: Any, by: Any = (), least: Any = None, times: Any = (), divisor: Any = None) -> None:
        """e tends to zero: divisor e is the sum of times by, or least e^2 <= by, where `by` tends to zero."""
        self._carries(
            "tends", e, by=_some(by), least=_maybe(least), times=_some(times), divisor=_maybe(divisor)
        )

    def summable(self, *e: Any, by: Any = (), least: Any = None) -> None:
        """e is summable: least |e| <= the sum of by."""
        self._carries("summable", e, by=_some(by), least=_maybe(least))

    def exponentially(self, *e: Any, by: Any = (), least: Any = None) -> None:
        """e decays at half the rate of `by`: least e^2 <= by."""
        self._carries("exponentially", e, by=_some(by), least=_maybe(least))

    def apart(self, *e: Any, least: Any) -> None:
        """e stays apart from zero: e^2 >= least > 0."""
        self._carries("apart", e, least=_maybe(least))

    def carries(self, fact: Fact) -> None:
        """A fact that follows from those above; for sets, from a smaller set."""
        if not isinstance(fact, Fact):
            raise TypeError(f"carries takes a fact, like settles(x <= 1), not {fact!r}")
        self._line("carries", fact=fact)

    def _carries(self, word: str, e: Sequence[Any], **how: Any) -> None:
        self._line("carries", fact=Fact(word, _column(e)), **how)

    def _line(self, rule: str, **what: Any) -> None:
        self.lines.append(Line(rule, what))


def _power(power: Any) -> Any:
    """1 or 2 as they are, for which there are formulas of their own; else the expression."""
    if power is None or (isinstance(power, int) and power in (1, 2)):
        return power
    return lift(power)


def _shown(value: Any) -> str:
    if isinstance(value, tuple):
        return ", ".join(map(_shown, value))
    if isinstance(value, Mapping):
        return ", ".join(f"{name} = {_shown(entry)}" for name, entry in value.items())
    if isinstance(value, Expr):
        return text(value)
    return value.text() if isinstance(value, Statement) else str(value)


def _one(x: Any) -> Expr:
    made = x() if isinstance(x, Definition) else lift(x)
    if made.shape != (1, 1):
        raise TypeError(f"a rule's function is a scalar, not {made!r}")
    return made


def _maybe(x: Any) -> Expr | None:
    return None if x is None else _one(x)


def _some(x: Any) -> tuple[Expr, ...]:
    """The scalar components of an expression, or of a list of them."""
    if x is None:
        return ()
    parts = x if isinstance(x, list | tuple) else [x]
    return tuple(entry for part in parts for entry in _components(part))


def _components(part: Any) -> list[Expr]:
    if isinstance(part, Quaternion):
        return [*part.vector, part.scalar]
    made = part() if isinstance(part, Definition) else lift(part)
    return [made] if made.shape == (1, 1) else list(made)


def _column(parts: Sequence[Any]) -> Expr:
    from symctrl.vectors import stack

    entries = _some(list(parts))
    if not entries:
        raise TypeError("a line speaks of at least one expression")
    return entries[0] if len(entries) == 1 else stack(*entries)


def _listed(x: Any) -> list[Any]:
    return list(x) if isinstance(x, list | tuple) else [x]


def _laws(laws: Any) -> tuple[Law, ...] | None:
    if laws is None:
        return None
    listed = _listed(laws)
    for law in listed:
        if not isinstance(law, Law):
            raise TypeError(f"laws: {law!r} is no law of the study")
    return tuple(listed)


def _definitions(free: Any) -> tuple[Definition, ...]:
    listed = _listed(free)
    for one in listed:
        if not isinstance(one, Definition):
            raise TypeError(f"free: {one!r} is no definition of the study")
    return tuple(listed)


def _plain(claim: Any, what: str) -> Statement:
    plain = claimed(claim)
    if not isinstance(plain, Equal | Bound | Definite | Nonzero | LaplacianBound):
        raise TypeError(f"{what} takes an equation, a bound or nonzero(x), not {claim!r}")
    return plain
