"""Where the field and the conclusions are defined: what they divide by, and take roots and logarithms of."""

from __future__ import annotations

from collections.abc import Sequence

from symctrl.kernel.values import Sentence
from symctrl.rules.apart import stays_apart
from symctrl.rules.chain import Chain
from symctrl.rules.tapes import arguments


def edges(chain: Chain, wanted: Sequence[str]) -> list[str]:
    """Those arguments (`kind key`), as quantities, that are not known to stay inside by what is known."""
    open_ = {edge.split(" ", 1)[1] for edge in wanted if not chain.at.edge_is_known(*edge.split(" ", 1))}
    found: list[str] = []
    for tape in arguments(list(chain.loop.collector.listings.values())):
        if not open_:
            break
        name = chain.q(tape)
        key = chain.at.traits(name).key
        if key in open_:
            open_.discard(key)
            if not chain.at.has("apart", name):
                stays_apart(chain, name)
            found.append(name)
    return [
        name
        for name in found
        if any(
            edge.endswith(f" {chain.at.traits(name).key}") and not chain.at.edge_is_known(*edge.split(" ", 1))
            for edge in wanted
        )
    ]


def define(chain: Chain, sentence: Sentence) -> None:
    """What a conclusion divides by stays apart from zero, where that can be carried over."""
    for k in sentence.of:
        traits = chain.at.output_traits((chain.loop.statement.claim.listing, k))
        if not chain.at.edges_are_known(traits):
            edges(chain, sorted(traits.edges))
