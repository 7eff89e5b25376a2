"""Twins of theorems: an error in one is said, and is neither a proof nor the end of the command."""

import pytest

from symctrl import bounded, exponentially
from symctrl.rules import theorems
from symctrl.vectors import cross, inverse
from symctrl.verify import verify
from tests.rules.theorem_rows import assert_proved, states, theorem


def damped():
    study, x = states("x")
    k = study.gain("k")
    study.motion(x, -k * x)
    return theorem(study, [exponentially(x**2, 2 * k)], lambda run: run.decays(x**2, a=2 * k), [k >= 0])


def test_an_error_in_a_twin_is_said_of_the_twin(monkeypatch):
    honest = theorems.attempt

    def attempt(*given, thorough=True):
        if not thorough:
            raise ZeroDivisionError("a quotient by zero")
        return honest(*given)

    monkeypatch.setattr(theorems, "attempt", attempt)
    row = verify(damped()).rows[0]
    assert row.verdict == "proved"
    assert row.twins.failed == ("without k >= 0: ZeroDivisionError: a quotient by zero",)
    assert row.twins.still_true == ()


def test_an_error_in_the_argument_itself_keeps_its_traceback(monkeypatch):
    def attempt(*_, **__):
        raise ZeroDivisionError("a quotient by zero")

    monkeypatch.setattr(theorems, "attempt", attempt)
    with pytest.raises(ZeroDivisionError):
        verify(damped())


def test_a_quartic_part_of_a_bounded_function_has_a_form_that_vanishes():
    """The second derivative of s^4 at zero is zero, so that the form has a row of zeros."""
    study, s = states("s")
    w, J = study.state("w", 3), study.inertia("J")
    study.motion(s, -(s**3))
    study.motion(w, -inverse(J) @ cross(w, J @ w))

    def argument(run):
        run.falls(w.T @ J @ w + s**4)
        run.exists()

    assert_proved(theorem(study, [bounded(s, w)], argument))
