"""Every solution exists for all time.

Soundness-critical. Last reviewed 2026-11-24.

Theorem. If on its maximal interval every state of a solution is bounded, or has a bounded rate, and
everything that the field divides by or takes a root or logarithm of stays apart from the edge of its domain,
the solution exists for all time.

Proof. On a finite maximal interval the states then stay in a compact set on which the field is bounded, so
that they have a limit there, and the solution goes on from it. An expression that is not zero on the whole
closed domain stays apart from zero on a compact part of it.

Sources: Khalil, Nonlinear Systems (continuation of solutions); Filippov, Differential Equations with
Discontinuous Righthand Sides, 1988, section 7.
"""

from __future__ import annotations

from symctrl.kernel.argument import Argument, Beside
from symctrl.kernel.rules.roles import Roles

PROVED_AS = {
    "nonzero": ("positive", "q q *"),
    "positive": ("positive", "q"),
    "nonnegative": ("nonnegative", "q"),
    "unit": ("nonnegative", "1 q q * -"),
}


def exists(at: Argument, of: Roles) -> None:
    """Roles: edges, the arguments whose sign is shown for all states of the closed domain."""
    shown = {at.traits(quantity).key: quantity for quantity in of.many("edges")}
    for state, rate in at.field().items():
        bounded = at.state_is_bounded(state) or rate.bounded
        at.require(f"{state} stays finite", bounded, f"neither {state} nor its rate is known to be bounded")
    named: set[str] = set()
    for edge, traits in at.edges().items():
        kind, _, key = edge.partition(" ")
        if at.edge_is_known(kind, key):
            continue
        quantity = shown.get(key)
        reads = ", ".join(sorted(traits.reads))
        missing = f"what must be {kind} for the field to be defined is not shown to stay so ({reads})"
        at.require("the field stays defined", quantity is not None, missing)
        if quantity is not None:
            named.add(key)
            proved, formula = PROVED_AS[kind]
            at.prove(f"{quantity} is {kind}", proved, formula, Beside(closed=True), q=quantity)
            at.learn_edge(kind, key)
    at.require(
        "no edge is named in vain", named == set(shown), "a quantity is named that the field does not need"
    )
    at.facts.add(("exists", ""))
