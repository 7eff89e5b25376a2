"""Proofs as values, and their JSON; a Gram matrix of integers gets the factor that shows it semidefinite."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import ceil, gcd, lcm, log2
from typing import Any

import numpy as np

from symctrl.decide.ldl import factor
from symctrl.sos.ring import Poly, denominator, integer_terms, rational_terms, to_fmpq

Rows = list[list[int]]


@dataclass(frozen=True)
class Part:
    """A product of constraints times b' G b / d: `basis` b over Z; of G and of L the rows to the diagonal."""

    product: tuple[int, ...]
    basis: tuple[Poly, ...]
    gram: Rows
    denominator: int
    lower: Rows
    scale: int

    def as_json(self) -> dict[str, Any]:
        return {
            "product": list(self.product),
            "basis": [integer_terms(b) for b in self.basis],
            "gram": self.gram,
            "denominator": self.denominator,
            "lower": self.lower,
            "scale": self.scale,
        }


@dataclass(frozen=True)
class Proof:
    """(constant + the multiplier's parts) p = margin + the parts + the multiples times what is zero."""

    parts: tuple[Part, ...]
    multiples: tuple[Poly, ...] = ()
    constant: Fraction = Fraction(1)
    multiplier: tuple[Part, ...] = ()
    margin: Fraction = Fraction(0)

    def as_json(self, empty: bool = False) -> dict[str, Any]:
        """empty: the left side is zero, so that the set is shown to be empty."""
        body: dict[str, Any] = {
            "margin": str(self.margin),
            "parts": [part.as_json() for part in self.parts],
            "multiples": [rational_terms(c) for c in self.multiples],
        }
        if empty:
            return {"kind": "empty", **body}
        multiplier = {
            "constant": str(self.constant),
            "parts": [part.as_json() for part in self.multiplier],
        }
        return {"kind": "squares", "multiplier": multiplier, **body}


def square(p: Poly, factor_: Fraction = Fraction(1), product: tuple[int, ...] = ()) -> Part:
    """factor p^2, with factor >= 0."""
    d = denominator(p)
    value = factor_ / d**2
    return Part(product, (p * d,), [[value.numerator]], value.denominator, [[0]], 1)


def times_square(proof: Proof, s: Poly) -> Proof:
    """Of p, without constraints and with the multiplier 1: the proof of p s^2."""
    d = denominator(s)
    parts = [
        replace(p, basis=tuple(b * (s * d) for b in p.basis), denominator=p.denominator * d**2)
        for p in proof.parts
    ]
    if proof.margin:
        parts.append(square(s, proof.margin))
    return replace(proof, parts=tuple(parts), margin=Fraction(0))


def part(
    product: tuple[int, ...], basis: Sequence[Poly], gram: Sequence[Sequence[int]], d: int
) -> list[Part] | None:
    """Parts with the sum product * b' gram b / d; None where the gram is not shown to be semidefinite."""
    content = gcd(d, *(a for row in gram for a in row))
    rows = [[a // content for a in row[: i + 1]] for i, row in enumerate(gram)]
    kept = [i for i, row in enumerate(rows) if row[i]]
    if len(kept) < len(rows):
        if any(rows[max(i, j)][min(i, j)] for i in range(len(rows)) if i not in kept for j in range(i)):
            return None
        if not kept:
            return []
        inner = [[gram[i][j] if j <= i else gram[j][i] for j in kept] for i in kept]
        return part(product, [basis[i] for i in kept], inner, d)
    lower = _lower(rows)
    if lower is not None:
        return [Part(product, tuple(basis), rows, d // content, *lower)]
    return _diagonal(product, basis, rows, d // content)


def _lower(rows: Rows) -> tuple[Rows, int] | None:
    """(L, t) with t G - L L' dominant: L is a rounded Cholesky factor of G less half its least eigenvalue."""
    n = len(rows)
    if _dominant(rows, [[0] * (i + 1) for i in range(n)], 1):
        return [[0] * (i + 1) for i in range(n)], 1
    if n == 1:
        return None
    shift = max(row[-1] for row in rows).bit_length()
    floats = np.array([[_ldexp(rows[max(i, j)][min(i, j)], -shift) for j in range(n)] for i in range(n)])
    least = float(np.linalg.eigvalsh(floats)[0])
    if least <= 1e-13:
        return None
    try:
        cholesky = np.linalg.cholesky(floats - least / 2 * np.eye(n))
    except np.linalg.LinAlgError:
        return None
    first = max(3, ceil(log2(n / least) / 1) + 1)
    for bits in (first - 3, first, first + 6):
        if bits < 50:
            more = max(0, (shift + 1) // 2 - bits)
            rounded = np.rint(np.ldexp(cholesky, bits)).astype(np.int64).tolist()
            lower = [[a << more for a in row[: i + 1]] for i, row in enumerate(rounded)]
            scale = 1 << (2 * (bits + more) - shift)
            if _dominant(rows, lower, scale):
                return lower, scale
    return None


def _ldexp(a: int, shift: int) -> float:
    """2^shift a, of an integer of any size."""
    return a / (1 << -shift) if shift < 0 else float(a << shift)


def _dominant(rows: Rows, lower: Rows, scale: int) -> bool:
    n = len(rows)
    big = max(max(map(abs, row)) for row in lower) ** 2 * n >= 2**62
    factor_ = np.zeros((n, n), dtype=object if big else np.int64)
    for i, row in enumerate(lower):
        factor_[i, : i + 1] = row
    product = (factor_ @ factor_.T).tolist() if any(map(any, lower)) else [[0] * n] * n
    slack = [0] * n
    for i, row in enumerate(rows):
        for j, a in enumerate(row):
            r = scale * a - product[i][j]
            if i == j:
                slack[i] += r
            else:
                slack[i] -= abs(r)
                slack[j] -= abs(r)
    return min(slack) >= 0


def _diagonal(product: tuple[int, ...], basis: Sequence[Poly], rows: Rows, d: int) -> list[Part] | None:
    """By exact factors G = L D L': squares of the polynomials L' b, where D >= 0."""
    n = len(rows)
    found = factor([[rows[max(i, j)][min(i, j)] for j in range(n)] for i in range(n)], d)
    if isinstance(found, list):
        return None
    parts = []
    for k, pivot in enumerate(found.diagonal):
        if pivot:
            column = [Fraction(1) if i == k else found.lower[i][k] for i in range(k, n)]
            unit = lcm(*(c.denominator for c in column))
            poly = sum((b * to_fmpq(c * unit) for b, c in zip(basis[k:], column, strict=True)), 0 * basis[0])
            parts.append(square(poly, pivot / unit**2, product))
    return parts
