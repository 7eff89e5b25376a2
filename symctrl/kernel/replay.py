"""Exact evaluation of a statement over the generators and factors of a proof, each step by its hint.

Soundness-critical. Last reviewed 2026-11-24.

Relies on: a hint only proposes; each is checked by the rule of its operation (`functions`), an inverse by
comparing the inverted value. All factors are nonzero and all generators real, by what is given or by a
condition of the statement, and everything that the proof brings is used.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from symctrl.kernel import functions
from symctrl.kernel.certificate import (
    Condition,
    Declined,
    Invalid,
    Statement,
    fields,
    rational,
    split_name,
    typed,
)
from symctrl.kernel.chain import Domain
from symctrl.kernel.conditions import Signs
from symctrl.kernel.evaluation import Evaluation, Sums
from symctrl.kernel.field import Field, Value, read_poly, read_powers
from symctrl.kernel.generators import read_by, read_generators, relations_of
from symctrl.kernel.polynomial import Poly, relation, variables

MAX_FACTOR_POWER = 1000


class Replay(Domain[Value]):
    """The domain of Values, driven by the hints of a proof.

    `given` holds the values of each assumption at node i (a matrix column by column) after `assume_given`.
    """

    def __init__(self, statement: Statement, proof: dict[str, Any], sums: Sums) -> None:
        factors = typed(proof["factors"], list, "factors")
        generators = typed(proof["generators"], list, "generators")
        count = len(generators)
        self.field = Field(count, [read_poly(f, count, f"factor {k}") for k, f in enumerate(factors)])
        self.table = read_generators(generators, self.field)
        self.free = {g.name: k for k, g in enumerate(self.table) if g.kind == "free"}
        self.signs = Signs(self.field, self.table)
        self.statement = statement
        self.walk = Evaluation(statement, self, self._free, sums)
        self.given: list[list[Value]] = []
        self._hints = typed(proof["hints"], list, "hints")
        self._next = 0
        self._used: set[int] = set()
        self._used_factors: set[int] = set()
        self._add_relations()

    def _add_relations(self) -> None:
        self.field.relations = [r for r in self.field.relations if r not in self._of_generators()]
        self.field.relations += self._of_generators()

    def _of_generators(self) -> list[tuple[int, Poly]]:
        top = range(len(self.table) - 1, -1, -1)
        return [r for k in top for r in relations_of(k, self.table[k], self.field, self._nonzero)]

    def _nonzero(self, p: Poly) -> bool:
        return p in self.field.factors or 0 not in self.signs.of(p)

    def assume_given(self) -> None:
        """Evaluate what is given at node i, and at node j where the table has names of j; learn from it."""
        for node in "ij":
            if node == "i" or any(split_name(name.rstrip("'"))[1] == "j" for name in self.free):
                self.assume(node)

    def assume(self, node: str) -> None:
        """Evaluate what is given at a node, and learn from it."""
        values: list[list[Value]] = []
        for assumption in self.statement.given:
            entries = [self.walk.output(ref, {"i": node}) for ref in assumption.of]
            values.append(entries)
            if assumption.kind == "zero":
                numerator = self.field.normal(self.field.fraction(entries[0])[0])
                if numerator.keys() == {0}:
                    raise Invalid("an assumption can never be met: a number that is not zero is zero")
                if numerator:
                    self.field.relations.append(relation(numerator))
            elif len(entries) == 1:
                kind = {"positive_definite": "positive", "positive_semidefinite": "nonnegative"}
                self.signs.learn(kind.get(assumption.kind, assumption.kind), entries[0])
            else:
                rows = [entries[r :: assumption.size] for r in range(assumption.size)]
                self.signs.learn_matrix(rows, assumption.kind == "positive_definite")
        self.given = self.given or values
        self._add_relations()

    def claim(self) -> list[Value]:
        """The outputs of the claim's listing at node i."""
        return self.walk.outputs(self.statement.claim.listing, {"i": "i"})

    def use(self, k: int) -> None:
        """Generator k counts as used."""
        self._used.add(k)

    def poly(self, value: Any, where: str) -> Poly:
        """A POLY that another part of the proof brings; its generators count as used."""
        p = read_poly(value, self.field.variables, where)
        self._used |= variables(p)
        return p

    def close(self) -> set[Condition]:
        """The conditions that the proof needs. Raises Invalid for what is unused, or undefined everywhere."""
        if self._next != len(self._hints):
            raise Invalid(f"hint {self._next} of {len(self._hints)} is not used")
        for k, g in enumerate(self.table):
            functions.require_defined(self.signs, g, f"generator {k}")
        for k, p in enumerate(self.field.factors):
            self.signs.require("nonzero", p, f"factor {k}")
        self._require_all_used()
        return self.signs.needed

    def _require_all_used(self) -> None:
        used = set(self._used)
        for k in range(len(self.table) - 1, -1, -1):
            g = self.table[k]
            if g.kind == "sin" and g.number in used:
                used.add(k)  # sine and cosine come as a pair
            if k in used:
                used |= read_by(g, self.field)
                self._used_factors |= {f for value in g.args for key in value for f, _ in key}
        for f in self._used_factors:
            used |= variables(self.field.factors[f])
        for what, count, seen in (
            ("generator", len(self.table), used),
            ("factor", len(self.field.factors), self._used_factors),
        ):
            idle = sorted(set(range(count)) - seen)
            if idle:
                raise Invalid(f"{what} {idle[0]} is not used")

    # The basic operations.

    def constant(self, value: Fraction) -> Value:
        return self.field.constant(value.numerator if value.denominator == 1 else value)

    def _free(self, name: str) -> Value:
        if name not in self.free:
            raise Invalid(f"{name} is not in the table of generators")
        self._used.add(self.free[name])
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
        self.signs.require_value("nonzero", a, "the argument of |.| in a rate")

    def inv(self, a: Value) -> Value:
        number = self.field.rational(a)
        if number is not None:
            if number == 0:
                raise Invalid("a division by zero")
            return self.constant(1 / number)
        where = f"hint {self._next}"
        hint = typed(self._hint(("inverse",))["inverse"], list, where)
        if len(hint) != 2:
            raise Invalid(f"{where}: an inverse is [number, powers of factors]")
        scale = rational(hint[0], where)
        factors = read_powers(typed(hint[1], list, where), len(self.field.factors), where, signed=True)
        if scale == 0 or any(abs(e) > MAX_FACTOR_POWER for _, e in factors):
            raise Invalid(f"{where}: the scale is zero or an exponent too large")
        self._used_factors |= {f for f, _ in factors}
        up = tuple((f, e) for f, e in factors if e > 0)
        down = tuple((f, -e) for f, e in factors if e < 0)
        ring = self.field.ring
        stated = {down: ring.scale(self.field.denominator(up), scale)}
        if not self.field.is_zero(self.field.sub(a, stated)):
            raise Invalid(f"{where}: the inverted value is not what the hint says")
        return {up: ring.scale(self.field.denominator(down), 1 / scale)}

    def function(self, op: str, args: Sequence[Value]) -> Value:
        rule = functions.RULES.get(op)
        if rule is None:
            raise Declined(f"{op.lower()} has no rule")
        where = f"hint {self._next} ({op.lower()})"
        value = self.field.read(self._hint(("is",))["is"], where)
        for key, p in value.items():
            self._used |= variables(p)
            self._used_factors |= {f for f, _ in key}
        rule(functions.Step(self.field, self.table, self.signs, op, where), list(args), value)
        return value

    def _hint(self, names: tuple[str]) -> dict[str, Any]:
        if self._next >= len(self._hints):
            raise Invalid(f"there are only {len(self._hints)} hints, and a {names[0]!r} is needed next")
        hint = fields(self._hints[self._next], names, f"hint {self._next}")
        self._next += 1
        return hint


def require_conditions(statement: Statement, needed: set[Condition]) -> None:
    """The statement must list exactly the conditions that its proof needs. Raises Invalid otherwise."""
    listed = set(statement.conditions)
    for missing in sorted(needed - listed, key=str):
        raise Invalid(f"the condition that {missing.of[:200]} is {missing.kind} is needed and not stated")
    for idle in sorted(listed - needed, key=str):
        raise Invalid(f"the condition that {idle.of[:200]} is {idle.kind} is stated and not needed")
