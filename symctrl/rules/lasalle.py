"""The invariance principle: how many rates it takes, and combinations of them without denominators."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from symctrl.graph import Tape
from symctrl.kernel.compose import rate_listing
from symctrl.rules import carries
from symctrl.rules.algebra import Algebra, algebra
from symctrl.rules.chain import Chain

What = Mapping[str, Any]
MAX_ORDER = 4


def lasalle(chain: Chain, what: What) -> bool:
    V, zeros, limits = chain.q(what["V"]), chain.qs(what["zero"]), chain.qs(what["limit"])
    if not chain.at.has("nonincreasing", V) and not chain.run("falls", {"V": V, "by": [], "plus": []}):
        return False
    carries.existence(chain)
    table: dict[str, Any] = {"V": V, "zero": zeros, "limit": limits}
    if not chain.attempt("lasalle", table | {"limit": []}):
        return chain.run("lasalle", table | {"limit": []})
    for order in range(MAX_ORDER + 1):
        for implied in _implied(chain, zeros, order):
            if chain.attempt("lasalle", table | {"order": {"rates": order}} | implied):
                return True
    return chain.run("lasalle", table | {"order": {"rates": 1}})


def _implied(chain: Chain, zeros: Sequence[str], order: int) -> list[dict[str, Any]]:
    """The rates as they are; of the first rates also the numerators, with the denominators as factors."""
    if order != 1:
        return [{}]
    rates = [rate_listing(e, 1) for e in zeros]
    tapes = algebra(chain, [chain.q(_name(chain, r)) for r in rates], _numerators)
    if not tapes:
        return [{}]
    implied = {
        chain.q(above): [[chain.q(below), e, 1]] for (above, below), e in zip(tapes, zeros, strict=True)
    }
    return [{"implied": implied}, {}]


def _name(chain: Chain, listing: str) -> Tape:
    from symctrl.rules.loop import tape_of

    return tape_of(chain.at.statement.listings[listing])


def _numerators(found: Algebra) -> list[tuple[Tape, Tape]] | None:
    domain, field = found.session.domain, found.session.domain.field
    pairs = []
    for value in found.values:
        numerator, key = domain.together(value)
        below = field.polynomial(1)
        for f, e in key:
            below = below * field.factors[f] ** e
        above, under = found.tape({(): numerator}), found.tape({(): below})
        if above is None or under is None or not found.is_constant({(): below}):
            return None
        pairs.append((above, under))
    return pairs
