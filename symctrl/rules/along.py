"""Solutions in closed form against a theorem: their obligations, and the constants of the contradiction."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

import casadi as ca

from symctrl.collect import Collector
from symctrl.expr import Expr, lift
from symctrl.graph import Tape, read, unfolded
from symctrl.kernel import trajectory
from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.contradiction import ROLE
from symctrl.kernel.enclosure import Enclosure
from symctrl.kernel.evaluation import Evaluation, NoSums
from symctrl.kernel.interval import Interval, point
from symctrl.kernel.place import NotContradicted
from symctrl.kernel.values import Sentence
from symctrl.literals import as_sx
from symctrl.rules.against import BITS, EXISTS, Offer, Refuted, Table, tried
from symctrl.rules.offered import NoCounterexample
from symctrl.rules.seeker import Outcome, Seeker
from symctrl.text import text

TIME = "t"
SAMPLES = tuple(map(Fraction, ("0", "1/4", "1/2", "3/4", "1", "3/2", "2", "3", "5", "8", "13", "21")))
TIMES = (*SAMPLES, Fraction(34), Fraction(64))
CONSTANTS = tuple(Fraction(1, 2**k) for k in range(8))
LATER = (Fraction(0), Fraction(1), Fraction(4), Fraction(16))
EXACT = Enclosure(BITS)


def along(offer: Offer) -> Refuted:
    """Raises NoCounterexample, Invalid or Declined where the functions refute nothing."""
    search = _Search(offer)
    return tried(offer, search.against)


class _Search:
    """One trajectory, against one conclusion after another."""

    def __init__(self, offer: Offer) -> None:
        self.offer = offer
        until = offer.counterexample.until
        if until is not None and until.value is None:
            raise NoCounterexample("the time up to which the functions are a solution is a number")
        self.until = None if until is None else until.value
        self.functions = {name: lift(value) for name, value in offer.values.items()}
        tapes = {name: self._tape(name, expr) for name, expr in self.functions.items()}
        self.table: Table = {
            "time": TIME,
            "listings": {f"{n} of t": x.as_json() | {"sha256": x.sha256} for n, x in tapes.items()},
            "functions": {name: [f"{name} of t", 0] for name in tapes},
            "until": None if self.until is None else str(self.until),
        }
        self.table = json.loads(json.dumps(self.table))
        self.seeker = Seeker("against", thorough=False)

    def _tape(self, name: str, expr: Expr) -> Tape:
        with unfolded():
            entries = ca.vertcat(*[as_sx(entry) for entry in expr.entries])
            symbols = ca.symvar(entries)
            function = ca.Function("function", [ca.vertcat(*symbols)], [ca.densify(entries)])
        made = Collector(self.offer.loop.study)._bound(read(function, [s.name() for s in symbols]))
        others = sorted(set(made.inputs) - {TIME})
        if others:
            raise NoCounterexample(
                f"{name} is a function of {others[0]}: it may read the time symctrl.counterexample.t alone"
            )
        return made

    def against(self, then: int | str) -> Refuted:
        claim = self.offer.statement.claim
        sentence = Sentence(EXISTS, ()) if isinstance(then, str) else claim.then[then]
        kept: NotContradicted | None = None
        unmet: Outcome | None = None
        for numbers in _Trials(self, sentence).numbers():
            try:
                self.seeker.outcomes = []
                trajectory.refute(
                    self.offer.statement, sentence, self.table | {"numbers": numbers}, self.seeker
                )
            except NotContradicted as error:
                kept = kept or error
                continue
            outcomes = self.seeker.outcomes
            failed = next((o for o in outcomes if not o.met or o.conditions), None)
            if failed is None:
                return self._made(then, numbers, outcomes)
            if failed.role != ROLE:
                raise NoCounterexample(f"{failed.role}: {self._why(failed)}")
            unmet = unmet or failed
        if unmet is not None:
            raise NotContradicted(
                f"no constants were found with which it contradicts that {self.offer.sentence(then)}"
            )
        raise kept or NotContradicted(f"it does not contradict that {self.offer.sentence(then)}")

    def _why(self, failed: Outcome) -> str:
        """What does not hold, refuted at a time if it can be."""
        if failed.met:
            return f"it is not shown that {failed.conditions[0].of} is {failed.conditions[0].kind}"
        if failed.problem is None:
            return failed.reason
        from symctrl.decide.decision import DECIDERS
        from symctrl.rules.seeker import NO_MEANING

        try:
            found = DECIDERS[failed.problem.claim.kind](failed.problem)
        except NO_MEANING as error:
            return f"{failed.reason}; {error}"
        if found.witness is None:
            return found.reason or failed.reason
        at = ", ".join(f"{n} = {v}" for n, v in found.witness.values_json(failed.problem).items())
        return f"not at {at}: {found.witness.says}"

    def _made(self, then: int | str, numbers: Table, outcomes: Sequence[Outcome]) -> Refuted:
        proofs = {o.role: {"given": list(o.given), "proof": o.proof} for o in outcomes}
        proof = {
            "kind": "against",
            "how": "along",
            "then": then,
            **self.table,
            "numbers": numbers,
            "proofs": proofs,
        }
        shown = {name: text(expr) for name, expr in self.functions.items()}
        states = [n for n in shown if self.offer.statement.scalars[n] != "parameter"]
        order = [*states, *(n for n in shown if n not in states)]
        path = ", ".join(f"{name} = {shown[name]}" for name in order)
        end = f" up to t = {self.until}" if self.until is not None else ""
        how = ", ".join(f"{name} = {value}" for name, value in numbers.items() if name != "entry")
        says = f"along {path}, a solution{end}, it is not true that {self.offer.sentence(then)} (by {how})"
        return self.offer.made(proof, says, dict(shown))

    def samples(self, k: int, level: int) -> dict[Fraction, list[Interval]]:
        """Output k of the claim and its derivatives at some times, where they have values."""
        times = [time for time in SAMPLES if self.until is None or time < self.until]
        found = {time: self._derivatives(k, time, level) for time in times}
        return {time: values for time, values in found.items() if values}

    def begin(self, k: int) -> list[Interval]:
        return self._derivatives(k, Fraction(0), 3)

    def _derivatives(self, k: int, time: Fraction, level: int) -> list[Interval]:
        ref = (self.offer.statement.claim.listing, k)
        return _derivatives(trajectory._composed(self.offer.statement, self.table), ref, time, level)


def _derivatives(whole: Any, ref: tuple[str, int], time: Fraction, level: int) -> list[Interval]:
    """The value and derivatives of an output at a time; none where they are not defined."""
    walk = Evaluation(whole, EXACT, lambda _: point(time), NoSums())
    try:
        value: Any = walk.output(ref, {}, level, None)
    except (Invalid, Declined):
        return []
    found = []
    for order in range(level + 1):
        part = value
        for step in range(level):
            part = None if part is None else part[1 if step < order else 0]
        found.append(point(0) if part is None else part)
    return found


class _Trials:
    """Constants that may do for a conclusion, those that samples exclude left out."""

    def __init__(self, search: _Search, sentence: Sentence) -> None:
        self.search, self.sentence = search, sentence

    def numbers(self) -> Iterator[Table]:
        word, of = self.sentence.word, self.sentence.of
        if word == EXISTS:
            states = self.search.offer.statement.motion
            yield from ({"c": str(c), "entry": k} for k in range(len(states)) for c in CONSTANTS)
            return
        if word in ("apart", "stays") or (word in ("settles", "bounded") and self.sentence.by is not None):
            until = self.search.until
            ends = () if until is None else (until,)
            yield from ({"at": str(time)} for time in (*ends, *TIMES) if until is None or time <= until)
        for entry, k in enumerate(of):
            if word in ("tends", "exponentially"):
                yield from self._still(entry, k, {})
            elif word == "summable":
                yield from self._still(entry, k, {}, names="c")
            elif word == "bounded":
                yield from ({"c": str(c), "d": str(d), "entry": entry} for c in CONSTANTS for d in (0, 1, 4))
            elif word == "enters":
                yield from self._outside(entry, k, {})
            elif word in ("settles", "eventually"):
                for later in LATER:
                    yield from self._outside(entry, k, {"from": str(later)})

    def _outside(self, entry: int, k: int, more: Table) -> Iterator[Table]:
        if self.sentence.zero:
            yield from self._still(entry, k, more, "c" if self.sentence.word == "enters" else "ck")
            return
        start = Fraction(more.get("from", 0))
        found = {t: v for t, v in self.search.samples(k, 0).items() if t >= start}
        most = min((-values[0].hi for values in found.values()), default=Fraction(0))
        yield from (
            {"c": str(c), "entry": entry, **more} for c in _below(most, [-v[0].hi for v in found.values()])
        )

    def _still(self, entry: int, k: int, more: Table, names: str = "ck") -> Iterator[Table]:
        """e^2 + w e'^2 >= c, with w = 0, those of an oscillation about zero, and 1."""
        found = self.search.samples(k, 1) if "k" in names else {}
        weights = [Fraction(0), *_weights(self.search.begin(k)), Fraction(1)] if found else [Fraction(0)]
        found = found or self.search.samples(k, 0)
        for weight in dict.fromkeys(weights) if found else ():
            sizes = [_size(values, weight) for values in found.values()]
            for c in _below(min(size.hi for size in sizes), [size.lo for size in sizes if size.thin]):
                yield {"c": str(c), "entry": entry, **({"k": str(weight)} if "k" in names else {}), **more}


def _size(values: Sequence[Interval], weight: Fraction) -> Interval:
    size = EXACT.square(values[0])
    if weight:
        size = EXACT.add(size, EXACT.mul(point(weight), EXACT.square(values[1])))
    return size


def _weights(begin: Sequence[Interval]) -> list[Fraction]:
    """1/w^2 for e'' = -w^2 e, read off the value and three derivatives at t = 0."""
    pairs = [(a.lo, b.lo) for a, b in zip(begin, begin[2:], strict=False) if a.thin and b.thin]
    return [-a / b for a, b in pairs if a * b < 0]


def _below(most: Fraction, exact: Sequence[Fraction]) -> list[Fraction]:
    """Constants that are not above the smallest sample: the sample itself, and powers of 1/2."""
    own = [x for x in exact if 0 < x <= most and x.denominator < 10**6]
    return [*dict.fromkeys([*own, *(c for c in CONSTANTS if c <= most)])][:8]
