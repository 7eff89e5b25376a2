"""Sums over the neighbours and nodes of any graph, as symbols, and identities between them.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: in an undirected graph, the sum over nodes i of the sum over neighbours j of E(i, j) is the sum
over edges {i, j} of E(i, j) + E(j, i). So it vanishes for every graph if E(i, j) + E(j, i) = 0 for generic
distinct nodes; and a sum over the neighbours of i alone vanishes for every graph if E(i, j) = 0. A sum over
nodes of terms that vanish is zero. These conditions are sufficient; they are what is checked here. What is
given holds at every node.

A symbol S at level n is the nest of pairs of its generators S, S', S'', ... (as many primes as
derivatives). The derivative of a sum is the sum of the derivatives of its terms.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from symctrl.kernel.certificate import Declined, Invalid, at_node, split_name
from symctrl.kernel.closure import Reach
from symctrl.kernel.evaluation import Evaluation, Level, NoSums
from symctrl.kernel.field import Value
from symctrl.kernel.generators import Generator, read_by
from symctrl.kernel.polynomial import Number, Poly, monomial, powers, variables
from symctrl.kernel.replay import Replay

Made = tuple[str, int, str | None]  # the name in the tables, how often it is differentiated, under which law


class SymbolSums:
    """Every sum at node i, and every total, is a symbol. `made` says what each generator stands for."""

    def __init__(self) -> None:
        self.made: dict[str, Made] = {}

    def value(self, walk: Evaluation[Any], key: str, node: str, level: int, law: str | None) -> Level:
        if node not in ("", "i"):
            raise Invalid(f"{key} is read at node {node}: sums are over the neighbours of node i alone")

        def nest(level: int, primes: int) -> Level:
            if level > 0:
                return nest(level - 1, primes), nest(level - 1, primes + 1)
            name = at_node(key, node) + "'" * primes
            new = (key, primes, self._law_that_matters(walk, key, primes, law))
            if self.made.setdefault(name, new) != new:
                raise Declined(f"{name} is read under two laws")
            return walk.free(name)

        return nest(level, 0)

    def _law_that_matters(self, walk: Evaluation[Any], key: str, primes: int, law: str | None) -> str | None:
        """None where the terms and their derivatives do not read an input that the law gives."""
        reach = Reach(walk.statement)
        reach.listing(walk.statement.names[key].of[0], "ij", primes, law)
        return law if any(used == law for used, _ in reach.replaced) else None


class SumIdentity:
    """The zero test for values with sum symbols; without any, it is that of the field.

    Making it evaluates the terms of the totals, then of the sums at (i, j), then at (j, i), by generator.
    """

    def __init__(self, replay: Replay, sums: SymbolSums) -> None:
        self.replay = replay
        self.field = replay.field
        self.sums = sums
        self.total_symbols = self._symbols("total")
        self.totals = {k: self._term(k, {"i": "i"}) for k in sorted(self.total_symbols)}
        self.sum_symbols = self._symbols("sum")
        if self._symbols("total") != self.total_symbols:
            raise Declined("a total inside a total")
        symbols = self.total_symbols | self.sum_symbols
        read = set().union(*map(variables, self.field.factors), *map(self._read_by, replay.table))
        if symbols & read:
            raise Invalid("a sum occurs in a denominator or inside a root or another function")
        replay.walk.sums = NoSums()
        self.terms = {k: self._term(k, {"i": "i", "j": "j"}) for k in sorted(self.sum_symbols)}
        self.swapped = {k: self._term(k, {"i": "j", "j": "i"}) for k in sorted(self.sum_symbols)}

    def _symbols(self, kind: str) -> set[int]:
        names = self.replay.statement.names
        return {
            self.replay.free[name] for name, made in self.sums.made.items() if names[made[0]].kind == kind
        }

    def _term(self, symbol: int, binding: dict[str, str]) -> Value:
        """The term of the sum that a symbol stands for, under a binding."""
        key, primes, law = self.sums.made[self.replay.table[symbol].name]
        term: Level = self.replay.walk.output(self.replay.statement.names[key].of, binding, primes, law)
        for _ in range(primes):
            term = None if term is None else term[1]
        return {} if term is None else term

    def _read_by(self, g: Generator) -> set[int]:
        return read_by(g, self.field)

    def require_zero(self, value: Value, where: str) -> None:
        """Raises Invalid where the value is not shown to be zero for every graph."""
        numerator, _ = self.field.fraction(value)
        p = self.field.normal(numerator)
        if not variables(p) & (self.total_symbols | self.sum_symbols):
            if p and not self.field.is_zero(value):
                raise Invalid(f"{where}: the sides differ by {self.replay.signs.printer.poly(p)[:300]}")
        elif variables(p) & self.total_symbols:
            self._require_zero_at_node(self._without_totals(p, where), where, exchange=True)
        else:
            self._require_zero_at_node({(): p}, where, exchange=False)

    def _without_totals(self, p: Poly, where: str) -> Value:
        """The term at node i of a linear combination of totals whose coefficients belong to no node."""
        local = self._node_generators()
        result: Value = {}
        for m, c in p.items():
            symbols = [(k, e) for k, e in powers(m) if k in self.total_symbols]
            rest = [(k, e) for k, e in powers(m) if k not in self.total_symbols]
            if len(symbols) != 1 or symbols[0][1] != 1 or any(k in local for k, _ in rest):
                raise Invalid(f"{where}: not a linear combination of sums over all nodes")
            term = self.totals[symbols[0][0]]
            result = self.field.add(result, self.field.mul({(): {monomial(rest): c}}, term))
        return result

    def _node_generators(self) -> set[int]:
        """The generators that depend on a node."""
        found = set(self.sum_symbols)
        for k, g in enumerate(self.replay.table):
            if _letter(g) or self._read_by(g) & found:
                found.add(k)
        return found

    def _require_zero_at_node(self, value: Value, where: str, exchange: bool) -> None:
        numerator, key = self.field.fraction(value)
        linear: dict[int, Poly] = {}
        for m, c in self.field.normal(numerator).items():
            symbols = [(k, e) for k, e in powers(m) if k in self.sum_symbols]
            if sum(e for _, e in symbols) != 1:
                what = "a part without sums" if not symbols else "a product of sums"
                raise Invalid(f"{where}: {what} is left at a node")
            k = symbols[0][0]
            linear.setdefault(k, {})[m - monomial(symbols)] = c
        if not exchange:
            edge = self._combined(linear, self.terms)
        else:
            below = self.field.denominator(key)
            back = {k: self._swap(p) for k, p in linear.items()}
            edge = self.field.add(
                self.field.mul(self._combined(linear, self.terms), {(): self._swap(below)}),
                self.field.mul(self._combined(back, self.swapped), {(): below}),
            )
        if not self.field.is_zero(edge):
            raise Invalid(f"{where}: the terms of an edge do not cancel")

    def _combined(self, coefficients: dict[int, Poly], terms: dict[int, Value]) -> Value:
        result: Value = {}
        for k, p in coefficients.items():
            result = self.field.add(result, self.field.mul({(): p}, terms[k]))
        return result

    def _swap(self, p: Poly) -> Poly:
        """The polynomial with the nodes i and j exchanged."""
        result: Poly = {}
        for m, c in p.items():
            image: Poly = {0: c}
            for k, e in powers(m):
                image = self.field.ring.mul(image, {monomial([(self._swapped(k), e)]): 1})
            result = self.field.ring.add(result, image)
        return result

    def _swapped(self, k: int) -> int:
        g = self.replay.table[k]
        if g.kind == "free" and _letter(g):
            base = g.name.rstrip("'")
            name = at_node(split_name(base)[0], "j" if _letter(g) == "i" else "i") + g.name[len(base) :]
            if name not in self.replay.free:
                raise Invalid(
                    f"{name} is not in the table of generators, and {g.name} is needed at both nodes"
                )
            self.replay.use(self.replay.free[name])
            return self.replay.free[name]
        if not self._read_by(g) & self._node_generators():
            return k
        wanted = self._definition(g, self._swap, self._swapped)
        for other, candidate in enumerate(self.replay.table):
            if candidate.kind == g.kind and self._definition(candidate, lambda p: p, lambda n: n) == wanted:
                self.replay.use(other)
                return other
        raise Invalid(f"generator {k} has no counterpart with the nodes exchanged")

    def _definition(
        self, g: Generator, on_poly: Callable[[Poly], Poly], on_index: Callable[[int], int]
    ) -> Any:
        """What a definition says, factors written out, after renaming."""

        def plain(p: Poly) -> frozenset[tuple[int, Number]]:
            return frozenset(on_poly(p).items())

        args = [{(plain(self.field.denominator(key)), plain(p)) for key, p in arg.items()} for arg in g.args]
        number = on_index(g.number) if g.kind in ("sign", "sin") else g.number
        return g.kind, g.name, None if g.base is None else plain(g.base), args, number


def _letter(g: Generator) -> str:
    """The node letter of a free generator, "" for another one."""
    return split_name(g.name.rstrip("'"))[1] if g.kind == "free" else ""
