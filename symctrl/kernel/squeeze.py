"""Equality from assumptions that are not equations of the sides: a power of the difference is not positive.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: if -(a - b)^2n is nonnegative, then a = b. So an equation follows from sums of squares that vanish
and from signs: 0 = |x|^2 gives x = 0, and a^2 = b^2 with a, b >= 0 gives a = b.
"""

from __future__ import annotations

from typing import Any

from symctrl.kernel.certificate import Invalid, fields, natural, several
from symctrl.kernel.combination import prove_sign
from symctrl.kernel.sums import opened
from symctrl.kernel.values import Condition, Statement

MAX_POWER = 4


def needed_conditions(statement: Statement, proof: dict[str, Any]) -> set[Condition]:
    """The conditions under which the proof shows the claim. Raises Invalid or Declined where it does not.

    `entries` has for each entry {"power": n, "terms": ..}: the combination is that of -(left - right)^2n.
    """
    test, outputs = opened(statement, proof, ("equal",), "entries")
    field = test.replay.field
    count = len(outputs) // 2
    for k, entry in enumerate(several(proof["entries"], count, "entries")):
        where = f"entry {k}"
        table = fields(entry, ("power", "terms"), where, optional=("times",))
        n = natural(table["power"], MAX_POWER + 1, where)
        if n == 0:
            raise Invalid(f"{where}: the power 0 says nothing of the difference")
        difference = field.sub(outputs[k], outputs[count + k])
        power = field.power(field.mul(difference, difference), n)
        terms = {key: part for key, part in table.items() if key != "power"}
        prove_sign(test, field.neg(power), terms, False, where)
    return test.replay.close()
