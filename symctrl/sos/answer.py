"""The answer to one problem as JSON, and each in a process of its own that is ended when its time is over."""

from __future__ import annotations

import multiprocessing
import resource
import time
from multiprocessing.connection import Connection
from typing import Any

from symctrl.certify import digest, tool
from symctrl.sos.decide import Outcome, decide
from symctrl.sos.problem import Problem

FORMAT = "symctrl-sos/1"
LIMIT = 30.0  # seconds for one problem, unless another limit is asked for
_GRACE = 5.0  # seconds after the limit until a process is ended
_MEMORY = 6 * 2**30  # bytes of address space of such a process


def answer(problem: Problem, inputs: Any, limit: float = LIMIT) -> dict[str, Any]:
    """What `symctrl sos --json` writes. inputs: what its digest is taken over."""
    start = time.perf_counter()
    outcome = decide(problem, limit)
    return _as_json(problem, inputs, outcome, time.perf_counter() - start)


def answer_apart(problem: Problem, inputs: Any, limit: float = LIMIT) -> dict[str, Any]:
    """The same from a process that is ended a few seconds after the limit, whatever it is doing."""
    start = time.perf_counter()
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)
    child = context.Process(target=_send, args=(there, problem, inputs, limit), daemon=True)
    child.start()
    there.close()
    try:
        if here.poll(limit + _GRACE):
            found: dict[str, Any] = here.recv()
            child.join()
            return found
        reason = f"stopped at the limit of {limit:g} s"
    except EOFError:
        reason = "the search ended without an answer: it needs more memory than there is, or failed"
    finally:
        if child.is_alive():
            child.kill()
        here.close()
    return _as_json(problem, inputs, Outcome("undecided", reason), time.perf_counter() - start)


def _send(there: Connection, problem: Problem, inputs: Any, limit: float) -> None:
    try:
        resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
        there.send(answer(problem, inputs, limit))
    except MemoryError:
        there.close()


def _as_json(problem: Problem, inputs: Any, outcome: Outcome, seconds: float) -> dict[str, Any]:
    return {
        "format": FORMAT,
        "tool": tool(),
        "inputs_sha256": digest(inputs),
        "id": problem.id,
        "verdict": outcome.verdict,
        "certificate": outcome.certificate,
        "witness": outcome.witness,
        "reason": outcome.reason,
        "seconds": round(seconds, 6),
        "bound": None if outcome.bound is None else str(outcome.bound),
        "tried": outcome.tried,
        "vacuous": outcome.vacuous,
    }
