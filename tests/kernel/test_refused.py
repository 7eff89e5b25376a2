"""Hand-made certificates of what is false, by a name, a symbol or a value that is not what it seems.

Each is refused for its own reason, and the same without the trick is valid.
"""

import pytest

from tests.arena.arguments import EXISTS, SQUARE, STABLE, START, V
from tests.arena.stated import carry, postfix, say, theorem, with_proofs
from tests.kernel.certificates import certificate, explain, free, seal

VALID = "valid: verified by its argument"


# names of listings that are made by the kernel


def damped():
    """x' = -k x."""
    lines = [("falls", {"V": "V"}), SQUARE, EXISTS]
    given = [("positive", "k", "parameter")]
    kinds = {"k": "parameter"}
    motion = {"x": "x k * neg"}
    return with_proofs(theorem(motion, ["x x *"], [say("bounded", 0)], V, lines, given=given, scalars=kinds))


def assumed_as(name):
    """With this name of the listing of what is assumed: as `obligation` it would be whatever is to prove."""
    case = damped()
    statement = case["statement"]
    statement["listings"][name] = statement["listings"].pop("given 0")
    statement["given"][0]["of"] = [name, 0]
    return explain(seal(case))


@pytest.mark.parametrize("name", ["obligation", "mode", "modes", "mode is", "mode below"])
def test_a_listing_of_the_statement_has_no_name_of_the_rules(name):
    assert assumed_as("what is given") == VALID
    assert assumed_as(name) == f"invalid: the name {name} of a listing belongs to the rules"


def test_a_listing_of_the_argument_has_no_name_of_the_rules():
    case = damped()
    case["proof"]["listings"]["obligation"] = postfix("k")
    assert explain(seal(case)) == "invalid: the name obligation of a listing belongs to the rules"


# sentences with fields that are not of their word


def saying(sentence):
    """x' = -x: all that is said of x and x^2 without another field is true, and proved."""
    lines = [*START, ("barbalat", {"e": "x", "W": "V", "power": "2"})]
    case = with_proofs(theorem(STABLE, ["x x *", "x"], [say("tends", 1)], V, lines))
    case["statement"]["claim"]["then"] = [sentence]
    return explain(seal(case))


@pytest.mark.parametrize(
    ("sentence", "more"),
    [
        (say("tends", 1), {"by": 0}),
        (say("tends", 1), {"zero": True}),
        (say("bounded", 0), {"zero": True}),
        (say("summable", 0), {"by": 0}),
        (say("summable", 0), {"zero": True}),
        (say("exists"), {"by": 0}),
    ],
)
def test_a_sentence_has_no_field_that_says_nothing(sentence, more):
    assert saying(sentence) == VALID
    answer = saying({**sentence, **more})
    assert answer == f"invalid: claim, then: {sentence['word']} is not said like this"


# a switch at its jump


def kept_by(rate):
    """x' = 0 and x >= 0, y' = rate: y >= 0 is kept."""
    lines = [("keeps", {"g": "x"}), EXISTS, ("keeps", {"g": "y"})]
    given, bounded = [("nonnegative", "x", "initial")], [say("bounded", 0)]
    motion, quantities = {"x": "0", "y": rate}, {"x": "x", "y": "y"}
    case = theorem(motion, ["y"], [say("stays", 0)], quantities, lines, given=given, suppose=bounded)
    return with_proofs(case)


def test_a_switch_is_not_nonnegative_where_its_argument_may_be_zero():
    """x = 0, y = -t is a solution in the sense of Filippov of y' = sgn(x)."""
    assert explain(kept_by("x")) == VALID
    assert explain(kept_by("x abs")) == VALID
    case = kept_by("x sign")
    case["proof"]["lines"][2]["proofs"]["g is kept"] = {
        "given": [0],
        "proof": {
            "kind": "combination",
            "generators": [*free("x", "y"), {"abs": [["1", 0, 1]]}, {"sign": [["1", 0, 1]], "abs": 2}],
            "factors": [],
            "hints": [{"is": [[[], [["1", 3, 1]]]]}],
            "entries": [{"terms": [["1", [[["1", 3, 1]]], []]]}],
        },
    }
    assert "g is kept: entry 0, term 0: the sign of sign(x) is not known" in explain(seal(case))


def bounded_by_a_rate(rate, bound):
    """x' = rate, a' = 0, and the integral of the bound is finite."""
    lines = [carry("bounded", "rate", e="x", by="s"), EXISTS]
    if rate == "a":
        falls = ("falls", {"V": "A"})
        lines = [falls, carry("bounded", "square", e="a", by=["A"]), *lines]
    quantities = {"x": "x", "s": bound} | ({"a": "a", "A": "a a *"} if rate == "a" else {})
    supposed = [say("summable", 1)]
    return theorem(
        {"x": rate, "a": "0"}, ["x", bound], [say("bounded", 0)], quantities, lines, suppose=supposed
    )


def test_what_is_supposed_does_not_jump():
    """x = t, a = 0 solves x' = sgn(a) in the sense of Filippov, and the integral of |sgn(0)| is 0."""
    assert explain(with_proofs(bounded_by_a_rate("a", "a abs"))) == VALID
    jumping = explain(bounded_by_a_rate("a sign", "a sign abs"))
    assert jumping == "invalid: what is supposed, that summable, jumps where a switch turns"


# symbols that the statement does not have


def squares(claim, generators, *of):
    """That a formula of x is a sum of squares of these polynomials."""
    proof = {
        "kind": "combination",
        "generators": generators,
        "entries": [{"terms": [["1", [], [p]] for p in of]}],
    }
    more = {"scalars": {"x": "state"}, "conditions": []}
    nonnegative = {"kind": "nonnegative", "shape": [1, 1], "listing": "claim"}
    return explain(certificate({"claim": claim}, proof, claim=nonnegative, **more))


def test_a_generator_is_a_symbol_of_the_statement():
    """The root of -(a - b)^2 - 1, for a and b of which nothing is said, would have a negative square."""
    assert squares("a = SQ x\nreturn a", free("x"), [["1", 0, 1]]) == "valid: verified by its combination"
    radicand = [["-1", 2, 2], ["2", 1, 1, 2, 1], ["-1", 1, 2], ["-1"]]
    table = [*free("x", "ghost", "spirit"), {"root": 2, "of": radicand}]
    of = (
        [["1/2", 0, 1], ["1/2"]],
        [["1/2", 0, 1, 3, 1], ["-1/2", 3, 1]],
        [["1/2", 0, 1, 1, 1], ["-1/2", 0, 1, 2, 1], ["-1/2", 1, 1], ["1/2", 2, 1]],
    )
    answer = squares("return x", table, *of)
    assert answer == "invalid: ghost is no symbol that the statement reads"
