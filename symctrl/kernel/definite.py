"""A symmetric matrix is positive definite or semidefinite.

Soundness-critical. Last reviewed 2026-11-24.

Theorems: A (x) I and block diagonal matrices have the definiteness of their parts; C'PC is semidefinite
with P, and definite if C is invertible too. A = L D L' and dominance of A - L L' are in `matrices`.
Sylvester: a symmetric A all of whose leading principal minors are positive is definite. Gershgorin: so is
one whose diagonal entries exceed the sums of the absolute values beside them. A sum of g P with g >= 0 and
semidefinite P is semidefinite (Horn and Johnson, Matrix Analysis, 7.1, 7.2, 6.1). A claim about all small
positive values of a gain, each smaller than a bound that depends on the other parameters: a polynomial in
the gain has the sign of its lowest coefficient there.

The `matrix` of a proof is the claim's tree with a leaf proof in the place of each block of entries. Rows of
`lower` go up to the diagonal.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from symctrl.kernel.certificate import (
    Declined,
    Invalid,
    fields,
    natural,
    rational,
    several,
    split_name,
    typed,
)
from symctrl.kernel.combination import prove_sign
from symctrl.kernel.conditions import SIGNS, determinant
from symctrl.kernel.field import Field, Value
from symctrl.kernel.matrices import Rows, has_factors, is_dominant
from symctrl.kernel.polynomial import monomial, powers, tidy, variables
from symctrl.kernel.replay import Replay
from symctrl.kernel.sums import SumIdentity, opened
from symctrl.kernel.values import Condition, Statement

MAX_MINORS = 6
Matrix = list[list[Value]]


def needed_conditions(statement: Statement, proof: dict[str, Any]) -> set[Condition]:
    """The conditions under which the proof shows the claim. Raises Invalid or Declined where it does not."""
    claim = statement.claim
    test, outputs = opened(statement, proof, ("positive_definite", "positive_semidefinite"), "matrix")
    replay = test.replay
    if claim.small is not None:
        _require_free_gain(replay, claim.small, outputs)
    _prove_tree(test, outputs, claim.matrix, proof["matrix"], claim.kind == "positive_definite")
    for condition, p in replay.signs.needed.items():
        gain = {replay.free[claim.small]} if claim.small is not None else set()
        if condition.kind != "nonzero" and gain & replay.behind(variables(p)):
            raise Declined(f"a condition bounds {claim.small}: {condition.kind} {condition.of[:200]}")
    return replay.close()


def _prove_tree(test: SumIdentity, outputs: Sequence[Value], tree: Any, proof: Any, strict: bool) -> None:
    if "kron_identity" in tree:
        table = fields(proof, ("kron_identity", "size"), "matrix")
        if table["size"] != tree["size"]:
            raise Invalid(f"the proof is for {str(table['size'])[:20]} copies, the claim for {tree['size']}")
        _prove_tree(test, outputs, tree["kron_identity"], table["kron_identity"], strict)
    elif "blocks" in tree:
        parts = several(fields(proof, ("blocks",), "matrix")["blocks"], len(tree["blocks"]), "blocks")
        for block, part in zip(tree["blocks"], parts, strict=True):
            _prove_tree(test, outputs, block, part, strict)
    elif "congruence" in tree:
        factor = [[outputs[k] for k in row] for row in tree["factor"]]
        if strict:
            _require_invertible(test.replay, factor)
        inner = fields(proof, ("congruence",), "matrix")["congruence"]
        _prove_tree(test, outputs, tree["congruence"], inner, strict)
    else:
        matrix = [[outputs[k] for k in row] for row in tree["entries"]]
        _prove_entries(test, matrix, typed(proof, dict, "matrix"), strict)


def _require_invertible(replay: Replay, factor: Matrix) -> None:
    if len(factor) != len(factor[0]):
        raise Invalid("C'PC is definite for an invertible C, and this one is not square")
    if len(factor) > MAX_MINORS:
        raise Declined(f"a determinant of more than {MAX_MINORS} rows")
    replay.inv(determinant(replay.field, factor))


def _prove_entries(test: SumIdentity, matrix: Matrix, leaf: Mapping[str, Any], strict: bool) -> None:
    if leaf.keys() == {"minors"}:
        _by_minors(test, matrix, leaf["minors"])
    elif leaf.keys() == {"rows"}:
        _by_rows(test, matrix, leaf["rows"])
    elif leaf.keys() == {"given"}:
        _by_sum(test, matrix, [{"of": [["1"]], "given": leaf["given"]}], strict)
    elif leaf.keys() == {"sum"}:
        _by_sum(test, matrix, leaf["sum"], strict)
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
        raise Invalid("a leaf proof is one of ldl, dominant, minors, rows, given and sum")


def _triangle(value: Any, n: int) -> list[list[Fraction]]:
    rows = several(value, n, "lower")
    return [_numbers(row, k + 1, f"row {k + 1} of lower") for k, row in enumerate(rows)]


def _numbers(value: Any, n: int, where: str) -> list[Fraction]:
    return [rational(entry, where) for entry in several(value, n, where)]


def _by_minors(test: SumIdentity, matrix: Matrix, proofs: Any) -> None:
    if len(matrix) > MAX_MINORS:
        raise Declined(f"minors of more than {MAX_MINORS} rows")
    sizes = range(1, len(matrix) + 1)
    minors = [determinant(test.replay.field, [row[:k] for row in matrix[:k]]) for k in sizes]
    _prove_positive(test, matrix, minors, proofs, "minor")


def _by_rows(test: SumIdentity, matrix: Matrix, proofs: Any) -> None:
    """In each row the diagonal entry exceeds the sum of the others in magnitude, whose signs are known."""
    replay, margins = test.replay, []
    for r, row in enumerate(matrix):
        left = row[r]
        for c, entry in enumerate(row):
            if c != r and entry:
                signs = replay.signs.of_value(entry)
                if not (signs <= SIGNS["nonnegative"] or signs <= {-1, 0}):
                    raise Invalid(f"the sign of the entry in row {r + 1}, column {c + 1} is not known")
                left = replay.field.sub(left, entry) if 1 in signs else replay.field.add(left, entry)
        margins.append(left)
    _prove_positive(test, matrix, margins, proofs, "row")


def _prove_positive(test: SumIdentity, matrix: Matrix, values: list[Value], proofs: Any, what: str) -> None:
    """The matrix is symmetric, and each of the values that decide about it is positive."""
    for i, row in enumerate(matrix):
        for j in range(i):
            where = f"symmetry in row {i + 1}, column {j + 1}"
            test.require_zero(test.replay.field.sub(row[j], matrix[j][i]), where)
    for k, (value, proof) in enumerate(
        zip(values, several(proofs, len(values), f"{what}s"), strict=True), start=1
    ):
        prove_sign(test, _lowest(test.replay, value), proof, strict=True, where=f"{what} {k}")


def _lowest(replay: Replay, value: Value) -> Value:
    """For a claim about small values of a gain, the coefficient of its lowest power: it decides the sign."""
    small = replay.statement.claim.small
    if small is None:
        return value
    p = replay.field.normal(replay.signs.carrier(value))
    gain = replay.free[small]
    if any(k != gain and replay.reaches(k, {gain}) for k in variables(p)):
        raise Declined(f"{small} occurs inside a root or another function")
    least = min((dict(powers(m)).get(gain, 0) for m in p), default=0)
    lowest = {m - monomial([(gain, least)]): c for m, c in p.items() if dict(powers(m)).get(gain, 0) == least}
    return {(): lowest} if lowest else {}


def _require_free_gain(replay: Replay, small: str, outputs: Sequence[Value]) -> None:
    """How small a gain must be depends on the other parameters, so these must not depend on it in turn.

    Nothing that is given ties the gain to others, and the matrix reads nothing that moves.
    """
    gain = replay.free[small]
    for assumption, entries in zip(replay.statement.given, replay.given, strict=True):
        sign_of_gain = entries == [replay.field.generator(gain)] and assumption.kind != "zero"
        if not sign_of_gain and gain in _behind(replay, entries):
            raise Declined(f"what is given about {small} restricts how small it can be")
    for k in _behind(replay, outputs):
        g = replay.table[k]
        if g.kind == "free" and replay.statement.scalars.get(split_name(g.name)[0]) != "parameter":
            raise Declined(f"how small {small} must be would depend on {g.name}, which is no parameter")


def _behind(replay: Replay, values: Sequence[Value]) -> set[int]:
    factors = {f for value in values for key in value for f, _ in key}
    polynomials = [p for value in values for p in value.values()] + [replay.field.factors[f] for f in factors]
    return replay.behind(set().union(*map(variables, polynomials)))


def _by_sum(test: SumIdentity, matrix: Matrix, parts: Any, strict: bool) -> None:
    """A = sum of g P, g >= 0, P rational or assumed; definite where for one g > 0 and P is definite."""
    replay, n = test.replay, len(matrix)
    field, left, definite = replay.field, [list(row) for row in matrix], False
    for part in typed(parts, list, "sum"):
        rest = ("given",) if "given" in typed(part, dict, "sum") else ("rows", "proof")
        fields(part, ("of", *rest), "sum")
        g = replay.poly(part["of"], "sum")
        signs = replay.signs.of_learned(g)
        if not signs <= SIGNS["nonnegative"]:
            raise Invalid(f"{replay.signs.printer.poly(g)[:200]} is not known to be nonnegative")
        wanted = strict and not definite and signs == SIGNS["positive"]
        assumed = "given" in part
        added, sure = _assumed(replay, part["given"], n) if assumed else _rational(part, n, wanted, field)
        definite = definite or (sure and wanted)
        for row, more in zip(left, added, strict=True):
            row[:] = [field.sub(a, field.mul({(): g}, b)) for a, b in zip(row, more, strict=True)]
    for r, row in enumerate(left):
        for c, entry in enumerate(row):
            test.require_zero(entry, f"the sum in row {r + 1}, column {c + 1}")
    if strict and not definite:
        raise Invalid("no part of the sum is certainly definite")


def _assumed(replay: Replay, k: Any, n: int) -> tuple[Matrix, bool]:
    """An assumed matrix; is it assumed definite, not only semidefinite?"""
    assumption = replay.statement.given[natural(k, len(replay.given), "given")]
    if not assumption.kind.startswith("positive_") or assumption.size != n:
        raise Invalid(f"assumption {k} says {assumption.kind} of {assumption.size} rows, not what is claimed")
    return [replay.given[k][r::n] for r in range(n)], assumption.kind == "positive_definite"


def _rational(part: dict[str, Any], n: int, strictly: bool, field: Field) -> tuple[Matrix, bool]:
    """A matrix of numbers that is shown semidefinite; is it shown definite, where that is of use?"""
    rows = [_numbers(row, n, "rows") for row in several(part["rows"], n, "rows")]
    sure = _proves(rows, part["proof"], strictly)
    return [[field.constant(tidy(entry)) for entry in row] for row in rows], sure


def _proves(rows: Rows, leaf: Any, strictly: bool) -> bool:
    """Is the part shown definite? Raises Invalid where it is not even shown semidefinite."""
    leaf = typed(leaf, dict, "proof")
    if strictly:
        try:
            prove_leaf(rows, leaf, True)
            return True
        except Invalid:
            pass
    prove_leaf(rows, leaf, False)
    return False
