"""What tends to zero because a multiple of it is a combination of what does.

A term with a factor that tends to zero is a combination by itself. For symbols that do not occur so, the
rates and other values that tend to zero are read as linear equations for them with constant coefficients A:
then det(A) e = adj(A) (z - r), where every term of r has a factor that tends to zero.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import combinations as subsets
from typing import Any

from symctrl.domains.field import Exact, Poly
from symctrl.domains.matrices import determinant_of
from symctrl.graph import Tape
from symctrl.rules.algebra import Algebra, algebra
from symctrl.rules.algebra import symbol_of as symbol
from symctrl.rules.chain import Chain

MAX_UNKNOWNS = 4
MAX_ROWS = 9


@dataclass(frozen=True)
class Found:
    """e times divisor is the sum of factor times part: parts by quantity, all else as tapes."""

    parts: tuple[str, ...]
    factors: tuple[Tape, ...]
    divisor: Tape | None = None


def combinations(chain: Chain, names: Sequence[str]) -> None:
    """Carry `tends` over to those of the quantities for which a combination is found."""
    if not names:
        return
    known = [name for name in chain.having("tends") if name not in names]
    if not known:
        return
    order = [*names, *known]
    found = algebra(chain, order, lambda a: search(a, list(names), known)) or {}
    for name, way in found.items():
        table: dict[str, Any] = {
            "word": "tends",
            "how": "combination",
            "e": name,
            "of": list(way.parts),
            "times": [chain.q(t) for t in way.factors],
        }
        if way.divisor is not None:
            table["divisor"] = chain.q(way.divisor)
        for factor in table["times"]:
            if not chain.at.has("bounded", factor):
                from symctrl.rules.ways import ensure

                ensure(chain, "bounded", factor)
        chain.attempt("carries", table)


def search(found: Algebra, names: list[str], known: list[str]) -> dict[str, Found]:
    """Ways for names, whose values come first in `found`, from what is known, whose values follow."""
    values = dict(zip([*names, *known], found.values, strict=True))
    small = {g: name for name in known if (g := _symbol(found, values[name])) is not None}
    ways: dict[str, Found] = {}
    for name in names:
        made = _directly(found, values[name], {n: values[n] for n in known}, small)
        if made is not None:
            ways[name] = made
    rest = [name for name in names if name not in ways]
    return ways | _linear(found, {n: values[n] for n in rest}, {n: values[n] for n in known}, small)


def _directly(found: Algebra, value: Exact, known: dict[str, Exact], small: dict[int, str]) -> Found | None:
    """Every term has a factor that tends to zero, as it is or after division by what tends to zero."""
    domain, field = found.session.domain, found.session.domain.field
    split = _split(found, value, small)
    if split is None:
        return None
    parts, rest = split
    own: dict[str, Exact] = {}
    for name, z in known.items():
        if not rest:
            break
        numerator, key = domain.together(z)
        below = reduce(lambda a, b: a * b, (field.factors[f] ** e for f, e in key), field.polynomial(1))
        if numerator.is_zero() or numerator.is_constant() or not found.is_constant({(): below}):
            continue
        quotients = {k: divmod(p, numerator) for k, p in rest.items()}
        own[name] = {k: q * below for k, (q, _) in quotients.items() if not q.is_zero()}
        rest = {k: r for k, (_, r) in quotients.items() if not r.is_zero()}
    return None if rest else _found(found, parts, own, None)


def _symbol(found: Algebra, value: Exact) -> int | None:
    return symbol(found, value)


def _split(found: Algebra, value: Exact, small: dict[int, str]) -> tuple[dict[str, Exact], Exact] | None:
    """The value as factors of what tends to zero, and the rest; None where a denominator is not constant."""
    field = found.session.domain.field
    parts: dict[str, Exact] = {}
    rest: Exact = {}
    for key, p in found.session.domain.simplified(value).items():
        if not found.is_constant(
            {(): reduce(lambda a, b: a * b, (field.factors[f] for f, _ in key), field.polynomial(1))}
        ):
            return None
        groups: dict[str | None, dict[tuple[int, ...], Any]] = {}
        for exponents, c in p.terms():
            lowered = [int(e) for e in exponents]
            at = next((g for g in small if lowered[field.size - 1 - g]), None)
            if at is not None:
                lowered[field.size - 1 - at] -= 1
            name = None if at is None else small[at]
            table = groups.setdefault(name, {})
            table[tuple(lowered)] = table.get(tuple(lowered), 0) + c
        for name, table in groups.items():
            poly = field.context.from_dict(table)
            if name is None:
                rest[key] = poly
            else:
                parts.setdefault(name, {})[key] = poly
    return parts, rest


def _linear(
    found: Algebra, unknown: dict[str, Exact], known: dict[str, Exact], small: dict[int, str]
) -> dict[str, Found]:
    """The unknown symbols from linear equations with constant coefficients."""
    symbols = {name: _symbol(found, value) for name, value in unknown.items()}
    if not unknown or len(unknown) > MAX_UNKNOWNS or None in symbols.values():
        return {}
    rows = []
    for name, value in known.items():
        if _symbol(found, value) is None:
            row = _row(found, name, value, [g for g in symbols.values() if g is not None], small)
            if row is not None:
                rows.append(row)
    for chosen in subsets(rows[:MAX_ROWS], len(unknown)):
        ways = _solved(found, list(unknown), chosen)
        if ways:
            return ways
    return {}


@dataclass(frozen=True)
class _Row:
    """below * z = sum of coefficients * unknowns + sum of parts."""

    name: str
    below: Exact
    coefficients: list[Poly]
    parts: dict[str, Exact]


def _row(found: Algebra, name: str, value: Exact, unknown: list[int], small: dict[int, str]) -> _Row | None:
    domain, field = found.session.domain, found.session.domain.field
    numerator, key = domain.together(value)
    below = reduce(lambda a, b: a * b, (field.factors[f] ** e for f, e in key), field.polynomial(1))
    if not found.is_constant({(): below}):
        return None
    split = _split(found, {(): numerator}, small)
    if split is None:
        return None
    parts, rest = split
    coefficients: list[Any] = []
    for g in unknown:
        c = found.coefficient(rest, {g: 1} | {h: 0 for h in unknown if h != g})
        coefficients.append(c.get((), field.polynomial(0)))
        rest = domain.sub_(rest, {(): coefficients[-1] * field.variable(g)})
    fits = not domain.simplified(rest) and all(found.is_constant({(): c}) for c in coefficients)
    return (
        _Row(name, {(): below}, coefficients, parts)
        if fits and any(not c.is_zero() for c in coefficients)
        else None
    )


def _solved(found: Algebra, names: list[str], rows: Sequence[_Row]) -> dict[str, Found]:
    domain, field = found.session.domain, found.session.domain.field
    matrix: list[list[Exact]] = [
        [{(): c} if not c.is_zero() else {} for c in row.coefficients] for row in rows
    ]
    det: Any = determinant_of(domain, matrix).get((), field.polynomial(0))
    if det.is_zero():
        return {}
    n = len(rows)
    adjugate: list[list[Any]] = [[_cofactor(found, matrix, c, r) for c in range(n)] for r in range(n)]
    common = reduce(lambda a, b: a.gcd(b), (p for row in adjugate for p in row if not p.is_zero()), det)
    det, adjugate = det / common, [[p / common for p in row] for row in adjugate]
    ways = {}
    for i, name in enumerate(names):
        parts: dict[str, Exact] = {}
        own: dict[str, Exact] = {}
        for k, row in enumerate(rows):
            weight = adjugate[i][k]
            if weight.is_zero():
                continue
            own[row.name] = domain.mul_({(): weight}, row.below)
            for part, value in row.parts.items():
                parts[part] = domain.sub_(parts.get(part, {}), domain.mul_({(): weight}, value))
        made = _found(found, parts, own, det)
        if made is not None:
            ways[name] = made
    return ways


def _cofactor(found: Algebra, matrix: list[list[Exact]], r: int, c: int) -> Poly:
    domain = found.session.domain
    rows = [[x for k, x in enumerate(row) if k != c] for n, row in enumerate(matrix) if n != r]
    minor = determinant_of(domain, rows) if rows else domain.constant(Fraction(1))
    value: Any = minor.get((), domain.field.polynomial(0))
    return -value if (r + c) % 2 else value


def _found(found: Algebra, parts: dict[str, Exact], own: dict[str, Exact], det: Poly | None) -> Found | None:
    pairs = [(name, found.tape(value)) for name, value in {**parts, **own}.items() if value]
    divisor = None if det is None else found.tape({(): det})
    if any(tape is None for _, tape in pairs) or (det is not None and divisor is None):
        return None
    return Found(tuple(n for n, _ in pairs), tuple(t for _, t in pairs if t is not None), divisor)
