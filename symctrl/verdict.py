"""What a decision says: an outcome, why, and the evidence that stands without us."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any


class Outcome(StrEnum):
    """proved: a certificate that the kernel accepts. refuted: an exact witness. ill-formed: the claim has no
    meaning as written. undecided: neither was found; the reason says what was tried."""

    PROVED = "proved"
    REFUTED = "refuted"
    ILL_FORMED = "ill-formed"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Condition:
    """What a proof needs beyond the assumptions: `of` is `kind` (nonzero, nonnegative or positive)."""

    kind: str
    of: str

    def __str__(self) -> str:
        sign = {"nonzero": "!= 0", "nonnegative": ">= 0", "positive": "> 0"}[self.kind]
        return f"{self.of} {sign}"


@dataclass(frozen=True)
class Verdict:
    """The answer to one claim.

    certificate: of a proof, or of a refutation by a witness; None where there is neither.
    witness: exact values of all symbols at which the claim fails, as strings "p/q" (and the graph of a
    fleet).
    residual: LaTeX of left minus right where an identity fails.
    """

    outcome: Outcome
    reason: str
    method: str = ""
    conditions: tuple[Condition, ...] = ()
    certificate: Mapping[str, Any] | None = field(default=None, repr=False)
    witness: Mapping[str, Any] | None = None
    residual: str | None = None

    def _repr_html_(self) -> str:
        from symctrl import notebook

        return notebook.verdict(self)
