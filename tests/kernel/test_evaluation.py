"""The walk and the chain rule against SymPy's derivatives, over exact numbers."""

from __future__ import annotations

import json
from collections.abc import Sequence
from fractions import Fraction

import pytest
import sympy as sp

from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.chain import Domain
from symctrl.kernel.evaluation import Evaluation, GraphSums, NoSums
from symctrl.kernel.loading import load
from tests.kernel.certificates import certificate, given, seal

NAMES = "sqrt sin cos exp log tanh sinh cosh asin acos atan asinh acosh atanh sign"
FUNCTIONS = {name.upper(): getattr(sp, name) for name in NAMES.split()} | {"FABS": sp.Abs, "POW": sp.Pow}


class Symbolic(Domain[sp.Expr]):
    """SymPy expressions as a domain: an oracle for the chain rule."""

    def __init__(self) -> None:
        self.asked: list[sp.Expr] = []

    def constant(self, value: Fraction) -> sp.Expr:
        return sp.Rational(value.numerator, value.denominator)

    def add(self, a: sp.Expr, b: sp.Expr) -> sp.Expr:
        return a + b

    def mul(self, a: sp.Expr, b: sp.Expr) -> sp.Expr:
        return a * b

    def inv(self, a: sp.Expr) -> sp.Expr:
        self.asked.append(a)
        return 1 / a

    def function(self, op: str, args: Sequence[sp.Expr]) -> sp.Expr:
        return FUNCTIONS[op](*args)

    def nonzero(self, a: sp.Expr) -> None:
        self.asked.append(a)

    def rational(self, a: sp.Expr) -> Fraction | None:
        return Fraction(int(a.p), int(a.q)) if isinstance(a, sp.Rational) else None


X, Y, K = sp.symbols("x y k", positive=True)
FIELD = {X: Y, Y: -K * sp.sin(X)}
STATEMENT = {
    "motion": {"x": ["f", 0], "y": ["f", 1]},
    "scalars": {"x": "state", "y": "state", "k": "parameter"},
}
MOTION = "a = SIN x\nb = MUL k a\nc = NEG b\nreturn y c"


def rate(body: str, level: int) -> tuple[sp.Expr, Symbolic]:
    """The kernel's derivative of the last line of the body, taken `level` times."""
    names = {
        f"r{n}": {"is": "rate", "of": ["V" if n == 0 else f"R{n}", 0], "law": None} for n in range(level)
    }
    body = body.replace("return", "zz = ADD x y\nreturn") + " zz"  # so that both states are read
    text = {"claim": f"return r{level - 1} k", "V": body, "f": MOTION}
    text |= {f"R{n}": f"return r{n - 1}" for n in range(1, level)}
    loaded = load(json.dumps(certificate(text, {}, names=names, conditions=[], **STATEMENT)))
    domain = Symbolic()
    free = {"x": X, "y": Y, "k": K}
    walk = Evaluation(loaded.statement, domain, free.__getitem__, NoSums())
    return walk.outputs("claim", {})[0], domain


def derivative(expr: sp.Expr) -> sp.Expr:
    return sum(sp.diff(expr, v) * f for v, f in FIELD.items())


def value(expr: sp.Expr) -> sp.Expr:
    return sp.N(expr.subs({X: sp.Rational(3, 10), Y: sp.Rational(7, 10), K: sp.Rational(13, 10)}), 30)


# Every body ends in an expression of x, y and k that moves with both states.
BODIES = {
    "a = MUL x y\nreturn a": X * Y,
    "a = DIV x y\nreturn a": X / Y,
    "a = DIV k y\nreturn a": K / Y,
    "a = DIV y k\nreturn a": Y / K,
    "a = INV x\nb = SUB a y\nreturn b": 1 / X - Y,
    "a = SQ x\nb = TWICE a\nc = ADD b y\nreturn c": 2 * X**2 + Y,
    "a = POW x 3\nb = MUL a y\nreturn b": X**3 * Y,
    "a = POW x -2\nb = MUL a y\nreturn b": X**-2 * Y,
    "a = POW x 0\nb = MUL a y\nreturn b": Y,
    "a = POW x 3/2\nb = MUL a y\nreturn b": X ** sp.Rational(3, 2) * Y,
    "a = POW x k\nb = MUL a y\nreturn b": X**K * Y,
    "a = POW x y\nreturn a": X**Y,
    "a = POW k y\nreturn a": K**Y,
    "a = TAN x\nb = MUL a y\nreturn b": sp.tan(X) * Y,
    "a = HYPOT x y\nreturn a": sp.sqrt(X**2 + Y**2),
    "a = LOG1P x\nb = EXPM1 y\nc = MUL a b\nreturn c": sp.log(1 + X) * (sp.exp(Y) - 1),
    "a = SUB x 2\nb = FABS a\nc = MUL b y\nreturn c": (2 - X) * Y,
}
for _op in (
    "SQRT",
    "SIN",
    "COS",
    "EXP",
    "LOG",
    "TANH",
    "SINH",
    "COSH",
    "ASIN",
    "ACOS",
    "ATAN",
    "ASINH",
    "ATANH",
):
    BODIES[f"a = {_op} x\nb = MUL a y\nreturn b"] = FUNCTIONS[_op](X) * Y
BODIES["z = ADD x 2\na = ACOSH z\nb = MUL a y\nreturn b"] = sp.acosh(X + 2) * Y


@pytest.mark.parametrize("body", BODIES)
def test_rates_are_those_of_sympy(body):
    wanted = BODIES[body]
    for level in (1, 2):
        wanted = derivative(wanted)
        assert abs(value(rate(body, level)[0] - wanted)) < 1e-20


def test_third_rates_too():
    wanted = X * Y / (1 + X**2)
    for _ in range(3):
        wanted = derivative(wanted)
    assert (
        abs(value(rate("a = SQ x\nb = ADD a 1\nc = MUL x y\nd = DIV c b\nreturn d", 3)[0] - wanted)) < 1e-20
    )


def test_a_kink_asks_for_what_it_needs():
    assert X - 2 in rate("a = SUB x 2\nb = FABS a\nreturn b", 1)[1].asked
    assert 2 * sp.sqrt(X) in rate("a = SQRT x\nreturn a", 1)[1].asked
    assert rate("a = SQRT k\nb = FABS a\nc = MUL b x\nreturn c", 1)[1].asked == []


@pytest.mark.parametrize("op", ["SIGN", "FLOOR"])
def test_what_jumps_has_no_rate(op):
    with pytest.raises((Invalid, KeyError)):
        rate(f"a = {op} x\nreturn a", 1)


def test_huge_powers_are_declined():
    with pytest.raises(Declined, match="exponent"):
        rate("a = POW x 5000\nreturn a", 1)


def loaded(listings, **tables):
    scalars = tables.pop("scalars", {"x": "state", "u": "input", "k": "parameter"})
    return load(json.dumps(certificate(listings, {}, scalars=scalars, conditions=[], **tables))).statement


LAWS = {
    "claim": "return r s",
    "V": "a = SQ x\nreturn a",
    "f": "return u",
    "L": "a = MUL k x\nreturn a",
}
RATES = {"r": {"is": "rate", "of": ["V", 0], "law": "p"}, "s": {"is": "rate", "of": ["V", 0], "law": None}}


def test_a_law_replaces_its_inputs_and_nothing_else():
    statement = loaded(LAWS, motion={"x": ["f", 0]}, laws={"p": {"u": ["L", 0]}}, names=RATES)
    u = sp.Symbol("u")
    walk = Evaluation(statement, Symbolic(), {"x": X, "u": u, "k": K}.__getitem__, NoSums())
    assert walk.outputs("claim", {}) == [2 * K * X**2, 2 * X * u]


@pytest.mark.parametrize(
    ("listings", "why"),
    [
        ({**LAWS, "V": "a = MUL x u\nreturn a"}, "u has no rate"),
        ({**LAWS, "L": "return r"}, "through itself"),
    ],
)
def test_what_has_no_rate_is_refused(listings, why):
    with pytest.raises(Invalid, match=why):
        loaded(listings, motion={"x": ["f", 0]}, laws={"p": {"u": ["L", 0]}}, names=RATES)


def test_a_state_without_motion_has_no_rate():
    with pytest.raises(Invalid, match="x has no rate"):
        loaded({"claim": "return r x", "V": "return x"}, scalars={"x": "state"}, names={"r": {**RATES["s"]}})


def test_a_law_inside_another_is_declined():
    names = {**RATES, "r2": {"is": "rate", "of": ["W", 0], "law": "q"}}
    listings = {**LAWS, "claim": "return r2 s", "W": "return r", "M": "return k"}
    with pytest.raises(Declined, match="inside a rate"):
        loaded(
            listings, motion={"x": ["f", 0]}, laws={"p": {"u": ["L", 0]}, "q": {"u": ["M", 0]}}, names=names
        )


FLEET = {
    "claim": "return T T",
    "node": "a = MUL q.i S.i\nreturn a",
    "edge": "a = SUB q.i q.j\nb = SQ a\nreturn b",
}
FLEET_TABLES = {
    "scalars": {"q.*": "state"},
    "names": {"T": {"is": "total", "of": ["node", 0]}, "S.*": {"is": "sum", "of": ["edge", 0]}},
}


def test_sums_over_a_graph():
    statement = loaded(FLEET, **FLEET_TABLES)
    q = {"q.1": 2, "q.2": 3, "q.3": 5}
    walk = Evaluation(
        statement,
        Symbolic(),
        lambda n: sp.Integer(q[n]),
        GraphSums({"1": ["2"], "2": ["1", "3"], "3": ["2"]}),
    )
    assert walk.outputs("claim", {})[0] == 2 * 1 + 3 * (1 + 4) + 5 * 4


def test_sums_over_no_nodes_are_zero_and_unknown_nodes_are_refused():
    statement = loaded(FLEET, **FLEET_TABLES)
    assert Evaluation(statement, Symbolic(), sp.Symbol, GraphSums({})).outputs("claim", {}) == [0, 0]
    with pytest.raises(Invalid, match="no node"):
        Evaluation(statement, Symbolic(), sp.Symbol, GraphSums({})).read("S.*", "7", 0, None)


def test_a_node_must_be_bound():
    with pytest.raises(Invalid, match="not bound"):
        loaded(
            {"claim": "return q.i a", "a": "return q.j"},
            scalars={"q.*": "state", "a": "state"},
            given=[given("zero", "a")],
        )
    with pytest.raises(Invalid, match="not bound"):
        loaded(
            {"claim": "return V V", "V": "return q.i"},
            scalars={"q.*": "state"},
            names={"V": {"is": "value", "of": ["V", 0]}},
        )


def test_the_builder_seals():
    one = certificate({"claim": "return x x"}, {}, scalars={"x": "state"}, conditions=[])
    assert seal(one) == one
