"""The chain rule: every operation on level values, from the basic operations of a domain.

Soundness-critical. Last reviewed 2026-11-24.

Relies on: the derivative of a composition of differentiable functions. Where an operation is not
differentiable everywhere, the rule asks the domain for what it needs: x/y and 1/y, that y != 0 (by `inv`);
sqrt(x), that sqrt(x) != 0; |x|, that x != 0; log and powers, what their base operations need. sign, floor,
comparisons and switches have no derivative here, not even where they are locally constant.

A level value is described in `evaluation`. An operation all of whose arguments have the derivative None is a
constant: its derivative is None, and nothing is asked.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any, Generic, TypeVar

from symctrl.kernel.certificate import Declined, Invalid

Value = TypeVar("Value")
Level = Any
MAX_POWER = 1000


class Domain(ABC, Generic[Value]):
    """What the basic operations mean on the values of one type (level 0)."""

    @abstractmethod
    def constant(self, value: Fraction) -> Value: ...

    @abstractmethod
    def add(self, a: Value, b: Value) -> Value: ...

    @abstractmethod
    def mul(self, a: Value, b: Value) -> Value: ...

    @abstractmethod
    def inv(self, a: Value) -> Value:
        """1/a. Raises Invalid where a may be zero."""

    def function(self, op: str, args: Sequence[Value]) -> Value:
        """An operation that is not a ring operation, by its opcode: SQRT FABS SIGN SIN COS EXP LOG TANH ...,
        and POW with an exponent that is not an integer constant. Raises Declined for one without a rule."""
        raise Declined(f"{op} of {len(args)} arguments has no rule")

    @abstractmethod
    def nonzero(self, a: Value) -> None:
        """Take note that a != 0 is needed. Raises Invalid where it cannot be had."""

    @abstractmethod
    def rational(self, a: Value) -> Fraction | None:
        """The number that `a` is known to be exactly, or None."""

    def neg(self, a: Value) -> Value:
        return self.mul(self.constant(Fraction(-1)), a)

    def sub(self, a: Value, b: Value) -> Value:
        return self.add(a, self.neg(b))

    def square(self, a: Value) -> Value:
        return self.mul(a, a)

    def power(self, a: Value, n: int) -> Value:
        """a to the integer power n >= 1."""
        half = self.square(self.power(a, n // 2)) if n > 1 else a
        return self.mul(half, a) if n > 1 and n % 2 else half


class Chain(Generic[Value]):
    """Operations on level values; `level` says how deep the pairs are nested."""

    def __init__(self, domain: Domain[Value]) -> None:
        self.domain = domain

    def constant(self, level: int, value: Fraction | int) -> Level:
        inner: Level = self.domain.constant(Fraction(value))
        for _ in range(level):
            inner = (inner, None)
        return inner

    def add(self, n: int, a: Level, b: Level) -> Level:
        if a is None or b is None:
            return b if a is None else a
        if n == 0:
            return self.domain.add(a, b)
        return self.add(n - 1, a[0], b[0]), self.add(n - 1, a[1], b[1])

    def neg(self, n: int, a: Level) -> Level:
        if a is None:
            return None
        if n == 0:
            return self.domain.neg(a)
        return self.neg(n - 1, a[0]), self.neg(n - 1, a[1])

    def sub(self, n: int, a: Level, b: Level) -> Level:
        if a is None or b is None:
            return self.neg(n, b) if a is None else a
        if n == 0:
            return self.domain.sub(a, b)
        return self.sub(n - 1, a[0], b[0]), self.sub(n - 1, a[1], b[1])

    def mul(self, n: int, a: Level, b: Level) -> Level:
        if a is None or b is None:
            return None
        if n == 0:
            return self.domain.mul(a, b)
        rate = self.add(n - 1, self.mul(n - 1, a[1], b[0]), self.mul(n - 1, a[0], b[1]))
        return self.mul(n - 1, a[0], b[0]), rate

    def square(self, n: int, a: Level) -> Level:
        if n == 0:
            return self.domain.square(a)
        part = self.mul(n - 1, a[0], a[1])
        return self.square(n - 1, a[0]), self.add(n - 1, part, part)

    def inv(self, n: int, a: Level) -> Level:
        """r = 1/a with the derivative -r^2 a'."""
        if n == 0:
            return self.domain.inv(a)
        r = self.inv(n - 1, a[0])
        if a[1] is None:
            return r, None
        return r, self.neg(n - 1, self.mul(n - 1, self.square(n - 1, r), a[1]))

    def div(self, n: int, a: Level, b: Level) -> Level:
        """With r = 1/b and x = a r: the derivative (a' - x b') r."""
        if n == 0:
            return self.domain.mul(a, self.domain.inv(b))
        r = self.inv(n - 1, b[0])
        x = self.mul(n - 1, a[0], r)
        return x, self.mul(n - 1, self.sub(n - 1, a[1], self.mul(n - 1, x, b[1])), r)

    def power(self, n: int, a: Level, exponent: int) -> Level:
        """a to an integer power; a to the power 0 is 1. A negative one is the power of the inverse."""
        if abs(exponent) > MAX_POWER:
            raise Declined(f"a power with the exponent {exponent} is above the limit {MAX_POWER}")
        if exponent == 0:
            return self.constant(n, 1)
        if exponent < 0:
            return self.power(n, self.inv(n, a), -exponent)
        if n == 0:
            return self.domain.power(a, exponent)
        value = self.power(n - 1, a[0], exponent)
        if a[1] is None:
            return value, None
        below = self.mul(n - 1, self.constant(n - 1, exponent), self.power(n - 1, a[0], exponent - 1))
        return value, self.mul(n - 1, below, a[1])

    def operation(self, op: str, n: int, args: Sequence[Level]) -> Level:
        """The value of an opcode with the given arguments. Raises Declined where it has no rule."""
        ring = _RING.get(op)
        if ring is not None:
            return ring(self, n, *args)
        if op in _COMPOSED:
            return self._composed(n, _COMPOSED[op], dict(zip("ab", args, strict=False)))
        if op in ("POW", "CONSTPOW"):
            exponent = self._constant(n, args[1])
            if exponent is not None and exponent.denominator == 1:
                return self.power(n, args[0], int(exponent))
            op = "POW"
        return self._function(op, n, args)

    def _constant(self, n: int, a: Level) -> Fraction | None:
        """The rational number that a level value is constantly, if it is one."""
        for _ in range(n):
            if a[1] is not None:
                return None
            a = a[0]
        return self.domain.rational(a)

    def _function(self, op: str, n: int, args: Sequence[Level]) -> Level:
        if n == 0:
            return self.domain.function(op, args)
        inner = [a[0] for a in args]
        value = self._function(op, n - 1, inner)
        if all(a[1] is None for a in args):
            return value, None
        if op == "POW":
            return value, self._power_rate(n - 1, inner, [a[1] for a in args], value)
        if op == "FABS":
            slope = self._abs_slope(n - 1, inner[0])
        elif op in _SLOPE:
            slope = self._composed(n - 1, _SLOPE[op], {"a": inner[0], "v": value})
        else:
            raise Invalid(f"{op.lower()} of what is not constant has no derivative")
        return value, self.mul(n - 1, slope, args[0][1])

    def _power_rate(self, n: int, inner: Sequence[Level], rates: Sequence[Level], value: Level) -> Level:
        """p a^(p-1) a' + a^p log(a) p', each part only where a' or p' is not None."""
        base, exponent = inner
        rate = None
        if rates[0] is not None:
            lower = self.operation("POW", n, [base, self.sub(n, exponent, self.constant(n, 1))])
            rate = self.mul(n, self.mul(n, exponent, lower), rates[0])
        if rates[1] is not None:
            grown = self.mul(n, value, self._function("LOG", n, [base]))
            rate = self.add(n, rate, self.mul(n, grown, rates[1]))
        return rate

    def _abs_slope(self, n: int, a: Level) -> Level:
        inner = a
        for _ in range(n):
            inner = inner[0]
        self.domain.nonzero(inner)
        return self._sign(n, a)

    def _sign(self, n: int, a: Level) -> Level:
        """sign(a) where a != 0 has been asked for: locally constant."""
        if n == 0:
            return self.domain.function("SIGN", [a])
        return self._sign(n - 1, a[0]), None

    def _composed(self, n: int, rule: str, given: Mapping[str, Level]) -> Level:
        """The value of a rule in postfix notation over what is given."""
        stack: list[Level] = []
        for word in rule.split():
            if word in given:
                stack.append(given[word])
            elif word[0].isdigit():
                stack.append(self.constant(n, Fraction(word)))
            else:
                count = 2 if word in ("ADD", "SUB", "MUL", "DIV") else 1
                stack[-count:] = [self.operation(word, n, stack[-count:])]
        (value,) = stack
        return value


_RING: dict[str, Callable[..., Level]] = {
    "ADD": Chain.add,
    "SUB": Chain.sub,
    "MUL": Chain.mul,
    "DIV": Chain.div,
    "NEG": Chain.neg,
    "SQ": Chain.square,
    "TWICE": lambda c, n, a: c.add(n, a, a),
    "INV": Chain.inv,
}

# Operations of a and b by simpler ones, in postfix notation.
_COMPOSED = {
    "TAN": "a SIN a COS DIV",
    "EXPM1": "a EXP 1 SUB",
    "LOG1P": "1 a ADD LOG",
    "FMIN": "a b ADD a b SUB FABS SUB 1/2 MUL",
    "FMAX": "a b ADD a b SUB FABS ADD 1/2 MUL",
    "SINH": "a EXP a EXP INV SUB 1/2 MUL",
    "COSH": "a EXP a EXP INV ADD 1/2 MUL",
    "ASINH": "a a SQ 1 ADD SQRT ADD LOG",
    "ACOSH": "a a SQ 1 SUB SQRT ADD LOG",
    "ATANH": "1 a ADD 1 a SUB DIV LOG 1/2 MUL",
    "HYPOT": "a SQ b SQ ADD SQRT",
}

# The derivative of each function of one argument a, where v is its value; that of |a| has a rule of its own.
_SLOPE = {
    "SQRT": "v TWICE INV",
    "SIN": "a COS",
    "COS": "a SIN NEG",
    "EXP": "v",
    "LOG": "a INV",
    "TANH": "1 v SQ SUB",
    "ASIN": "1 a SQ SUB SQRT INV",
    "ACOS": "1 a SQ SUB SQRT INV NEG",
    "ATAN": "1 a SQ ADD INV",
}
