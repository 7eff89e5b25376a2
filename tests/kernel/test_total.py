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
    """
    table = [*free("T", "x.i", "x.j", *names)]
    table += [{"sum": of, "node": "i"} for of in sums]
    inner = {"given": list(chosen), "proof": modes}
    more_given = more.pop("given", [])
    listings = {"claim": "return T", "b": "return B"} | ({"z is": "return z"} if more_given else {})
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
        given=[given("laplacian_bound", "b"), *more_given],
        claim={"kind": "nonnegative", "shape": [1, 1], "listing": "claim"},
        conditions=[],
    )
    case["statement"]["listings"] |= {"node": postfix(node), "edge": postfix(edge)}
    return explain(seal(case))


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
    sign = {"kind": "nonnegative", "of": ["z is", 0], "text": "z >= 0", "about": "parameter"}
    more = {"scalars": {"z": "parameter"}, "given": [sign], "chosen": (1, 2)}
    assert spectral("x.i S.i * z *", modes, names=("z",), **more) == "valid: verified by its spectral"


def each(term, proof, names=("T", "x.i")):
    case = certificate(
        {"claim": "return T"},
        {"kind": "each", "generators": free(*names), "term": {"given": [], "proof": proof}},
        scalars={"x.*": "state"},
        names={"T": {"is": "total", "of": ["node", 0]}},
        claim={"kind": "nonnegative", "shape": [1, 1], "listing": "claim"},
        conditions=[],
    )
    case["statement"]["listings"]["node"] = postfix(term)
    return explain(seal(case))


def test_a_sum_of_squares_node_by_node():
    assert each("x.i x.i *", combination(("x.i",), square(0))) == "valid: verified by its each"
    assert "the sides differ" in each("x.i x.i * neg", combination(("x.i",), square(0)))
    assert "declined" in each("x.i x.i *", {"kind": "definite"})
