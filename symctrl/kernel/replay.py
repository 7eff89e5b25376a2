"""Exact evaluation of a statement over the generators and factors of a proof, each step by its hint.

Soundness-critical. Last reviewed 2026-11-24.

Relies on: a hint only proposes, and any hint may serve; each is checked by the rule of its operation
(`functions`), an inverse by comparing the inverted value. What a value uses is established where it is
first used: a factor is nonzero and a generator real by what is known until then, or by a condition. So
nothing that is learned from a value ever justifies that this value exists. Plain polynomials, which always
exist, are learned first. An assumption is met only where it is defined: what it divides by is not zero
there. Everything that the proof brings must be used.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from typing import Any

from symctrl.kernel import functions
from symctrl.kernel.certificate import (
    Declined,
    Invalid,
    fields,
    natural,
    rational,
    several,
    split_name,
    typed,
)
from symctrl.kernel.chain import Domain
from symctrl.kernel.closure import Reach
from symctrl.kernel.conditions import SIGNS, Signs
from symctrl.kernel.evaluation import Evaluation, Sums
from symctrl.kernel.field import Field, Value, read_poly, read_powers
from symctrl.kernel.generators import read_by, read_generators, relations_of, relations_of_switches
from symctrl.kernel.polynomial import Poly, Relation, monomial, relation, variables
from symctrl.kernel.values import Assumption, Condition, Statement

MAX_FACTOR_POWER = 1000
MAX_CASES = 6  # inside each other
_PLAIN = frozenset(("INPUT", "CONST", "ADD", "SUB", "MUL", "NEG", "SQ", "TWICE"))


class Replay(Domain[Value]):
    """The domain of Values, driven by the hints of a proof.

    `given` holds the values of each assumption at node i (a matrix column by column) after `assume_given`.
    """

    def __init__(self, statement: Statement, proof: dict[str, Any], sums: Sums) -> None:
        factors = typed(proof["factors"], list, "factors")
        generators = typed(proof["generators"], list, "generators")
        count = len(generators)
        self.field = Field(count, [read_poly(f, count, f"factor {k}") for k, f in enumerate(factors)])
        if any(p.keys() <= {0} for p in self.field.factors):
            raise Invalid("a factor is a number")
        self.table = read_generators(generators, self.field)
        self.free = {g.name: k for k, g in enumerate(self.table) if g.kind == "free"}
        self.signs = Signs(self.field, self.table, statement.along)
        self.statement = statement
        self.walk = Evaluation(statement, self, self._free, sums)
        self.given: list[list[Value]] = [[]] * len(statement.given)
        self._hints = [typed(hint, dict, "a hint") for hint in typed(proof["hints"], list, "hints")]
        self._used_hints: set[int] = set()
        self._results: dict[Any, Value] = {}
        self._used: set[int] = set()
        self._used_factors: set[int] = set()
        self._read: set[int] = set()
        self._learned: list[Relation] = []
        self._assuming = False
        self._cases = 0
        self._add_relations()

    def _add_relations(self) -> None:
        """Those that were learned, and those of the generators by what is known now."""
        top = range(len(self.table) - 1, -1, -1)
        own = [r for k in top for r in relations_of(k, self.table[k], self.field, self._nonzero)]
        switches = relations_of_switches(self.table, lambda e: self.signs.of_value(e) == SIGNS["positive"])
        self.field.relations = self._learned + switches + own

    def _nonzero(self, p: Poly) -> bool:
        return self.is_factor(p) or 0 not in self.signs.of(p)

    def is_factor(self, p: Poly) -> bool:
        """Is the polynomial a factor that has been established?"""
        return any(self.field.factors[f] == p for f in self._used_factors)

    def assume_given(self) -> None:
        """Evaluate what is given at node i, and at node j where the table has names of j; learn from it.

        What is given of the graph is left to the proofs mode by mode.
        """
        nodes = "ij" if any(split_name(name.rstrip("'"))[1] == "j" for name in self.free) else "i"
        about_values = [pair for pair in enumerate(self.statement.given) if pair[1].kind != "laplacian_bound"]
        order = sorted(about_values, key=lambda pair: not self._is_plain(pair[1]))
        self._assuming = True
        for node in nodes:
            for k, assumption in order:
                entries = [self.walk.output(ref, {"i": node}) for ref in assumption.of]
                if node == "i":
                    self.given[k] = entries
                self._learn(assumption, entries)
        self._assuming = False

    def derive(self, entries: list[Any]) -> None:
        """Take equations that follow: `poly` = sum over `of` of POLY times the numerator of assumption k."""
        ring = self.field.ring
        for n, entry in enumerate(entries):
            where = f"relation {n}"
            table = fields(entry, ("poly", "of"), where)
            p = self.poly(table["poly"], where)
            left = p
            for pair in typed(table["of"], list, where):
                at, cofactor = several(pair, 2, f"{where}, [assumption, POLY]")
                k = natural(at, len(self.given), where)
                if self.statement.given[k].kind != "zero":
                    raise Invalid(f"{where}: assumption {k} is no equation")
                numerator, _ = self.field.fraction(self.given[k][0])
                left = ring.add(left, ring.scale(ring.mul(self.poly(cofactor, where), numerator), -1))
            if left or p.keys() <= {0}:
                raise Invalid(f"{where} does not follow from the assumptions as it says")
            self._learned.append(relation(p))
        self._add_relations()

    @contextmanager
    def supposing(self, k: int, side: int, where: str) -> Iterator[bool]:
        """What is shown inside is shown where the argument b of generator k = |b| has this sign or is zero.

        False where that never is. Nothing is evaluated or used for the first time inside, and what is learned
        is forgotten.
        """
        g = self.table[k]
        if g.kind != "abs" or not g.base or k not in self._used or self._cases >= MAX_CASES:
            raise Invalid(f"{where}: generator {k} is no absolute value by which cases are told apart")
        self.signs.learn_minors()
        kept = self._learned, self.signs.known, self.field.relations
        size: Poly = {monomial([(k, 1)]): 1}
        b = self.field.ring.scale(g.base, side)
        self._learned = [*kept[0], relation(self.field.ring.add(size, self.field.ring.scale(b, -1)))]
        self._add_relations()
        self._cases += 1
        try:
            yield self.signs.suppose("nonnegative", b)
        finally:
            self._cases -= 1
            # not found anew, which would be under the relations of the case
            self._learned, self.signs.known, self.field.relations = kept

    def _is_plain(self, assumption: Assumption) -> bool:
        """Is it about polynomials, which are defined everywhere?"""
        reach = Reach(self.statement)
        for listing, _ in assumption.of:
            reach.listing(listing, "i", 0, None)
        steps = (step for visit in reach.done for step in self.statement.listings[visit[0]].code)
        return all(step.op in _PLAIN for step in steps)

    def _learn(self, assumption: Assumption, entries: list[Value]) -> None:
        if assumption.kind == "zero":
            numerator = self.field.normal(self.field.fraction(entries[0])[0])
            if 0 not in self.signs.of(numerator):
                raise Invalid("an assumption can never be met: what is never zero is zero")
            if numerator:
                self._learned.append(relation(numerator))
        elif len(entries) == 1:
            kind = {"positive_definite": "positive", "positive_semidefinite": "nonnegative"}
            self.signs.learn(kind.get(assumption.kind, assumption.kind), entries[0])
        else:
            rows = [entries[r :: assumption.size] for r in range(assumption.size)]
            self.signs.learn_matrix(rows, assumption.kind == "positive_definite")
        self._add_relations()

    def learn_sign(self, kind: str, p: Poly) -> None:
        """A polynomial has been shown to have this kind of sign."""
        self.signs.learn(kind, {(): p} if p else {})
        self._add_relations()

    def claim(self) -> list[Value]:
        """The outputs of the claim's listing at node i, and its neighbour j where it speaks of one."""
        return self.walk.outputs(self.statement.claim.listing, {"i": "i", "j": "j"})

    def poly(self, value: Any, where: str) -> Poly:
        """A POLY that another part of the proof brings; its generators count as used."""
        p = read_poly(value, self.field.variables, where)
        self._establish(variables(p))
        return p

    def close(self) -> set[Condition]:
        """The conditions that the proof needs. Raises Invalid for what is unused, or undefined everywhere."""
        idle = set(range(len(self._hints))) - self._used_hints
        if idle:
            raise Invalid(f"hint {min(idle)} of {len(self._hints)} is not used")
        pairs = {k for k, g in enumerate(self.table) if g.kind == "sin" and g.number in self._used}
        for what, count, used in (
            ("generator", len(self.table), self._used | pairs),  # sine and cosine come as a pair
            ("factor", len(self.field.factors), self._used_factors),
        ):
            idle = set(range(count)) - used
            if idle:
                raise Invalid(f"{what} {min(idle)} is not used")
        foreign = {k for k, g in enumerate(self.table) if g.kind == "free"} - self._read
        if foreign:
            raise Invalid(f"{self.table[min(foreign)].name[:60]} is no symbol that the statement reads")
        return set(self.signs.needed)

    def _establish(self, generators: Iterable[int], factors: Iterable[int] = ()) -> None:
        """These are used from now on: real, and not zero, by what is known or by a condition."""
        new, below = set(generators) - self._used, set(factors) - self._used_factors
        if self._cases and (new or below):
            raise Invalid("a generator or factor is used for the first time in a case")
        for k in sorted(new):
            g = self.table[k]
            self._used.add(k)
            self._establish(read_by(g, self.field), {f for value in g.args for key in value for f, _ in key})
            functions.require_defined(self.signs, g, f"generator {k}")
        for f in sorted(below - self._used_factors):
            p = self.field.factors[f]
            self._establish(variables(p))
            self.signs.require("nonzero", p, f"factor {f}")
            self._used_factors.add(f)
            if any(g.kind == "sign" and g.base == p for g in self.table):
                self._add_relations()

    # The basic operations.

    def constant(self, value: Fraction) -> Value:
        return self.field.constant(value.numerator if value.denominator == 1 else value)

    def _free(self, name: str) -> Value:
        if name not in self.free:
            raise Invalid(f"{name} is not in the table of generators")
        self._used.add(self.free[name])
        self._read.add(self.free[name])
        return self.field.generator(self.free[name])

    def add(self, a: Value, b: Value) -> Value:
        return self.field.add(a, b)

    def neg(self, a: Value) -> Value:
        return self.field.neg(a)

    def mul(self, a: Value, b: Value) -> Value:
        return self.field.mul(a, b)

    def rational(self, a: Value) -> Fraction | None:
        return self.field.rational(a)

    def nonzero(self, a: Value) -> None:
        if not self.statement.along:
            self.signs.require_value("nonzero", a, "the argument of |.| in a rate")

    def inv(self, a: Value) -> Value:
        number = self.field.rational(a)
        if number is not None:
            if number == 0:
                raise Invalid("a division by zero")
            return self.constant(1 / number)
        return self._found("INV", [a])

    def function(self, op: str, args: Sequence[Value]) -> Value:
        if op == "SIGN" and self.statement.along and self.field.is_zero(args[0]):
            # at a jump the field has every value of the switch, not only that of sign(0)
            raise Declined("a switch whose argument is zero by what is assumed")
        if op not in functions.RULES:
            raise Declined(f"{op.lower()} has no rule in the kernel")
        return self._found(op, list(args))

    def _found(self, op: str, args: list[Value]) -> Value:
        """The value that the first hint gives that the rule of the operation confirms."""
        memo = op, tuple(frozenset((key, frozenset(p.items())) for key, p in a.items()) for a in args)
        if memo not in self._results:
            if self._cases:
                raise Invalid("an operation is evaluated in a case")
            self._results[memo] = self._search(op, args)
        return self._results[memo]

    def _search(self, op: str, args: list[Value]) -> Value:
        reason = ""
        for k, hint in enumerate(self._hints):
            if ("inverse" in hint) != (op == "INV"):
                continue
            needed = dict(self.signs.needed)
            try:
                value, below = self._by_hint(k, op, args)
            except Invalid as refused:  # a hint that is refused leaves no condition
                self.signs.needed = needed
                reason = f": {refused}"
                continue
            self._used_hints.add(k)
            self._establish((), below)
            if op == "INV" and self._assuming:
                for f in (f for key in value for f, _ in key):
                    self._establish(variables(self.field.factors[f]))
                    self.signs.learn("nonzero", {(): self.field.factors[f]})
            for key, p in value.items():
                self._establish(variables(p), [f for f, _ in key])
            return value
        of = ", ".join(self.signs.printer.value(a)[:120] for a in args)
        raise Invalid(f"no hint gives {op.lower()} of {of}{reason}")

    def _by_hint(self, k: int, op: str, args: list[Value]) -> tuple[Value, set[int]]:
        """The value by hint k, and the factors that its check divides by. Raises Invalid if it is another."""
        where = f"hint {k} ({op.lower()})"
        if op == "INV":
            return self._inverse(where, self._hints[k], args[0])
        value = self.field.read(fields(self._hints[k], ("is",), where)["is"], where)
        functions.RULES[op](functions.Step(self.field, self.table, self.signs, op, where), args, value)
        return value, set()

    def _inverse(self, where: str, hint: dict[str, Any], a: Value) -> tuple[Value, set[int]]:
        number, above = several(fields(hint, ("inverse",), where)["inverse"], 2, f"{where}, [number, powers]")
        scale = rational(number, where)
        factors = read_powers(typed(above, list, where), len(self.field.factors), where, signed=True)
        if scale == 0 or any(abs(e) > MAX_FACTOR_POWER for _, e in factors):
            raise Invalid(f"{where}: the scale is zero or an exponent too large")
        up = tuple((f, e) for f, e in factors if e > 0)
        down = tuple((f, -e) for f, e in factors if e < 0)
        ring = self.field.ring
        stated = {down: ring.scale(self.field.denominator(up), scale)}
        if not self.field.is_zero(self.field.sub(a, stated)):
            raise Invalid(f"{where} is about another value")
        return {up: ring.scale(self.field.denominator(down), 1 / scale)}, {f for f, _ in down}

    def sum_generator(self, inside: tuple[tuple[int, int], ...], node: str) -> int:
        """The generator of the sum of a monomial over the neighbours of a node; Invalid without one."""
        for k, g in enumerate(self.table):
            if g.kind == "sum" and g.name == node and g.powers == inside:
                self._establish([k])
                return k
        of = self.signs.printer.poly({monomial(inside): 1})
        raise Invalid(f"the table has no sum of {of[:120]} over the neighbours of {node}")

    def reaches(self, k: int, wanted: set[int]) -> bool:
        """Is generator k one of those wanted, or defined over one?"""
        return not wanted.isdisjoint(self.behind({k}))

    def behind(self, generators: set[int]) -> set[int]:
        """These generators and all that they are defined over."""
        found = set(generators)
        todo = list(found)
        while todo:
            new = read_by(self.table[todo.pop()], self.field) - found
            found |= new
            todo += new
        return found
