"""A set is never left.

Soundness-critical. Last reviewed 2026-11-24.

Theorem. Let g be locally Lipschitz with g' >= -a g for all states of the domain, all signals and all values
of the switches, with a continuous in the state. A solution with g >= 0 (g > 0) at the beginning has g >= 0 (g
> 0) for all its time.

Proof. g(t) exp(int a) does not decrease; a is integrable over every closed interval of the solution's time,
for it is continuous along the solution.

Theorem (`keeps_sign`). Let g be continuous, and not zero at any state of the domain at which the field has a
value. A solution with g > 0 at the beginning has g > 0 for all its time.

Proof. The field has a value all along a solution, so that g is not zero there: intermediate values.

Source: comparison; Nagumo's theorem in the form of Blanchini, Automatica 35(11), 1999.
"""

from __future__ import annotations

from symctrl.kernel.argument import Argument
from symctrl.kernel.rules.roles import Roles


def keeps(at: Argument, of: Roles) -> None:
    """Roles: g, a (0 where it is left out)."""
    g, a = of.one("g"), of.maybe("a")
    at.require_differentiable("g is differentiable", g)
    if a is None:
        at.prove("g is kept", "nonnegative", "g'", g=g)
    else:
        traits = at.traits(a)
        at.require("a is continuous", not traits.jumps, f"{a} jumps")
        signals = [name for name in traits.reads if at.is_signal(name)]
        at.require("a has no signal", not signals, f"{a} depends on a signal")
        at.prove("g is kept", "nonnegative", "g' a g * +", g=g, a=a)
    at.learn_set("stays", False, [g])
    _now_at_all_times(at, g)


def keeps_sign(at: Argument, of: Roles) -> None:
    """Roles: g."""
    g = of.one("g")
    at.require("g is continuous", not at.traits(g).jumps, f"{g} jumps")
    at.require("g is defined", at.edges_are_known(at.traits(g)), f"what {g} divides by may vanish")
    at.prove("g is not zero where the field has a value", "positive", "g g *", g=g)
    at.learn_set("stays", False, [g])
    _now_at_all_times(at, g, "positive")


def _now_at_all_times(at: Argument, g: str, *kinds: str) -> None:
    """What is assumed of g at the beginning (of these kinds, if any) is available."""
    keys = at.keys(g)
    kept = [a for key, a in at.initial if key in keys and (not kinds or a.kind in kinds)]
    at.available += kept
    at.initial = [(key, a) for key, a in at.initial if a not in kept]
