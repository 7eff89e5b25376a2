"""The author's language: `Expr`, an expression as written over a CasADi graph.

An Expr is one node: an operation, its arguments and a shape. Its graph `sx` is built from the node with
CasADi's simplification off, when first asked for, so large structures stay cheap. Shapes are strict: `*`
scales, `@` multiplies, `/` divides by a scalar, nothing is broadcast. Literals are exact.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any, Literal, NoReturn, Protocol, Union, runtime_checkable

import casadi as ca
import numpy as np

from symctrl.entries import Entries, Shape, component_names, entries_of
from symctrl.graph import exact_literal, unfolded
from symctrl.indexing import selection
from symctrl.literals import as_sx
from symctrl.nodes import walk
from symctrl.nonconforming import Nonconforming, mismatch, short_text, size

Liftable = Union["Expr", int, Fraction, str, float, list[Any], tuple[Any, ...], "np.ndarray[Any, Any]"]
Relation = Literal[">=", "<=", ">", "<"]
LARGEST_EXPONENT = 1000  # of a literal in powers of ten
SCALAR: Shape = (1, 1)


@runtime_checkable
class Record(Protocol):
    """What a deferred quantity stands for: any frozen hashable object with a name and its LaTeX."""

    @property
    def label(self) -> str: ...

    @property
    def latex(self) -> str: ...


@dataclass(frozen=True, eq=False, repr=False)
class Expr:
    """An expression of shape rows x columns; a vector is a column. Hashed by identity, no truth value.

    op and args say what was written: `args` holds the argument Exprs and, for some operations, plain data:
    literal (value, text), symbol (name, latex, symmetric), deferred (record,), foreign (text, entries), index
    (x, rows, columns), norm (x, p), eye and zeros (). All others have Exprs only: neg, add, sub, scale (one
    of two is a scalar), matmul, divide, power, signed_power, saturate, transpose, stack, row, diagonal, skew,
    cross, dot, inverse, det, trace, kron, minimum, maximum, atan2 and the functions of one argument.
    """

    op: str
    args: tuple[Any, ...]
    shape: Shape

    __array_ufunc__ = None

    @cached_property
    def entries(self) -> Entries:
        """The scalar entries, column by column: a Fraction for a number, else a CasADi scalar."""
        with unfolded():
            for node in walk(self, skip=lambda n: "entries" in n.__dict__):
                node.__dict__["entries"] = entries_of(node.op, node.args, node.shape)
        result: Entries = self.__dict__["entries"]
        return result

    @cached_property
    def sx(self) -> ca.SX:
        """The dense CasADi graph of this expression."""
        return ca.reshape(ca.vertcat(*[as_sx(entry) for entry in self.entries]), *self.shape)

    @property
    def value(self) -> Fraction | None:
        """The exact number, if this is a scalar made of literals only."""
        only = self.entries[0] if self.shape == SCALAR else None
        return only if isinstance(only, Fraction) else None

    @property
    def T(self) -> Expr:
        return self if self.shape == SCALAR else Expr("transpose", (self,), self.shape[::-1])

    def __add__(self, other: Liftable) -> Expr:
        return _sum("add", self, other)

    def __radd__(self, other: Any) -> Expr:
        # Python's sum() begins with the integer 0, which is no addend of the author's
        return self if type(other) is int and other == 0 else _sum("add", other, self)

    def __sub__(self, other: Liftable) -> Expr:
        return _sum("sub", self, other)

    def __rsub__(self, other: Liftable) -> Expr:
        return _sum("sub", other, self)

    def __neg__(self) -> Expr:
        return Expr("neg", (self,), self.shape)

    def __pos__(self) -> Expr:
        return self

    def __mul__(self, other: Liftable) -> Expr:
        return _scaled(self, other)

    def __rmul__(self, other: Any) -> Expr:
        return _scaled(other, self)

    def __matmul__(self, other: Liftable) -> Expr:
        return _multiplied(self, other)

    def __rmatmul__(self, other: Liftable) -> Expr:
        return _multiplied(other, self)

    def __truediv__(self, other: Liftable) -> Expr:
        return _divided(self, other)

    def __rtruediv__(self, other: Liftable) -> Expr:
        return _divided(other, self)

    def __pow__(self, other: Liftable) -> Expr:
        return _raised(self, other)

    def __rpow__(self, other: Liftable) -> Expr:
        return _raised(other, self)

    def __getitem__(self, key: Any) -> Expr:
        rows, cols = selection(self.shape, key)
        return Expr("index", (self, rows, cols), (len(rows), len(cols)))

    def __iter__(self) -> Iterator[Expr]:
        return (self[k] for k in range(len(self)))

    def __len__(self) -> int:
        if 1 not in self.shape:
            raise TypeError(
                f"a {size(self)} matrix has no length and no order of entries; write M[r, c] or M[r, :]"
            )
        return max(self.shape)

    def __ge__(self, other: Any) -> Comparison:
        return _compared(self, ">=", other)

    def __le__(self, other: Any) -> Comparison:
        return _compared(self, "<=", other)

    def __gt__(self, other: Any) -> Comparison:
        return _compared(self, ">", other)

    def __lt__(self, other: Any) -> Comparison:
        return _compared(self, "<", other)

    def __eq__(self, other: object) -> NoReturn:
        raise TypeError("expressions are not compared with ==: write equal(a, b) for the claim")

    def __ne__(self, other: object) -> NoReturn:
        raise TypeError("expressions are not compared with !=: write nonzero(a - b)")

    __hash__ = object.__hash__

    def __contains__(self, other: object) -> NoReturn:
        raise TypeError("'in' has no meaning for an expression; compare entries with equal(a, b)")

    def __bool__(self) -> NoReturn:
        raise TypeError(
            "an expression has no truth value; write equal(a, b), nonzero(x) or a bound such as x >= 0, "
            "and two conditions instead of a chain a <= x <= b"
        )

    def __abs__(self) -> NoReturn:
        raise TypeError(
            "abs() has several readings: write absolute(v) for each component, norm(v, 1) for their sum, "
            "or norm(v) for the Euclidean length"
        )

    def __array__(self, *args: Any, **kwargs: Any) -> NoReturn:
        raise TypeError("an expression does not go into a numpy array; use stack, row or block")

    def __repr__(self) -> str:
        return f"<Expr {size(self)}: {short_text(self)}>"


@dataclass(frozen=True, eq=False)
class Comparison:
    """`left relation right` as it was written, componentwise; `symctrl.statements` makes a claim of it."""

    left: Expr
    relation: Relation
    right: Expr

    def __bool__(self) -> NoReturn:
        raise TypeError(
            f"the bound {short_text(self.left)} {self.relation} {short_text(self.right)} has no truth value; "
            "write two conditions instead of a chain a <= x <= b, and a list of conditions instead of 'and'"
        )


def lift(x: Liftable) -> Expr:
    """The expression of a number, a string such as "0.95", "1/3" or "1e-3", or a (nested) list of these.

    A flat list is a column vector, a list of lists a matrix given by rows. Raises GraphError for a float that
    has no short decimal, ValueError for a string that is no number, Nonconforming for rows of different
    lengths, TypeError for anything else.
    """
    if isinstance(x, Expr):
        return x
    if x is None or isinstance(x, (bool, complex)):
        raise TypeError(
            f"{x!r} is no expression" + ("; does a function lack its return?" if x is None else "")
        )
    if isinstance(x, np.generic):
        return lift(x.item())
    if isinstance(x, (int, Fraction)):
        value = Fraction(x)
        return Expr("literal", (value, str(value)), SCALAR)
    if isinstance(x, str):
        return Expr("literal", (_number(x), x.strip()), SCALAR)
    if isinstance(x, float):
        value = exact_literal(float(x))
        return Expr("literal", (value, str(value) if value.denominator == 1 else repr(float(x))), SCALAR)
    if isinstance(x, np.ndarray):
        return lift(x.tolist() if x.ndim else x.item())
    if isinstance(x, (list, tuple)):
        return _lift_rows(x)
    raise TypeError(
        f'a {type(x).__name__} is no expression; give an Expr, a number, a string like "1/3" or a list '
        "of these, and take CasADi in by study.wrap(sx)"
    )


def symbol(name: str, shape: Shape = SCALAR, latex: str | None = None, symmetric: bool = False) -> Expr:
    """A free symbol; its scalars are `name`, `name[k]` or `name[r,c]`, counted from 1.

    Raises ValueError for a name that begins like a number or holds a bracket, and for a symmetric shape that
    is not square.
    """
    if not name or not (name[0].isalpha() or name[0] == "_") or any(c in name for c in "[], '"):
        raise ValueError(
            f"{name!r} is no name for a symbol: it begins with a letter and has no brackets or spaces"
        )
    if symmetric and shape[0] != shape[1]:
        raise ValueError(f"symbol {name}: a symmetric matrix is square, not {shape[0]}x{shape[1]}")
    return Expr("symbol", (name, latex, symmetric), _checked(shape))


def deferred(record: Record, shape: Shape = SCALAR) -> Expr:
    """A quantity that stands for something else: a definition's value, a rate, a sum over neighbours.

    record is kept as the node's only argument; its `label` names the scalars, its `latex` prints the node.
    """
    if not isinstance(record, Record):
        raise TypeError(
            f"a deferred quantity needs a record with label and latex, not a {type(record).__name__}"
        )
    return Expr("deferred", (record,), _checked(shape))


def foreign(sx: ca.SX, text: str) -> Expr:
    """An expression built with CasADi itself, printed as `text`. What CasADi folded in it was not seen.

    Raises GraphError for a constant that has no exact value.
    """
    dense = ca.densify(ca.SX(sx))
    elements = [dense.nz[k] for k in range(dense.nnz())]
    entries = [exact_literal(float(e)) if e.is_constant() else e for e in elements]
    return Expr("foreign", (text, tuple(entries)), _checked(dense.shape))


def terms(expr: Expr) -> tuple[Expr, ...]:
    """The addends as written, each with its sign: sums, differences and minus signs are opened only."""
    result: list[Expr] = []
    stack = [(expr, False)]
    while stack:
        node, negative = stack.pop()
        if node.op == "neg":
            stack.append((node.args[0], not negative))
        elif node.op in ("add", "sub"):
            left, right = node.args
            stack += [(right, negative != (node.op == "sub")), (left, negative)]
        else:
            result.append(-node if negative else node)
    return tuple(result)


def scalars(expr: Expr) -> list[str]:
    """The names of all free symbols of the graph, each once, those of named constants (`1/3`) among them."""
    return list(dict.fromkeys(s.name() for s in ca.symvar(expr.sx)))


def _checked(shape: Shape) -> Shape:
    rows, cols = shape
    if rows < 1 or cols < 1:
        raise ValueError(f"a shape has at least one row and one column, not {rows}x{cols}")
    return int(rows), int(cols)


def _number(text: str) -> Fraction:
    try:
        exponent = text.lower().partition("e")[2]
        if exponent and abs(int(exponent)) > LARGEST_EXPONENT:
            raise ValueError("the number would fill the memory")
        return Fraction(text.strip())
    except (ValueError, ZeroDivisionError):
        raise ValueError(
            f'{text!r} is no exact number; write "0.95", "1/3" or "1e-3", or a symbol of the study'
        ) from None


def _lift_rows(rows: list[Any] | tuple[Any, ...]) -> Expr:
    nested = [isinstance(row, (list, tuple, np.ndarray)) for row in rows]
    if not rows:
        raise TypeError("an empty list is no expression")
    if not any(nested):
        return joined("stack", [lift(row) for row in rows])
    if not all(nested):
        raise TypeError(
            "a list of rows and of entries at once; [a, b] is a column, [[a, b], [c, d]] a matrix"
        )
    if any(isinstance(x, (list, tuple, np.ndarray)) for row in rows for x in row):
        raise TypeError(
            "lists are nested three deep; a matrix is a list of rows, and stack or block joins matrices"
        )
    return joined("stack", [joined("row", [lift(x) for x in row]) for row in rows])


def joined(op: str, parts: list[Expr]) -> Expr:
    """Parts below one another (op "stack") or side by side (op "row"). Raises Nonconforming."""
    along = 0 if op == "stack" else 1
    for part in parts[1:]:
        if part.shape[1 - along] != parts[0].shape[1 - along]:
            kind = "columns" if op == "stack" else "rows"
            raise mismatch(op, parts[0], part, f"all parts have the same number of {kind}")
    length, width = sum(p.shape[along] for p in parts), parts[0].shape[1 - along]
    return Expr(op, tuple(parts), (length, width) if op == "stack" else (width, length))


def _sum(op: str, left: Liftable, right: Liftable) -> Expr:
    a, b = lift(left), lift(right)
    if a.shape != b.shape:
        raise mismatch("sum" if op == "add" else "difference", a, b)
    return Expr(op, (a, b), a.shape)


def _scaled(left: Liftable, right: Liftable) -> Expr:
    a, b = lift(left), lift(right)
    if SCALAR not in (a.shape, b.shape):
        hint = "* scales by a scalar; @ multiplies" if a.shape[1] == b.shape[0] else "* scales by a scalar"
        raise mismatch("product", a, b, hint)
    return Expr("scale", (a, b), b.shape if a.shape == SCALAR else a.shape)


def _multiplied(left: Liftable, right: Liftable) -> Expr:
    a, b = lift(left), lift(right)
    if a.shape[1] != b.shape[0]:
        raise mismatch("matrix product", a, b, "* scales by a scalar" if SCALAR in (a.shape, b.shape) else "")
    return Expr("matmul", (a, b), (a.shape[0], b.shape[1]))


def _divided(left: Liftable, right: Liftable) -> Expr:
    a, b = lift(left), lift(right)
    if b.shape != SCALAR:
        raise mismatch(
            "quotient", a, b, "only division by a scalar is defined; inverse(M) is a matrix's inverse"
        )
    return Expr("divide", (a, b), a.shape)


def _raised(left: Liftable, right: Liftable) -> Expr:
    a, b = lift(left), lift(right)
    if a.shape != SCALAR or b.shape != SCALAR:
        hint = "power(x, gamma) is componentwise" if 1 in a.shape else "write M@M, or inverse(M) for M^-1"
        raise mismatch("power", a, b, hint)
    return Expr("power", (a, b), SCALAR)


def _compared(left: Expr, relation: Relation, right: Liftable) -> Comparison:
    other = lift(right)
    if left.shape != other.shape and not any(x.op == "literal" and x.args[0] == 0 for x in (left, other)):
        raise mismatch(f"comparison {relation}", left, other, "shapes are equal, or one side is 0")
    return Comparison(left, relation, other)


__all__ = [
    "SCALAR", "Comparison", "Expr", "Liftable", "Nonconforming", "Record", "Relation", "Shape",
    "component_names", "deferred", "foreign", "joined", "lift", "mismatch", "scalars", "short_text",
    "symbol", "terms", "walk",
]  # fmt: skip
