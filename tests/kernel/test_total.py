"""Sums over all nodes that are nonnegative: node by node, and mode by mode of the Laplacian."""

import pytest

from tests.arena.stated import postfix
from tests.kernel.certificates import certificate, explain, free, given, seal

MODE = {"kind": "combination", "factors": [], "hints": []}


def combination(names, *terms):
    return {**MODE, "generators": free(*names), "entries": [{"terms": list(terms)}]}


def square(k):
    return ["1", [], [[["1", k, 1]]]]


def spectral(node, modes, edge="x.i x.j -", names=(), sums=([], [[2, 1]]), chosen=(1,), **more):
    """That the sum over nodes of a formula is not negative. S.i: the sum over neighbours of that of an edge.

    The free generators are T, x.i, x.j and those of `names`; sums: those of products of them.
    assumed: listings that are given not to be negative.
    """
    table = [*free("T", "x.i", "x.j", *names)]
    table += [{"sum": of, "node": "i"} for of in sums]
    inner = {"given": list(chosen), "proof": modes}
    assumed = more.pop("assumed", {})
    listings = {"claim": "return T", "b": "return B"} | assumed
    case = certificate(
        listings,
        {
            "kind": "spectral",
            "generators": table,
            "bound": 0,
            "modes": inner,
        },
        scalars={"x.*": "state", "B": "parameter", **more.pop("scalars", {})},
        names={"T": {"is": "total", "of": ["node", 0]}, "S.*": {"is": "sum", "of": ["edge", 0]}},
        given=[given("laplacian_bound", "b"), *(given("nonnegative", name) for name in assumed)],
        claim={"kind": "nonnegative", "shape": [1, 1], "listing": "claim"},
        conditions=[],
    )
    case["statement"]["listings"] |= {"node": postfix(node), "edge": postfix(edge)}
    return explain(seal(case))


VALID = "valid: verified by its each"
FORM = combination(("x.i", "mode"), ["1", [0], [[["1", 0, 1]]]])


def test_a_form_in_x_and_the_laplacian_of_x():
    assert spectral("x.i S.i *", FORM) == "valid: verified by its spectral"


def test_the_form_of_another_sign_is_refused():
    assert "the sides differ" in spectral("x.i S.i * neg", FORM)


def test_modes_are_not_assumed_to_be_above_zero_by_the_bound():
    assert spectral("x.i S.i *", FORM, chosen=(2,)).startswith("invalid: ")


@pytest.mark.parametrize(
    ("node", "edge", "sums", "reason"),
    [
        ("x.i S.i *", "x.j", ([[2, 1]],), "the degree of a node does not cancel"),
        ("S.i", "x.j x.j *", ([[2, 2]],), "the degree of a node does not cancel"),
        ("x.i x.i * S.i *", "x.i x.j -", ([], [[2, 1]]), "no quadratic form"),
        ("x.i S.i +", "x.i x.j -", ([], [[2, 1]]), "no quadratic form"),
        ("x.i S.i *", "x.j x.j *", ([[2, 2]],), "a product beside other symbols"),
    ],
)
def test_what_is_no_form_of_modes(node, edge, sums, reason):
    answer = spectral(node, FORM, edge, sums=sums)
    assert answer.startswith("invalid: ")
    assert reason in answer


def test_a_coefficient_is_constant():
    moving = spectral("x.i S.i * z *", FORM, names=("z",), scalars={"z": "state"})
    assert "no product of symbols of a node" in moving
    modes = combination(("x.i", "mode", "z"), ["1", [0, 1], [[["1", 0, 1]]]])
    more = {"scalars": {"z": "parameter"}, "assumed": {"z is": "return z"}, "chosen": (1, 2)}
    assert spectral("x.i S.i * z *", modes, names=("z",), **more) == "valid: verified by its spectral"


@pytest.mark.parametrize("name", ["modes", "mode is", "mode below"])
def test_the_names_of_what_is_about_modes_belong_to_the_proof(name):
    def assuming(name):
        return spectral("x.i S.i *", FORM, names=("B",), assumed={name: "return B"}, chosen=(2,))

    assert assuming("B is") == "valid: verified by its spectral"
    assert assuming(name) == f"invalid: the name {name} of a listing belongs to the proof"


def test_signs_at_nodes_say_nothing_of_modes():
    """x = (1, 0), y = (0, 1), nowhere negative: the sum over the nodes of x (L y) is -1."""
    states = {"scalars": {"y.*": "state"}, "names": ("y.i", "y.j"), "sums": ([], [[4, 1]])}
    assumed = {"x is": "return x.i", "y is": "return y.i"}
    product = combination(("x.i", "y.i", "mode"), ["1", [0, 1, 2], []])
    answer = spectral("x.i S.i *", product, "y.i y.j -", assumed=assumed, chosen=(1, 2, 3), **states)
    assert answer == "invalid: an assumption about what belongs to a node says nothing of modes"


def each(term, proof, names=("T", "x.i"), claim="T", chosen=(), assumed=None, kind="nonnegative", more=None):
    """assumed: listings that are given, of this kind. more: a second sum over nodes, U."""
    case = certificate(
        {"claim": "return T", **(assumed or {})},
        {"kind": "each", "generators": free(*names), "term": {"given": list(chosen), "proof": proof}},
        scalars={"x.*": "state"} | ({"k": "parameter"} if "k" in names else {}),
        names={"T": {"is": "total", "of": ["node", 0]}}
        | ({"U": {"is": "total", "of": ["more", 0]}} if more else {}),
        given=[given(kind, name) for name in assumed or {}],
        claim={"kind": "nonnegative", "shape": [1, 1], "listing": "claim"},
        conditions=[],
    )
    case["statement"]["listings"] |= {"claim": postfix(claim), "node": postfix(term)}
    if more:
        case["statement"]["listings"]["more"] = postfix(more)
    return explain(seal(case))


def test_a_sum_of_squares_node_by_node():
    assert each("x.i x.i *", combination(("x.i",), square(0))) == VALID
    assert "the sides differ" in each("x.i x.i * neg", combination(("x.i",), square(0)))
    assert "declined" in each("x.i x.i *", {"kind": "definite"})


def test_the_name_of_the_term_belongs_to_the_proof():
    """As `mode`, k >= 0 would be the claim itself: -x^2 >= 0."""
    weighted, names = combination(("k", "x.i"), ["1", [0], [[["1", 1, 1]]]]), ("T", "x.i", "k")
    node = "k x.i x.i * *"
    assert each(node, weighted, names, chosen=(0,), assumed={"k is": "return k"}) == VALID
    belongs = "invalid: the name mode of a listing belongs to the proof"
    assert each(node, weighted, names, chosen=(0,), assumed={"mode": "return k"}) == belongs


def test_what_is_linear_by_an_assumption_is_not_so_node_by_node():
    """T^2 - U with T = sum x_i = 0, U = sum x_i^2: at a node x_i^2 - x_i^2, and -2 for x = (1, -1)."""
    nothing, names = combination(("x.i",)), ("T", "U", "x.i")
    more = {"assumed": {"T is": "return T"}, "kind": "zero", "more": "x.i x.i *"}
    refused = "invalid: SQ of sums over nodes is not linear in them"
    assert each("x.i", nothing, names, claim="T sq U -", **more) == refused
    assert each("x.i x.i *", nothing, names, claim="T U -", more="x.i x.i *") == VALID
