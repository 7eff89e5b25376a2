"""A solution in closed form that meets what is given and contradicts a conclusion.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: functions of time with x' = f(x) at each time, f being continuous there, are a solution. A smooth e
with e^2 + k e'^2 >= c > 0 does not tend to zero, nor vanishes from some time on: else e'^2 is at least c/(2k)
from some time on, e' keeps its sign, and e grows beyond all bounds. With e^2 >= c t - d it is not bounded,
with e^2 >= c not summable. A solution on [0, T) with x^2 (T - t) >= c > 0 has no continuation to T.

A signal is a polynomial of times, sines, exponentials and the like, defined and continuous at all times;
where the solution is known up to a time only, the signal keeps a value of before from then on.

Proof fields: `time`, the name of time; `listings`, of functions of it; `functions` {scalar: output}, for all
free scalars; `until`, null or the time up to which they are a solution (with "exists": before which);
`numbers`, the constants that the contradiction needs (c, k, d, a time `at` or `from`) and `entry`, where one
function is meant its position in the conclusion (with "exists": in the motion as the statement lists it);
`proofs`, by role of the obligation {given, proof}.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

from symctrl.kernel.argument import OBLIGATION, Argument, Judge, single
from symctrl.kernel.certificate import Declined, Invalid, fields, rational, split_name, typed
from symctrl.kernel.closure import ENTIRE, Reach
from symctrl.kernel.compose import rates_of
from symctrl.kernel.contradiction import contradict
from symctrl.kernel.enclosure import Enclosure
from symctrl.kernel.evaluation import Evaluation, NoSums
from symctrl.kernel.form import _ref, read_tables
from symctrl.kernel.interval import Interval, Undecided, point
from symctrl.kernel.place import free_scalars, is_fleet, is_initial, is_signal, moves, reads, supposed
from symctrl.kernel.theorem import Checker
from symctrl.kernel.traits import SMOOTH
from symctrl.kernel.values import Assumption, Listing, Meaning, Ref, Sentence, Statement, Step
from symctrl.kernel.witness import BITS, _holds

CLOCK = "clock"
KINKED = frozenset(("FABS", "FMIN", "FMAX", "SIGN"))
JUMPING = frozenset(("FLOOR", "CEIL", "NOT", "LT", "LE", "EQ", "NE", "AND", "OR", "IF_ELSE_ZERO", "ATAN2"))
FORMULAS = {"zero": ("equal", ("g", "0")), "nonzero": ("positive", "g g *"), "positive": ("positive", "g")}


def along(statement: Statement, sentence: Sentence, table: Mapping[str, Any]) -> None:
    """Raises Invalid or Declined where the functions do not refute the theorem."""
    checker = Checker()
    checker.proofs = typed(table["proofs"], dict, "proofs")
    refute(statement, sentence, table, checker)
    checker.close("proofs")
    for condition in checker.conditions:
        raise Invalid(f"it is not shown that {condition.of[:200]} is {condition.kind}")


def refute(statement: Statement, sentence: Sentence, table: Mapping[str, Any], judge: Judge) -> None:
    """Puts to the judge that the functions are a solution, meet what is given, and contradict."""
    until = None if table["until"] is None else rational(table["until"], "until")
    if until is not None and until <= 0:
        raise Invalid("the time up to which the functions are a solution is not positive")
    strict = sentence.word == "exists"
    path = Path(statement, _composed(statement, table), table["time"], judge, until, strict)
    path.begin()
    path.solve()
    path.meet_given()
    path.meet_supposed()
    contradict(path, sentence, typed(table["numbers"], dict, "numbers"))


def _composed(statement: Statement, table: Mapping[str, Any]) -> Statement:
    """The statement in which all that is free is a function of time."""
    if is_fleet(statement):
        raise Declined("a solution of a fleet in closed form")
    time, law = typed(table["time"], str, "time"), statement.claim.law
    if split_name(time) != (time, "") or time in statement.scalars or time in statement.names:
        raise Invalid(f"{time[:60]!r} is no name for the time of this statement")
    empty: dict[str, Any] = {"scalars": {}, "names": {}, "motion": {}, "laws": {}}
    new = read_tables({"listings": table["listings"], **empty}, {})["listings"]
    free = free_scalars(statement)
    given = fields(table["functions"], list(free), "functions")
    functions = {name: _ref(ref, new, f"the function of {name}") for name, ref in given.items()}
    _require_functions(statement, new, functions, time)
    inputs = statement.laws[law] if law is not None else {}
    names = {name: _along_solution(name, m, law) for name, m in statement.names.items()}
    names |= {name: Meaning("value", of=ref) for name, ref in (functions | dict(inputs)).items()}
    clock = Listing((Step("CONST", value=Fraction(1)),), (0,), "")
    return replace(
        statement,
        listings=_joined(statement.listings, new, {CLOCK: clock}),
        names=names,
        scalars={time: "state"},
        motion={time: (CLOCK, 0)},
        laws={},
        given=(),
        claim=replace(statement.claim, law=None),
    )


def _joined(*tables: Mapping[str, Listing]) -> dict[str, Listing]:
    joined: dict[str, Listing] = {}
    for table in tables:
        for name, listing in table.items():
            if name in joined:
                raise Invalid(f"the name {name[:60]} belongs to the statement")
            joined[name] = listing
    return joined


def _along_solution(name: str, meaning: Meaning, law: str | None) -> Meaning:
    """A rate along a solution of the closed loop is the derivative by time."""
    if meaning.law not in (None, law):
        raise Declined(f"{name} is a rate under another law than that of the closed loop")
    return replace(meaning, law=None)


def _require_functions(
    statement: Statement, listings: Mapping[str, Listing], functions: Mapping[str, Ref], time: str
) -> None:
    used = set()
    for name, (listing, k) in functions.items():
        used.add(listing)
        code = single(listings[listing], k).code
        inputs = {step.name for step in code if step.op == "INPUT"}
        if inputs - {time}:
            raise Invalid(f"the function of {name} reads {sorted(inputs - {time})[0][:60]}")
        if inputs and statement.scalars[name] == "parameter":
            raise Invalid(f"the parameter {name} is not constant")
        if is_signal(statement, name) and not {step.op for step in code} <= ENTIRE:
            raise Declined(f"the signal {name} divides, or takes a root or logarithm")
    if set(listings) - used:
        raise Invalid(f"the listing {sorted(set(listings) - used)[0][:60]} is no function")


@dataclass
class Path:
    """The functions, and obligations about them. strict: `until` is the end of the maximal interval."""

    original: Statement
    whole: Statement
    time: str
    judge: Judge
    until: Fraction | None
    strict: bool
    at: Argument = field(init=False)
    count: int = 0

    def begin(self) -> None:
        """From 0 to `until`, without it if `strict`."""
        self.at = Argument(self.whole, (), self.judge)
        self.at.available.append(self.since(Fraction(0)))
        if self.until is not None:
            self.at.mint("before", [f"{self.until} @{self.time} -"])
            kind = "positive" if self.strict else "nonnegative"
            said = f"{self.time} {'<' if self.strict else '<='} {self.until}"
            self.at.available.append(Assumption(kind, (("before", 0),), text=said, about=OBLIGATION))

    def since(self, start: Fraction) -> Assumption:
        """That time is at least this."""
        name = f"since {start}"
        if name not in self.at.statement.listings:
            self.at.mint(name, [f"@{self.time} {start} -"])
        text = f"{self.time} >= {start}"
        return Assumption("nonnegative", ((name, 0),), text=text, about=OBLIGATION)

    def quantity(self, ref: Ref) -> str:
        """One output as a quantity with rates."""
        self.count += 1
        name = f"along{self.count}"
        self.at.mint_single(name, ref)
        listings, names = rates_of(name, self.at.statement.listings[name], None)
        own = self.at.statement
        if names.keys() & (own.names.keys() | own.scalars.keys()):
            raise Invalid(f"the name rate1_{name} belongs to the rules")
        self.at.statement = replace(
            own, listings=_joined(own.listings, listings), names={**own.names, **names}
        )
        return name

    def output(self, k: int) -> str:
        """A quantity of the claim."""
        return self.quantity((self.original.claim.listing, k))

    def is_smooth(self, quantity: str) -> bool:
        traits = self.at.traits(quantity)
        return traits.level == SMOOTH and not traits.jumps

    def reads_time(self, ref: Ref) -> bool:
        only = {OBLIGATION: single(self.whole.listings[ref[0]], ref[1])}
        reach = Reach(replace(self.whole, listings={**self.whole.listings, **only}))
        reach.listing(OBLIGATION, "", 0, None)
        return self.time in reach.read

    def solve(self) -> None:
        """Each state is smooth, and its derivative is its rate, which does not jump."""
        jumps = False
        states = sorted(key for key in self.original.scalars if moves(self.original, key))
        for state in states:
            if state not in self.original.motion:
                raise Invalid(f"the state {state} has no motion")
            x = self.quantity(self.whole.names[state].of)
            rate = self.quantity(self.original.motion[state])
            if not self.is_smooth(x):
                raise Declined(f"the function of {state} is not known to be smooth")
            jumps = jumps or bool(self.at.traits(rate).jumps)
            self.at.prove(f"the rate of {state}", "equal", ["x'", "f"], x=x, f=rate)
        self._meet_switches(jumps)

    def _meet_switches(self, jumps: bool) -> None:
        """No switch of the field is at its jump at any time."""
        reach = Reach(self.whole)
        for name, _ in self.original.motion.values():
            reach.listing(name, "", 0, None)
        for name, level, _ in sorted(reach.done, key=str):
            operations = {step.op for step in self.whole.listings[name].code}
            if operations & JUMPING or (level and operations & KINKED):
                raise Declined("the field has a comparison, a step, or a rate of what has a kink")
        for name in sorted({name for name, _, _ in reach.done}) if jumps else ():
            code = self.whole.listings[name].code
            for n, argument in enumerate(step.args[0] for step in code if step.op == "SIGN"):
                listing = single(Listing(code, (argument,), ""), 0)
                listings = _joined(self.at.statement.listings, {f"switch {n} of {name}": listing})
                self.at.statement = replace(self.at.statement, listings=listings)
                role = f"switch {n + 1} of {name} is not at its jump"
                self.at.prove(role, "positive", "a a *", a=f"switch {n} of {name}")

    def meet_given(self) -> None:
        """Assumptions about the initial state, and about constants, at time 0; all others at all times."""
        for k, assumption in enumerate(self.original.given):
            initial = is_initial(self.original, assumption)
            if not initial and self._is_open(assumption.of):
                raise Declined(f"that {assumption.text[:80]!r} holds after {self.until}")
            if initial or not any(self.reads_time(ref) for ref in assumption.of):
                self._meet_at_once(k, assumption)
                continue
            if len(assumption.of) != 1:
                raise Declined("an assumed matrix that is definite at all times")
            kind, formulas = FORMULAS.get(assumption.kind, ("nonnegative", "g"))
            role = f"assumption {k + 1}, {assumption.text}"
            self.at.prove(role, kind, formulas, g=self.quantity(assumption.of[0]))

    def _is_open(self, refs: Sequence[Ref]) -> bool:
        """Is it about states whose later values are not known?"""
        if self.until is None or self.strict:
            return False
        return any(moves(self.original, key) for key in reads(self.original, refs))

    def _meet_at_once(self, k: int, assumption: Assumption) -> None:
        for bits in BITS:
            try:
                holds = _holds(assumption, [self.number(ref, Fraction(0), bits) for ref in assumption.of])
            except Undecided:
                continue
            if not holds:
                raise Invalid(f"the functions do not satisfy assumption {k + 1}, {assumption.text[:80]!r}")
            return
        raise Declined(f"it is not decided that assumption {k + 1}, {assumption.text[:80]!r} holds")

    def meet_supposed(self) -> None:
        """What is supposed is shown where it is constantly zero, or between bounds that are constant."""
        for n, (sentence, ref) in enumerate(supposed(self.original), start=1):
            if self.until is not None and (self.reads_time(ref) or self._is_open([ref])):
                raise Declined("what is supposed is about all times, and the functions are not")
            role, e = f"supposed {n}, {sentence.word}", self.quantity(ref)
            if sentence.word == "bounded" and self.at.traits(e).bounded:
                continue
            if sentence.word == "apart" and not self.reads_time(ref):
                self.at.prove(role, "positive", "e e *", e=e)
            elif sentence.word in ("tends", "summable"):
                self.at.prove(role, "equal", ["e", "0"], e=e)
            else:
                raise Declined(f"that what is supposed ({sentence.word}) holds of these functions")

    def number(self, ref: Ref, time: Fraction, bits: int) -> Interval:
        """The value of an output at a time."""
        walk = Evaluation(self.whole, Enclosure(bits), lambda _: point(time), NoSums())
        value: Interval = walk.output(ref, {}, 0, None)
        return value
