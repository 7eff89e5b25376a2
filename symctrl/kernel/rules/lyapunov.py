"""A point is stable in the sense of Lyapunov.

Soundness-critical. Last reviewed 2026-11-24.

Theorem. Let p be a point of the domain at which V is zero, and V locally Lipschitz with V >= a |x - p|^2 for
a constant a > 0, over all states, and V' <= 0 for all signals and all values of the switches, both wherever
|x - p|^2 <= r, for a constant r > 0 (or everywhere). Then p is stable.

Proof. V falls along a solution as long as it is in the ball; one that begins where V < a e, e <= r, does not
reach the sphere |x - p|^2 = e.

Source: Lyapunov 1892; Khalil, Nonlinear Systems.
"""

from __future__ import annotations

from fractions import Fraction

from symctrl.kernel.argument import OBLIGATION, Argument, Beside
from symctrl.kernel.certificate import rational
from symctrl.kernel.rules.roles import Roles
from symctrl.kernel.values import Assumption

POINT = "the point"


def lyapunov(at: Argument, of: Roles) -> None:
    """Roles: V, least (a; 1 where it is left out), at (numbers by state), radius (r) with inside (r - |x -
    p|^2).
    """
    V, least, inside, radius = of.one("V"), of.maybe("least"), of.maybe("inside"), of.maybe("radius")
    p = {name: rational(value, name) for name, value in of.numbers("at").items()}
    states = set(at.statement.motion)
    named = f"the point has {', '.join(sorted(p))}, the system {', '.join(sorted(states))}"
    at.require("every state is named", set(p) == states, named)
    if set(p) != states:
        return
    there = _at_the_point(at, p)
    at.require_differentiable("V is differentiable", V)
    at.prove("V is zero at the point", "equal", ["V", "0"], Beside(tuple(there)), V=V)
    _in_the_domain(at, there)
    parts = [_difference(state, p[state]) for state in sorted(p)]
    distance = "0" + "".join(f" {part} {part} * +" for part in parts)
    extra: list[Assumption] = []
    if inside is not None and radius is not None:
        at.require_constant("the radius is constant", radius)
        at.prove("the radius is positive", "positive", "r", r=radius)
        at.prove("inside is the ball", "equal", ["s", f"r {distance} -"], s=inside, r=radius)
        extra = [Assumption("nonnegative", ((inside, 0),), text="in the ball", about=OBLIGATION)]
    formula, roles = f"V {distance} -", {"V": V}
    if least is not None:
        at.require_constant("the factor is constant", least)
        at.prove("the factor is positive", "positive", "a", a=least)
        formula, roles = f"V {distance} a * -", roles | {"a": least}
    at.prove("V grows with the distance", "nonnegative", formula, Beside(tuple(extra)), **roles)
    at.prove("V does not rise", "nonnegative", "V' neg", Beside(tuple(extra)), V=V)
    at.facts.add(("stable", point_key(p)))


def _difference(state: str, value: Fraction) -> str:
    return f"@{state} {abs(value)} {'-' if value >= 0 else '+'}"


def _at_the_point(at: Argument, p: dict[str, Fraction]) -> list[Assumption]:
    at.mint(POINT, [_difference(state, p[state]) for state in sorted(p)])
    return [
        Assumption("zero", ((POINT, k),), text=f"{state} = {p[state]}", about=OBLIGATION)
        for k, state in enumerate(sorted(p))
    ]


def _in_the_domain(at: Argument, there: list[Assumption]) -> None:
    for k, assumption in enumerate(at.available):
        if len(assumption.of) != 1 or not at.reads_states(assumption):
            continue
        quantity = at.mint_single(f"{POINT}, assumption {k + 1}", assumption.of[0])
        kind, formulas = {
            "zero": ("equal", ["g", "0"]),
            "nonzero": ("positive", ["g g *"]),
            "positive": ("positive", ["g"]),
            "nonnegative": ("nonnegative", ["g"]),
        }[assumption.kind]
        others = [a for a in at.available if a is not assumption and not at.reads_states(a)]
        at.prove(
            f"the point meets {assumption.text}",
            kind,
            formulas,
            Beside(tuple(there), only=tuple(others)),
            g=quantity,
        )


def point_key(p: dict[str, Fraction]) -> str:
    return " ".join(f"{name}={p[name]}" for name in sorted(p))
