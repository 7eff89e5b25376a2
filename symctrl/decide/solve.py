"""Solving the equations that a problem assumes, so that exact points can be drawn: one way after another.

Linear equations are solved for a symbol and put into the rest; what factors is solved factor by factor; what
is left must be a sphere or circle, which has a rational parametrisation, or linear in a symbol."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from symctrl.decide.definiteness import decide_matrix
from symctrl.decide.session import Session
from symctrl.domains.field import Poly
from symctrl.domains.fraction import rational_root
from symctrl.problem import star

Terms = tuple[tuple[Fraction, Mapping[str, int]], ...]
MAX_WAYS = 8


class NoPoint(ValueError):  # noqa: N818
    """No admissible point was found; the message names the assumption that failed last."""


@dataclass(frozen=True)
class Sphere:
    """x_1² + .. + x_k² = radius², for symbols by their starred names."""

    names: tuple[str, ...]
    radius: Fraction


@dataclass(frozen=True)
class Linear:
    """The symbol `name` solves coefficient * name + rest = 0; both are polynomials in other starred names."""

    name: str
    coefficient: Terms
    rest: Terms


Way = tuple[Sphere | Linear, ...]  # to be carried out from the last to the first


def ways(session: Session) -> list[Way]:
    """Ways to meet all assumed equations, at most MAX_WAYS. Raises NoPoint for one of a form that is not
    solved.
    """
    texts = [assumption.text for assumption, _ in session.zeros]
    polynomials = [p for _, p in session.zeros]
    found = []
    for way in _solved(session, polynomials, frozenset()):
        found.append(way)
        if len(found) == MAX_WAYS:
            break
    if not found:
        raise NoPoint(f"no exact point is known with {' and '.join(dict.fromkeys(texts))}")
    return found


def _solved(session: Session, zeros: list[Poly], taken: frozenset[int]) -> Iterator[Way]:
    """Every way to make the polynomials zero; generators in `taken` are drawn already."""
    zeros = [p for p in zeros if not p.is_zero()]
    if not zeros:
        yield ()
        return
    if any(p.is_constant() for p in zeros):
        return
    for k, p in enumerate(zeros):
        factors = [f for f, _ in p.factor()[1]]
        if len(factors) > 1:
            for f in factors:
                yield from _solved(session, [*zeros[:k], f, *zeros[k + 1 :]], taken)
            return
    for k, p in enumerate(zeros):
        forms = _squares(session, p)
        if forms is not None:
            yield from _solved(session, [*zeros[:k], *forms, *zeros[k + 1 :]], taken)
            return
    for k, p in enumerate(zeros):
        solved = _linear(session, p, taken, constant=True)
        if solved is not None:
            way, generator, value = solved
            rest = [_put(session, q, generator, value) for n, q in enumerate(zeros) if n != k]
            for others in _solved(session, rest, taken | {generator}):
                yield (way, *others)
            return
    for k, p in enumerate(zeros):
        sphere = _sphere(session, p, taken)
        if sphere is not None:
            last, generators = sphere
            rest = [_without_square(session, q, p) for n, q in enumerate(zeros) if n != k]
            for others in _solved(session, rest, taken | generators):
                yield (*others, last)
            return
    for k, p in enumerate(zeros):
        solved = _linear(session, p, taken, constant=False)
        if solved is not None and len(zeros) == 1:
            yield (solved[0],)
            return
        if solved is not None:
            rest = [q for n, q in enumerate(zeros) if n != k]
            if not any(solved[1] in session.domain.field.occurring(q) for q in rest):
                for more in _solved(session, rest, taken | {solved[1]}):
                    yield (solved[0], *more)
                return


def _squares(session: Session, p: Poly) -> list[Poly] | None:
    """The linear forms of a quadratic form that is plus or minus a sum of squares: they vanish with it."""
    field = session.domain.field
    if p.total_degree() != 2 or any(sum(map(int, e)) != 2 for e in p.monoms()):
        return None
    variables = sorted(field.occurring(p))
    place = {k: n for n, k in enumerate(variables)}
    gram = [[Fraction(0)] * len(variables) for _ in variables]
    for exponents, c in p.terms():
        i, j = (place[field.size - 1 - v] for v, e in enumerate(exponents) for _ in range(int(e)))
        for a, b in ((i, j), (j, i)):
            gram[a][b] += Fraction(int(c.p), int(c.q)) / 2
    for side in (1, -1):
        leaf = decide_matrix([[side * x for x in row] for row in gram]).leaf
        if leaf is not None and "ldl" in leaf:
            lower, diagonal = leaf["ldl"]["lower"], leaf["ldl"]["diagonal"]
            return [
                sum(
                    (
                        field.variable(variables[r]) * field.polynomial(Fraction(lower[r][k]))
                        for r in range(k, len(gram))
                    ),
                    start=field.polynomial(0),
                )
                for k, d in enumerate(diagonal)
                if Fraction(d)
            ]
    return None


def _put(session: Session, p: Poly, generator: int, value: Poly) -> Poly:
    field = session.domain.field
    images = [field.context.gen(v) for v in range(field.size)]
    images[field.size - 1 - generator] = value
    return p.compose(*images, ctx=field.context)


def _without_square(session: Session, q: Poly, sphere: Poly) -> Poly:
    """q less a multiple of the sphere's equation, so that a square that both have is gone."""
    own = {tuple(map(int, e)): c for e, c in sphere.terms()}
    for e, c in q.terms():
        exponents = tuple(map(int, e))
        if any(exponents) and exponents in own:
            return q - sphere * (c / own[exponents])
    return q


def _linear(
    session: Session, p: Poly, taken: frozenset[int], constant: bool
) -> tuple[Linear, int, Poly] | None:
    """Solve for a symbol that occurs linearly; constant: with a coefficient that is a number."""
    field = session.domain.field
    for k in sorted(field.occurring(p) - taken):
        g = field.generators[k]
        if g.kind != "free" or ".j" in g.name or any(k in field.made_of(o) for o in field.occurring(p)):
            continue
        column = field.size - 1 - k
        if max(int(e[column]) for e in p.monoms()) != 1:
            continue
        lead = {
            tuple(0 if v == column else int(x) for v, x in enumerate(e)): c for e, c in p.terms() if e[column]
        }
        rest = {tuple(map(int, e)): c for e, c in p.terms() if not e[column]}
        coefficient, remainder = field.context.from_dict(lead), field.context.from_dict(rest)
        if constant and not coefficient.is_constant():
            continue
        terms = _terms(session, coefficient), _terms(session, remainder)
        if terms[0] is None or terms[1] is None:
            continue
        value = -remainder / coefficient.leading_coefficient() if coefficient.is_constant() else remainder
        return Linear(star(g.name), terms[0], terms[1]), k, value
    return None


def _sphere(session: Session, p: Poly, taken: frozenset[int]) -> tuple[Sphere, frozenset[int]] | None:
    terms = _terms(session, p)
    if terms is None or session.domain.field.occurring(p) & taken:
        return None
    constant = sum((c for c, names in terms if not names), Fraction(0))
    squares = [(c, names) for c, names in terms if names]
    if any(list(names.values()) != [2] for _, names in squares) or len({c for c, _ in squares}) != 1:
        return None
    names = tuple(next(iter(n)) for _, n in reversed(squares))
    square = -constant / squares[0][0]
    radius = rational_root(square, 2) if square > 0 else None
    return (
        None
        if radius is None or len(names) < 2
        else (Sphere(names, radius), frozenset(session.domain.field.occurring(p)))
    )


def _terms(session: Session, p: Poly) -> Terms | None:
    """The terms of a relation over starred names; None where it has opaque generators or speaks of the
    neighbour.
    """
    field = session.domain.field
    result: list[tuple[Fraction, Mapping[str, int]]] = []
    for exponents, c in p.terms():
        names: dict[str, int] = {}
        for v, e in enumerate(exponents):
            if e:
                g = field.generators[field.size - 1 - v]
                if g.kind != "free" or ".j" in g.name:
                    return None
                names[star(g.name)] = int(e)
        result.append((Fraction(int(c.p), int(c.q)), names))
    return tuple(result)


def evaluated(terms: Terms, values: Mapping[str, Any]) -> Fraction:
    """The polynomial at the values."""
    total = Fraction(0)
    for c, names in terms:
        term = c
        for name, e in names.items():
            term *= values[name] ** e
        total += term
    return total
