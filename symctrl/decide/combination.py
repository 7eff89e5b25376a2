"""A sign by a combination: a value as a sum of positive multiples of products of assumptions and squares.

The candidates are assumptions, their pairwise products and monomials, each times squares; a linear programme
in floating point chooses among them, and the multipliers are solved for exactly. A quadratic form in the
symbols of unknown sign is completed to squares by its exact LDLᵀ."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from itertools import combinations, combinations_with_replacement
from operator import mul
from typing import Any

import flint
import numpy as np

from symctrl.decide.definiteness import decide_matrix
from symctrl.decide.forms import forms_in
from symctrl.decide.identity import vanishes
from symctrl.decide.session import Session
from symctrl.domains.field import Exact, Poly, coefficient

MAX_CANDIDATES = 1500
MAX_MONOMIALS = 400
MAX_PRODUCTS = 25
MAX_TERMS = 3000  # of a polynomial for whose sign a proof is looked for
MAX_OCCURRING = 16
MAX_PAIRED = 8  # symbols whose sums and differences are tried
MAX_REPEATED = 4
MAX_MULTIPLIERS = 4
TINY = 1e-9


@dataclass(frozen=True)
class Candidate:
    """A nonnegative polynomial: the product of assumptions (by index) or known polynomials, times squares."""

    value: Poly
    given: tuple[Any, ...]
    squares: tuple[Poly, ...]


@dataclass(frozen=True)
class Known:
    """The author's advice as exact polynomials: a positive multiplier, squares, and forms that are not
    negative.
    """

    times: Poly | None = None
    squares: tuple[Poly, ...] = ()
    forms: tuple[tuple[Any, Poly], ...] = ()


def entry_of(session: Session, value: Exact, strict: bool, known: Known) -> dict[str, Any] | None:
    """The entry of a combination for one value, with the author's multiplier where there is one; None if none
    is found.
    """
    if known.times is not None:
        return _scaled_entry(session, value, strict, known, [known.times])
    if session.totals:
        return {"terms": []} if not strict and vanishes(session, value) else None
    terms = terms_of(session, value, strict, known)
    if terms is not None:
        return {"terms": terms}
    if len(session.carrier(value)) > MAX_TERMS:
        return None
    found = _by_fact(session, value, strict) or (
        None if strict else _by_scaled_completion(session, value, known)
    )
    for times in _multipliers(session) if found is None else ():
        found = found or _scaled_entry(session, value, strict, known, times)
    return found


def _scaled_entry(
    session: Session, value: Exact, strict: bool, known: Known, times: Sequence[Poly]
) -> dict[str, Any] | None:
    """The entry of the value times factors that are known to be positive."""
    field = session.domain.field
    scaled = reduce(mul, times, session.carrier(value))
    terms = terms_of(session, session.domain.polynomial(field.normal(scaled)), strict, known)
    return None if terms is None else {"terms": terms, "times": [field.json(factor) for factor in times]}


def _multipliers(session: Session) -> list[list[Poly]]:
    """Positive polynomials with which assumed equations rewrite more: their positive factors, and the
    positive generators that lead them; and the squares of these. Each as its factors.
    """
    field, signs = session.domain.field, session.domain.signs
    zeros = [p for _, p in session.zeros] + [new.polynomial for new, _ in session.derived]
    leading: list[Poly] = []
    found: list[list[Poly]] = []
    for p in zeros:
        for v, e in enumerate(p.monomial(0)):
            k = field.size - 1 - v
            if e and signs.generator.get(k) == "positive":
                leading += [field.variable(k)] * int(e)
        found.append([f for f, _ in p.factor()[1] if signs.of(f) == "positive"])
    distinct = [p for k, p in enumerate([leading, *found]) if p and p not in [leading, *found][:k]]
    return [power for p in distinct[:MAX_MULTIPLIERS] for power in (p, [*p, *p])]


def _by_fact(session: Session, value: Exact, strict: bool) -> dict[str, Any] | None:
    """The value times something positive is itself known, as the minor of a matrix that is assumed to be
    definite.
    """
    field, signs = session.domain.field, session.domain.signs
    p = field.normal(session.carrier(value))
    for fact, kind in signs.facts:
        if kind == "positive" or (kind == "nonnegative" and not strict):
            quotient, rest = divmod(fact, p)
            if rest.is_zero() and signs.of(quotient) == "positive":
                return {"times": [field.json(quotient)], "terms": [["1", [field.json(fact)], []]]}
    return None


def terms_of(
    session: Session, value: Exact, strict: bool, known: Known | None = None
) -> list[list[Any]] | None:
    """The terms of a combination that proves the value nonnegative (positive if strict), or None."""
    known = known or Known()
    p = session.carrier(value)
    if len(p) > MAX_TERMS:
        return None
    for form in (p, session.domain.field.normal(p)):
        sign = session.domain.signs.of(form)
        if sign == "positive" or (sign == "nonnegative" and not strict):
            return [["1", [session.domain.field.json(form)], []]] if not form.is_zero() else []
    p = session.domain.field.normal(p)
    if p.is_zero():
        return None if strict else []
    found = _by_factors(session, p, strict) or (_by_squares(session, p) if not strict else None)
    if found is None and not strict and (parts := _parts(session, p)):
        found = _by_parts(session, parts, known)
        if not _is_tied(session, p):
            return found
    found = found or _by_forms(session, p, strict, known) or _by_completion(session, p, strict, known)
    found = found or (_by_open_factor(session, p, known) if not strict else None)
    for wide in (False, True) if len(session.domain.field.occurring(p)) <= MAX_OCCURRING else ():
        found = found or _by_programme(session, p, strict, _candidates(session, p, known, wide))
    return found


def _by_forms(session: Session, p: Poly, strict: bool, known: Known) -> list[list[Any]] | None:
    """A quadratic form of an assumed definite matrix, and the rest without its entries."""
    field = session.domain.field
    for factor, value in forms_in(session, p):
        c = dict(p.to_dict()).get(tuple(value.monomial(0)), 0) / value.leading_coefficient()
        rest = p - value * c
        entries = field.occurring(value) - field.occurring(rest)
        if c > 0 and len(entries) > 1:
            terms = terms_of(session, session.domain.polynomial(rest), strict, known)
            if terms is not None:
                return [[str(c), [factor], []], *terms]
    return None


def _by_factors(session: Session, p: Poly, strict: bool) -> list[list[Any]] | None:
    """p as one product of factors of known sign and squares."""
    field, signs = session.domain.field, session.domain.signs
    c, exponents = session.domain.factor_polynomial(p)
    if c <= 0:
        return None
    known, squares = [], []
    for k, e in sorted(exponents.items()):
        f = field.factors[k]
        sign = signs.of(f)
        if e % 2 and not (sign == "positive" or (sign == "nonnegative" and not strict)):
            return None
        if (
            strict
            and e % 2 == 0
            and sign not in ("positive", "nonzero")
            and k not in session.domain.divided()
        ):
            return None
        certain = e if strict and sign == "positive" and e <= MAX_REPEATED else e % 2
        known += [field.json(f)] * certain
        if e > certain:
            squares.append(field.json(f ** (e // 2)))
    return [[str(c), known, squares]]


def _parts(session: Session, p: Poly) -> list[Poly]:
    """Parts that share no symbol of unknown sign; none where there is only one."""
    field, signs = session.domain.field, session.domain.signs
    groups: list[tuple[set[int], dict[tuple[int, ...], Any]]] = []
    for exponents, c in p.terms():
        columns = {field.size - 1 - v for v, e in enumerate(exponents) if e}
        made_of = columns.union(*(field.made_of(k) for k in columns if field.generators[k].kind != "sum"))
        open_ = {k for k in made_of if signs.generator.get(k) not in ("positive", "nonnegative")}
        open_ -= {k for k in open_ if _is_degree(session, k)}
        merged = {tuple(map(int, exponents)): c}
        rest = []
        for own, terms in groups:
            if own & open_ or (not own and not open_):
                open_ |= own
                merged |= terms
            else:
                rest.append((own, terms))
        groups = [*rest, (open_, merged)]
    return [field.context.from_dict(terms) for _, terms in groups] if len(groups) > 1 else []


def _by_parts(session: Session, parts: Sequence[Poly], known: Known) -> list[list[Any]] | None:
    """Each part by itself; where no assumption ties their symbols and one is negative, so is the sum
    somewhere.
    """
    found: list[list[Any]] = []
    for part in parts:
        terms = terms_of(session, session.domain.polynomial(part), False, known)
        if terms is None:
            return None
        found += terms
    return found


def _is_tied(session: Session, p: Poly) -> bool:
    """Does an assumption speak of a symbol of unknown sign in p, or is there a part without one?"""
    field, signs = session.domain.field, session.domain.signs
    open_ = {k for k in field.occurring(p) if signs.generator.get(k) not in ("positive", "nonnegative")}
    spoken = [*field.relations, *(fact for fact, _ in signs.facts)]
    alone = any(not any(e[field.size - 1 - k] for k in open_) for e in p.monoms())
    return alone or any(field.occurring(q) & open_ for q in spoken)


def _is_degree(session: Session, k: int) -> bool:
    """Is the generator a number of neighbours, which ties no symbols together?"""
    g = session.domain.field.generators[k]
    return g.kind == "sum" and bool(g.argument.is_constant())


def _by_open_factor(session: Session, p: Poly, known: Known) -> list[list[Any]] | None:
    """Factors of known sign and squares apart, the sign of what is left is that of p."""
    field, signs = session.domain.field, session.domain.signs
    c, exponents = session.domain.factor_polynomial(p)
    outside: list[Any] = []
    squares: list[Any] = []
    left = field.polynomial(1 if c > 0 else -1)
    for k, e in sorted(exponents.items()):
        f = field.factors[k]
        if signs.of(f) in ("positive", "nonnegative"):
            outside += [field.json(f)] * e
            continue
        squares += [field.json(f ** (e // 2))] if e > 1 else []
        left = left * f if e % 2 else left
    if not (outside or squares) or left.is_constant():
        return None
    terms = terms_of(session, session.domain.polynomial(left), False, known)
    if terms is None:
        return None
    return [[str(Fraction(w) * abs(c)), [*outside, *given], [*squares, *own]] for w, given, own in terms]


def _by_squares(session: Session, p: Poly) -> list[list[Any]] | None:
    """p as a quadratic form in monomials of degree at most one, if its exact LDLᵀ has no negative pivot."""
    field = session.domain.field
    if p.total_degree() > 2:
        return None
    variables = sorted(field.occurring(p))
    basis = [field.polynomial(1), *(field.variable(k) for k in variables)]
    gram = [[Fraction(0)] * len(basis) for _ in basis]
    place = {k: n + 1 for n, k in enumerate(variables)}
    for exponents, c in p.terms():
        at = [place[field.size - 1 - v] for v, e in enumerate(exponents) for _ in range(int(e))]
        i, j = [*at, 0, 0][:2]
        number = Fraction(int(c.p), int(c.q))
        gram[i][j] += number / 2
        gram[j][i] += number / 2
    answer = decide_matrix(gram)
    leaf = answer.leaf
    if leaf is None or "ldl" not in leaf:
        return None
    lower, diagonal = leaf["ldl"]["lower"], leaf["ldl"]["diagonal"]
    result = []
    for k, d in enumerate(diagonal):
        if Fraction(d) == 0:
            continue
        square = field.polynomial(0)
        for r in range(k, len(basis)):
            square = (
                square + basis[r] * field.polynomial(Fraction(lower[r][k])).leading_coefficient()
                if Fraction(lower[r][k])
                else square
            )
        result.append([str(d), [], [field.json(square)]])
    return result


def _by_completion(session: Session, p: Poly, strict: bool, known: Known) -> list[list[Any]] | None:
    """A completed square a (x + b)^2, with a known to be positive, and the rest without x.

    Of a form that is not negative any such square can come first: the first that there is decides.
    """
    field, signs = session.domain.field, session.domain.signs
    for k in sorted(field.occurring(p)):
        if signs.generator.get(k) is not None or field.generators[k].kind != "free":
            continue
        a, b = (_coefficient(session, p, k, power) for power in (2, 1))
        if a.is_zero() or p.degrees()[field.size - 1 - k] != 2 or signs.of(a) != "positive":
            continue
        half, rest = divmod(b, 2 * a)
        if not rest.is_zero():
            continue
        square = field.variable(k) + half
        left = p - a * square * square
        terms = terms_of(session, session.domain.polynomial(left), strict, known)
        if terms is None:
            return None
        c, factors = (str(coefficient(a)), []) if a.is_constant() else ("1", [field.json(a)])
        return [[c, factors, [field.json(square)]], *terms]
    return None


def _by_scaled_completion(session: Session, value: Exact, known: Known) -> dict[str, Any] | None:
    """4 a (a x^2 + b x + c) = (2 a x + b)^2 + (4 a c - b^2), with a known to be positive."""
    field, signs = session.domain.field, session.domain.signs
    p = field.normal(session.carrier(value))
    for k in sorted(field.occurring(p)) if not p.is_zero() else ():
        if signs.generator.get(k) is not None or field.generators[k].kind != "free":
            continue
        a, b, c = (_coefficient(session, p, k, power) for power in (2, 1, 0))
        if a.is_zero() or p.degrees()[field.size - 1 - k] != 2 or signs.of(a) != "positive":
            continue
        if divmod(b, 2 * a)[1].is_zero():
            continue  # then the square is completed without a multiplier
        terms = terms_of(session, session.domain.polynomial(4 * a * c - b * b), False, known)
        if terms is None:
            return None
        square = 2 * a * field.variable(k) + b
        return {"times": [field.json(4 * a)], "terms": [["1", [], [field.json(square)]], *terms]}
    return None


def _coefficient(session: Session, p: Poly, k: int, power: int) -> Poly:
    """The coefficient of a power of a generator."""
    field = session.domain.field
    column = field.size - 1 - k
    kept = {
        tuple(0 if v == column else int(x) for v, x in enumerate(e)): c
        for e, c in p.terms()
        if e[column] == power
    }
    return field.context.from_dict(kept)


def _by_programme(
    session: Session, p: Poly, strict: bool, candidates: Sequence[Candidate]
) -> list[list[Any]] | None:
    from scipy.optimize import linprog

    field = session.domain.field
    monomials: dict[tuple[int, ...], int] = {}
    columns = []
    for candidate in candidates:
        columns.append(
            {monomials.setdefault(tuple(map(int, e)), len(monomials)): c for e, c in candidate.value.terms()}
        )
    target = {monomials.setdefault(tuple(map(int, e)), len(monomials)): c for e, c in p.terms()}
    if not columns or len(monomials) > 20 * MAX_MONOMIALS:
        return None
    matrix = np.zeros((len(monomials), len(columns)))
    for n, column in enumerate(columns):
        for m, c in column.items():
            matrix[m, n] = float(Fraction(int(c.p), int(c.q)))
    right = np.zeros(len(monomials))
    for m, c in target.items():
        right[m] = float(Fraction(int(c.p), int(c.q)))
    sure = [_is_sure(session, candidate) for candidate in candidates]
    cost = np.array([-1.0 if strict and s else 1e-3 for s in sure])
    bounds = [(0, 1e6)] * len(columns)
    widths = np.maximum(np.abs(matrix).max(axis=0), 1e-300)
    height = max(float(np.abs(right).max()), 1e-300)
    answer = linprog(cost, A_eq=matrix / widths, b_eq=right / height, bounds=bounds, method="highs")
    if answer.status != 0:
        return None
    chosen = [n for n in range(len(columns)) if answer.x[n] > TINY]
    weights = _exact_weights([columns[n] for n in chosen], target)
    if weights is None or any(w < 0 for w in weights):
        return None
    if strict and not any(w > 0 and sure[n] for n, w in zip(chosen, weights, strict=True)):
        return None
    return [
        [str(w), list(candidates[n].given), [field.json(s) for s in candidates[n].squares]]
        for n, w in zip(chosen, weights, strict=True)
        if w
    ]


def _exact_weights(columns: Sequence[dict[int, Any]], target: dict[int, Any]) -> list[Fraction] | None:
    """The exact solution of sum w_n column_n = target, if there is one."""
    if not columns:
        return [] if not target else None
    rows = sorted({m for column in columns for m in column} | set(target))
    system = flint.fmpq_mat(
        len(rows), len(columns) + 1, [c.get(m, flint.fmpq(0)) for m in rows for c in (*columns, target)]
    )
    reduced, rank = system.rref()
    weights = [Fraction(0)] * len(columns)
    for r in range(rank):
        pivot = next(c for c in range(len(columns) + 1) if reduced[r, c] != 0)
        if pivot == len(columns):
            return None
        last = reduced[r, len(columns)]
        weights[pivot] = Fraction(int(last.p), int(last.q))
    return weights


def _candidates(session: Session, p: Poly, known: Known, wide: bool) -> list[Candidate]:
    """The author's forms and squares with every product of assumptions first, then monomials and their pairs.

    wide: all products by themselves before any square, and squares with a constant in them.
    """
    field = session.domain.field
    one = field.polynomial(1)
    facts = [(one, ())] + [(q, (k,)) for k, q in _facts(session)]
    products = list(facts)
    products += [(a * b, (*x, *y)) for (a, x), (b, y) in combinations_with_replacement(facts[1:], 2)]
    products += [
        (a * b * c, (*x, *y, *z)) for (a, x), (b, y), (c, z) in combinations(facts[1:], 3) if len(facts) < 10
    ]
    found: list[Candidate] = []
    degree = p.total_degree()
    for form, value in [*known.forms, *(forms_in(session, p) if wide else ())]:
        for product, given in products:
            found.append(Candidate(field.normal(product * value), (*given, form), ()))
    if wide:
        found += [
            Candidate(field.normal(q), given, ()) for q, given in products if q.total_degree() <= degree + 2
        ]
    for product, given in products:
        for square in [*known.squares, *_squares(session, p, wide)]:
            advised = any(square is known_square for known_square in known.squares)
            if not advised and product.total_degree() + 2 * square.total_degree() > degree + 2:
                continue
            squares = () if square == one else (square,)
            found.append(Candidate(field.normal(product * square * square), given, squares))
            if len(found) >= MAX_CANDIDATES:
                return found
    return found


def _facts(session: Session) -> Iterator[tuple[Any, Poly]]:
    """The nonnegative assumptions at node i, by index; then opaque generators that are not negative, by
    POLY.
    """
    field = session.domain.field
    for k, assumption in enumerate(session.problem.given):
        if assumption.kind in ("positive", "nonnegative"):
            yield k, session.carrier(session.at(assumption.of[0], {"i": "i"}))
    for k, g in enumerate(field.generators):
        if g.kind in ("root", "abs", "exp", "power"):
            yield field.json(field.variable(k)), field.variable(k)
        for beside in _beside(session, k):
            yield field.json(beside), beside


def _beside(session: Session, k: int) -> list[Poly]:
    """|p| - p and |p| + p for an absolute value, 1 - s and 1 + s for a sign: not negative."""
    field = session.domain.field
    g = field.generators[k]
    if g.kind not in ("abs", "sign"):
        return []
    inner = g.argument if g.kind == "abs" else field.variable(k)
    bound = field.variable(k) if g.kind == "abs" else field.polynomial(1)
    return [bound - inner, bound + inner]


def _squares(session: Session, p: Poly, wide: bool) -> list[Poly]:
    """Monomials whose squares may occur, their sums and differences in pairs; if wide, without the symbols of
    known sign where there are many, and in pairs with 1.
    """
    field = session.domain.field
    opaque = {k for k, g in enumerate(field.generators) if g.kind not in ("free", "sum")}
    related = {
        k for r in field.relations for k in field.occurring(r) if field.occurring(r) & field.occurring(p)
    }
    occurring = field.occurring(p) | opaque | related
    if wide and len(occurring) > MAX_PAIRED:
        occurring -= {k for k, sign in session.domain.signs.generator.items() if sign == "positive"}
    one = field.polynomial(1)
    variables = [field.variable(k) for k in sorted(occurring)]
    ends = [one, *variables] if wide else variables
    few = len(variables) <= MAX_PAIRED
    pairs = [a + s * b for a, b in combinations(ends, 2) for s in (1, -1)] if few else []
    products = [a * b for a, b in combinations_with_replacement(variables, 2)] if p.total_degree() > 3 else []
    minors = [a - b for a, b in combinations(products, 2)] if len(products) <= MAX_PRODUCTS else []
    return [one, *variables, *pairs, *products, *minors]


def _is_sure(session: Session, candidate: Candidate) -> bool:
    kinds = [
        session.problem.given[g].kind == "positive" if isinstance(g, int) else False for g in candidate.given
    ]
    return all(kinds) and not candidate.squares


def form_of(
    session: Session, matrix: Sequence[Exact], x: Sequence[Exact]
) -> tuple[dict[str, Any], Poly] | None:
    """xᵀPx for a P (column by column) that is assumed to be definite, as a term's factor and as a
    polynomial.
    """
    domain, n = session.domain, len(x)
    for k, assumption in enumerate(session.problem.given):
        if assumption.size != n or not assumption.kind.startswith("positive_"):
            continue
        values = [session.at(of, {"i": "i"}) for of in assumption.of]
        if not all(domain.is_zero(domain.sub_(a, b)) for a, b in zip(matrix, values, strict=True)):
            continue
        total: Exact = {}
        for r in range(n):
            for c in range(n):
                total = domain.add_(total, domain.mul_(domain.mul_(x[r], values[r + n * c]), x[c]))
        if set(domain.simplified(total)) <= {()} and all(set(domain.simplified(e)) <= {()} for e in x):
            vector = [domain.field.json(domain.simplified(e).get((), domain.field.polynomial(0))) for e in x]
            return {"given": k, "vector": vector}, domain.simplified(total).get(
                (), domain.field.polynomial(0)
            )
    return None
