"""A refutation of a theorem: one solution that meets what is given and contradicts one conclusion.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: a theorem is a claim about all parameters, signals, graphs and solutions that meet what is given, and
about each of its conclusions and that solutions exist for all time, which every theorem concludes. It is
false where one of them meets all that is given and contradicts one of these.

at: where all rates are zero the constant function is a solution. Where a switch is at its jump, the field
is f + s g + .. for its active switches s, f and g continuous; if the gradients of their arguments, by states
that no assumed equation speaks of, are independent, all combinations of signs occur near the point, each
on an open set, so that for any s in [-1, 1] the value is one of Filippov's (Differential Equations with
Discontinuous Righthand Sides, 1988, section 4).
undefined: a solution needs a field that has a value where it begins.
leaves, unstable, along and enclosed: `boundary`, `instability`, `trajectory`, `enclosed`.

Proof fields: `how`; `then`, the conclusion from 0, or "exists"; and by `how`:
at {values, graph, switches}, leaves and undefined {values, graph}, unstable {values}: numbers of all free
scalars, `graph` for fleets alone as in `witness`; `switches`, the values of the active switches in the order
in which the rates meet them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

from symctrl.kernel.boundary import leaves
from symctrl.kernel.certificate import Declined, Invalid, fields, natural, rational, several
from symctrl.kernel.closure import rates_exist_where_defined
from symctrl.kernel.enclosed import enclosed
from symctrl.kernel.instability import rank, unstable
from symctrl.kernel.interval import Undecided, Undefined
from symctrl.kernel.place import (
    SETS,
    NotContradicted,
    Place,
    Site,
    is_fleet,
    read_place,
    reads,
    require_momentary,
    require_no_jump,
    sign_of,
    states,
)
from symctrl.kernel.spots import Spot
from symctrl.kernel.traits import NOT_AFFINE, SMOOTH
from symctrl.kernel.trajectory import along
from symctrl.kernel.values import Condition, Sentence, Statement
from symctrl.kernel.witness import BITS

EXISTS = Sentence("exists", ())
OWN = {
    "at": ("values", "switches"),
    "leaves": ("values",),
    "undefined": ("values",),
    "unstable": ("values",),
    "along": ("time", "listings", "functions", "until", "numbers", "proofs"),
    "enclosed": ("values", "tube"),
}


def needed_conditions(statement: Statement, proof: dict[str, Any]) -> set[Condition]:
    """None, where the theorem is refuted. Raises Invalid where it is not, Declined where that is open."""
    if statement.claim.kind != "theorem":
        raise Invalid(f"a counterexample to a theorem does not refute the claim {statement.claim.kind}")
    if statement.conditions:
        raise Invalid("a refutation has no conditions, for the kernel could not check that they hold")
    how = proof.get("how")
    if type(how) is not str or how not in OWN:
        raise Declined(f"a counterexample of the kind {str(how)[:40]!r} is not known")
    graph = ("graph",) if "values" in OWN[how] and is_fleet(statement) else ()
    table = fields(proof, ("kind", "how", "then", *OWN[how], *graph), "proof")
    sentence = _sentence(statement, table["then"])
    if how == "along":
        along(statement, sentence, table)
    else:
        place = read_place(statement, table)
        _with_bits(lambda bits: POINTS[how](statement, sentence, place, table, bits))
    return set()


def _sentence(statement: Statement, then: Any) -> Sentence:
    """The conclusion that is contradicted."""
    if then == "exists" and type(then) is str:
        return EXISTS
    return statement.claim.then[natural(then, len(statement.claim.then), "then")]


def _with_bits(work: Callable[[int], None]) -> None:
    reason = ""
    for bits in BITS:
        try:
            return work(bits)
        except Undecided as undecided:
            reason = str(undecided)
    raise Declined(f"the counterexample is not decided with {BITS[-1]} bits: {reason}")


def at(statement: Statement, sentence: Sentence, place: Place, table: Mapping[str, Any], bits: int) -> None:
    """A rest point."""
    site = resting(statement, place, table["switches"], bits)
    site.require_given()
    site.require_supposed()
    require_contradicted(site, sentence)


def resting(statement: Statement, place: Place, values: Any, bits: int) -> Site:
    """The closed loop at a rest point, with these values of the active switches. Raises Invalid."""
    site = Site(statement, place, bits)
    jumping = site.active(site.rates())
    given = [rational(x, "a switch") for x in several(values, len(jumping), "switches")]
    if any(abs(x) > 1 for x in given):
        raise Invalid("a switch has a value from -1 to 1")
    if jumping:
        directions = _free_states(statement, place)
        site = Site(statement, place, bits, directions, dict(zip(jumping, given, strict=True)))
    rates = site.rates()
    for name, rate in rates.items():
        if sign_of(rate, f"the rate of {name}"):
            raise Invalid(f"this is no rest point: the rate of {name} is {_shown(rate)}")
    if jumping:
        _require_all_values(site, rates, jumping)
    return site


def _free_states(statement: Statement, place: Place) -> list[str]:
    """The states, at their nodes, of which no assumed equation speaks."""
    bound = {key for a in statement.given if a.kind == "zero" for key in reads(statement, a.of)}
    return [name for key, name, _ in states(statement, place.graph) if key not in bound]


def _require_all_values(site: Site, rates: Mapping[str, Spot], jumping: list[str]) -> None:
    """Every value in [-1, 1] of every active switch must belong to a value of the field."""
    for name, rate in rates.items():
        if rate.traits.degree >= NOT_AFFINE:
            raise Declined(f"a switch is at its jump, and the rate of {name} is not affine in switches")
    if site.domain.at_edge:
        raise Declined("a switch is at its jump, and a root or logarithm at the edge of its domain")
    rows: list[list[Fraction]] = []
    for key in jumping:
        argument = site.domain.active[key]
        row = argument.gradient()
        if row is None or argument.traits.level != SMOOTH or argument.traits.jumps:
            raise Declined("a switch is at its jump, and the gradient of its argument is not known exactly")
        rows.append(row)
    if rank(rows) < len(rows):
        raise Declined("the gradients of the arguments of switches that are at their jumps are dependent")


def require_contradicted(site: Site, sentence: Sentence) -> None:
    """Does the constant solution contradict the conclusion? Raises Invalid where it does not."""
    word, outputs = sentence.word, [spot for k in sentence.of for spot in site.outputs(k)]
    by = site.outputs(sentence.by) if sentence.by is not None else None
    require_no_jump([*outputs, *(by or [])], word)
    signs = [sign_of(spot, "what the conclusion is about") for spot in outputs]
    if word in ("exists", "stays", "stable") or (word == "bounded" and by is None):
        fails = False
    elif word == "bounded":
        fails = _exceeds(site, outputs, by or [])
    elif word == "exponentially" and by is not None:
        fails = any(signs) and all(sign_of(rate, "the rate of decay") > 0 for rate in by)
    elif word == "apart":
        fails = 0 in signs
    elif word in SETS:
        fails = any(signs) if sentence.zero else -1 in signs
    else:
        fails = any(signs)
    if not fails:
        raise NotContradicted(f"a constant solution at the values does not contradict the conclusion {word}")


def _exceeds(site: Site, outputs: list[Spot], by: list[Spot]) -> bool:
    """Is one of them larger in magnitude than its bound?"""
    domain = site.domain
    bounds = by * (len(outputs) // len(by))
    gaps = [
        domain.real.sub(bound.number, domain.real.fabs_(e.number))
        for e, bound in zip(outputs, bounds, strict=True)
    ]
    if any(gap.hi < 0 for gap in gaps):
        return True
    if all(gap.lo >= 0 for gap in gaps):
        return False
    raise Undecided("whether the bound is exceeded")


def undefined(
    statement: Statement, sentence: Sentence, place: Place, table: Mapping[str, Any], bits: int
) -> None:
    """A state of the domain at which the field has no value."""
    if sentence.word != "exists":
        raise NotContradicted(
            f"that the field has no value does not contradict the conclusion {sentence.word}"
        )
    require_momentary(statement)
    if statement.uses:
        raise Declined("a formula that a proved statement replaced may have had a value")
    if not rates_exist_where_defined(statement, statement.claim.law):
        raise Declined("the field reads rates, which may have a value where their formula has none")
    site = Site(statement, place, bits)
    site.require_given()
    site.require_supposed()
    if not any(_has_no_value(site, key, binding) for key, _, binding in states(statement, place.graph)):
        raise Invalid("the field has a value here")


def _has_no_value(site: Site, key: str, binding: dict[str, str]) -> bool:
    """Does the rate of this state have none?"""
    there = Site(site.statement, site.place, site.domain.real.bits)
    try:
        there.value(site.statement.motion[key], binding)
    except Undefined:
        if there.domain.active:
            raise Declined("a switch is at its jump") from None
        return True
    return False


def _shown(spot: Spot) -> str:
    a = spot.number
    return str(a.lo)[:60] if a.thin else f"between {float(a.lo):.6g} and {float(a.hi):.6g}"


POINTS: Mapping[str, Callable[[Statement, Sentence, Place, Mapping[str, Any], int], None]] = {
    "at": at,
    "leaves": leaves,
    "undefined": undefined,
    "unstable": unstable,
    "enclosed": enclosed,
}
