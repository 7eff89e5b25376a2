"""The table of generators: free symbols and numbers that are defined over earlier ones.

Soundness-critical. Last reviewed 2026-11-24.

Relies on: each opaque generator is a real number by definition wherever its need holds, and its relations
are theorems about that number (g^n = p and g >= 0 for a root; |p|^2 = p^2; sign(p) p = |p| and sign(p) |p|
= p, also where p = 0; sin^2 + cos^2 = 1; sign(p)^2 = 1 where p != 0, so that sign(p)^2 r = r for a number r
that is zero where p is, as a root or a power with a positive exponent of |p|). A definition reads only
earlier generators, so the table is a chain of definitions.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from symctrl.kernel.certificate import Declined, Invalid, fields, natural, split_name, typed
from symctrl.kernel.field import Field, Value, read_poly, read_powers
from symctrl.kernel.polynomial import Poly, Relation, monomial, powers, relation, variables

MAX_ROOT = 1000
_OTHER = {"i": "j", "j": "i"}
MAX_TEXT = 20_000
# The functions that have no relation, with their numbers of arguments.
FUNCTIONS = {**dict.fromkeys(("tanh", "atan", "log", "asin", "acos", "erf", "floor", "ceil"), 1), "atan2": 2}


@dataclass(frozen=True)
class Generator:
    """`kind` is the key that tells the definition; `name` is that of a free symbol or of a function.

    `base` is the POLY and `args` the VALUEs; `number` is the degree of a root, or the generator that a sign
    or a sine goes with. A sum over the neighbours of the node `name` is of the monomial `powers`.
    """

    kind: str
    name: str = ""
    base: Poly | None = None
    args: tuple[Value, ...] = ()
    number: int = 0
    powers: tuple[tuple[int, int], ...] = ()


def read_generators(value: Any, field: Field) -> list[Generator]:
    """The table. Raises Invalid where a definition is malformed or reads what is not earlier."""
    table: list[Generator] = []
    for k, entry in enumerate(typed(value, list, "generators")):
        where = f"generator {k}"
        new = _read(typed(entry, dict, where), field, table, where)
        if new in table:
            raise Invalid(f"{where} is there twice")
        if any(v >= k for v in read_by(new, field)):
            raise Invalid(f"{where} is defined by one that is not earlier")
        table.append(new)
        if any(letters(table, v, field) != {_OTHER[new.name]} for v, _ in new.powers):
            raise Invalid(f"{where}: a sum over neighbours is of what belongs to the neighbour alone")
    return table


def letters(table: list[Generator], k: int, field: Field) -> set[str]:
    """The generic nodes that generator k belongs to: i, j, both or none."""
    g = table[k]
    if g.kind == "sum":
        return {g.name}
    if g.kind == "free":
        node = split_name(g.name.rstrip("'"))[1]
        return {node} if node else set()
    return set().union(*(letters(table, v, field) for v in read_by(g, field)))


def read_by(g: Generator, field: Field) -> set[int]:
    """The generators that a definition mentions, also in the factors it divides by."""
    found = variables(g.base or {})
    for value in g.args:
        for key, p in value.items():
            found |= variables(p).union(*(variables(field.factors[f]) for f, _ in key))
    return found | ({g.number} if g.kind in ("sign", "sin") else set()) | {k for k, _ in g.powers}


def _read(entry: dict[str, Any], field: Field, table: list[Generator], where: str) -> Generator:
    def poly(key: str) -> Poly:
        return read_poly(entry[key], field.variables, where)

    if "free" in entry:
        return Generator("free", name=typed(fields(entry, ("free",), where)["free"], str, where))
    if "sum" in entry:
        node = typed(fields(entry, ("sum", "node"), where)["node"], str, where)
        if node not in _OTHER:
            raise Invalid(f"{where}: a sum is over the neighbours of node i or j, not {node[:40]!r}")
        return Generator("sum", name=node, powers=read_powers(entry["sum"], field.variables, where))
    if "root" in entry:
        degree = natural(fields(entry, ("root", "of"), where)["root"], MAX_ROOT, where)
        if degree < 2:
            raise Invalid(f"{where}: a root has a degree of at least 2")
        return Generator("root", base=poly("of"), number=degree)
    if "sign" in entry:
        k = natural(fields(entry, ("sign", "abs"), where)["abs"], len(table), where)
        base = poly("sign")
        if table[k].kind != "abs" or table[k].base != base:
            raise Invalid(f"{where}: generator {k} is not the absolute value of the same polynomial")
        return Generator("sign", base=base, number=k)
    if "abs" in entry:
        fields(entry, ("abs",), where)
        return Generator("abs", base=poly("abs"))
    if "sin" in entry:
        k = natural(fields(entry, ("sin", "cos"), where)["cos"], len(table), where)
        angle = field.read(entry["sin"], where)
        if table[k].kind != "cos" or table[k].args != (angle,):
            raise Invalid(f"{where}: generator {k} is not the cosine of the same angle")
        return Generator("sin", args=(angle,), number=k)
    for kind in ("cos", "exp"):
        if kind in entry:
            return Generator(kind, args=(field.read(fields(entry, (kind,), where)[kind], where),))
    if "power" in entry:
        fields(entry, ("power", "exponent"), where)
        return Generator("power", base=poly("power"), args=(field.read(entry["exponent"], where),))
    return _read_function(entry, field, where)


def _read_function(entry: dict[str, Any], field: Field, where: str) -> Generator:
    name = typed(fields(entry, ("function", "of"), where)["function"], str, where)
    args = tuple(field.read(arg, where) for arg in typed(entry["of"], list, where))
    if name not in FUNCTIONS:
        raise Declined(f"{where}: {name[:40]!r} has no rule in the kernel")
    if len(args) != FUNCTIONS[name]:
        raise Invalid(f"{where}: {name} of {len(args)} arguments")
    return Generator("function", name=name, args=args)


def relations_of(k: int, g: Generator, field: Field, nonzero: Callable[[Poly], bool]) -> list[Relation]:
    """The relations of generator k, each led by a monomial with k in it.

    nonzero: is a polynomial known to vanish nowhere?
    """
    ring = field.ring
    if g.kind == "root" and g.base is not None:
        return [(monomial([(k, g.number)]), g.base)]
    if g.kind == "abs" and g.base is not None:
        return [(monomial([(k, 2)]), ring.mul(g.base, g.base))]
    if g.kind == "sin":
        return [(monomial([(k, 2)]), {0: 1, monomial([(g.number, 2)]): -1})]
    if g.kind == "sign" and g.base is not None:
        own: Poly = {monomial([(k, 1)]): 1}
        size: Poly = {monomial([(g.number, 1)]): 1}
        minus = ring.scale(g.base, -1)
        found = [relation(ring.add(ring.mul(own, size), minus))]
        if g.base:
            found.append(relation(ring.add(ring.mul(own, g.base), ring.scale(size, -1))))
        if nonzero(g.base):
            found.append((monomial([(k, 2)]), {0: 1}))
        return found
    return []


def relations_of_switches(table: list[Generator], positive: Callable[[Value], bool]) -> list[Relation]:
    """s^2 r = r for each switch s = sign(p), and r a root of |p| or |p|^e with an e that is positive: both
    sides are zero where p is, whatever the value of the switch there, and elsewhere s^2 = 1.
    """
    found = []
    for r, g in enumerate(table):
        vanishing = g.kind == "root" or (g.kind == "power" and positive(g.args[0]))
        for s, h in enumerate(table):
            if vanishing and h.kind == "sign" and g.base == {monomial([(h.number, 1)]): 1}:
                own: Poly = {monomial([(r, 1)]): -1}
                found.append(relation({**own, monomial(sorted([(r, 1), (s, 2)])): 1}))
    return found


class Printer:
    """Plain text of polynomials and values; the same certificate gives the same text."""

    def __init__(self, table: list[Generator], field: Field) -> None:
        self.table = table
        self.field = field

    def poly(self, p: Poly) -> str:
        """Terms by falling monomials, like `q0^2 - 2*K*q[1]`. Raises Declined where it gets too long."""
        text = ""
        for m in sorted(p, reverse=True):
            size = abs(Fraction(p[m]))
            factors = [self.generator(k) + (f"^{e}" if e > 1 else "") for k, e in powers(m)]
            term = "*".join(([str(size)] if size != 1 or not factors else []) + factors)
            sign = ("-", " - ") if p[m] < 0 else ("", " + ")
            text = _short(text + sign[bool(text)] + term)
        return text or "0"

    def value(self, value: Value) -> str:
        parts = []
        for key in sorted(value):
            text = self.poly(value[key])
            for factor, exponent in key:
                power = f"^{exponent}" if exponent > 1 else ""
                text = f"({text})/({self.poly(self.field.factors[factor])}){power}"
            parts.append(text)
        return _short(" + ".join(parts) or "0")

    def generator(self, k: int) -> str:
        g = self.table[k]
        of = "" if g.base is None else self.poly(g.base)
        args = ", ".join(self.value(arg) for arg in g.args)
        if g.kind == "free":
            return g.name
        if g.kind == "sum":
            of = self.poly({monomial(g.powers): 1}) if g.powers else f"1 at {g.name}"
            return f"sum({of})"
        if g.kind == "root":
            return f"sqrt({of})" if g.number == 2 else f"root({g.number}, {of})"
        if g.kind == "power":
            return f"pow({of}, {args})"
        return f"{g.kind}({of})" if g.kind in ("abs", "sign") else f"{g.name or g.kind}({args})"


def _short(text: str) -> str:
    if len(text) > MAX_TEXT:
        raise Declined(f"a condition is longer than {MAX_TEXT} characters")
    return text
