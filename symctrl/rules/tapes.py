"""Parts of instruction lists as quantities."""

from __future__ import annotations

from collections.abc import Iterable

from symctrl.graph import Instruction, Tape


def single(tape: Tape, register: int) -> Tape:
    """One register of a tape, with the instructions that it needs."""
    needed = {register}
    for r in range(register, -1, -1):
        if r in needed:
            needed.update(tape.code[r].args)
    new = {old: n for n, old in enumerate(sorted(needed))}
    code = tuple(
        Instruction(s.op, tuple(new[a] for a in s.args), s.name, s.value)
        for r, s in enumerate(tape.code)
        if r in needed
    )
    return Tape(code, (new[register],))


def bare(state: str) -> Tape:
    """A symbol alone; in a fleet, that of node i."""
    return Tape((Instruction("INPUT", name=state.replace(".*", ".i")),), (0,))


def arguments(listings: Iterable[Tape]) -> list[Tape]:
    """What is divided by, and what roots and logarithms are taken of, as tapes of one output."""
    found = []
    for tape in listings:
        for step in tape.code:
            if step.op in ("DIV", "INV"):
                found.append(single(tape, step.args[-1]))
            elif step.op in ("SQRT", "LOG", "POW", "CONSTPOW", "ASIN", "ACOS"):
                found.append(single(tape, step.args[0]))
    return found
