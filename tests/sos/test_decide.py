"""What is decided about polynomials: never wrongly, with certificates that others can check too."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from symctrl.certify import canonical
from symctrl.kernel.check import check_text
from symctrl.sos.basis import half_newton, monomials, parities, split
from symctrl.sos.deadline import Deadline
from symctrl.sos.decide import decide, lower_bound
from symctrl.sos.problem import Problem, read
from symctrl.sos.ring import from_terms, ring, to_fmpq, value_at
from tests.sos.check import holds
from tests.sos.problems import EMPTY, PROBLEMS, PROVED

OPEN = settings(max_examples=25, deadline=None, database=None, suppress_health_check=list(HealthCheck))


def accepted(outcome):
    """The outcome, having had its certificate checked by the kernel and by SymPy."""
    if outcome.verdict != "undecided":
        assert check_text(canonical(outcome.certificate)).status == "valid"
        assert holds(outcome.certificate)
    return outcome


@pytest.mark.parametrize("name", PROBLEMS)
def test_a_named_problem(name):
    text, on, wanted = PROBLEMS[name]
    problem = read(text, None if any(c in text + on for c in "xyab") else ("x",), on)
    found = accepted(decide(problem, 20))
    if wanted is None:
        assert found.verdict in ("proved", "undecided")
        return
    assert found.verdict == (PROVED if wanted == EMPTY else wanted), found.tried
    assert found.vacuous == (wanted == EMPTY)


small = st.integers(-4, 4)


@st.composite
def squares(draw):
    """A sum of two squares of polynomials in two variables of degree 2, whatever its zeros."""
    over = ring(("x", "y"))
    total = over.constant(0)
    for _ in range(2):
        coefficients = draw(st.lists(small, min_size=6, max_size=6))
        q = from_terms(over, dict(zip(monomials(2, 2), coefficients, strict=True)))
        total = total + q * q
    return Problem(("x", "y"), total)


@OPEN
@given(squares())
def test_a_sum_of_squares_is_never_refuted(problem):
    assert accepted(decide(problem, 10)).verdict != "refuted"


@OPEN
@given(squares(), st.integers(1, 5))
def test_a_sum_of_squares_with_a_margin_is_proved(problem, margin):
    """Plus a definite form in all monomials of degree 2."""
    extra = sum((problem.ring.gens()[0] ** a * problem.ring.gens()[1] ** b) ** 2 for a, b in monomials(2, 2))
    more = Problem(problem.names, problem.polynomial + margin * extra)
    assert accepted(decide(more, 10)).verdict == "proved"


@OPEN
@given(squares(), st.tuples(small, small), st.integers(1, 12))
def test_what_is_negative_at_a_point_is_refuted(problem, point, digits):
    value = value_at(problem.polynomial, tuple(map(Fraction, point)))
    shifted = problem.polynomial - to_fmpq(value + Fraction(1, 10**digits))
    assert accepted(decide(Problem(problem.names, shifted), 10)).verdict == "refuted"


@settings(max_examples=60, deadline=None, database=None)
@given(st.lists(st.integers(-5, 5), min_size=1, max_size=9), st.sampled_from([0, 1, 2]))
def test_one_variable_is_decided_completely(coefficients, which):
    on = ("", "x >= -1", "x >= 0, x <= 2")[which]
    text = " + ".join(f"({c})*x^{k}" for k, c in enumerate(coefficients))
    assert accepted(decide(read(text, ("x",), on), 10)).verdict != "undecided"


@settings(max_examples=40, deadline=None, database=None)
@given(st.lists(st.integers(-5, 5), min_size=3, max_size=7))
def test_a_form_in_two_variables_is_decided_completely(coefficients):
    d = len(coefficients) - 1
    text = " + ".join(f"({c})*x^{k}*y^{d - k}" for k, c in enumerate(coefficients))
    assert accepted(decide(read(text, ("x", "y")), 10)).verdict != "undecided"


def test_strictness_is_told_apart():
    for text, verdict in (
        ("x^2 + 1 > 0", "proved"),
        ("x^2 > 0", "refuted"),
        ("x^2 + y^2 + 1/1000 > 0", "proved"),
        ("x^2 + y^2 > 0", "refuted"),
        ("3 > 0*x", "proved"),
    ):
        assert accepted(decide(read(text, None), 10)).verdict == verdict


def test_a_lower_bound_is_one():
    bound = lower_bound(read("x^4 + y^4 + x^2*y - 7*x + 3", None), Deadline(10))
    assert bound is not None
    assert Fraction("-4.196") < bound < Fraction("-4.195")
    assert lower_bound(read(PROBLEMS["motzkin"][0], None), Deadline(10)) is None


def test_a_basis_is_half_the_newton_polytope():
    motzkin = [(4, 2), (2, 4), (2, 2), (0, 0)]
    assert half_newton(motzkin) == [(0, 0), (1, 1), (1, 2), (2, 1)]
    over = ring(("x", "y"))
    x, y = over.gens()
    signs = parities([x**4 * y**2 + x**2 * y**4 - 3 * x**2 * y**2 + 1])
    assert sorted(map(sorted, split([(0, 0), (1, 1), (1, 2), (2, 1)], signs))) == [
        [(0, 0)],
        [(1, 1)],
        [(1, 2)],
        [(2, 1)],
    ]


@pytest.mark.parametrize("n", [4, 12, 40])
def test_a_chain_is_proved_in_groups_of_variables(n):
    steps = "+".join(f"10*(x{k + 1}-x{k}^2)^2 + (1-x{k})^2" for k in range(n - 1))
    powers = "+".join(f"x{k}^4" for k in range(n))
    found = decide(read(f"{steps} + ({powers})/100 + 1/10", None), 20)
    assert found.verdict == "proved"
    assert "groups of variables" in found.reason


def test_a_strictly_positive_quartic_in_many_variables_is_quick():
    n = 9
    text = "+".join(f"x{i}^4 + x{i}^2*x{j}^2 + x{i}*x{j}" for i in range(n) for j in range(i)) + "+x0^4 + 20"
    found = decide(read(text, None), 20)
    assert found.verdict == "proved"
