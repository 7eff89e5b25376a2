"""The structure of a matrix as it is written: what `lowered` reads off gives back the matrix."""

from fractions import Fraction

import pytest

from symctrl import Study
from symctrl.expr import lift
from symctrl.structure import lowered
from symctrl.vectors import diagonal, eye, kron

A = lift([["2", "1/3"], ["1/3", "5"]])
B = lift([[7]])
C = lift([["1", "2", "-1"], ["0", "1", "4"]])


def rows(tree, parts):
    """The matrix that a tree of numbers stands for."""
    entries = [entry for part in parts for entry in part.entries]
    if "entries" in tree:
        return [[entries[k] for k in row] for row in tree["entries"]]
    if "kron_identity" in tree:
        inner, n = rows(tree["kron_identity"], parts), tree["size"]
        size = len(inner) * n
        return [[inner[r // n][c // n] * (r % n == c % n) for c in range(size)] for r in range(size)]
    if "blocks" in tree:
        blocks = [rows(block, parts) for block in tree["blocks"]]
        size, made, at = sum(map(len, blocks)), [], 0
        for block in blocks:
            made += [[Fraction(0)] * at + row + [Fraction(0)] * (size - at - len(block)) for row in block]
            at += len(block)
        return made
    middle, factor = rows(tree["congruence"], parts), [[entries[k] for k in row] for row in tree["factor"]]
    half = [
        [sum(m * f for m, f in zip(row, col, strict=True)) for col in zip(*factor, strict=True)]
        for row in middle
    ]
    return [
        [sum(f * h for f, h in zip(left, right, strict=True)) for right in zip(*half, strict=True)]
        for left in zip(*factor, strict=True)
    ]


@pytest.mark.parametrize(
    ("matrix", "kind"),
    [
        (A, "entries"),
        (kron(A, eye(3)), "kron_identity"),
        (diagonal(A, B), "blocks"),
        (C.T @ A @ C, "congruence"),
        (diagonal(kron(A, eye(2)), C.T @ A @ C), "blocks"),
        (kron(diagonal(A, B), eye(2)), "kron_identity"),
        (kron(eye(2), A), "entries"),
        (A @ A @ A, "entries"),
    ],
)
def test_a_tree_stands_for_the_matrix(matrix, kind):
    tree, parts = lowered(matrix)
    assert kind in tree
    n = matrix.shape[0]
    assert rows(tree, parts) == [[matrix.entries[r + n * c] for c in range(n)] for r in range(n)]


def test_a_definition_is_opened_for_its_structure_only():
    study = Study("own")
    k = study.gain("k")

    @study.definition("1")
    def big():
        return kron(k * A, eye(3))

    @study.definition("2")
    def small():
        return k * A

    assert "kron_identity" in lowered(big())[0]
    assert lowered(small())[1][0].op == "deferred"
