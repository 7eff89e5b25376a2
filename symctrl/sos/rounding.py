"""From a Gram matrix of floats to an exact identity: round, then put what is left on the Gram matrix itself.

Peyrl and Parrilo (Computing sum of squares decompositions with rational coefficients, TCS 409, 2008): where
the float matrix is well inside the cone, the nearest rational solution is inside too. In a basis of monomials
no linear system is needed: what is left of each monomial is spread over the entries that make it.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import frexp, lcm
from operator import add
from typing import Any

import numpy as np

from symctrl.sos.proof import Part, part
from symctrl.sos.ring import Monomial, Poly, Ring, monomial, terms

Entry = tuple[int, int, int]  # block, row, column


def exponents_of(h: Any) -> list[int]:
    """f with H_ii about 4^f: by 2^-f rows and columns have a unit diagonal."""
    return [round(frexp(max(float(d), 1e-200))[1] / 2) for d in np.diag(h)]


def scaled_integers(h: Any, f: Sequence[int], bits: int) -> list[list[int]]:
    """2^bits h_ij / 2^(f_i + f_j), rounded."""
    unit = np.ldexp(1.0, -np.array(f))
    scaled = h * unit[:, None] * unit[None, :]
    rounded: list[list[int]] = np.rint(np.ldexp(scaled, bits)).astype(np.int64).tolist()
    return rounded


def bits_for(h: Any, f: Sequence[int]) -> int | None:
    """Bits that keep a matrix definite when it is rounded; None where it is not definite in floats."""
    unit = np.ldexp(1.0, -np.array(f))
    try:
        least = float(np.linalg.eigvalsh(h * unit[:, None] * unit[None, :])[0])
    except np.linalg.LinAlgError:
        return None
    if not least > 1e-14:
        return None
    return max(2, 3 - frexp(least / len(h))[1])


def monomial_parts(
    target: Poly, bases: Sequence[Sequence[Monomial]], hs: Sequence[Any], over: Ring
) -> list[Part] | None:
    """Parts with exactly the sum `target`, near the floats hs; None where there are none near enough.

    The basis polynomials are monomials times powers of two, which balance the matrices.
    """
    fs = [exponents_of(h) for h in hs]
    needs = [bits_for(h, f) for h, f in zip(hs, fs, strict=True)]
    if any(bits is None or bits > 45 for bits in needs):
        return None
    wanted = terms(target)
    unit = lcm(*(c.denominator for c in wanted.values()))
    places: dict[Monomial, list[Entry]] = {}
    for b, basis in enumerate(bases):
        for i, m in enumerate(basis):
            for j in range(i + 1):
                places.setdefault(tuple(map(add, m, basis[j])), []).append((b, i, j))
    if any(m not in places for m in wanted):
        return None
    # d p = sum of G_ij 2^(e_i + e_j) m_i m_j with e = f - low, d = unit 2^(bits - 2 low), G = 2^bits unit H.
    low = min(min(f) for f in fs)
    need = max(min(fs[b][i] + fs[b][j] for b, i, j in entries) + 1 for entries in places.values())
    bits = max(*(bits or 0 for bits in needs), need, 2 * low)
    if bits > 900:
        return None
    rounded = min(bits, 50)
    found = [scaled_integers(h, f, rounded) for h, f in zip(hs, fs, strict=True)]
    gram = [[[(a << (bits - rounded)) * unit for a in row] for row in g] for g in found]
    d = unit << (bits - 2 * low)
    for m, entries in places.items():
        total = sum(gram[b][i][j] << (fs[b][i] + fs[b][j] - 2 * low + (i != j)) for b, i, j in entries)
        c = wanted.get(m, Fraction(0))
        left = c.numerator * (d // c.denominator) - total
        if left and not _spread(gram, left, entries, fs, low):
            return None
    result: list[Part] = []
    for basis, g, f in zip(bases, gram, fs, strict=True):
        polys = [monomial(over, m, 1 << (e - low)) for m, e in zip(basis, f, strict=True)]
        parts = part((), polys, g, d)
        if parts is None:
            return None
        result += parts
    return result


def _spread(gram: list[Any], left: int, entries: list[Entry], fs: list[list[int]], low: int) -> bool:
    """Adds what is left of a monomial to the entries that make it, in shares; False where it does not go."""
    shifts = [fs[b][i] + fs[b][j] - 2 * low + (i != j) for b, i, j in entries]
    order = sorted(zip(shifts, entries, strict=True), reverse=True)
    for k, (shift, (b, i, j)) in enumerate(order):
        unit = 1 << shift
        # The last one has the smallest unit, and takes all that is left.
        share, rest = divmod(left, unit * (len(entries) - k))
        if k == len(entries) - 1 and rest:
            return False
        gram[b][i][j] += share
        if i != j:
            gram[b][j][i] += share
        left -= share * unit
    return left == 0
