"""Sums of polynomials in few variables each: one Gram matrix for each group of variables.

Waki, Kim, Kojima and Muramatsu (SIAM J. Optim. 17, 2006): variables are joined where they meet in a term; the
groups are the maximal cliques of a chordal extension of this graph. Here Clarabel is the solver: many small
cones are what it is good at. Rounding spreads what is left of a monomial over all groups that make it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import networkx as nx
import numpy as np
from scipy import sparse

from symctrl.sos.basis import monomials
from symctrl.sos.deadline import Deadline
from symctrl.sos.proof import Part
from symctrl.sos.ring import Monomial, Poly, terms
from symctrl.sos.rounding import monomial_parts

MAX_GROUP = 60  # monomials over one group


@dataclass(frozen=True)
class Groups:
    """For each group of variables, the monomials over it that may occur in squares."""

    bases: list[list[Monomial]]


def groups(p: Poly) -> Groups | None:
    """The groups, None where they are not small or there is only one."""
    table = terms(p)
    n = len(p.context().names())
    graph = nx.Graph()
    for m in table:
        used = [k for k, e in enumerate(m) if e]
        graph.add_nodes_from(used)
        graph.add_edges_from((a, b) for i, a in enumerate(used) for b in used[:i])
    if graph.number_of_nodes() < 3:
        return None
    chordal, _ = nx.complete_to_chordal_graph(graph)
    found = [sorted(clique) for clique in nx.chordal_graph_cliques(chordal)]
    if len(found) < 2:
        return None
    half = -(-max(sum(m) for m in table) // 2)
    least = min(sum(m) for m in table) // 2
    bases = []
    for clique in sorted(found):
        own = monomials(len(clique), half, least)
        if len(own) > MAX_GROUP:
            return None
        spread = []
        for b in own:
            exponents = dict(zip(clique, b, strict=True))
            spread.append(tuple(exponents.get(k, 0) for k in range(n)))
        bases.append(spread)
    return Groups(_pruned(bases, set(table)))


def _pruned(bases: list[list[Monomial]], support: set[Monomial]) -> list[list[Monomial]]:
    """Without monomials whose square nothing can cancel (diagonal consistency), in all groups at once."""
    while True:
        sums = {
            tuple(x + y for x, y in zip(a, b, strict=True))
            for basis in bases
            for i, a in enumerate(basis)
            for b in basis[:i]
        }
        kept = [
            [b for b in basis if (d := tuple(2 * e for e in b)) in support or d in sums] for basis in bases
        ]
        if kept == bases:
            return [basis for basis in kept if basis]
        bases = kept


def search_groups(p: Poly, found: Groups, deadline: Deadline) -> list[Part] | None:
    """p as a sum over the groups of sums of squares; None where none is found with a margin."""
    table = terms(p)
    hs = _solve(table, found.bases)
    deadline.check()
    if hs is None:
        return None
    return monomial_parts(p, found.bases, hs, p.context())


def _solve(table: dict[Monomial, Any], bases: Sequence[Sequence[Monomial]]) -> list[Any] | None:
    """Gram matrices with the largest margin, over the scaled polynomial, by Clarabel."""
    import clarabel

    size = max(abs(float(c)) for c in table.values())
    place: dict[Monomial, int] = {m: k for k, m in enumerate(table)}
    rows, columns, values = [], [], []
    starts, count = [], 0
    margin: dict[int, float] = {}
    for basis in bases:
        starts.append(count)
        for i, a in enumerate(basis):
            for j in range(i + 1):
                m = tuple(x + y for x, y in zip(a, basis[j], strict=True))
                row = place.setdefault(m, len(place))
                rows.append(row)
                columns.append(count)
                values.append(1.0 if i == j else float(np.sqrt(2)))
                if i == j:
                    margin[row] = margin.get(row, 0.0) + 1.0
                count += 1
    # Variables: the scaled triangles of all X, then lam. Equations, then X in its cones.
    rows += list(margin)
    columns += [count] * len(margin)
    values += list(margin.values())
    equations = sparse.csc_matrix((values, (rows, columns)), shape=(len(place), count + 1))
    right = np.zeros(len(place))
    for m, c in table.items():
        right[place[m]] = float(c) / size
    cone = -sparse.eye(count, count + 1, format="csc")
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_threads = 1
    cones = [clarabel.ZeroConeT(len(place)), *(clarabel.PSDTriangleConeT(len(basis)) for basis in bases)]
    objective = np.zeros(count + 1)
    objective[count] = -1.0
    done = clarabel.DefaultSolver(
        sparse.csc_matrix((count + 1, count + 1)),
        objective,
        sparse.vstack([equations, cone], format="csc"),
        np.concatenate([right, np.zeros(count)]),
        cones,
        settings,
    ).solve()
    x = np.array(done.x)
    if not np.isfinite(x).all() or x[count] <= 0:
        return None
    hs = []
    for basis, start in zip(bases, starts, strict=True):
        n = len(basis)
        h = np.zeros((n, n))
        low = np.tril_indices(n)
        h[low] = x[start : start + n * (n + 1) // 2]
        h = (h + h.T) / np.sqrt(2)
        h[np.diag_indices(n)] /= np.sqrt(2)
        hs.append(size * (h + x[count] * np.eye(n)))
    return hs
