"""A sum over all nodes is nonnegative: node by node, or mode by mode of the graph's Laplacian.

Soundness-critical. Last reviewed 2026-11-24.

Theorem (`each`). A sum over nodes of terms that are nonnegative at every node is nonnegative; so is a sum
over nodes i and neighbours j of terms t(i, j) with t(i, j) + t(j, i) >= 0 for every edge: in an undirected
graph each is taken in both directions.

Theorem (`spectral`). Let L be the Laplacian of an undirected graph with no eigenvalue above b, and P a
quadratic form with constant coefficients. If P(x, m x) >= 0 for all x and all m with 0 <= m <= b, then the
sum over nodes i of P(x_i, (L x)_i) is nonnegative for every graph.

Proof. L = U diag(m) U' with U orthogonal and 0 <= m_k <= b. The sum over nodes of a product of two components
is that of their coordinates in the columns of U, in which L x has the coordinates m_k times those of x: the
sum is the sum over k of P(y_k, m_k y_k). Source: spectral theorem; Godsil and Royle, Algebraic Graph Theory,
on Laplacians.

In the terms at a node, the sum over neighbours of x is the degree times x less (L x), and the sum over nodes
and neighbours j of c x_j y_j, for a constant c, is that over nodes of c times the degree times x y. The
degree must cancel.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from symctrl.kernel import combination
from symctrl.kernel.argument import single
from symctrl.kernel.certificate import (
    Declined,
    Invalid,
    at_node,
    fields,
    natural,
    per_node,
    split_name,
    typed,
)
from symctrl.kernel.closure import Reach
from symctrl.kernel.conditions import SIGNS
from symctrl.kernel.field import Value
from symctrl.kernel.polynomial import Poly, powers
from symctrl.kernel.sums import OTHER, SumIdentity, opened
from symctrl.kernel.values import Assumption, Claim, Condition, Listing, Statement, Step

MODE = "mode"
SHARED = ("kind", "generators", "factors", "hints")
Key = tuple[tuple[int, int], ...]


def needed_conditions_each(statement: Statement, proof: dict[str, Any]) -> set[Condition]:
    """Field `term`: the proof for the terms at a node, {given, proof}, in place of the sums over nodes."""
    evaluation = {key: value for key, value in proof.items() if key != "term"}
    fields(proof, (*SHARED, "term"), "proof", ("relations",))
    test, values = opened(statement, evaluation, ("nonnegative",))
    if len(values) != 1:
        raise Invalid("a proof node by node is of one value")
    _combined(test, values[0])  # it is a linear combination of sums over nodes with constant coefficients
    return test.replay.close() | _proved(at_a_node(statement), statement.given, proof["term"])


def at_a_node(statement: Statement) -> Statement:
    """The claim with the term at node i in the place of each sum over nodes; where all terms are sums over
    the neighbours, with those of an edge in both directions. Raises Invalid for other names.
    """
    listing = statement.listings[statement.claim.listing]
    _require_linear(statement, listing)
    _require_own(statement, MODE)
    terms = {step.name: _term(statement, step.name) for step in listing.code if step.op == "INPUT"}
    edges = {name: _summand(statement, term) for name, term in terms.items() if term is not None}
    of_edges = bool(edges) and None not in edges.values()
    if of_edges:
        terms = {**terms, **edges}
    maker = _Inlined()
    for step in listing.code:
        term = terms.get(step.name) if step.op == "INPUT" else None
        if term is None and step.op == "INPUT" and statement.scalars.get(step.name) != "parameter":
            raise Invalid(f"{step.name[:60]} is neither a sum over nodes nor a constant")
        maker.put(step, term, both=of_edges)
    made = Listing(tuple(maker.code), tuple(maker.place[r] for r in listing.outputs), "")
    claim = Claim("nonnegative", MODE, (1, 1))
    return replace(statement, listings={**statement.listings, MODE: made}, claim=claim)


def _require_own(statement: Statement, *names: str) -> None:
    for name in names:
        if name in statement.listings:
            raise Invalid(f"the name {name} of a listing belongs to the proof")


def _require_linear(statement: Statement, listing: Listing) -> None:
    """Each output is, as it is written, a linear combination of sums over nodes with constant coefficients.

    What is linear only by what is assumed of the sums is not so term by term.
    """
    degrees: list[int | None] = []  # None: constantly zero
    for step in listing.code:
        degrees.append(_degree(statement, step, [degrees[a] for a in step.args]))
    if any(degrees[r] == 0 for r in listing.outputs):
        raise Invalid("a constant is no sum over nodes")


def _degree(statement: Statement, step: Step, args: list[int | None]) -> int | None:
    """In the sums over nodes: 0 or 1. Raises Invalid for what is not linear."""
    known = [a for a in args if a is not None]
    if step.op == "INPUT":
        meaning = statement.names.get(step.name)
        return 1 if meaning is not None and meaning.kind == "total" else 0
    if step.op == "CONST":
        return 0 if step.value else None
    if not any(known):
        return 0 if known else None if step.op in ("ADD", "SUB", "NEG", "MUL", "TWICE", "SQ") else 0
    if step.op in ("NEG", "TWICE") or (step.op in ("ADD", "SUB") and 0 not in known):
        return 1
    if step.op == "MUL" and sum(known) == 1:
        return 1 if len(known) == 2 else None
    if step.op == "DIV" and args == [1, 0]:
        return 1
    raise Invalid(f"{step.op} of sums over nodes is not linear in them")


def _term(statement: Statement, name: str) -> Listing | None:
    """The term at node i of a sum over all nodes."""
    meaning = statement.names.get(name)
    if meaning is None or meaning.kind != "total":
        return None
    return single(statement.listings[meaning.of[0]], meaning.of[1])


def _summand(statement: Statement, term: Listing) -> Listing | None:
    """The term of an edge, where the term of a node is a sum over its neighbours and nothing else."""
    key = split_name(term.code[0].name)[0] if len(term.code) == 1 and term.code[0].op == "INPUT" else ""
    meaning = statement.names.get(key)
    if meaning is None or meaning.kind != "sum":
        return None
    return single(statement.listings[meaning.of[0]], meaning.of[1])


class _Inlined:
    """Instructions in which an input may be replaced by a listing of one output."""

    def __init__(self) -> None:
        self.code: list[Step] = []
        self.place: list[int] = []

    def put(self, step: Step, instead: Listing | None, both: bool = False) -> None:
        """both: the listing and, added to it, the same with the nodes i and j exchanged."""
        if instead is None:
            self.place.append(self._emit(step, self.place))
            return
        there = self._put(instead.code)[instead.outputs[0]]
        if both:
            back = self._put([replace(inner, name=_exchanged(inner.name)) for inner in instead.code])
            self.code.append(Step("ADD", (there, back[instead.outputs[0]])))
            there = len(self.code) - 1
        self.place.append(there)

    def _put(self, code: Sequence[Step]) -> list[int]:
        registers: list[int] = []
        for inner in code:
            registers.append(self._emit(inner, registers))
        return registers

    def _emit(self, step: Step, registers: list[int]) -> int:
        moved = Step(step.op, tuple(registers[a] for a in step.args), step.name, step.value)
        if moved not in self.code:
            self.code.append(moved)
        return self.code.index(moved)


def _exchanged(name: str) -> str:
    """The name at the other end of the edge."""
    key, node = split_name(name) if name else ("", "")
    return at_node(key, OTHER[node]) if node in OTHER else name


def needed_conditions_spectral(statement: Statement, proof: dict[str, Any]) -> set[Condition]:
    """Field `modes`: the proof that P(x, m x) >= 0, {given, proof}; m is called `mode`."""
    evaluation = {key: value for key, value in proof.items() if key not in ("modes", "bound")}
    fields(proof, (*SHARED, "modes", "bound"), "proof", ("relations",))
    bound = natural(proof["bound"], len(statement.given), "bound")
    if statement.given[bound].kind != "laplacian_bound":
        raise Invalid(f"assumption {bound} does not bound the eigenvalues of the Laplacian")
    test, values = opened(statement, evaluation, ("nonnegative",))
    if len(values) != 1 or MODE in statement.scalars or MODE in statement.names:
        raise Invalid("a proof mode by mode is of one sum over nodes")
    p = _at_a_node(test, values[0])
    form = _in_modes(test, p)
    _require_own(statement, f"{MODE}s", f"{MODE} is", f"{MODE} below")
    inner = _statement(statement, test, form, bound)
    usable = [k for k, a in enumerate(inner.given) if k >= len(statement.given) or _is_global(statement, a)]
    return test.replay.close() | _proved(inner, inner.given, proof["modes"], usable)


def _is_global(statement: Statement, assumption: Assumption) -> bool:
    """Is it about parameters that belong to no node? Coordinates in modes are not the values at nodes."""
    reach = Reach(statement)
    for name, _ in assumption.of:
        reach.listing(name, "i", 0, None)
    scalars, names = statement.scalars, statement.names
    return all(
        not per_node(key)
        and (scalars.get(key) == "parameter" or (key in names and names[key].kind in ("value", "constant")))
        for key in reach.read
    )


def _proved(
    statement: Statement, given: tuple[Assumption, ...], entry: Any, usable: Sequence[int] | None = None
) -> set[Condition]:
    table = fields(entry, ("given", "proof"), "the inner proof")
    numbers = [natural(k, len(given), "given") for k in typed(table["given"], list, "given")]
    if numbers != sorted(set(numbers)):
        raise Invalid("the assumptions are numbered in order, each once")
    if usable is not None and not set(numbers) <= set(usable):
        raise Invalid("an assumption about what belongs to a node says nothing of modes")
    chosen = replace(statement, given=tuple(given[k] for k in numbers))
    proof = typed(table["proof"], dict, "the inner proof")
    if proof.get("kind") != "combination":
        raise Declined("the inner proof is not a combination")
    return combination.needed_conditions(chosen, proof)


def _at_a_node(test: SumIdentity, value: Any) -> Poly:
    """The terms of the totals at node i, over a denominator that is positive and constant."""
    field = test.field
    p, below = field.fraction(_combined(test, value))
    for f, _ in below:
        if test.replay.signs.of(field.factors[f]) != SIGNS["positive"] or _local(test, field.factors[f]):
            raise Invalid("a denominator at a node is not a positive constant")
    return field.normal(p)


def _combined(test: SumIdentity, value: Value) -> Value:
    """The combination of the terms of the totals at node i. What a term divides by may belong to the node: a
    proof node by node is of the term as it is.
    """
    field = test.field
    numerator, key = field.fraction(value)
    for f, _ in key:
        if test.replay.signs.of(field.factors[f]) != SIGNS["positive"]:
            raise Invalid("a denominator of the sum is not known to be positive")
    coefficients = test._coefficients(field.normal(numerator), "the sum")
    return test._at_node(coefficients, "i")


def _local(test: SumIdentity, p: Poly) -> bool:
    return any(_kind(test, k) != "constant" for m in p for k, _ in powers(m))


def _kind(test: SumIdentity, k: int) -> str:
    """Of a generator: constant, node (a free symbol of node i), sum or other."""
    g = test.replay.table[k]
    if g.kind == "sum":
        return "sum"
    if g.kind != "free":
        return "other"
    scalars, name = test.replay.statement.scalars, g.name
    if ".i" in name:
        return "node"
    return "constant" if scalars.get(name) == "parameter" else "other"


def _in_modes(test: SumIdentity, p: Poly) -> dict[tuple[Key, Key, int], Fraction]:
    """Coefficients of P(x, m x) by (constants, node symbols, power of m)."""
    found: dict[tuple[Key, Key, int, int], Fraction] = {}
    for m, c in p.items():
        for (constants, nodes, degree, mode), share in _expanded(test, powers(m)):
            key = (constants, nodes, degree, mode)
            found[key] = found.get(key, Fraction(0)) + Fraction(c) * share
    kept = {key: c for key, c in found.items() if c}
    for constants, nodes, degree, _ in kept:
        if degree:
            raise Invalid("the degree of a node does not cancel: the sum is no form in x and L x")
        if sum(e for _, e in nodes) != 2:
            raise Invalid("the sum is no quadratic form in the symbols of a node")
        if any(_kind(test, k) != "constant" for k, _ in constants):
            raise Invalid("a coefficient of the form is not constant")
    return {(constants, nodes, mode): c for (constants, nodes, _, mode), c in kept.items()}


def _expanded(
    test: SumIdentity, factors: list[tuple[int, int]]
) -> list[tuple[tuple[Key, Key, int, int], int]]:
    """A monomial with its sums over neighbours put in terms of the degree d and of L x = m x at the node."""
    constants = [(k, e) for k, e in factors if _kind(test, k) == "constant"]
    nodes = {k: e for k, e in factors if _kind(test, k) == "node"}
    sums = [(k, e) for k, e in factors if _kind(test, k) == "sum"]
    if any(_kind(test, k) == "other" for k, _ in factors):
        raise Invalid("the sum has a term that is no product of symbols of a node")
    results: list[tuple[dict[int, int], int, int, int]] = [(nodes, 0, 0, 1)]
    for k, e in sums:
        inside = dict(test.replay.table[k].powers)
        size = sum(inside.values())
        alone = not nodes and len(sums) == 1 and e == 1
        if size > 2 or (size == 2 and not alone):
            raise Invalid("a sum over neighbours of a product beside other symbols of the node")
        for _ in range(e):
            results = [new for old in results for new in _one_sum(test, old, inside, size)]
    return [((tuple(constants), tuple(sorted(n.items())), d, m), share) for n, d, m, share in results]


def _one_sum(
    test: SumIdentity, old: tuple[dict[int, int], int, int, int], inside: dict[int, int], size: int
) -> list[tuple[dict[int, int], int, int, int]]:
    """Sum of 1: d. Sum of x_j: d x - m x. Sum of x_j y_j, under the sum over nodes: d x y."""
    nodes, degree, mode, share = old
    merged = dict(nodes)
    for k, e in inside.items():
        at = _same_at_i(test, k)
        merged[at] = merged.get(at, 0) + e
    if size == 1:
        return [(merged, degree + 1, mode, share), (merged, degree, mode + 1, -share)]
    return [(merged, degree + 1, mode, share)]


def _same_at_i(test: SumIdentity, k: int) -> int:
    """The generator of node i that is the neighbour's generator k."""
    name = test.replay.table[k].name.replace(".j", ".i", 1)
    if test.replay.table[k].kind != "free" or name not in test.replay.free:
        raise Invalid(f"{test.replay.table[k].name[:60]} of the neighbour has no like at the node")
    return test.replay.free[name]


def _statement(
    statement: Statement, test: SumIdentity, form: dict[tuple[Key, Key, int], Fraction], bound: int
) -> Statement:
    """That P(x, m x) >= 0 for 0 <= m <= b."""
    name: Callable[[int], str] = lambda k: test.replay.table[k].name  # noqa: E731
    listing = polynomial_listing(
        [
            (c, [(name(k), e) for k, e in (*constants, *nodes)] + ([(MODE, mode)] if mode else []))
            for (constants, nodes, mode), c in form.items()
        ]
    )
    b = single(statement.listings[statement.given[bound].of[0][0]], statement.given[bound].of[0][1])
    below = Listing(
        (*b.code, Step("INPUT", name=MODE), Step("SUB", (b.outputs[0], len(b.code)))), (len(b.code) + 1,), ""
    )
    listings = {
        **statement.listings,
        f"{MODE}s": listing,
        f"{MODE} is": Listing((Step("INPUT", name=MODE),), (0,), ""),
        f"{MODE} below": below,
    }
    given = (
        *statement.given,
        Assumption("nonnegative", ((f"{MODE} is", 0),), text=f"{MODE} >= 0"),
        Assumption("nonnegative", ((f"{MODE} below", 0),), text=f"{MODE} <= the bound of eigenvalues"),
    )
    claim = Claim("nonnegative", f"{MODE}s", (1, 1))
    scalars = {**statement.scalars, MODE: "parameter"}
    return replace(statement, listings=listings, given=given, claim=claim, scalars=scalars)


def polynomial_listing(terms: list[tuple[Fraction, list[tuple[str, int]]]]) -> Listing:
    """A polynomial by its terms, in an order of their own, as a listing."""
    code: list[Step] = []
    at: dict[Step, int] = {}

    def emit(step: Step) -> int:
        if step not in at:
            at[step] = len(code)
            code.append(step)
        return at[step]

    total = emit(Step("CONST", value=Fraction(0)))
    for c, factors in sorted(terms, key=lambda term: sorted(term[1])):
        term = emit(Step("CONST", value=c))
        for name, e in sorted(factors):
            for _ in range(e):
                term = emit(Step("MUL", (term, emit(Step("INPUT", name=name)))))
        total = emit(Step("ADD", (total, term)))
    return Listing(tuple(code), (total,), "")
