"""Definiteness of a claim's matrix, leaf by leaf of its tree: exact numbers, or leading principal minors in
symbols.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from symctrl.decide.affine import by_rows, by_sum, lowest
from symctrl.decide.attempt import Attempt
from symctrl.decide.combination import terms_of
from symctrl.decide.definiteness import decide_matrix
from symctrl.decide.direction import null_vector
from symctrl.decide.place import evaluation
from symctrl.decide.points import points
from symctrl.decide.session import Session, exactly
from symctrl.decide.witness import Witness
from symctrl.domains.field import Exact
from symctrl.domains.fraction import FractionDomain, NoExactValue
from symctrl.domains.matrices import determinant_of
from symctrl.problem import Problem

TRIES = 60
MAX_MINORS = 6
Tree = dict[str, Any]


def attempt(problem: Problem) -> Attempt:
    """A proof or a witness of definiteness. Raises what the exact domain and the search for points raise."""
    strict = problem.claim.kind == "positive_definite"
    assert problem.claim.matrix is not None
    tree = dict(problem.claim.matrix)
    made = proof(problem)
    if made is not None:
        return Attempt(proof=made, reason=f"{_how(made['matrix'])}", method="exact definiteness")
    small = problem.claim.small
    found = None if small else _refuted(problem, tree, strict)
    if found is not None:
        return Attempt(witness=found)
    tried = f"no one value of {small} would refute it" if small else f"none of {TRIES} points refutes it"
    return Attempt(reason=f"no certificate was found, and {tried}", method="exact definiteness")


def proof(problem: Problem) -> dict[str, Any] | None:
    """A proof of definiteness; None if there is none. Raises Unsupported."""
    assert problem.claim.matrix is not None
    tree, strict = dict(problem.claim.matrix), problem.claim.kind == "positive_definite"
    return exactly(problem, lambda session: _proof(session, tree, strict, problem.claim.small))


def _proof(session: Session, tree: Tree, strict: bool, small: str | None) -> dict[str, Any] | None:
    outputs = session.claim()
    matrix = _prove(session, outputs, tree, strict, small)
    return None if matrix is None else session.proof("definite", matrix=matrix)


def _prove(session: Session, outputs: Sequence[Exact], tree: Tree, strict: bool, small: str | None) -> Any:
    if "kron_identity" in tree:
        part = _prove(session, outputs, tree["kron_identity"], strict, small)
        return None if part is None else {"kron_identity": part, "size": tree["size"]}
    if "blocks" in tree:
        parts = [_prove(session, outputs, block, strict, small) for block in tree["blocks"]]
        return None if None in parts else {"blocks": parts}
    if "congruence" in tree:
        return _prove_congruence(session, outputs, tree, strict, small)
    rows = [[outputs[k] for k in row] for row in tree["entries"]]
    numbers = [[session.domain.rational(v) for v in row] for row in rows]
    if all(n is not None for row in numbers for n in row):
        answer = decide_matrix([[n for n in row if n is not None] for row in numbers])
        wanted = ("positive definite",) if strict else ("positive definite", "positive semidefinite")
        return answer.leaf if answer.definiteness in wanted else None
    leaf = _assumed(session, rows, strict)
    leaf = by_rows(session, rows, small) if leaf is None else leaf
    leaf = _by_minors(session, rows, small) if leaf is None else leaf
    return by_sum(session, rows, strict) if leaf is None else leaf


def _prove_congruence(
    session: Session, outputs: Sequence[Exact], tree: Tree, strict: bool, small: str | None
) -> Any:
    """CᵀPC is semidefinite with P, and definite if C is invertible too."""
    factor = [[outputs[k] for k in row] for row in tree["factor"]]
    if strict:
        if len(factor) != len(factor[0]):
            return None
        session.domain.inv_(determinant_of(session.domain, factor))
    middle = _prove(session, outputs, tree["congruence"], strict, small)
    return None if middle is None else {"congruence": middle}


def _assumed(session: Session, rows: list[list[Exact]], strict: bool) -> Any:
    """The leaf is a matrix that is assumed to be definite."""
    n = len(rows)
    domain = session.domain
    for k, assumption in enumerate(session.problem.given):
        kinds = ("positive_definite",) if strict else ("positive_definite", "positive_semidefinite")
        if assumption.kind not in kinds or assumption.size != n:
            continue
        values = [session.at(of, {"i": "i", "j": "j"}) for of in assumption.of]
        if all(
            domain.is_zero(domain.sub_(rows[r][c], values[r + n * c])) for r in range(n) for c in range(n)
        ):
            return {"given": k}
    return None


def _by_minors(session: Session, rows: list[list[Exact]], small: str | None) -> Any:
    domain, n = session.domain, len(rows)
    if n > MAX_MINORS or any(
        not domain.is_zero(domain.sub_(rows[r][c], rows[c][r])) for r in range(n) for c in range(r)
    ):
        return None
    minors = []
    for k in range(1, n + 1):
        minor = determinant_of(domain, [row[:k] for row in rows[:k]])
        if small is not None:
            minor = lowest(session, minor, small)
        terms = terms_of(session, minor, True)
        if terms is None:
            return None
        minors.append({"terms": terms})
    return {"minors": minors}


def _refuted(problem: Problem, tree: Tree, strict: bool) -> Witness | None:
    for tried, place in enumerate(points(problem), start=1):
        try:
            outputs = evaluation(problem, place, FractionDomain()).outputs(
                problem.claim.listing, place.binding
            )
            x = _against(tree, outputs, strict)
        except (NoExactValue, ZeroDivisionError):
            x = None
        if x is not None:
            return Witness(
                place,
                0,
                tuple(x),
                "x'Ax < 0 for the vector x" if not strict else "x'Ax <= 0 for the vector x",
            )
        if tried >= TRIES or not place.values:
            return None
    return None


def _against(tree: Tree, outputs: Sequence[Fraction], strict: bool) -> list[Fraction] | None:
    """A vector against the definiteness of the tree's matrix at numbers."""
    if "kron_identity" in tree:
        x = _against(tree["kron_identity"], outputs, strict)
        return None if x is None else [e if k == 0 else Fraction(0) for e in x for k in range(tree["size"])]
    if "blocks" in tree:
        sizes = [size_of(block) for block in tree["blocks"]]
        for n, block in enumerate(tree["blocks"]):
            x = _against(block, outputs, strict)
            if x is not None:
                return [Fraction(0)] * sum(sizes[:n]) + x + [Fraction(0)] * sum(sizes[n + 1 :])
        return None
    rows = _numbers(tree, outputs)
    if any(rows[r][c] != rows[c][r] for r in range(len(rows)) for c in range(r)):
        return None
    answer = decide_matrix(rows)
    if answer.witness is not None:
        return list(answer.witness)
    return null_vector(rows) if strict and answer.definiteness == "positive semidefinite" else None


def _numbers(tree: Tree, outputs: Sequence[Fraction]) -> list[list[Fraction]]:
    """The whole matrix of a tree."""
    if "congruence" in tree:
        middle = _numbers(tree["congruence"], outputs)
        c = [[outputs[k] for k in row] for row in tree["factor"]]
        return _product(_product([list(column) for column in zip(*c, strict=True)], middle), c)
    if "entries" in tree:
        return [[outputs[k] for k in row] for row in tree["entries"]]
    if "kron_identity" in tree:
        n, size = size_of(tree), tree["size"]
        inner = _numbers(tree["kron_identity"], outputs)
        return [
            [inner[r // size][c // size] if r % size == c % size else Fraction(0) for c in range(n)]
            for r in range(n)
        ]
    parts = [_numbers(block, outputs) for block in tree["blocks"]]
    rows, before = [], 0
    for part in parts:
        after = size_of(tree) - before - len(part)
        rows += [[Fraction(0)] * before + row + [Fraction(0)] * after for row in part]
        before += len(part)
    return rows


def _product(a: list[list[Fraction]], b: list[list[Fraction]]) -> list[list[Fraction]]:
    return [
        [
            sum((x * y for x, y in zip(row, column, strict=True)), Fraction(0))
            for column in zip(*b, strict=True)
        ]
        for row in a
    ]


def size_of(tree: Tree) -> int:
    """The number of rows of a tree's matrix."""
    if "kron_identity" in tree:
        return int(tree["size"]) * size_of(tree["kron_identity"])
    if "blocks" in tree:
        return sum(size_of(block) for block in tree["blocks"])
    return len(tree["factor"][0]) if "congruence" in tree else len(tree["entries"])


def _how(leaf: Any) -> str:
    for key, words in (
        ("ldl", "A = L D L' exactly"),
        ("dominant", "A - L L' is diagonally dominant"),
        ("minors", "all leading principal minors are positive"),
        ("rows", "diagonally dominant"),
        ("sum", "a sum of nonnegative multiples of semidefinite matrices"),
        ("given", "assumed"),
    ):
        if key in leaf:
            return words
    if "blocks" in leaf:
        return "block by block: " + ", ".join(dict.fromkeys(_how(part) for part in leaf["blocks"]))
    inner = leaf.get("kron_identity") or leaf["congruence"]
    return ("of C'PC: " if "congruence" in leaf else "") + _how(inner)
