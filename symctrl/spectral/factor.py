"""Upper bounds of the largest eigenvalue of a Laplacian by rounded Cholesky factors of t I - L.

F F' misses t I - L by a remainder that is diagonally dominant (Rump, Verification of positive definiteness,
BIT 46, 2006, has the like in floating point); the kernel forms the remainder in integers. The factor of a
tree, a ring or a few thousand nodes is sparse enough for that; that of a large expander is not.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np

from symctrl.kernel import laplacian
from symctrl.spectral.network import Array, Network

UNIT = 2**40
FILL = 500  # edges more than nodes up to which a graph of any size has a sparse factor
NODES = 2500  # up to which other graphs are tried
DENSE = 600  # up to which any graph is
EDGES = 20  # a node, beyond which the factor of a graph larger than that is not sparse


def is_cheap(network: Network) -> bool:
    """Is a factor worth the attempt?"""
    sparse = network.nodes <= NODES and network.edges <= EDGES * network.nodes
    return network.edges <= network.nodes + FILL or network.nodes <= DENSE or sparse


def proof(network: Network, t: Fraction, below: float) -> dict[str, Any] | None:
    """A proof for the kernel that no eigenvalue reaches t; below: the largest as floats have it."""
    lu = _factors(network, (float(t) + below) / 2)
    if lu is None or (lu.perm_r != lu.perm_c).any():
        return None
    pivots = lu.U.diagonal()
    if not pivots.min() > 0:
        return None
    factor = lu.L.tocsc()
    if (np.diff(factor.indptr).astype(float) ** 2).sum() > laplacian.MAX_PRODUCTS:
        return None
    values = np.rint(factor.data * np.repeat(np.sqrt(pivots) * UNIT, np.diff(factor.indptr)))
    nodes = np.argsort(lu.perm_c)[factor.indices] + 1
    columns = [
        _column(nodes[start:stop], values[start:stop])
        for start, stop in zip(factor.indptr, factor.indptr[1:], strict=False)
    ]
    return {"kind": "factor", "x": [1] * network.nodes, "unit": UNIT, "columns": columns}


def inverse_iteration(network: Network, shift: float, start: Array, steps: int = 6) -> Array | None:
    """Floats nearer to the eigenvector whose eigenvalue is nearest to the shift."""
    lu = _factors(network, shift)
    x = start
    for _ in range(steps if lu is not None else 0):
        x = lu.solve(x)
        size = np.abs(x).max()
        if not np.isfinite(size) or size == 0:
            return None
        x = x / size
    return None if lu is None else x


def _factors(network: Network, shift: float) -> Any:
    """L U of shift I - Laplacian, as for a symmetric definite matrix; None where it is singular."""
    from scipy import sparse
    from scipy.sparse.linalg import splu

    matrix = sparse.diags(shift - network.degrees) + network.adjacency
    options = {"SymmetricMode": True}
    try:
        return splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    except RuntimeError:
        return None


def _column(nodes: Array, values: Array) -> list[int]:
    order = np.argsort(nodes)
    kept = order[values[order] != 0]
    return np.column_stack([nodes[kept], values[kept]]).astype(np.int64).ravel().tolist()
