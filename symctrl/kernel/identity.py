"""Proofs that two matrices are equal.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: two values are equal wherever both are defined if their difference, over a common denominator that
vanishes nowhere, has a numerator in the ideal of the relations that hold (`field`); with sums over a graph,
if the difference cancels at each node and along each edge (`sums`). What it takes that both are defined is
what is given and the conditions of the statement.
"""

from __future__ import annotations

from typing import Any

from symctrl.kernel.certificate import Condition, Invalid, Statement, fields
from symctrl.kernel.replay import Replay, require_conditions
from symctrl.kernel.sums import SumIdentity, SymbolSums


def verify(statement: Statement, proof: dict[str, Any]) -> None:
    """Raises Invalid or Declined unless the proof shows the claim under exactly the stated conditions."""
    require_conditions(statement, needed_conditions(statement, proof))


def needed_conditions(statement: Statement, proof: dict[str, Any]) -> set[Condition]:
    """The conditions under which the proof shows the claim, whatever the statement lists. Raises likewise."""
    if statement.claim.kind != "equal":
        raise Invalid(f"an identity does not prove a claim of the kind {statement.claim.kind}")
    fields(proof, ("kind", "generators", "factors", "hints"), "proof")
    sums = SymbolSums()
    replay = Replay(statement, proof, sums)
    sums.replay = replay
    replay.assume_given()
    values = replay.claim()
    test = SumIdentity(replay, sums)
    rows, columns = statement.claim.shape
    count = rows * columns
    for k in range(count):
        where = f"entry [{k % rows + 1},{k // rows + 1}]"
        test.require_zero(replay.field.sub(values[k], values[count + k]), where)
    return replay.close()
