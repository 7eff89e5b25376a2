"""Opaque generators: few of them, each with its relations; what is learnt makes an end."""

import pytest

from symctrl.domains.domain import Unsupported
from symctrl.domains.opaque import Knowledge, Refine
from symctrl.expr import lift, symbol
from symctrl.vectors import absolute, cos, exp, power, sgn, sin, sqrt, tanh
from tests.domains.exactly import exactly

x, y, g = symbol("x"), symbol("y"), symbol("g")


def kinds(*exprs):
    """The kinds of the generators that are made, free ones aside."""
    return exactly(lambda d, _: sorted(k.kind for k in d.field.generators if k.kind != "free"), *exprs)


@pytest.mark.parametrize(
    ("exprs", "made"),
    [
        ([sqrt(x), sqrt(4 * x), power(x, "3/2")], ["root"]),
        ([sqrt(x), power(x, "1/3")], ["root"]),
        ([absolute(x), absolute(-3 * x), absolute(x**3)], ["abs"]),
        ([absolute(x), sqrt(x)], ["root"]),
        ([sgn(x), sgn(-x), sgn(x**3)], ["abs", "sign"]),
        ([sin(x), cos(2 * x), sin(x / 2)], ["cos", "sin"]),
        ([exp(x), exp(-x), exp(3 * x)], ["exp"]),
        ([exp(x + y), exp(x - y)], ["exp", "exp"]),
        ([tanh(x), tanh(-x), tanh(x + y - y)], ["function"]),
        ([power(absolute(x), g), power(absolute(x), g - 1)], ["abs", "power"]),
        ([sqrt(lift(2)), sqrt(lift(8))], ["root"]),
        ([x / y, (x + 1) ** 3], []),
    ],
)
def test_what_belongs_together_shares_its_generators(exprs, made):
    assert kinds(*exprs) == made


@pytest.mark.parametrize("expr", [sin(33 * x), sin(7 * x + 7 * y), (x + y + g + 1) ** 5000, power(x * 0, g)])
def test_what_would_grow_without_end_or_has_no_meaning_is_refused(expr):
    with pytest.raises(Unsupported):
        kinds(expr)


def test_knowledge_grows_until_it_divides():
    knowledge = Knowledge()
    assert knowledge.denominator("x", 2) == 2
    with pytest.raises(Refine):
        knowledge.denominator("x", 3)
    assert knowledge.denominator("x", 3) == knowledge.denominator("x", 2) == 6
    with pytest.raises(Refine):
        knowledge.learn_nonnegative("x")
    knowledge.learn_nonnegative("x")
