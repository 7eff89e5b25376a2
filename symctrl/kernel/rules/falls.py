"""A function falls along every solution.

Soundness-critical. Last reviewed 2026-11-24.

Theorem. Let V be locally Lipschitz with the rate V' along solutions, W_k >= 0, and w_j have finite integrals
of |w_j|. If V' <= w_1 + .. - W_1 - .. for all states of the domain, all signals and all values of the
switches, and V >= c for a constant c, then V is bounded and every W_k has a finite
integral. Without w, V never increases.

Proof. V(x(t)) is absolutely continuous, so V(t) <= V(0) + int |w| - int W; with V >= c the integral of W is
at most V(0) - c + int |w|, and V lies between c and V(0) + int |w|.

Source: integration of the chain rule; Shevitz and Paden, IEEE Trans. Automatic Control 39(9), 1994, for V
with kinks; Paden and Sastry, IEEE Trans. Circuits and Systems 34(1), 1987, for the field at a switch.
"""

from __future__ import annotations

from symctrl.kernel.argument import Argument
from symctrl.kernel.rules.roles import Roles


def falls(at: Argument, of: Roles) -> None:
    """Roles: V, by (the W), plus (the w), above (the constant c; 0 where it is left out)."""
    V, parts, inputs, above = of.one("V"), of.many("by"), of.many("plus"), of.maybe("above")
    at.require_differentiable("V is differentiable", V)
    for k, W in enumerate(parts, start=1):
        at.prove(f"part {k} is not negative", "nonnegative", "W", W=W)
    for k, w in enumerate(inputs, start=1):
        at.need(f"input {k} is summable", "summable", w)
    named = {f"w{k}": w for k, w in enumerate(inputs)} | {f"W{k}": W for k, W in enumerate(parts)}
    formula = (
        "V' neg"
        + "".join(f" w{k} +" for k in range(len(inputs)))
        + "".join(f" W{k} -" for k in range(len(parts)))
    )
    at.prove("V falls", "nonnegative", formula, V=V, **named)
    if above is None:
        at.prove("V is bounded below", "nonnegative", "V", V=V)
    else:
        at.require_constant("the lower bound is constant", above)
        at.prove("V is bounded below", "nonnegative", "V c -", V=V, c=above)
    at.learn("bounded", V)
    for W in parts:
        at.learn("summable", W)
    if not inputs:
        at.learn("nonincreasing", V)
