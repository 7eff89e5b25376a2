"""That a quantity stays bounded: from its parts, from a function above its square, from assumed bounds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import product

from symctrl.domains.field import Exact
from symctrl.graph import Tape
from symctrl.rules.algebra import Algebra, algebra, symbol_of
from symctrl.rules.chain import Chain
from symctrl.rules.constants import carried_with, offsets, squares_in
from symctrl.rules.edges import edges
from symctrl.rules.loop import tape_of
from symctrl.rules.quantities import formula, share_symbols
from symctrl.rules.tapes import bare, single

MAX_INSIDE = 12  # sums and differences inside a quantity that are tried by themselves


# One quantity


def bounded(chain: Chain, name: str) -> bool:
    """As it is composed, by itself, or as it is composed of sums and differences that are bounded."""
    composed_of = {"word": "bounded", "how": "composed", "e": name}
    if chain.attempt("carries", composed_of):
        return True
    divides = sorted(chain.at.traits(name).edges)
    if divides and not edges(chain, divides) and chain.attempt("carries", composed_of):
        return True
    if _by_itself(chain, name):
        return True
    tape = tape_of(chain.at.statement.listings[name])
    inside = [r for r, step in enumerate(tape.code) if step.op in ("ADD", "SUB") and r != tape.outputs[0]]
    inner = [_by_itself(chain, chain.q(single(tape, r))) for r in inside[:MAX_INSIDE]]
    return any(inner) and chain.attempt("carries", composed_of)


def _by_itself(chain: Chain, name: str) -> bool:
    """By a square below a bounded function, by constants, by a completed square, or solved for."""
    near = _near(chain, name)
    if any(_below(chain, V, name) for V in near) or bounded_by_constants(chain, name):
        return True
    near = _near(chain, name)
    for V in near:
        _squares_of(chain, V, name)
    near = _near(chain, name)
    return any(_shifted(chain, V, name) or _solved(chain, V, name) or _quartic(chain, V, name) for V in near)


def _squares_of(chain: Chain, V: str, name: str) -> None:
    """What is squared in a bounded V, as it is written there, and speaks of the quantity."""
    tape = tape_of(chain.at.statement.listings[V])
    exponents = {k for k, step in enumerate(tape.code) if step.op == "CONST" and step.value == 2}
    for step in tape.code:
        twice = step.op == "SQ" or (step.op in ("POW", "CONSTPOW") and step.args[1] in exponents)
        if twice and tape.code[step.args[0]].op in ("ADD", "SUB"):
            s = chain.q(single(tape, step.args[0]))
            if share_symbols(chain, s, name) and not chain.at.has("bounded", s):
                _below(chain, V, s)


def _near(chain: Chain, name: str) -> list[str]:
    """What is known to be bounded and shares a symbol with the quantity."""
    return [V for V in chain.having("bounded") if share_symbols(chain, V, name)]


def _below(chain: Chain, V: str, name: str) -> bool:
    """A multiple of its square, or of its absolute value, is below the bounded V, or below its logarithm."""
    table = {"word": "bounded", "how": "square", "e": name, "by": [V]}
    if carried_with(chain, table, squares_in(chain, V, name)):
        return True
    if chain.attempt("carries", {"word": "bounded", "how": "parts", "e": name, "by": [V]}):
        return True
    return any(
        chain.attempt("carries", {"word": "bounded", "how": "logarithm", "e": name, "by": V} | way)
        for way in _logarithms(chain, V)
    )


def _logarithms(chain: Chain, V: str) -> list[dict[str, str]]:
    """g and a for each term a log(1 + g) of V."""
    found = algebra(chain, [V], _logarithmic_terms) or []
    return [{"inside": chain.q(inside), "least": chain.q(least)} for inside, least in found]


def _logarithmic_terms(found: Algebra) -> list[tuple[Tape, Tape]]:
    (V,) = found.values
    domain, field = found.session.domain, found.session.domain.field
    terms = []
    for k, g in enumerate(field.generators):
        if g.kind == "function" and g.name == "log":
            factor = found.coefficient(V, {k: 1})
            less = domain.sub_(g.argument[0], domain.constant(Fraction(1)))
            tapes = _tapes(found, [less, factor]) if factor and found.is_constant(factor) else None
            terms += [(tapes[0], tapes[1])] if tapes else []
    return terms


def bounded_by_constants(chain: Chain, name: str) -> bool:
    """By a relation or by assumed bounds, without any function."""
    table = {"word": "bounded", "how": "square", "e": name, "by": []}
    return any(chain.attempt("carries", table | {"offset": offset}) for offset in offsets(chain, name))


def _shifted(chain: Chain, V: str, name: str) -> bool:
    """By a square in V that is completed: a (e + b)^2 with constants a and b."""
    found = algebra(chain, [V, name], _completed)
    if not found:
        return False
    least, shift = (chain.q(tape) for tape in found)
    y = chain.q(formula(chain, "a b +", a=name, b=shift))
    table = {"word": "bounded", "how": "square", "e": y, "by": [V], "least": least}
    return chain.attempt("carries", table) and _combined(
        chain, name, [y, shift], [chain.q("1"), chain.q("-1")]
    )


def _completed(found: Algebra) -> list[Tape] | None:
    """a and b."""
    V, e = found.values
    at = symbol_of(found, e)
    if at is None:
        return None
    domain = found.session.domain
    a, linear = (found.coefficient(V, {at: power}) for power in (2, 1))
    if not a or not linear or not found.is_constant(a) or not found.is_constant(linear):
        return None
    return _tapes(found, [a, domain.simplified(domain.mul_(linear, domain.inv_(domain.add_(a, a))))])


def _quartic(chain: Chain, V: str, name: str) -> bool:
    """By a fourth power in V with a constant factor a: a e^2 <= a e^4 + a/4."""
    found = algebra(chain, [V, name], _fourth)
    if not found:
        return False
    least, offset = (chain.q(tape) for tape in found)
    table = {"word": "bounded", "how": "square", "e": name, "by": [V], "least": least, "offset": offset}
    return chain.attempt("carries", table)


def _fourth(found: Algebra) -> list[Tape] | None:
    """a and a/4."""
    V, e = found.values
    at = symbol_of(found, e)
    a = found.coefficient(V, {at: 4}) if at is not None else None
    if not a or not found.is_constant(a):
        return None
    return _tapes(found, [a, found.session.domain.scaled(a, Fraction(1, 4))])


def _solved(chain: Chain, s: str, name: str) -> bool:
    """e from a bounded s = c e + r with a constant c and a bounded r."""
    found = algebra(chain, [s, name], _isolated)
    if not found:
        return False
    over, less, rest = (chain.q(tape) for tape in found)
    return _combined(chain, name, [s, rest], [over, less])


def _isolated(found: Algebra) -> list[Tape] | None:
    """1/c, -1/c and r."""
    s, e = found.values
    at = symbol_of(found, e)
    if at is None:
        return None
    domain = found.session.domain
    c = found.coefficient(s, {at: 1})
    rest = domain.simplified(domain.sub_(s, domain.mul_(c, e)))
    if not c or not found.is_constant(c) or at in found.occurring(rest):
        return None
    over = domain.inv_(c)
    return _tapes(found, [over, domain.neg_(over), rest])


def _tapes(found: Algebra, values: Sequence[Exact]) -> list[Tape] | None:
    """The values as instructions; None where one has none."""
    tapes = [tape for value in values if (tape := found.tape(value)) is not None]
    return tapes if len(tapes) == len(values) else None


def _combined(chain: Chain, name: str, of: Sequence[str], times: Sequence[str]) -> bool:
    """As a combination of what is bounded."""
    table = {"word": "bounded", "how": "combination", "e": name, "of": list(of), "times": list(times)}
    return chain.attempt("carries", table)


# What a listing reads, and the states


def bounded_reads(chain: Chain, listing: str) -> None:
    """Carry boundedness over to what a listing reads, states and signals; of two nodes there is no rate."""
    if listing in chain.at.statement.listings:
        _bounded_symbols(chain, sorted(chain.at.traits(listing).reads))


def _bounded_symbols(chain: Chain, names: Sequence[str]) -> None:
    for name in names:
        if not chain.at.free_is_bounded(name):
            bounded(chain, chain.q(bare(name.replace(".j", ".i"))))


def bounded_states(chain: Chain) -> None:
    """Carry boundedness over to every state for which that succeeds."""
    names = {state: chain.q(bare(state)) for state in chain.at.statement.motion}
    for name in _open(chain, names):
        bounded_by_constants(chain, name)
    bounded_forms(chain, list(_open(chain, names)))
    for name in _open(chain, names):
        bounded(chain, name)
    for rate in chain.at.field().values():
        _bounded_symbols(chain, sorted(n for n in rate.reads if chain.at.is_signal(n)))
    for name in list(_open(chain, names)):
        bounded(chain, name)


def _open(chain: Chain, names: Mapping[str, str]) -> Iterator[str]:
    """The quantities, by state, of the states that are not known to be bounded, each when its turn comes."""
    return (name for state, name in names.items() if not chain.at.state_is_bounded(state))


# Several quantities at once


def bounded_forms(chain: Chain, names: Sequence[str]) -> None:
    """e'P e <= k + V for the quadratic part of a bounded V in all symbols, and in each column of them."""
    columns: dict[str, list[str]] = {}
    for name in names:
        read = min(chain.at.traits(name).reads, default="")
        columns.setdefault(read.partition("[")[0], []).append(name)
    for V in chain.having("bounded"):
        for column in (list(names), *columns.values()):
            if len(column) > 1:
                _bounded_form(chain, V, [n for n in column if not chain.at.has("bounded", n)])


def _bounded_form(chain: Chain, V: str, column: Sequence[str]) -> bool:
    entries = algebra(chain, [V, *column], _hessian) if column else None
    if not entries:
        return False
    P = [chain.q(tape) for tape in entries]
    table = {"word": "bounded", "how": "form", "e": list(column), "P": P, "by": [V]}
    return chain.attempt("carries", table)


def _hessian(found: Algebra) -> list[Tape] | None:
    """Half the second derivatives of the first value by the others, column by column; None where not
    constant.
    """
    V, *column = found.values
    at = [g for value in column if (g := symbol_of(found, value)) is not None]
    if len(at) < len(column):
        return None
    entries = [_half_second_derivative(found, V, at, a, b) for a, b in product(at, at)]
    return _tapes(found, entries) if all(map(found.is_constant, entries)) else None


def _half_second_derivative(found: Algebra, V: Exact, at: Sequence[int], a: int, b: int) -> Exact:
    """By the generators a and b, where all those in `at` are zero."""
    powers = {a: 2} if a == b else {a: 1, b: 1}
    entry = found.coefficient(V, dict.fromkeys(at, 0) | powers)
    return entry if a == b else found.session.domain.scaled(entry, Fraction(1, 2))
