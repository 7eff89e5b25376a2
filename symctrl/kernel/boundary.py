"""A state of a set from which every solution leaves it at once.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: let g be smooth and g = 0 at a state, and g' < 0 there for every value in {-1, 1} of the switches
that are at their jumps, the rate of g being affine in them. Then g < 0 soon after along every solution.

Proof. All of Filippov's values of the field are convex combinations of those for these values of the
switches, so that g' < 0 for all; his set is compact and upper semicontinuous, so that g' is below a negative
number near the state (Filippov, Differential Equations with Discontinuous Righthand Sides, 1988, section 7).
A signal is chosen constant: one that is admissible is enough.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from itertools import product
from typing import Any

from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.place import (
    NotContradicted,
    Place,
    Site,
    require_momentary,
    require_no_jump,
    sign_of,
)
from symctrl.kernel.spots import Spot
from symctrl.kernel.traits import NOT_AFFINE, SMOOTH
from symctrl.kernel.values import Sentence, Statement

MAX_SWITCHES = 8


def leaves(
    statement: Statement, sentence: Sentence, place: Place, table: Mapping[str, Any], bits: int
) -> None:
    """A state of a set from which every solution leaves it at once."""
    if sentence.word != "stays":
        raise NotContradicted(
            f"a state from which a set is left does not contradict the conclusion {sentence.word}"
        )
    require_momentary(statement)
    site = Site(statement, place, bits)
    site.rates()
    site.require_given()
    site.require_supposed()
    boundary: list[tuple[int, dict[str, str]]] = []
    for k in sentence.of:
        for binding, spot in zip(site.bindings(), site.outputs(k), strict=True):
            require_no_jump([spot], "the set")
            sign = sign_of(spot, "what the set is about")
            if sign < 0 or (sentence.zero and sign):
                raise Invalid("the values are not in the set that is to be left")
            if sign == 0:
                boundary.append((k, binding))
    reasons = [_kept(site, sentence, k, binding) for k, binding in boundary]
    if all(reasons):
        why = reasons[0] if reasons else "this is no point of its boundary"
        raise Invalid(f"the set is not left here: {why}")


def _kept(site: Site, sentence: Sentence, k: int, binding: dict[str, str]) -> str:
    """Why this boundary may not be crossed, or nothing where every solution crosses it."""
    g, rate = _boundary(site, sentence, k, binding)
    if rate is None:
        return "a function of its boundary does not move"
    if g.traits.level != SMOOTH or g.traits.jumps or rate.traits.degree >= NOT_AFFINE:
        raise Declined("the set has a kink here, or the rate of its boundary is not affine in switches")
    keys = site.active({"": rate})
    if len(keys) > MAX_SWITCHES:
        raise Declined(f"more than {MAX_SWITCHES} switches are at their jumps")
    signs = set()
    for corner in product((Fraction(-1), Fraction(1)), repeat=len(keys)):
        turned_so = dict(zip(keys, corner, strict=True))
        there = Site(site.statement, site.place, site.domain.real.bits, (), turned_so)
        _, turned = _boundary(there, sentence, k, binding)
        signs.add(0 if turned is None else sign_of(turned, "the rate of a function of the set"))
    if signs == {-1} or (sentence.zero and signs == {1}):
        return ""
    many = " for one value of the switches" if keys else ""
    return f"the rate of a function of its boundary has the sign {sorted(signs)[-1]}{many}"


def _boundary(site: Site, sentence: Sentence, k: int, binding: dict[str, str]) -> tuple[Spot, Spot | None]:
    ref = (site.statement.claim.listing, k)
    g, rate = site.value(ref, binding, 1)
    return g, rate
