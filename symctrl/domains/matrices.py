"""Determinants of small matrices of exact values."""

from __future__ import annotations

from symctrl.domains.exact import ExactDomain
from symctrl.domains.field import Exact


def determinant_of(domain: ExactDomain, rows: list[list[Exact]]) -> Exact:
    """The determinant of a small matrix of exact values, by Laplace expansion."""
    if len(rows) == 1:
        return rows[0][0]
    total: Exact = {}
    for c, entry in enumerate(rows[0]):
        if entry:
            minor = determinant_of(domain, [row[:c] + row[c + 1 :] for row in rows[1:]])
            term = domain.mul_(entry, minor)
            total = domain.sub_(total, term) if c % 2 else domain.add_(total, term)
    return total
