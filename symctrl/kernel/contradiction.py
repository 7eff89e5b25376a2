"""What functions of time must show to contradict each conclusion.

Soundness-critical. Last reviewed 2026-11-24.

Relies on the theorem of `trajectory`. Numbers at one time are enclosed; what holds at all times is an
obligation, from 0 on or from the time `from`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from symctrl.kernel.argument import Beside
from symctrl.kernel.certificate import Declined, Invalid, fields, natural, rational
from symctrl.kernel.interval import Interval, Undecided
from symctrl.kernel.place import SETS, NotContradicted
from symctrl.kernel.values import Sentence
from symctrl.kernel.witness import BITS

if TYPE_CHECKING:
    from symctrl.kernel.trajectory import Path

ROLE = "the conclusion is contradicted"
ALL_TIMES = {"tends": "ck", "exponentially": "ck", "summable": "c", "bounded": "cd"}


def contradict(path: Path, sentence: Sentence, numbers: Mapping[str, Any]) -> None:
    """Puts the obligation to the judge, or evaluates. Raises Invalid where nothing is contradicted."""
    if sentence.word == "exists":
        _blows_up(path, numbers)
    elif "at" in numbers:
        _at_one_time(path, sentence, numbers)
    elif sentence.word in SETS and sentence.word != "stays":
        _outside(path, sentence, numbers)
    elif sentence.word in ALL_TIMES and not (sentence.word == "bounded" and sentence.by is not None):
        _at_all_times(path, sentence, numbers)
    else:
        raise NotContradicted(
            f"functions of time at all times do not contradict the conclusion {sentence.word}"
        )


def _constants(numbers: Mapping[str, Any], names: str, *more: str) -> dict[str, Fraction]:
    """The numbers of these names: c is positive, no other is negative."""
    table = fields(numbers, [*names, *more], "numbers")
    found = {name: rational(table[name], name) for name in table if name != "entry"}
    if any(x < 0 for x in found.values()) or found.get("c", 1) == 0:
        raise Invalid("numbers: c is positive, and no number is negative")
    return found


def _entry(numbers: Mapping[str, Any], count: int) -> int:
    return natural(numbers.get("entry"), count, "entry")


def _blows_up(path: Path, numbers: Mapping[str, Any]) -> None:
    c = _constants(numbers, "c", "entry")["c"]
    if path.until is None:
        raise NotContradicted("functions at all times do not contradict that solutions exist")
    states = list(path.original.motion)
    x = path.quantity(path.whole.names[states[_entry(numbers, len(states))]].of)
    path.at.prove(ROLE, "nonnegative", f"x x * {path.until} @{path.time} - * {c} -", x=x)


def _at_all_times(path: Path, sentence: Sentence, numbers: Mapping[str, Any]) -> None:
    given = _constants(numbers, ALL_TIMES[sentence.word], "entry")
    _require_endless(path)
    if sentence.word == "exponentially" and sentence.by is not None:
        ref = (path.original.claim.listing, sentence.by)
        if path.reads_time(ref) or not _decided(lambda bits: _sign(path.number(ref, Fraction(0), bits)) > 0):
            raise NotContradicted("the rate of decay is not a positive constant")
    e = path.output(sentence.of[_entry(numbers, len(sentence.of))])
    if sentence.word == "bounded":
        formula = f"e e * {given['c']} @{path.time} * - {given['d']} +"
    else:
        formula = _never_still(path, e, given)
    path.at.prove(ROLE, "nonnegative", formula, e=e)


def _never_still(path: Path, e: str, given: Mapping[str, Fraction]) -> str:
    """e^2 + k e'^2 >= c."""
    if not given.get("k"):
        return f"e e * {given['c']} -"
    if not path.is_smooth(e):
        raise Declined("what the conclusion is about is not known to be smooth")
    return f"e e * {given['k']} e' e' * * + {given['c']} -"


def _outside(path: Path, sentence: Sentence, numbers: Mapping[str, Any]) -> None:
    """Outside the set by c: for all times, from a time on, or for `enters` until the time that it names."""
    enters = sentence.word == "enters"
    zeros = "k" if sentence.zero and not enters else ""
    given = _constants(numbers, f"c{zeros}", "entry", *(() if enters else ("from",)))
    if not (enters and sentence.by is not None and path.until is not None):
        _require_endless(path)
    elif not _decided(lambda bits: _before(_time(path, sentence, bits), path.until or Fraction(0))):
        raise NotContradicted("the time by which the set is entered is later than the functions go")
    e = path.output(sentence.of[_entry(numbers, len(sentence.of))])
    formula = _never_still(path, e, given) if sentence.zero else f"e neg {given['c']} -"
    beside = Beside((path.since(given["from"]),)) if given.get("from") else None
    path.at.prove(ROLE, "nonnegative", formula, beside, e=e)


def _at_one_time(path: Path, sentence: Sentence, numbers: Mapping[str, Any]) -> None:
    time = _constants(numbers, "", "at")["at"]
    if path.until is not None and time > path.until:
        raise NotContradicted("the time is later than the functions go")
    if not _decided(lambda bits: _fails_at(path, sentence, time, bits)):
        raise NotContradicted(
            f"at the time {time} the functions do not contradict the conclusion {sentence.word}"
        )


def _fails_at(path: Path, sentence: Sentence, time: Fraction, bits: int) -> bool:
    claim = path.original.claim.listing
    there = [path.number((claim, k), time, bits) for k in sentence.of]
    if sentence.word == "apart":
        return _any(there, lambda a: _sign(a) == 0)
    if sentence.word == "stays":
        begin = [path.number((claim, k), Fraction(0), bits) for k in sentence.of]
        if any(_out(a, sentence.zero) for a in begin):
            raise NotContradicted("the solution does not begin in the set")
        return _any(there, lambda a: _out(a, sentence.zero))
    if sentence.word == "settles" and sentence.by is not None:
        late = _before(_time(path, sentence, bits), time)
        return late and _any(there, lambda a: _out(a, sentence.zero))
    if sentence.word == "bounded" and sentence.by is not None:
        bound = _time(path, sentence, bits)
        return _any(there, lambda a: _beyond(a, bound))
    raise NotContradicted(f"one time does not contradict the conclusion {sentence.word}")


def _any(parts: list[Interval], test: Callable[[Interval], bool]) -> bool:
    """Does the test hold of one of them? Raises Undecided where that is open."""
    reason: Undecided | None = None
    for part in parts:
        try:
            if test(part):
                return True
        except Undecided as undecided:
            reason = undecided
    if reason is not None:
        raise reason
    return False


def _time(path: Path, sentence: Sentence, bits: int) -> Interval:
    """The time, or the bound, that the conclusion names, of the initial state."""
    assert sentence.by is not None
    return path.number((path.original.claim.listing, sentence.by), Fraction(0), bits)


def _before(by: Interval, time: Fraction) -> bool:
    if by.lo <= time < by.hi:
        raise Undecided("whether a time is late enough")
    return by.hi <= time


def _beyond(a: Interval, bound: Interval) -> bool:
    least = max(a.lo, -a.hi)
    if least > bound.hi:
        return True
    if a.magnitude <= bound.lo:
        return False
    raise Undecided("whether a bound is exceeded")


def _out(a: Interval, zero: bool) -> bool:
    """Is a value that of a point outside? A set is where values are zero, or not negative."""
    if not zero and a.lo >= 0:
        return False
    sign = _sign(a)
    return sign != 0 if zero else sign < 0


def _sign(a: Interval) -> int:
    if a.sign is None:
        raise Undecided("a sign")
    return a.sign


def _decided(test: Callable[[int], bool]) -> bool:
    for bits in BITS:
        try:
            return test(bits)
        except Undecided as undecided:
            reason = str(undecided)
    raise Declined(f"not decided with {BITS[-1]} bits: {reason}")


def _require_endless(path: Path) -> None:
    if path.until is not None:
        raise NotContradicted(
            "the functions are a solution up to a time only, and the conclusion is about all times"
        )
