"""Expressions in the exact domain, and the numbers that its values stand for, by mpmath."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

import casadi as ca
import mpmath

from symctrl.domains.domain import Domain, Operators
from symctrl.domains.exact import ExactDomain
from symctrl.domains.field import Field, OutOfGenerators
from symctrl.domains.opaque import Knowledge, Refine
from symctrl.expr import Expr
from symctrl.graph import Tape, interpret, read
from symctrl.literals import is_constant_name
from tests.domains.oracle import MEANING

MAX_RESTARTS = 12
BELOW_ZERO = frozenset(("SQRT", "LOG"))


class Undefined(ValueError):  # noqa: N818
    """No real value at this point."""


def tape(*exprs: Expr) -> Tape:
    """The instruction list of expressions over their own symbols, as written."""
    outputs = [expr.sx for expr in exprs]
    symbols = ca.symvar(ca.vertcat(*[ca.vec(sx) for sx in outputs]))
    function = ca.Function("f", [ca.vertcat(ca.SX(0, 1), *symbols)], outputs)
    return read(function, [s.name() for s in symbols])


def values(listing: Tape, domain: Domain[Any], symbols: Callable[[str], Any]) -> list[Any]:
    """All outputs in a domain. symbols: the value of each; a named constant is its number."""
    inputs = {
        name: domain.constant(Fraction(name)) if is_constant_name(name) else symbols(name)
        for name in listing.inputs
    }
    return interpret(listing, domain, inputs)


def exactly(
    work: Callable[[ExactDomain, list[Any]], Any],
    *exprs: Expr,
    signs: Mapping[str, str] | None = None,
    zero: Sequence[Expr] = (),
) -> Any:
    """`work` on the domain and the exact values of all entries of the expressions.

    signs: by symbol, "positive", "nonnegative" or "nonzero". zero: relations.
    """
    claim, given = tape(*exprs), tape(*zero) if zero else None
    inputs = dict.fromkeys((*claim.inputs, *(given.inputs if given else ())))
    names = [name for name in inputs if not is_constant_name(name)]
    knowledge, spare = Knowledge(), 16
    for _ in range(MAX_RESTARTS):
        domain = ExactDomain(Field(names, spare), knowledge)
        for name, kind in (signs or {}).items():
            domain.signs.learn(domain.field.variable(domain.field.index[name]), kind)
        try:
            for relation in values(given, domain, domain.free) if given else ():
                domain.field.add_relation(domain.together(relation)[0])
            return work(domain, values(claim, domain, domain.free))
        except Refine:
            continue
        except OutOfGenerators:
            spare *= 2
    raise AssertionError(f"more than {MAX_RESTARTS} restarts")


def is_zero(expr: Expr, **more: Any) -> bool:
    return bool(exactly(lambda domain, found: domain.is_zero(found[0]), expr, **more))


class Numbers(Operators[Any]):
    """Real numbers in mpmath's working precision. Raises Undefined."""

    name = "mpmath"

    def constant(self, value: Fraction) -> Any:
        return mpmath.mpf(value.numerator) / value.denominator

    def inv_(self, a: Any) -> Any:
        return self.operation("INV")(a)

    def operation(self, op: str) -> Callable[..., Any]:
        def evaluate(*args: Any) -> Any:
            if op in BELOW_ZERO and args[0] < 0:
                raise Undefined
            if op in ("POW", "CONSTPOW"):
                return real_power(*args)
            try:
                value = MEANING[op].value(*args)
            except (ZeroDivisionError, ValueError):
                raise Undefined from None
            if isinstance(value, mpmath.mpc) or not mpmath.isfinite(value):
                raise Undefined
            return value

        return evaluate


def real_power(base: Any, exponent: Any) -> Any:
    if exponent == int(exponent) and (base or exponent >= 0):
        return base ** int(exponent)
    if base < 0 or (base == 0 and exponent < 0):
        raise Undefined
    return base**exponent


def opaque_power(base: Any, exponent: Any) -> Any:
    """A power as a certificate defines it: of what is positive, or of zero with a positive exponent."""
    if base < 0 or (base == 0 and exponent <= 0):
        raise Undefined
    return base**exponent


class Meant:
    """The numbers that generators and values of a field stand for at a point.

    Raises Undefined where a generator has none, or where a factor that something was divided by is zero.
    """

    def __init__(self, field: Field, point: Mapping[str, Any]) -> None:
        self.field = field
        self.known: list[Any] = []
        for g in field.generators:
            self.known.append(point[g.name] if g.kind == "free" else self._opaque(g))

    def value(self, value: Mapping[Any, Any]) -> Any:
        total = mpmath.mpf(0)
        for key, p in value.items():
            below = mpmath.mpf(1)
            for k, e in key:
                below *= self.polynomial(self.field.factors[k]) ** e
            if abs(below) < mpmath.mpf(10) ** (10 - mpmath.mp.dps):
                raise Undefined
            total += self.polynomial(p) / below
        return total

    def polynomial(self, p: Any) -> Any:
        total = mpmath.mpf(0)
        for exponents, c in p.terms():
            term = mpmath.mpf(int(c.p)) / int(c.q)
            for v, e in enumerate(exponents):
                if e:
                    term *= self.known[self.field.size - 1 - v] ** int(e)
            total += term
        return total

    def _opaque(self, g: Any) -> Any:
        match g.kind:
            case "root":
                return opaque_power(self.polynomial(g.argument), mpmath.mpf(1) / g.degree)
            case "abs":
                return abs(self.polynomial(g.argument))
            case "sign":
                return mpmath.sign(self.polynomial(g.argument))
            case "power":
                return opaque_power(self.polynomial(g.argument), self.value(g.exponent))
            case "cos" | "sin" | "exp":
                return MEANING[g.kind.upper()].value(self.value(g.argument))
            case _:
                return Numbers().operation(g.name.upper())(*[self.value(a) for a in g.argument])
