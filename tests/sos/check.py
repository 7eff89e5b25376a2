"""An independent reading of certificates about polynomials: SymPy expands, fractions judge matrices."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import sympy as sp


def number(text: Any) -> Any:
    return sp.Rational(str(text))


def polynomial(table: Any, xs: Any) -> Any:
    return sp.Add(*[number(c) * sp.Mul(*[xs[v] ** e for v, e in pairs(m)]) for c, m in table])


def pairs(flat: Any) -> Any:
    return list(zip(flat[::2], flat[1::2], strict=True))


def part(entry: Any, weights: Any, xs: Any) -> Any:
    """The polynomial of a part, having seen that its Gram matrix is semidefinite (exactly, by SymPy)."""
    n = len(entry["basis"])
    gram = [[entry["gram"][max(i, j)][min(i, j)] for j in range(n)] for i in range(n)]
    assert entry["denominator"] > 0
    assert semidefinite(gram)
    basis = [polynomial(b, xs) for b in entry["basis"]]
    total = sum(gram[i][j] * basis[i] * basis[j] for i in range(n) for j in range(n))
    for k in entry["product"]:
        total *= weights[k]
    return total / entry["denominator"]


def semidefinite(gram: Any) -> bool:
    """By elimination with fractions."""
    work = [[Fraction(a) for a in row] for row in gram]
    n = len(work)
    for k in range(n):
        pivot = work[k][k]
        if pivot < 0 or (pivot == 0 and any(work[i][k] for i in range(k, n))):
            return False
        for i in range(k + 1, n) if pivot else ():
            factor = work[i][k] / pivot
            if factor:
                for j in range(k, n):
                    work[i][j] -= factor * work[k][j]
    return True


def holds(certificate: Any) -> bool:
    """Does a proof, or a witness, show what the certificate states?"""
    s, proof = certificate["statement"], certificate["proof"]
    xs = sp.symbols([f"v{k}" for k in range(len(s["variables"]))])
    p = polynomial(s["polynomial"], xs)
    gs = [polynomial(g, xs) for g in s["nonnegative"]]
    hs = [polynomial(h, xs) for h in s["zero"]]
    if proof["kind"] == "witness":
        at = dict(zip(xs, (number(proof["values"][name]) for name in s["variables"]), strict=True))
        value = p.subs(at)
        inside = all(g.subs(at) >= 0 for g in gs) and all(sp.simplify(h.subs(at)) == 0 for h in hs)
        return bool(inside and (value < 0 or (s["claim"] == "positive" and value == 0)))
    right = number(proof["margin"]) + sum(part(entry, gs, xs) for entry in proof["parts"])
    right += sum(polynomial(c, xs) * h for c, h in zip(proof["multiples"], hs, strict=True))
    if proof["kind"] == "empty":
        return bool(number(proof["margin"]) > 0) and sp.Poly(right, *xs).is_zero
    multiplier = proof["multiplier"]
    left = number(multiplier["constant"]) + sum(part(entry, [], xs) for entry in multiplier["parts"])
    assert number(multiplier["constant"]) > 0 or (not gs and not hs)
    assert number(proof["margin"]) >= 0
    assert s["claim"] == "nonnegative" or number(proof["margin"]) > 0
    return not sp.Poly(left, *xs).is_zero and sp.Poly(left * p - right, *xs).is_zero
