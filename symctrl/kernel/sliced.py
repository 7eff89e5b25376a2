"""A statement in which each listing has one output, with the instructions that this output needs.

Soundness-critical. Last reviewed 2026-11-24.

Relies on no theorem: what an output does not need has no part in its value, not even where it has none
itself.
"""

from __future__ import annotations

from dataclasses import replace

from symctrl.kernel.argument import single
from symctrl.kernel.values import Ref, Statement


def sliced(statement: Statement) -> Statement:
    """The motion, laws and names of the statement, over such listings."""
    return replace(
        statement,
        listings={
            slice_of((name, k))[0]: single(listing, k)
            for name, listing in statement.listings.items()
            for k in range(len(listing.outputs))
        },
        names={
            name: meaning if meaning.kind == "constant" else replace(meaning, of=slice_of(meaning.of))
            for name, meaning in statement.names.items()
        },
        motion={key: slice_of(ref) for key, ref in statement.motion.items()},
        laws={law: {u: slice_of(ref) for u, ref in table.items()} for law, table in statement.laws.items()},
    )


def slice_of(ref: Ref) -> Ref:
    """The position comes first, so that no two of them have one name."""
    return f"{ref[1]}#{ref[0]}", 0
