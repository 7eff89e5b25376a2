"""A sign by a combination: a value as a sum of positive multiples of products of assumptions and squares.

What is quick comes first: a known sign, factors, squares. Then the value is reduced to simpler ones, by its
parts, by forms of assumed matrices and by completed squares; a linear programme is last.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial, reduce
from itertools import chain
from operator import mul
from typing import Any

from symctrl.decide.cases import by_cases
from symctrl.decide.coefficients import coefficient_of
from symctrl.decide.factors import Term, as_product, is_tied, opened, parts_of
from symctrl.decide.forms import Form, form_of, without_forms
from symctrl.decide.logarithms import by_logarithms
from symctrl.decide.programme import by_programme, candidates, inside_logarithm
from symctrl.decide.session import Session
from symctrl.decide.squares import as_squares, completed, completed_with_multiplier
from symctrl.decide.summed import terms_of_totals
from symctrl.decide.written import set_aside, written
from symctrl.domains.field import Exact, Poly

__all__ = ["Known", "entry_of", "form_of", "terms_of"]

MAX_TERMS = 3000  # of a polynomial for whose sign a proof is looked for
MAX_OCCURRING = 16  # symbols of a polynomial for which a programme is set up
MAX_MULTIPLIERS = 4


@dataclass(frozen=True)
class Known:
    """The author's advice as exact polynomials: a positive multiplier, squares, and forms that are not
    negative.
    """

    times: Poly | None = None
    squares: tuple[Poly, ...] = ()
    forms: tuple[Form, ...] = ()


# The entry of a proof, with multipliers


def entry_of(session: Session, value: Exact, strict: bool, known: Known) -> dict[str, Any] | None:
    """The entry of a combination for one value, with the author's multiplier where there is one; None if none
    is found.
    """
    if known.times is not None:
        return _scaled_entry(session, value, strict, known, [known.times])
    if session.totals.keys() & {k for q in value.values() for k in session.domain.field.occurring(q)}:
        of_sums = None if strict else terms_of_totals(session, value)
        return None if of_sums is None else {"terms": of_sums}
    terms = terms_of(session, value, strict, known)
    if terms is not None:
        return {"terms": terms}
    if len(session.carrier(value)) > MAX_TERMS:
        return None
    found = _by_fact(session, value, strict)
    if found is None and not strict:
        found = _by_scaled_completion(session, value, known) or set_aside(
            session,
            session.domain.field.normal(session.carrier(value)),
            lambda left: _short_entry(session, left, known),
        )
    again = partial(entry_of, session, strict=strict, known=known)
    if found is None:
        p = session.domain.field.normal(session.carrier(value))
        plain = partial(entry_of, session, strict=False, known=Known())
        found = by_logarithms(session, p, plain, lambda: again(value))
    if found is None:
        found = _by_multipliers(session, value, strict, known)
    return by_cases(session, value, again) if found is None else found


def _short_entry(session: Session, value: Exact, known: Known) -> dict[str, Any] | None:
    """The entry of what is left beside a square, without another multiplier than that of a completion."""
    terms = terms_of(session, value, False, known)
    return _by_scaled_completion(session, value, known) if terms is None else {"terms": terms}


def _by_fact(session: Session, value: Exact, strict: bool) -> dict[str, Any] | None:
    """The value times something positive is itself known, as the minor of a matrix that is assumed to be
    definite.
    """
    field, signs = session.domain.field, session.domain.signs
    p = field.normal(session.carrier(value))
    if p.is_zero():
        return None
    for fact, kind in signs.facts:
        if kind == "positive" or (kind == "nonnegative" and not strict):
            quotient, rest = divmod(fact, p)
            if rest.is_zero() and signs.of(quotient) == "positive":
                return {"times": [field.json(quotient)], "terms": [["1", [field.json(fact)], []]]}
    return None


def _by_scaled_completion(session: Session, value: Exact, known: Known) -> dict[str, Any] | None:
    """A square that is completed with a multiplier, and the terms of the rest."""
    field = session.domain.field
    step = completed_with_multiplier(session, field.normal(session.carrier(value)))
    if step is None:
        return None
    times, term, rest = step
    terms = _terms_of_polynomial(session, rest, False, known)
    return None if terms is None else {"times": [field.json(times)], "terms": [term, *terms]}


def _by_multipliers(session: Session, value: Exact, strict: bool, known: Known) -> dict[str, Any] | None:
    """The first multiplier with which there are terms."""
    tried = [*_multipliers(session), *_turned(session, value)]
    scaled = (_scaled_entry(session, value, strict, known, times) for times in tried)
    return next((entry for entry in scaled if entry is not None), None)


def _scaled_entry(
    session: Session, value: Exact, strict: bool, known: Known, times: Sequence[Poly]
) -> dict[str, Any] | None:
    """The entry of the value times factors that are known to be positive."""
    field = session.domain.field
    scaled = reduce(mul, times, session.carrier(value))
    terms = _terms_of_polynomial(session, field.normal(scaled), strict, known)
    return None if terms is None else {"terms": terms, "times": [field.json(factor) for factor in times]}


def _multipliers(session: Session) -> list[list[Poly]]:
    """Positive polynomials with which assumed equations rewrite more: their positive factors, and the
    positive generators that lead them; and the squares of these. Each as its factors.
    """
    field, signs = session.domain.field, session.domain.signs
    if session.cases:
        return [[a] for a in _leading(session)][:MAX_MULTIPLIERS]
    zeros = [p for _, p in session.zeros] + [new.polynomial for new, _ in session.derived]
    leading: list[Poly] = []
    found: list[list[Poly]] = []
    for p in zeros:
        for v, e in enumerate(p.monomial(0)):
            k = field.size - 1 - v
            if e and signs.generator.get(k) == "positive":
                leading += [field.variable(k)] * int(e)
        found.append([f for f, _ in p.factor()[1] if signs.of(f) == "positive"])
    found += [[a] for k in range(len(field.generators)) for a in inside_logarithm(session, k)]
    distinct = [p for k, p in enumerate([leading, *found]) if p and p not in [leading, *found][:k]]
    return [power for p in distinct[:MAX_MULTIPLIERS] for power in (p, [*p, *p])]


def _turned(session: Session, value: Exact) -> list[list[Poly]]:
    """a + b for a - b, where it is known to be positive."""
    p = session.domain.field.normal(session.carrier(value))
    if len(p) != 2:
        return []
    q = session.domain.field.context.from_dict({m: abs(c) for m, c in p.to_dict().items()})
    return [[q]] if q not in (p, -p) and session.domain.signs.of(q) == "positive" else []


def _leading(session: Session) -> list[Poly]:
    """Positive coefficients of symbols of unknown sign in what the cases suppose."""
    field, signs = session.domain.field, session.domain.signs
    found: list[Poly] = []
    for b in map(field.normal, session.cases.values()):
        for k in sorted(field.occurring(b)):
            a = coefficient_of(field, b, {k: 1})
            for p in (a, -a):
                if not p.is_constant() and signs.of(p) == "positive" and p not in found:
                    found.append(p)
    return found


# The terms


def terms_of(session: Session, value: Exact, strict: bool, known: Known | None = None) -> list[Term] | None:
    """The terms of a combination that proves the value nonnegative (positive if strict), or None."""
    known = known or Known()
    p = session.carrier(value)
    if len(p) > MAX_TERMS:
        return None
    terms = _by_sign(session, p, strict)
    if terms is not None:
        return terms
    p = session.domain.field.normal(p)
    if p.is_zero():
        return None if strict else []
    terms = as_product(session, p, strict) or (None if strict else as_squares(session, p))
    if terms is not None:
        return terms
    parts = [] if strict else parts_of(session, p)
    if parts:
        terms = _by_parts(session, parts, known)
        if terms or not is_tied(session, p):
            return terms
    terms = _by_reduction(session, p, strict, known)
    if not terms and not strict:
        terms = _by_open_factor(session, p, known)
    return terms or _by_programme(session, p, strict, known)


def _terms_of_polynomial(session: Session, p: Poly, strict: bool, known: Known) -> list[Term] | None:
    return terms_of(session, session.domain.polynomial(p), strict, known)


def _by_sign(session: Session, p: Poly, strict: bool) -> list[Term] | None:
    """The sign is known of the polynomial as a whole, as it is or in normal form."""
    field = session.domain.field
    for form in (p, field.normal(p)):
        sign = session.domain.signs.of(form)
        if sign == "positive" or (sign == "nonnegative" and not strict):
            return [["1", [field.json(form)], []]] if not form.is_zero() else []
    return None


def _by_parts(session: Session, parts: Sequence[Poly], known: Known) -> list[Term] | None:
    """Each part by itself."""
    found: list[Term] = []
    for part in parts:
        terms = _terms_of_polynomial(session, part, False, known)
        if terms is None:
            return None
        found += terms
    return found


def _by_reduction(session: Session, p: Poly, strict: bool, known: Known) -> list[Term] | None:
    """A form of an assumed matrix or a completed square, and the terms of the rest."""
    steps: Iterator[tuple[Term, Poly]] = chain(without_forms(session, p), completed(session, p))
    for term, rest in steps:
        terms = _terms_of_polynomial(session, rest, strict, known)
        if terms is not None:
            return [term, *terms]
    return None


def _by_open_factor(session: Session, p: Poly, known: Known) -> list[Term] | None:
    """Factors of known sign and squares apart, the sign of what is left is that of p."""
    found = opened(session, p)
    terms = None if found is None else _terms_of_polynomial(session, found.left, False, known)
    return None if found is None or terms is None else found.around(terms)


def _by_programme(session: Session, p: Poly, strict: bool, known: Known) -> list[Term] | None:
    """By a linear programme with few candidates, then with many."""
    if len(session.domain.field.occurring(p)) > MAX_OCCURRING:
        return None
    tries = [(known.squares, False), (known.squares, True)]
    own = written(session)
    for squares, wide in [*tries, *([((*known.squares, *own), False)] if own else [])]:
        tried = candidates(session, p, squares, known.forms, wide)
        terms = by_programme(session, p, strict, tried)
        if terms:
            return terms
    return None
