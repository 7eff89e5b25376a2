"""What each operation of an `Expr` does to the scalar entries of its arguments.

Entries are listed column by column. Shapes were checked when the node was made. Nothing is simplified:
products with a literal zero stay, so that every division and root of the author's text is an instruction of
the graph.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import reduce
from typing import Any

from symctrl.literals import Scalar, binary, named, unary

Shape = tuple[int, int]
Entries = tuple[Scalar, ...]
Grid = list[list[Scalar]]  # rows of scalars

ZERO, ONE = Fraction(0), Fraction(1)
FUNCTIONS = {
    "absolute": "FABS",
    "sgn": "SIGN",
    "sqrt": "SQRT",
    "sin": "SIN",
    "cos": "COS",
    "tan": "TAN",
    "asin": "ASIN",
    "acos": "ACOS",
    "atan": "ATAN",
    "exp": "EXP",
    "log": "LOG",
    "sinh": "SINH",
    "cosh": "COSH",
    "tanh": "TANH",
}
COMPONENTWISE = {"add": "ADD", "sub": "SUB", "minimum": "FMIN", "maximum": "FMAX", "atan2": "ATAN2"}
LARGEST_COFACTOR_SIZE = 4


def component_names(name: str, shape: Shape, symmetric: bool = False) -> tuple[str, ...]:
    """The scalar names of a symbol column by column: `a`, `v[k]` or `M[r,c]`, counted from 1.

    A symmetric matrix uses the names of its upper triangle on both sides.
    """
    rows, cols = shape
    if shape == (1, 1):
        return (name,)
    if cols == 1:
        return tuple(f"{name}[{r}]" for r in range(1, rows + 1))
    positions = [(r, c) for c in range(1, cols + 1) for r in range(1, rows + 1)]
    if symmetric:
        positions = [(min(p), max(p)) for p in positions]
    return tuple(f"{name}[{r},{c}]" for r, c in positions)


def entries_of(op: str, args: tuple[Any, ...], shape: Shape) -> Entries:
    """The entries of a node whose Expr arguments have theirs (`argument.entries`)."""
    if op in FUNCTIONS:
        return tuple(unary(FUNCTIONS[op], x) for x in args[0].entries)
    if op in COMPONENTWISE:
        left, right = args
        return tuple(
            binary(COMPONENTWISE[op], a, b) for a, b in zip(left.entries, right.entries, strict=True)
        )
    return _RULES[op](args, shape)


def grid(x: Any) -> Grid:
    """The entries of a node, row by row."""
    rows, cols = x.shape
    return [[x.entries[r + c * rows] for c in range(cols)] for r in range(rows)]


def flat(rows: Sequence[Sequence[Scalar]]) -> Entries:
    """Rows of scalars, column by column."""
    return tuple(row[c] for c in range(len(rows[0])) for row in rows)


def add(a: Scalar, b: Scalar) -> Scalar:
    return binary("ADD", a, b)


def sub(a: Scalar, b: Scalar) -> Scalar:
    return binary("SUB", a, b)


def mul(a: Scalar, b: Scalar) -> Scalar:
    return binary("MUL", a, b)


def total(values: Sequence[Scalar]) -> Scalar:
    return reduce(add, values)


def product(a: Grid, b: Grid) -> Grid:
    columns = list(zip(*b, strict=True))
    return [[total([mul(x, y) for x, y in zip(row, col, strict=True)]) for col in columns] for row in a]


def determinant(m: Grid) -> Scalar:
    """By cofactors of the first row up to 4x4, above that from the characteristic polynomial."""
    if len(m) > LARGEST_COFACTOR_SIZE:
        return _faddeev_leverrier(m)[1]
    if len(m) == 1:
        return m[0][0]
    if len(m) == 2:
        return sub(mul(m[0][0], m[1][1]), mul(m[0][1], m[1][0]))
    first, *rest = [mul(m[0][c], determinant(_minor(m, 0, c))) for c in range(len(m))]
    for c, term in enumerate(rest, 1):
        first = (sub if c % 2 else add)(first, term)
    return first


def adjugate(m: Grid) -> tuple[Grid, Scalar]:
    """(adjugate, determinant), both without a division by an entry."""
    size = len(m)
    if size > LARGEST_COFACTOR_SIZE:
        return _faddeev_leverrier(m)
    if size == 1:
        return [[ONE]], m[0][0]
    signed = [[determinant(_minor(m, c, r)) for c in range(size)] for r in range(size)]
    return (
        [[unary("NEG", x) if (r + c) % 2 else x for c, x in enumerate(row)] for r, row in enumerate(signed)],
        determinant(m),
    )


def _minor(m: Grid, row: int, col: int) -> Grid:
    return [r[:col] + r[col + 1 :] for k, r in enumerate(m) if k != row]


def _faddeev_leverrier(m: Grid) -> tuple[Grid, Scalar]:
    """Adjugate and determinant of m in n^4 operations; it divides by the integers 2..n only.

    With B_1 = I, c_k = -tr(m B_k)/k and B_(k+1) = m B_k + c_k I (Faddeev and LeVerrier): the adjugate is
    (-1)^(n-1) B_n and the determinant (-1)^n c_n.
    """
    size = len(m)
    last: Grid = [[ONE if r == c else ZERO for c in range(size)] for r in range(size)]
    for k in range(1, size + 1):
        image = product(m, last) if k > 1 else m
        trace = total([image[r][r] for r in range(size)])
        coefficient = unary("NEG", trace) if k == 1 else binary("DIV", trace, Fraction(-k))
        if k == size:
            break
        last = [
            [add(x, coefficient) if r == c else x for c, x in enumerate(row)] for r, row in enumerate(image)
        ]
    if size % 2:
        return last, unary("NEG", coefficient)
    return [[unary("NEG", x) for x in row] for row in last], coefficient


def _literal(args: tuple[Any, ...], shape: Shape) -> Entries:
    return (args[0],)


def _symbol(args: tuple[Any, ...], shape: Shape) -> Entries:
    name, _, symmetric = args
    return tuple(named(n) for n in component_names(name, shape, symmetric))


def _deferred(args: tuple[Any, ...], shape: Shape) -> Entries:
    return tuple(named(n) for n in component_names(args[0].label, shape))


def _foreign(args: tuple[Any, ...], shape: Shape) -> Entries:
    return tuple(args[1])


def _neg(args: tuple[Any, ...], shape: Shape) -> Entries:
    return tuple(unary("NEG", x) for x in args[0].entries)


def _scale(args: tuple[Any, ...], shape: Shape) -> Entries:
    a, b = args
    if a.shape == (1, 1):
        return tuple(mul(a.entries[0], x) for x in b.entries)
    return tuple(mul(x, b.entries[0]) for x in a.entries)


def _matmul(args: tuple[Any, ...], shape: Shape) -> Entries:
    return flat(product(grid(args[0]), grid(args[1])))


def _divide(args: tuple[Any, ...], shape: Shape) -> Entries:
    (divisor,) = args[1].entries
    return tuple(binary("DIV", x, divisor) for x in args[0].entries)


def _power(args: tuple[Any, ...], shape: Shape) -> Entries:
    (exponent,) = args[1].entries
    return tuple(binary("POW", x, exponent) for x in args[0].entries)


def _signed_power(args: tuple[Any, ...], shape: Shape) -> Entries:
    (exponent,) = args[1].entries
    return tuple(mul(binary("POW", unary("FABS", x), exponent), unary("SIGN", x)) for x in args[0].entries)


def _saturate(args: tuple[Any, ...], shape: Shape) -> Entries:
    x, limit = args
    limits = limit.entries if limit.shape == shape else limit.entries * len(x.entries)
    return tuple(
        binary("FMAX", unary("NEG", bound), binary("FMIN", value, bound))
        for value, bound in zip(x.entries, limits, strict=True)
    )


def _transpose(args: tuple[Any, ...], shape: Shape) -> Entries:
    return flat(list(zip(*grid(args[0]), strict=True)))


def _index(args: tuple[Any, ...], shape: Shape) -> Entries:
    x, rows, cols = args
    return tuple(x.entries[r + c * x.shape[0]] for c in cols for r in rows)


def _stack(args: tuple[Any, ...], shape: Shape) -> Entries:
    return flat([row for x in args for row in grid(x)])


def _row(args: tuple[Any, ...], shape: Shape) -> Entries:
    return tuple(entry for x in args for entry in x.entries)


def _diagonal(args: tuple[Any, ...], shape: Shape) -> Entries:
    rows: Grid = [[ZERO] * shape[1] for _ in range(shape[0])]
    top = left = 0
    for block in args:
        for r, entries in enumerate(grid(block)):
            rows[top + r][left : left + block.shape[1]] = entries
        top, left = top + block.shape[0], left + block.shape[1]
    return flat(rows)


def _eye(args: tuple[Any, ...], shape: Shape) -> Entries:
    return tuple(ONE if r == c else ZERO for c in range(shape[1]) for r in range(shape[0]))


def _zeros(args: tuple[Any, ...], shape: Shape) -> Entries:
    return (ZERO,) * (shape[0] * shape[1])


def _skew(args: tuple[Any, ...], shape: Shape) -> Entries:
    x, y, z = args[0].entries
    nx, ny, nz = (unary("NEG", v) for v in (x, y, z))
    return flat([[ZERO, nz, y], [z, ZERO, nx], [ny, x, ZERO]])


def _cross(args: tuple[Any, ...], shape: Shape) -> Entries:
    a, b = args[0].entries, args[1].entries
    return tuple(sub(mul(a[i], b[j]), mul(a[j], b[i])) for i, j in ((1, 2), (2, 0), (0, 1)))


def _dot(args: tuple[Any, ...], shape: Shape) -> Entries:
    return (total([mul(a, b) for a, b in zip(args[0].entries, args[1].entries, strict=True)]),)


def _inverse(args: tuple[Any, ...], shape: Shape) -> Entries:
    rows, det = adjugate(grid(args[0]))
    return tuple(binary("DIV", x, det) for x in flat(rows))


def _det(args: tuple[Any, ...], shape: Shape) -> Entries:
    return (determinant(grid(args[0])),)


def _trace(args: tuple[Any, ...], shape: Shape) -> Entries:
    return (total([row[k] for k, row in enumerate(grid(args[0]))]),)


def _kron(args: tuple[Any, ...], shape: Shape) -> Entries:
    a, b = grid(args[0]), grid(args[1])
    return flat([[mul(x, y) for x in row_a for y in row_b] for row_a in a for row_b in b])


def _norm(args: tuple[Any, ...], shape: Shape) -> Entries:
    vector, p = args
    if p == "2" and len(vector.entries) > 1:
        return (unary("SQRT", total([unary("SQ", x) for x in vector.entries])),)
    sizes = [unary("FABS", x) for x in vector.entries]
    return (reduce(lambda a, b: binary("FMAX", a, b), sizes),) if p == "inf" else (total(sizes),)


_RULES: dict[str, Callable[[tuple[Any, ...], Shape], Entries]] = {
    "literal": _literal,
    "symbol": _symbol,
    "deferred": _deferred,
    "foreign": _foreign,
    "neg": _neg,
    "scale": _scale,
    "matmul": _matmul,
    "divide": _divide,
    "power": _power,
    "signed_power": _signed_power,
    "saturate": _saturate,
    "transpose": _transpose,
    "index": _index,
    "stack": _stack,
    "row": _row,
    "diagonal": _diagonal,
    "eye": _eye,
    "zeros": _zeros,
    "skew": _skew,
    "cross": _cross,
    "dot": _dot,
    "inverse": _inverse,
    "det": _det,
    "trace": _trace,
    "kron": _kron,
    "norm": _norm,
}
