"""Values together with their derivative along a direction, over any other domain (forward mode).

The chain rule of each operation is written with the operations of the base domain, so that derivatives are as
exact as the base, and `Tangent(Tangent(base))` gives second derivatives. CasADi's derivatives at a kink hold
almost everywhere only; here an operation without a derivative is refused: NotDifferentiable.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Generic, TypeVar

from symctrl.domains.domain import Domain

Value = TypeVar("Value")


class NotDifferentiable(ValueError):  # noqa: N818
    """The operation has no derivative, and its argument moves."""


@dataclass(frozen=True, slots=True)
class Pair(Generic[Value]):
    """A value and its derivative; None is the derivative that is exactly zero."""

    value: Value
    derivative: Value | None = None
    literal: Fraction | None = None  # of a constant: an exponent is looked at


class Tangent(Domain[Pair[Value]]):
    """Forward-mode derivatives over the domain `base`.

    Where a rule divides (roots, logarithms, quotients), the base meets the inverse and reports its condition:
    the derivative of sqrt(a) needs a > 0, and that of |a|, sign(a)*a', is the derivative only where a != 0.
    """

    def __init__(self, base: Domain[Value]) -> None:
        self.base = base
        self.name = f"tangent of the {base.name}"

    def constant(self, value: Fraction) -> Pair[Value]:
        return Pair(self.base.constant(value), None, value)

    # Derivative parts: None stands for zero and costs nothing.

    def _plus(self, a: Value | None, b: Value | None) -> Value | None:
        if a is None or b is None:
            return b if a is None else a
        return self.base.add_(a, b)

    def _minus(self, a: Value | None, b: Value | None) -> Value | None:
        if b is None:
            return a
        return self.base.neg_(b) if a is None else self.base.sub_(a, b)

    def _times(self, factor: Value, a: Value | None) -> Value | None:
        return None if a is None else self.base.mul_(factor, a)

    def _chain(self, value: Value, slope: Callable[[], Value], a: Pair[Value]) -> Pair[Value]:
        """(value, slope * a'), where the slope is formed only if a moves."""
        return Pair(value, None if a.derivative is None else self.base.mul_(slope(), a.derivative))

    def _of(self, op: str, *args: Value) -> Value:
        return self.base.operation(op)(*args)

    def _one(self) -> Value:
        return self.base.constant(Fraction(1))

    # Arithmetic.

    def add_(self, a: Pair[Value], b: Pair[Value]) -> Pair[Value]:
        return Pair(self.base.add_(a.value, b.value), self._plus(a.derivative, b.derivative))

    def sub_(self, a: Pair[Value], b: Pair[Value]) -> Pair[Value]:
        return Pair(self.base.sub_(a.value, b.value), self._minus(a.derivative, b.derivative))

    def neg_(self, a: Pair[Value]) -> Pair[Value]:
        return Pair(self.base.neg_(a.value), self._minus(None, a.derivative))

    def twice_(self, a: Pair[Value]) -> Pair[Value]:
        moved = a.derivative
        return Pair(self.base.twice_(a.value), None if moved is None else self.base.twice_(moved))

    def mul_(self, a: Pair[Value], b: Pair[Value]) -> Pair[Value]:
        change = self._plus(self._times(b.value, a.derivative), self._times(a.value, b.derivative))
        return Pair(self.base.mul_(a.value, b.value), change)

    def sq_(self, a: Pair[Value]) -> Pair[Value]:
        return self._chain(self.base.sq_(a.value), lambda: self.base.twice_(a.value), a)

    def inv_(self, a: Pair[Value]) -> Pair[Value]:
        r = self.base.inv_(a.value)
        return self._chain(r, lambda: self.base.neg_(self.base.sq_(r)), a)

    def div_(self, a: Pair[Value], b: Pair[Value]) -> Pair[Value]:
        """With r = 1/b and q = a r: (a/b)' = (a' - q b') r. The base inverts once."""
        r = self.base.inv_(b.value)
        q = self.base.mul_(a.value, r)
        return Pair(q, self._times(r, self._minus(a.derivative, self._times(q, b.derivative))))

    # Roots and powers.

    def sqrt_(self, a: Pair[Value]) -> Pair[Value]:
        root = self._of("SQRT", a.value)
        return self._chain(root, lambda: self.base.inv_(self.base.twice_(root)), a)

    def hypot_(self, a: Pair[Value], b: Pair[Value]) -> Pair[Value]:
        h = self.base.hypot_(a.value, b.value)
        change = self._plus(self._times(a.value, a.derivative), self._times(b.value, b.derivative))
        return Pair(h, None if change is None else self.base.mul_(change, self.base.inv_(h)))

    def pow_(self, a: Pair[Value], b: Pair[Value]) -> Pair[Value]:
        """a**b: b a**(b-1) a' for an exponent that does not move, else a**b (b' log a + b a'/a)."""
        if b.literal == 0:
            return self.constant(Fraction(1))
        if b.literal == 1:
            return a
        power = self.base.operation("POW")
        value = power(a.value, b.value)
        if b.derivative is None:
            return self._chain(value, lambda: self.base.mul_(b.value, power(a.value, self._lowered(b))), a)
        change = self.base.mul_(self._of("LOG", a.value), b.derivative)
        if a.derivative is not None:
            ratio = self.base.mul_(a.derivative, self.base.inv_(a.value))
            change = self.base.add_(change, self.base.mul_(b.value, ratio))
        return Pair(value, self.base.mul_(value, change))

    def _lowered(self, exponent: Pair[Value]) -> Value:
        """The exponent less one; a literal stays a literal, which the base can look at."""
        if exponent.literal is not None:
            return self.base.constant(exponent.literal - 1)
        return self.base.sub_(exponent.value, self._one())

    # Exponentials and logarithms.

    def exp_(self, a: Pair[Value]) -> Pair[Value]:
        e = self._of("EXP", a.value)
        return self._chain(e, lambda: e, a)

    def expm1_(self, a: Pair[Value]) -> Pair[Value]:
        e = self.base.expm1_(a.value)
        return self._chain(e, lambda: self.base.add_(e, self._one()), a)

    def log_(self, a: Pair[Value]) -> Pair[Value]:
        return self._chain(self._of("LOG", a.value), lambda: self.base.inv_(a.value), a)

    def log1p_(self, a: Pair[Value]) -> Pair[Value]:
        return self._chain(
            self.base.log1p_(a.value), lambda: self.base.inv_(self.base.add_(self._one(), a.value)), a
        )

    # Trigonometric and hyperbolic functions, and their inverses.

    def sin_(self, a: Pair[Value]) -> Pair[Value]:
        return self._chain(self._of("SIN", a.value), lambda: self._of("COS", a.value), a)

    def cos_(self, a: Pair[Value]) -> Pair[Value]:
        return self._chain(self._of("COS", a.value), lambda: self.base.neg_(self._of("SIN", a.value)), a)

    def tan_(self, a: Pair[Value]) -> Pair[Value]:
        t = self.base.tan_(a.value)
        return self._chain(t, lambda: self.base.add_(self._one(), self.base.sq_(t)), a)

    def sinh_(self, a: Pair[Value]) -> Pair[Value]:
        return self._chain(self._of("SINH", a.value), lambda: self._of("COSH", a.value), a)

    def cosh_(self, a: Pair[Value]) -> Pair[Value]:
        return self._chain(self._of("COSH", a.value), lambda: self._of("SINH", a.value), a)

    def tanh_(self, a: Pair[Value]) -> Pair[Value]:
        t = self._of("TANH", a.value)
        return self._chain(t, lambda: self.base.sub_(self._one(), self.base.sq_(t)), a)

    def asin_(self, a: Pair[Value]) -> Pair[Value]:
        return self._chain(self._of("ASIN", a.value), lambda: self._inverse_cosine(a.value), a)

    def acos_(self, a: Pair[Value]) -> Pair[Value]:
        value = self._of("ACOS", a.value)
        return self._chain(value, lambda: self.base.neg_(self._inverse_cosine(a.value)), a)

    def _inverse_cosine(self, sine: Value) -> Value:
        return self._inverse_root(self.base.sub_(self._one(), self.base.sq_(sine)))

    def _inverse_root(self, a: Value) -> Value:
        return self.base.inv_(self._of("SQRT", a))

    def atan_(self, a: Pair[Value]) -> Pair[Value]:
        value = self._of("ATAN", a.value)
        return self._chain(
            value, lambda: self.base.inv_(self.base.add_(self._one(), self.base.sq_(a.value))), a
        )

    def atan2_(self, a: Pair[Value], b: Pair[Value]) -> Pair[Value]:
        """(a' b - a b')/(a^2 + b^2), away from the origin (and from the cut, where the angle jumps)."""
        angle = self._of("ATAN2", a.value, b.value)
        change = self._minus(self._times(b.value, a.derivative), self._times(a.value, b.derivative))
        if change is None:
            return Pair(angle)
        square = self.base.add_(self.base.sq_(a.value), self.base.sq_(b.value))
        return Pair(angle, self.base.mul_(change, self.base.inv_(square)))

    def asinh_(self, a: Pair[Value]) -> Pair[Value]:
        value = self._of("ASINH", a.value)
        return self._chain(
            value, lambda: self._inverse_root(self.base.add_(self.base.sq_(a.value), self._one())), a
        )

    def acosh_(self, a: Pair[Value]) -> Pair[Value]:
        value = self._of("ACOSH", a.value)
        return self._chain(
            value, lambda: self._inverse_root(self.base.sub_(self.base.sq_(a.value), self._one())), a
        )

    def atanh_(self, a: Pair[Value]) -> Pair[Value]:
        value = self._of("ATANH", a.value)
        return self._chain(
            value, lambda: self.base.inv_(self.base.sub_(self._one(), self.base.sq_(a.value))), a
        )

    def erf_(self, a: Pair[Value]) -> Pair[Value]:
        """The slope is 2/sqrt(pi) exp(-a^2), and sqrt(pi)/2 = sqrt(atan(1))."""
        value = self._of("ERF", a.value)
        return self._chain(value, lambda: self.base.inv_(self._gaussian_inverse(a.value)), a)

    def erfinv_(self, a: Pair[Value]) -> Pair[Value]:
        value = self._of("ERFINV", a.value)
        return self._chain(value, lambda: self._gaussian_inverse(value), a)

    def _gaussian_inverse(self, x: Value) -> Value:
        """sqrt(pi)/2 exp(x^2)."""
        half_root_pi = self._of("SQRT", self._of("ATAN", self._one()))
        return self.base.mul_(half_root_pi, self._of("EXP", self.base.sq_(x)))

    # Operations with a kink: the derivative away from it.

    def fabs_(self, a: Pair[Value]) -> Pair[Value]:
        return self._chain(self._of("FABS", a.value), lambda: _local_sign(self.base, a.value), a)

    def fmin_(self, a: Pair[Value], b: Pair[Value]) -> Pair[Value]:
        """From min(a, b) = (a + b - |a - b|)/2; the derivative holds where a != b."""
        return Pair(self._of("FMIN", a.value, b.value), self._extreme(a, b, self._minus))

    def fmax_(self, a: Pair[Value], b: Pair[Value]) -> Pair[Value]:
        """From max(a, b) = (a + b + |a - b|)/2; the derivative holds where a != b."""
        return Pair(self._of("FMAX", a.value, b.value), self._extreme(a, b, self._plus))

    def _extreme(
        self, a: Pair[Value], b: Pair[Value], join: Callable[[Value | None, Value | None], Value | None]
    ) -> Value | None:
        if a.derivative is None and b.derivative is None:
            return None
        sign = _local_sign(self.base, self.base.sub_(a.value, b.value))
        apart = self._times(sign, self._minus(a.derivative, b.derivative))
        total = join(self._plus(a.derivative, b.derivative), apart)
        return self._times(self.base.constant(Fraction(1, 2)), total)

    def copysign_(self, a: Pair[Value], b: Pair[Value]) -> Pair[Value]:
        self._still("copysign", b)
        value, turn = self._of("COPYSIGN", a.value, b.value), self._of("COPYSIGN", self._one(), b.value)
        return self._chain(value, lambda: self.base.mul_(_local_sign(self.base, a.value), turn), a)

    def if_else_zero_(self, a: Pair[Value], b: Pair[Value]) -> Pair[Value]:
        self._still("if_else_zero", a)
        choose = self.base.operation("IF_ELSE_ZERO")
        moved = b.derivative
        return Pair(choose(a.value, b.value), None if moved is None else choose(a.value, moved))

    # Operations without a derivative: their arguments must not move.

    def _still(self, op: str, *args: Pair[Value]) -> None:
        if any(a.derivative is not None for a in args):
            raise NotDifferentiable(f"{op} has no derivative, and its argument is not constant here")

    def operation(self, op: str) -> Callable[..., Pair[Value]]:
        if op not in _JUMPS:
            return super().operation(op)
        base = self.base.operation(op)

        def evaluate(*args: Pair[Value]) -> Pair[Value]:
            self._still(op.lower(), *args)
            return Pair(base(*(a.value for a in args)))

        return evaluate


def _local_sign(base: Domain[Any], a: Any) -> Any:
    """sign(a) next to a point with a != 0, which the derivative of |a| needs anyway: there it is constant."""
    if isinstance(base, Tangent):
        return Pair(_local_sign(base.base, a.value))
    return base.operation("SIGN")(a)


_JUMPS = frozenset(("SIGN", "FLOOR", "CEIL", "FMOD", "REMAINDER", "LT", "LE", "EQ", "NE", "AND", "OR", "NOT"))
