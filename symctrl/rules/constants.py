"""Constants to try where the author gives none: factors of squares, assumed bounds, rates of decay."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from symctrl.expr import lift
from symctrl.graph import Instruction, Tape
from symctrl.kernel.argument import single
from symctrl.rules.algebra import Algebra, algebra, symbol_of
from symctrl.rules.chain import Chain
from symctrl.rules.loop import tape_of
from symctrl.rules.quantities import claimed, formula

MAX_BOUNDS = 12  # assumed bounds that speak of a quantity, whose products in pairs are tried


def carried_with(chain: Chain, table: Mapping[str, Any], least: Sequence[str]) -> bool:
    """Does a line of the rule `carries` hold, without a factor or with the first of these that serves?"""
    tables = [dict(table), *(dict(table) | {"least": a} for a in least)]
    return any(chain.attempt("carries", one) for one in tables)


def squares_in(chain: Chain, V: str, name: str, power: str = "e e *") -> list[str]:
    """Constants a for which a e^2, or another power, may be below V.

    The coefficient of e^2 in V, the quotient of V by the power, a half, the gains.
    """
    below = chain.q(formula(chain, power, e=name))
    tapes = [algebra(chain, [V, name], _square_coefficient), algebra(chain, [V, below], constant_quotient)]
    own = [chain.q(tape) for tape in tapes if tape is not None]
    halves = [chain.q(formula(chain, "a 2 /", a=a)) for a in own]
    return list(dict.fromkeys([*own, *halves] if own else [chain.q("1/2"), *factors(chain)]))


def _square_coefficient(found: Algebra) -> Tape | None:
    """The coefficient of the square of the second value, a symbol, in the first, if it is constant."""
    V, e = found.values
    at = symbol_of(found, e)
    if at is None:
        return None
    coefficient = found.coefficient(V, {at: 2})
    return found.tape(coefficient) if coefficient and found.is_constant(coefficient) else None


def constant_quotient(found: Algebra) -> Tape | None:
    """The first value over the second, if it is constant and neither is zero."""
    V, e = found.values
    domain = found.session.domain
    if not e or not V:
        return None
    quotient = domain.simplified(domain.mul_(V, domain.inv_(e)))
    return found.tape(quotient) if found.is_constant(quotient) else None


def factors(chain: Chain) -> list[str]:
    """The parameters that are assumed positive."""
    found = []
    for assumption in chain.at.available:
        name, k = assumption.of[0]
        listing = chain.at.statement.listings[name]
        step = listing.code[listing.outputs[k]]
        is_parameter = step.op == "INPUT" and chain.at.statement.scalars.get(step.name) == "parameter"
        if assumption.kind == "positive" and is_parameter:
            found.append(chain.q(Tape((Instruction("INPUT", name=step.name),), (0,))))
    return found


def products(chain: Chain) -> list[str]:
    """The positive parameters and their products in pairs."""
    own = factors(chain)
    tapes = [formula(chain, "a b *", a=a, b=b) for k, a in enumerate(own) for b in own[k:]]
    return [*own, *(chain.q(tape) for tape in tapes)]


def offsets(chain: Chain, name: str) -> Iterator[str]:
    """Constants that may bound the square: 1, and products of the two bounds of a symbol that are assumed."""
    yield chain.q("1")
    bounds = [a for a in chain.at.available if a.kind in ("nonnegative", "positive") and len(a.of) == 1]
    tapes = [tape_of(single(chain.at.statement.listings[a.of[0][0]], a.of[0][1])) for a in bounds]
    reads = chain.at.traits(name).reads
    tapes = [tape for tape in tapes if reads & set(tape.inputs)]
    if 0 < len(tapes) <= MAX_BOUNDS:
        quantities = [chain.q(tape) for tape in tapes]
        for tape in algebra(chain, [name, *quantities], _squared_bounds) or []:
            yield chain.q(tape)


def _squared_bounds(found: Algebra) -> list[Tape]:
    """p^2, where it is constant, as (p - e)(p + e) + e^2 for pairs of bounds."""
    domain = found.session.domain
    e, *bounds = found.values
    square = domain.mul_(e, e)
    values = [domain.simplified(domain.add_(domain.mul_(a, b), square)) for a in bounds for b in bounds]
    tapes = [found.tape(value) for value in values if value and found.is_constant(value)]
    return [tape for tape in tapes if tape is not None]


def rates_of(chain: Chain, V: str) -> list[str]:
    """The constants that are known as rates of V's decay."""
    key = chain.at.traits(V).key
    return [
        name
        for name in chain.loop.quantities
        if ("exponentially", f"{key} {chain.at.traits(name).key}") in chain.at.facts
    ]


def half_of(chain: Chain, rate: str) -> str:
    """Half of a constant: its own half where it is written as a double, or as the author writes one."""
    for sentence in chain.loop.statement.claim.then:
        if sentence.word == "exponentially" and sentence.by is not None:
            asked = claimed(chain, sentence.by)
            if algebra(chain, [asked, rate], _is_half):
                return asked
    expr = chain.loop.quantities[rate]
    return chain.q(expr / 2 if expr is not None else lift(0))


def _is_half(found: Algebra) -> bool:
    domain = found.session.domain
    half, whole = found.values
    return domain.is_zero(domain.sub_(domain.add_(half, half), whole))
