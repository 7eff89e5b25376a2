"""Statements as values: what they are about, how they print, and what they refuse."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from symctrl.bounds import Bound, claimed
from symctrl.expr import Nonconforming, lift, symbol
from symctrl.statements import (
    Statement,
    conforms,
    equal,
    equivalent,
    implies,
    nonnegative,
    nonzero,
    positive,
    positive_definite,
    positive_semidefinite,
    skew_symmetric,
    sufficiently_small,
    symmetric,
)

x, y, k = symbol("x"), symbol("y"), symbol("k")
v, w, M = symbol("v", (3, 1)), symbol("w", (3, 1)), symbol("M", (3, 3))
N = symbol("N", (3, 2))

PRINTED: list[tuple[Statement, str, str, str]] = [
    (equal(v, w), "equal", "v = w", "v = w"),
    (equal(x, 0), "equal", "x = 0", "x = 0"),
    (symmetric(M), "symmetric", "M = M'", r"M = M^{\mathsf T}"),
    (skew_symmetric(M), "skew", "M = -M'", r"M = -M^{\mathsf T}"),
    (positive_definite(M), "positive_definite", "M is positive definite", r"M \succ 0"),
    (positive_semidefinite(M), "positive_semidefinite", "M is positive semidefinite", r"M \succeq 0"),
    (x >= y, "nonnegative", "x >= y", r"x \ge y"),
    (x <= y, "nonnegative", "x <= y", r"x \le y"),
    (x > 0, "positive", "x > 0", "x > 0"),
    (x < "1/3", "positive", "x < 1/3", r"x < \frac{1}{3}"),
    (v >= 0, "nonnegative", "v >= 0", r"v \ge 0"),
    (nonnegative(v), "nonnegative", "v >= 0", r"v \ge 0"),
    (positive(x), "positive", "x > 0", "x > 0"),
    (nonzero(x), "nonzero", "x != 0", r"x \ne 0"),
    (conforms(v), "conforms", "v is well formed, 3x1", r"v \in \mathbb{R}^{3 \times 1}"),
    (implies(x > 0, y > 0), "implies", "x > 0 implies y > 0", r"x > 0 \implies y > 0"),
    (
        implies([x > 0, nonzero(y)], equal(x, y)),
        "implies",
        "x > 0 and y != 0 implies x = y",
        r"x > 0,\; y \ne 0 \implies x = y",
    ),
    (equivalent(x > 0, y > 0), "equivalent", "x > 0 if and only if y > 0", r"x > 0 \iff y > 0"),
    (
        sufficiently_small(k, x > k),
        "sufficiently_small",
        "x > k for every sufficiently small k > 0",
        r"x > k \text{ for every sufficiently small } k > 0",
    ),
]


@pytest.mark.parametrize(("statement", "kind", "plain", "tex"), PRINTED, ids=[p[2] for p in PRINTED])
def test_a_statement_says_what_it_is(statement: Statement, kind: str, plain: str, tex: str) -> None:
    statement = claimed(statement)
    assert (statement.kind, statement.text(), statement.latex()) == (kind, plain, tex)
    assert plain in repr(statement)


RATIONALS = st.fractions(-5, 5, max_denominator=7)


@given(RATIONALS, RATIONALS)
def test_a_bound_is_about_the_quantity_that_is_then_nonnegative(a: Fraction, b: Fraction) -> None:
    left, right = lift(str(a)), lift(str(b))
    truths = {">=": a >= b, "<=": a <= b, ">": a > b, "<": a < b}
    bounds = {">=": left >= right, "<=": left <= right, ">": left > right, "<": left < right}
    for relation, written in bounds.items():
        bound = claimed(written)
        value = bound.expr.value
        assert value is not None
        assert (value > 0 if bound.strict else value >= 0) == truths[relation]


@given(RATIONALS)
def test_a_number_on_the_left_is_turned_round(a: Fraction) -> None:
    for bound in map(claimed, (a <= x, int(a) <= x, str(a) <= x)):
        assert isinstance(bound, Bound)
        assert (bound.left, bound.relation, bound.strict) == (x, ">=", False)
    assert (a > x).relation == "<"


def test_a_bound_against_zero_is_about_the_other_side_itself() -> None:
    assert claimed(v >= 0).expr is v
    assert claimed(0 <= v).expr is v  # noqa: SIM300
    assert claimed(v > 0).expr is v
    assert (claimed(v <= 0).expr.op, claimed(v <= 0).expr.args) == ("neg", (v,))
    assert claimed(lift(0) < v).expr is v


def test_a_bound_on_equal_shapes_is_componentwise() -> None:
    bound = claimed(v <= w)
    assert bound.expr.shape == (3, 1)
    assert bound.expr.args == (w, v)


def test_implies_keeps_hypotheses_claim_and_cofactors() -> None:
    given, claim = [equal(x, y), claimed(x > 0), equal(y, k)], equal(x, k)
    statement = implies(given, claim, by=[1, k])
    assert list(statement.hypotheses) == given
    assert statement.claim is claim
    assert [c.shape for c in statement.by] == [(1, 1), (1, 1)]
    assert implies(tuple(given), claim).by == ()
    with pytest.raises(ValueError, match="3 cofactors in by= for 2 equations"):
        implies(given, claim, by=[1, 2, 3])


ILL_FORMED: list[tuple[Callable[[], Any], str]] = [
    (lambda: equal(v, x), "left is 3x1, right is 1x1"),
    (lambda: equal(v, 0), "left is 3x1, right is 1x1"),
    (lambda: equal(M, N), "left is 3x3, right is 3x2"),
    (lambda: symmetric(N), "needs a square matrix, given 3x2"),
    (lambda: skew_symmetric(v), "needs a square matrix, given 3x1"),
    (lambda: positive_definite(N), "needs a square matrix, given 3x2"),
    (lambda: positive_semidefinite(v), "needs a square matrix, given 3x1"),
    (lambda: nonzero(v), r"nonzero\(norm\(v\)\)"),
    (lambda: v > x, "left is 3x1, right is 1x1"),
]


@pytest.mark.parametrize(("write", "words"), ILL_FORMED)
def test_shapes_that_do_not_go_together_are_nonconforming(write: Callable[[], Any], words: str) -> None:
    with pytest.raises(Nonconforming, match=words):
        write()


HELP: list[tuple[Callable[[], Any], str]] = [
    (lambda: bool(equal(x, y)), "no truth value"),
    (lambda: equal(x, y) and equal(y, k), "list of conditions"),
    (lambda: 0 < x < 1, "two conditions instead of a chain"),
    (lambda: equal(equal(x, y), x), r"was given the claim x = y"),  # type: ignore[arg-type]
    (lambda: positive(x > 0), "was given the claim x > 0"),  # type: ignore[arg-type]
    (lambda: implies(x, y > 0), "a hypothesis is .* not a bare expression"),  # type: ignore[arg-type]
    (lambda: implies([x > 0, True], y > 0), "a hypothesis is .* not True"),  # type: ignore[list-item]
    (lambda: implies([], y > 0), "at least one hypothesis"),
    (lambda: implies(x > 0, y), "a claim is .* not a bare expression"),  # type: ignore[arg-type]
    (lambda: implies(x > 0, implies(x > 0, y > 0)), "a claim is"),  # type: ignore[arg-type]
    (lambda: equivalent(x, y > 0), "a condition is"),  # type: ignore[arg-type]
    (lambda: sufficiently_small(2 * k, y > 0), "a scalar symbol"),
    (lambda: sufficiently_small(v, y > 0), "a scalar symbol"),
    (lambda: sufficiently_small(k, y), "a claim is"),  # type: ignore[arg-type]
    (lambda: sufficiently_small(k, equal(y, 0)), "is an equation"),
]


@pytest.mark.parametrize(("write", "words"), HELP)
def test_what_is_no_statement_is_answered_with_what_is(write: Callable[[], Any], words: str) -> None:
    with pytest.raises(TypeError, match=words):
        write()
