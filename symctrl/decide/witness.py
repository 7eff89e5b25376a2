"""Refutation: an exact point at which a claim fails, found by trying admissible points.

Where a value is rational it is compared exactly; where it is not (a sine, an exponential), by rigorous
enclosures."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from typing import Any

from symctrl.decide.place import Place, evaluation, is_fleet
from symctrl.decide.points import points
from symctrl.domains.domain import Unsupported
from symctrl.domains.fraction import FractionDomain, NoExactValue
from symctrl.domains.interval import IntervalDomain, bounds
from symctrl.problem import Problem, split

TRIES = 60
BITS = 256


@dataclass(frozen=True)
class Witness:
    """The place, the entry that fails (from 0) or the vector x, and the failing side in words."""

    place: Place
    at: int
    x: tuple[Fraction, ...] | None
    says: str

    def values_json(self, problem: Problem) -> dict[str, Any]:
        """What a row's `witness` shows."""
        shown: dict[str, Any] = {name: str(value) for name, value in self.place.values.items()}
        if self.place.edges:
            shown["graph"] = [list(edge) for edge in self.place.edges]
        if self.x is not None:
            shown["x"] = [str(entry) for entry in self.x]
        return shown

    def proof(self, problem: Problem) -> dict[str, Any]:
        """The proof of a refutation for the kernel."""
        made: dict[str, Any] = {
            "kind": "witness",
            "values": {name: str(value) for name, value in self.place.values.items()},
        }
        if is_fleet(problem):
            made["graph"] = [list(edge) for edge in self.place.edges]
            letters = {split(n)[1] for n in problem.listings[problem.claim.listing].inputs}
            if letters - {None}:
                made["node"] = self.place.binding["i"]
            if "j" in letters:
                made["neighbour"] = self.place.binding["j"]
        return made | ({"x": [str(e) for e in self.x]} if self.x is not None else {"at": self.at})


def refute(problem: Problem, tries: int = TRIES) -> Witness | None:
    """A witness against an equation or a bound, or None. Raises NoPoint where no admissible point is found at
    all.
    """
    return fails_at(problem, islice(points(problem), tries))


def fails_at(problem: Problem, places: Iterable[Place]) -> Witness | None:
    """A witness among admissible places, or None."""
    found = (_fails(problem, place) for place in places)
    return next((witness for witness in found if witness is not None), None)


def _fails(problem: Problem, place: Place) -> Witness | None:
    try:
        outputs = evaluation(problem, place, FractionDomain()).outputs(problem.claim.listing, place.binding)
        return _exact_failure(problem, place, outputs)
    except NoExactValue:
        return _enclosed_failure(problem, place)
    except ZeroDivisionError:
        return None


def _exact_failure(problem: Problem, place: Place, outputs: Sequence[Fraction]) -> Witness | None:
    count = len(outputs) // 2
    for k in range(count if problem.claim.kind == "equal" else len(outputs)):
        if problem.claim.kind == "equal" and outputs[k] != outputs[count + k]:
            return Witness(place, k, None, f"left is {outputs[k]}, right is {outputs[count + k]}")
        if problem.claim.kind == "nonnegative" and outputs[k] < 0:
            return Witness(place, k, None, f"the value is {outputs[k]} < 0")
        if problem.claim.kind == "positive" and outputs[k] <= 0:
            return Witness(place, k, None, f"the value is {outputs[k]} <= 0")
    return None


def _enclosed_failure(problem: Problem, place: Place) -> Witness | None:
    domain = IntervalDomain(BITS)
    with domain.working():
        try:
            balls = evaluation(problem, place, domain).outputs(problem.claim.listing, place.binding)
        except (Unsupported, ZeroDivisionError, ValueError):
            return None
        outputs = [bounds(ball) for ball in balls]
    count = len(outputs) // 2
    for k in range(count if problem.claim.kind == "equal" else len(outputs)):
        a, b = outputs[k], outputs[count + k] if problem.claim.kind == "equal" else (Fraction(0), Fraction(0))
        if a is None or b is None:
            continue
        if a[1] < b[0] or (problem.claim.kind == "equal" and b[1] < a[0]):
            return Witness(
                place,
                k,
                None,
                f"left is about {float(a[0]):.6g}, right about {float(b[0]):.6g}: the enclosures do not meet",
            )
    return None
