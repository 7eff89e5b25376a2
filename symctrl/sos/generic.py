"""Exact identities where weights, equations or bases of polynomials are involved.

All Gram matrices and multiples are rounded; what is left of the identity is small. Blocks of monomials with
weight one take it up entry by entry, after exact multiples of what is zero have removed the monomials that
these blocks do not make. Without such blocks an exact linear system distributes it.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm
from typing import Any

import numpy as np
from flint import fmpq, fmpq_mat, nmod_mat

from symctrl.sos.programme import Block, Programme
from symctrl.sos.proof import Part, part
from symctrl.sos.ring import Monomial, Poly, denominator, terms, to_fmpq, to_fraction
from symctrl.sos.rounding import bits_for, exponents_of, monomial_parts, scaled_integers

_PRIME = (1 << 61) - 1
_BITS = 40  # of rounded multiples
MAX_SYSTEM = 1200


class Rounding:
    """One attempt at an exact identity near float Gram matrices in the programme's bases."""

    def __init__(
        self, programme: Programme, hs: Sequence[Any], multiples: Sequence[float], more: int = 2
    ) -> None:
        self.programme = programme
        self.over = programme.target.context()
        self.hs = hs
        self.more = more
        self.cs = [Fraction(round(c * 2**_BITS), 2**_BITS) for c in multiples]
        self.parts: list[Part] = []
        self.grams: dict[int, list[list[Fraction]]] = {}

    def run(self) -> tuple[list[Part], list[Fraction]] | None:
        """(parts, coefficients of the multiples), or None."""
        blocks = self.programme.blocks
        plain = [k for k, block in enumerate(blocks) if block.monomials is not None]
        left = self.programme.target
        for k in range(len(blocks)):
            if k in plain:
                continue
            gram = _rational(self.hs[k], self.more)
            if gram is None:
                return None
            self.grams[k] = gram
        if not plain:
            return self._by_a_system()
        for k, gram in self.grams.items():
            found = _part(blocks[k], gram)
            if found is None:
                return None
            self.parts += found
            left = left - _value(blocks[k], gram)
        left = self._without_multiples(left)
        if left is None:
            return None
        bases = [blocks[k].monomials or [] for k in plain]
        parts = monomial_parts(left, bases, [self.hs[k] for k in plain], self.over)
        return None if parts is None else (self.parts + parts, self.cs)

    def _without_multiples(self, left: Poly) -> Poly | None:
        """What is left after the multiples, corrected so that the plain blocks make all its monomials."""
        multiples = [product for _, _, product in self.programme.multiples]
        for c, product in zip(self.cs, multiples, strict=True):
            if c:
                left = left - product * to_fmpq(c)
        made = {
            tuple(a + b for a, b in zip(x, y, strict=True))
            for block in self.programme.blocks
            for x in block.monomials or []
            for y in block.monomials or []
        }
        table = terms(left)
        columns = [terms(product) for product in multiples]
        foreign = sorted({m for t in (table, *columns) for m in t if m not in made})
        wanted = [table.get(m, Fraction(0)) for m in foreign]
        if not any(wanted):
            return left
        solution = solve([[column.get(m, Fraction(0)) for column in columns] for m in foreign], wanted)
        if solution is None:
            return None
        for k, c in enumerate(solution):
            if c:
                self.cs[k] += c
                left = left - multiples[k] * to_fmpq(c)
        return left

    def _by_a_system(self) -> tuple[list[Part], list[Fraction]] | None:
        """Corrections of the Gram matrices and multiples from one exact linear system."""
        blocks = self.programme.blocks
        left = self.programme.target
        for k, gram in self.grams.items():
            left = left - _value(blocks[k], gram)
        products, places = [], []
        for k, block in enumerate(blocks):
            for i, a in enumerate(block.basis):
                for j in range(i + 1):
                    products.append(block.weight * a * block.basis[j] * (1 if i == j else 2))
                    places.append((k, i, j))
        for n, (_, _, product) in enumerate(self.programme.multiples):
            if self.cs[n]:
                left = left - product * to_fmpq(self.cs[n])
            products.append(product)
            places.append((-1, n, 0))
        if left != 0:
            changes = _fit(products, left)
            if changes is None:
                return None
            for (k, i, j), c in zip(places, changes, strict=True):
                if not c:
                    continue
                if k < 0:
                    self.cs[i] += c
                    continue
                self.grams[k][i][j] += c
                if i != j:
                    self.grams[k][j][i] += c
        parts = []
        for k, gram in self.grams.items():
            found = _part(blocks[k], gram)
            if found is None:
                return None
            parts += found
        return parts, self.cs


def _rational(h: Any, more: int) -> list[list[Fraction]] | None:
    """The matrix rounded so that it stays definite, with some bits more."""
    f = exponents_of(h)
    bits = bits_for(h, f)
    if bits is None or bits > 48:
        return None
    bits = min(bits + more, 50)
    found = scaled_integers(h, f, bits)
    return [
        [Fraction(a) * Fraction(2) ** (f[i] + f[j] - bits) for j, a in enumerate(row)]
        for i, row in enumerate(found)
    ]


def _part(block: Block, gram: list[list[Fraction]]) -> list[Part] | None:
    d = lcm(*(a.denominator for row in gram for a in row))
    rows = [[a.numerator * (d // a.denominator) for a in row] for row in gram]
    units = [denominator(b) for b in block.basis]
    if any(u != 1 for u in units):
        raise ValueError("a basis must have integer coefficients")
    return part(block.product, block.basis, rows, d)


def _value(block: Block, gram: list[list[Fraction]]) -> Poly:
    """weight * b' G b."""
    total = 0 * block.weight
    for i, a in enumerate(block.basis):
        inner = 0 * a
        for j in range(i + 1):
            if gram[i][j]:
                inner = inner + block.basis[j] * to_fmpq(gram[i][j] * (1 if i == j else 2))
        total = total + a * inner
    return total * block.weight


def _fit(products: Sequence[Poly], left: Poly) -> list[Fraction] | None:
    """Small coefficients with sum of c_k products_k = left: floats first, the rest exactly."""
    tables = [terms(p) for p in products]
    wanted = terms(left)
    monomials: list[Monomial] = sorted({m for t in (wanted, *tables) for m in t})
    if len(monomials) > MAX_SYSTEM:
        return None
    place = {m: k for k, m in enumerate(monomials)}
    matrix = np.zeros((len(monomials), len(tables)))
    for k, t in enumerate(tables):
        for m, c in t.items():
            matrix[place[m], k] = float(c)
    target = np.array([float(wanted.get(m, Fraction(0))) for m in monomials])
    guess = np.linalg.lstsq(matrix, target, rcond=1e-12)[0]
    size = max(float(np.abs(guess).max()), 1e-300)
    unit = Fraction(2) ** (int(np.log2(size)) - 40)
    first = [round(Fraction(float(g)) / unit) * unit for g in guess]
    rest = [wanted.get(m, Fraction(0)) for m in monomials]
    for c, t in zip(first, tables, strict=True):
        if c:
            for m, a in t.items():
                rest[place[m]] -= c * a
    second = solve([[t.get(m, Fraction(0)) for t in tables] for m in monomials], rest)
    if second is None:
        return None
    return [a + b for a, b in zip(first, second, strict=True)]


def solve(rows: Sequence[Sequence[Fraction]], right: Sequence[Fraction]) -> list[Fraction] | None:
    """A solution with few entries that are not zero; pivots are found modulo a prime. None: no solution."""
    if not any(right):
        return [Fraction(0)] * len(rows[0])
    if not rows[0]:
        return None
    scaled = []
    for row, b in zip(rows, right, strict=True):
        d = lcm(b.denominator, *(a.denominator for a in row))
        scaled.append([int(a * d) for a in (*row, b)])
    width = len(rows[0])
    reduced, rank = nmod_mat(
        len(scaled), width + 1, [a % _PRIME for row in scaled for a in row], _PRIME
    ).rref()
    pivots = _pivots(reduced, rank)
    if width in pivots:
        return None
    columns = pivots
    transposed = [[row[c] for row in scaled] for c in columns]
    again, _ = nmod_mat(
        len(columns), len(scaled), [a % _PRIME for row in transposed for a in row], _PRIME
    ).rref()
    kept = _pivots(again, rank)
    square = fmpq_mat(rank, rank, [fmpq(scaled[r][c]) for r in kept for c in columns])
    try:
        found = square.solve(fmpq_mat(rank, 1, [fmpq(scaled[r][width]) for r in kept]), algorithm="dixon")
    except (ZeroDivisionError, ValueError):
        return None
    result = [Fraction(0)] * width
    for k, c in enumerate(columns):
        result[c] = to_fraction(found[k, 0])
    for integers in scaled:
        total = sum((a * result[c] for c, a in enumerate(integers[:-1]) if a and result[c]), Fraction(0))
        if total != integers[-1]:
            return None
    return result


def _pivots(reduced: Any, rank: int) -> list[int]:
    pivots = []
    column = 0
    for r in range(rank):
        while int(reduced[r, column]) == 0:
            column += 1
        pivots.append(column)
        column += 1
    return pivots
