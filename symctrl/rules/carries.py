"""The author's line that carries facts over, and conclusions that no line states: exactly what is asked for.

What the other rules carry over on their way is in `ways` and `boundedness`, and exported from here.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from symctrl.facts import SETS, Fact
from symctrl.kernel.values import Sentence
from symctrl.rules.boundedness import bounded_reads, bounded_states
from symctrl.rules.chain import Chain
from symctrl.rules.constants import factors, products, squares_in
from symctrl.rules.edges import define, edges
from symctrl.rules.growth import growths
from symctrl.rules.quantities import claimed, speaks_of_all, total_of
from symctrl.rules.ways import ensure, ensure_all, exponentially_by

__all__ = [
    "bounded_reads",
    "bounded_states",
    "carries",
    "conclude",
    "ensure",
    "existence",
    "factors",
    "products",
    "speaks_of_all",
    "squares_in",
    "total_of",
]

What = Mapping[str, Any]


# The author's line


def carries(chain: Chain, what: What) -> bool:
    """A fact about a column or a set, with what the author says of the way."""
    fact: Fact = what["fact"]
    if fact.word == "exists":
        return existence(chain) or chain.run("exists", {"edges": []})
    if fact.of is None:
        return chain.fail(fact.word, f"that {fact.text()} is given by the rule lyapunov")
    if fact.word == "tends":
        existence(chain)
    names = chain.qs([fact.of] if fact.of.shape == (1, 1) else list(fact.of))
    if fact.word in SETS:
        time = None if fact.by is None else chain.q(fact.by)
        return set_of(chain, fact.word, fact.zero, names, time)
    hints = {key: said for key, said in what.items() if key != "fact" and not _is_left_out(said)}
    if hints:
        met = [_hinted(chain, fact.word, name, hints) for name in names]
        return all(met)
    missing = ensure_all(chain, fact.word, names)
    for name in missing:
        chain.fail(fact.word, f"no way was found from the facts so far to {fact.word} of {chain.said(name)}")
    return not missing


def _is_left_out(hint: Any) -> bool:
    return hint is None or (isinstance(hint, tuple) and not hint)


def _hinted(chain: Chain, word: str, name: str, hints: What) -> bool:
    """By what the author names, which is carried over first."""
    by = chain.qs(hints.get("by", ()))
    more = {key: chain.q(hints[key]) for key in ("least", "offset", "divisor") if key in hints}
    for one in by:
        ensure(chain, word, one)
    if "divisor" in more:
        ensure(chain, "apart", more["divisor"])
    if word == "exponentially":
        decays = [exponentially_by(chain, name, V, more.get("least")) for V in by]
        return all(decays)
    if word == "tends" and "times" in hints:
        of = {"how": "combination", "of": by, "times": _bounded_factors(chain, hints["times"])}
    elif word == "bounded" and "rate" in hints:
        return chain.run("carries", {"word": word, "how": "rate", "e": name, "by": chain.q(hints["rate"])})
    else:
        of = _below(chain, word, name, by)
    return chain.run("carries", {"word": word, "e": name} | more | of)


def _bounded_factors(chain: Chain, times: Sequence[Any]) -> list[str]:
    """The factors of a combination as quantities, known to be bounded where that can be carried over."""
    names = chain.qs(times)
    for name in names:
        ensure(chain, "bounded", name)
    return names


def _below(chain: Chain, word: str, name: str, by: list[str]) -> dict[str, Any]:
    """How a multiple of the quantity or its square, or of the sum of squares over all nodes, is bounded."""
    if word == "summable":
        return {"how": "parts", "by": by}
    table: dict[str, Any] = {"how": "square"}
    if word != "apart":
        table["by"] = by if word == "bounded" else by[0] if by else ""
    if by and speaks_of_all(chain, by[0]) and not speaks_of_all(chain, name):
        table["total"] = total_of(chain, name)
    return table


# Sets


def set_of(chain: Chain, word: str, zero: bool, names: Sequence[str], time: str | None) -> bool:
    """A set in which one lies for which the same word is known, or that is kept by itself."""
    if (word, _set_key(chain, zero, names, time)) in chain.at.facts:
        return True
    table = {"word": word, "how": "set", "e": list(names), "of_zeros": "yes" if zero else "no"}
    table |= {} if time is None else {"time": time}
    for inner_zero in (True, False):
        for inner in chain.loop.quantities:
            smaller = {"by": [inner], "by_zeros": "yes" if inner_zero else "no"}
            known = (word, _set_key(chain, inner_zero, [inner], time)) in chain.at.facts
            if known and chain.attempt("carries", table | smaller):
                return True
    if len(names) > 1 and word != "enters":
        met = [set_of(chain, word, zero, [name], time) for name in names]
        return all(met)
    if word == "stays" and not zero and chain.attempt("keeps", {"g": names[0]}):
        return True
    return chain.fail(word, f"no smaller set is known of which {word} is said")


def _set_key(chain: Chain, zero: bool, names: Sequence[str], time: str | None) -> str:
    keys = [chain.at.traits(name).key for name in names]
    return chain.at.set_key(zero, keys, "" if time is None else chain.at.traits(time).key)


# Conclusions


def conclude(chain: Chain, sentence: Sentence) -> bool:
    """Try to carry the facts so far over to a conclusion of the theorem."""
    if sentence.word == "exists":
        return existence(chain)
    define(chain, sentence)
    names = [claimed(chain, k) for k in sentence.of]
    if sentence.word not in SETS:
        return bool(names) and not ensure_all(chain, sentence.word, names)
    before = list(chain.outcomes)
    time = None if sentence.by is None else claimed(chain, sentence.by)
    met = set_of(chain, sentence.word, sentence.zero, names, time)
    chain.outcomes = chain.outcomes if met else before
    return met


def existence(chain: Chain) -> bool:
    """That solutions exist, where the states are bounded without more ado."""
    if ("exists", "") in chain.at.facts:
        return True
    bounded_states(chain)
    table = {"edges": edges(chain, list(chain.at.edges()))}
    return any(chain.attempt("exists", table | more) for more in ({}, *growths(chain)))
