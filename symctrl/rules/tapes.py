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


INFIX = {"ADD": " + ", "SUB": " - ", "MUL": "*", "DIV": "/"}


def said(tape: Tape) -> str:
    """The only output of a tape as text."""
    texts: list[str] = []
    for step in tape.code:
        args = [texts[a] for a in step.args]
        whole = [text if text.isidentifier() or _is_closed(text) else f"({text})" for text in args]
        if step.op == "INPUT":
            texts.append(step.name)
        elif step.op == "CONST":
            texts.append(str(step.value))
        elif step.op in INFIX:
            left, right = (args[0], whole[1]) if step.op in ("ADD", "SUB") else whole
            texts.append(f"{left}{INFIX[step.op]}{right}")
        elif step.op in ("NEG", "SQ", "TWICE", "INV"):
            texts.append(
                {"NEG": "-{}", "SQ": "{}^2", "TWICE": "2*{}", "INV": "1/{}"}[step.op].format(whole[0])
            )
        elif step.op in ("POW", "CONSTPOW"):
            texts.append(f"{whole[0]}^{whole[1]}")
        else:
            texts.append(f"{step.op.lower()}({', '.join(args)})")
    return texts[tape.outputs[0]]


def _is_closed(text: str) -> bool:
    """Is it a name, a number or a call, that needs no brackets beside an operation?"""
    depth = 0
    for k, letter in enumerate(text):
        depth += {"(": 1, ")": -1}.get(letter, 0)
        if depth == 0 and (letter in "+-*/^ " or (letter == ")" and k < len(text) - 1)):
            return False
    return True
