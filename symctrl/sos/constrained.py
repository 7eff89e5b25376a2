"""Programmes for a set: sums of squares times constraints, of rising degree, modulo its equations.

Putinar's form p = q_0 + sum of g_i q_i + sum of c_j h_j exists for p > 0 on a compact set whose description
shows that it is bounded (Putinar, Positive polynomials on compact semi-algebraic sets, Indiana 42, 1993);
with products of the constraints (Schmuedgen, Math. Ann. 289, 1991) for every compact set.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from flint import fmpz_mpoly_ctx, fmpz_mpoly_vec

from symctrl.sos.basis import monomials, parities, split
from symctrl.sos.problem import Problem
from symctrl.sos.programme import Block, Programme
from symctrl.sos.ring import Monomial, Poly, degree, denominator, monomial, to_fraction

MAX_ROWS = 400  # of all Gram matrices together
MAX_PRODUCTS = 12  # pairs of constraints


def programmes(problem: Problem, target: Poly, more: int = 2) -> Iterator[tuple[str, Programme]]:
    """Programmes for target on the set, the small ones first, with words for each. more: degrees to add."""
    least = -(-max(problem.degree, degree(target)) // 2)
    leads = leading(problem.zero)
    pairs = list(combinations(range(len(problem.nonnegative)), 2))
    for half in range(least, least + more + 1):
        for products in ([], pairs[:MAX_PRODUCTS]) if pairs else ([],):
            made = _programme(problem, target, half, products, leads)
            if made is not None:
                words = f"constraints {'and their products ' if products else ''}to degree {2 * half}"
                yield words, made


def _programme(
    problem: Problem,
    target: Poly,
    half: int,
    pairs: Sequence[tuple[int, ...]],
    leads: Sequence[Monomial],
) -> Programme | None:
    one = problem.ring.constant(1)
    weights: list[tuple[tuple[int, ...], Poly]] = [((), one)]
    boxes = _boxes(problem)
    inside = {k for pair in boxes for k in pair}
    weights += [((i, j), problem.nonnegative[i] * problem.nonnegative[j]) for i, j in boxes]
    weights += [((k,), g) for k, g in enumerate(problem.nonnegative) if pairs or k not in inside]
    pairs = [pair for pair in pairs if pair not in boxes]
    weights += [((i, j), problem.nonnegative[i] * problem.nonnegative[j]) for i, j in pairs]
    signs = parities([target, *problem.nonnegative, *problem.zero])
    n = len(problem.names)
    blocks = []
    for product, weight in weights:
        top = (2 * half - degree(weight)) // 2
        if top < 0 or weight == 0:
            continue
        basis = [b for b in monomials(n, top) if not any(_divides(m, b) for m in leads)]
        for part in split(basis, signs):
            blocks.append(Block(product, weight, tuple(monomial(problem.ring, b) for b in part)))
    if sum(len(block.basis) for block in blocks) > MAX_ROWS * (1 + (len(blocks) > 5)):
        return None
    multiples = []
    for j, h in enumerate(problem.zero):
        room = 2 * half - degree(h)
        for b in monomials(n, room) if room >= 0 else []:
            # h is even under every symmetry of the problem, so its multiple must be too.
            if not any((signs @ list(b)) % 2):
                by = monomial(problem.ring, b)
                multiples.append((j, by, by * h))
    return Programme(target, tuple(blocks), tuple(multiples))


def _boxes(problem: Problem) -> list[tuple[int, int]]:
    """Pairs x >= a, x <= b, whose product says more: (b - a)(x - a) = (x - a)^2 + (x - a)(b - x)."""
    ends: dict[int, dict[bool, int]] = {}
    for k, g in enumerate(problem.nonnegative):
        used = [v for v, e in enumerate(g.degrees()) if e]
        if len(used) == 1 and degree(g) == 1:
            ends.setdefault(used[0], {}).setdefault(to_fraction(g.leading_coefficient()) > 0, k)
    return [(min(e.values()), max(e.values())) for e in ends.values() if len(e) == 2]


def _divides(a: Monomial, b: Monomial) -> bool:
    return all(x <= y for x, y in zip(a, b, strict=True))


def leading(zero: Sequence[Poly]) -> list[Monomial]:
    """Leading monomials of a Groebner basis of the equations, or of as much of one as is quick to find."""
    kept = [h for h in zero if h != 0]
    if not kept:
        return []
    over = kept[0].context()
    integers = fmpz_mpoly_ctx.get(over.names(), over.ordering())
    scaled = []
    for h in kept:
        d = denominator(h)
        scaled.append(integers.from_dict({m: int(to_fraction(c) * d) for m, c in h.to_dict().items()}))
    try:
        found = fmpz_mpoly_vec(scaled, integers).buchberger_naive(limits=(60, 200, 400))
        basis = list(found[0] if isinstance(found, tuple) else found)
    except (ValueError, TypeError, ArithmeticError):
        basis = scaled
    leads = [tuple(map(int, g.monoms()[0])) for g in (*basis, *scaled)]
    return [m for m in leads if any(m)]
