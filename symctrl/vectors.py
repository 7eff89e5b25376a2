"""Functions on expressions: putting vectors and matrices together, and mathematics on them.

Every function lifts its arguments, checks their shapes (Nonconforming) and gives one node. A matrix is rows x
columns, a vector a column. Functions of one argument (`sin`, `sgn`, `absolute`, ..) act on each component.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from symctrl.expr import SCALAR, Expr, Liftable, joined, lift
from symctrl.nonconforming import misfit, mismatch


def stack(*rows: Liftable) -> Expr:
    """The arguments below one another; all have the same number of columns."""
    return joined("stack", _some(rows, "stack"))


def row(*columns: Liftable) -> Expr:
    """The arguments side by side; all have the same number of rows."""
    return joined("row", _some(columns, "row"))


def block(rows: Sequence[Sequence[Liftable]]) -> Expr:
    """A matrix of blocks, given by rows."""
    return joined("stack", _some([row(*blocks) for blocks in rows], "block"))


def diagonal(*blocks: Liftable) -> Expr:
    """The block diagonal matrix of the arguments; one vector alone is taken as the diagonal's entries."""
    parts = _some(blocks, "diagonal")
    if len(parts) == 1 and 1 in parts[0].shape and parts[0].shape != SCALAR:
        parts = list(parts[0])
    return Expr("diagonal", tuple(parts), (sum(p.shape[0] for p in parts), sum(p.shape[1] for p in parts)))


def eye(n: int) -> Expr:
    """The n x n identity matrix."""
    return Expr("eye", (), _size(n, n))


def zeros(rows: int, columns: int = 1) -> Expr:
    """The matrix of zeros."""
    return Expr("zeros", (), _size(rows, columns))


def skew(v: Liftable) -> Expr:
    """The 3x3 matrix of the cross product: skew(v) @ w = v x w."""
    return Expr("skew", (_vector3(v, "skew"),), (3, 3))


def cross(a: Liftable, b: Liftable) -> Expr:
    """The cross product of two 3x1 vectors."""
    return Expr("cross", (_vector3(a, "cross"), _vector3(b, "cross")), (3, 1))


def dot(a: Liftable, b: Liftable) -> Expr:
    """The scalar product of two vectors of equal length."""
    left, right = _vector(a, "dot"), _vector(b, "dot")
    if len(left) != len(right):
        raise mismatch("dot", left, right)
    return Expr("dot", (left, right), SCALAR)


def transpose(M: Liftable) -> Expr:
    """The transpose, columns x rows."""
    return lift(M).T


def inverse(M: Liftable) -> Expr:
    """The inverse of an n x n matrix: its adjugate over its determinant, which stays visible."""
    matrix = _square(M, "inverse")
    return Expr("inverse", (matrix,), matrix.shape)


def det(M: Liftable) -> Expr:
    """The determinant of an n x n matrix."""
    return Expr("det", (_square(M, "det"),), SCALAR)


def trace(M: Liftable) -> Expr:
    """The sum of the diagonal of an n x n matrix."""
    return Expr("trace", (_square(M, "trace"),), SCALAR)


def kron(A: Liftable, B: Liftable) -> Expr:
    """The Kronecker product: (m p) x (n q) for A m x n and B p x q, kept as written."""
    left, right = lift(A), lift(B)
    return Expr("kron", (left, right), (left.shape[0] * right.shape[0], left.shape[1] * right.shape[1]))


def norm(v: Liftable, p: int | float | str = 2) -> Expr:
    """The p-norm of a vector, for p = 1, 2 or "inf". Raises ValueError for another p."""
    name = "inf" if p in ("inf", math.inf) else str(p)
    if name not in ("1", "2", "inf"):
        raise ValueError(f'norm(v, p) is defined for p = 1, 2 and "inf", not {p!r}')
    return Expr("norm", (_vector(v, "norm"), name), SCALAR)


def power(x: Liftable, gamma: Liftable) -> Expr:
    """Each component to the power gamma, a scalar."""
    return _with_scalar("power", x, gamma)


def signed_power(x: Liftable, gamma: Liftable) -> Expr:
    """|x|^gamma sgn(x) in each component; gamma is a scalar."""
    return _with_scalar("signed_power", x, gamma)


def saturate(x: Liftable, limit: Liftable) -> Expr:
    """Each component cut to [-limit, limit]; limit is a scalar or has the shape of x."""
    value, bound = lift(x), lift(limit)
    if bound.shape not in (SCALAR, value.shape):
        raise mismatch("saturate", value, bound, "the limit is a scalar or has the shape of what it limits")
    return Expr("saturate", (value, bound), value.shape)


def minimum(a: Liftable, b: Liftable) -> Expr:
    """The smaller of two components; equal shapes."""
    return _pair("minimum", a, b)


def maximum(a: Liftable, b: Liftable) -> Expr:
    """The larger of two components; equal shapes."""
    return _pair("maximum", a, b)


def atan2(y: Liftable, x: Liftable) -> Expr:
    """The angle of the point (x, y) in (-pi, pi]; equal shapes."""
    return _pair("atan2", y, x)


def absolute(x: Liftable) -> Expr:
    """The absolute value of each component."""
    return _each("absolute", x)


def sgn(x: Liftable) -> Expr:
    """The sign of each component: -1, 0 or 1."""
    return _each("sgn", x)


def sqrt(x: Liftable) -> Expr:
    """The nonnegative square root of each component."""
    return _each("sqrt", x)


def sin(x: Liftable) -> Expr:
    """The sine of each component."""
    return _each("sin", x)


def cos(x: Liftable) -> Expr:
    """The cosine of each component."""
    return _each("cos", x)


def tan(x: Liftable) -> Expr:
    """The tangent of each component."""
    return _each("tan", x)


def asin(x: Liftable) -> Expr:
    """The inverse sine of each component, in [-pi/2, pi/2]."""
    return _each("asin", x)


def acos(x: Liftable) -> Expr:
    """The inverse cosine of each component, in [0, pi]."""
    return _each("acos", x)


def atan(x: Liftable) -> Expr:
    """The inverse tangent of each component, in (-pi/2, pi/2)."""
    return _each("atan", x)


def exp(x: Liftable) -> Expr:
    """The exponential of each component."""
    return _each("exp", x)


def log(x: Liftable) -> Expr:
    """The natural logarithm of each component."""
    return _each("log", x)


def sinh(x: Liftable) -> Expr:
    """The hyperbolic sine of each component."""
    return _each("sinh", x)


def cosh(x: Liftable) -> Expr:
    """The hyperbolic cosine of each component."""
    return _each("cosh", x)


def tanh(x: Liftable) -> Expr:
    """The hyperbolic tangent of each component."""
    return _each("tanh", x)


def _each(op: str, x: Liftable) -> Expr:
    value = lift(x)
    return Expr(op, (value,), value.shape)


def _pair(op: str, a: Liftable, b: Liftable) -> Expr:
    left, right = lift(a), lift(b)
    if left.shape != right.shape:
        raise mismatch(op, left, right)
    return Expr(op, (left, right), left.shape)


def _with_scalar(op: str, x: Liftable, gamma: Liftable) -> Expr:
    value, exponent = lift(x), lift(gamma)
    if exponent.shape != SCALAR:
        raise mismatch(op, value, exponent, "the exponent is a scalar")
    return Expr(op, (value, exponent), value.shape)


def _some(parts: Sequence[Liftable], what: str) -> list[Expr]:
    if not parts:
        raise TypeError(f"{what} needs at least one argument")
    return [lift(part) for part in parts]


def _size(rows: int, columns: int) -> tuple[int, int]:
    if rows < 1 or columns < 1:
        raise ValueError(f"a matrix has at least one row and one column, not {rows}x{columns}")
    return rows, columns


def _vector(v: Liftable, what: str) -> Expr:
    value = lift(v)
    if 1 not in value.shape:
        raise misfit(what, "a vector", value)
    return value


def _vector3(v: Liftable, what: str) -> Expr:
    value = lift(v)
    if value.shape != (3, 1):
        raise misfit(what, "a 3x1 vector", value)
    return value


def _square(M: Liftable, what: str) -> Expr:
    value = lift(M)
    if value.shape[0] != value.shape[1]:
        raise misfit(what, "a square matrix", value)
    return value
