"""Counterexamples to a theorem: what is offered becomes a certificate, or a reason why it is none."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from symctrl.certify import certificate
from symctrl.counterexample import Counterexample
from symctrl.facts import Fact
from symctrl.kernel import against as kernel
from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.check import check_text
from symctrl.kernel.form import read_statement
from symctrl.kernel.instability import reduced
from symctrl.kernel.place import NotContradicted, Place, Site, read_place
from symctrl.kernel.values import Statement
from symctrl.rules.loop import Loop
from symctrl.rules.offered import NoCounterexample, values_of

if TYPE_CHECKING:
    pass

Table = dict[str, Any]
EXISTS = "exists"
BITS = 256
SHOWN = 12  # values in a sentence


@dataclass(frozen=True)
class Refuted:
    """A counterexample that the kernel accepts. says: one sentence. witness: what a row shows."""

    certificate: Table
    says: str
    witness: Table


@dataclass
class Offer:
    """A counterexample to be made a certificate. against: the conclusions to be tried, in this order."""

    loop: Loop
    counterexample: Counterexample
    against: Sequence[int | str]
    statement: Statement = field(init=False)
    values: dict[str, Any] = field(init=False)

    def __post_init__(self) -> None:
        self.statement = read_statement(json.loads(json.dumps(self.loop.problem.statement())))
        self.values = values_of(self.loop.study, self.statement, self.counterexample)

    def sentence(self, then: int | str) -> str:
        """A conclusion in words."""
        if isinstance(then, int):
            return self.loop.theorem.then[then].text()
        return "every solution exists for all time"

    def numbers(self) -> dict[str, Fraction]:
        """The values, which must be numbers. Raises NoCounterexample."""
        for name, value in self.values.items():
            if not isinstance(value, Fraction):
                raise NoCounterexample(f"the value of {name} is not an exact number")
        return self.values

    def shown(self) -> str:
        """The values that were offered, in their order."""
        offered = self.counterexample.values
        chosen = [n for key in offered for n in self.values if key in (n, n.partition("[")[0])]
        parts = [f"{name} = {self.values[name]}" for name in chosen or self.values]
        return ", ".join(parts[:SHOWN]) + (", .." if len(parts) > SHOWN else "")

    def made(self, proof: Table, says: str, witness: Table) -> Refuted:
        """The certificate. Raises NoCounterexample where the kernel does not accept it."""
        stated = json.loads(json.dumps(self.loop.problem.statement()))
        whole = certificate(stated, json.loads(json.dumps(proof)))
        answer = check_text(json.dumps(whole))
        if answer.status != "valid":
            raise NoCounterexample(answer.reason)
        return Refuted(whole, says, witness)


def contradict(loop: Loop, counterexample: Counterexample, against: Fact | None) -> Refuted | str:
    """The certificate of a counterexample to a conclusion (to any, if none is named), or why it is none."""
    try:
        offer = Offer(loop, counterexample, _conclusions(loop, against))
        return MAKERS[counterexample.kind](offer)
    except (NoCounterexample, Invalid, Declined) as error:
        return " ".join(str(error).split())


def _conclusions(loop: Loop, against: Fact | None) -> list[int | str]:
    then = loop.theorem.then
    if against is None:
        return [*range(len(then)), EXISTS]
    found = [k for k, fact in enumerate(then) if fact is against or fact.text() == against.text()]
    if not found and against.word == EXISTS:
        return [EXISTS]
    if not found:
        known = ", ".join(fact.text() for fact in then)
        raise NoCounterexample(f"the theorem does not conclude that {against.text()}, but that {known}")
    return list(found)


def tried(offer: Offer, work: Callable[[int | str], Refuted]) -> Refuted:
    """The first conclusion that is contradicted. Raises what says most about why none is."""
    kept, reason = [], None
    for then in offer.against:
        try:
            return work(then)
        except NotContradicted as error:
            kept.append(str(error))
        except (NoCounterexample, Invalid, Declined) as error:
            reason = reason or error
    if reason is not None:
        raise reason
    if len(kept) == 1:
        raise NoCounterexample(kept[0])
    raise NoCounterexample("it contradicts no conclusion of the theorem")


# Counterexamples at a point.


def _at(offer: Offer) -> Refuted:
    said = "every rate is zero, so that it is not true that"
    return tried(offer, lambda then: _point(offer, then, said, {"switches": _switches(offer)}))


def _leaves(offer: Offer) -> Refuted:
    said = "the boundary is crossed outwards, so that it is not true that"
    return tried(offer, lambda then: _point(offer, then, said, {}))


def _undefined(offer: Offer) -> Refuted:
    said = "the closed loop has no value, so that it is not true that"
    return tried(offer, lambda then: _point(offer, then, said, {}))


def _unstable(offer: Offer) -> Refuted:
    said = "the linear part has an eigenvalue with a positive real part, so that it is not true that"
    return tried(offer, lambda then: _point(offer, then, said, {}))


def _enclosed(offer: Offer) -> Refuted:
    from symctrl.domains.domain import Unsupported
    from symctrl.trajectories import NotEnclosed, enclose

    until = offer.counterexample.until
    if until is None or until.value is None or until.value <= 0:
        raise NoCounterexample("the time up to which the solution is enclosed is a positive number")
    values = offer.numbers()
    try:
        tube = enclose(offer.loop.problem, offer.loop.law, values, until.value)
    except (NotEnclosed, Unsupported, ValueError) as error:
        raise NoCounterexample(str(error)) from None
    said = f"at t = 0 a solution begins that is enclosed up to t = {until.value}, so that it is not true that"
    return tried(offer, lambda then: _point(offer, then, said, {"tube": tube.as_json()}))


def _point(offer: Offer, then: int | str, said: str, more: Table) -> Refuted:
    """A counterexample by numbers against one conclusion. Raises what the kernel raises."""
    written = {name: str(value) for name, value in offer.numbers().items()}
    edges = [list(edge) for edge in offer.counterexample.graph]
    graph = {"graph": edges} if edges else {}
    proof = {
        "kind": "against",
        "how": offer.counterexample.kind,
        "then": then,
        "values": written,
        **graph,
        **more,
    }
    kernel.needed_conditions(offer.statement, json.loads(json.dumps(proof)))
    where = f"at {offer.shown()}" + (f" on {_graph_text(edges)}" if edges else "")
    switches = ", ".join(more.get("switches", []))
    turned = f" with {switches} for the values of the switches at their jumps" if switches else ""
    says = f"{where} {said} {offer.sentence(then)}"
    return offer.made(proof, says.replace(" every rate", f"{turned} every rate"), written | graph)


def _graph_text(edges: Sequence[Sequence[str]]) -> str:
    return "the graph with the edges " + ", ".join("-".join(edge) for edge in edges)


def _switches(offer: Offer) -> list[str]:
    """Values of the switches at their jumps with which all rates are zero, if there are any."""
    written = {name: str(value) for name, value in offer.numbers().items()}
    graph = [list(edge) for edge in offer.counterexample.graph]
    place = read_place(offer.statement, {"values": written, "graph": graph})
    site = Site(offer.statement, place, BITS)
    keys = site.active(site.rates())
    if not keys:
        return []
    rates = _rates(offer.statement, place, {})
    if rates is None:
        return ["0"] * len(keys)
    columns = [_rates(offer.statement, place, {key: Fraction(1)}) for key in keys]
    rows = [
        [*(column[k] - rate for column in columns if column is not None), -rate]
        for k, rate in enumerate(rates)
    ]
    done, pivots = reduced(rows)
    if len(keys) in pivots or None in columns:
        return ["0"] * len(keys)
    found = [Fraction(0)] * len(keys)
    for row, pivot in zip(done, pivots, strict=True):
        found[pivot] = row[-1]
    return [str(x) if abs(x) <= 1 else "0" for x in found]


def _rates(statement: Statement, place: Place, switches: Mapping[str, Fraction]) -> list[Fraction] | None:
    """Exact rates with these values of the switches at their jumps, 0 for others; None if not exact."""
    spots = list(Site(statement, place, BITS, (), switches).rates().values())
    return [s.number.lo for s in spots] if all(s.number.thin for s in spots) else None


def _along(offer: Offer) -> Refuted:
    from symctrl.rules.along import along

    return along(offer)


MAKERS: Mapping[str, Callable[[Offer], Refuted]] = {
    "at": _at,
    "along": _along,
    "leaves": _leaves,
    "undefined": _undefined,
    "unstable": _unstable,
    "enclosed": _enclosed,
}
