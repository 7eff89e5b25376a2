"""Problems in one variable, and forms in two: decided on the line, on half-lines and on intervals.

On [a, b], x = (a + b t^2)/(1 + t^2) makes p >= 0 a question on the line, and the squares of its answer
become p = u(x)^2 + .. + (x - a)(b - x) (v(x)^2 + ..) (Polya and Szego, Problems and Theorems in Analysis II,
VI 44-47); on [a, oo), x = a + t^2 does.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import fmpq_poly

from symctrl.sos.deadline import Deadline
from symctrl.sos.problem import Problem
from symctrl.sos.proof import Part, Proof
from symctrl.sos.ring import Poly, from_terms, to_fmpq, to_fraction
from symctrl.sos.univariate import Weighted, between, decompose, even_squares, merged, odd_part, real_roots

Lift = Callable[[Any], Poly]  # fmpq_poly to a polynomial of the problem


@dataclass(frozen=True)
class _Interval:
    """From `low`, up to `high`; product: constraints whose product is unit * (x - low)(high - x)."""

    low: Fraction | None
    high: Fraction | None
    product: tuple[int, ...]
    unit: Fraction


def variable_of(problem: Problem) -> int | None:
    """The only variable that occurs, None if there are several or none."""
    polys = (problem.polynomial, *problem.nonnegative, *problem.zero)
    used = [k for k in range(len(problem.names)) if any(p.degrees()[k] for p in polys)]
    return used[0] if len(used) == 1 else None


def form_of(problem: Problem) -> tuple[int, int] | None:
    """The two variables of a form in two variables, on the whole space."""
    p = problem.polynomial
    used = [k for k, e in enumerate(p.degrees()) if e]
    degrees = {sum(map(int, m)) for m in p.monoms()}
    if len(used) != 2 or len(degrees) != 1 or not problem.everywhere or problem.strict:
        return None
    return used[0], used[1]


def flat_poly(p: Poly, k: int) -> Any:
    """The polynomial in variable k alone, as an fmpq_poly; other variables are set to 1."""
    coefficients: list[Any] = [0] * (int(p.degrees()[k]) + 1)
    for m, c in p.to_dict().items():
        coefficients[int(m[k])] += c
    return fmpq_poly(coefficients)


def points(problem: Problem, k: int) -> Iterator[tuple[Fraction, ...]]:
    """A rational point in each open piece of the line where no sign changes; rational roots."""
    polys = [flat_poly(p, k) for p in (problem.polynomial, *problem.nonnegative, *problem.zero)]
    product = fmpq_poly([1])
    for p in polys:
        if p.degree() > 0:
            product *= p // p.gcd(product)
    free = product // product.gcd(product.derivative()) if product.degree() > 0 else product
    values = between(real_roots(free))
    for p in polys:
        if p.degree() > 0:
            values += [-to_fraction(f[0]) / to_fraction(f[1]) for f, _ in _factors(p) if f.degree() == 1]
    for x in sorted(values, key=lambda x: (x.denominator, abs(x))):
        yield tuple(x if j == k else Fraction(0) for j in range(len(problem.names)))


def _factors(p: Any) -> list[Any]:
    factors: list[Any] = p.factor()[1]
    return factors


def prove(problem: Problem, k: int, deadline: Deadline) -> Proof | None:
    """A proof where the set is the line, a half-line or an interval with rational ends; else None."""
    p = flat_poly(problem.polynomial, k)
    n = len(problem.names)

    def lift(q: Any) -> Poly:
        return from_terms(
            problem.ring,
            {tuple(e if j == k else 0 for j in range(n)): to_fraction(c) for e, c in enumerate(q.coeffs())},
        )

    if problem.zero:
        return None
    margin = _margin(p) if problem.strict and problem.everywhere else Fraction(0)
    if problem.everywhere:
        parts = _on_the_line(p - to_fmpq(margin), lift, deadline)
        return (
            None if parts is None or (problem.strict and not margin) else Proof(tuple(parts), margin=margin)
        )
    if problem.strict:
        return None
    for interval in _intervals([flat_poly(g, k) for g in problem.nonnegative]):
        parts = _on(interval, p, lift, deadline)
        if parts is not None:
            return Proof(tuple(parts))
    return None


def prove_form(problem: Problem, used: tuple[int, int], deadline: Deadline) -> Proof | None:
    """A proof for a form p(x, y), from p(x, 1)."""
    i, j = used
    p = flat_poly(problem.polynomial, i)
    n = len(problem.names)
    half = int(problem.polynomial.total_degree()) // 2

    def lift(q: Any) -> Poly:
        return from_terms(
            problem.ring,
            {
                tuple(e if v == i else half - e if v == j else 0 for v in range(n)): to_fraction(c)
                for e, c in enumerate(q.coeffs())
            },
        )

    parts = _on_the_line(p, lift, deadline)
    return None if parts is None else Proof(tuple(parts))


def form_points(problem: Problem, used: tuple[int, int]) -> Iterator[tuple[Fraction, ...]]:
    """Points that decide a form in two variables: (x, 1) in each piece, and (1, 0)."""
    p = flat_poly(problem.polynomial, used[0])
    free = p // p.gcd(p.derivative()) if p.degree() > 0 else p
    pairs = [(Fraction(1), Fraction(0)), *((x, Fraction(1)) for x in between(real_roots(free)))]
    for x, y in pairs:
        yield tuple(
            x if v == used[0] else y if v == used[1] else Fraction(0) for v in range(len(problem.names))
        )


def _nonnegative(p: Any) -> tuple[Any, Any] | None:
    """(q, s) with p = q s^2 and q > 0 on the line; None where p is negative somewhere."""
    if p == 0:
        return None
    q, s = odd_part(p)
    if q[q.degree()] < 0 or q.degree() % 2 or real_roots(q):
        return None
    return q, s


def _on_the_line(p: Any, lift: Lift, deadline: Deadline) -> list[Part] | None:
    if p == 0:
        return []
    found = _nonnegative(p)
    if found is None:
        return None
    q, s = found
    return [_part((), [Weighted(w.weight, w.polynomial * s) for w in decompose(q, deadline)], lift)]


def _part(product: tuple[int, ...], squares: Sequence[Weighted], lift: Lift) -> Part:
    polys, weights, d = merged(squares)
    n = len(polys)
    gram = [[0] * i + [weights[i]] for i in range(n)]
    return Part(product, tuple(map(lift, polys)), gram, d, [[0] * (i + 1) for i in range(n)], 1)


def _margin(p: Any) -> Fraction:
    """A positive number below the least value of p; 0 where there is none."""
    if p.degree() < 1:
        return max(Fraction(0), to_fraction(p[0]) / 2)
    if _nonnegative(p) is None or real_roots(p // p.gcd(p.derivative())):
        return Fraction(0)
    e = Fraction(1)
    while _nonnegative(p - to_fmpq(e)) is None:
        e /= 16
    return e / 2


def _intervals(gs: Sequence[Any]) -> Iterator[_Interval]:
    """Those that single constraints, or products of two, describe."""
    lows: list[tuple[Fraction, int, Fraction]] = []
    highs: list[tuple[Fraction, int, Fraction]] = []
    for k, g in enumerate(gs):
        if g.degree() == 1:
            root, slope = -to_fraction(g[0]) / to_fraction(g[1]), to_fraction(g[1])
            (lows if slope > 0 else highs).append((root, k, abs(slope)))
        roots = sorted(-to_fraction(f[0]) / to_fraction(f[1]) for f, _ in _factors(g) if f.degree() == 1)
        if g.degree() == 2 and g[2] < 0 and len(roots) == 2:
            yield _Interval(roots[0], roots[1], (k,), -to_fraction(g[2]))
    for low, i, a in sorted(lows, reverse=True):
        for high, j, b in sorted(highs):
            if low < high:
                yield _Interval(low, high, (min(i, j), max(i, j)), a * b)
    for low, i, a in sorted(lows, reverse=True):
        yield _Interval(low, None, (i,), a)
    for high, j, b in sorted(highs):
        yield _Interval(None, high, (j,), b)


def _on(interval: _Interval, p: Any, lift: Lift, deadline: Deadline) -> list[Part] | None:
    low, high = interval.low, interval.high
    x, t = fmpq_poly([0, 1]), fmpq_poly([0, 1])
    m = 0
    if low is not None and high is not None:
        m = (p.degree() + 1) // 2
        a, b = to_fmpq(low), to_fmpq(high)
        top, bottom = t * t * b + a, t * t + 1
        lifted = sum((top**k * bottom ** (2 * m - k) * p[k] for k in range(p.degree() + 1)), fmpq_poly([0]))
        first, second, size = x - a, b - x, (b - a) ** m
    elif low is not None:
        lifted, first, second, size = p(t * t + to_fmpq(low)), x - to_fmpq(low), None, 1
    else:
        assert high is not None
        lifted, first, second, size = p(to_fmpq(high) - t * t), to_fmpq(high) - x, None, 1
    if lifted == 0:
        return []
    found = _nonnegative(lifted)
    if found is None:
        return None
    q, s = found
    us, vs = even_squares(q, deadline)
    shift = next(k for k, c in enumerate(s.coeffs()) if c != 0) % 2
    e = fmpq_poly([s[k] for k in range(shift, s.degree() + 1, 2)])
    if shift:  # s^2 = t^2 e(t^2)^2 turns a square into a multiple of t^2, and the other way about
        us, vs = [Weighted(v.weight, v.polynomial * x) for v in vs], us
    us, vs = ([Weighted(w.weight, w.polynomial * e) for w in ws] for ws in (us, vs))

    def back(u: Any, top_degree: int) -> Any:
        if second is None:
            return u(first)
        return sum(
            (first**k * second ** (top_degree - k) * u[k] for k in range(u.degree() + 1)), fmpq_poly([0])
        )

    scale = Fraction(1) / to_fraction(size * fmpq_poly([1])[0]) ** 2
    squares = [Weighted(u.weight * scale, back(u.polynomial, m)) for u in us]
    weighted = [Weighted(v.weight * scale / interval.unit, back(v.polynomial, m - 1)) for v in vs]
    parts = [_part((), squares, lift)] if squares else []
    return [*parts, _part(interval.product, weighted, lift)] if weighted else parts
