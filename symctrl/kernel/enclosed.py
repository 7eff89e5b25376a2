"""A solution in a tube that contradicts a conclusion at a finite time.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: by `tube` there is one solution from the initial values, for constant signals, and it is in the
boxes of the tube. A set of which it is outside at a time is left by then, and not kept from an earlier time
on; one of which it is outside at all times up to T is not reached by T.

Proof fields: `values`, of all free scalars, those of states at t = 0; `tube`, as in `tube`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from symctrl.kernel.certificate import Declined
from symctrl.kernel.enclosure import Enclosure
from symctrl.kernel.evaluation import Evaluation, NoSums
from symctrl.kernel.interval import Interval, point
from symctrl.kernel.place import (
    NotContradicted,
    Place,
    Site,
    is_fleet,
    require_momentary,
    require_no_jump,
    sign_of,
)
from symctrl.kernel.sliced import slice_of, sliced
from symctrl.kernel.tube import Box, Segment, verify_tube
from symctrl.kernel.values import Sentence, Statement


def enclosed(
    statement: Statement, sentence: Sentence, place: Place, table: Mapping[str, Any], bits: int
) -> None:
    """Raises Invalid or Declined where the tube does not contradict the conclusion."""
    if is_fleet(statement):
        raise Declined("a tube is for one vehicle")
    require_momentary(statement)
    site = Site(statement, place, bits)
    site.require_given()
    site.require_supposed()
    begin = [spot for k in sentence.of for spot in site.outputs(k)]
    require_no_jump(begin, sentence.word)
    segments = verify_tube(statement, statement.claim.law, place.values, table["tube"])
    seen = Seen(statement, place, sentence, bits)
    if sentence.word == "stays":
        signs = [sign_of(spot, "what the set is about") for spot in begin]
        if any(signs) if sentence.zero else -1 in signs:
            raise NotContradicted("the solution does not begin in the set")
        fails = seen.outside(segments[-1].end)
    elif sentence.word in ("settles", "enters") and sentence.by is not None:
        by = site.outputs(sentence.by)[0]
        require_no_jump([by], "the time")
        fails = _too_late(sentence, seen, segments, by.number)
    elif sentence.word == "bounded" and sentence.by is not None:
        fails = seen.beyond(segments[-1].end, site.outputs(sentence.by)[0].number)
    else:
        raise NotContradicted(f"a solution up to a time does not contradict the conclusion {sentence.word}")
    if not fails:
        raise NotContradicted(f"the tube does not contradict the conclusion {sentence.word}")


def _too_late(sentence: Sentence, seen: Seen, segments: Sequence[Segment], by: Interval) -> bool:
    """Is the solution outside at a time that is late enough, or for `enters` at all times before?"""
    if sentence.word == "settles":
        late = [segment.end for segment in segments if segment.t1 >= by.hi]
        if by.hi <= 0:
            late.append(segments[0].start)
        return any(seen.outside(box) for box in late)
    early = [segment.over for segment in segments if segment.t0 <= by.hi]
    return segments[-1].t1 >= by.hi and all(seen.outside(box) for box in early)


class Seen:
    """What a conclusion is about, on boxes."""

    def __init__(self, statement: Statement, place: Place, sentence: Sentence, bits: int) -> None:
        self.statement, self.only = statement, sliced(statement)
        self.place, self.sentence, self.bits = place, sentence, bits

    def values(self, box: Box) -> list[Interval]:
        def free(name: str) -> Interval:
            return box[name] if name in box else point(self.place.values[name])

        walk = Evaluation(self.only, Enclosure(self.bits), free, NoSums())
        claim = self.statement.claim
        return [walk.output(slice_of((claim.listing, k)), {}, 0, claim.law) for k in self.sentence.of]

    def outside(self, box: Box) -> bool:
        if self.sentence.zero:
            return any(a.sign in (1, -1) for a in self.values(box))
        return any(a.hi < 0 for a in self.values(box))

    def beyond(self, box: Box, bound: Interval) -> bool:
        return any(a.lo > bound.hi or -a.hi > bound.hi for a in self.values(box))
