"""Each rule accepts a right proof and refuses every change of it that is another proof."""

from __future__ import annotations

import copy

import pytest

from tests.kernel.certificates import certificate, explain, free, given, mutations, seal, status


def v(*terms):
    """A VALUE without denominators, from POLY terms."""
    return [[[], [list(term) for term in terms]]]


def sums(node, *monomials):
    """Generators of sums over the neighbours of a node, of monomials [generator, exponent, ..]."""
    pairs = [[list(pair) for pair in zip(m[::2], m[1::2], strict=True)] for m in monomials]
    return [{"sum": of, "node": node} for of in pairs]


def states(*names):
    return {"scalars": dict.fromkeys(names, "state")}


X = [1, 0, 1]  # the first generator, as a term
Y = [1, 1, 1]
ANGLES = [
    *free("x", "y"), {"cos": v(X)}, {"sin": v(X), "cos": 2}, {"cos": v(Y)}, {"sin": v(Y), "cos": 4}
]  # fmt: skip
SUM = "a = SUB q.i q.j\n"
FLEET = {"scalars": {"q.*": "state", "w.*": "state"}, "motion": {"q.*": ["f", 0]}}

# name: (listings, proof, tables, conditions that it needs, digit changes that leave another right proof)
CASES = {
    "division": (
        {"claim": "a = MUL x y\nb = DIV a y\nreturn b x"},
        {"generators": free("x", "y"), "factors": [[Y]], "hints": [{"inverse": ["1", [[0, 1]]]}]},
        states("x", "y"),
        ["y nonzero"],
    ),
    "division by a product": (
        {"claim": "a = MUL x y\nb = MUL a 3\nc = DIV y b\nd = INV x\ne = DIV d 3\nreturn c e"},
        {"generators": free("x", "y"), "factors": [[X], [Y]],
         "hints": [{"inverse": ["3", [[0, 1], [1, 1]]]}, {"inverse": ["1", [[0, 1]]]}]},
        states("x", "y"),
        ["x nonzero", "y nonzero"],
    ),
    "relation": (
        {"claim": "a = SQ x\nb = SQ y\nc = ADD a b\nd = SQ c\nreturn d 1",
         "unit": "a = SQ x\nb = SQ y\nc = ADD a b\nd = SUB c 1\nreturn d"},
        {"generators": free("x", "y")},
        {**states("x", "y"), "given": [given("zero", "unit")]},
        [],
    ),
    "division that a relation allows": (
        {"claim": "a = SQ x\nb = SUB 1 a\nc = DIV y b\nd = INV y\nreturn c d",
         "unit": "a = SQ x\nb = SQ y\nc = ADD a b\nd = SUB c 1\nreturn d"},
        {"generators": free("x", "y"), "factors": [[Y]],
         "hints": [{"inverse": ["1", [[0, 2]]]}, {"inverse": ["1", [[0, 1]]]}]},
        {**states("x", "y"), "given": [given("zero", "unit")]},
        ["y nonzero"],
    ),
    "square root": (
        {"claim": "a = SQRT x\nb = SQ a\nreturn b x"},
        {"generators": [*free("x"), {"root": 2, "of": [X]}], "hints": [{"is": v(Y)}]},
        states("x"),
        ["x nonnegative"],
    ),
    "absolute value": (
        {"claim": "a = SQ x\nb = SQRT a\nc = FABS x\nreturn b c"},
        {"generators": [*free("x"), {"abs": [X]}], "hints": [{"is": v(Y)}]},
        states("x"),
        [],
    ),
    "sign and absolute value": (
        {"claim": "a = SIGN x\nb = FABS x\nc = MUL a b\nreturn c x"},
        {"generators": [*free("x"), {"abs": [X]}, {"sign": [X], "abs": 1}],
         "hints": [{"is": v([1, 2, 1])}, {"is": v(Y)}]},
        states("x"),
        [],
    ),
    "sign of a product": (
        {"claim": "a = SIGN x\nb = SIGN y\nc = MUL a b\nd = MUL x y\ne = MUL -3 d\nf = SIGN e\n"
                  "g = NEG f\nreturn c g"},
        {"generators": [*free("x", "y"), {"abs": [X]}, {"sign": [X], "abs": 2}, {"abs": [Y]},
                        {"sign": [Y], "abs": 4}],
         "hints": [{"is": v([1, 3, 1])}, {"is": v([1, 5, 1])}, {"is": v([-1, 3, 1, 5, 1])}]},
        states("x", "y"),
        [],
    ),
    "square of a sign": (
        {"claim": "a = SIGN x\nb = SQ a\nreturn b 1", "nz": "return x"},
        {"generators": [*free("x"), {"abs": [X]}, {"sign": [X], "abs": 1}], "hints": [{"is": v([1, 2, 1])}]},
        {**states("x"), "given": [given("nonzero", "nz")]},
        [],
    ),
    "sine of a sum": (
        {"claim": "a = ADD x y\nb = SIN a\nc = SIN x\nd = COS y\ne = COS x\nf = SIN y\n"
                  "g = MUL c d\nh = MUL e f\ni = ADD g h\nreturn b i"},
        {"generators": ANGLES,
         "hints": [{"is": v([1, 2, 1, 5, 1], [1, 3, 1, 4, 1])}, {"is": v([1, 3, 1])}, {"is": v([1, 4, 1])},
                   {"is": v([1, 2, 1])}, {"is": v([1, 5, 1])}]},
        states("x", "y"),
        [],
    ),
    "cosine of a difference": (
        {"claim": "a = TWICE x\nb = SUB a y\nc = COS b\nd = SUB y a\ne = COS d\nreturn c e"},
        {"generators": ANGLES,
         "hints": [{"is": v([1, 4, 1], [-2, 3, 2, 4, 1], [2, 2, 1, 3, 1, 5, 1])}]},
        states("x", "y"),
        [],
    ),
    "rational power": (
        {"claim": "a = POW x 3/2\nb = SQRT x\nc = MUL a b\nd = SQ x\nreturn c d"},
        {"generators": [*free("x"), {"root": 2, "of": [X]}],
         "hints": [{"is": v([1, 0, 1, 1, 1])}, {"is": v(Y)}]},
        states("x"),
        ["x nonnegative"],
    ),
    "symbolic power": (
        {"claim": "a = POW x p\nb = MUL a x\nc = ADD p 1\nd = POW x c\nreturn b d"},
        {"generators": [*free("x", "p"), {"power": [X], "exponent": v(Y)}],
         "hints": [{"is": v([1, 2, 1])}, {"is": v([1, 0, 1, 2, 1])}]},
        {"scalars": {"x": "state", "p": "parameter"}},
        ["x positive"],
    ),
    "power with a positive exponent": (
        {"claim": "a = FABS x\nb = POW a p\nc = SQ b\nd = TWICE p\ne = POW a d\nreturn c e", "p": "return p"},
        {"generators": [*free("x", "p"), {"abs": [X]}, {"power": [[1, 2, 1]], "exponent": v(Y)}],
         "hints": [{"is": v([1, 2, 1])}, {"is": v([1, 3, 1])}, {"is": v([1, 3, 2])}]},
        {"scalars": {"x": "state", "p": "parameter"}, "given": [given("positive", "p")]},
        [],
    ),
    "negative power": (
        {"claim": "a = POW x -1/2\nb = MUL a x\nc = SQRT x\nreturn b c"},
        {"generators": [*free("x"), {"root": 2, "of": [X]}], "factors": [[Y]],
         "hints": [{"is": [[[[0, 1]], [[1]]]]}, {"is": v(Y)}]},
        states("x"),
        ["sqrt(x) nonzero", "x nonnegative", "x positive"],
    ),
    "exponential": (
        {"claim": "a = SUB x y\nb = EXP a\nc = EXP x\nd = EXP y\ne = DIV c d\nreturn b e"},
        {"generators": [*free("x", "y"), {"exp": v(X)}, {"exp": v(Y)}], "factors": [[[1, 3, 1]]],
         "hints": [{"is": [[[[0, 1]], [[1, 2, 1]]]]}, {"is": v([1, 2, 1])}, {"is": v([1, 3, 1])},
                   {"inverse": ["1", [[0, 1]]]}]},
        states("x", "y"),
        [],
    ),
    "opaque function": (
        {"claim": "a = LOG x\nb = ADD x 0\nc = LOG b\nreturn a c"},
        {"generators": [*free("x"), {"function": "log", "of": [v(X)]}],
         "hints": [{"is": v(Y)}]},
        states("x"),
        ["x positive"],
    ),
    "rate along a law": (
        {"claim": "a = SQ x\nb = MUL k a\nc = NEG b\nreturn r c", "V": "a = SQ x\nb = DIV a 2\nreturn b",
         "f": "return u", "L": "a = MUL k x\nb = NEG a\nreturn b"},
        {"generators": free("x", "k")},
        {"scalars": {"x": "state", "k": "parameter", "u": "input"}, "motion": {"x": ["f", 0]},
         "laws": {"pd": {"u": ["L", 0]}}, "names": {"r": {"is": "rate", "of": ["V", 0], "law": "pd"}}},
        [],
    ),
    "rate of an absolute value": (
        {"claim": "a = SIGN x\nreturn r a", "V": "a = FABS x\nreturn a", "f": "return 1"},
        {"generators": [*free("x"), {"abs": [X]}, {"sign": [X], "abs": 1}],
         "hints": [{"is": v([1, 2, 1])}, {"is": v(Y)}]},
        {**states("x"), "motion": {"x": ["f", 0]},
         "names": {"r": {"is": "rate", "of": ["V", 0], "law": None}}},
        ["x nonzero"],
    ),
    "sum over edges": (
        {"claim": "return T 0", "node": "return S.i", "edge": SUM + "return a"},
        {"generators": [*free("T", "q.i", "q.j"), *sums("i", [], [2, 1]), *sums("j", [], [1, 1])]},
        {"scalars": {"q.*": "state"},
         "names": {"T": {"is": "total", "of": ["node", 0]}, "S.*": {"is": "sum", "of": ["edge", 0]}}},
        [],
    ),
    "sum at a node": (
        {"claim": "a = MUL 3 S.i\nreturn a R.i", "one": SUM + "return a",
         "three": SUM + "b = MUL 3 a\nreturn b"},
        {"generators": [*free("q.i", "q.j"), *sums("i", [], [1, 1])]},
        {"scalars": {"q.*": "state"},
         "names": {"S.*": {"is": "sum", "of": ["one", 0]}, "R.*": {"is": "sum", "of": ["three", 0]}}},
        [],
    ),
    "rate of a sum over edges": (
        {"claim": "a = MUL 4 T2\nreturn r a", "V": "return T", "node": "return S.i",
         "edge": SUM + "b = SQ a\nreturn b",
         "f": "return w.i", "node2": "a = MUL w.i R.i\nreturn a", "edge2": SUM + "return a"},
        {"generators": [*free("T", "T'", "T2", "q.i", "q.j", "w.i", "w.j"),
                        *sums("i", [], [4, 1], [4, 2], [6, 1], [4, 1, 6, 1]),
                        *sums("j", [], [3, 1], [3, 2], [5, 1], [3, 1, 5, 1])]},
        {**FLEET, "names": {
            "T": {"is": "total", "of": ["node", 0]}, "S.*": {"is": "sum", "of": ["edge", 0]},
            "T2": {"is": "total", "of": ["node2", 0]}, "R.*": {"is": "sum", "of": ["edge2", 0]},
            "r": {"is": "rate", "of": ["V", 0], "law": None}}},
        [],
    ),
}  # fmt: skip


def made(name, **changes):
    listings, proof, tables, *_ = CASES[name]
    return certificate({**listings, **changes}, proof, **tables)


@pytest.mark.parametrize("name", CASES)
def test_a_right_proof_is_valid_under_the_conditions_it_needs(name):
    one = made(name)
    assert explain(one) == "valid: verified by its identity"
    assert sorted(f"{c['of']} {c['kind']}" for c in one["statement"]["conditions"]) == CASES[name][3]


# Changes that give another right proof: |-x| is |x|.
STILL_RIGHT = {
    "absolute value": {"('generators', 1, 'abs', 0, 0) -> -1"},
    "power with a positive exponent": {"('generators', 2, 'abs', 0, 0) -> -1"},
}


@pytest.mark.parametrize("name", CASES)
def test_a_changed_proof_is_refused(name):
    one = made(name)
    accepted = {what for what, other in mutations(one) if status(other) == "valid"}
    assert accepted == STILL_RIGHT.get(name, set())


@pytest.mark.parametrize("name", [name for name in CASES if CASES[name][3]])
def test_a_condition_that_is_not_stated_is_refused(name):
    one = made(name)
    for k in range(len(one["statement"]["conditions"])):
        other = copy.deepcopy(one)
        del other["statement"]["conditions"][k]
        assert "not stated" in explain(seal(other))


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("division", {"claim": "a = MUL x y\nb = DIV a y\nreturn b y"}),
        ("relation", {"unit": "a = SQ x\nb = SQ y\nc = ADD a b\nd = SUB c 2\nreturn d"}),
        ("square root", {"claim": "a = SQRT x\nb = SQ a\nc = NEG b\nreturn c x"}),
        ("sine of a sum", {"claim": CASES["sine of a sum"][0]["claim"].replace("i = ADD", "i = SUB")}),
        ("rational power", {"claim": "a = POW x 5/2\nb = SQRT x\nc = MUL a b\nd = SQ x\nreturn c d"}),
        ("exponential", {"claim": "a = ADD x y\nb = EXP a\nc = EXP x\nd = EXP y\ne = DIV c d\nreturn b e"}),
        ("rate along a law", {"L": "a = MUL k x\nreturn a"}),
        ("sum over edges", {"edge": "a = ADD q.i q.j\nreturn a"}),
        ("sum over edges", {"node": "a = MUL S.i q.i\nreturn a"}),
        ("sum over edges", {"node": "a = SQ S.i\nreturn a"}),
        ("sum over edges", {"node": "a = ADD S.i q.i\nreturn a"}),
        ("sum over edges", {"claim": "return T 1"}),
        ("sum over edges", {"claim": "a = SQ T\nreturn a 0"}),
        ("sum over edges", {"node": "a = SUB S.i q.i\nb = ADD a 1\nreturn b"}),
        ("sum over edges", {"edge": "a = SQ q.i\nb = SUB a q.j\nreturn b"}),
        ("sum at a node", {"three": "a = SUB q.j q.i\nb = MUL 3 a\nreturn b"}),
        ("rate of a sum over edges", {"claim": "a = MUL 2 T2\nreturn r a"}),
    ],
)
def test_the_same_proof_of_a_false_claim_is_refused(name, changes):
    listings, proof, tables, needed = CASES[name]
    conditions = [dict(zip(("of", "kind"), text.rsplit(" ", 1), strict=True)) for text in needed]
    other = certificate({**listings, **changes}, proof, **tables, conditions=conditions)
    assert status(other) == "invalid", explain(other)


@pytest.mark.parametrize("kind", ["nonnegative", "positive"])
def test_an_identity_proves_nothing_but_equality(kind):
    one = made("division")
    one["statement"]["claim"] = {"kind": kind, "shape": [1, 2], "listing": "claim"}
    assert "does not prove" in explain(seal(one))


def test_an_assumption_that_nothing_meets_proves_nothing():
    listings = {"claim": "return x 0", "given": "a = SUB x x\nb = ADD a 1\nreturn b"}
    with_zero = certificate(
        listings, {"generators": free("x")}, **states("x"), given=[given("zero", "given")], conditions=[]
    )
    assert "never be met" in explain(with_zero)


def test_a_division_by_zero_proves_nothing():
    listings = {"claim": "a = SUB x x\nb = DIV a a\nreturn b 7"}
    for proof in (
        {},
        {"factors": [[]], "hints": [{"inverse": ["1", [[0, 1]]]}]},
        {"hints": [{"inverse": ["0", []]}]},
    ):
        one = certificate(listings, {"generators": free("x"), **proof}, **states("x"), conditions=[])
        assert status(one) == "invalid"


NEIGHBOURS = {"scalars": {"q.*": "state"}, "names": {"S.*": {"is": "sum", "of": ["edge", 0]}}}


@pytest.mark.parametrize(
    ("edge", "generators", "why"),
    [
        ("a = INV q.j\nreturn a", free("q.i", "q.j"), "divides by what belongs to the neighbour"),
        ("a = MUL q.i q.j\nb = FABS a\nreturn b", [*free("q.i", "q.j"), {"abs": [[1, 0, 1, 1, 1]]}],
         "function of both nodes"),
        ("return q.j", [*free("q.i", "q.j"), *sums("i", [1, 2])], "no sum of q.j over"),
        ("return q.j", [*free("q.i", "q.j"), *sums("j", [1, 1])], "what belongs to the neighbour alone"),
        ("return q.j", [*free("q.i", "q.j"), *sums("i", [0, 1])], "what belongs to the neighbour alone"),
        ("return q.j", [*free("q.i", "q.j"), *sums("k", [1, 1])], "node i or j"),
        ("return q.j", [*free("q.i", "q.j"), *sums("i", [1, 1], [1, 1])], "there twice"),
        ("return q.j", [*sums("i", [2, 1]), *free("q.i", "q.j")], "not earlier"),
    ],
)  # fmt: skip
def test_a_sum_is_of_monomials_of_the_neighbour(edge, generators, why):
    proof = {"generators": generators, "factors": [[Y]],
             "hints": [{"inverse": ["1", [[0, 1]]]}, {"is": v([1, 2, 1])}]}  # fmt: skip
    one = certificate({"claim": "return S.i 0", "edge": edge}, proof, **NEIGHBOURS, conditions=[])
    assert why in explain(one)


def test_a_sum_may_not_be_hidden():
    """The sum over nodes of 1/S(i) is not zero because that of S(i), the sum of q.i - q.j, is."""
    one = certificate(
        {"claim": "return T 0", "node": "a = INV S.i\nreturn a", "edge": SUM + "return a"},
        {"generators": [*free("T", "q.i", "q.j"), *sums("i", [], [2, 1]), *sums("j", [], [1, 1])],
         "factors": [[[1, 1, 1, 3, 1], [-1, 4, 1]], [[1, 2, 1, 5, 1], [-1, 6, 1]]],
         "hints": [{"inverse": ["1", [[0, 1]]]}, {"inverse": ["1", [[1, 1]]]}]},
        scalars={"q.*": "state"},
        names={"T": {"is": "total", "of": ["node", 0]}, "S.*": {"is": "sum", "of": ["edge", 0]}},
        conditions=[],
    )  # fmt: skip
    assert "without sums" in explain(one)


def test_a_total_under_two_laws_is_declined():
    """T' depends on the law, so one symbol cannot stand for both."""
    one = certificate(
        {"claim": "return r1 r2", "V": "return T", "node": "return q.i", "f": "return u.i",
         "L1": "return 1", "L2": "return q.i"},
        {"generators": free("T", "T'", "q.i")},
        scalars={"q.*": "state", "u.*": "input"},
        motion={"q.*": ["f", 0]},
        laws={"one": {"u.*": ["L1", 0]}, "two": {"u.*": ["L2", 0]}},
        names={"T": {"is": "total", "of": ["node", 0]}, "r1": {"is": "rate", "of": ["V", 0], "law": "one"},
               "r2": {"is": "rate", "of": ["V", 0], "law": "two"}},
        conditions=[],
    )  # fmt: skip
    assert explain(one) == "declined: T' is read under two laws"


def test_a_claim_may_speak_of_a_node_and_its_neighbour():
    """What is given holds at both."""
    proof = {"generators": free("q.i", "q.j")}
    unit = {"scalars": {"q.*": "state"}, "given": [given("zero", "unit")]}
    listing = "a = SQ q.i\nb = SUB a 1\nreturn b"
    one = certificate({"claim": "a = SQ q.i\nb = SQ q.j\nreturn a b", "unit": listing}, proof, **unit)
    assert status(one) == "valid"
    other = certificate({"claim": "return q.i q.j", "unit": listing}, proof, **unit, conditions=[])
    assert status(other) == "invalid"


def test_an_idle_generator_factor_or_hint_is_refused():
    for field, extra in (
        ("generators", {"free": "y"}),
        ("generators", {"abs": [X]}),
        ("factors", [X]),
        ("hints", {}),
    ):
        one = made("relation")
        one["proof"][field].append(extra)
        assert status(seal(one)) == "invalid"
