"""Reading polynomials: which generator one is, and the coefficient of a product of generators."""

from __future__ import annotations

from collections.abc import Mapping

from symctrl.domains.field import Exact, Field, Poly


def generator_of(field: Field, value: Exact) -> int | None:
    """The generator that the value is; None where it is anything else."""
    if set(value) != {()} or len(value[()]) != 1:
        return None
    occurring = field.occurring(value[()])
    if len(occurring) != 1:
        return None
    (k,) = occurring
    return k if value[()] == field.variable(k) else None


def coefficient_of(field: Field, p: Poly, powers: Mapping[int, int]) -> Poly:
    """The coefficient of a product of powers of generators, other generators aside."""
    columns = {field.size - 1 - k: power for k, power in powers.items()}
    kept = {}
    for exponents, c in p.terms():
        if all(exponents[v] == power for v, power in columns.items()):
            kept[tuple(0 if v in columns else int(e) for v, e in enumerate(exponents))] = c
    return field.context.from_dict(kept)
