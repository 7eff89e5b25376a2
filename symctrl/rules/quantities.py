"""Quantities of an argument: as expressions, summed over all nodes, and those of the theorem's claim."""

from __future__ import annotations

from symctrl.entries import component_names
from symctrl.expr import Expr, symbol
from symctrl.graph import Tape
from symctrl.kernel.argument import single
from symctrl.kernel.closure import Reach
from symctrl.kernel.compose import composed
from symctrl.problem import split
from symctrl.records import letters
from symctrl.rules.chain import Chain
from symctrl.rules.loop import tape_of
from symctrl.written import StudyError


def shown(chain: Chain, name: str) -> Expr:
    """The quantity as an expression; one that is a tape is a symbol alone."""
    known = chain.loop.quantities[name]
    if known is not None:
        return known
    (step,) = chain.at.statement.listings[name].code
    for declared in chain.loop.study.symbols.values():
        label = declared.expr.args[0].replace(".*", ".i")
        names = component_names(label, declared.expr.shape, declared.expr.args[2])
        if step.name in names:
            whole = symbol(label, declared.expr.shape, None, declared.expr.args[2])
            return whole if whole.shape == (1, 1) else list(whole)[names.index(step.name)]
    base, _, index = split(step.name)
    raise StudyError(f"{base}{index} is no symbol of {chain.loop.study.name}")


def claimed(chain: Chain, k: int) -> str:
    """Output k of the theorem's claim as a quantity."""
    return chain.q(tape_of(single(chain.loop.statement.listings["claim"], k)))


def formula(chain: Chain, text: str, **named: str) -> Tape:
    """A formula in postfix notation over quantities, as "a b +"."""
    return tape_of(composed(chain.at.statement.listings, [text], named))


def share_symbols(chain: Chain, V: str, name: str) -> bool:
    """Are these two quantities, and is there a symbol that both read?"""
    return name != V and bool(chain.at.traits(V).reads & chain.at.traits(name).reads)


def speaks_of_all(chain: Chain, name: str) -> bool:
    """Has the quantity a sum over all nodes in it?"""
    reach = Reach(chain.at.statement)
    reach.listing(name, "ij", 0, None)
    names = chain.at.statement.names
    return any(key in names and names[key].kind == "total" for key in reach.read)


def total_of(chain: Chain, name: str) -> str:
    """The sum over all nodes, and neighbours where it speaks of them, of the square of a quantity."""
    fleet = chain.loop.study.of_fleet
    assert fleet is not None
    e = shown(chain, name)
    square = e * e
    if "j" in letters(e):
        square = fleet.sum(fleet.neighbour, square)
    return chain.q(fleet.sum(fleet.node, square))
