"""Barbalat's lemma: a summable bound of a power is looked for among what is summable."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from symctrl.kernel.compose import rate_listing
from symctrl.kernel.rules.barbalat import POWERS
from symctrl.rules import carries
from symctrl.rules.chain import Chain

What = Mapping[str, Any]


def barbalat(chain: Chain, what: What) -> bool:
    carries.existence(chain)
    e = what["e"]
    parts = [e] if e.shape == (1, 1) else list(e)
    met = [_one(chain, chain.q(part), what) for part in parts]
    return all(met)


def _one(chain: Chain, e: str, what: What) -> bool:
    if chain.at.has("tends", e):
        return True
    carries.bounded_reads(chain, rate_listing(e, 1))
    tables = list(_tables(chain, e, what))
    if not tables:
        return chain.fail("W is summable", "nothing is known to be summable before this line")
    return chain.first("barbalat", tables)


def _tables(chain: Chain, e: str, what: What) -> Iterator[dict[str, Any]]:
    given = [chain.q(what["of"])] if what["of"] is not None else []
    reads = chain.at.traits(e).reads
    summable = given or [W for W in chain.having("summable") if chain.at.traits(W).reads & reads or not reads]
    rate = {"rate": chain.q(what["rate"])} if what["rate"] is not None else {}
    power = what["power"]
    for W in summable:
        over_nodes = carries.speaks_of_all(chain, W) and not carries.speaks_of_all(chain, e)
        if over_nodes:
            yield from _over_nodes(chain, e, W, what["least"], rate)
        for words in [_power(chain, power)] if power is not None else [{"power": "2"}, {"power": "1"}]:
            for least in _factors(chain, W, e, words, what["least"]):
                yield {"e": e, "W": W} | words | rate | ({"least": least} if least else {})


def _over_nodes(chain: Chain, e: str, W: str, least: Any, rate: dict[str, str]) -> Iterator[dict[str, Any]]:
    """W bounds the sum over all nodes of the square."""
    total = carries.total_of(chain, e)
    factors = [chain.q(least)] if least is not None else [None, *carries.products(chain)]
    for factor in factors:
        yield (
            {"e": e, "W": W, "power": "total", "total": total} | rate | ({"least": factor} if factor else {})
        )


def _factors(chain: Chain, W: str, e: str, words: Mapping[str, str], least: Any) -> list[str | None]:
    if least is not None:
        return [chain.q(least)]
    if words["power"] == "p":
        return [None, *carries.factors(chain)]
    return [None, *carries.squares_in(chain, W, e, POWERS[words["power"]])]


def _power(chain: Chain, power: Any) -> dict[str, str]:
    return {"power": str(power)} if isinstance(power, int) else {"power": "p", "p": chain.q(power)}


def barbalat_rate(chain: Chain, what: What) -> bool:
    e = what["e"]
    parts = [e] if e.shape == (1, 1) else list(e)
    met = []
    for part in parts:
        name = chain.q(part)
        carries.ensure(chain, "tends", name)
        carries.bounded_reads(chain, rate_listing(name, 2))
        met.append(chain.run("barbalat_rate", {"e": name}))
        chain.q(chain.loop.rate(part))  # so that the lines below can speak of it
    return all(met)
