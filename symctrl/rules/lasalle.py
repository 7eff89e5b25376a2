"""The invariance principle: how many rates it takes, and combinations of them without denominators."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from symctrl.graph import Tape
from symctrl.kernel.compose import composed
from symctrl.rules import carries
from symctrl.rules.algebra import Algebra, algebra
from symctrl.rules.chain import Chain
from symctrl.rules.combination import Found, search
from symctrl.rules.loop import tape_of

What = Mapping[str, Any]
MAX_ORDER = 4
MAX_TERMS = 120  # of e and its rates as polynomials, for the ideal that they generate to be completed


def lasalle(chain: Chain, what: What) -> bool:
    V, zeros, limits = chain.q(what["V"]), chain.qs(what["zero"]), chain.qs(what["limit"])
    if not chain.at.has("nonincreasing", V) and not chain.run("falls", {"V": V, "by": [], "plus": []}):
        return False
    carries.existence(chain)
    table: dict[str, Any] = {"V": V, "zero": zeros, "limit": limits}
    if not chain.attempt("lasalle", table | {"limit": []}):
        return chain.run("lasalle", table | {"limit": []})
    for order in range(MAX_ORDER + 1):
        for more in _ways(chain, what, zeros, limits, order):
            if chain.attempt("lasalle", table | more):
                return True
    return chain.run("lasalle", table | {"order": {"rates": 1}})


def _ways(
    chain: Chain, what: What, zeros: Sequence[str], limits: Sequence[str], order: int
) -> list[dict[str, Any]]:
    """With multiples of the limits that are combinations of e and its rates, or with the rates themselves."""
    ways: list[dict[str, Any]] = []
    sources = _sources(chain, what["zero"], zeros, order)
    names = [*limits, *(name for name in sources if name not in limits)]
    known = list(sources)
    found = (
        algebra(chain, names + [n for n in known if n in limits], lambda a: _search(a, limits, known, names))
        or {}
    )
    implied = {}
    for name, way in found.items():
        multiple = chain.q(_product(chain, name, way))
        implied[multiple] = [
            [chain.q(tape), *sources[part]] for part, tape in zip(way.parts, way.factors, strict=True)
        ]
    if implied:
        ways.append({"order": {"rates": order}, "implied": implied})
    size = algebra(chain, known, lambda a: sum(len(p) for v in a.values for p in v.values())) or 0
    return ways + ([{"order": {"rates": order}}] if size <= MAX_TERMS else [])


def _search(
    found: Algebra, limits: Sequence[str], known: Sequence[str], names: Sequence[str]
) -> dict[str, Found]:
    values = dict(zip(names, found.values, strict=False))
    unknown = [name for name in limits if name not in known]
    ordered = Algebra(found.session, [values[n] for n in [*unknown, *known]], found.scalars)
    return search(ordered, unknown, list(known))


def _sources(
    chain: Chain, exprs: Sequence[Any], zeros: Sequence[str], order: int
) -> dict[str, tuple[str, int]]:
    """e and its rates as quantities, each with the zero and the order that it is."""
    sources: dict[str, tuple[str, int]] = {}
    for expr, zero in zip(exprs, zeros, strict=True):
        current = expr
        for k in range(order + 1):
            sources.setdefault(chain.q(current), (zero, k))
            current = chain.loop.rate(current)
    return sources


def _product(chain: Chain, name: str, way: Found) -> Tape:
    """The limit times the divisor of its combination."""
    if way.divisor is None:
        return tape_of(chain.at.statement.listings[name])
    divisor = chain.q(way.divisor)
    return tape_of(composed(chain.at.statement.listings, ["g d *"], {"g": name, "d": divisor}))
