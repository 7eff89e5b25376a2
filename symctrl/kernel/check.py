"""The checker: from the text of a certificate to an answer and the statement that was verified.

Soundness-critical. Last reviewed 2026-11-24.

Relies on the files that it dispatches to, one for each kind of proof. The statement is printed from what was
checked, never from words that the certificate brings without quoting them as such.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from symctrl.kernel import (
    against,
    combination,
    conforms,
    definite,
    identity,
    laplacian,
    sos,
    squeeze,
    theorem,
    total,
    witness,
)
from symctrl.kernel.certificate import Declined, Invalid, Refused, text_field, typed
from symctrl.kernel.loading import MAX_TEXT, load, opened, read, read_all
from symctrl.kernel.printing import line, print_statement
from symctrl.kernel.values import Certificate, Condition, Statement

# The function of each kind of proof that checks it and gives the conditions it needs. Others may be added.
Rules = Callable[[Statement, dict[str, Any]], set[Condition]]
PROOFS: dict[str, Rules] = {
    "identity": identity.needed_conditions,
    "combination": combination.needed_conditions,
    "definite": definite.needed_conditions,
    "conforms": conforms.needed_conditions,
    "witness": witness.needed_conditions,
    "squeeze": squeeze.needed_conditions,
    "each": total.needed_conditions_each,
    "spectral": total.needed_conditions_spectral,
    "argument": theorem.needed_conditions,
    "against": against.needed_conditions,
}
# Statements with a form of their own: each of these modules knows its own, reads, prints and verifies it.
OTHERS: tuple[Any, ...] = (laplacian, sos)
REFUTING = ("witness", "against")
EXIT_CODES = {"valid": 0, "invalid": 1, "unreadable": 2, "declined": 3}
SEVERITY = ("unreadable", "invalid", "declined", "valid")  # worst first


@dataclass(frozen=True)
class Answer:
    """`status` is valid, invalid, declined or unreadable; `statement` is "" where it cannot be read."""

    status: str
    statement: str
    reason: str


def check_text(text: str) -> Answer:
    """Decide a certificate, or a bundle: it is valid if every part is. No input makes it raise."""
    return _attempt(_decide_all, text)


def _decide_all(text: str) -> Answer:
    answers = [_attempt(_decide, part) for part in read_all(text)]
    return answers[0] if len(answers) == 1 else _together(answers)


def _attempt(work: Callable[[Any], Answer], about: Any) -> Answer:
    """The answer of the work, or the one that its exception amounts to."""
    try:
        return work(about)
    except Refused as error:
        return Answer(error.status, "", line(str(error)))
    except (RecursionError, MemoryError) as error:
        reason = f"the check exceeds the limits of this machine: {type(error).__name__}"
        return Answer("declined", "", reason)
    except Exception as error:
        return Answer("declined", "", line(f"the kernel failed: {type(error).__name__}: {error}"))


def _decide(part: Any) -> Answer:
    for rules in OTHERS:
        if type(part) is dict and rules.is_meant(part.get("statement")):
            return _decide_other(part, rules)
    certificate = read(part)
    statement = print_statement(certificate.statement, refuted=certificate.proof.get("kind") in REFUTING)
    done = _attempt(_verify, certificate)
    return Answer(done.status, statement, done.reason)


def _decide_other(part: Any, rules: Any) -> Answer:
    """A statement that has a form of its own, with proofs of its own."""
    top = opened(part)
    text_field(top["tool"], "tool")
    proof = typed(top["proof"], dict, "proof")
    statement = rules.read_statement(top["statement"])
    kind = proof.get("kind")
    text = rules.print_statement(statement, refuted=kind in REFUTING)
    done = _attempt(lambda _: _answer_other(statement, proof, rules), None)
    return Answer(done.status, text, done.reason)


def _answer_other(statement: Any, proof: dict[str, Any], rules: Any) -> Answer:
    rules.verify(statement, proof)
    return Answer("valid", "", f"verified by its {proof['kind']}")


def _together(parts: Sequence[Answer]) -> Answer:
    """The worst part counts; the statements one after another."""
    texts = [f"part {k} of {len(parts)}: {part.statement}" for k, part in enumerate(parts, start=1)]
    worst = min(parts, key=lambda part: SEVERITY.index(part.status))
    if worst.status == "valid":
        reasons = ", ".join(dict.fromkeys(part.reason for part in parts))
        return Answer("valid", "\n".join(texts), f"{len(parts)} parts, {reasons}")
    reason = f"part {parts.index(worst) + 1} of {len(parts)}: {worst.reason}"
    return Answer(worst.status, "\n".join(texts), reason)


def needed_conditions(text: str) -> list[Condition]:
    """The conditions that the proof of a certificate needs, whatever its statement lists, in a fixed order.

    Raises Unreadable, Invalid or Declined where the proof is none.
    """
    return sorted(_needed(load(text)), key=lambda condition: (condition.kind, condition.of))


def _needed(certificate: Certificate) -> set[Condition]:
    kind = certificate.proof.get("kind")
    if not isinstance(kind, str) or kind not in PROOFS:
        raise Declined(f"a proof of the kind {str(kind)[:60]!r} is not known")
    return PROOFS[kind](certificate.statement, certificate.proof)


def verify(certificate: Certificate) -> None:
    """Raises Invalid or Declined unless the proof shows the claim under exactly the stated conditions."""
    needed, listed = _needed(certificate), set(certificate.statement.conditions)
    for missing in sorted(needed - listed, key=str):
        raise Invalid(f"the condition that {missing.of[:200]} is {missing.kind} is needed and not stated")
    for idle in sorted(listed - needed, key=str):
        raise Invalid(f"the condition that {idle.of[:200]} is {idle.kind} is stated and not needed")


def _verify(certificate: Certificate) -> Answer:
    verify(certificate)
    return Answer("valid", "", f"verified by its {certificate.proof['kind']}")


def check_file(path: str | Path) -> Answer:
    """Decide the certificate in a file; a file that cannot be read as text is unreadable."""
    try:
        with Path(path).open(encoding="utf-8") as stream:
            text = stream.read(MAX_TEXT + 1)
    except (OSError, UnicodeError, ValueError) as error:
        return Answer("unreadable", "", line(f"{type(error).__name__}: {error}"))
    except MemoryError:
        return Answer("declined", "", "the file is too large for this machine")
    return check_text(text)


def exit_code(answers: Sequence[Answer]) -> int:
    """Of several answers the worst counts: 2 unreadable, 1 invalid, 3 declined, 0 all valid; of none, 2."""
    for status in SEVERITY:
        if any(answer.status == status for answer in answers):
            return EXIT_CODES[status]
    return EXIT_CODES["unreadable"]
