"""A symmetric matrix is positive definite or semidefinite.

Soundness-critical. Last reviewed 2026-11-24.

Theorems: A (x) I and block diagonal matrices have the definiteness of their parts. A = L D L' and
dominance of A - L L' are in `matrices`. Sylvester: a symmetric A all of whose leading principal minors
are positive is definite. Congruence: A = sum of C'PC with assumed definite or semidefinite P is
semidefinite, since x'Ax is the sum of (Cx)'P(Cx); it is definite where no x but 0 has Cx = 0 for all C of
definite P, that is, where the sum of C'C over those is definite (Horn and Johnson, Matrix Analysis, 7.1,
7.2).

The `matrix` of a proof is the claim's tree with a leaf proof in the place of each block of entries. Rows
of `lower` go up to the diagonal. A congruence names a factor C by its rows of POLYs or numbers and P by
its assumption; of the factors of definite P the rational rows count.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from symctrl.kernel.certificate import (
    Condition,
    Declined,
    Invalid,
    Statement,
    fields,
    natural,
    rational,
    typed,
)
from symctrl.kernel.combination import prove_sign
from symctrl.kernel.conditions import determinant
from symctrl.kernel.field import Value
from symctrl.kernel.matrices import Rows, eliminate, has_factors, is_dominant
from symctrl.kernel.replay import Replay, require_conditions
from symctrl.kernel.sums import SumIdentity, SymbolSums

MAX_MINORS = 6
Matrix = list[list[Value]]


def verify(statement: Statement, proof: dict[str, Any]) -> None:
    """Raises Invalid or Declined unless the proof shows the claim under exactly the stated conditions."""
    require_conditions(statement, needed_conditions(statement, proof))


def needed_conditions(statement: Statement, proof: dict[str, Any]) -> set[Condition]:
    """The conditions under which the proof shows the claim, whatever the statement lists; see `verify`."""
    claim = statement.claim
    if claim.kind not in ("positive_definite", "positive_semidefinite"):
        raise Invalid(f"the proof is one of definiteness, not of the claim {claim.kind}")
    fields(proof, ("kind", "generators", "factors", "hints", "matrix"), "proof")
    sums = SymbolSums()
    replay = Replay(statement, proof, sums)
    replay.assume_given()
    outputs = replay.claim()
    test = SumIdentity(replay, sums)
    _prove_tree(test, outputs, claim.matrix, proof["matrix"], claim.kind == "positive_definite")
    return replay.close()


def _prove_tree(test: SumIdentity, outputs: Sequence[Value], tree: Any, proof: Any, strict: bool) -> None:
    if "kron_identity" in tree:
        table = fields(proof, ("kron_identity", "size"), "matrix")
        if table["size"] != tree["size"]:
            raise Invalid(f"the proof is for {str(table['size'])[:20]} copies, the claim for {tree['size']}")
        _prove_tree(test, outputs, tree["kron_identity"], table["kron_identity"], strict)
    elif "blocks" in tree:
        parts = typed(fields(proof, ("blocks",), "matrix")["blocks"], list, "blocks")
        if len(parts) != len(tree["blocks"]):
            raise Invalid(f"the proof has {len(parts)} blocks, the claim {len(tree['blocks'])}")
        for block, part in zip(tree["blocks"], parts, strict=True):
            _prove_tree(test, outputs, block, part, strict)
    else:
        matrix = [[outputs[k] for k in row] for row in tree["entries"]]
        _prove_entries(test, matrix, typed(proof, dict, "matrix"), strict)


def _prove_entries(test: SumIdentity, matrix: Matrix, leaf: Mapping[str, Any], strict: bool) -> None:
    if leaf.keys() == {"minors"}:
        _by_minors(test, matrix, leaf["minors"])
    elif leaf.keys() == {"congruence"}:
        _by_congruence(test, matrix, leaf["congruence"], strict)
    else:
        prove_leaf([[_number(test.replay, value) for value in row] for row in matrix], leaf, strict)


def _number(replay: Replay, value: Value) -> Fraction:
    number = replay.field.rational(value)
    if number is None:
        raise Invalid("an entry of the matrix is not a number, which this leaf proof needs")
    return number


def prove_leaf(rows: Rows, leaf: Mapping[str, Any], strict: bool) -> None:
    """Returns if a leaf proof `ldl` or `dominant` proves the rational matrix definite, or semidefinite unless
    `strict`. Raises Invalid, Declined."""
    n = len(rows)
    if leaf.keys() == {"ldl"}:
        table = fields(leaf["ldl"], ("lower", "diagonal"), "ldl")
        diagonal = _numbers(table["diagonal"], n, "diagonal")
        if not has_factors(rows, _triangle(table["lower"], n), diagonal):
            raise Invalid("the matrix is not L D L' with D >= 0 for the L and D of the proof")
        if strict and not all(diagonal):
            raise Invalid("the matrix is singular, so only semidefinite")
    elif leaf.keys() == {"dominant"}:
        table = fields(leaf["dominant"], ("lower", "scale"), "dominant")
        scale = _numbers(table["scale"], n, "scale")
        if not is_dominant(rows, _triangle(table["lower"], n), scale, strict):
            raise Invalid("the matrix less L L' is not diagonally dominant with the scale of the proof")
    else:
        raise Invalid("a leaf proof is one of ldl, dominant, minors and congruence")


def _triangle(value: Any, n: int) -> list[list[Fraction]]:
    rows = typed(value, list, "lower")
    if len(rows) != n:
        raise Invalid(f"lower has {len(rows)} rows, and the matrix {n}")
    return [_numbers(row, k + 1, f"row {k + 1} of lower") for k, row in enumerate(rows)]


def _numbers(value: Any, n: int, where: str) -> list[Fraction]:
    if len(typed(value, list, where)) != n:
        raise Invalid(f"{where} has {len(value)} numbers, and should have {n}")
    return [rational(entry, where) for entry in value]


def _by_minors(test: SumIdentity, matrix: Matrix, proofs: Any) -> None:
    field, n = test.replay.field, len(matrix)
    if len(typed(proofs, list, "minors")) != n:
        raise Invalid(f"the matrix has {n} leading principal minors, and the proof {len(proofs)}")
    if n > MAX_MINORS:
        raise Declined(f"minors of more than {MAX_MINORS} rows")
    for i in range(n):
        for j in range(i):
            where = f"symmetry in row {i + 1}, column {j + 1}"
            test.require_zero(field.sub(matrix[i][j], matrix[j][i]), where)
    for k, proof in enumerate(proofs, start=1):
        minor = determinant(field, [row[:k] for row in matrix[:k]])
        prove_sign(test, minor, proof, strict=True, where=f"minor {k}")


def _by_congruence(test: SumIdentity, matrix: Matrix, parts: Any, strict: bool) -> None:
    replay, n = test.replay, len(matrix)
    total: Matrix = [[{} for _ in range(n)] for _ in range(n)]
    gram = [[Fraction(0)] * n for _ in range(n)]
    for part in typed(parts, list, "congruence"):
        table = fields(part, ("factor", "given"), "congruence")
        k = natural(table["given"], len(replay.given), "given")
        assumption = replay.statement.given[k]
        if assumption.kind not in _CONES:
            raise Invalid(f"assumption {k} says {assumption.kind}, which gives no definite matrix")
        factor = _factor(replay, table["factor"], assumption.size, n)
        _add_product(replay, total, factor, replay.given[k])
        if assumption.kind in ("positive", "positive_definite"):
            _add_gram(replay, gram, factor)
    for i in range(n):
        for j in range(n):
            where = f"the sum of C'PC in row {i + 1}, column {j + 1}"
            test.require_zero(replay.field.sub(matrix[i][j], total[i][j]), where)
    if strict:
        found = eliminate(gram)
        if found is None or not found.definite:
            raise Invalid("the factors C of definite matrices do not have full rank together")


_CONES = ("positive", "nonnegative", "positive_definite", "positive_semidefinite")


def _factor(replay: Replay, value: Any, rows: int, columns: int) -> Matrix:
    table = typed(value, list, "factor")
    if len(table) != rows or any(len(typed(row, list, "factor")) != columns for row in table):
        raise Invalid(f"a factor must have {rows} rows and {columns} columns")
    return [[_entry(replay, entry) for entry in row] for row in table]


def _entry(replay: Replay, value: Any) -> Value:
    if type(value) is list:
        p = replay.poly(value, "factor")
        return {(): p} if p else {}
    return replay.constant(rational(value, "factor"))


def _add_product(replay: Replay, total: Matrix, c: Matrix, p: Sequence[Value]) -> None:
    """total += C'PC; P column by column."""
    field, m = replay.field, len(c)
    for i in range(len(total)):
        for k in range(m):
            if not c[k][i]:
                continue
            for l in range(m):  # noqa: E741
                left = field.mul(c[k][i], p[k + m * l])
                for j in range(len(total)):
                    total[i][j] = field.add(total[i][j], field.mul(left, c[l][j]))


def _add_gram(replay: Replay, gram: list[list[Fraction]], c: Matrix) -> None:
    """gram += the sum of r'r over the rows r of C that are rational, which is at most C'C."""
    for row in c:
        numbers = [number for number in map(replay.field.rational, row) if number is not None]
        if len(numbers) == len(row):
            for i, a in enumerate(numbers):
                for j, b in enumerate(numbers):
                    gram[i][j] += a * b
