"""What a decider found: a proof for the kernel, or a witness, or neither."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from symctrl.decide.witness import Witness


@dataclass(frozen=True)
class Attempt:
    """proof: of the claim. witness: against it. reason: in words. residual: LaTeX of left minus right of an
    identity.
    """

    proof: Mapping[str, Any] | None = None
    witness: Witness | None = None
    reason: str = ""
    method: str = ""
    residual: str | None = None
