"""Carrying a fact over to a quantity: the ways of each word, in turn, with constants that are guessed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from symctrl.records import Sum
from symctrl.rules.apart import stays_apart
from symctrl.rules.boundedness import bounded, bounded_forms
from symctrl.rules.chain import Chain
from symctrl.rules.combination import combinations
from symctrl.rules.constants import (
    carried_with,
    factors,
    half_of,
    rates_of,
    squares_in,
)
from symctrl.rules.quantities import share_symbols


def ensure(chain: Chain, word: str, name: str) -> bool:
    """Is the fact known, or can it be carried over without being asked?"""
    if chain.at.has(word, name):
        return True
    return word in WAYS and WAYS[word](chain, name)


def ensure_all(chain: Chain, word: str, names: Sequence[str]) -> list[str]:
    """The quantities to which the fact cannot be carried over, one by one, as a vector or by combinations."""
    if word == "bounded" and len(names) > 1:
        bounded_forms(chain, [name for name in names if not chain.at.has(word, name)])
    for name in names:
        ensure(chain, word, name)
    if word == "tends":
        combinations(chain, [name for name in names if not chain.at.has(word, name)])
    return [name for name in names if not chain.at.has(word, name)]


def tends(chain: Chain, name: str) -> bool:
    """As a sum of small terms, as a combination, or by a square below what tends to zero."""
    if ("exists", "") not in chain.at.facts:
        return False
    _again(chain, name)
    if _sum_of_small(chain, name):
        return True
    combinations(chain, [name])
    if chain.at.has("tends", name):
        return True
    decaying = dict.fromkeys(chain.having("tends") + chain.having("exponentially"))
    near = [V for V in decaying if share_symbols(chain, V, name)]
    table = {"word": "tends", "how": "square", "e": name}
    return any(carried_with(chain, table | {"by": V}, squares_in(chain, V, name)) for V in near)


def _again(chain: Chain, name: str) -> None:
    """Earlier lines give more once their input tends to zero."""
    for rule, line in chain.again:
        if "input" in line and not chain.at.has("tends", line["V"]) and line["input"] != name:
            ensure(chain, "tends", line["input"])
            chain.attempt(rule, line)


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
    """Below a multiple of what is summable."""
    near = [W for W in chain.having("summable") if share_symbols(chain, W, name)]
    table = {"word": "summable", "how": "parts", "e": name}
    return any(carried_with(chain, table | {"by": [W]}, factors(chain)) for W in near)


def exponentially(chain: Chain, name: str) -> bool:
    """By a square below what decays exponentially."""
    known = [V for V in chain.having("exponentially") if name != V]
    return any(exponentially_by(chain, name, V) for V in known)


def exponentially_by(chain: Chain, name: str, V: str, least: str | None = None) -> bool:
    """By a square below V, times `least` or one of the constants to try, at half of a known rate of V."""
    for rate in rates_of(chain, V):
        half = half_of(chain, rate)
        table = {"word": "exponentially", "how": "square", "e": name, "by": V, "rate": rate, "half": half}
        if least is not None:
            met = chain.attempt("carries", table | {"least": least})
        else:
            met = carried_with(chain, table, squares_in(chain, V, name))
        if met:
            return True
    return False


WAYS: Mapping[str, Callable[[Chain, str], bool]] = {
    "bounded": bounded,
    "tends": tends,
    "summable": summable,
    "exponentially": exponentially,
    "apart": stays_apart,
}
