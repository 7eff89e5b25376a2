"""Proofs that two matrices are equal.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: two values are equal wherever both are defined if their difference, over a common denominator that
vanishes nowhere, has a numerator in the ideal of the relations that hold (`field`); with sums over a graph,
if the difference cancels at each node and along each edge (`sums`). What it takes that both are defined is
what is given and the conditions of the statement.
"""

from __future__ import annotations

from typing import Any

from symctrl.kernel.sums import opened
from symctrl.kernel.values import Condition, Statement


def needed_conditions(statement: Statement, proof: dict[str, Any]) -> set[Condition]:
    """The conditions under which the proof shows the claim. Raises Invalid or Declined where it does not."""
    test, values = opened(statement, proof, ("equal",))
    rows, columns = statement.claim.shape
    count = rows * columns
    for k in range(count):
        where = f"entry [{k % rows + 1},{k // rows + 1}]"
        test.require_zero(test.replay.field.sub(values[k], values[count + k]), where)
    return test.replay.close()
