"""Definitions and laws: they claim only that they are well formed.

Soundness-critical. Last reviewed 2026-11-24.

Relies on: a listing of known operations whose names all have a meaning, none through itself, defines a
function wherever its operations do. `certificate.load` has checked that; nothing is said about where they
do.
"""

from __future__ import annotations

from typing import Any

from symctrl.kernel.certificate import Invalid, fields
from symctrl.kernel.values import Condition, Statement


def needed_conditions(statement: Statement, proof: dict[str, Any]) -> set[Condition]:
    """None: a definition is well formed without any. Raises Invalid for another claim or proof."""
    if statement.claim.kind != "conforms":
        raise Invalid(f"a proof of kind conforms does not prove a claim of the kind {statement.claim.kind}")
    fields(proof, ("kind",), "proof")
    return set()
