"""Reasons speak of expressions: a quantity that the rules made is printed as the formula that it is."""

import pytest

from symctrl import tends
from symctrl.kernel.form import _listing
from symctrl.rules.loop import tape_of
from symctrl.rules.tapes import said
from tests.arena.stated import postfix
from tests.rules.theorem_rows import decided, states, theorem


@pytest.mark.parametrize(
    ("formula", "shown"),
    [
        ("x", "x"),
        ("x x * 1 +", "x*x + 1"),
        ("x y z - -", "x - (y - z)"),
        ("a b + c d + *", "(a + b)*(c + d)"),
        ("x neg y *", "(-x)*y"),
        ("x y + abs z - neg", "-(fabs(x + y) - z)"),
        ("x 1/3 ^", "x^(1/3)"),
    ],
)
def test_a_tape_as_text(formula, shown):
    assert said(tape_of(_listing(postfix(formula), ""))) == shown


def test_a_state_has_its_name_in_a_reason():
    study, x, y = states("x", "y")
    study.motion(x, y)
    study.motion(y, -x - y)

    def argument(run):
        run.falls(x**2 + x * y + y**2)
        run.tends(x)

    row, _ = decided(theorem(study, [tends(x)], argument))
    assert "no way was found from the facts so far to tends of x;" in f"{row.reason};"
