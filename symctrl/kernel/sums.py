"""Sums over the neighbours and nodes of any graph, and identities between them.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: a sum over the neighbours of a node of c u, where c belongs to the node and u to the neighbour, is
c times the sum of u. So every such sum is a polynomial in generators T = sum of a monomial of the
neighbour, and what vanishes as a polynomial in these vanishes for every graph. In an undirected graph, the
sum over nodes i of c(i) T(i), with T the sum of u over the neighbours, is the sum over edges {i, j} of c(i)
u(j) + c(j) u(i): if that is zero for generic neighbours, the sum over nodes is zero for every graph. What
is given holds at every node.

A total, the sum over all nodes, is a generator for each derivative: T, T', T'', ... The derivative of a sum
is the sum of the derivatives of its terms.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

from symctrl.kernel.certificate import Declined, Invalid, fields, typed
from symctrl.kernel.closure import Reach
from symctrl.kernel.evaluation import Evaluation, Level
from symctrl.kernel.field import Value
from symctrl.kernel.generators import letters
from symctrl.kernel.polynomial import Poly, monomial, powers, variables
from symctrl.kernel.replay import Replay
from symctrl.kernel.values import Statement

OTHER = {"i": "j", "j": "i"}
Made = tuple[str, int, str | None]  # the name of a total, how often it is differentiated, under which law


def opened(
    statement: Statement, proof: dict[str, Any], claims: Collection[str], *own: str
) -> tuple[SumIdentity, list[Value]]:
    """The zero test over the statement as a proof of the given claims evaluates it, and the claim's outputs.

    own: the fields of the proof beside those that every proof has. Raises Invalid, Declined.
    """
    if statement.claim.kind not in claims:
        raise Invalid(f"a proof of the kind {proof['kind']} does not prove the claim {statement.claim.kind}")
    fields(proof, ("kind", "generators", "factors", "hints", *own), "proof", ("relations",))
    sums = SymbolSums()
    replay = Replay(statement, proof, sums)
    sums.replay = replay
    replay.assume_given()
    replay.derive(typed(proof.get("relations", []), list, "relations"))
    outputs = replay.claim()
    return SumIdentity(replay, sums), outputs


class SymbolSums:
    """Sums as polynomials in generators. `totals` says what each total's generator stands for."""

    def __init__(self) -> None:
        self.replay: Replay | None = None
        self.totals: dict[int, Made] = {}

    def value(self, walk: Evaluation[Any], key: str, node: str, level: int, law: str | None) -> Level:
        meaning = walk.statement.names[key]
        if meaning.kind == "total":
            return self._nest(walk, key, level, 0, law)
        if node not in OTHER:
            raise Invalid(f"{key} is a sum over the neighbours of no node")
        terms = walk.output(meaning.of, {"i": node, "j": OTHER[node]}, level, law)
        return _mapped(terms, level, lambda value: self._summed(value, node))

    def _nest(self, walk: Evaluation[Any], key: str, level: int, primes: int, law: str | None) -> Level:
        if level > 0:
            return tuple(self._nest(walk, key, level - 1, primes + more, law) for more in (0, 1))
        name = key + "'" * primes
        value = walk.free(name)
        assert self.replay is not None
        k = self.replay.free[name]
        made = (key, primes, law if primes or self._depends_on_law(walk.statement, key, law) else None)
        if self.totals.setdefault(k, made) != made:
            raise Declined(f"{name} is read under two laws")
        return value

    def _depends_on_law(self, statement: Statement, key: str, law: str | None) -> bool:
        """Does the term of the total read an input, or a rate?"""
        reach = Reach(statement)
        reach.listing(statement.names[key].of[0], "ij", 0, law)
        return any(
            statement.scalars.get(name) == "input"
            or (name in statement.names and statement.names[name].kind == "rate")
            for name in reach.read
        )

    def _summed(self, value: Value, node: str) -> Value:
        """The sum over the neighbours of a node of a value that belongs to the node and its neighbour."""
        assert self.replay is not None
        table, field, other = self.replay.table, self.replay.field, OTHER[node]
        of = [letters(table, k, field) for k in range(len(table))]
        result: Value = {}
        for key, numerator in value.items():
            p = field.normal(numerator)
            if any(other in of[k] for f, _ in key for k in variables(field.factors[f])):
                raise Declined("a sum over neighbours that divides by what belongs to the neighbour")
            summed: Poly = {}
            for m, c in p.items():
                if any(of[k] == {"i", "j"} for k, _ in powers(m)):
                    raise Declined("a sum over neighbours of a function of both nodes")
                inside = tuple((k, e) for k, e in powers(m) if other in of[k])
                t = self.replay.sum_generator(inside, node)
                moved = m - monomial(list(inside)) + monomial([(t, 1)])
                summed = field.ring.add(summed, {moved: c})
            result = field.add(result, {key: summed})
        return result


def _mapped(level_value: Level, level: int, change: Callable[[Value], Value]) -> Level:
    if level_value is None:
        return None
    if level == 0:
        return change(level_value)
    return tuple(_mapped(part, level - 1, change) for part in level_value)


class SumIdentity:
    """The zero test for values with sums; without totals, it is that of the field."""

    def __init__(self, replay: Replay, sums: SymbolSums) -> None:
        self.replay = replay
        self.field = replay.field
        self.sums = sums

    def require_zero(self, value: Value, where: str) -> None:
        """Raises Invalid where the value is not shown to be zero for every graph."""
        if self.field.is_zero(value):
            return
        numerator, _ = self.field.fraction(value)
        p = self.field.normal(numerator)
        if not variables(p) & self.sums.totals.keys():
            raise Invalid(f"{where}: the sides differ by {self.replay.signs.printer.poly(p)[:300]}")
        coefficients = self._coefficients(p, where)
        ends = [self._at_node(coefficients, node) for node in ("i", "j")]
        edge: Value = {}
        if not self.field.is_zero(ends[0]):
            for end, node in zip(ends, ("i", "j"), strict=True):
                edge = self.field.add(edge, self._along_edge(end, node, where))
        if not self.field.is_zero(edge):
            raise Invalid(f"{where}: the terms of an edge do not cancel")

    def _coefficients(self, p: Poly, where: str) -> dict[int, Poly]:
        """A linear combination of totals, whose coefficients belong to no node."""
        found: dict[int, Poly] = {}
        for m, c in p.items():
            totals = [(k, e) for k, e in powers(m) if k in self.sums.totals]
            rest = [(k, e) for k, e in powers(m) if k not in self.sums.totals]
            local = any(letters(self.replay.table, k, self.field) for k, _ in rest)
            if len(totals) != 1 or totals[0][1] != 1 or local:
                raise Invalid(f"{where}: not a linear combination of sums over all nodes")
            found.setdefault(totals[0][0], {})[monomial(rest)] = c
        return found

    def _at_node(self, coefficients: dict[int, Poly], node: str) -> Value:
        """The combination of the terms of the totals at one node."""
        total: Value = {}
        for k, p in coefficients.items():
            key, primes, law = self.sums.totals[k]
            term: Level = self.replay.walk.output(
                self.replay.statement.names[key].of, {"i": node}, primes, law
            )
            for _ in range(primes):
                term = None if term is None else term[1]
            total = self.field.add(total, self.field.mul({(): p}, term or {}))
        return total

    def _along_edge(self, value: Value, node: str, where: str) -> Value:
        """A value at a node, linear in the sums over its neighbours, with each replaced by its term."""
        numerator, key = self.field.fraction(value)
        table = self.replay.table
        sums = {k for k, g in enumerate(table) if g.kind == "sum" and g.name == node}
        hidden = {k for f, _ in key for k in variables(self.field.factors[f])}
        edge: Poly = {}
        for m, c in self.field.normal(numerator).items():
            inside = [(k, e) for k, e in powers(m) if k in sums]
            rest = [k for k, _ in powers(m) if k not in sums] + list(hidden)
            if len(inside) != 1 or inside[0][1] != 1:
                raise Invalid(f"{where}: at a node there is a part without sums, or a product of sums")
            if any(self.replay.reaches(k, sums) for k in rest):
                raise Invalid(f"{where}: a sum occurs in a denominator or inside a root or another function")
            k = inside[0][0]
            edge = self.field.ring.add(edge, {m - monomial(inside) + monomial(list(table[k].powers)): c})
        return {key: edge} if edge else {}
