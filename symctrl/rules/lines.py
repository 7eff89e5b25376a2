"""Lines whose constants the author gives: falls, decays, outside, holds, part, keeps, exists, lyapunov."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from symctrl.rules import carries
from symctrl.rules.chain import Chain
from symctrl.rules.edges import edges

What = Mapping[str, Any]


def falls(chain: Chain, what: What) -> bool:
    V, parts, inputs = chain.q(what["V"]), chain.qs(what["by"]), chain.qs(what["plus"])
    for w in inputs:
        carries.ensure(chain, "summable", w)
    table: dict[str, Any] = {"V": V, "by": parts, "plus": inputs}
    if what["above"] is not None:
        table["above"] = chain.q(what["above"])
    return chain.run("falls", table)


def decays(chain: Chain, what: What) -> bool:
    named = {k: chain.q(x) for k, x in what.items() if x is not None}
    if "input" in named:
        for word in ("tends", "summable", "bounded"):
            carries.ensure(chain, word, named["input"])
    if "radius" in named:
        named["set"] = chain.q(what["radius"] - what["V"])
    if what["b"] is not None or what["radius"] is not None or what["input"] is not None:
        _existence_by(chain, dict(named))
    chain.again.append(("decays", named))
    return chain.run("decays", named)


def _existence_by(chain: Chain, named: dict[str, str]) -> None:
    """Facts about large times need existence, which may follow from what the line says of bounds first."""
    if ("exists", "") in chain.at.facts:
        return
    first = {k: v for k, v in named.items() if k != "time"}
    if chain.attempt("decays", first):
        carries.existence(chain)


def outside(chain: Chain, what: What) -> bool:
    named = {k: chain.q(what[k]) for k in ("V", "radius", "rate")}
    named |= {"set": chain.q(what["radius"] - what["V"]), "beyond": chain.q(what["V"] - what["radius"])}
    if what["time"] is not None:
        named["time"] = chain.q(what["time"])
    if ("exists", "") not in chain.at.facts and chain.attempt("outside", named):
        carries.existence(chain)
    return chain.run("outside", named)


def keeps(chain: Chain, what: What) -> bool:
    names, table = chain.qs(what["g"]), {}
    if what["a"] is None:
        names = [g for g in names if not _keeps_sign(chain, g)]
    else:
        table = {"a": chain.q(what["a"])}
    met = [chain.run("keeps", {"g": g} | table) for g in names]
    return all(met)


def _keeps_sign(chain: Chain, g: str) -> bool:
    """Is the sign kept? What is assumed of it at the beginning without being strict is then kept as well,
    where that can be shown.
    """
    if not chain.attempt("keeps_sign", {"g": g}):
        return False
    if any(key in chain.at.keys(g) for key, _ in chain.at.initial):
        chain.attempt("keeps", {"g": g})
    return True


def holds(chain: Chain, what: What) -> bool:
    met = [chain.run("holds", {"e": e, "kind": what["kind"]}) for e in chain.qs(what["e"])]
    return all(met)


def part(chain: Chain, what: What) -> bool:
    term, total = chain.q(what["term"]), chain.q(what["of"])
    return chain.run("part", {"e": chain.q(what["of"] - what["term"]), "term": term, "total": total})


def exists(chain: Chain, what: What) -> bool:
    return carries.existence(chain) or chain.run("exists", {"edges": edges(chain, list(chain.at.edges()))})


def lyapunov(chain: Chain, what: What) -> bool:
    from symctrl.expr import Expr, lift
    from symctrl.rules.loop import scalars_at

    at = scalars_at(chain.loop.study, what["at"], "lyapunov")
    table: dict[str, Any] = {"V": chain.q(what["V"]), "at": {name: str(value) for name, value in at.items()}}
    if what["least"] is not None:
        table["least"] = chain.q(what["least"])
    if what["radius"] is not None:
        distance: Expr = lift(0)
        for name, numbers in what["at"].items():
            for entry, value in zip(_entries(chain, name), numbers, strict=True):
                distance = distance + (entry - value) ** 2
        table |= {"radius": chain.q(what["radius"]), "inside": chain.q(what["radius"] - distance)}
    if chain.attempt("lyapunov", table):
        return True
    if what["least"] is None:
        for least in carries.factors(chain):
            if chain.attempt("lyapunov", table | {"least": least}):
                return True
    return chain.run("lyapunov", table)


def _entries(chain: Chain, name: str) -> list[Any]:
    expr = chain.loop.study.symbols[name].expr
    return [expr] if expr.shape == (1, 1) else list(expr)
