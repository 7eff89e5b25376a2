"""A theorem's verdict: proved by the first argument that closes, refuted by a counterexample that the kernel
accepts, otherwise undecided with what is missing; and one row for each line and obligation.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import astuple, dataclass
from typing import TYPE_CHECKING, Any

from symctrl.certify import digest, tool
from symctrl.context import current
from symctrl.expr import Nonconforming
from symctrl.inputs import files_of
from symctrl.kernel.values import Sentence
from symctrl.listings import UndefinedLetter
from symctrl.problem import Problem
from symctrl.rows import Row, Twins
from symctrl.rules.carries import conclude
from symctrl.rules.chain import Chain, Done, accepted, recorded
from symctrl.rules.loop import Loop
from symctrl.rules.planners import PLANNERS
from symctrl.rules.seeker import Memory, Outcome, Seeker
from symctrl.rules.twins import twins
from symctrl.rules.vacuous import contradictory, refuse_assumed_conclusions
from symctrl.statements import Nonzero
from symctrl.theorem import ArgumentEntry, Theorem
from symctrl.verdict import Condition, Verdict
from symctrl.verdict import Outcome as Verdicts

if TYPE_CHECKING:
    from symctrl.collect import Used
    from symctrl.store import Store
    from symctrl.study import Study

PHRASES = {"exists": "solutions exist for all time"}


@dataclass(frozen=True)
class Tried:
    """An argument, decided. open_: conclusions that it does not give. certificate: where it closes. shown:
    the study's assumptions about the trajectory that it shows.
    """

    entry: ArgumentEntry
    begin: tuple[Outcome, ...]
    lines: tuple[Done, ...]
    open_: tuple[str, ...]
    conditions: tuple[Condition, ...] = ()
    certificate: dict[str, Any] | None = None
    refused: str | None = None
    ill_formed: str | None = None
    shown: tuple[str, ...] = ()

    @property
    def closes(self) -> bool:
        return self.certificate is not None

    @property
    def why_not(self) -> str:
        """The first cause."""
        if self.ill_formed is not None:
            return f"it does not conform: {self.ill_formed}"
        for outcome in self.begin:
            if not outcome.met:
                return f"{outcome.role}: {outcome.reason}"
        for n, done in enumerate(self.lines, start=1):
            if not done.met:
                return f"line {n}, {done.line.rule}: {done.reason}"
        if self.refused is not None:
            return f"the kernel does not accept the argument: {self.refused}"
        return f"no line gives that {', nor that '.join(self.open_)}"


@dataclass(frozen=True)
class Decided:
    """A theorem's problem, verdict, rows of its arguments, what became of its twins, and the study's
    assumptions about the trajectory that its argument shows.
    """

    problem: Problem
    verdict: Verdict
    rows: tuple[Row, ...]
    rests_on: tuple[str, ...] = ()
    unmet: tuple[str, ...] = ()
    twins: Twins | None = None
    shown: tuple[str, ...] = ()


def decide(
    study: Study,
    theorem: Theorem,
    id_: str,
    equation: str,
    using: Sequence[Used] = (),
    store: Store | None = None,
) -> Decided:
    """The verdict with the definitions and laws of the instance at hand. Raises StudyError.

    It is taken from the store if nothing in the study's files has changed and the kernel accepts it again.
    """
    loop = Loop(study, theorem, id_, using)
    refuse_assumed_conclusions(loop, id_)
    if contradictory(loop):
        reason = "what is given contradicts itself: no state and no parameters meet it"
        return Decided(loop.problem, Verdict(Verdicts.ILL_FORMED, reason), ())
    key = digest([loop.problem.sha256, files_of(study), current().variant, tool()])
    kept = store.get(key) if store is not None else None
    known = None if kept is None else _read(loop.problem, kept)
    if known is not None:
        return known
    made = _decided(study, loop, id_, equation)
    if store is not None:
        store.put(key, _written(made))
    return made


def _decided(study: Study, loop: Loop, id_: str, equation: str) -> Decided:
    theorem, using = loop.theorem, loop.using
    entries = [entry for entry in study.arguments if entry.theorem == id_]
    memory: Memory = {}
    tried = [conforming(Loop(study, theorem, id_, using), entry, memory) for entry in entries]
    rows = tuple(row for one in tried for row in rows_of(one, id_, equation))
    closing = next((one for one in tried if one.closes), None)
    refuted = _refuted(study, loop, id_)
    if closing is not None and isinstance(refuted, Verdict):
        from symctrl.verify import ToolError

        raise ToolError(f"{id_} is proved by {closing.entry.id} and refuted by a counterexample")
    if closing is not None:
        reason = f"by {closing.entry.id}, {len(closing.lines)} lines"
        verdict = Verdict(
            Verdicts.PROVED, reason, f"argument {closing.entry.id}", closing.conditions, closing.certificate
        )
        prefix = f"{id_}/{closing.entry.id}/"
        steps = tuple(r.id for r in rows if r.id.startswith(prefix) and r.form == "step")
        laws = [law.name for law in loop.laws if loop.problem.laws]
        found = twins(study, theorem, id_, using, closing.entry, laws, memory)
        return Decided(loop.problem, verdict, rows, steps, (), found, closing.shown)
    if isinstance(refuted, Verdict):
        return Decided(loop.problem, refuted, rows)
    reasons = [f"{one.entry.id}: {one.why_not}" for one in tried] + refuted
    reason = "; ".join(reasons) or "no argument and no counterexample is given"
    unmet = tuple(r.id for r in rows if r.form == "obligation" and r.verdict != "proved")
    return Decided(loop.problem, Verdict(Verdicts.UNDECIDED, reason, "rules"), rows, (), unmet)


def _written(made: Decided) -> dict[str, Any]:
    verdict = made.verdict
    return {
        "outcome": verdict.outcome.value,
        "reason": verdict.reason,
        "method": verdict.method,
        "conditions": [[c.kind, c.of] for c in verdict.conditions],
        "certificate": verdict.certificate,
        "witness": verdict.witness,
        "rows": [row.as_json() for row in made.rows],
        "rests_on": list(made.rests_on),
        "unmet": list(made.unmet),
        "twins": None if made.twins is None else [*astuple(made.twins)],
        "shown": list(made.shown),
    }


def _read(problem: Problem, kept: Mapping[str, Any]) -> Decided | None:
    """What was decided before; None where the kernel does not accept it as a verdict of this very problem."""
    conditions = tuple(Condition(kind, of) for kind, of in kept["conditions"])
    outcome = Verdicts(kept["outcome"])
    if outcome is not Verdicts.UNDECIDED:
        stated = problem.statement([{"kind": c.kind, "of": c.of} for c in conditions])
        made = kept["certificate"]
        kind = "argument" if outcome is Verdicts.PROVED else "against"
        same = made is not None and made["statement"] == json.loads(json.dumps(stated))
        if not same or made["proof"]["kind"] != kind or accepted(made) is not None:
            return None
    verdict = Verdict(
        outcome, kept["reason"], kept["method"], conditions, kept["certificate"], kept["witness"]
    )
    rows = tuple(
        Row(**row | {"rests_on": tuple(row["rests_on"]), "unmet": tuple(row["unmet"])})
        for row in kept["rows"]
    )
    tried, *texts = kept["twins"] or (0,)
    found = None if kept["twins"] is None else Twins(tried, *map(tuple, texts))
    rests_on, unmet, shown = (tuple(kept[name]) for name in ("rests_on", "unmet", "shown"))
    return Decided(problem, verdict, rows, rests_on, unmet, found, shown)


def conforming(loop: Loop, entry: ArgumentEntry, memory: Memory) -> Tried:
    """The argument, decided; one that does not conform proves nothing."""
    try:
        return attempt(loop, entry, memory)
    except (Nonconforming, UndefinedLetter) as error:
        return Tried(entry, (), (), (), ill_formed=str(error))


def attempt(loop: Loop, entry: ArgumentEntry, memory: Memory, thorough: bool = True) -> Tried:
    """One argument, line by line, with a certificate where it closes."""
    chain = Chain(loop, Seeker(loop.problem.id, thorough, memory), hasty=not thorough)
    begin = tuple(chain.outcomes)
    lines = tuple(chain.decided(recorded(entry.function), PLANNERS))
    whole = all(o.met for o in begin) and all(done.met for done in lines)
    if whole:
        for sentence in chain.open_conclusions():
            conclude(chain, sentence)
    open_ = tuple(said(chain.loop, s) for s in chain.open_conclusions())
    if not whole or open_:
        return Tried(entry, begin, lines, open_)
    made = chain.certificate()
    refused = accepted(made)
    if refused is not None:
        return Tried(entry, begin, lines, open_, refused=refused)
    conditions = tuple(Condition(c["kind"], c["of"]) for c in made["statement"]["conditions"])
    return Tried(entry, begin, lines, open_, conditions, made, shown=tuple(_shown(chain)))


def _shown(chain: Chain) -> Iterator[str]:
    """What the study assumes of the trajectory not to be zero, and is known to stay apart from it."""
    for assumed in chain.loop.study.trajectory_assumptions():
        claim = assumed.claim
        if isinstance(claim, Nonzero) and chain.at.has("apart", chain.q(claim.expr)):
            yield claim.text()


def said(loop: Loop, sentence: Sentence) -> str:
    """A conclusion in words."""
    if sentence.word == "exists":
        return PHRASES["exists"]
    at = loop.statement.claim.then.index(sentence)
    return loop.theorem.then[at].text()


def rows_of(tried: Tried, id_: str, equation: str) -> Iterator[Row]:
    """A row for each line, and for each of its obligations."""
    start = f"{id_}/{tried.entry.id}/0"
    begin = list(_obligations(tried.begin, start, equation, "begin"))
    if begin:
        yield _begin(tried, start, equation, [row.id for row in begin])
        yield from begin
    for n, done in enumerate(tried.lines, start=1):
        line_id = f"{id_}/{tried.entry.id}/{n}"
        obligations = list(_obligations(done.outcomes, line_id, equation, done.line.rule))
        yield _step(done, line_id, n, equation, tuple(row.id for row in obligations), tried)
        yield from obligations


def _begin(tried: Tried, line_id: str, equation: str, below: Sequence[str]) -> Row:
    """What every argument asks first: that assumed equations about states are kept."""
    unmet = tuple(f"{line_id}/{o.role}" for o in tried.begin if not o.met)
    return Row(
        id=line_id,
        equation=equation,
        statement="before line 1: equations about states are kept",
        latex="",
        form="step",
        corrects=None,
        kind="step",
        verdict="undecided" if unmet else "proved",
        stands=False,
        conditional=False,
        reason=next((f"{o.role}: {o.reason}" for o in tried.begin if not o.met), ""),
        method="rule",
        rule="begin",
        rests_on=tuple(below),
        unmet=unmet,
    )


def _step(done: Done, line_id: str, n: int, equation: str, below: Sequence[str], tried: Tried) -> Row:
    refuted = next((o for o in done.outcomes if not o.met and o.witness is not None), None)
    verdict = "proved" if done.met else "refuted" if refuted is not None else "undecided"
    broken = next((k for k, d in enumerate(tried.lines, start=1) if not d.met), None)
    prefix = line_id.rpartition("/")[0]
    return Row(
        id=line_id,
        equation=equation,
        statement=f"line {n}: {done.line.text()}",
        latex="",
        form="step",
        corrects=None,
        kind="step",
        verdict=verdict,
        stands=False,
        conditional=False,
        reason=done.reason,
        method="rule",
        rule=done.line.rule,
        rests_on=tuple(below),
        unmet=tuple(f"{line_id}/{o.role}" for o in done.outcomes if not o.met),
        blocked_by=f"{prefix}/{broken}" if done.blocked else None,
        witness=_witness(refuted),
    )


def _obligations(outcomes: Sequence[Outcome], line_id: str, equation: str, rule: str) -> Iterator[Row]:
    seen: set[str] = set()
    for outcome in outcomes:
        name = outcome.role
        count = 1
        while name in seen:
            count += 1
            name = f"{outcome.role} ({count})"
        seen.add(name)
        yield Row(
            id=f"{line_id}/{name}",
            equation=equation,
            statement=outcome.role,
            latex="",
            form="obligation",
            corrects=None,
            kind=outcome.problem.claim.kind if outcome.problem is not None else "structure",
            verdict="proved" if outcome.met else "refuted" if outcome.witness is not None else "undecided",
            stands=False,
            conditional=False,
            reason=outcome.reason,
            method="rule",
            rule=rule,
            role=outcome.role,
            witness=_witness(outcome),
        )


def _witness(outcome: Outcome | None) -> dict[str, Any] | None:
    if outcome is None or outcome.witness is None or outcome.problem is None:
        return None
    return outcome.witness.values_json(outcome.problem)


def _refuted(study: Study, loop: Loop, id_: str) -> Verdict | list[str]:
    """The first counterexample that the kernel accepts, or why those that are offered are none."""
    reasons: list[str] = []
    for entry in study.counterexamples:
        if entry.theorem != id_:
            continue
        from symctrl.rules.against import contradict

        found = contradict(loop, entry.function(), entry.against)
        if not isinstance(found, str):
            return Verdict(
                Verdicts.REFUTED,
                found.says,
                f"counterexample {entry.id}",
                (),
                found.certificate,
                found.witness,
            )
        reasons.append(f"{entry.id} is no counterexample: {found}")
    return reasons
