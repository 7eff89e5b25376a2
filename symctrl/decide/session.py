"""One exact evaluation of a problem: its assumptions as relations and known signs, its claim as exact values.

The evaluation starts again, knowing more, when it needs more generators or finer ones.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any, TypeVar

from symctrl.decide.ideal import Derived, completed
from symctrl.domains.algebra_latex import value_latex
from symctrl.domains.domain import Unsupported
from symctrl.domains.exact import ExactDomain
from symctrl.domains.field import Exact, Field, Generator, OutOfGenerators, Poly
from symctrl.domains.matrices import determinant_of
from symctrl.domains.opaque import Knowledge, Refine
from symctrl.domains.tangent import Pair
from symctrl.evaluate import Environment
from symctrl.problem import Assumption, Output, Problem, split, star

MAX_RESTARTS = 40
MAX_MINOR = 3
PER_WORD = 8  # exponents in one machine word of a monomial in FLINT, as long as they are small
SUMS = 12  # monomials that a claim with sums over neighbours sums, about
RATIONAL = frozenset(
    ["INPUT", "CONST", "ADD", "SUB", "NEG", "MUL", "DIV", "INV", "SQ", "TWICE", "POW", "CONSTPOW"]
)
OTHER = {"i": "j", "j": "i"}
Result = TypeVar("Result")


@dataclass
class Session:
    """The exact domain with the problem's assumptions in it. `totals` are the generators of sums over all
    nodes: name, derivatives, law.

    `cases` are the arguments that are supposed not to be negative, by the generator of their absolute value.
    `told` are the logarithms whose signs have been looked for.
    `zeros` are the numerators of the equations assumed at node i, `derived` what follows from them.
    """

    problem: Problem
    domain: ExactDomain
    environment: Environment = field(init=False)
    totals: dict[int, tuple[str, int, str | None]] = field(default_factory=dict)
    zeros: list[tuple[Assumption, Poly]] = field(default_factory=list)
    derived: list[tuple[Derived, list[int]]] = field(default_factory=list)
    cases: dict[int, Poly] = field(default_factory=dict)
    told: set[int] = field(default_factory=set)

    def __post_init__(self) -> None:
        self.environment = Environment(self.problem, self.domain, self.free, self)
        for node in self.nodes():
            for assumption in self.problem.given:
                self._learn(assumption, {"i": node, "j": "j"} if node == "i" else {"i": node})
        if len(self.zeros) > 1:
            self._complete()

    def _complete(self) -> None:
        """Add what follows from several assumed equations together, where their leading monomials meet."""
        zeros = [
            (k, self.domain.fraction(self.at(a.of[0], {"i": "i"}))[0])
            for k, a in enumerate(self.problem.given)
            if a.kind == "zero"
        ]
        for new in completed(self.domain.field, [p for _, p in zeros]):
            self.domain.field.add_relation(new.polynomial)
            self.derived.append((new, [k for k, _ in zeros]))

    def nodes(self) -> list[str]:
        """The generic nodes that occur: i, and j where a neighbour does; a problem without a fleet has the
        one case i.
        """
        letters = {split(name)[1] for tape in self.problem.listings.values() for name in tape.inputs} - {None}
        return ["i", "j"] if "j" in letters else ["i"]

    def free(self, name: str) -> Exact:
        """The generator of a free scalar."""
        return self.domain.polynomial(self.domain.field.variable(self._generator(name)))

    def value(self, at: Environment, name: str, level: int, law: str | None) -> Any:
        """The value of a sum over neighbours as a polynomial in sums of monomials, or of a total as a
        generator.
        """
        meaning = self.problem.names[star(name)]
        assert meaning.of is not None
        node = split(name)[1]
        if meaning.is_ == "total":
            return self._total(name, level, 0, law)
        if node not in OTHER:
            raise Unsupported(f"{name} is a sum over the neighbours of no node")
        return _mapped(
            at.output(meaning.of, {"i": node, "j": OTHER[node]}, level, law), lambda v: self._summed(v, node)
        )

    def carrier(self, value: Exact) -> Poly:
        """A polynomial with the sign of the value: the numerator times the factors of odd exponent below
        it.
        """
        numerator, key = self.domain.together(value)
        for k, e in key:
            if e % 2:
                numerator = numerator * self.domain.field.factors[k]
        return numerator

    def claim(self) -> list[Exact]:
        return list(self.environment.outputs(self.problem.claim.listing, {"i": "i", "j": "j"}))

    def at(self, of: Output, binding: dict[str, str]) -> Exact:
        value: Exact = self.environment.output(of, binding)
        return value

    def proof(self, kind: str, **more: Any) -> dict[str, Any]:
        """The proof for the kernel, from what was evaluated."""
        field = self.domain.field
        relations = []
        for new, given in self.derived:
            parts = [(k, c) for k, c in zip(given, new.cofactors, strict=True) if not c.is_zero()]
            of = [[k, field.json(c)] for k, c in parts]
            relations.append({"poly": field.json(new.polynomial), "of": of})
        whole = {"kind": kind} | self.domain.proof_json() | more
        return whole | ({"relations": relations} if relations else {})

    def latex(self, value: Exact) -> str:
        """The value over one denominator in LaTeX."""
        return value_latex(self.domain.field, self.domain.simplified(value))

    def _total(self, name: str, level: int, order: int, law: str | None) -> Any:
        if level > 0:
            return Pair(
                self._total(name, level - 1, order, law), self._total(name, level - 1, order + 1, law)
            )
        k = self._generator(name + "'" * order)
        if self.totals.setdefault(k, (name, order, law))[2] != law and order:
            raise Unsupported("the rates of one sum under two laws do not go into one claim")
        return self.domain.polynomial(self.domain.field.variable(k))

    def _summed(self, value: Exact, node: str) -> Exact:
        """The sum over the neighbours of a node: what belongs to the node goes before the sum."""
        field, other = self.domain.field, OTHER[node]
        result: Exact = {}
        for key, given in value.items():
            p = field.normal(given)
            if any(other in field.letters(k) for f, _ in key for k in field.occurring(field.factors[f])):
                raise Unsupported("a sum over neighbours that divides by what belongs to the neighbour")
            inside = {k for k in field.occurring(p) if other in field.letters(k)}
            if any(len(field.letters(k)) > 1 for k in inside):
                raise Unsupported("a sum over neighbours of a function of both nodes")
            result = self.domain.add_(result, {key: self._sums_of(p, inside, node)})
        return result

    def _sums_of(self, p: Poly, inside: set[int], node: str) -> Poly:
        field = self.domain.field
        columns = [field.size - 1 - k for k in inside]
        parts: dict[tuple[int, ...], dict[tuple[int, ...], Any]] = {}
        for exponents, c in p.terms():
            own, summed = list(exponents), [0] * field.size
            for v in columns:
                own[v], summed[v] = 0, exponents[v]
            parts.setdefault(tuple(summed), {})[tuple(own)] = c
        total = field.polynomial(0)
        for summed_powers, coefficients in sorted(parts.items()):
            monomial = field.context.from_dict({summed_powers: 1})
            k = self.domain.opaque.generator(Generator("sum", node, monomial))
            total = total + field.context.from_dict(coefficients) * field.variable(k)
        return total

    def _generator(self, name: str) -> int:
        index = self.domain.field.index
        if name not in index:
            index[name] = self.domain.field.add_generator(Generator("free", name))
        return index[name]

    def _learn(self, assumption: Assumption, binding: dict[str, str]) -> None:
        if assumption.kind == "laplacian_bound":
            return  # it is about the graph, and used by the proofs mode by mode
        values = [self.at(of, binding) for of in assumption.of]
        domain = self.domain
        if assumption.kind.startswith("positive_"):
            rows = [values[r :: assumption.size] for r in range(assumption.size)]
            self._learn_minors(rows, "positive" if assumption.kind == "positive_definite" else "nonnegative")
            return
        if assumption.kind == "zero":
            numerator, _ = domain.together(values[0])
            domain.field.add_relation(numerator)
            if binding["i"] == "i" and not numerator.is_zero():
                self.zeros.append((assumption, numerator))
            return
        domain.signs.learn(self.carrier(values[0]), assumption.kind)

    def _learn_minors(self, rows: list[list[Exact]], kind: str) -> None:
        """The principal minors of a definite matrix are positive, of a semidefinite one nonnegative.

        Horn and Johnson, Matrix Analysis, 7.1. Minors of more than MAX_MINOR rows are not formed.
        """
        for size in range(1, min(len(rows), MAX_MINOR) + 1):
            for subset in combinations(range(len(rows)), size):
                minor = determinant_of(self.domain, [[rows[r][c] for c in subset] for r in subset])
                self.domain.signs.learn(self.carrier(minor), kind)


def _mapped(value: Any, change: Callable[[Exact], Exact]) -> Any:
    """The change of each part of a nested pair."""
    if isinstance(value, Pair):
        derivative = None if value.derivative is None else _mapped(value.derivative, change)
        return Pair(_mapped(value.value, change), derivative)
    return change(value)


def exactly(problem: Problem, work: Callable[[Session], Result]) -> Result:
    """`work` on a session of the problem, with as many generators and as fine ones as it turns out to need.

    Raises Unsupported where an operation has no exact meaning, NowhereDefined, NoRate, NotDifferentiable.
    """
    knowledge = Knowledge()
    spare = _expected(problem)
    for _ in range(MAX_RESTARTS):
        try:
            return work(Session(problem, ExactDomain(Field([], spare), knowledge)))
        except OutOfGenerators:
            spare *= 2
        except Refine:
            continue
    raise Unsupported("the roots and angles of this claim need ever finer generators")


def _expected(problem: Problem) -> int:
    """How many generators the problem will need, about: each one that is reserved makes monomials longer."""
    tapes = problem.listings.values()
    nodes = {split(name)[1] for tape in tapes for name in tape.inputs} - {None}
    sums = SUMS * any(meaning.is_ in ("sum", "total") for meaning in problem.names.values())
    opaque = sum(len([step for step in tape.code if step.op not in RATIONAL]) for tape in tapes)
    count = (len(problem.scalars) + opaque + sums) * max(1, len(nodes))
    return max(1, -(-count // PER_WORD)) * PER_WORD
