"""Polynomial arithmetic of the kernel against FLINT."""

from __future__ import annotations

from fractions import Fraction

import flint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symctrl.kernel.certificate import Declined
from symctrl.kernel.polynomial import MAX_EXPONENT, Poly, Ring, monomial, powers, relation, variables

COUNT = 3
CONTEXT = flint.fmpq_mpoly_ctx.get(("a", "b", "c"), flint.Ordering.lex)
EXPONENTS = st.tuples(*[st.integers(0, 3)] * COUNT)
NUMBERS = st.fractions(-9, 9, max_denominator=7).filter(bool)
TERMS = st.dictionaries(EXPONENTS, NUMBERS, max_size=6)


def kernel(terms: dict[tuple[int, ...], Fraction]) -> Poly:
    return {monomial(list(enumerate(exponents))): c for exponents, c in terms.items()}


def oracle(terms: dict[tuple[int, ...], Fraction]) -> flint.fmpq_mpoly:
    return CONTEXT.from_dict({e: flint.fmpq(c.numerator, c.denominator) for e, c in terms.items()})


def back(p: Poly) -> flint.fmpq_mpoly:
    table = {}
    for m, c in p.items():
        exponents = dict(powers(m))
        table[tuple(exponents.get(k, 0) for k in range(COUNT))] = Fraction(c)
    return oracle(table)


@given(TERMS, TERMS)
def test_sums_and_products_are_those_of_flint(p, q):
    ring = Ring(COUNT)
    assert back(ring.add(kernel(p), kernel(q))) == oracle(p) + oracle(q)
    assert back(ring.mul(kernel(p), kernel(q))) == oracle(p) * oracle(q)


@given(TERMS, st.integers(0, 4))
def test_powers_are_those_of_flint(p, n):
    assert back(Ring(COUNT).power(kernel(p), n)) == oracle(p) ** n


@given(TERMS, TERMS)
def test_a_quotient_is_exact_or_none(p, q):
    ring = Ring(COUNT)
    if not q:
        return
    assert ring.quotient(ring.mul(kernel(p), kernel(q)), kernel(q)) == kernel(p)
    found = ring.quotient(kernel(p), kernel(q))
    exact = not divmod(oracle(p), oracle(q))[1]
    assert (found is not None) == exact
    if found is not None:
        assert back(found) * oracle(q) == oracle(p)


@given(TERMS, TERMS, TERMS)
def test_a_normal_form_by_tower_relations_is_the_remainder_of_flint(p, above, below):
    """Relations b^2 = f(a), c^2 = g(a, b) have coprime leads, so that the normal form is unique."""
    rules = [
        {(0, 2, 0): Fraction(-1)} | {(a, 0, 0): c for (a, _, _), c in below.items()},
        {(0, 0, 2): Fraction(-1)} | {(a, b % 2, 0): c for (a, b, _), c in above.items()},
    ]
    normal = Ring(COUNT).normal(kernel(p), [relation(kernel(r)) for r in rules])
    # FLINT ranks the first variable highest; reversing the order makes c the highest.
    reverse = flint.fmpq_mpoly_ctx.get(("c", "b", "a"), flint.Ordering.lex)
    images = list(reverse.gens())[::-1]
    rest = oracle(p).compose(*images, ctx=reverse)
    for _ in range(2):
        for rule in reversed(rules):
            rest = divmod(rest, oracle(rule).compose(*images, ctx=reverse))[1]
    assert back(normal).compose(*images, ctx=reverse) == rest


@given(EXPONENTS, EXPONENTS)
def test_later_variables_rank_higher(a, b):
    packed = [monomial(list(enumerate(e))) for e in (a, b)]
    assert (packed[0] < packed[1]) == (a[::-1] < b[::-1])


def test_packing_keeps_variables_apart():
    far = monomial([(0, 1), (7, MAX_EXPONENT), (4000, 2)])
    assert powers(far) == [(0, 1), (7, MAX_EXPONENT), (4000, 2)]
    assert variables({far: 1, 0: 3}) == {0, 7, 4000}
    assert powers(0) == []
    assert variables({}) == set()


def test_what_would_overflow_is_declined():
    ring = Ring(2)
    large = {monomial([(0, MAX_EXPONENT)]): 1}
    with pytest.raises(Declined, match="exponent"):
        ring.mul(large, {monomial([(0, 1)]): 1})
    with pytest.raises(Declined, match="digits"):
        ring.power({0: 3}, 2**20)
    with pytest.raises(Declined, match="generators"):
        Ring(5000)


def test_work_is_bounded():
    ring = Ring(2)
    with pytest.raises(Declined, match="steps"):
        ring.spend(10**9)
