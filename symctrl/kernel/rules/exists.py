"""Every solution exists for all time.

Soundness-critical. Last reviewed 2026-11-24.

Theorem. If on its maximal interval every state of a solution is bounded, or has a bounded rate, or has a
square below a differentiable V with V' <= b V for a constant b (as V = 1 + |x|^2 where the field grows at
most like a + c |x|), and everything that the field divides by or takes a root or logarithm of stays apart
from the edge of its domain, the solution exists for all time.

Proof. V(t) exp(-b t) does not increase, so that V(t) <= V(0) exp(b t) is bounded over a finite interval
(Gronwall), whatever the sign of b. On a finite maximal interval the states then stay in a compact set on
which the field is bounded, so that they have a limit there, and the solution goes on from it. An expression
that is not zero on the whole closed domain stays apart from zero on a compact part of it.

Sources: Khalil, Nonlinear Systems (continuation of solutions); Filippov, Differential Equations with
Discontinuous Righthand Sides, 1988, section 7.
"""

from __future__ import annotations

from symctrl.kernel.argument import Argument, Beside
from symctrl.kernel.certificate import per_node
from symctrl.kernel.rules.roles import Roles

PROVED_AS = {
    "nonzero": ("positive", "q q *"),
    "positive": ("positive", "q"),
    "nonnegative": ("nonnegative", "q"),
    "unit": ("nonnegative", "1 q q * -"),
}


def exists(at: Argument, of: Roles) -> None:
    """Roles: edges, the arguments whose sign is shown for all states of the closed domain; where states are
    not bounded V, rate (b) and grows, quantities that are each a state alone.
    """
    finite = _growing(at, of)
    shown = {at.traits(quantity).key: quantity for quantity in of.many("edges")}
    for state, rate in at.field().items():
        bounded = at.state_is_bounded(state) or rate.bounded or at.state_key(state) in finite
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


def _growing(at: Argument, of: Roles) -> set[str]:
    """The keys of the states whose squares are below a function that grows at most exponentially."""
    V, b, states = of.maybe("V"), of.maybe("rate"), of.many("grows")
    if V is None or b is None or not states:
        at.require("the growth is whole", V is b and not states, "V, rate and grows belong together")
        return set()
    at.require_constant("the rate of growth is constant", b)
    at.require_differentiable("V is differentiable", V)
    at.require("V is defined", at.edges_are_known(at.traits(V)), f"what {V} divides by may vanish")
    at.prove("V grows at most exponentially", "nonnegative", "b V * V' -", V=V, b=b)
    for k, x in enumerate(states, start=1):
        at.prove(f"the square of state {k} is below V", "nonnegative", "V x x * -", V=V, x=x)
    known = {at.state_key(state) for state in at.statement.motion if not per_node(state)}
    found = {at.traits(x).key for x in states}
    at.require("what grows is a state", found <= known, "a quantity that is no state of its own")
    return found
