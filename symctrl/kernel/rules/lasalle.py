"""The invariance principle.

Soundness-critical. Last reviewed 2026-11-24.

Theorem. Let solutions exist for all time with every state bounded, the closed loop have no time and no signal
in it and a continuous right side, and V be differentiable and never increase along solutions. Let e = 0
wherever V' = 0, and let a limit g vanish wherever e, its rate, its second rate, .. vanish together. Then g
tends to zero.

Proof. V falls, so a solution stays in a compact set, exists for all time, and approaches its limit set, which
is weakly invariant and on which V is constant: through each of its points goes a solution in it along which
V' = 0, so that e and all its rates along it vanish. There g = 0.

Sources: LaSalle 1960; Khalil, Nonlinear Systems; Bacciotti and Ceragioli 1999 for the weakly invariant form,
which needs no uniqueness. The field divides by nothing that is not shown to be nonzero on the closed domain.
"""

from __future__ import annotations

from typing import Any

from symctrl.kernel.argument import OBLIGATION, Argument, Beside
from symctrl.kernel.certificate import Invalid, typed
from symctrl.kernel.compose import MAX_RATES, rate_listing
from symctrl.kernel.rules.roles import Roles
from symctrl.kernel.traits import SMOOTH
from symctrl.kernel.values import Assumption


def lasalle(at: Argument, of: Roles) -> None:
    """Roles: V, zero (e), limit (g), order {rates: how many rates of e are used}, implied.

    implied: quantities that are zero because they are combinations of e and its rates, by name the parts
    [factor, e, order of the rate], ..; they stand for the rates in the last obligations.
    """
    V, zeros, limits = of.one("V"), of.many("zero"), of.many("limit")
    order = of.numbers("order").get("rates", 0)
    if type(order) is not int or not 0 <= order < MAX_RATES:
        raise Invalid("lasalle: the order is a number of rates")
    at.need_existence()
    for state in at.statement.motion:
        at.require(f"{state} is bounded", at.state_is_bounded(state), "it is not known to be bounded")
    _autonomous(at)
    smooth = at.traits(V).level == SMOOTH and not at.traits(V).jumps
    at.require("V is differentiable", smooth, f"{V} has a kink or a jump")
    at.require("V never increases", at.has("nonincreasing", V), f"{V} is not known to fall")
    for g in (*zeros, *limits):
        signals = sorted(name for name in at.traits(g).reads if at.is_signal(name))
        at.require(f"{g} has no signal", not signals, f"it depends on {', '.join(signals)}")
    still = Assumption("zero", ((rate_listing(V, 1), 0),), text="V' = 0", about=OBLIGATION)
    for k, e in enumerate(zeros, start=1):
        at.prove(f"V' = 0 gives zero {k}", "equal", ["e", "0"], Beside((still,), closed=True), e=e)
    resting = _resting(at, of, zeros, order)
    for k, g in enumerate(limits, start=1):
        at.prove(
            f"limit {k} vanishes on the invariant set",
            "equal",
            ["g", "0"],
            Beside(tuple(resting), closed=True),
            g=g,
        )
    for g in limits:
        at.learn("tends", g)


def _autonomous(at: Argument) -> None:
    for state, rate in at.field().items():
        signals = sorted(name for name in rate.reads if at.is_signal(name))
        at.require(f"the rate of {state} has no signal", not signals, f"it depends on {', '.join(signals)}")
        at.require(f"the rate of {state} is continuous", not rate.jumps, "it jumps where a switch turns")


def _resting(at: Argument, of: Roles, zeros: list[str], order: int) -> list[Assumption]:
    """What vanishes on the limit set, as assumptions: e and its rates, or what is a combination of them."""
    rates = [rate_listing(e, k) for e in zeros for k in range(order + 1)]
    for rate in rates:
        traits = at.traits(rate)
        smooth = traits.level == SMOOTH or rate.count("'") == order
        at.require(f"{rate} is continuous", not traits.jumps and smooth, f"{rate} jumps or has a kink")
    implied = of.numbers("implied")
    found = []
    for name, parts in sorted(implied.items()):
        at.require("what is implied is a quantity", name in of.known, f"{name} is no quantity")
        _prove_implied(at, of, name, parts, zeros, order)
        found.append(name)
    kept = found + [
        rate for rate in rates if rate.rstrip("'") in zeros and (not implied or not rate.endswith("'"))
    ]
    return [Assumption("zero", ((name, 0),), text=f"{name} = 0", about=OBLIGATION) for name in kept]


def _prove_implied(at: Argument, of: Roles, name: str, parts: Any, zeros: list[str], order: int) -> None:
    roles, total = {"v": name}, "0"
    for k, part in enumerate(typed(parts, list, name)):
        factor, e, rate = typed(part, list, name)
        if factor not in of.known or e not in zeros or type(rate) is not int or not 0 <= rate <= order:
            raise Invalid(f"{name}: a part is a factor, a zero and the order of its rate")
        roles |= {f"c{k}": factor, f"z{k}": e}
        total += f" c{k} z{k}{chr(39) * rate} * +"
    at.prove(f"{name} is a combination of rates", "equal", ["v", total], **roles)
