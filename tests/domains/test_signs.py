"""Signs: what is known of a polynomial holds at every point that meets the assumptions."""

from fractions import Fraction

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from symctrl.domains.field import Field
from symctrl.domains.signs import Signs

HOLDS = {"positive": lambda v: v > 0, "nonnegative": lambda v: v >= 0, "nonzero": lambda v: v != 0}
halves = st.sampled_from([Fraction(n, 2) for n in range(-3, 4) if n])
terms = st.dictionaries(st.tuples(*[st.integers(0, 3)] * 3), halves, max_size=3)
point = st.tuples(*[st.sampled_from([Fraction(n, 3) for n in range(-6, 7)])] * 3)


def polynomial(field, wanted):
    total = field.polynomial(0)
    for powers, c in wanted.items():
        term = field.polynomial(c)
        for k, e in enumerate(powers):
            term = term * field.variable(k) ** e
        total = total + term
    return total


def number(wanted, at):
    return sum((c * at[0] ** e[0] * at[1] ** e[1] * at[2] ** e[2] for e, c in wanted.items()), Fraction(0))


@given(
    st.lists(st.tuples(terms, st.sampled_from(sorted(HOLDS))), max_size=3),
    st.tuples(*[st.sampled_from([None, *sorted(HOLDS)])] * 3),
    terms,
    st.lists(point, min_size=5, max_size=5),
)
@settings(max_examples=300, deadline=None)
def test_what_is_known_is_true(facts, kinds, asked, places):
    field = Field(["x", "y", "z"], 1)
    signs = Signs(field)
    for k, kind in enumerate(kinds):
        if kind:
            signs.learn(field.variable(k), kind)
    for wanted, kind in facts:
        signs.learn(polynomial(field, wanted), kind)
    known = signs.of(polynomial(field, asked))
    assume(known is not None)
    for at in places:
        if all(kind is None or HOLDS[kind](v) for kind, v in zip(kinds, at, strict=True)) and all(
            HOLDS[kind](number(wanted, at)) for wanted, kind in facts
        ):
            assert HOLDS[known](number(asked, at)), (asked, known, at)


@pytest.mark.parametrize(
    ("learnt", "known"),
    [
        (["positive", "nonnegative"], "positive"),
        (["nonnegative", "positive"], "positive"),
        (["nonnegative", "nonzero"], "positive"),
        (["nonzero"], "nonzero"),
        (["nonnegative"], "nonnegative"),
        ([], None),
    ],
)
def test_what_is_known_twice_is_put_together(learnt, known):
    field = Field(["x"], 1)
    signs = Signs(field)
    for kind in learnt:
        signs.learn(field.variable(0), kind)
    assert signs.of(field.variable(0)) == known
