"""Polynomials in one variable: nonnegativity on the line is decided completely, with a proof by squares.

p >= 0 on R exactly where its leading coefficient is positive and no irreducible factor of odd multiplicity
has a real root. A polynomial q > 0 is A^2 + B^2 with A + iB = sqrt(lead) times the product of x - z over the
roots z in the upper half-plane. Floats of many digits give A and B nearly; what is left is absorbed by
e (w_0 + w_1 x^2 + ..), of which q - e (..) is still positive (Chevillard, Harrison, Joldes, Lauter,
Efficient and accurate computation of upper bounds of approximation errors, TCS 412, 2011; Magron, Safey El
Din, Schweighofer, Algorithms for weighted sum of squares decomposition, JSC 93, 2019).
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import lcm
from typing import Any

from flint import acb_poly, arb, ctx, fmpq, fmpq_poly, fmpz_poly

from symctrl.sos.deadline import Deadline
from symctrl.sos.ring import to_fmpq, to_fraction

MAX_PRECISION = 60_000


@dataclass(frozen=True)
class Weighted:
    """weight * polynomial^2, the weight being positive."""

    weight: Fraction
    polynomial: Any  # fmpq_poly


@contextmanager
def precision(bits: int) -> Any:
    """Balls of so many bits inside."""
    before = ctx.prec
    ctx.prec = bits
    try:
        yield
    finally:
        ctx.prec = before


def integral(p: Any) -> Any:
    """A positive multiple of an fmpq_poly with integer coefficients."""
    return fmpz_poly([int(c) for c in (p * p.denom()).coeffs()])


def odd_part(p: Any) -> tuple[Any, Any]:
    """(q, s) with p = q s^2 and q without a square factor."""
    unit, factors = integral(p).factor()
    q = fmpq_poly([unit]) / p.denom()
    s = fmpq_poly([1])
    for f, e in factors:
        s *= fmpq_poly(f) ** (e // 2)
        if e % 2:
            q *= fmpq_poly(f)
    return q, s


def real_roots(p: Any) -> list[Any]:
    """Disjoint balls with one real root each, in order, of a polynomial without square factors."""
    if p.degree() < 1:
        return []
    return sorted(
        (z.real for z, _ in integral(p).complex_roots() if z.imag == 0), key=lambda r: float(r.mid())
    )


def between(roots: Sequence[Any]) -> list[Fraction]:
    """Rational points below, between and above real roots that lie in disjoint balls: one in each gap."""
    if not roots:
        return [Fraction(0)]
    points = [_short(None, _low(roots[0]))]
    points += [_short(_high(a), _low(b)) for a, b in pairwise(roots)]
    return [*points, _short(_high(roots[-1]), None)]


def _exact(x: Any) -> Fraction:
    man, exp = x.man_exp()
    return Fraction(int(man)) * Fraction(2) ** int(exp)


def _low(ball: Any) -> Fraction:
    return _exact(ball.mid()) - _exact(ball.rad())


def _high(ball: Any) -> Fraction:
    return _exact(ball.mid()) + _exact(ball.rad())


def _short(low: Fraction | None, high: Fraction | None) -> Fraction:
    """A rational number strictly between, with few digits."""
    if low is None:
        assert high is not None
        return Fraction(high.__ceil__() - 1)
    if high is None:
        return Fraction(low.__floor__() + 1)
    if low < 0 < high:
        return Fraction(0)
    bits = 0
    while True:
        unit = Fraction(1, 1 << bits)
        k = (low / unit).__floor__() + 1
        if k * unit < high:
            return k * unit
        bits += 1


def decompose(q: Any, deadline: Deadline) -> list[Weighted]:
    """Weighted squares with the sum q, of a polynomial that is positive on the line. Raises Late."""
    d = q.degree() // 2
    if d == 0:
        return [Weighted(to_fraction(q[0]), fmpq_poly([1]))]
    weights = _weights(q)
    shift = 3
    while True:
        deadline.check()
        e = Fraction(1, 1 << shift)
        rest = q - sum((_monomial(2 * k, e * w) for k, w in enumerate(weights)), fmpq_poly([0]))
        roots = integral(rest).complex_roots() if rest.degree() == 2 * d and rest[2 * d] > 0 else None
        if roots is not None and all(z.imag != 0 for z, _ in roots):
            break
        shift *= 2
    bits = 64 + 2 * shift
    while bits < MAX_PRECISION:
        deadline.check()
        squares = _two_squares(rest, bits)
        left = rest - sum(((s.polynomial**2) * to_fmpq(s.weight) for s in squares), fmpq_poly([0]))
        absorbed = _absorb(left, [e * w for w in weights])
        if absorbed is not None:
            return [*squares, *absorbed]
        bits *= 2
    raise ArithmeticError("the roots were not found with enough digits")


def even_squares(q: Any, deadline: Deadline) -> tuple[list[Weighted], list[Weighted]]:
    """(u, v) in s = t^2 with q(t) = sum of u(s)^2 + s * sum of v(s)^2, of an even polynomial q > 0."""
    us, vs = [], []
    for term in decompose(q, deadline):
        a = term.polynomial
        us.append(Weighted(term.weight, fmpq_poly([a[k] for k in range(0, a.degree() + 1, 2)])))
        vs.append(Weighted(term.weight, fmpq_poly([a[k] for k in range(1, a.degree() + 1, 2)])))
    return [u for u in us if u.polynomial != 0], [v for v in vs if v.polynomial != 0]


def _weights(q: Any) -> list[Fraction]:
    """Powers of two between the first and the last coefficient, as if x were scaled to make them equal."""
    d = q.degree() // 2
    low, high = _log2(to_fraction(q[0])), _log2(to_fraction(q[2 * d]))
    return [Fraction(2) ** round(low + (high - low) * k / d) for k in range(d + 1)]


def _log2(a: Fraction) -> int:
    return a.numerator.bit_length() - a.denominator.bit_length()


def _monomial(k: int, c: Fraction) -> Any:
    return fmpq_poly([0] * k + [to_fmpq(c)])


def _two_squares(q: Any, bits: int) -> list[Weighted]:
    """A^2 and B^2, with rational coefficients, whose sum is nearly q."""
    lead = to_fraction(q[q.degree()])
    with precision(2 * bits):
        roots = [z for z, m in integral(q).complex_roots() for _ in range(m) if float(z.imag.mid()) > 0]
        coefficients = acb_poly.from_roots(roots).coeffs()
        parts = []
        for component in ("real", "imag"):
            numbers = [getattr(c, component) if hasattr(c, component) else arb(c) for c in coefficients]
            parts.append(fmpq_poly([_rounded(x, bits) for x in numbers]))
    return [Weighted(lead, part) for part in parts if part != 0]


def _rounded(x: Any, bits: int) -> Any:
    """The number to so many significant bits."""
    value = _exact(x.mid())
    if value == 0:
        return fmpq(0)
    cut = bits - _log2(value)
    scaled = round(value * Fraction(2) ** cut)
    return to_fmpq(Fraction(scaled) * Fraction(2) ** -cut)


def _absorb(left: Any, slack: Sequence[Fraction]) -> list[Weighted] | None:
    """left + sum of slack_k x^2k as squares c (x^k)^2 and c (x^k +- x^(k+1))^2, or None."""
    if left.degree() > 2 * len(slack) - 2:
        return None
    slack = list(slack)
    found = []
    for k in range(len(slack) - 1):
        c = to_fraction(left[2 * k + 1])
        if c:
            half = abs(c) / 2
            slack[k] -= half
            slack[k + 1] -= half
            found.append(Weighted(half, fmpq_poly([0] * k + [1, 1 if c > 0 else -1])))
    for k, w in enumerate(slack):
        total = w + to_fraction(left[2 * k])
        if total < 0:
            return None
        if total:
            found.append(Weighted(total, fmpq_poly([0] * k + [1])))
    return found


def merged(squares: Sequence[Weighted]) -> tuple[list[Any], list[int], int]:
    """(integer polynomials, integer weights, d) with the same sum, over d."""
    pairs = []
    for s in squares:
        unit = int(s.polynomial.denom())
        pairs.append((s.polynomial * unit, s.weight / unit**2))
    d = lcm(*(w.denominator for _, w in pairs))
    return [p for p, _ in pairs], [int(w * d) for _, w in pairs], d
