"""From a statement to its verdict: hypotheses, equivalences and lists are reduced to single problems."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import chain
from typing import TYPE_CHECKING, Any

from symctrl.bounds import Statement
from symctrl.certify import bundle, canonical, digest
from symctrl.collect import Collector, Used
from symctrl.decide.decision import decide
from symctrl.kernel.check import check_text
from symctrl.problem import Problem
from symctrl.reach import closings
from symctrl.statements import AtValues, Definite, Equivalent, Implies, Nonzero, Small, SufficientlySmall
from symctrl.verdict import Condition, Outcome, Verdict
from symctrl.written import StudyError

if TYPE_CHECKING:
    from symctrl.store import Store
    from symctrl.study import Study


@dataclass(frozen=True)
class Part:
    """One problem of a claim, and the role that it plays in it.

    expanded: the same problem with all entries of a matrix that is written as a product.
    """

    problem: Problem
    role: str = ""
    expanded: Problem | None = None


def parts(
    study: Study,
    claim: Any,
    id_: str,
    values: Mapping[str, Fraction] | None = None,
    using: Sequence[Used] = (),
) -> list[Part]:
    """The problems that a claim consists of. Raises UndefinedLetter, Nonconforming, StudyError."""
    if isinstance(claim, list | tuple):
        if not claim:
            raise StudyError(f"{id_}: an empty list claims nothing")
        return [part for one in claim for part in parts(study, one, id_, values, using)]
    if isinstance(claim, AtValues):
        return parts(study, claim.claim, id_, study.all_values(), using)
    made = partial(_part, study, id_, values, using)
    if isinstance(claim, Equivalent):
        enough = made(claim.claim, claim.conditions, role="the condition is sufficient")
        role = "the condition is necessary"
        return [enough, *(made(condition, [claim.claim], role=role) for condition in claim.conditions)]
    if isinstance(claim, Implies):
        return [made(claim.claim, claim.hypotheses)]
    if isinstance(claim, SufficientlySmall):
        return [made(one, (), small=claim.gain.args[0]) for one in _as_definite(claim.claim)]
    if not isinstance(claim, Statement):
        raise StudyError(f"{id_} returns {claim!r}; a statement returns a claim, like equal(a, b)")
    return [made(claim, ())]


def _as_definite(claim: Small) -> list[Definite]:
    """A bound, as definiteness of a 1 x 1 matrix for each component; proofs for small values are of that."""
    if isinstance(claim, Definite):
        return [claim]
    if isinstance(claim, Nonzero):
        return [Definite(claim.expr**2, strict=True)]
    rows, columns = claim.expr.shape
    entries = [claim.expr[r, c] for r in range(rows) for c in range(columns)]
    return [Definite(entry, claim.strict) for entry in entries]


def digest_of(found: Sequence[Part]) -> str:
    """The digest of a claim, by which another claim's certificate names it."""
    return digest([part.problem.sha256 for part in found])


def verdict_of(found: Sequence[Part], store: Store | None) -> Verdict:
    """The verdict of a claim from those of its parts: refuted if one is, proved if all are."""
    verdicts = [_verdict(part, store) for part in found]
    if len(verdicts) == 1:
        return verdicts[0]
    for outcome in (Outcome.REFUTED, Outcome.ILL_FORMED, Outcome.UNDECIDED):
        for part, verdict in zip(found, verdicts, strict=True):
            if verdict.outcome == outcome:
                role = f"{part.role} fails: " if part.role else f"{part.problem.text}: "
                return _with_reason(verdict, role + verdict.reason)
    conditions = tuple(dict.fromkeys(c for verdict in verdicts for c in verdict.conditions))
    made = bundle([verdict.certificate for verdict in verdicts if verdict.certificate is not None])
    methods = ", ".join(dict.fromkeys(verdict.method for verdict in verdicts))
    return Verdict(Outcome.PROVED, f"all {len(verdicts)} parts are proved", methods, conditions, made)


def remembered(
    problem: Problem, store: Store | None, decider: Callable[[Problem], Verdict] = decide
) -> Verdict:
    """The verdict, from the store if it is there and the kernel accepts its certificate again.

    What was undecided has nothing that could be checked, and nothing that anyone could gain by altering it.
    """
    key = _key(problem)
    kept = store.get(key) if store is not None else None
    if kept is not None:
        known = _read(kept)
        if known.outcome is Outcome.UNDECIDED or _holds_still(problem, known):
            return known
    verdict = decider(problem)
    if store is not None:
        store.put(key, _written(verdict))
    return verdict


def _key(problem: Problem) -> str:
    """The digest of what is decided and of the author's hint: another hint may lead to another verdict."""
    advice = problem.advice
    if advice is None:
        return problem.sha256
    return digest([problem.sha256, advice.tape.sha256, advice.times, advice.squares, list(advice.sizes)])


def _part(
    study: Study,
    id_: str,
    values: Mapping[str, Fraction] | None,
    using: Sequence[Used],
    claim: Statement,
    hypotheses: Sequence[Statement],
    role: str = "",
    small: str | None = None,
) -> Part:
    problem = Collector(study, values).problem(claim, id_, hypotheses, small, using)
    if problem.claim.matrix is None or "congruence" not in canonical(problem.claim.matrix):
        return Part(problem, role)
    expanded = Collector(study, values).problem(claim, id_, hypotheses, small, using, expanded=True)
    return Part(problem, role, expanded)


def _verdict(part: Part, store: Store | None) -> Verdict:
    """The verdict of a part; what is not decided by its structure, by its entries."""
    verdict = remembered(part.problem, store)
    if verdict.outcome is Outcome.UNDECIDED and part.expanded is not None:
        return remembered(part.expanded, store)
    return verdict


def _holds_still(problem: Problem, known: Verdict) -> bool:
    """Does the kernel accept the certificate, and does it say what the verdict says of this very problem?

    A proof may be one of the problem with definitions closed, a witness may not.
    """
    if known.certificate is None or check_text(json.dumps(known.certificate)).status != "valid":
        return False
    by_witness = known.certificate["proof"]["kind"] == "witness"
    if known.outcome is not (Outcome.REFUTED if by_witness else Outcome.PROVED):
        return False
    conditions = [{"kind": c.kind, "of": c.of} for c in known.conditions]
    candidates = [problem] if by_witness else chain([problem], closings(problem))
    stated = known.certificate["statement"]
    return any(stated == json.loads(json.dumps(one.statement(conditions))) for one in candidates)


def _with_reason(verdict: Verdict, reason: str) -> Verdict:
    from dataclasses import replace

    return replace(verdict, reason=reason)


def _written(verdict: Verdict) -> dict[str, Any]:
    return {
        "outcome": verdict.outcome.value,
        "reason": verdict.reason,
        "method": verdict.method,
        "conditions": [[c.kind, c.of] for c in verdict.conditions],
        "certificate": verdict.certificate,
        "witness": verdict.witness,
        "residual": verdict.residual,
    }


def _read(kept: Mapping[str, Any]) -> Verdict:
    return Verdict(
        Outcome(kept["outcome"]),
        kept["reason"],
        kept["method"],
        tuple(Condition(kind, of) for kind, of in kept["conditions"]),
        kept["certificate"],
        kept["witness"],
        kept["residual"],
    )
