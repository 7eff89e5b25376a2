"""The checker: from the text of a certificate to an answer and the statement that was verified.

Soundness-critical. Last reviewed 2026-11-24.

Relies on the files that it dispatches to, one for each kind of proof. The statement is printed from what was
checked, never from words that the certificate brings without quoting them as such.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

from symctrl.kernel.certificate import MAX_TEXT, Certificate, Condition, Declined, Invalid, Unreadable, load
from symctrl.kernel.printing import line, print_statement

# The module that verifies each kind of proof, by `verify(statement, proof)`.
PROOFS = {
    "identity": "symctrl.kernel.identity",
    "combination": "symctrl.kernel.combination",
    "definite": "symctrl.kernel.definite",
    "conforms": "symctrl.kernel.conforms",
    "witness": "symctrl.kernel.witness",
    "squeeze": "symctrl.kernel.squeeze",
}
BUNDLE_FORMAT = "symctrl-certificates/1"
MAX_PARTS = 1000
EXIT_CODES = {"valid": 0, "invalid": 1, "unreadable": 2, "declined": 3}
SEVERITY = ("unreadable", "invalid", "declined", "valid")  # worst first


@dataclass(frozen=True)
class Answer:
    """`status` is valid, invalid, declined or unreadable; `statement` is "" where it cannot be read."""

    status: str
    statement: str
    reason: str


def check_text(text: str) -> Answer:
    """Decide a certificate. No input makes it raise."""
    statement = ""
    try:
        certificate = load(text)
        statement = print_statement(certificate.statement, refuted=certificate.proof.get("kind") == "witness")
        reason = _verify(certificate)
        return Answer("valid", statement, reason)
    except Unreadable as error:
        return Answer("unreadable", statement, line(str(error)))
    except Invalid as error:
        return Answer("invalid", statement, line(str(error)))
    except Declined as error:
        return Answer("declined", statement, line(str(error)))
    except (RecursionError, MemoryError) as error:
        return Answer(
            "declined", statement, f"the check exceeds the limits of this machine: {type(error).__name__}"
        )
    except Exception as error:
        return Answer("declined", statement, line(f"the kernel failed: {type(error).__name__}: {error}"))


def needed_conditions(text: str) -> list[Condition]:
    """The conditions that the proof of a certificate needs, whatever its statement lists, in a fixed order.

    Raises Unreadable, Invalid or Declined where the proof is none.
    """
    certificate = load(text)
    module = import_module(PROOFS[str(certificate.proof.get("kind"))])
    needed = module.needed_conditions(certificate.statement, certificate.proof)
    return sorted(needed, key=lambda condition: (condition.kind, condition.of))


def _verify(certificate: Certificate) -> str:
    kind = certificate.proof.get("kind")
    if not isinstance(kind, str) or kind not in PROOFS:
        raise Declined(f"a proof of the kind {str(kind)[:60]!r} is not known")
    import_module(PROOFS[kind]).verify(certificate.statement, certificate.proof)
    return f"verified by its {kind}"


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
