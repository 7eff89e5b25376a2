"""The closed loop of a theorem as pure data: motion, laws, assumptions, conclusions, quantities."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from symctrl.collect import Collector, Used, _sides, refuse_circles, refuse_other_loops
from symctrl.entries import component_names
from symctrl.expr import Expr, walk
from symctrl.facts import SETS, Fact
from symctrl.graph import Instruction, Tape
from symctrl.kernel import values as kernel
from symctrl.kernel.argument import extended
from symctrl.kernel.compose import rates_of
from symctrl.kernel.form import read_statement
from symctrl.problem import ADVICE, PROVED, Assumption, Claim, Meaning, Output, Problem, Use, split, star
from symctrl.reach import Reach, _without_idle_law
from symctrl.records import Rate, rate
from symctrl.statements import Equal
from symctrl.theorem import About, Theorem
from symctrl.written import Law, StudyError

if TYPE_CHECKING:
    from symctrl.study import Study

Sentence = dict[str, Any]


class Loop:
    """The problem of a theorem, and more quantities as they are asked for.

    problem: the theorem alone, its statement. statement: the kernel's form of it with all quantities and
    rates. using: proved statements; the right side of an equation takes the place of what is on its left.
    """

    def __init__(
        self,
        study: Study,
        theorem: Theorem,
        id_: str,
        using: Sequence[Used] = (),
        changed: Changed | None = None,
    ) -> None:
        self.study = study
        self.theorem = theorem
        self.using = using
        self.laws = _laws_of(study, theorem)
        changed = changed or Changed()
        self.collector = Collector(study, bodies=changed.laws)
        self.law = " and ".join(law.name for law in self.laws) or None
        self.suppose, self.then = self._claim_listing(theorem)
        if changed.forgotten is not None:
            del self.suppose[changed.forgotten]
        self._close()
        dropped = slice(0)
        for k, given in enumerate(theorem.given):
            before = len(self.collector.given)
            self.collector.assume(given.claim, self._about(given))
            if k == changed.dropped:
                dropped = slice(before, len(self.collector.given))
            self._close()
        for used in using:
            if not isinstance(used.claim, Equal):
                self.collector.assume(used.claim, PROVED)
        with study.along_trajectory(changed.along and theorem.trajectory):
            self.collector._assume_what_occurs()
        self._close()
        del self.collector.given[dropped]  # only now: the listings of the others keep their names
        empty = Problem(study.name, id_, theorem.text(), {}, Claim("theorem", "claim", theorem={}))
        self.problem = self._base(empty)
        self.statement = extended(read_statement(self.problem.statement()), ())
        self.minted: tuple[dict[str, Any], dict[str, Any]] = self._minted_of(self.statement)
        self.quantities: dict[str, Expr | None] = {}
        self._by_tape: dict[str, str] = {}
        self._listings: dict[int, tuple[Tape, kernel.Listing]] = {}

    def _about(self, given: About) -> str:
        """What is assumed of a free definition is assumed of the trajectory, if that depends on states."""
        own = {definition.entry.id for definition in self.theorem.free}
        for expr in _sides(given.claim)[0]:
            for node in walk(expr):
                label = node.args[0].label.partition(".")[0] if node.op == "deferred" else ""
                if label in own and any(self._is_state(name) for name in _symbols(node)):
                    return "trajectory"
        return given.about

    def _is_state(self, name: str) -> bool:
        declared = self.study.symbols.get(_declared(name))
        return declared is not None and declared.kind == "state"

    def quantity(self, what: Expr | Tape) -> str:
        """The name of a scalar expression, or of a tape of one output, as a quantity of the argument."""
        name = f"x{len(self.quantities) + 1}"
        if isinstance(what, Tape):
            self.collector.listings[name] = what
        else:
            self.collector.add(name, [what])
        tape = self.collector.listings[name]
        known = self._by_tape.get(tape.sha256)
        if known is not None:
            del self.collector.listings[name]
            return known
        self._by_tape[tape.sha256] = name
        self.quantities[name] = what if isinstance(what, Expr) else None
        self._close()
        self._extend(name)
        return name

    def rate(self, what: Expr) -> Expr:
        """The rate of an expression along the closed loop."""
        return rate(what, self.laws[0].name if self.law is not None else None)

    def _base(self, empty: Problem) -> Problem:
        """The theorem's problem with what its solutions read, and nothing else."""
        tables = self._tables(empty)
        law = self.law if self.law in tables.laws else None
        whole = reached(tables, ["claim"], law)
        if law not in whole.laws:
            self.law = None
            whole = reached(tables, ["claim"], None)
        stated = {"law": self.law, "suppose": self.suppose, "then": self.then}
        return replace(whole, claim=Claim("theorem", "claim", theorem=stated))

    def _minted_of(self, statement: kernel.Statement) -> tuple[dict[str, Any], dict[str, Any]]:
        """The listings and names that the rules have of their own."""
        listings = {n: x for n, x in statement.listings.items() if n not in self.problem.listings}
        return listings, {n: x for n, x in statement.names.items() if n not in self.problem.names}

    def _extend(self, quantity: str) -> None:
        """Bring the kernel's statement up to the collector's tables."""
        whole = self._tables(self.problem)
        listings = {name: self._listing(tape) for name, tape in whole.listings.items()}
        rates = rates_of(quantity, listings[quantity], self.law)
        self.minted[0].update(rates[0])
        self.minted[1].update(rates[1])
        self.statement = replace(
            self.statement,
            listings={**listings, **self.minted[0]},
            names={**{n: meaning_of(m) for n, m in whole.names.items()}, **self.minted[1]},
            scalars=whole.scalars,
            motion=whole.motion,
            laws=whole.laws,
        )

    def _listing(self, tape: Tape) -> kernel.Listing:
        if id(tape) not in self._listings:
            self._listings[id(tape)] = tape, listing_of(tape)
        return self._listings[id(tape)][1]

    def added(self, used: Sequence[str]) -> dict[str, Any]:
        """What the argument has beside the statement: the tables of its proof, with the quantities used."""
        old = self.problem
        whole = reached(self._tables(old), ["claim", *used], self.law)
        return {
            "listings": {
                n: t.as_json() | {"sha256": t.sha256}
                for n, t in whole.listings.items()
                if n not in old.listings
            },
            "names": {n: m.as_json() for n, m in whole.names.items() if n not in old.names},
            "scalars": {n: k for n, k in whole.scalars.items() if n not in old.scalars},
            "motion": {n: list(of) for n, of in whole.motion.items() if n not in old.motion},
            "laws": {},
        }

    def _close(self) -> None:
        """Add the motion, under the law, of every state that occurs."""
        for law in self.laws:
            if any(u in self.collector.scalars for u in _targets(law)):
                self.collector._law(law.name)
        done: set[str] = set()
        while True:
            states = [
                n for n, kind in self.collector.scalars.items() if kind != "parameter" and n not in done
            ]
            if not states:
                return
            for name in states:
                done.add(name)
                self.collector._add_motion(name)
                if self.collector.scalars[name] == "state" and name not in self.collector.motion:
                    raise StudyError(f"the state {name} has no motion: study.motion({split(name)[0]}, ...)")
            for law in self.laws:
                if any(u in self.collector.scalars for u in _targets(law)):
                    self.collector._law(law.name)

    def _tables(self, problem: Problem) -> Problem:
        """The problem with what has been collected, one law for the closed loop, and what is used in its
        place.
        """
        c = self.collector
        own = [law.name for law in self.laws]
        joint = {u: of for name in own for u, of in c.laws.get(name, {}).items()}
        laws: dict[str, Mapping[str, Output]] = {n: table for n, table in c.laws.items() if n not in own}
        if self.law is not None and joint:
            laws[self.law] = joint
        made = replace(
            problem,
            listings=dict(c.listings),
            scalars=dict(c.scalars),
            names=dict(c.names),
            motion=dict(c.motion),
            laws=laws,
            given=tuple(c.given),
        )
        for used in self.using:
            if isinstance(used.claim, Equal):
                made = c._replaced(made, used.claim)
                refuse_circles(made, used.claim)
                self._refuse_other_loops(used.claim, laws.keys())
        made = self._freed(made)
        names = {n: replace(m, law=self.law) if m.law in own else m for n, m in made.names.items()}
        listings = {name: tape for name, tape in made.listings.items() if name != ADVICE}
        return replace(made, names=names, listings=listings, uses=self._uses())

    def _refuse_other_loops(self, used: Equal, known: Collection[str]) -> None:
        """An equation under one of the laws that close the loop holds in the loop, for it holds whatever the
        other inputs are; beside them no other law may be taken.
        """
        record = used.left.args[0] if used.left.op == "deferred" else None
        own: set[str | None] = {law.name for law in self.laws}
        joint = {record.law} if isinstance(record, Rate) and record.law in own else own or {None}
        refuse_other_loops(used, {*joint, *(law for law in known if law != self.law)})

    def _freed(self, made: Problem) -> Problem:
        """The problem with the definitions that are free as signals."""
        own = {definition.entry.id for definition in self.theorem.free}
        freed = {n for n in made.names if split(n)[0] in own}
        names = {n: m for n, m in made.names.items() if n not in freed}
        return replace(made, names=names, scalars=dict(made.scalars) | dict.fromkeys(freed, "signal"))

    def _uses(self) -> tuple[Use, ...]:
        return tuple(Use(used.id, used.sha256, f"using {used.id}") for used in self.using)

    def _claim_listing(self, theorem: Theorem) -> tuple[list[Sentence], list[Sentence]]:
        exprs: list[Expr] = []
        parts = []
        for facts in (theorem.suppose, theorem.then):
            parts.append([self._sentence(fact, exprs) for fact in facts])
        read = {name for expr in exprs for name in _symbols(expr)}
        exprs += [expr for expr in whole_systems(self.study, read) if expr.args[0] not in read]
        self.collector.add("claim", exprs or [_zero()])
        return parts[0], parts[1]

    def _sentence(self, fact: Fact, exprs: list[Expr]) -> Sentence:
        made: Sentence = {"word": fact.word, "of": []}
        if fact.at:
            made["at"] = self._point(fact)
            exprs += [self.study.symbols[name].expr for name in fact.at]  # so that their motion is stated
        count = sum(e.shape[0] * e.shape[1] for e in exprs)
        if fact.of is not None:
            exprs.append(fact.of)
            made["of"] = list(range(count, count + fact.of.shape[0]))
            count += fact.of.shape[0]
        if fact.by is not None:
            exprs.append(fact.by)
            made["by"] = count
        return made | ({"zero": True} if fact.zero and fact.word in SETS else {})

    def _point(self, fact: Fact) -> dict[str, str]:
        return {name: str(value) for name, value in scalars_at(self.study, fact.at, fact.word).items()}


@dataclass(frozen=True)
class Changed:
    """A twin of a theorem: without an assumption (dropped) or a supposition (forgotten), or with other laws.

    along: with the study's assumptions about the trajectory.
    """

    dropped: int | None = None
    forgotten: int | None = None
    laws: Mapping[str, Expr] = field(default_factory=dict)
    along: bool = True


def reached(problem: Problem, roots: Sequence[str], law: str | None) -> Problem:
    """The problem with only what listings read, and the motion of that under the law, and the assumptions
    read.
    """
    reach = Reach(problem)
    for root in roots:
        reach.listing(root, 0, law)
    for assumption in problem.given:
        for of in assumption.of:
            reach.listing(of[0], 0, None)
    looped: set[str] = set()
    while new := [n for n in problem.motion if n in reach.read and n not in looped]:
        for name in new:
            looped.add(name)
            reach.listing(problem.motion[name][0], 0, law)
    entered = {name for name, _, _ in reach.visits}
    laws = {
        name: {u: of for u, of in table.items() if (name, u) in reach.replaced}
        for name, table in problem.laws.items()
    }
    laws = {name: table for name, table in laws.items() if table}
    return replace(
        problem,
        listings={name: tape for name, tape in problem.listings.items() if name in entered},
        names={n: _without_idle_law(m, laws) for n, m in problem.names.items() if n in reach.read},
        scalars={n: k for n, k in problem.scalars.items() if n in reach.read},
        motion={n: of for n, of in problem.motion.items() if n in looped or n in reach.moved},
        laws=laws,
    )


def whole_systems(study: Study, read: set[str]) -> list[Expr]:
    """All states with a motion of the systems of which a state is read; of the study's model if none is."""
    moving = {x.args[0]: x for x, _ in study.motions}
    systems = {study.symbols[_declared(name)].system for name in moving if name in read}
    return [x for name, x in moving.items() if study.symbols[_declared(name)].system in (systems or {None})]


def _declared(name: str) -> str:
    return name.replace(".i", ".*")


def _symbols(expr: Expr) -> set[str]:
    """The symbols in an expression and in all that it stands for, at node i."""
    found: set[str] = set()
    waiting = [expr]
    while waiting:
        for node in walk(waiting.pop()):
            if node.op == "symbol":
                found.add(node.args[0].replace(".j", ".i"))
            elif node.op == "deferred" and hasattr(node.args[0], "body"):
                waiting.append(node.args[0].body)
    return found


def scalars_at(study: Study, at: Mapping[str, Sequence[Any]], what: str) -> dict[str, Any]:
    """Numbers by scalar name, from numbers by symbol. Raises StudyError for unknown ones and wrong sizes."""
    from difflib import get_close_matches

    found: dict[str, Any] = {}
    for name, numbers in at.items():
        declared = study.symbols.get(name)
        if declared is None:
            near = get_close_matches(name, study.symbols, 3, 0.4) or list(study.symbols)[:8]
            raise StudyError(f"{what}: {name} is no symbol of {study.name}; it has {', '.join(near)}")
        names = component_names(name, declared.expr.shape, declared.expr.args[2])
        if len(names) != len(numbers):
            raise StudyError(
                f"{what}: {name} has {len(names)} components, and {len(numbers)} numbers were given"
            )
        found |= dict(zip(names, numbers, strict=True))
    return found


def listing_of(tape: Tape) -> kernel.Listing:
    """The kernel's form of a tape."""
    steps = tuple(kernel.Step(s.op, s.args, s.name, s.value) for s in tape.code)
    return kernel.Listing(steps, tape.outputs, tape.sha256)


def tape_of(listing: kernel.Listing) -> Tape:
    """The tape of the kernel's listing."""
    return Tape(tuple(Instruction(s.op, s.args, s.name, s.value) for s in listing.code), listing.outputs)


def meaning_of(meaning: Meaning) -> kernel.Meaning:
    of = meaning.of if meaning.of is not None else ("", 0)
    from fractions import Fraction

    return kernel.Meaning(meaning.is_, Fraction(meaning.value or 0), of, meaning.law)


def assumption_of(a: kernel.Assumption) -> Assumption:
    return Assumption(a.kind, a.of, a.text, a.about, a.size)


def _laws_of(study: Study, theorem: Theorem) -> list[Law]:
    laws = list(theorem.laws) if theorem.laws is not None else list(study.laws.values())
    targets: dict[str, str] = {}
    for law in laws:
        for u in _targets(law):
            if targets.setdefault(u, law.name) != law.name:
                raise StudyError(
                    f"two laws give {u}, {targets[u]} and {law.name}: say which closes the loop, "
                    "claim(.., laws=[..])"
                )
    return laws


def _targets(law: Law) -> list[str]:
    target = law.target
    return [star(n) for n in component_names(target.args[0].replace(".i", ".*"), target.shape)]


def _zero() -> Expr:
    from symctrl.expr import lift

    return lift(0)
