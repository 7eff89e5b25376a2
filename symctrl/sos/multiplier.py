"""Nonnegative polynomials that are no sums of squares: s p may be one, with s a sum of squares itself.

Reznick (Uniform denominators in Hilbert's seventeenth problem, Math. Z. 220, 1995): for a positive form p
some (x_1^2 + .. + x_n^2)^k p is a sum of squares.
"""

from __future__ import annotations

from collections.abc import Iterator

from symctrl.sos.proof import Part
from symctrl.sos.ring import Poly, degree, from_terms, monomial, terms


def multipliers(p: Poly) -> Iterator[tuple[str, Poly, Part]]:
    """Powers of the sum of the squares of the variables of p, and of 1 where p is not homogeneous."""
    over = p.context()
    gens = [x for x, e in zip(over.gens(), p.degrees(), strict=True) if e]
    homogeneous = len({sum(map(int, m)) for m in p.monoms()}) == 1
    base = sum((x * x for x in gens), over.constant(0 if homogeneous else 1))
    words = " + ".join([f"{x}^2" for x in gens[:6]] + [".."] * (len(gens) > 6) + ["1"] * (not homogeneous))
    power = over.constant(1)
    for k in range(1, 4):
        power = power * base
        if degree(p) + 2 * k > 20:
            return
        table = terms(power)
        halves = [tuple(e // 2 for e in m) for m in table]
        weights = [int(c) for c in table.values()]
        gram = [[0] * i + [w] for i, w in enumerate(weights)]
        zeros = [[0] * (i + 1) for i in range(len(weights))]
        part = Part((), tuple(monomial(over, m) for m in halves), gram, 1, zeros, 1)
        yield (f"({words})^{k}" if k > 1 else words), from_terms(over, table), part
