"""What can be read off an instruction list: where it jumps, what it depends on, what keeps it bounded.

Soundness-critical. Last reviewed 2026-11-24.

Relies on: a composition of continuous functions is continuous, and of locally Lipschitz ones locally
Lipschitz; sign(a) f is continuous where f is and f = 0 wherever a = 0; sums and products of bounded functions
are bounded, as are sign, sine, cosine, tanh, arctan and erf of anything, and 1/a where |a| has a positive
infimum. Every trait is an upper bound: what is not recognised is taken to be the worst.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from hashlib import sha256
from typing import Any

from symctrl.kernel.chain import Domain
from symctrl.kernel.evaluation import Evaluation, Level
from symctrl.kernel.values import Statement

SMOOTH, LIPSCHITZ, CONTINUOUS = 0, 1, 2
NOT_AFFINE = 2
_ALWAYS_BOUNDED = frozenset(
    ("SIN", "COS", "TANH", "ATAN", "ERF", "SIGN", "ATAN2", "LT", "LE", "EQ", "NE", "NOT", "AND", "OR")
)
_ENTIRE = frozenset(("SIN", "COS", "TANH", "ATAN", "EXP", "ERF"))
_OPEN = frozenset(("SQRT", "LOG", "POW", "ASIN", "ACOS"))  # smooth or defined on a part of the line only
_COMPARISONS = frozenset(
    ("LT", "LE", "EQ", "NE", "NOT", "AND", "OR", "FLOOR", "CEIL", "ATAN2", "IF_ELSE_ZERO")
)
NOTHING: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class Traits:
    """Of one value: `key` is the same for equal structures. level: how smooth it is away from its jumps.
    jumps: keys of arguments at whose zeros it jumps. zeros: keys of arguments at whose zeros it vanishes.
    degree: in switches, 2 for more than affine. reads: free symbols. bounded: for certain.
    edges: `kind key` of what it divides by (nonzero), takes roots (nonnegative) and logarithms (positive) of,
    and of the arguments of arcsine and arccosine (unit: at most 1 in absolute value). number: its value, if
    it is a literal.
    """

    key: str
    level: int = SMOOTH
    jumps: frozenset[str] = NOTHING
    zeros: frozenset[str] = NOTHING
    degree: int = 0
    reads: frozenset[str] = NOTHING
    bounded: bool = True
    edges: frozenset[str] = NOTHING
    number: Fraction | None = None


@dataclass
class Reading(Domain[Traits]):
    """known_bounded, known_apart: is the value with this key known to be? is_parameter: is the symbol
    constant?

    of_edge: the arguments of divisions, roots and logarithms that were met, by key.
    """

    known_bounded: Callable[[str], bool]
    known_apart: Callable[[str], bool]
    is_parameter: Callable[[str], bool]
    of_edge: dict[str, Traits] = field(default_factory=dict)

    def free(self, name: str) -> Traits:
        key = _key("INPUT", name)
        bounded = self.is_parameter(name) or self.known_bounded(key)
        return Traits(key, zeros=frozenset((key,)), reads=frozenset((name,)), bounded=bounded)

    def constant(self, value: Fraction) -> Traits:
        return Traits(_key("CONST", str(value)), number=value)

    def add(self, a: Traits, b: Traits) -> Traits:
        return self._made(
            _key("ADD", *sorted((a.key, b.key))),
            [a, b],
            level=max(a.level, b.level),
            jumps=a.jumps | b.jumps,
            zeros=a.zeros & b.zeros,
            degree=max(a.degree, b.degree),
            bounded=a.bounded and b.bounded,
        )

    def mul(self, a: Traits, b: Traits) -> Traits:
        left, right = a.jumps - (b.zeros - b.jumps), b.jumps - (a.zeros - a.jumps)
        filled = left | right != a.jumps | b.jumps
        return self._made(
            _key("MUL", *sorted((a.key, b.key))),
            [a, b],
            level=max(a.level, b.level, CONTINUOUS if filled else SMOOTH),
            jumps=left | right,
            zeros=a.zeros | b.zeros,
            degree=min(a.degree + b.degree, NOT_AFFINE),
            bounded=a.bounded and b.bounded,
        )

    def inv(self, a: Traits) -> Traits:
        if a.number is not None and a.number:
            return self.constant(1 / a.number)
        self.of_edge[a.key] = a
        return self._made(
            _key("INV", a.key),
            [a],
            level=a.level,
            jumps=a.jumps,
            degree=NOT_AFFINE if a.degree else 0,
            bounded=self.is_constant(a) or self.known_apart(a.key),
            edges=frozenset((f"nonzero {a.key}",)),
        )

    def function(self, op: str, args: Sequence[Traits]) -> Traits:
        a = args[0]
        key = _key(op, *(x.key for x in args))
        jumps = frozenset().union(*(x.jumps for x in args))
        level = max(x.level for x in args)
        degree = NOT_AFFINE if any(x.degree for x in args) else 0
        inside = all(x.bounded for x in args)
        if op == "FABS":
            return self._made(key, args, max(level, LIPSCHITZ), jumps, a.zeros | {a.key}, degree, inside)
        if op == "SIGN":
            degree = degree or 1
            return self._made(key, args, level, jumps | {a.key}, NOTHING, degree, True)
        if op in _COMPARISONS:
            return self._made(
                key, args, level, jumps | {key}, NOTHING, NOT_AFFINE, op in _ALWAYS_BOUNDED or inside
            )
        if op in _ENTIRE:
            odd = a.zeros | {a.key} if op in ("SIN", "TANH", "ATAN", "ERF") else NOTHING
            return self._made(key, args, level, jumps, odd, degree, op in _ALWAYS_BOUNDED or inside)
        return self._partial(op, args, key, level, jumps, degree, inside)

    def _partial(
        self,
        op: str,
        args: Sequence[Traits],
        key: str,
        level: int,
        jumps: frozenset[str],
        degree: int,
        inside: bool,
    ) -> Traits:
        """Roots, powers and logarithms: smooth where the argument is positive, which is an edge."""
        a = args[0]
        self.of_edge[a.key] = a
        grows = op == "SQRT" or (op == "POW" and self._is_positive_number(args[1]))
        if op == "POW" and grows and (args[1].number or 0) >= 1:
            level = max(level, LIPSCHITZ)
        elif op != "LOG" and not (self.known_apart(a.key) or self.known_positive(a.key)):
            level = max(level, CONTINUOUS)
        zeros = a.zeros | {a.key} if grows else NOTHING
        bounded = inside and (grows or op in ("ASIN", "ACOS") or self.known_apart(a.key))
        edge = "unit" if op in ("ASIN", "ACOS") else "nonnegative" if grows else "positive"
        return self._made(
            key,
            args,
            level,
            jumps,
            zeros,
            degree,
            bounded or self._all_constant(args),
            frozenset((f"{edge} {a.key}",)),
        )

    def _is_positive_number(self, exponent: Traits) -> bool:
        literal = exponent.number is not None and exponent.number > 0
        return literal or self.known_positive(exponent.key)

    def known_positive(self, key: str) -> bool:
        return self.known_apart(f"positive {key}")

    def _made(
        self,
        key: str,
        args: Sequence[Traits],
        level: int,
        jumps: frozenset[str],
        zeros: frozenset[str] = NOTHING,
        degree: int = 0,
        bounded: bool = False,
        edges: frozenset[str] = NOTHING,
    ) -> Traits:
        reads = frozenset().union(*(a.reads for a in args))
        edges = edges.union(*(a.edges for a in args))
        sure = bounded or self.known_bounded(key) or all(map(self.is_parameter, reads))
        return Traits(key, level, jumps, zeros | {key}, degree, reads, sure, edges)

    def is_constant(self, a: Traits) -> bool:
        return all(map(self.is_parameter, a.reads))

    def _all_constant(self, args: Sequence[Traits]) -> bool:
        return all(self.is_constant(a) for a in args)

    def nonzero(self, a: Traits) -> None:
        """The rate of |a| along a solution is s a' for every s where a = 0, for a' is zero there."""

    def rational(self, a: Traits) -> Fraction | None:
        return a.number


class TraitSums:
    """A sum over neighbours or nodes is as good as its terms; there are finitely many."""

    def __init__(self, domain: Reading) -> None:
        self.domain = domain

    def value(self, walk: Evaluation[Any], key: str, node: str, level: int, law: str | None) -> Level:
        meaning = walk.statement.names[key]
        other = {"i": "j", "j": "i"}.get(node, "j")
        binding = {"i": node or "i", "j": other}
        inner = walk.output(meaning.of, binding, level, law)
        return self._summed(inner, level, f"{meaning.kind} {node}")

    def _summed(self, value: Level, level: int, how: str) -> Level:
        if value is None:
            return None
        if level:
            return tuple(self._summed(part, level - 1, how) for part in value)
        a: Traits = value
        key = _key(how, a.key)
        jumps = frozenset((_key("jump", key),)) if a.jumps else NOTHING  # at places of its own
        return self.domain._made(key, [a], a.level, jumps, NOTHING, a.degree, a.bounded)


def _key(op: str, *parts: str) -> str:
    return sha256("\x1f".join((op, *parts)).encode()).hexdigest()[:32]


def reading(statement: Statement, domain: Reading) -> Evaluation[Traits]:
    """The walk that reads traits of the statement's listings."""
    return Evaluation(statement, domain, domain.free, TraitSums(domain))
