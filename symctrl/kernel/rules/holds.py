"""What holds at every state is an assumption of the lines below.

Soundness-critical. Last reviewed 2026-11-24.

Theorems. What follows from the assumptions that are available holds along every solution. A term that is not
negative at any node is not above its sum over all nodes.

Proofs. A solution meets the assumptions at each of its times. The sum is the term and others that are not
negative.
"""

from __future__ import annotations

from symctrl.kernel.argument import LEMMA, Argument
from symctrl.kernel.rules.roles import Roles
from symctrl.kernel.values import Assumption

PROVED_AS = {
    "nonnegative": ("nonnegative", "e"),
    "positive": ("positive", "e"),
    "nonzero": ("positive", "e e *"),
    "zero": ("equal", ("e", "0")),
}


def holds(at: Argument, of: Roles) -> None:
    """Roles: e, kind."""
    e, kind = of.one("e"), of.word("kind", PROVED_AS)
    proved, formulas = PROVED_AS[kind]
    at.prove(f"e is {kind}", proved, formulas, e=e)
    _learn(at, kind, e)


def part(at: Argument, of: Roles) -> None:
    """Roles: term; total, its sum over all nodes; e, the rest."""
    e, term, total = of.one("e"), of.one("term"), of.one("total")
    fits = at.is_total_of(total, term)
    at.require("the total is that of the term", fits, f"{total} is not the sum over nodes of {term}")
    at.prove("the term is not negative", "nonnegative", "t", t=term)
    at.prove("e is the rest", "equal", ("e", "T t -"), e=e, T=total, t=term)
    _learn(at, "nonnegative", e)


def _learn(at: Argument, kind: str, e: str) -> None:
    at.available.append(Assumption(kind, ((e, 0),), text=f"{e} is {kind}", about=LEMMA))
