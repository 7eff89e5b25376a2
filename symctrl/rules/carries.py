"""Carrying facts over: the ways of the rule `carries`, tried in turn with constants that are guessed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

from symctrl.entries import component_names
from symctrl.expr import Expr, lift, symbol
from symctrl.facts import SETS, Fact
from symctrl.graph import Instruction, Tape
from symctrl.kernel.argument import single as single_output
from symctrl.kernel.closure import Reach
from symctrl.kernel.compose import composed
from symctrl.kernel.values import Sentence
from symctrl.problem import split
from symctrl.records import Sum, letters
from symctrl.rules.algebra import Algebra, algebra
from symctrl.rules.chain import Chain
from symctrl.rules.combination import combinations
from symctrl.rules.edges import define, edges
from symctrl.rules.loop import tape_of
from symctrl.rules.tapes import bare, single
from symctrl.written import StudyError

What = Mapping[str, Any]
MAX_INSIDE = 12


def carries(chain: Chain, what: What) -> bool:
    """The author's line: a fact about a column, with what he says of the way."""
    fact: Fact = what["fact"]
    if fact.word == "exists":
        return existence(chain) or chain.run("exists", {"edges": []})
    assert fact.of is not None
    parts = [fact.of] if fact.of.shape == (1, 1) else list(fact.of)
    if fact.word in SETS:
        return sets(chain, fact, parts)
    names = chain.qs(parts)
    hints = {
        k: v
        for k, v in what.items()
        if k != "fact" and v is not None and not (isinstance(v, tuple) and not v)
    }
    if hints:
        met = [_hinted(chain, fact.word, name, hints) for name in names]
        return all(met)
    for name in names:
        ensure(chain, fact.word, name)
    if fact.word == "tends":
        combinations(chain, [n for n in names if not chain.at.has("tends", n)])
    missing = [name for name in names if not chain.at.has(fact.word, name)]
    for name in missing:
        _as_the_author_would_see_it(chain, fact.word, name)
    return not missing


def _as_the_author_would_see_it(chain: Chain, word: str, name: str) -> None:
    shown = chain.loop.quantities.get(name)
    from symctrl.text import text

    of = text(shown) if shown is not None else name
    chain.fail(word, f"no way was found from the facts so far to {word} of {of}")


def _hinted(chain: Chain, word: str, name: str, hints: Mapping[str, Any]) -> bool:
    by = chain.qs(hints.get("by", ()))
    more = {k: chain.q(hints[k]) for k in ("least", "offset", "divisor") if k in hints}
    for one in by:
        ensure(chain, word, one)
    if "divisor" in more:
        ensure(chain, "apart", more["divisor"])
    if word == "tends" and "times" in hints:
        times = chain.qs(hints["times"])
        for factor in times:
            ensure(chain, "bounded", factor)
        return chain.run(
            "carries", {"word": word, "how": "combination", "e": name, "of": by, "times": times} | more
        )
    if word == "bounded" and "rate" in hints:
        return chain.run("carries", {"word": word, "how": "rate", "e": name, "by": chain.q(hints["rate"])})
    if word == "exponentially":
        decays = [_exponentially(chain, name, V, more) for V in by]
        return all(decays)
    how, of = {
        "bounded": ("square", by),
        "tends": ("square", by[0] if by else ""),
        "summable": ("parts", by),
        "apart": ("square", None),
    }[word]
    table = {"word": word, "how": how, "e": name} | more | ({"by": of} if of is not None else {})
    if how == "square" and by and speaks_of_all(chain, by[0]) and not speaks_of_all(chain, name):
        table |= {"total": total_of(chain, name)}
    if "least" in more or not chain.attempt("carries", table):
        return chain.run("carries", table)
    return True


def speaks_of_all(chain: Chain, name: str) -> bool:
    """Has the quantity a sum over all nodes in it?"""
    reach = Reach(chain.at.statement)
    reach.listing(name, "ij", 0, None)
    names = chain.at.statement.names
    return any(key in names and names[key].kind == "total" for key in reach.read)


def total_of(chain: Chain, name: str, power: int = 2) -> str:
    """The sum over all nodes, and neighbours where it speaks of them, of a power of a quantity."""
    fleet = chain.loop.study.of_fleet
    assert fleet is not None
    e = shown(chain, name)
    summand = e * e if power == 2 else e
    if "j" in letters(e):
        summand = fleet.sum(fleet.neighbour, summand)
    return chain.q(fleet.sum(fleet.node, summand))


def shown(chain: Chain, name: str) -> Expr:
    """The quantity as an expression; one that is a tape is a symbol alone."""
    known = chain.loop.quantities[name]
    if known is not None:
        return known
    (step,) = chain.at.statement.listings[name].code
    base, _, index = split(step.name)
    for declared in chain.loop.study.symbols.values():
        label = declared.expr.args[0].replace(".*", ".i")
        names = component_names(label, declared.expr.shape, declared.expr.args[2])
        if step.name in names:
            whole = symbol(label, declared.expr.shape, None, declared.expr.args[2])
            return whole if whole.shape == (1, 1) else list(whole)[names.index(step.name)]
    raise StudyError(f"{base}{index} is no symbol of {chain.loop.study.name}")


def ensure(chain: Chain, word: str, name: str) -> bool:
    """Is the fact known, or can it be carried over without being asked?"""
    if chain.at.has(word, name):
        return True
    ways = {
        "bounded": bounded,
        "tends": tends,
        "summable": summable,
        "exponentially": exponentially,
        "apart": stays_apart,
    }
    way = ways.get(word)
    return way is not None and way(chain, name)


def bounded(chain: Chain, name: str) -> bool:
    composed_of = {"word": "bounded", "how": "composed", "e": name}
    if chain.attempt("carries", composed_of) or _directly_bounded(chain, name):
        return True
    tape = tape_of(chain.at.statement.listings[name])
    inside = [r for r, step in enumerate(tape.code) if step.op in ("ADD", "SUB") and r != tape.outputs[0]]
    inner = [_directly_bounded(chain, chain.q(single(tape, r))) for r in inside[:MAX_INSIDE]]
    return any(inner) and chain.attempt("carries", composed_of)


def _directly_bounded(chain: Chain, name: str) -> bool:
    """By a square below a bounded function, by constants, or by a completed square."""
    for V in [V for V in chain.having("bounded") if _shares(chain, V, name)]:
        for least in (None, *squares_in(chain, V, name)):
            table: dict[str, Any] = {"word": "bounded", "how": "square", "e": name, "by": [V]}
            if chain.attempt("carries", table | ({"least": least} if least else {})):
                return True
    if bounded_by_constants(chain, name):
        return True
    near = [V for V in chain.having("bounded") if _shares(chain, V, name)]
    return any(_shifted(chain, V, name) or _solved(chain, V, name) for V in near)


def bounded_by_constants(chain: Chain, name: str) -> bool:
    """By a relation or by assumed bounds, without any function."""
    table = {"word": "bounded", "how": "square", "e": name, "by": []}
    return any(chain.attempt("carries", table | {"offset": offset}) for offset in offsets(chain, name))


def _solved(chain: Chain, s: str, name: str) -> bool:
    """e from a bounded s = c e + r with a constant c and a bounded r."""
    found = algebra(chain, [s, name], _isolated)
    if not found:
        return False
    over, less, rest = (chain.q(tape) for tape in found)
    table = {"word": "bounded", "how": "combination", "e": name, "of": [s, rest], "times": [over, less]}
    return chain.attempt("carries", table)


def _isolated(found: Algebra) -> tuple[Tape, Tape, Tape] | None:
    """1/c, -1/c and r."""
    s, e = found.values
    at = _symbol(found, e)
    if at is None:
        return None
    domain = found.session.domain
    c = found.coefficient(s, {at: 1})
    rest = domain.simplified(domain.sub_(s, domain.mul_(c, e)))
    if not c or not found.is_constant(c) or at in found.occurring(rest):
        return None
    over = domain.inv_(c)
    tapes = [found.tape(value) for value in (over, domain.neg_(over), rest)]
    return None if None in tapes else (tapes[0], tapes[1], tapes[2])  # type: ignore[return-value]


def _shifted(chain: Chain, V: str, name: str) -> bool:
    """By a square in V that is completed: a (e + b)^2 with constants a and b."""
    found = algebra(chain, [V, name], _completed)
    if not found:
        return False
    least, shift = (chain.q(tape) for tape in found)
    y = chain.q(_sum(chain, name, shift))
    table = {"word": "bounded", "how": "square", "e": y, "by": [V], "least": least}
    if not chain.attempt("carries", table):
        return False
    one, less = chain.q("1"), chain.q("-1")
    combined = {"word": "bounded", "how": "combination", "e": name, "of": [y, shift], "times": [one, less]}
    return chain.attempt("carries", combined)


def _sum(chain: Chain, a: str, b: str) -> Tape:
    """Two quantities added up."""
    return tape_of(composed(chain.at.statement.listings, ["a b +"], {"a": a, "b": b}))


def _completed(found: Algebra) -> tuple[Tape, Tape] | None:
    V, e = found.values
    at = _symbol(found, e)
    if at is None:
        return None
    domain = found.session.domain
    a, b = (found.coefficient(V, {at: power}) for power in (2, 1))
    if not a or not b or not found.is_constant(a) or not found.is_constant(b):
        return None
    shift = domain.mul_(b, domain.inv_(domain.add_(a, a)))
    tapes = found.tape(a), found.tape(domain.simplified(shift))
    return (tapes[0], tapes[1]) if tapes[0] is not None and tapes[1] is not None else None


def tends(chain: Chain, name: str) -> bool:
    if ("exists", "") not in chain.at.facts:
        return False
    for rule, line in chain.again:
        if "input" in line and not chain.at.has("tends", line["V"]) and line["input"] != name:
            ensure(chain, "tends", line["input"])
            chain.attempt(rule, line)
    if _sum_of_small(chain, name):
        return True
    combinations(chain, [name])
    if chain.at.has("tends", name):
        return True
    decaying = chain.having("tends") + chain.having("exponentially")
    for V in [V for V in dict.fromkeys(decaying) if _shares(chain, V, name)]:
        for least in (None, *squares_in(chain, V, name)):
            table: dict[str, Any] = {"word": "tends", "how": "square", "e": name, "by": V}
            if chain.attempt("carries", table | ({"least": least} if least else {})):
                return True
    return False


def _sum_of_small(chain: Chain, name: str) -> bool:
    """A sum over all nodes, of a term that tends to zero at each."""
    known = chain.loop.quantities.get(name)
    record = known.args[0] if known is not None and known.op == "deferred" else None
    if not isinstance(record, Sum) or not record.total:
        return False
    term = chain.q(record.body)
    ensure(chain, "tends", term)
    return chain.attempt("carries", {"word": "tends", "how": "sum", "e": name, "by": term})


def summable(chain: Chain, name: str) -> bool:
    for W in [W for W in chain.having("summable") if _shares(chain, W, name)]:
        for least in (None, *factors(chain)):
            table: dict[str, Any] = {"word": "summable", "how": "parts", "e": name, "by": [W]}
            if chain.attempt("carries", table | ({"least": least} if least else {})):
                return True
    return False


def stays_apart(chain: Chain, name: str) -> bool:
    """As a constant, as a constant multiple of what stays apart, or above its square."""
    if chain.at.is_constant(name):
        return chain.attempt("carries", {"word": "apart", "how": "constant", "e": name})
    supposed = [k for sentence in chain.loop.statement.claim.suppose if sentence.word == "apart" for k in sentence.of]
    known = [claim_quantity(chain, k) for k in supposed]
    for z in dict.fromkeys([*known, *chain.having("apart")]):
        if z == name or chain.at.is_constant(z):
            continue
        tape = algebra(chain, [name, z], _constant_quotient, relations=True)
        if tape is not None:
            table = {"word": "apart", "how": "multiple", "e": name, "by": z, "times": chain.q(tape)}
            if chain.attempt("carries", table):
                return True
        if chain.attempt("carries", {"word": "apart", "how": "above", "e": name, "by": z}):
            return True
    return False


def exponentially(chain: Chain, name: str) -> bool:
    known = [V for V in chain.having("exponentially") if V not in (name,)]
    return any(_exponentially(chain, name, V, {}) for V in known)


def _exponentially(chain: Chain, name: str, V: str, more: Mapping[str, str]) -> bool:
    for rate in rates_of(chain, V):
        half = half_of(chain, rate)
        for least in [more.get("least")] if "least" in more else [None, *squares_in(chain, V, name)]:
            table = {"word": "exponentially", "how": "square", "e": name, "by": V, "rate": rate, "half": half}
            if chain.attempt("carries", table | ({"least": least} if least else {})):
                return True
    return False


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
    wanted = [s for s in chain.loop.statement.claim.then if s.word == "exponentially" and s.by is not None]
    for sentence in wanted:
        assert sentence.by is not None
        asked = claim_quantity(chain, sentence.by)
        if algebra(chain, [asked, rate], _is_half):
            return asked
    shown = chain.loop.quantities[rate]
    return chain.q(shown / 2 if shown is not None else lift(0))


def _is_half(found: Algebra) -> bool:
    domain = found.session.domain
    return domain.is_zero(domain.sub_(domain.add_(found.values[0], found.values[0]), found.values[1]))


def claim_quantity(chain: Chain, k: int) -> str:
    """Output k of the theorem's claim as a quantity."""
    return chain.q(tape_of(single_output(chain.loop.statement.listings["claim"], k)))


def sets(chain: Chain, fact: Fact, parts: Sequence[Expr]) -> bool:
    """A set that contains one for which the same word is known."""
    names = chain.qs(list(parts))
    time = None if fact.by is None else chain.q(fact.by)
    return set_of(chain, fact.word, fact.zero, names, time)


def set_of(chain: Chain, word: str, zero: bool, names: Sequence[str], time: str | None) -> bool:
    at = chain.at
    key = at.set_key(zero, [at.traits(n).key for n in names], "" if time is None else at.traits(time).key)
    if (word, key) in at.facts:
        return True
    for inner_zero in (True, False):
        for inner in chain.loop.quantities:
            table = {
                "word": word,
                "how": "set",
                "e": list(names),
                "of_zeros": "yes" if zero else "no",
                "by": [inner],
                "by_zeros": "yes" if inner_zero else "no",
            } | ({} if time is None else {"time": time})
            known = at.set_key(
                inner_zero, [at.traits(inner).key], "" if time is None else at.traits(time).key
            )
            if (word, known) in at.facts and chain.attempt("carries", table):
                return True
    if word == "stays" and not zero and all(chain.attempt("keeps", {"g": name}) for name in names):
        return len(names) == 1
    return chain.fail(word, f"no smaller set is known of which {word} is said")


def conclude(chain: Chain, sentence: Sentence) -> bool:
    """Try to carry the facts so far over to a conclusion of the theorem."""
    if sentence.word == "exists":
        return existence(chain)
    define(chain, sentence)
    names = [claim_quantity(chain, k) for k in sentence.of]
    if sentence.word in SETS:
        before = list(chain.outcomes)
        time = None if sentence.by is None else claim_quantity(chain, sentence.by)
        met = set_of(chain, sentence.word, sentence.zero, names, time)
        chain.outcomes = before if not met else chain.outcomes
        return met
    for name in names:
        ensure(chain, sentence.word, name)
    if sentence.word == "tends":
        combinations(chain, [n for n in names if not chain.at.has("tends", n)])
    return bool(names) and all(chain.at.has(sentence.word, name) for name in names)


def existence(chain: Chain) -> bool:
    """That solutions exist, where the states are bounded without more ado."""
    if ("exists", "") in chain.at.facts:
        return True
    bounded_states(chain)
    return chain.attempt("exists", {"edges": edges(chain, list(chain.at.edges()))})


def bounded_reads(chain: Chain, listing: str) -> None:
    """Carry boundedness over to what a listing reads, states and signals; of two nodes there is no rate."""
    if listing not in chain.at.statement.listings:
        return
    for name in sorted(chain.at.traits(listing).reads):
        if not chain.at.free_is_bounded(name):
            bounded(chain, chain.q(bare(name.replace(".j", ".i"))))


def bounded_states(chain: Chain) -> None:
    """Carry boundedness over to every state for which that succeeds."""
    names = {state: chain.q(bare(state)) for state in chain.at.statement.motion}
    for state, name in names.items():
        if not chain.at.state_is_bounded(state):
            bounded_by_constants(chain, name)
    forms(chain, [names[state] for state in names if not chain.at.state_is_bounded(state)])
    for state, name in names.items():
        if not chain.at.state_is_bounded(state):
            bounded(chain, name)
    for rate in chain.at.field().values():
        for name in sorted(
            n for n in rate.reads if chain.at.is_signal(n) and not chain.at.free_is_bounded(n)
        ):
            bounded(chain, chain.q(bare(name.replace(".j", ".i"))))
    left = [names[state] for state in names if not chain.at.state_is_bounded(state)]
    for name in left:
        bounded(chain, name)


def forms(chain: Chain, names: Sequence[str]) -> None:
    """e'P e <= k + V for the quadratic part of a bounded V in each column of symbols, and in all."""
    columns: dict[str, list[str]] = {}
    for name in names:
        (read,) = chain.at.traits(name).reads or ("",)
        columns.setdefault(read.partition("[")[0], []).append(name)
    for V in chain.having("bounded"):
        for column in (*columns.values(), list(names)):
            if len(column) > 1 or column == list(names):
                _form(chain, V, [n for n in column if not chain.at.has("bounded", n)])


def _form(chain: Chain, V: str, column: Sequence[str]) -> bool:
    if not column:
        return False
    entries = algebra(chain, [V, *column], _hessian)
    if not entries:
        return False
    table = {
        "word": "bounded",
        "how": "form",
        "e": list(column),
        "P": [chain.q(t) for t in entries],
        "by": [V],
    }
    return chain.attempt("carries", table)


def _hessian(found: Algebra) -> list[Tape] | None:
    """Half the second derivatives of the first value by the others, column by column; None where not
    constant.
    """
    V, *column = found.values
    at = [_symbol(found, value) for value in column]
    tapes = []
    for a in at:
        for b in at:
            if a is None or b is None:
                return None
            powers = {a: 2} if a == b else {a: 1, b: 1}
            others = {g: 0 for g in at if g is not None and g not in powers}
            entry = found.coefficient(V, powers | others)
            entry = entry if a == b else found.session.domain.scaled(entry, Fraction(1, 2))
            if not found.is_constant(entry):
                return None
            tape = found.tape(entry)
            if tape is None:
                return None
            tapes.append(tape)
    return tapes


def squares_in(chain: Chain, V: str, name: str, power: str = "e e *") -> list[str]:
    """Constants a for which a e^2, or another power, may be below V.

    The coefficient of e^2 in V, the quotient of V by the power, a half, the gains.
    """
    tape = algebra(chain, [V, name], _square_coefficient)
    below = chain.q(tape_of(composed(chain.at.statement.listings, [power], {"e": name})))
    tapes = [tape, algebra(chain, [V, below], _constant_quotient)]
    own = [chain.q(t) for t in tapes if t is not None]
    listings = chain.at.statement.listings
    halves = [chain.q(tape_of(composed(listings, ["a 2 /"], {"a": a}))) for a in own]
    return list(dict.fromkeys([*own, *halves] if own else [chain.q("1/2"), *factors(chain)]))


def _constant_quotient(found: Algebra) -> Tape | None:
    V, e = found.values
    domain = found.session.domain
    if not e or not V:
        return None
    quotient = domain.simplified(domain.mul_(V, domain.inv_(e)))
    return found.tape(quotient) if found.is_constant(quotient) else None


def _square_coefficient(found: Algebra) -> Tape | None:
    V, e = found.values
    at = _symbol(found, e)
    if at is None:
        return None
    coefficient = found.coefficient(V, {at: 2})
    return found.tape(coefficient) if coefficient and found.is_constant(coefficient) else None


def _symbol(found: Algebra, value: Any) -> int | None:
    """The generator that a value is."""
    field = found.session.domain.field
    if set(value) != {()} or len(value[()]) != 1:
        return None
    occurring = field.occurring(value[()])
    if len(occurring) != 1:
        return None
    (g,) = occurring
    return g if value[()] == field.variable(g) else None


def factors(chain: Chain) -> list[str]:
    """The parameters that are assumed positive, and their halves, as constants to try."""
    found = []
    for assumption in chain.at.available:
        listing = chain.at.statement.listings[assumption.of[0][0]]
        step = listing.code[listing.outputs[assumption.of[0][1]]]
        is_parameter = step.op == "INPUT" and chain.at.statement.scalars.get(step.name) == "parameter"
        if assumption.kind == "positive" and is_parameter:
            found.append(chain.q(Tape((Instruction("INPUT", name=step.name),), (0,))))
    return found


def products(chain: Chain) -> list[str]:
    """The positive parameters and their products in pairs, as constants to try."""
    own = factors(chain)
    listings = chain.at.statement.listings
    tapes = [
        tape_of(composed(listings, ["a b *"], {"a": a, "b": b})) for k, a in enumerate(own) for b in own[k:]
    ]
    return [*own, *(chain.q(tape) for tape in tapes)]


def offsets(chain: Chain, name: str) -> Iterator[str]:
    """Constants that may bound the square: 1, and products of the two bounds of a symbol that are assumed."""
    yield chain.q("1")
    bounds = [a for a in chain.at.available if a.kind in ("nonnegative", "positive") and len(a.of) == 1]
    tapes = [tape_of(single_output(chain.at.statement.listings[a.of[0][0]], a.of[0][1])) for a in bounds]
    reads = chain.at.traits(name).reads
    tapes = [t for t in tapes if reads & set(t.inputs)]
    if not tapes or len(tapes) > 12:
        return
    quantities = [chain.q(t) for t in tapes]
    for tape in algebra(chain, [name, *quantities], _squared_bounds) or []:
        yield chain.q(tape)


def _squared_bounds(found: Algebra) -> list[Tape]:
    """p^2, where it is constant, as (p - e)(p + e) + e^2 for pairs of bounds."""
    domain = found.session.domain
    e, *bounds = found.values
    tapes = []
    for a in bounds:
        for b in bounds:
            value = domain.simplified(domain.add_(domain.mul_(a, b), domain.mul_(e, e)))
            if value and found.is_constant(value):
                tape = found.tape(value)
                if tape is not None:
                    tapes.append(tape)
    return tapes


def _shares(chain: Chain, V: str, name: str) -> bool:
    shared = chain.at.traits(V).reads & chain.at.traits(name).reads
    return V not in (name,) and bool(shared)
