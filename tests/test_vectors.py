"""Functions on expressions against numpy, at random points."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca
import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symctrl import vectors as sv
from symctrl.expr import Expr, Nonconforming, lift, symbol

Array = npt.NDArray[np.float64]
SEEDS = st.integers(0, 10_000)
x = symbol("x")
a, b, M = symbol("a", (3, 1)), symbol("b", (3, 1)), symbol("M", (3, 3))
N = symbol("N", (2, 3))


def evaluate(expr: Expr, *given: tuple[Expr, Array]) -> Array:
    function = ca.Function("f", [s.sx for s, _ in given], [expr.sx])
    return np.asarray(function(*[value for _, value in given]))


def drawn(seed: int, *shape: int, low: float = -2, high: float = 2) -> Array:
    return np.random.default_rng(seed).uniform(low, high, shape)


@pytest.mark.parametrize("size", [1, 2, 3, 4, 5, 6])
@given(SEEDS)
def test_inverse_and_determinant(size: int, seed: int) -> None:
    m = symbol("m", (size, size))
    value = drawn(seed, size, size) + 5 * np.eye(size)
    assert evaluate(sv.inverse(m), (m, value)) == pytest.approx(np.linalg.inv(value), rel=1e-9, abs=1e-9)
    assert evaluate(sv.det(m), (m, value)) == pytest.approx(np.linalg.det(value), rel=1e-9)


@pytest.mark.parametrize("size", [1, 2, 3, 4, 5, 6])
def test_an_inverse_of_numbers_is_exact(size: int) -> None:
    hilbert = lift([[f"1/{r + c + 1}" for c in range(size)] for r in range(size)])
    assert (sv.inverse(hilbert) @ hilbert).entries == sv.eye(size).entries


LINEAR: dict[str, tuple[Expr, Callable[[Array, Array, Array], Any]]] = {
    "skew": (sv.skew(a) @ b, lambda p, q, m: np.cross(p.T, q.T).T),
    "cross": (sv.cross(a, b), lambda p, q, m: np.cross(p.T, q.T).T),
    "dot": (sv.dot(a, b.T), lambda p, q, m: p.T @ q),
    "trace": (sv.trace(M), lambda p, q, m: np.trace(m)),
    "transpose": (sv.transpose(M), lambda p, q, m: m.T),
    "kron": (sv.kron(M, a.T), lambda p, q, m: np.kron(m, p.T)),
    "stack": (sv.stack(M, a.T, [[1, 2, 3]]), lambda p, q, m: np.vstack([m, p.T, [[1, 2, 3]]])),
    "row": (sv.row(M, a, b), lambda p, q, m: np.hstack([m, p, q])),
    "block": (sv.block([[M, a], [b.T, 0]]), lambda p, q, m: np.block([[m, p], [q.T, np.zeros((1, 1))]])),
    "diagonal": (
        sv.diagonal(M, 2, a),
        lambda p, q, m: np.block(
            [
                [m, np.zeros((3, 2))],
                [np.zeros((1, 3)), np.array([[2.0, 0.0]])],
                [np.zeros((3, 4)), p],
            ]
        ),
    ),
    "diagonal of a vector": (sv.diagonal(a), lambda p, q, m: np.diag(p.ravel())),
    "eye": (M - sv.eye(3), lambda p, q, m: m - np.eye(3)),
    "zeros": (sv.row(M, sv.zeros(3)), lambda p, q, m: np.hstack([m, np.zeros((3, 1))])),
    "norm": (sv.norm(a), lambda p, q, m: np.linalg.norm(p)),
    "norm 1": (sv.norm(a, 1), lambda p, q, m: np.abs(p).sum()),
    "norm inf": (sv.norm(a.T, "inf"), lambda p, q, m: np.abs(p).max()),
    "norm of a scalar": (sv.norm(a[0]), lambda p, q, m: np.abs(p[0])),
    "absolute": (sv.absolute(M), lambda p, q, m: np.abs(m)),
    "sgn": (sv.sgn(M), lambda p, q, m: np.sign(m)),
    "minimum": (sv.minimum(a, b), lambda p, q, m: np.minimum(p, q)),
    "maximum": (sv.maximum(a, b), lambda p, q, m: np.maximum(p, q)),
    "atan2": (sv.atan2(a, b), lambda p, q, m: np.arctan2(p, q)),
    "power": (sv.power(a, 3), lambda p, q, m: p**3),
    "signed_power": (sv.signed_power(a, "3/5"), lambda p, q, m: np.abs(p) ** 0.6 * np.sign(p)),
    "saturate": (sv.saturate(a, "0.5"), lambda p, q, m: np.clip(p, -0.5, 0.5)),
    "saturate by component": (
        sv.saturate(a, sv.absolute(b)),
        lambda p, q, m: np.clip(p, -np.abs(q), np.abs(q)),
    ),
}


@pytest.mark.parametrize(("expr", "meaning"), LINEAR.values(), ids=LINEAR)
@given(SEEDS)
def test_it_means_what_numpy_computes(
    expr: Expr, meaning: Callable[[Array, Array, Array], Any], seed: int
) -> None:
    p, q, m = drawn(seed, 3, 1), drawn(seed + 1, 3, 1), drawn(seed + 2, 3, 3)
    expected = np.asarray(meaning(p, q, m)).reshape(expr.shape)
    assert evaluate(expr, (a, p), (b, q), (M, m)) == pytest.approx(expected, rel=1e-12, abs=1e-12)


FUNCTIONS: list[tuple[Callable[[Expr], Expr], Callable[[Array], Array], float, float]] = [
    (sv.sqrt, np.sqrt, 0, 2),
    (sv.sin, np.sin, -2, 2),
    (sv.cos, np.cos, -2, 2),
    (sv.tan, np.tan, -1, 1),
    (sv.asin, np.arcsin, -1, 1),
    (sv.acos, np.arccos, -1, 1),
    (sv.atan, np.arctan, -2, 2),
    (sv.exp, np.exp, -2, 2),
    (sv.log, np.log, 0.1, 2),
    (sv.sinh, np.sinh, -2, 2),
    (sv.cosh, np.cosh, -2, 2),
    (sv.tanh, np.tanh, -2, 2),
]


@pytest.mark.parametrize(("ours", "theirs", "low", "high"), FUNCTIONS, ids=[f[0].__name__ for f in FUNCTIONS])
@given(SEEDS)
def test_functions_act_on_each_component(
    ours: Callable[[Expr], Expr], theirs: Callable[[Array], Array], low: float, high: float, seed: int
) -> None:
    value = drawn(seed, 3, 3, low=low, high=high)
    assert evaluate(ours(M), (M, value)) == pytest.approx(theirs(value), rel=1e-12)


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        (sv.absolute("-1/3"), "1/3"),
        (sv.sgn(-3), "-1"),
        (sv.minimum("0.1", "1/3"), "1/10"),
        (sv.norm(["-1/3", "1/6"], 1), "1/2"),
        (sv.power("2/3", -2), "9/4"),
        (sv.saturate(5, "1/7"), "1/7"),
        (sv.dot([1, "1/3"], [3, 3]), "4"),
    ],
)
def test_what_is_rational_is_computed_exactly(written: Expr, expected: str) -> None:
    assert written.value is not None
    assert str(written.value) == expected


@pytest.mark.parametrize("written", [sv.sin(1), sv.sqrt(2), sv.norm([1, 1]), lift(2) ** "1/2", sv.exp("1/3")])
def test_what_is_not_rational_is_not_rounded(written: Expr) -> None:
    assert written.value is None
    assert ca.symvar(written.sx)


REFUSED: dict[str, tuple[Callable[[], Any], str]] = {
    "stack": (lambda: sv.stack(a, N), "left is 3x1, right is 2x3"),
    "row": (lambda: sv.row(a, N), "left is 3x1, right is 2x3"),
    "block": (lambda: sv.block([[M, a], [b, 1]]), "left is 3x1, right is 1x1"),
    "skew": (lambda: sv.skew(a.T), "needs a 3x1 vector, given 1x3"),
    "cross": (lambda: sv.cross(a, [1, 2]), "needs a 3x1 vector, given 2x1"),
    "dot": (lambda: sv.dot(a, [1, 2]), "left is 3x1, right is 2x1"),
    "dot of matrices": (lambda: sv.dot(M, M), "needs a vector, given 3x3"),
    "inverse": (lambda: sv.inverse(N), "needs a square matrix, given 2x3"),
    "det": (lambda: sv.det(a), "needs a square matrix, given 3x1"),
    "trace": (lambda: sv.trace(N), "needs a square matrix, given 2x3"),
    "norm": (lambda: sv.norm(M), "needs a vector, given 3x3"),
    "power": (lambda: sv.power(a, b), "left is 3x1, right is 3x1"),
    "signed_power": (lambda: sv.signed_power(a, b), "left is 3x1, right is 3x1"),
    "saturate": (lambda: sv.saturate(a, [1, 2]), "left is 3x1, right is 2x1"),
    "minimum": (lambda: sv.minimum(a, 1), "left is 3x1, right is 1x1"),
    "atan2": (lambda: sv.atan2(a, x), "left is 3x1, right is 1x1"),
}


@pytest.mark.parametrize(("write", "words"), REFUSED.values(), ids=REFUSED)
def test_shapes_are_strict(write: Callable[[], Any], words: str) -> None:
    with pytest.raises(Nonconforming, match=words):
        write()


def test_sizes_and_norms_that_do_not_exist_are_refused() -> None:
    with pytest.raises(ValueError, match="at least one row"):
        sv.zeros(0, 3)
    with pytest.raises(ValueError, match="p = 1, 2"):
        sv.norm(a, 3)
    with pytest.raises(TypeError, match="at least one argument"):
        sv.stack()
