"""A function falls outside a set.

Soundness-critical. Last reviewed 2026-11-24.

Theorem. Let V be locally Lipschitz, r and d > 0 constants, and V' <= -d wherever V >= r, for all signals and
all values of the switches. Then V is bounded above, V <= r is never left, and is reached within (V(0) - r)/d.
If V >= 0 too, V is bounded.

Proof. Where V > r on an interval, V falls by at least d times its length there. From V = r it cannot rise.

Source: Khalil, Nonlinear Systems (ultimate boundedness).
"""

from __future__ import annotations

from symctrl.kernel.argument import OBLIGATION, Argument, Beside
from symctrl.kernel.rules.roles import Roles
from symctrl.kernel.values import Assumption


def outside(at: Argument, of: Roles) -> None:
    """Roles: V, radius (r), rate (d), set (r - V), beyond (V - r), time (a bound of (V(0) - r)/d)."""
    V, r, d, inside, beyond = (of.one(role) for role in ("V", "radius", "rate", "set", "beyond"))
    time = of.maybe("time")
    at.require_differentiable("V is differentiable", V)
    at.prove("V is not negative", "nonnegative", "V", V=V)
    for what, quantity in (("the radius", r), ("the rate", d)):
        at.require_constant(f"{what} is constant", quantity)
    at.prove("the rate is positive", "positive", "d", d=d)
    at.prove("the set is V <= r", "equal", ["s", "r V -"], s=inside, r=r, V=V)
    at.prove("beyond it V >= r", "equal", ["s", "V r -"], s=beyond, r=r, V=V)
    there = Assumption("nonnegative", ((beyond, 0),), text="V >= r", about=OBLIGATION)
    at.prove("V falls outside", "nonnegative", "V' neg d -", Beside((there,)), V=V, d=d)
    if time is not None:
        at.prove("the time is late enough", "nonnegative", "T d * V - r +", T=time, d=d, V=V, r=r)
    at.learn("bounded", V)
    at.learn_set("stays", False, [inside])
    if ("exists", "") in at.facts:
        at.learn_set("enters", False, [inside], time)
        at.learn_set("settles", False, [inside], time)
        at.learn_set("eventually", False, [inside])
