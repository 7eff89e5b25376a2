"""What a domain is: a small class that says what each operation means.

A domain gives a meaning to the basic operations below; the composite ones have a meaning in terms of them and
are overridden where a domain can do better. An operation without a meaning is refused by name: `Unsupported`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from fractions import Fraction
from typing import Any, Generic, TypeVar

from symctrl.graph import ARITY

Value = TypeVar("Value")


class Unsupported(ValueError):  # noqa: N818
    """The domain gives the operation no meaning."""


class Domain(ABC, Generic[Value]):
    """Base of all domains over values of one type. Methods are named after CasADi's opcodes in lower case."""

    name = "domain"

    def operation(self, op: str) -> Callable[..., Value]:
        """The function that evaluates opcode `op`. Raises Unsupported where there is none."""
        method: Callable[..., Value] | None = getattr(self, op.lower() + "_", None) if op in ARITY else None
        if method is None:
            raise Unsupported(f"the {self.name} domain gives no meaning to {op.lower()}")
        return method

    @abstractmethod
    def constant(self, value: Fraction) -> Value:
        """The value of an exact rational literal."""

    @abstractmethod
    def add_(self, a: Value, b: Value) -> Value: ...

    @abstractmethod
    def mul_(self, a: Value, b: Value) -> Value: ...

    @abstractmethod
    def inv_(self, a: Value) -> Value: ...

    def neg_(self, a: Value) -> Value:
        return self.mul_(self.constant(Fraction(-1)), a)

    def sub_(self, a: Value, b: Value) -> Value:
        return self.add_(a, self.neg_(b))

    def div_(self, a: Value, b: Value) -> Value:
        return self.mul_(a, self.inv_(b))

    def sq_(self, a: Value) -> Value:
        return self.mul_(a, a)

    def twice_(self, a: Value) -> Value:
        return self.add_(a, a)

    def tan_(self, a: Value) -> Value:
        return self.div_(self.operation("SIN")(a), self.operation("COS")(a))

    def expm1_(self, a: Value) -> Value:
        return self.sub_(self.operation("EXP")(a), self.constant(Fraction(1)))

    def log1p_(self, a: Value) -> Value:
        return self.operation("LOG")(self.add_(self.constant(Fraction(1)), a))

    def hypot_(self, a: Value, b: Value) -> Value:
        return self.operation("SQRT")(self.add_(self.sq_(a), self.sq_(b)))

    def constpow_(self, a: Value, b: Value) -> Value:
        return self.operation("POW")(a, b)


class Operators(Domain[Value]):
    """Base of the domains whose values know Python's operators."""

    def add_(self, a: Any, b: Any) -> Any:
        return a + b

    def sub_(self, a: Any, b: Any) -> Any:
        return a - b

    def mul_(self, a: Any, b: Any) -> Any:
        return a * b

    def neg_(self, a: Any) -> Any:
        return -a

    def inv_(self, a: Any) -> Any:
        return 1 / a
