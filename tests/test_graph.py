from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import casadi as ca
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symctrl.domains.domain import Unsupported
from symctrl.domains.floating import FloatDomain
from symctrl.domains.fraction import FractionDomain
from symctrl.graph import (
    ARITY,
    GraphError,
    Instruction,
    Tape,
    exact_literal,
    interpret,
    prebound,
    read,
    unfolded,
)
from tests.domains.oracle import MEANING

BUILD: dict[str, Callable[..., ca.SX]] = {
    "NEG": lambda a: -a,
    "EXP": ca.exp,
    "LOG": ca.log,
    "SQRT": ca.sqrt,
    "SQ": lambda a: a * a,
    "TWICE": lambda a: 2 * a,
    "SIN": ca.sin,
    "COS": ca.cos,
    "TAN": ca.tan,
    "ASIN": ca.asin,
    "ACOS": ca.acos,
    "ATAN": ca.atan,
    "SINH": ca.sinh,
    "COSH": ca.cosh,
    "TANH": ca.tanh,
    "ASINH": ca.asinh,
    "ACOSH": ca.acosh,
    "ATANH": ca.atanh,
    "FABS": ca.fabs,
    "SIGN": ca.sign,
    "FLOOR": ca.floor,
    "CEIL": ca.ceil,
    "NOT": ca.logic_not,
    "ERF": ca.erf,
    "ERFINV": ca.erfinv,
    "INV": lambda a: 1 / a,
    "LOG1P": ca.log1p,
    "EXPM1": ca.expm1,
    "ADD": lambda a, b: a + b,
    "SUB": lambda a, b: a - b,
    "MUL": lambda a, b: a * b,
    "DIV": lambda a, b: a / b,
    "POW": lambda a, b: a**b,
    "CONSTPOW": lambda a, b: a**2.5 + 0 * b,
    "LT": lambda a, b: a < b,
    "LE": lambda a, b: a <= b,
    "EQ": lambda a, b: a == b,
    "NE": lambda a, b: a != b,
    "AND": ca.logic_and,
    "OR": ca.logic_or,
    "FMOD": ca.fmod,
    "REMAINDER": ca.remainder,
    "COPYSIGN": ca.copysign,
    "IF_ELSE_ZERO": lambda a, b: ca.if_else(a, b, 0),
    "FMIN": ca.fmin,
    "FMAX": ca.fmax,
    "ATAN2": ca.atan2,
    "HYPOT": ca.hypot,
}


def symbols(count: int) -> list[ca.SX]:
    return [ca.SX.sym(f"x{k}") for k in range(count)]


def ops(tape: Tape) -> list[str]:
    return [step.op for step in tape.code]


def test_every_opcode_of_the_table_is_built_below() -> None:
    assert set(BUILD) == set(ARITY) == set(MEANING)


@pytest.mark.parametrize("op", sorted(ARITY))
def test_opcode_is_read_by_name_and_means_what_casadi_evaluates(op: str) -> None:
    x = symbols(ARITY[op])
    function = ca.Function("f", x, [BUILD[op](*x)])
    tape = read(function, [f"x{k}" for k in range(len(x))])
    assert op in ops(tape)
    assert set(ops(tape)) <= {op, "INPUT", "CONST"}
    rng = np.random.default_rng(len(op))
    columns = [rng.uniform(float(Fraction(lo)), float(Fraction(hi)), 20) for lo, hi in MEANING[op].box]
    expected = np.array([float(function(*sample)) for sample in zip(*columns, strict=True)])
    (got,) = interpret(function, FloatDomain(), columns)
    # CasADi's own erfinv is a low-order approximation.
    np.testing.assert_allclose(got, expected, rtol=1e-6 if op == "ERFINV" else 1e-14)


@pytest.mark.parametrize(("a", "b"), [(0.0, 0.0), (1.0, 0.0), (0.0, 2.0), (2.0, 2.0), (-1.0, 3.0)])
@pytest.mark.parametrize("op", ["LT", "LE", "EQ", "NE", "AND", "OR", "FMIN", "FMAX", "IF_ELSE_ZERO"])
def test_ties_and_zeros_mean_what_casadi_evaluates(op: str, a: float, b: float) -> None:
    x = symbols(2)
    function = ca.Function("f", x, [BUILD[op](*x)])
    exact = interpret(function, FractionDomain(), [Fraction(a), Fraction(b)])
    assert exact == [Fraction(float(function(a, b)))]


class TestRefusals:
    def test_free_symbol_is_named(self) -> None:
        x, k = ca.SX.sym("x"), ca.SX.sym("kappa")
        function = ca.Function("f", [x], [k * x], {"allow_free": True})
        with pytest.raises(GraphError, match=r"f has free symbols: .*kappa"):
            read(function)

    def test_call_without_scalar_instructions_is_named(self) -> None:
        table = ca.interpolant("lookup", "linear", [[0.0, 1.0, 2.0]], [0.0, 1.0, 4.0])
        x = ca.MX.sym("x")
        with pytest.raises(GraphError, match="lookup"):
            read(ca.Function("f", [x], [table(x)]))

    def test_matrix_operation_that_does_not_expand_is_named(self) -> None:
        m = ca.MX.sym("m", 2, 2)
        with pytest.raises(GraphError, match=r"function g \(MXFunction\) cannot be expanded.*LinsolQr"):
            read(ca.Function("g", [m], [ca.inv(m)]))

    def test_matrix_function_that_casadi_will_not_inline_is_named(self) -> None:
        m = ca.MX.sym("m", 2)
        kept = ca.Function("kept", [m], [2 * m], {"never_inline": True})
        for function in (kept, ca.Function("f", [m], [kept(m) + m])):
            with pytest.raises(GraphError, match=r"function kept \(MXFunction\) is marked never_inline"):
                read(function)

    def test_printing_is_named(self) -> None:
        x = ca.SX.sym("x")
        with pytest.raises(GraphError, match=r"instruction .* of function f is printme"):
            read(ca.Function("f", [x], [x.printme(3)]))

    def test_domain_without_a_meaning_is_named(self) -> None:
        class Bare(FractionDomain):
            name = "bare"
            erfinv_ = None  # type: ignore[assignment]

        x = ca.SX.sym("x")
        with pytest.raises(Unsupported, match="the bare domain gives no meaning to erfinv"):
            interpret(ca.Function("f", [x], [ca.erfinv(x)]), Bare(), [Fraction(0)])

    def test_wrong_number_of_names_or_values(self) -> None:
        x = ca.SX.sym("x", 2)
        function = ca.Function("f", [x], [x[0] * x[1]])
        with pytest.raises(GraphError, match="f has 2 scalar inputs, but 1 names"):
            read(function, ["a"])
        with pytest.raises(GraphError, match="different names, but a was given twice"):
            read(function, ["a", "a"])
        with pytest.raises(GraphError, match=r"no value was given for x\[2\]"):
            interpret(read(function, ["x[1]", "x[2]"]), FractionDomain(), {"x[1]": Fraction(1)})
        with pytest.raises(GraphError, match="has 2 inputs, but 1 values"):
            interpret(read(function), FractionDomain(), [Fraction(1)])


class TestLiterals:
    @given(st.decimals(-(10**6), 10**6, places=4, allow_nan=False))
    def test_short_decimals_are_read_as_written(self, decimal: Any) -> None:
        assert exact_literal(float(decimal)) == Fraction(decimal)

    @pytest.mark.parametrize(
        ("value", "exact"),
        [(0.95, "19/20"), (0.1, "1/10"), (1e-3, "1/1000"), (-0.0, "0"), (2.0**53, str(2**53))],
    )
    def test_accepted(self, value: float, exact: str) -> None:
        assert exact_literal(value) == Fraction(exact)

    @pytest.mark.parametrize("value", [1 / 3, np.pi, 0.1 + 0.2, 3 * 0.1, 2.0**-40, 2.0**0.5, 2.0**200 / 3])
    def test_computed_doubles_are_refused_by_name(self, value: float) -> None:
        with pytest.raises(GraphError) as caught:
            exact_literal(value)
        assert repr(float(value)) in str(caught.value)

    @pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
    def test_values_that_are_no_numbers_are_refused(self, value: float) -> None:
        with pytest.raises(GraphError, match=f"the constant {value} has no exact value"):
            exact_literal(value)

    def test_refusal_says_where_the_literal_is_used(self) -> None:
        x = ca.SX.sym("x")
        with pytest.raises(GraphError, match=r"0\.3333333333333333 .*in function f, .* instruction \d+, mul"):
            read(ca.Function("f", [x], [ca.sin(x) * (1 / 3)]))
        with pytest.raises(GraphError, match=r"3\.14159.* as entry 2 of output y"):
            read(ca.Function("f", [x], [ca.vertcat(x, ca.pi)], ["x"], ["y"]))

    def test_constants_folded_by_casadi_are_caught(self) -> None:
        x = ca.SX.sym("x")
        with pytest.raises(GraphError, match=r"0\.30000000000000004"):
            read(ca.Function("f", [x], [3 * (0.1 * x)]))


class TestUnfolded:
    @pytest.mark.parametrize(
        ("build", "kept"),
        [
            (lambda x: x / x, "DIV"),
            (lambda x: 0 * x, "MUL"),
            (lambda x: ca.sqrt(x) * ca.sqrt(x), "SQRT"),
            (lambda x: x - x, "SUB"),
            (lambda x: x**2, "POW"),
            (lambda x: ca.eq(x, x), "EQ"),
        ],
    )
    def test_expressions_stay_as_written(self, build: Callable[[ca.SX], ca.SX], kept: str) -> None:
        x = ca.SX.sym("x")
        with unfolded():
            written = ca.Function("f", [x], [build(x)])
        assert kept in ops(read(written))
        assert kept not in ops(read(ca.Function("f", [x], [build(x)])))

    def test_switch_is_restored_after_errors_and_when_nested(self) -> None:
        switch = ca.GlobalOptions.getSimplificationOnTheFly
        seen = []

        def build() -> None:
            with unfolded():
                with unfolded():
                    seen.append(switch())
                seen.append(switch())
                raise KeyError

        with pytest.raises(KeyError):
            build()
        assert seen == [False, False]
        assert switch()

    def test_matrix_functions_expand_as_written(self) -> None:
        m = ca.MX.sym("m")
        with unfolded():
            function = ca.Function("f", [m], [m / m])
        assert "DIV" in ops(read(function))


def nested(count: int) -> tuple[ca.Function, ca.Function]:
    """A function that calls another `count` times deep, and the same function with the calls inlined."""
    with unfolded():
        return _nested(count)


def _nested(count: int) -> tuple[ca.Function, ca.Function]:
    x = ca.SX.sym("x", 2)
    step = ca.vertcat(x[0] * x[1] + 1, ca.sin(x[0]))
    called = ca.Function("c0", [x], [step, x[0] - x[1]], {"never_inline": True})
    flat = ca.Function("d0", [x], [step, x[0] - x[1]])
    for k in range(count):
        a, b = called(x)[0], flat(x)[0]
        called = ca.Function(f"c{k + 1}", [x], [2 * a[::-1], a[0] / 3], {"never_inline": True})
        flat = ca.Function(f"d{k + 1}", [x], [2 * b[::-1], b[0] / 3])
    return called, flat


class TestExpansion:
    @pytest.mark.parametrize("depth", [1, 2, 4])
    def test_nested_calls_give_the_tape_of_the_inlined_function(self, depth: int) -> None:
        called, flat = nested(depth)
        point = np.array([0.3, -1.1])
        tape = read(called)
        values = interpret(tape, FloatDomain(), {"i0[1]": point[0], "i0[2]": point[1]})
        expected = np.concatenate([np.array(out).ravel() for out in flat(point)])
        np.testing.assert_allclose(np.array(values), expected, rtol=1e-15)
        assert sorted(ops(tape)) == sorted(ops(read(flat)))

    def test_unused_outputs_of_a_call_leave_no_trace(self) -> None:
        x = ca.SX.sym("x")
        two = ca.Function("two", [x], [ca.sin(x), ca.exp(x)], {"never_inline": True})
        tape = read(ca.Function("f", [x], [two(x)[1]]))
        assert ops(tape) == ["INPUT", "EXP"]

    def test_matrix_functions_are_expanded(self) -> None:
        a, x = ca.MX.sym("a", 2, 2), ca.MX.sym("x", 2)
        function = ca.Function("f", [a, x], [a @ x, ca.dot(x, x)])
        values = [Fraction(k, 7) for k in range(1, 7)]
        got = interpret(function, FractionDomain(), values)
        v = np.array(values, dtype=object)
        matrix = v[:4].reshape(2, 2, order="F")
        assert got == [*(matrix @ v[4:]), v[4:] @ v[4:]]

    def test_calls_inside_matrix_functions_are_expanded(self) -> None:
        x, m = ca.SX.sym("x", 2), ca.MX.sym("m", 2)
        step = ca.Function("step", [x], [ca.vertcat(x[0] * x[1], x[0] - x[1] / 2)], {"never_inline": True})
        twice = ca.Function("twice", [m], [step(step(m))])
        function = ca.Function("f", [m], [twice(m) + step.mapaccum(3)(m)[:, -1]])
        a = b = (Fraction(3), Fraction(5))
        a, b = (self.step(self.step(a)), self.step(self.step(self.step(b))))
        assert interpret(function, FractionDomain(), [Fraction(3), Fraction(5)]) == [a[0] + b[0], a[1] + b[1]]

    def test_outputs_in_blocks_keep_their_order(self) -> None:
        m, n = ca.MX.sym("m", 2), ca.MX.sym("n", 2, 2)
        outputs = [ca.blockcat([[n, m], [m.T, ca.MX(1)]]), ca.vertcat(m, ca.sin(m)), ca.diagcat(m, n)]
        function = ca.Function("f", [m, n], outputs)
        values = [0.3, 0.7, 1.0, 2.0, 3.0, 4.0]
        called = function.call([ca.DM(values[:2]), ca.reshape(ca.DM(values[2:]), 2, 2)])
        expected = [x for output in called for x in output.nonzeros()]
        got = interpret(function, FloatDomain(), [np.array(x) for x in values])
        np.testing.assert_allclose(np.array(got), expected, rtol=1e-15)

    @staticmethod
    def step(x: tuple[Fraction, Fraction]) -> tuple[Fraction, Fraction]:
        return x[0] * x[1], x[0] - x[1] / 2

    def test_structural_zeros_are_not_entries(self) -> None:
        d = ca.SX.sym("d", ca.Sparsity.diag(3))
        function = ca.Function("f", [d], [d @ d, ca.SX(2, 2), ca.diag(ca.vertcat(1, 2))])
        assert interpret(function, FractionDomain(), [Fraction(k) for k in (3, 4, 5)]) == [9, 16, 25, 1, 2]

    def test_equal_instructions_are_merged_and_dead_ones_removed(self) -> None:
        x = ca.SX.sym("x", 3)
        first, again = ca.sin(x[0] + x[1]), ca.sin(x[0] + x[1])
        tape = read(ca.Function("f", [x], [first * again, ca.SX(0)]), ["a", "b", "c"])
        assert tape.inputs == ("a", "b")
        assert ops(tape).count("SIN") == 1

    def test_a_tape_is_single_assignment(self) -> None:
        tape = read(nested(3)[0])
        for k, step in enumerate(tape.code):
            assert all(a < k for a in step.args)
            assert len(step.args) == ARITY.get(step.op, 0)
        used = {a for step in tape.code for a in step.args} | set(tape.outputs)
        assert used == set(range(len(tape.code)))


class TestWalk:
    def test_operations_are_looked_up_once(self) -> None:
        class Counting(FractionDomain):
            looked_up: list[str]

            def operation(self, op: str) -> Callable[..., Fraction]:
                self.looked_up.append(op)
                return super().operation(op)

        x = ca.SX.sym("x", 3)
        tape = read(ca.Function("f", [x], [x[0] * x[1] * x[2] + x[0] * x[2] - 2]))
        domain = Counting()
        domain.looked_up = []
        run = prebound(tape, domain)
        assert sorted(domain.looked_up) == sorted({s.op for s in tape.code} - {"INPUT", "CONST"})
        before = list(domain.looked_up)
        for n in range(5):
            point = [Fraction(n), Fraction(n, 2), Fraction(3)]
            assert run(point) == [point[0] * point[1] * point[2] + point[0] * point[2] - 2]
        assert domain.looked_up == before

    @given(st.lists(st.fractions(-5, 5, max_denominator=9), min_size=2, max_size=2))
    def test_inputs_by_name_and_by_position_agree(self, point: Sequence[Fraction]) -> None:
        x = ca.SX.sym("x", 2)
        function = ca.Function("f", [x], [x[1] - x[0] ** 2, x[1]])
        tape = read(function, ["a", "b"])
        named = interpret(tape, FractionDomain(), {"b": point[1], "a": point[0], "unused": Fraction(0)})
        assert named == [point[1] - point[0] ** 2, point[1]]
        assert interpret(function, FractionDomain(), point) == named
        assert interpret(tape, FractionDomain(), point) == named

    def test_text_form_and_digest(self) -> None:
        tape = Tape((Instruction("INPUT", name="x"), Instruction("CONST", value=Fraction(1, 3))), (1, 0))
        assert tape.as_json() == {"code": [["INPUT", "x"], ["CONST", "1/3"]], "outputs": [1, 0]}
        other = Tape((Instruction("INPUT", name="x"), Instruction("CONST", value=Fraction(2, 3))), (1, 0))
        assert tape.sha256 != other.sha256
