"""Theorems that say nothing: a conclusion that is assumed, assumptions that contradict each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from symctrl.evidence import point_known
from symctrl.kernel.argument import OBLIGATION, Argument, Beside
from symctrl.kernel.theorem import output_key
from symctrl.kernel.values import Assumption, Sentence
from symctrl.rules.loop import Loop
from symctrl.rules.seeker import Seeker
from symctrl.written import StudyError


def refuse_assumed_conclusions(loop: Loop, id_: str) -> None:
    """Raises StudyError where a conclusion is assumed of the trajectory, or follows at once from what is; and
    where what is supposed jumps.
    """
    seeker = Seeker(id_, thorough=False)
    at = Argument(loop.statement, (), seeker)
    claim = loop.statement.claim
    for sentence, fact in zip(claim.suppose, loop.theorem.suppose, strict=True):
        if any(at.output_traits((claim.listing, k)).jumps for k in sentence.of):
            raise StudyError(
                f"{id_}: {fact.text()} cannot be supposed: it jumps where a switch turns, and the solutions "
                "take other values of the switch there"
            )
    supposed = {(s.word, output_key(at, k)) for s in claim.suppose for k in s.of}
    along = [a for a in loop.statement.given if a.about == "trajectory"]
    for sentence, fact in zip(claim.then, loop.theorem.then, strict=True):
        known = any((sentence.word, output_key(at, k)) in supposed for k in sentence.of)
        if known or (sentence.of and along and _follows(at, seeker, sentence, along)):
            raise StudyError(f"{id_}: the conclusion that {fact.text()} is assumed of the trajectory")


def _follows(at: Argument, seeker: Seeker, sentence: Sentence, along: Sequence[Assumption]) -> bool:
    """Do the assumptions about the trajectory alone put every component at zero, or into the set?"""
    zero = sentence.zero or sentence.word == "tends"
    if not zero and sentence.word not in ("stays", "enters", "settles", "eventually"):
        return False
    for k in sentence.of:
        name = f"conclusion {k + 1}"
        if name not in at.statement.listings:
            at.mint_single(name, (at.statement.claim.listing, k))
        formulas = ["e", "0"] if zero else ["e"]
        seeker.outcomes = []
        at.prove(name, "equal" if zero else "nonnegative", formulas, Beside(only=tuple(along)), e=name)
        if not seeker.outcomes[-1].met:
            return False
    return True


def contradictory(loop: Loop) -> bool:
    """Is it proved that nothing meets all that is given? Tried where no point is known that does."""
    if not loop.problem.given or point_known([loop.problem]):
        return False
    seeker = Seeker(loop.problem.id, thorough=False)
    at = Argument(loop.statement, (), seeker)
    # All are kept for it, though the claim reads nothing that they speak of.
    given = tuple(replace(a, about=OBLIGATION) for a in loop.statement.given)
    at.prove("minus one is not negative", "nonnegative", "0 1 -", Beside(extra=given, only=()))
    return seeker.outcomes[-1].met
