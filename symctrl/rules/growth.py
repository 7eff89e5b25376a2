"""Functions that grow at most exponentially, for states that are not bounded: 1 + |x|^2, and rates to try."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from symctrl.kernel.certificate import per_node
from symctrl.rules.chain import Chain
from symctrl.rules.constants import factors
from symctrl.rules.quantities import formula
from symctrl.rules.tapes import bare

MAX_GROWING = 4  # states of a system that are not bounded


def growths(chain: Chain) -> list[dict[str, Any]]:
    """V and rates for the states that are not known to stay finite: three and twice the sizes of parameters,
    and their squares beside these.
    """
    field, kinds = chain.at.field(), chain.at.statement.scalars
    open_ = [x for x, rate in field.items() if not (chain.at.state_is_bounded(x) or rate.bounded)]
    if not open_ or len(open_) > MAX_GROWING or any(map(per_node, open_)):
        return []
    states = [chain.q(bare(x)) for x in open_]
    reads = sorted({name for x in open_ for name in field[x].reads if kinds.get(name) == "parameter"})
    positive = factors(chain)
    every = list(dict.fromkeys([*positive, *(chain.q(bare(name)) for name in reads)]))
    V = _sum(chain, "1", [f"{x} {x} *" for x in states], states)
    doubles = [f"{p} 2 *" if p in positive else f"{p} abs 2 *" for p in every]
    squares = [f"{p} {p} *" for p in every]
    rates = [_sum(chain, "3", terms, every) for terms in (doubles, [*doubles, *squares])]
    return [{"V": V, "rate": rate, "grows": states} for rate in dict.fromkeys(rates)]


def _sum(chain: Chain, first: str, terms: Sequence[str], names: Sequence[str]) -> str:
    text = " ".join([first, *(f"{term} +" for term in terms)])
    return chain.q(formula(chain, text, **{name: name for name in names}))
