"""What an argument reads off instructions, which assumptions it may use, and what each rule asks for."""

import json
from fractions import Fraction

import pytest

from symctrl.kernel import theorem as kernel
from symctrl.kernel.argument import Argument, Beside, Obligation
from symctrl.kernel.certificate import Invalid
from symctrl.kernel.compose import MAX_RATES, composed, rate_listing, rates_of
from symctrl.kernel.form import read_tables
from symctrl.kernel.loading import load
from symctrl.kernel.rules.roles import Roles
from symctrl.kernel.traits import CONTINUOUS, LIPSCHITZ, NOT_AFFINE, SMOOTH
from tests.arena.stated import postfix, say, theorem


class Noted:
    """A judge that takes every proof for granted, and notes what is asked for."""

    def __init__(self):
        self.proved = []
        self.unmet = []

    def prove(self, at, obligation):
        self.proved.append(obligation.role)

    def require(self, role, holds, why):
        if not holds:
            self.unmet.append(role)


def argument(motion, quantities, out="x", **more):
    """The argument of a theorem, with a judge that grants all proofs."""
    case = theorem(motion, [out], [say("bounded", 0)], quantities, [], **more)
    read = load(json.dumps(case))
    whole, names = kernel._whole(read.statement, read.proof)
    at = Argument(whole, names, Noted(), stated=frozenset(read.statement.motion))
    kernel.suppose(at)
    at.begin(read.proof["cofactors"])
    return at


def ran(at, rule, of):
    """What a rule asks of facts and of the graph, and does not get."""
    at.judge = Noted()
    kernel.RULES[rule](at, Roles(of, at.quantities, rule))
    return at.judge.unmet


def traits(formula, facts=(), motion=None, **more):
    """The traits of a formula of x, y, a parameter p and a signal d, with facts about other formulas."""
    scalars = {"p": "parameter", "d": "signal"}
    moving = motion or {"x": "x neg y -", "y": "y neg"}
    known = {f"known{k}": f for k, (_, f) in enumerate(facts)}
    out = "x y + p + d +"
    at = argument(moving, {"q": formula, **known}, out=out, scalars=scalars, **more)
    for k, (word, _) in enumerate(facts):
        at.learn(word, f"known{k}")
    return at.traits("q")


# traits: jumps


@pytest.mark.parametrize(
    ("formula", "jumps", "level"),
    [
        ("x sign", 1, SMOOTH),
        ("x sign y sign *", 2, SMOOTH),
        ("x x sign *", 0, CONTINUOUS),
        ("x sign x *", 0, CONTINUOUS),
        ("x abs 1/2 ^ x sign *", 0, CONTINUOUS),
        ("x abs p ^ x sign *", 1, CONTINUOUS),
        ("y x sign *", 1, SMOOTH),
        ("x 1 + x sign *", 1, SMOOTH),
        ("x y * x sign *", 0, CONTINUOUS),
        ("x y + x sign *", 1, SMOOTH),
        ("x sign x sign *", 1, SMOOTH),
        ("x sign abs", 1, LIPSCHITZ),
        ("x abs", 0, LIPSCHITZ),
        ("x abs 3/2 ^", 0, LIPSCHITZ),
        ("x abs 1/2 ^", 0, CONTINUOUS),
        ("x x *", 0, SMOOTH),
        ("1 x /", 0, SMOOTH),
        ("1 x sign /", 1, SMOOTH),
    ],
)
def test_jumps_and_how_smooth_it_is(formula, jumps, level):
    found = traits(formula)
    assert (len(found.jumps), found.level) == (jumps, level)


def test_a_jump_is_healed_by_a_zero_of_the_same_argument_alone():
    assert traits("x y - x y - sign *").jumps == frozenset()
    assert traits("x y - x y + sign *").jumps != frozenset()


def test_a_root_is_smooth_where_its_argument_stays_apart_from_zero():
    assert traits("x abs 1/2 ^", [("apart", "x abs")]).level == LIPSCHITZ
    assert traits("x abs 1/2 ^", [("apart", "y")]).level == CONTINUOUS


# traits: switches


@pytest.mark.parametrize(
    ("formula", "degree"),
    [
        ("x", 0),
        ("x sign", 1),
        ("x sign y *", 1),
        ("x sign y sign +", 1),
        ("x sign y sign *", NOT_AFFINE),
        ("x sign sq", NOT_AFFINE),
        ("x sign abs", NOT_AFFINE),
        ("x sign sign", NOT_AFFINE),
        ("1 x sign 2 + /", NOT_AFFINE),
        ("x sign 2 + 1/2 ^", NOT_AFFINE),
    ],
)
def test_the_degree_in_switches(formula, degree):
    assert traits(formula).degree == degree


def test_a_kink_asks_for_a_field_that_is_affine_in_its_switches():
    affine = argument({"x": "x sign neg"}, {"V": "x abs"})
    affine.require_differentiable("V", "V")
    assert affine.judge.unmet == []
    bent = argument({"x": "x sign y sign * neg", "y": "y neg"}, {"V": "x abs", "U": "x x *"})
    bent.require_differentiable("V", "V")
    bent.require_differentiable("U", "U")
    assert bent.judge.unmet == ["V, switches"]


# traits: edges and bounds


@pytest.mark.parametrize(
    ("formula", "kinds"),
    [
        ("x y *", []),
        ("x 2 /", []),
        ("x y /", ["nonzero"]),
        ("1 x y / /", ["nonzero", "nonzero"]),
        ("x 1/2 ^", ["nonnegative"]),
        ("x -1/2 ^", ["positive"]),
        ("x p ^", ["positive"]),
        ("x -2 ^", ["nonzero"]),
    ],
)
def test_the_edges_of_a_formula(formula, kinds):
    assert sorted(edge.split()[0] for edge in traits(formula).edges) == kinds


@pytest.mark.parametrize(
    ("formula", "facts", "bounded"),
    [
        ("x", [], False),
        ("x", [("bounded", "x")], True),
        ("x", [("tends", "x")], True),
        ("x", [("summable", "x")], False),
        ("x", [("apart", "x")], False),
        ("p", [], True),
        ("d", [], False),
        ("d", [("bounded", "d")], True),
        ("x y +", [("bounded", "x")], False),
        ("x y +", [("bounded", "x"), ("bounded", "y")], True),
        ("x y +", [("bounded", "x y +")], True),
        ("x y *", [("bounded", "x")], False),
        ("y x sign *", [("bounded", "y")], True),
        ("1 x /", [("bounded", "x")], False),
        ("1 x /", [("apart", "x")], True),
        ("x abs", [("bounded", "x")], True),
        ("x abs 1/2 ^", [("bounded", "x")], True),
        ("x abs -1/2 ^", [("bounded", "x")], False),
        ("x abs p ^", [("bounded", "x")], False),
    ],
)
def test_what_is_bounded(formula, facts, bounded):
    assert traits(formula, facts).bounded is bounded


def test_equal_structures_have_one_key_and_others_another():
    assert traits("x y +").key == traits("y x +").key
    assert traits("x y *").key == traits("y x *").key
    keys = {
        traits(f).key for f in ("x y -", "y x -", "x y /", "y x /", "x y ^", "y x ^", "x", "x sign", "x abs")
    }
    assert len(keys) == 9


# compose


def listings(**formulas):
    tables = {"listings": {name: postfix(f) for name, f in formulas.items()}}
    return read_tables(
        tables | {"scalars": {}, "names": {}, "motion": {}, "laws": {}},
        {},
    )["listings"]


def steps(listing):
    return [(s.op, s.args, s.name or s.value) for s in listing.code]


def test_a_formula_is_put_together_from_quantities_states_and_numbers():
    made = composed(listings(V="x x *"), ["V 1/2 - @x *"], {"V": "V"})
    zero = Fraction(0)
    assert steps(made) == [
        ("INPUT", (), "x"),
        ("MUL", (0, 0), zero),
        ("CONST", (), Fraction(1, 2)),
        ("SUB", (1, 2), zero),
        ("MUL", (3, 0), zero),
    ]
    assert made.outputs == (4,)


def test_the_order_of_arguments_counts():
    one = composed(listings(a="x", b="y"), ["a b -"], {"a": "a", "b": "b"})
    other = composed(listings(a="x", b="y"), ["a b -"], {"a": "b", "b": "a"})
    assert steps(one) != steps(other)


def test_rates_are_named_by_their_order():
    more, names = rates_of("V", listings(V="x")["V"], "law")
    assert sorted(more) == [rate_listing("V", k) for k in range(1, MAX_RATES + 1)]
    assert names["rate2_V"].of == ("V'", 0)
    assert {meaning.law for meaning in names.values()} == {"law"}
    _, of_a_node = rates_of("V", listings(V="x.i")["V"], None)
    assert "rate1_V.*" in of_a_node
    assert rates_of("V", listings(V="x.i x.j -")["V"], None) == ({}, {})


# assumptions


def available(at):
    return [a.text for a in at.available]


ASSUMED = [
    ("nonnegative", "x", "initial"),
    ("positive", "p", "parameter"),
    ("nonnegative", "1 d -", "signal"),
    ("nonnegative", "y", "trajectory"),
    ("positive", "1 d +", "signal"),
    ("nonnegative", "y 2 +", "parameter"),
    ("nonzero", "x 5 +", "initial"),
]


def assuming():
    kinds = {"p": "parameter", "d": "signal"}
    moving = {"x": "x neg", "y": "y neg d + p +"}
    return argument(moving, {"x": "x", "y": "y", "w": "y 2 +"}, given=ASSUMED, scalars=kinds)


def test_what_holds_at_the_beginning_only_is_not_available():
    at = assuming()
    assert available(at) == [f"assumption {k}" for k in (2, 3, 4, 5)]
    assert [a.text for _, a in at.initial] == ["assumption 1", "assumption 6"]


def test_what_is_kept_becomes_available_and_nothing_else_does():
    at = assuming()
    assert ran(at, "keeps", {"g": "x"}) == []
    assert available(at)[4:] == ["assumption 1"]
    assert ran(at, "keeps", {"g": "w"}) == []
    assert available(at)[5:] == ["assumption 6"]


def test_on_the_closed_domain_strict_assumptions_are_about_constants():
    at = assuming()
    obligation = Obligation("role", "positive", ("x",), {"x": "x"}, Beside(closed=True))
    assert [a.text for a in at.usable(obligation)] == [f"assumption {k}" for k in (2, 3, 4)]
    only = tuple(at.available[:1])
    assert at.usable(Obligation("role", "positive", ("x",), {}, Beside(only=only))) == list(only)


def test_a_positive_constant_stays_apart_from_zero_and_a_signal_does_not():
    at = argument(
        {"x": "x d * p +"},
        {"p": "p", "d": "d", "c": "p 1 -"},
        scalars={"p": "parameter", "d": "signal"},
        given=[("positive", "p", ""), ("positive", "d", ""), ("nonnegative", "p 1 -", "")],
    )
    assert [at.has("apart", q) for q in ("p", "d", "c")] == [True, False, False]


def test_an_equation_is_used_after_it_is_shown_to_be_kept():
    at = argument({"x": "y", "y": "x neg"}, {"x": "x"}, given=[("zero", "x x * y y * + 1 -", "initial")])
    assert at.judge.proved == ["assumption 1 is kept"]
    assert available(at) == ["assumption 1"]


def test_a_cofactor_may_not_jump():
    more = {"given": [("zero", "x", "initial")], "cofactors": {"relation1": "c"}}
    at = argument({"x": "x x sign *"}, {"c": "x sign"}, **more)
    assert at.judge.unmet == ["assumption 1 is kept: continuous"]


# what the rules ask for

BARE = {"V": "x x *", "x": "x", "y": "y", "one": "1", "z": "x y *", "s": "x sign", "k": "p", "b": "1 x x * -"}
BARE |= {"q": "1 x /"}
OUTSIDE = {"V": "V", "radius": "one", "rate": "one", "set": "b", "beyond": "b"}
BY_RATE = {"word": "bounded", "how": "rate", "by": "V"}
MOVING = {"x": "x neg", "y": "x y * d +"}


def loop():
    return argument(MOVING, BARE, scalars={"p": "parameter", "d": "signal"}, out="x y + p +")


@pytest.mark.parametrize(
    ("rule", "of", "unmet"),
    [
        ("falls", {"V": "s"}, ["V is differentiable"]),
        ("falls", {"V": "V", "plus": ["V"]}, ["input 1 is summable"]),
        ("falls", {"V": "V", "above": "x"}, ["the lower bound is constant"]),
        ("decays", {"V": "V"}, ["a rate is given"]),
        ("decays", {"V": "V", "a": "x"}, ["the rate is constant"]),
        ("decays", {"V": "V", "a": "one", "c": "x"}, ["the offset is constant"]),
        ("decays", {"V": "V", "a": "one", "input": "x"}, ["the input is known"]),
        ("decays", {"V": "V", "b": "one", "gamma": "x", "rho": "x"}, ["gamma is constant"]),
        ("outside", {**OUTSIDE, "radius": "x"}, ["the radius is constant"]),
        ("outside", {**OUTSIDE, "rate": "x"}, ["the rate is constant"]),
        ("keeps", {"g": "s"}, ["g is differentiable"]),
        ("keeps", {"g": "x", "a": "s"}, ["a is continuous"]),
        ("keeps_sign", {"g": "s"}, ["g is continuous"]),
        ("keeps_sign", {"g": "q"}, ["g is defined"]),
        ("part", {"e": "x", "term": "x", "total": "V"}, ["the total is that of the term"]),
        ("exists", {}, ["x stays finite", "y stays finite"]),
        ("exists", {"edges": ["x"]}, ["x stays finite", "y stays finite", "no edge is named in vain"]),
        (
            "barbalat",
            {"e": "x", "W": "V", "power": "2"},
            ["existence", "W is summable", "the rate of e is bounded"],
        ),
        ("barbalat_rate", {"e": "x"}, ["existence", "e tends to zero", "the second rate is bounded"]),
        (
            "lasalle",
            {"V": "V", "zero": ["x"], "limit": ["x"]},
            ["existence", "x is bounded", "y is bounded", "the rate of y has no signal", "V never increases"],
        ),
        ("lyapunov", {"V": "V", "at": {"x": "0"}}, ["every state is named"]),
        ("carries", {"word": "bounded", "how": "composed", "e": "x"}, ["e is composed of what is bounded"]),
        ("carries", {"word": "bounded", "how": "square", "e": "x", "by": ["V"]}, ["bound 1 is bounded"]),
        ("carries", {**BY_RATE, "e": "x"}, ["the bound of the rate is summable"]),
        (
            "carries",
            {"word": "tends", "how": "combination", "e": "z", "of": ["y"], "times": ["x"]},
            ["part 1: tends", "factor 1 is bounded"],
        ),
        ("carries", {"word": "tends", "how": "square", "e": "x", "by": "V"}, ["V tends to zero"]),
        ("carries", {"word": "summable", "how": "parts", "e": "x", "by": ["V"]}, ["bound 1 is summable"]),
        ("carries", {"word": "apart", "how": "multiple", "e": "z", "by": "x", "times": "y"},
         ["z stays apart from zero", "the factor is constant"]),
        ("carries", {"word": "apart", "how": "constant", "e": "x"}, ["e is constant"]),
        ("carries", {"word": "bounded", "how": "parts", "e": "x", "by": ["V"]}, ["bound 1 is bounded"]),
    ],
)  # fmt: skip
def test_what_a_rule_asks_for(rule, of, unmet):
    assert ran(loop(), rule, of) == unmet


@pytest.mark.parametrize("rule", sorted(kernel.RULES))
def test_a_line_without_roles_is_refused_or_asks(rule):
    if rule == "exists":
        assert ran(loop(), rule, {}) != []
        return
    with pytest.raises(Invalid):
        ran(loop(), rule, {})
