"""Is a statement closed: what it reads is defined, not through itself, and what is defined is read?

Soundness-critical. Last reviewed 2026-11-24.

Relies on: a definition by well-founded recursion has exactly one value. The walk below visits every (listing,
level, law) that an evaluation of the statement can visit (as in docs/certificates.md), and refuses a cycle.
"""

from __future__ import annotations

from collections.abc import Collection

from symctrl.kernel.certificate import Declined, Invalid, at_node, per_node, split_name
from symctrl.kernel.values import Meaning, Ref, Statement

ENTIRE = frozenset(
    ("INPUT", "CONST", "ADD", "SUB", "MUL", "NEG", "SQ", "TWICE", "SIN", "COS", "EXP", "TANH", "ATAN")
)
MAX_LEVEL = 4
MAX_DEPTH = 100
Visit = tuple[str, int, str | None]  # listing, level, law


def require_closed(statement: Statement) -> None:
    """Raises Invalid for a name that is unknown, idle, circular or without a rate; Declined if too deep."""
    _require_consistent_tables(statement)
    walk = Reach(statement)
    for assumption in statement.given:
        for ref in assumption.of:
            walk.listing(ref[0], "i", 0, None)
    walk.listing(statement.claim.listing, "ij", 0, statement.claim.law)
    if statement.claim.kind == "theorem":
        walk.closed_loop(statement.claim.law)
    listings = {visit[0] for visit in walk.done}
    law_inputs = {(law, u) for law, table in statement.laws.items() for u in table}
    for what, all_of, used in (
        ("listing", set(statement.listings), listings),
        ("scalar", set(statement.scalars), walk.read),
        ("name", set(statement.names), walk.read),
        ("motion", set(statement.motion), walk.moved),
        ("law", set(statement.laws), walk.laws),
        ("input of a law", law_inputs, walk.replaced),
    ):
        idle = sorted(map(str, all_of - used))
        if idle:
            raise Invalid(f"the {what} {idle[0][:80]} is not used by the claim or an assumption")


def rates_exist_where_defined(statement: Statement, law: str | None) -> bool:
    """Does every rate that the field reads have a value exactly where its formula has one?

    Relies on: a rate of what is made of smooth operations and divisions exists where that is defined, and
    nowhere else. A rate of a root or of |.| may exist where the formula divides by zero.
    """
    reach = Reach(statement)
    for name, _ in statement.motion.values():
        reach.listing(name, "i", 0, law)
    rated = {name for name, level, _ in reach.done if level}
    return {step.op for name in rated for step in statement.listings[name].code} <= ENTIRE | {"DIV", "INV"}


def effective_law(own: str | None, outer: str | None) -> str | None:
    """The law under which a rate is taken inside another one: its own, or else the outer one.

    Two different laws are declined: the inputs that only the outer one gives would be ambiguous.
    """
    if own is not None and outer is not None and own != outer:
        raise Declined(f"a rate under the law {own[:60]!r} inside a rate under the law {outer[:60]!r}")
    return outer if own is None else own


class Reach:
    """What the evaluation of listings reads, directly and through names, motion and laws."""

    def __init__(self, statement: Statement) -> None:
        self.statement = statement
        self.done: set[Visit] = set()
        self.open: set[Visit] = set()
        self.read: set[str] = set()
        self.moved: set[str] = set()
        self.looped: set[str] = set()
        self.laws: set[str] = set()
        self.replaced: set[tuple[str, str]] = set()
        self.letters: dict[str, frozenset[str]] = {}

    def listing(self, name: str, letters: Collection[str], level: int, law: str | None) -> None:
        """Visit a listing whose names may mention the node letters given."""
        visit = (name, level, law)
        if name not in self.letters:
            self.letters[name] = self.statement.listings[name].letters
        if not self.letters[name] <= set(letters):
            raise Invalid(f"listing {name[:60]!r} mentions a node that is not bound where it is used")
        if visit in self.open:
            raise Invalid(f"listing {name[:60]!r} is defined through itself")
        if visit in self.done:
            return
        if level > MAX_LEVEL or len(self.open) >= MAX_DEPTH:
            limit = f"more than {MAX_LEVEL} rates or {MAX_DEPTH} names inside each other"
            raise Declined(f"listing {name[:60]!r}: {limit}")
        self.open.add(visit)
        for step in self.statement.listings[name].code:
            if step.op == "INPUT":
                self._input(split_name(step.name)[0], level, law)
        self.open.remove(visit)
        self.done.add(visit)

    def closed_loop(self, law: str | None) -> None:
        """Visit the motion under the law of everything that was read, and of what that reads."""
        if law is not None:
            self.laws.add(law)
        while True:
            new = [key for key in self.statement.motion if key in self.read and key not in self.looped]
            if not new:
                return
            for key in new:
                self.looped.add(key)
                self.moved.add(key)
                self.listing(self.statement.motion[key][0], "i", 0, law)

    def _input(self, key: str, level: int, law: str | None) -> None:
        self.read.add(key)
        letters = "i" if per_node(key) else ""
        if key in self.statement.names:
            self._meaning(self.statement.names[key], letters, level, law)
            return
        kind = self.statement.scalars.get(key)
        if kind is None:
            raise Invalid(f"the name {key} is not defined")
        given = law_of(self.statement, key, law)
        if kind == "input" and given is not None and law is not None:
            self.replaced.add((law, key))
            self.listing(given[0], letters, level, law)
        elif kind != "parameter" and level > 0:
            if key not in self.statement.motion:
                raise Invalid(
                    f"{key} has no rate: {'no law gives it' if kind == 'input' else 'it has no motion'}"
                )
            self.moved.add(key)
            for below in range(level):
                self.listing(self.statement.motion[key][0], letters, below, law)

    def _meaning(self, meaning: Meaning, letters: str, level: int, law: str | None) -> None:
        if meaning.kind == "constant":
            return
        if meaning.kind == "rate":
            level += 1
            if meaning.law is not None:
                self.laws.add(meaning.law)
            law = effective_law(meaning.law, law)
        self.listing(meaning.of[0], {"sum": "ij", "total": "i"}.get(meaning.kind, letters), level, law)


def law_of(statement: Statement, key: str, law: str | None) -> Ref | None:
    """What the law puts in the place of an input, if it does."""
    return None if law is None else statement.laws[law].get(key)


def _require_consistent_tables(statement: Statement) -> None:
    for key in statement.names:
        if key in statement.scalars:
            raise Invalid(f"{key} is both a scalar and a name")
    for key in statement.motion:
        if statement.scalars.get(key) not in ("state", "signal"):
            raise Invalid(f"{key} has a motion, but is not a state or a signal")
    for law, table in statement.laws.items():
        for key in table:
            if statement.scalars.get(key) != "input":
                raise Invalid(f"the law {law[:60]!r} gives {key}, which is not an input")
    if statement.claim.law is not None and statement.claim.law not in statement.laws:
        raise Invalid(f"the law {statement.claim.law[:60]!r} of the closed loop is not given")
    for name, meaning in statement.names.items():
        if meaning.law is not None and meaning.law not in statement.laws:
            raise Invalid(f"name {name}: the law {meaning.law[:60]!r} is not given")
    keys = (*statement.scalars, *statement.names)
    symbols = {at_node(key, "").split("[")[0].rstrip(".") for key in keys if per_node(key)}
    for key in keys:
        if not per_node(key) and key.split("[")[0].split(".")[0] in symbols:
            raise Invalid(f"{key}: its symbol belongs to every node, so it must be written with *")
