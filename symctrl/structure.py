"""The structure of a matrix as its author wrote it: Kronecker products with an identity, blocks, congruences.

Definiteness is decided on the parts; nothing is expanded.
"""

from __future__ import annotations

from typing import Any

from symctrl.expr import Expr, lift
from symctrl.records import Named, fingerprint
from symctrl.vectors import eye

Tree = dict[str, Any]


def lowered(matrix: Expr, expanded: bool = False) -> tuple[Tree, list[Expr]]:
    """The tree of a claim of definiteness, and the expressions whose entries, one after another, its leaves
    count. expanded: the tree of all entries, which a witness speaks of.
    """
    parts: list[Expr] = []
    if expanded:
        return {"entries": _entries(matrix, parts)}, parts
    return _tree(matrix, parts), parts


def _tree(matrix: Expr, parts: list[Expr]) -> Tree:
    matrix = _opened(matrix)
    if matrix.op == "kron" and _opened(matrix.args[1]).op == "eye":
        return {"kron_identity": _tree(matrix.args[0], parts), "size": matrix.args[1].shape[0]}
    if matrix.op == "diagonal" and all(part.shape[0] == part.shape[1] for part in matrix.args):
        return {"blocks": [_tree(part, parts) for part in matrix.args]}
    if matrix.op == "eye":
        return {"kron_identity": {"entries": _entries(lift(1), parts)}, "size": matrix.shape[0]}
    if matrix.op == "scale" and _opened(matrix.args[1]).op == "eye":
        return {"kron_identity": _tree(matrix.args[0], parts), "size": matrix.args[1].shape[0]}
    found = _congruence(matrix)
    if found is not None:
        factor, middle = found
        return {"congruence": _tree(middle, parts), "factor": _entries(factor, parts)}
    return {"entries": _entries(matrix, parts)}


def _congruence(matrix: Expr) -> tuple[Expr, Expr] | None:
    """C and P where the matrix is written Cᵀ P C, or Cᵀ C with P = I."""
    if matrix.op != "matmul":
        return None
    if matrix.args[0].op != "matmul":
        return _gram(*matrix.args)
    (left, middle), right = matrix.args[0].args, matrix.args[1]
    if left.op == "transpose" and fingerprint(left.args[0]) == fingerprint(right):
        return right, middle
    return None


def _gram(left: Expr, right: Expr) -> tuple[Expr, Expr] | None:
    """C and I where a product is Cᵀ C."""
    if left.op == "transpose" and fingerprint(left.args[0]) == fingerprint(right):
        return right, eye(right.shape[0])
    if right.op == "transpose" and fingerprint(right.args[0]) == fingerprint(left):
        return right, eye(right.shape[0])
    return None


def _entries(matrix: Expr, parts: list[Expr]) -> list[list[int]]:
    """Rows of output positions; the entries of an expression are column by column."""
    start = sum(part.shape[0] * part.shape[1] for part in parts)
    parts.append(matrix)
    rows, columns = matrix.shape
    return [[start + r + rows * c for c in range(columns)] for r in range(rows)]


def _opened(matrix: Expr) -> Expr:
    """A definition's formula in the place of its name, where the formula has structure."""
    while matrix.op == "deferred" and isinstance(matrix.args[0], Named):
        body = matrix.args[0].body
        if body.op not in ("kron", "diagonal", "deferred") and _congruence(body) is None:
            break
        matrix = body
    return matrix
