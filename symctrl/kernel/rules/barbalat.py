"""What has a finite integral and a bounded rate tends to zero.

Soundness-critical. Last reviewed 2026-11-24.

Theorem. Let solutions exist for all time, e be locally Lipschitz, and W have a finite integral with
W >= a |e|^p for constants a > 0 and p >= 1 (or a times the sum over all nodes of a fleet of e^2). If the rate
of e is bounded, or has a finite integral itself (|e'| <= S with S summable), then e tends to zero.

Proof. |e|^p has a finite integral. With a bounded rate e is uniformly continuous; were |e| >= 2 c at times
without bound, |e|^p >= c^p on intervals of a fixed length around them, and the integral would be infinite.
With a rate of finite integral e has a limit, which must be zero.

Sources: Barbalat 1959; Khalil, Nonlinear Systems; Tao, IEEE Trans. Automatic Control 42(5), 1997.
"""

from __future__ import annotations

from symctrl.kernel.argument import Argument
from symctrl.kernel.compose import rate_listing
from symctrl.kernel.rules.roles import Roles

POWERS = {"1": "e", "2": "e e *", "p": "e abs p ^", "total": "T"}


def barbalat(at: Argument, of: Roles) -> None:
    """Roles: e, W, power (1, 2, p or total), p, total, least (a; 1 where it is left out), rate (S)."""
    e, W, least, rate = of.one("e"), of.one("W"), of.maybe("least"), of.maybe("rate")
    power = of.word("power", POWERS)
    at.need_existence()
    at.require_differentiable("e is differentiable", e)
    at.need("W is summable", "summable", W)
    roles = {"W": W, "e": e}
    if power == "p":
        roles["p"] = of.one("p")
        at.require_constant("p is constant", roles["p"])
        at.prove("p is at least one", "nonnegative", "p 1 -", p=roles["p"])
    if power == "total":
        roles["T"] = of.one("total")
        at.require_total(roles["T"], e)
        del roles["e"]
    bound = POWERS[power]
    if least is not None:
        at.require_constant("the factor is constant", least)
        at.prove("the factor is positive", "positive", "a", a=least)
        bound, roles = f"{bound} a *", roles | {"a": least}
    at.prove("W bounds the power of e", "nonnegative", f"W {bound} -", **roles)
    if power == "1":
        at.prove("W bounds minus e", "nonnegative", f"W {bound} +", **roles)
    if rate is None:
        at.require(
            "the rate of e is bounded", at.rate_is_bounded(e), f"the rate of {e} is not known to be bounded"
        )
    else:
        at.need("the bound of the rate is summable", "summable", rate)
        at.prove("S bounds the rate of e", "nonnegative", "S e' -", S=rate, e=e)
        at.prove("S bounds minus the rate of e", "nonnegative", "S e' +", S=rate, e=e)
    at.learn("tends", e)


def barbalat_rate(at: Argument, of: Roles) -> None:
    """The rate of what tends to zero does so too, where it is uniformly continuous.

    Theorem. Let solutions exist for all time and e tend to zero. If e' is continuous without a switch in it,
    and e'' is bounded, then e' tends to zero.

    Proof. The integral of e' converges and e' is uniformly continuous: Barbalat's lemma for e'.

    Source: as above. Role: e.
    """
    e = of.one("e")
    at.need_existence()
    at.need("e tends to zero", "tends", e)
    first = rate_listing(e, 1)
    at.require_differentiable("the rate of e has no switch", first)
    at.require(
        "the second rate is bounded",
        at.rate_is_bounded(e, 2),
        f"the second rate of {e} is not known to be bounded",
    )
    at.learn("tends", first)
