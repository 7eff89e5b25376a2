"""A function decays at a rate, in finite time, or into a neighbourhood.

Soundness-critical. Last reviewed 2026-11-24.

Theorem. Let V >= 0 be locally Lipschitz with V' <= -a V - b rho^(1+gamma) + c + w for all states of the
domain, all signals and all values of the switches, with constants a > 0 or left out, b > 0 or left out, not
both left out, c >= 0, rho >= 0 with rho^2 = V, and 0 <= gamma < 1. Then V is bounded (where w has a finite
integral, tends to zero or is bounded, for a > 0). Without b, c, w: V(t) <= V(0) exp(-a t). With b, without c,
w: V is zero from the time T on, with T = 2 rho(0)^(1-gamma) / (b (1-gamma)) at most. With c, without w: for
every constant r with a r + b r^((1+gamma)/2) > c the set V <= r is reached and kept. If a > 0, without c: V
tends to zero where w tends to zero; and where w has a finite integral V has one too, and tends to zero.

Proof. Comparison with the solutions of v' = -a v - b v^((1+gamma)/2) + c. For b alone, rho^(1-gamma) falls at
the rate b (1-gamma)/2 at least, and a V makes it fall faster. At V = r the rate is negative, so r is not
exceeded again, and above r the rate is below a negative constant. For an input, V(t) <= V(0) exp(-a t) + the
convolution of |w| with exp(-a t).

Sources: comparison lemma, Khalil, Nonlinear Systems; Bhat and Bernstein, SIAM J. Control and Optimization
38(3), 2000, for finite time; Sontag for inputs.
"""

from __future__ import annotations

from symctrl.kernel.argument import OBLIGATION, Argument, Beside
from symctrl.kernel.rules.roles import Roles
from symctrl.kernel.values import Assumption


def decays(at: Argument, of: Roles) -> None:
    """Roles: V, a, b with gamma and rho, c, input, time (a bound of T), radius (r) with set (r - V)."""
    V, a, b, c, w = of.one("V"), of.maybe("a"), of.maybe("b"), of.maybe("c"), of.maybe("input")
    at.require(
        "a rate is given", a is not None or b is not None, "neither a linear nor a power rate is given"
    )
    at.require_differentiable("V is differentiable", V)
    at.prove("V is not negative", "nonnegative", "V", V=V)
    roles = {"V": V}
    formula = "V' neg"
    if a is not None:
        _positive_constant(at, "the rate", a)
        formula, roles = f"{formula} a V * -", roles | {"a": a}
    if b is not None:
        more = _power(at, of, V, b)
        formula, roles = f"{formula} b rho 1 g + ^ * -", roles | more
    if c is not None:
        at.require_constant("the offset is constant", c)
        at.prove("the offset is not negative", "nonnegative", "c", c=c)
        formula, roles = f"{formula} c +", roles | {"c": c}
    if w is not None:
        formula, roles = f"{formula} w +", roles | {"w": w}
    at.prove("V decays", "nonnegative", formula, **roles)
    if w is not None:
        _with_input(at, V, a, c, w)
        return
    at.learn("bounded", V)
    if c is not None:
        _into_set(at, of, V, roles)
        return
    at.learn("nonincreasing", V)
    _to_zero(at, of, V, roles)


def _power(at: Argument, of: Roles, V: str, b: str) -> dict[str, str]:
    gamma, rho = of.one("gamma"), of.one("rho")
    _positive_constant(at, "the rate of the power", b)
    at.require_constant("gamma is constant", gamma)
    at.prove("gamma is not negative", "nonnegative", "g", g=gamma)
    at.prove("gamma is below one", "positive", "1 g -", g=gamma)
    at.prove("rho is not negative", "nonnegative", "rho", rho=rho)
    at.prove("V is the square of rho", "equal", ["rho rho *", "V"], rho=rho, V=V)
    return {"b": b, "g": gamma, "rho": rho}


def _positive_constant(at: Argument, what: str, quantity: str) -> None:
    at.require_constant(f"{what} is constant", quantity)
    at.prove(f"{what} is positive", "positive", "a", a=quantity)


def _with_input(at: Argument, V: str, a: str | None, c: str | None, w: str) -> None:
    at.require("a linear rate", a is not None, "an input takes a linear rate a")
    kinds = [word for word in ("tends", "summable", "bounded") if at.has(word, w)]
    at.require(
        "the input is known",
        bool(kinds),
        "the input is not known to be bounded, to tend to zero or to be summable",
    )
    at.learn("bounded", V)
    if c is None and "summable" in kinds:
        at.learn("summable", V)
    if c is None and {"tends", "summable"} & set(kinds) and ("exists", "") in at.facts:
        at.learn("tends", V)


def _to_zero(at: Argument, of: Roles, V: str, roles: dict[str, str]) -> None:
    exists = ("exists", "") in at.facts
    if "a" in roles:
        for key in at.keys(V):
            at.facts.add(("exponentially", f"{key} {at.traits(roles['a']).key}"))
            at.facts.add(("exponentially", key))
        at.learn("summable", V)
    time = of.maybe("time")
    if exists:
        at.learn("tends", V)
    if "b" in roles and exists:
        if time is not None:
            late = "T b 1 g - * * 2 rho 1 g - ^ * -"
            # Where rho = 0 at the beginning, V is zero from the beginning, whatever T is.
            away = Assumption("positive", ((roles["rho"], 0),), text="rho > 0", about=OBLIGATION)
            given = {name: roles[name] for name in ("b", "g", "rho")}
            at.prove("the time is late enough", "nonnegative", late, Beside((away,)), T=time, **given)
        for word in ("settles", "enters", "eventually"):
            at.learn_set(word, True, [V], time)


def _into_set(at: Argument, of: Roles, V: str, roles: dict[str, str]) -> None:
    r, inside = of.maybe("radius"), of.maybe("set")
    if r is None or inside is None:
        return
    _positive_constant(at, "the radius", r)
    at.prove("the set is V <= r", "equal", ["s", "r V -"], s=inside, r=r, V=V)
    formula = (
        "c neg" + (" a r * +" if "a" in roles else "") + (" b r 1 g + 2 / ^ * +" if "b" in roles else "")
    )
    given = {k: v for k, v in roles.items() if k in ("a", "b", "c") or (k == "g" and "b" in roles)}
    at.prove("V falls at the radius", "positive", formula, r=r, **given)
    at.learn_set("stays", False, [inside])
    if ("exists", "") in at.facts:
        for word in ("settles", "enters", "eventually"):
            at.learn_set(word, False, [inside])
