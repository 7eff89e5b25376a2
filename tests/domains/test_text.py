from collections.abc import Mapping
from fractions import Fraction

import casadi as ca
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symctrl.domains.fraction import FractionDomain, NoExactValue
from symctrl.domains.text import Text, TextDomain
from symctrl.graph import ARITY, interpret, read, unfolded

ARITHMETIC = ("ADD", "SUB", "MUL", "DIV", "NEG", "INV", "SQ", "TWICE", "POW")
LEAVES: Mapping[str, Fraction] = {"x": Fraction(3), "y": Fraction(-5, 7), "z": Fraction(2, 3)}


@given(st.data())
@settings(max_examples=200, deadline=None)
def test_the_text_read_as_mathematics_has_the_value_of_the_expression(data: st.DataObject) -> None:
    """Python's own parser and precedence against the walk (with ** for ^)."""
    texts, numbers = TextDomain(limit=10**6), FractionDomain()

    def build(depth: int) -> tuple[Text, Fraction]:
        if depth == 0:
            name = data.draw(st.sampled_from(sorted(LEAVES)))
            return Text(name), LEAVES[name]
        op = data.draw(st.sampled_from(ARITHMETIC))
        args = [build(depth - 1) for _ in range(ARITY[op])]
        if op == "POW":
            exponent = Fraction(data.draw(st.integers(-2, 3)))
            args[1] = (texts.constant(exponent), exponent)
        return texts.operation(op)(*(t for t, _ in args)), numbers.operation(op)(*(v for _, v in args))

    try:
        text, value = build(3)
    except NoExactValue:
        return
    numerals = {str(n): Fraction(n) for n in range(4)}
    readable = text.text.replace("^", "**")
    for numeral in numerals:
        readable = readable.replace(numeral, f"Fraction({numeral})")
    assert eval(readable, {"Fraction": Fraction, **LEAVES}) == value


@pytest.mark.parametrize(
    ("write", "text"),
    [
        (lambda x, y: x + y * (x - y), "x + y*(x - y)"),
        (lambda x, y: x + -y, "x - y"),
        (lambda x, y: -(x + y), "-(x + y)"),
        (lambda x, y: x / (y * x), "x/(y*x)"),
        (lambda x, y: (x + y) ** 2, "(x + y)^2"),
        (lambda x, y: ca.fmin(x, ca.fabs(y)), "min(x, abs(y))"),
        (lambda x, y: ca.atan2(x, y) < 2, "atan2(x, y) < 2"),
    ],
)
def test_written_as_one_would(write: object, text: str) -> None:
    x, y = ca.SX.sym("x"), ca.SX.sym("y")
    with unfolded():
        tape = read(ca.Function("f", [x, y], [write(x, y)]), ["x", "y"])  # type: ignore[operator]
    (got,) = interpret(tape, TextDomain(), {name: Text(name) for name in tape.inputs})
    assert got.text == text


@pytest.mark.parametrize("op", sorted(ARITY))
def test_every_operation_has_a_text_of_bounded_length(op: str) -> None:
    long = Text("+".join(["word"] * 12), 1)
    got = TextDomain().operation(op)(*[long] * ARITY[op])
    assert len(got.text) <= 60 or ARITY[op] == 1
    assert "..." in got.text
    assert got.text.count("(") == got.text.count(")")
