"""The largest eigenvalue of a graph's Laplacian between two rationals, and whether it exceeds a number.

Floating point proposes vectors and factors; each bound holds by integers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import floor
from typing import TYPE_CHECKING, Any

import numpy as np

from symctrl.decide.definiteness import decide_matrix
from symctrl.decide.direction import null_vector
from symctrl.kernel import laplacian
from symctrl.kernel.certificate import Refused
from symctrl.spectral import certificates, factor
from symctrl.spectral.matrix import integers, largest_eigenvalue, shifted
from symctrl.spectral.network import Array, Network, of_graph
from symctrl.spectral.vectors import DIGITS, GAP, Search
from symctrl.spectral.witness import lanczos, laplacian_times, quotient, rounded
from symctrl.verdict import Outcome

if TYPE_CHECKING:
    import networkx as nx

SMALL = 200  # nodes up to which exact elimination settles every case
TINY = 30  # nodes up to which its certificate is checked as quickly as any
STEPS = 150
MORE_STEPS = 150
METHODS = {
    "vector": "a positive vector",
    "factor": "a rounded factor",
    "elimination": "exact elimination",
    "size": "the number of nodes",
}


@dataclass(frozen=True)
class Bracket:
    """low <= largest eigenvalue <= high.

    vector: integers x with x'Lx >= low x'x. proof: of the kernel, that no eigenvalue exceeds high; strict:
    that none reaches it.
    """

    low: Fraction
    high: Fraction
    vector: tuple[int, ...]
    proof: Mapping[str, Any]
    strict: bool

    def __str__(self) -> str:
        return f"[{self.low}, {self.high}]" if self.low < self.high else str(self.low)


@dataclass(frozen=True)
class Decision:
    """Whether the largest eigenvalue is at most (or below) a number; certificate: None where undecided."""

    outcome: Outcome
    reason: str
    bracket: Bracket
    certificate: Mapping[str, Any] | None = None


def extreme_eigenvalue(graph: nx.Graph, thresholds: Sequence[Fraction] = ()) -> Bracket:
    """Bounds of the largest eigenvalue of the Laplacian; thresholds: numbers to have on one side if possible.

    Raises ValueError for a graph without nodes, or one that is directed or has loops.
    """
    return _bracket(of_graph(graph), tuple(map(Fraction, thresholds)))


def decide_at_most(graph: nx.Graph, t: Fraction, strict: bool = False) -> Decision:
    """Is every eigenvalue of the Laplacian at most t (strict: below t)? Raises as `extreme_eigenvalue`."""
    network, t = of_graph(graph), Fraction(t)
    bracket = _bracket(network, (t,), strict)
    words = f"the largest eigenvalue of the Laplacian is {'below' if strict else 'at most'} {t}"
    found = quotient(network, np.array(bracket.vector))
    statement = certificates.statement(network, str(graph.name) or "graph", t, strict)
    if found > t or (strict and found == t):
        proof: Mapping[str, Any] = {"kind": "witness", "x": list(bracket.vector)}
        reason = f"it is {'at least' if strict else 'above'} {t}: by a vector, x'Lx / x'x = {_short(found)}"
        return _checked(Decision(Outcome.REFUTED, reason, bracket), statement, proof)
    if bracket.high < t or (bracket.high == t and (bracket.strict or not strict)):
        reason = f"{words}: by {METHODS[bracket.proof['kind']]}"
        return _checked(Decision(Outcome.PROVED, reason, bracket), statement, bracket.proof)
    return Decision(Outcome.UNDECIDED, _undecided(network, bracket), bracket)


def _checked(decision: Decision, statement: dict[str, Any], proof: Mapping[str, Any]) -> Decision:
    """The decision with its certificate, if the kernel accepts it."""
    try:
        laplacian.verify(laplacian.read_statement(statement), dict(proof))
    except Refused as refused:
        reason = f"{decision.reason}; but the kernel does not accept it: {refused}"
        return Decision(Outcome.UNDECIDED, reason, decision.bracket)
    made = certificates.certificate(statement, proof)
    return Decision(decision.outcome, decision.reason, decision.bracket, made)


def _undecided(network: Network, bracket: Bracket) -> str:
    reason = f"the largest eigenvalue is between {_short(bracket.low)} and {_short(bracket.high)}"
    if factor.is_cheap(network):
        return reason
    return (
        f"{reason}; a positive vector can bound that of degrees plus adjacency only, "
        "and the graph is too large for a factor"
    )


def _bracket(network: Network, thresholds: tuple[Fraction, ...], strict: bool = False) -> Bracket:
    """strict: a threshold that is the upper bound is wanted as one that no eigenvalue reaches."""
    if network.nodes <= SMALL:
        return _of_small(network, thresholds)
    return _of_large(network, thresholds, strict)


def _of_small(network: Network, thresholds: tuple[Fraction, ...]) -> Bracket:
    rows = (np.diag(network.degrees) - network.adjacency.toarray().astype(np.int64)).tolist()
    found = largest_eigenvalue(rows)
    best = Bracket(found.low, found.high, integers(found.vector), {}, found.low < found.high)
    for t in thresholds:
        if best.low < t < best.high:
            best = _with_side(rows, best, t)
    search = Search(network)
    if search.best.bound <= best.high:
        return replace(best, proof=_vector_proof(search), strict=search.best.strict)
    if network.nodes == best.high:
        return replace(best, proof={"kind": "size"}, strict=False)
    if best.strict and network.nodes > TINY:
        below = quotient(network, np.array(best.vector, dtype=object))
        proof = factor.proof(network, best.high, float(below))
        if proof is not None and _holds(network, best.high, proof):
            return replace(best, proof=proof)
    return replace(best, proof={"kind": "elimination"})


def _with_side(rows: Sequence[Sequence[int]], best: Bracket, t: Fraction) -> Bracket:
    """The bracket with t, which is in it, as one of its ends."""
    answer = decide_matrix(shifted(rows, t))
    if answer.witness is not None:
        return replace(best, low=t, vector=integers(answer.witness))
    if answer.definiteness == "positive definite":
        return replace(best, high=t)
    return replace(best, low=t, high=t, vector=integers(null_vector(shifted(rows, t))), strict=False)


def _of_large(network: Network, thresholds: tuple[Fraction, ...], strict: bool) -> Bracket:
    low = _Low(network)
    search = Search(network)
    cheap = factor.is_cheap(network)
    size = Fraction(network.nodes)
    if network.sides is not None:
        low.consider(network.sides * search.best.x)
    if low.bound < min(search.best.bound, size):
        low.improve(lanczos(laplacian_times(network), network.nodes, STEPS))
        search.tighten(low.bound, thresholds, strict)
        low.polish(search, cheap)
    best = Bracket(low.bound, search.best.bound, (), _vector_proof(search), search.best.strict)
    if size < best.high:
        best = Bracket(low.bound, size, (), {"kind": "size"}, False)
    if cheap:
        wanted = tuple(t for t in thresholds if t < best.high or (strict and not best.strict))
        best = _by_factors(network, best, wanted, float(low.quotient))
    return Bracket(best.low, best.high, tuple(low.x.tolist()), best.proof, best.strict)


def _by_factors(network: Network, best: Bracket, thresholds: tuple[Fraction, ...], below: float) -> Bracket:
    """The bracket with a factor for its upper bound, where one is better; below: the eigenvalue in floats."""
    gaps = (Fraction(1, 10**k) for k in (6, 4, 2))
    narrow = [best.low + 2 * gap for gap in gaps if best.high - best.low > 4 * GAP]
    for t in sorted({*narrow, *thresholds}):
        if best.low < t <= best.high:
            proof = factor.proof(network, t, below)
            if proof is not None and _holds(network, t, proof):
                return Bracket(best.low, t, (), proof, True)
    return best


def _holds(network: Network, t: Fraction, proof: dict[str, Any]) -> bool:
    """Does the kernel find that no eigenvalue reaches t?"""
    try:
        statement = laplacian.read_statement(certificates.statement(network, "graph", t, strict=True))
        laplacian.verify(statement, proof)
    except Refused:
        return False
    return True


class _Low:
    """The best lower bound so far, and its vector."""

    def __init__(self, network: Network) -> None:
        self.network = network
        edge = int(np.argmax(network.degrees[network.a] + network.degrees[network.b])) if network.edges else 0
        x = np.zeros(network.nodes, dtype=np.int64)
        x[0] = 1
        if network.edges:
            x[0], x[network.a[edge]], x[network.b[edge]] = 0, 1, -1
        self.x, self.quotient = x, quotient(network, x)
        if network.sides is not None:
            self.consider(network.sides)

    @property
    def bound(self) -> Fraction:
        """The quotient, or less in few digits."""
        if self.quotient.denominator <= 10**DIGITS:
            return self.quotient
        return Fraction(floor(self.quotient * 10**DIGITS), 10**DIGITS)

    def consider(self, x: Array) -> None:
        found = quotient(self.network, x)
        if found > self.quotient:
            self.x, self.quotient = x, found

    def improve(self, x: Array) -> None:
        """Consider floats, rounded."""
        if np.isfinite(x).all() and x.any():
            self.consider(rounded(self.network, x))

    def polish(self, search: Search, cheap: bool) -> None:
        """Better vectors, where the bounds are apart: from the upper bound's, and by more iterations."""
        network, high = self.network, search.best.bound
        if network.sides is not None:
            self.improve(network.sides * search.best.x.astype(float))
        if cheap:
            found = factor.inverse_iteration(network, float(high), self.x.astype(float))
            if found is not None:
                self.improve(found)
        if float(high - self.quotient) > 10 * GAP and not cheap:
            self.improve(lanczos(laplacian_times(network), network.nodes, MORE_STEPS, self.x.astype(float)))


def _vector_proof(search: Search) -> dict[str, Any]:
    return {"kind": "vector", "x": search.best.x.tolist()}


def _short(value: Fraction) -> str:
    return str(value) if value.denominator <= 10**DIGITS else f"about {float(value):.9g}"
