"""Expressions: shapes, exactness, and that the graph means what the author wrote."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import casadi as ca
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symctrl.domains.fraction import FractionDomain
from symctrl.expr import (
    Expr,
    Nonconforming,
    deferred,
    foreign,
    lift,
    scalars,
    symbol,
    terms,
    walk,
)
from symctrl.graph import GraphError, interpret, read
from symctrl.literals import is_constant_name
from symctrl.vectors import inverse, kron, sqrt, stack
from tests.programs import NUMBERS, POINT, Program, programs

x, y, k = symbol("x"), symbol("y"), symbol("k")
v, w = symbol("v", (3, 1)), symbol("w", (3, 1))
u = symbol("u", (2, 1))
M, N = symbol("M", (3, 3)), symbol("N", (3, 2))


@dataclass(frozen=True)
class Named:
    label: str
    latex: str = "V"


def opcodes(expr: Expr) -> list[str]:
    return [step.op for step in read(ca.Function("f", ca.symvar(expr.sx), [expr.sx])).code]


def exact(expr: Expr, point: dict[str, Fraction]) -> list[Fraction]:
    """The entries column by column, evaluated exactly over the graph."""
    symbols = ca.symvar(expr.sx)
    names = [s.name() for s in symbols]
    values = {name: Fraction(name) if is_constant_name(name) else point[name] for name in names}
    return interpret(read(ca.Function("f", symbols, [expr.sx]), names), FractionDomain(), values)


def columns(value: list[list[Fraction]]) -> list[Fraction]:
    return [row[c] for c in range(len(value[0])) for row in value]


@given(programs())
def test_the_graph_means_what_was_written(program: Program) -> None:
    assert program.expr.shape == program.shape == program.expr.sx.shape
    assert exact(program.expr, POINT) == columns(program.value)


@given(programs(symbols=False))
def test_literals_are_combined_exactly(program: Program) -> None:
    assert list(program.expr.entries) == columns(program.value)
    if program.shape == (1, 1):
        assert program.expr.value == program.value[0][0]


@given(programs())
def test_terms_sum_up_to_the_expression(program: Program) -> None:
    addends = terms(program.expr)
    assert not {"add", "sub"} & {t.args[0].op if t.op == "neg" else t.op for t in addends}
    parts = [exact(term, POINT) for term in addends]
    assert [sum(column) for column in zip(*parts, strict=True)] == columns(program.value)


def test_terms_keep_the_sign_and_the_order_of_the_author() -> None:
    a, b, c = x * y, k / x, sqrt(y)
    assert tuple(t.args[0] if t.op == "neg" else t for t in terms(a - (b - -(c + a)))) == (a, b, c, a)
    assert [t.op == "neg" for t in terms(a - (b - -(c + a)))] == [False, True, True, True]


@given(NUMBERS, NUMBERS)
def test_a_literal_keeps_its_text(a: Fraction, b: Fraction) -> None:
    total = lift(str(a)) + lift(str(b))
    assert total.value == a + b
    assert [arg.args[1] for arg in total.args] == [str(a), str(b)]


@pytest.mark.parametrize(
    "text", ["1/3", "-2/7", "12345678901/100000000000", str(2**60 + 1), "1e-400", "1e400"]
)
def test_a_number_without_a_short_decimal_is_a_named_constant(text: str) -> None:
    assert [Fraction(name) for name in scalars(lift(text) * x) if is_constant_name(name)] == [Fraction(text)]
    assert exact(lift(text) * x, {"x": Fraction(3)}) == [3 * Fraction(text)]


@pytest.mark.parametrize("text", ["0.95", "19/20", "-1e-3", "7", "1e30"])
def test_a_short_decimal_is_a_constant_of_the_graph(text: str) -> None:
    assert scalars(lift(text) * x) == ["x"]
    assert exact(lift(text) * x, {"x": Fraction(1)}) == [Fraction(text)]


@pytest.mark.parametrize("number", [1 / 3, 0.1 + 0.2, float("nan"), float("inf")])
def test_a_float_that_is_no_short_decimal_is_refused(number: float) -> None:
    for write in (lambda: x + number, lambda: lift([number]), lambda: np.array([number]) @ stack(x)):
        with pytest.raises(GraphError):
            write()


def test_a_computed_float_is_answered_with_how_to_write_it() -> None:
    with pytest.raises(GraphError, match="write it as a string"):
        _ = x + 1 / 3


def test_numpy_numbers_and_arrays_are_read_entry_by_entry() -> None:
    assert lift(np.array([[0.1, 2.0], [3.0, 0.7]])).entries == (Fraction(1, 10), 3, 2, Fraction(7, 10))
    assert lift(np.float64(0.95)).value == Fraction(19, 20)
    assert lift(np.int64(4)).value == 4
    assert (np.array([1, 2, 3]) + v).shape == (np.eye(3) @ v).shape == (np.float64(2) * v).shape == (3, 1)


@pytest.mark.parametrize("op", ["DIV", "SUB", "MUL", "SQRT"])
def test_nothing_is_simplified(op: str) -> None:
    written = {"DIV": x / x, "SUB": x - x, "MUL": 0 * x, "SQRT": sqrt(x) * sqrt(x)}[op]
    assert op in opcodes(written)


def test_a_zero_divisor_stays_in_the_graph() -> None:
    assert opcodes(lift(1) / 0).count("DIV") == opcodes(x / 0).count("DIV") == 1
    assert (lift(1) / 0).value is None
    assert opcodes(lift(0) ** -1) == ["INPUT", "INPUT", "POW"]


def test_the_switch_of_casadi_is_left_as_it_was() -> None:
    for before in (True, False):
        ca.GlobalOptions.setSimplificationOnTheFly(before)
        try:
            assert (x / x + 1).sx.shape == (1, 1)
            with pytest.raises(Nonconforming):
                _ = x + v
            assert ca.GlobalOptions.getSimplificationOnTheFly() is before
        finally:
            ca.GlobalOptions.setSimplificationOnTheFly(True)


REFUSED: list[tuple[str, Callable[[], Any], tuple[str, str]]] = [
    ("vector + scalar", lambda: v + x, ("3x1", "1x1")),
    ("vector - number", lambda: v - 1, ("3x1", "1x1")),
    ("zero as text + vector", lambda: "0" + v, ("1x1", "3x1")),
    ("vectors of different length", lambda: v + u, ("3x1", "2x1")),
    ("column + row", lambda: v + w.T, ("3x1", "1x3")),
    ("vector * vector", lambda: v * w, ("3x1", "3x1")),
    ("vector * matrix", lambda: v * M, ("3x1", "3x3")),
    ("matrix * vector", lambda: M * v, ("3x3", "3x1")),
    ("vector / vector", lambda: v / w, ("3x1", "3x1")),
    ("number / vector", lambda: 1 / v, ("1x1", "3x1")),
    ("scalar @ vector", lambda: x @ v, ("1x1", "3x1")),
    ("vector @ vector", lambda: v @ w, ("3x1", "3x1")),
    ("matrix @ matrix", lambda: N @ M, ("3x2", "3x3")),
    ("vector ** 2", lambda: v**2, ("3x1", "1x1")),
    ("matrix ** -1", lambda: M**-1, ("3x3", "1x1")),
    ("scalar ** vector", lambda: x**v, ("1x1", "3x1")),
    ("list of another length", lambda: v + [1, 2], ("3x1", "2x1")),  # noqa: RUF005
    ("rows of different length", lambda: lift([[1, 2], [3]]), ("1x2", "1x1")),
    ("bound between shapes", lambda: v >= u, ("3x1", "2x1")),
    ("vector <= number", lambda: v <= 1, ("3x1", "1x1")),
]


@pytest.mark.parametrize(("write", "shapes"), [r[1:] for r in REFUSED], ids=[r[0] for r in REFUSED])
def test_shapes_are_strict(write: Callable[[], Any], shapes: tuple[str, str]) -> None:
    with pytest.raises(Nonconforming, match=f"left is {shapes[0]}, right is {shapes[1]}: "):
        write()


def test_the_message_has_both_texts_and_the_way_out() -> None:
    with pytest.raises(Nonconforming, match=r"\(2\*v\) and \(u\)"):
        _ = 2 * v - u
    with pytest.raises(Nonconforming, match="@ multiplies"):
        _ = M * v
    with pytest.raises(Nonconforming, match=r"power\(x, gamma\) is componentwise"):
        _ = v**2
    long = sum((x for _ in range(1000)), x)
    with pytest.raises(Nonconforming, match=r"x \+ x .* \.\.\. .* x \+ x") as caught:
        _ = long + v
    assert len(str(caught.value)) < 300


HELP: list[tuple[Callable[[], Any], str]] = [
    (lambda: bool(x), "no truth value"),
    (lambda: x == y, r"equal\(a, b\)"),
    (lambda: x != y, "nonzero"),
    (lambda: x in v, "'in'"),
    (lambda: y in [x], r"equal\(a, b\)"),
    (lambda: abs(v), r"absolute\(v\).*norm\(v, 1\).*norm\(v\)"),
    (lambda: 0 <= x <= 1, "two conditions instead of a chain"),
    (lambda: x if x > 0 else y, "no truth value"),
    (lambda: x + True, "no expression"),
    (lambda: lift(None), "return"),  # type: ignore[arg-type]
    (lambda: x + 1j, "no expression"),
    (lambda: x + ca.SX(1), "wrap"),
    (lambda: np.array([x, y]), "stack"),
    (lambda: len(M), "no length"),
    (lambda: list(M), r"M\[r, :\]"),
    (lambda: M[0], r"M\[r, c\]"),
    (lambda: v[x], "an integer or a slice"),
    (lambda: v[True], "an integer or a slice"),
    (lambda: lift([]), "empty list"),
    (lambda: lift([x, [1, 2]]), "rows and of entries at once"),
    (lambda: lift([[[1]]]), "three deep"),
    (lambda: deferred(object()), "label and latex"),  # type: ignore[arg-type]
]


@pytest.mark.parametrize(("write", "words"), HELP)
def test_what_has_no_meaning_is_answered_with_what_has(write: Callable[[], Any], words: str) -> None:
    with pytest.raises(TypeError, match=words):
        write()


@pytest.mark.parametrize("text", ["", "x", "1/0", "0,5", "1/3 m", "1e999999999", "1e"])
def test_a_string_that_is_no_number_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="is no exact number"):
        lift(text)


@pytest.mark.parametrize("name", ["", "1x", "-x", "q[1]", "a b", "a'"])
def test_a_name_that_could_be_mistaken_is_refused(name: str) -> None:
    with pytest.raises(ValueError, match="is no name"):
        symbol(name)


INDICES = st.one_of(st.integers(-5, 4), st.slices(4))


@given(st.sampled_from([(1, 1), (3, 1), (1, 4), (3, 4)]), INDICES, INDICES)
def test_indexing_is_that_of_numpy(shape: tuple[int, int], row: int | slice, col: int | slice) -> None:
    a = symbol("a", shape)
    names = np.array([e.name() for e in a.sx.elements()]).reshape(shape, order="F")
    keep = tuple(slice(i, i + 1 or None) if isinstance(i, int) else i for i in (row, col))
    inside = all(isinstance(i, slice) or -n <= i < n for i, n in zip((row, col), shape, strict=True))
    expected = names[keep] if inside else np.array([])
    if expected.size == 0:
        with pytest.raises(IndexError):
            a[row, col]
    else:
        picked = a[row, col]
        assert picked.shape == expected.shape
        assert [e.name() for e in picked.sx.elements()] == list(expected.flatten(order="F"))


@pytest.mark.parametrize(
    "write", [lambda: v[3], lambda: v[-4], lambda: M[0, 3], lambda: M[3:, 0], lambda: v[0, 0, 0]]
)
def test_an_index_out_of_range_is_an_index_error(write: Callable[[], Any]) -> None:
    with pytest.raises(IndexError):
        write()


def test_vectors_are_sequences_of_their_entries() -> None:
    assert [scalars(entry) for entry in v] == [["v[1]"], ["v[2]"], ["v[3]"]]
    assert len(v) == len(v.T) == 3
    first, *_ = v.T
    assert first.shape == (1, 1)


def test_names_count_from_one_and_an_index_follows_the_node() -> None:
    assert [e.name() for e in N.sx.elements()] == ["N[1,1]", "N[2,1]", "N[3,1]", "N[1,2]", "N[2,2]", "N[3,2]"]
    assert scalars(symbol("tau.i", (2, 1))) == ["tau.i[1]", "tau.i[2]"]
    assert scalars(x) == ["x"]


def test_a_symmetric_matrix_has_the_scalars_of_its_upper_triangle() -> None:
    J = symbol("J", (3, 3), symmetric=True)
    assert sorted(scalars(J)) == ["J[1,1]", "J[1,2]", "J[1,3]", "J[2,2]", "J[2,3]", "J[3,3]"]
    assert [e.name() for e in J.sx.elements()] == [e.name() for e in J.T.sx.elements()]
    with pytest.raises(ValueError, match="square"):
        symbol("J", (3, 2), symmetric=True)


def test_one_name_is_one_symbol_of_the_graph() -> None:
    assert ca.is_equal(symbol("z").sx, symbol("z").sx)
    assert scalars(symbol("z") + symbol("z")) == ["z"]


def test_a_deferred_quantity_is_named_by_its_record() -> None:
    record = Named("tau.i")
    tau = deferred(record, (2, 1))
    assert (tau.op, tau.args, tau.shape) == ("deferred", (record,), (2, 1))
    assert scalars(tau) == ["tau.i[1]", "tau.i[2]"]
    assert scalars(deferred(Named("rate1"))) == ["rate1"]
    assert scalars(deferred(Named("S"), (1, 2))) == ["S[1,1]", "S[1,2]"]


def test_foreign_casadi_keeps_its_graph_and_its_constants() -> None:
    s = ca.SX.sym("s", 2)
    taken = foreign(ca.vertcat(s[0] * 0.1, 3), "outside")
    assert taken.shape == (2, 1)
    assert taken.entries[1] == 3
    assert exact(2 * taken, {"s_0": Fraction(5)}) == [1, 6]
    with pytest.raises(GraphError):
        foreign(ca.vertcat(s, 1 / 3), "inexact")


def test_walk_gives_each_node_once_and_arguments_first() -> None:
    shared = x * y
    expr = sqrt(shared + shared) / (shared - k)
    order = list(walk(expr))
    assert order[-1] is expr
    assert len(order) == len(set(order)) == 8
    place = {node: number for number, node in enumerate(order)}
    assert all(place[arg] < place[node] for node in order for arg in node.args if isinstance(arg, Expr))


def test_long_sums_and_deep_sharing_are_no_trouble() -> None:
    total, doubled = x, x
    for _ in range(3000):
        total = total + x
    for _ in range(60):
        doubled = doubled + doubled
    assert len(terms(total)) == 3001
    assert exact(total, {"x": Fraction(1, 3)}) == [Fraction(3001, 3)]
    assert exact(doubled, {"x": Fraction(1)}) == [2**60]


def test_large_structures_are_built_when_they_are_asked_for() -> None:
    large = kron(symbol("A", (300, 300)), symbol("B", (300, 300)))
    assert (large @ symbol("z", (90_000, 1))).shape == (90_000, 1)
    assert "entries" not in large.__dict__


def test_pythons_sum_adds_no_zero() -> None:
    total = sum([v, w])
    assert isinstance(total, Expr)
    assert terms(total) == (v, w)


def test_an_expression_is_a_value_that_cannot_be_changed() -> None:
    with pytest.raises(AttributeError):
        x.op = "other"  # type: ignore[misc]
    assert {x: 1}[x] == 1


@pytest.mark.parametrize(
    "write", [lambda: 2**x, lambda: x ** Fraction(1, 3), lambda: x**y, lambda: lift(2) ** "1/2"]
)
def test_powers_stay_powers(write: Callable[[], Expr]) -> None:
    assert opcodes(write()).count("POW") == 1


def test_the_inverse_divides_by_the_determinant_alone() -> None:
    tape = read(ca.Function("f", ca.symvar(M.sx), [inverse(M).sx]))
    divisors = {step.args[1] for step in tape.code if step.op == "DIV"}
    assert len(divisors) == 1
