"""Exact evaluation of a statement over the generators and factors of a proof, each step by its hint.

Soundness-critical. Last reviewed 2026-11-24.

Relies on: a hint only proposes, and any hint may serve; each is checked by the rule of its operation (`functions`), an inverse by
comparing the inverted value. All factors are nonzero and all generators real, by what is given or by a
condition of the statement, and everything that the proof brings is used.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
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
from symctrl.kernel.polynomial import Poly, monomial, relation, variables

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
        self._hints = [typed(hint, dict, "a hint") for hint in typed(proof["hints"], list, "hints")]
        self._used_hints: set[int] = set()
        self._results: dict[Any, Value] = {}
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
        return self.walk.outputs(self.statement.claim.listing, {"i": "i", "j": "j"})

    def poly(self, value: Any, where: str) -> Poly:
        """A POLY that another part of the proof brings; its generators count as used."""
        p = read_poly(value, self.field.variables, where)
        self._used |= variables(p)
        return p

    def close(self) -> set[Condition]:
        """The conditions that the proof needs. Raises Invalid for what is unused, or undefined everywhere."""
        idle = set(range(len(self._hints))) - self._used_hints
        if idle:
            raise Invalid(f"hint {min(idle)} of {len(self._hints)} is not used")
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
        return self._found("INV", [a], lambda k: self._inverse(k, a))

    def function(self, op: str, args: Sequence[Value]) -> Value:
        if op not in functions.RULES:
            raise Declined(f"{op.lower()} has no rule")
        return self._found(op, list(args), lambda k: self._result(k, op, list(args)))

    def _found(self, op: str, args: list[Value], attempt: Callable[[int], Value | None]) -> Value:
        """The value that the first hint gives that the rule of the operation confirms."""
        memo = op, tuple(frozenset((key, frozenset(p.items())) for key, p in a.items()) for a in args)
        reason = ""
        for k in range(len(self._hints)) if memo not in self._results else ():
            try:
                value = attempt(k)
            except Invalid as refused:
                reason = f": {refused}"
                continue
            if value is not None:
                self._used_hints.add(k)
                self._results[memo] = value
                break
        if memo not in self._results:
            of = ", ".join(self.signs.printer.value(a)[:120] for a in args)
            raise Invalid(f"no hint gives {op.lower()} of {of}{reason}")
        return self._results[memo]

    def _inverse(self, k: int, a: Value) -> Value | None:
        """The inverse by hint k, if that is one."""
        where, hint = f"hint {k}", self._hints[k]
        if "inverse" not in hint:
            return None
        pair = typed(fields(hint, ("inverse",), where)["inverse"], list, where)
        if len(pair) != 2:
            raise Invalid(f"{where}: an inverse is [number, powers of factors]")
        scale = rational(pair[0], where)
        factors = read_powers(typed(pair[1], list, where), len(self.field.factors), where, signed=True)
        if scale == 0 or any(abs(e) > MAX_FACTOR_POWER for _, e in factors):
            raise Invalid(f"{where}: the scale is zero or an exponent too large")
        up = tuple((f, e) for f, e in factors if e > 0)
        down = tuple((f, -e) for f, e in factors if e < 0)
        ring = self.field.ring
        stated = {down: ring.scale(self.field.denominator(up), scale)}
        if not self.field.is_zero(self.field.sub(a, stated)):
            raise Invalid(f"{where} is about another value")
        self._used_factors |= {f for f, _ in factors}
        return {up: ring.scale(self.field.denominator(down), 1 / scale)}

    def _result(self, k: int, op: str, args: list[Value]) -> Value | None:
        """The value of a function by hint k, if that is one."""
        where, hint = f"hint {k} ({op.lower()})", self._hints[k]
        if "is" not in hint:
            return None
        value = self.field.read(fields(hint, ("is",), where)["is"], where)
        functions.RULES[op](functions.Step(self.field, self.table, self.signs, op, where), args, value)
        for key, p in value.items():
            self._used |= variables(p)
            self._used_factors |= {f for f, _ in key}
        return value

    def sum_generator(self, inside: tuple[tuple[int, int], ...], node: str) -> int:
        """The generator of the sum of a monomial over the neighbours of a node. Raises Invalid where there is none."""
        for k, g in enumerate(self.table):
            if g.kind == "sum" and g.name == node and g.powers == inside:
                self._used.add(k)
                return k
        of = self.signs.printer.poly({monomial(inside): 1})
        raise Invalid(f"the table has no sum of {of[:120]} over the neighbours of {node}")

    def reaches(self, k: int, wanted: set[int]) -> bool:
        """Is generator k one of those wanted, or defined over one?"""
        return k in wanted or any(self.reaches(v, wanted) for v in read_by(self.table[k], self.field))


def require_conditions(statement: Statement, needed: set[Condition]) -> None:
    """The statement must list exactly the conditions that its proof needs. Raises Invalid otherwise."""
    listed = set(statement.conditions)
    for missing in sorted(needed - listed, key=str):
        raise Invalid(f"the condition that {missing.of[:200]} is {missing.kind} is needed and not stated")
    for idle in sorted(listed - needed, key=str):
        raise Invalid(f"the condition that {idle.of[:200]} is {idle.kind} is stated and not needed")
