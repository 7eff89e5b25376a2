"""One rule for each operation beyond field arithmetic: is the value that a hint states its value?

Soundness-critical. Last reviewed 2026-11-24.

Relies on: the number v >= 0 with v^2 = a is unique; sign(t p q) = sign(p) sign(q) for t > 0; the addition
theorems of sine, cosine and the exponential function; x^a x^b = x^(a+b) for x > 0, and for x = 0 where all
exponents are positive. A rule raises Invalid where it does not confirm the hint.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import NoReturn

from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.conditions import ODD, SIGNS, Signs
from symctrl.kernel.field import Field, Value
from symctrl.kernel.generators import FUNCTIONS, Generator
from symctrl.kernel.polynomial import Poly, monomial, powers, variables

MAX_MULTIPLE = 64


@dataclass(frozen=True)
class Step:
    """What a rule needs to know: the field, the table and signs, and which operation it is for."""

    field: Field
    table: list[Generator]
    signs: Signs
    op: str
    where: str

    def refuse(self, why: str) -> NoReturn:
        raise Invalid(f"{self.where}: {why}")


def _square_root(step: Step, args: list[Value], value: Value) -> None:
    _require_root(step, args[0], value)


def _absolute(step: Step, args: list[Value], value: Value) -> None:
    _require_root(step, step.field.mul(args[0], args[0]), value)


def _require_root(step: Step, square: Value, value: Value) -> None:
    field = step.field
    if not field.is_zero(field.sub(field.mul(value, value), square)):
        step.refuse("the square of the stated value is another one")
    step.signs.require_value("nonnegative", value, f"{step.where}: a root")


def _sign(step: Step, args: list[Value], value: Value) -> None:
    """value = c * product of sign generators, c = 1 or -1; a = c t * product of their arguments, t > 0."""
    field = step.field
    if field.is_zero(args[0]):
        if value:
            step.refuse("the sign of zero is zero")
        return
    c, generators = _single_term(step, value)
    if c not in (1, -1) or any(e != 1 or step.table[k].kind != "sign" for k, e in generators):
        step.refuse("the stated value is not a product of sign generators")
    product: Poly = {0: 1}
    for k, _ in generators:
        product = field.ring.mul(product, step.table[k].base or {})
    if not product:
        step.refuse("a sign generator has the argument zero")
    carrier = step.signs.carrier(args[0])
    quotients = (field.ring.quotient(p, product) for p in (carrier, field.normal(carrier)))
    if not any(q is not None and step.signs.of(q) == frozenset((c,)) for q in quotients):
        step.refuse("the arguments of the signs do not multiply to the argument up to a positive factor")


def _single_term(step: Step, value: Value) -> tuple[Fraction, list[tuple[int, int]]]:
    """The coefficient and the powers of a value that is one term over factors that are single generators."""
    if len(value) != 1:
        step.refuse("the stated value is not a single term")
    ((key, p),) = value.items()
    if len(p) != 1:
        step.refuse("the stated value is not a single term")
    ((m, c),) = p.items()
    exponents = dict(powers(m))
    for factor, exponent in key:
        below = step.field.factors[factor]
        inverted = powers(max(below))
        if list(below.values()) != [1] or len(inverted) != 1 or inverted[0][1] != 1:
            step.refuse("the stated value is not a single term")
        k = inverted[0][0]
        exponents[k] = exponents.get(k, 0) - exponent
    return Fraction(c), sorted(exponents.items())


def _exponential(step: Step, args: list[Value], value: Value) -> None:
    field = step.field
    c, generators = _single_term(step, value)
    left = args[0]
    for k, exponent in generators:
        if step.table[k].kind != "exp":
            step.refuse("the stated value is not a product of exp generators")
        left = field.sub(left, field.mul(field.constant(exponent), step.table[k].args[0]))
    if c != 1 or not field.is_zero(left):
        step.refuse("the exponents do not add up")


def _trigonometric(step: Step, args: list[Value], value: Value) -> None:
    """The argument is a sum of integer multiples of angles in the table; the value follows from these."""
    field = step.field
    cos, sin = field.constant(1), field.constant(0)
    for k, n in _multiples(step, args[0]):
        c, s = field.generator(k), field.generator(_sine_of(step, k))
        for _ in range(abs(n)):
            turn = s if n > 0 else field.neg(s)
            cos, sin = (
                field.sub(field.mul(cos, c), field.mul(sin, turn)),
                field.add(field.mul(sin, c), field.mul(cos, turn)),
            )
    if not field.is_zero(field.sub(value, cos if step.op == "COS" else sin)):
        step.refuse("the addition theorem gives another value")


def _sine_of(step: Step, k: int) -> int:
    found = [n for n, g in enumerate(step.table) if g.kind == "sin" and g.number == k]
    if not found:
        step.refuse(f"generator {k} is a cosine without its sine")
    return found[0]


def _multiples(step: Step, angle: Value) -> list[tuple[int, int]]:
    """Integers n with angle = sum of n * angle of the cosine generator k, as pairs (k, n)."""
    rows: list[
        tuple[Value, dict[int, Fraction]]
    ] = []  # reduced angles, and how they combine from the table's
    for k, g in enumerate(step.table):
        if g.kind == "cos":
            reduced, combination = _eliminate(step, g.args[0], {k: Fraction(1)}, rows)
            if reduced:
                rows.append((reduced, combination))
    rest, combination = _eliminate(step, angle, {}, rows)
    if not step.field.is_zero(rest):
        step.refuse("the angle is not a sum of multiples of angles in the table")
    if any(n.denominator != 1 or abs(n) > MAX_MULTIPLE for n in combination.values()):
        step.refuse("the angle is not a sum of integer multiples of angles in the table")
    return [(k, -int(n)) for k, n in combination.items() if n]


def _eliminate(
    step: Step, angle: Value, combination: dict[int, Fraction], rows: list[tuple[Value, dict[int, Fraction]]]
) -> tuple[Value, dict[int, Fraction]]:
    """Subtract multiples of the rows so that the leading term of each is gone."""
    for row, of in rows:
        key = max(row)
        lead = max(row[key])
        ratio = Fraction(angle.get(key, {}).get(lead, 0)) / row[key][lead]
        if ratio:
            angle = step.field.sub(angle, step.field.mul(step.field.constant(ratio), row))
            combination = {
                k: combination.get(k, Fraction(0)) - ratio * of.get(k, 0) for k in combination | of
            }
    return angle, combination


def _power(step: Step, args: list[Value], value: Value) -> None:
    """value = a^m * product of powers of a in the table, and the exponents add up."""
    field = step.field
    base, exponent = args
    kind = "nonnegative" if step.signs.of_value(exponent) <= SIGNS["positive"] else "positive"
    step.signs.require_value(kind, base, f"{step.where}: the base of a power")
    numerator, key = field.fraction(value)
    left, rest = exponent, dict(key)
    for k in sorted(variables(numerator).union(*(variables(field.factors[f]) for f in rest))):
        own = _exponent_over(step, step.table[k], base)
        if own is None:
            continue
        for f in [f for f in rest if field.factors[f] == field.generator(k)[()]]:
            left = field.add(left, field.mul(field.constant(rest.pop(f)), own))
        n = min(dict(powers(m)).get(k, 0) for m in numerator)
        numerator = {m - monomial([(k, n)]): c for m, c in numerator.items()}
        left = field.sub(left, field.mul(field.constant(n), own))
    m = _whole(step, left)
    remaining: Value = {tuple(rest.items()): numerator}
    if m < 0:
        same = field.sub(field.mul(remaining, field.power(base, -m)), field.constant(1))
    else:
        same = field.sub(remaining, field.power(base, m))
    if not field.is_zero(same):
        step.refuse("the stated value is not the power")


def _exponent_over(step: Step, g: Generator, base: Value) -> Value | None:
    """The exponent of a generator that is a power of the base, else None."""
    if g.kind not in ("power", "root") or g.base is None:
        return None
    if not step.field.is_zero(step.field.sub(base, {(): g.base} if g.base else {})):
        return None
    return g.args[0] if g.kind == "power" else step.field.constant(Fraction(1, g.number))


def _whole(step: Step, left: Value) -> int:
    numerator, key = step.field.fraction(left)
    p = step.field.normal(numerator)
    number = step.field.rational({key: p} if p else {})
    if number is None or number.denominator != 1:
        step.refuse("the exponents do not add up to a whole number")
    if abs(number) > MAX_MULTIPLE:
        raise Declined(f"{step.where}: the exponent {number} is above the limit {MAX_MULTIPLE}")
    return int(number)


def _opaque(step: Step, args: list[Value], value: Value) -> None:
    """The generator of this function and argument; minus it, of an odd function and minus the argument."""
    field = step.field
    c, generators = _single_term(step, value)
    g = step.table[generators[0][0]] if len(generators) == 1 and generators[0][1] == 1 else None
    if g is None or g.kind != "function" or g.name != step.op.lower():
        step.refuse("the stated value is not the generator of this function")
    if c != 1 and not (c == -1 and g.name in ODD):
        step.refuse("the stated value is a multiple of the generator")
    for given, own in zip(args, g.args, strict=True):
        if not field.is_zero(field.sub(given, own) if c == 1 else field.add(given, own)):
            step.refuse("the generator has another argument")


Rule = Callable[[Step, list[Value], Value], None]
RULES: dict[str, Rule] = {
    **{name.upper(): _opaque for name in FUNCTIONS},
    "SQRT": _square_root,
    "FABS": _absolute,
    "SIGN": _sign,
    "EXP": _exponential,
    "SIN": _trigonometric,
    "COS": _trigonometric,
    "POW": _power,
}


def require_defined(signs: Signs, g: Generator, where: str) -> None:
    """What a generator needs to be a real number: known, or a condition. Raises Invalid if never."""
    if g.kind == "root" and g.base is not None:
        signs.require("nonnegative", g.base, where)
    if g.kind == "power" and g.base is not None:
        growing = signs.of_value(g.args[0]) <= SIGNS["positive"]
        signs.require("nonnegative" if growing else "positive", g.base, where)
    if g.kind == "function":
        field, a = signs.field, g.args[0]
        square = field.mul(a, a)
        one = field.constant(1)
        needs: dict[str, tuple[str, Value]] = {
            "log": ("positive", a),
            "asin": ("nonnegative", field.sub(one, square)),
            "acos": ("nonnegative", field.sub(one, square)),
        }
        if g.name == "atan2":
            needs["atan2"] = ("nonzero", field.add(square, field.mul(g.args[1], g.args[1])))
        if g.name in needs:
            signs.require_value(*needs[g.name], where)
