"""Bounds: each entry is nonnegative, or positive, by a combination of assumptions and squares; refuted by a
point.
"""

from __future__ import annotations

from typing import Any

from symctrl.decide.attempt import Attempt
from symctrl.decide.combination import Known, entry_of, form_of
from symctrl.decide.session import Session, exactly
from symctrl.decide.witness import refute
from symctrl.domains.domain import Unsupported
from symctrl.problem import ADVICE, Problem

TRIES = 400


def attempt(problem: Problem) -> Attempt:
    """A proof or a witness of entries >= 0 (> 0). Raises what the exact domain and the search for points
    raise.
    """
    reason = "no combination of the assumptions was found that proves it"
    try:
        found_proof = proof(problem)
        if found_proof is not None:
            return Attempt(
                proof=found_proof, reason="a combination of assumptions and squares", method="combination"
            )
    except Unsupported as error:
        reason = str(error)
    found = refute(problem, TRIES)
    if found is not None:
        return Attempt(witness=found)
    return Attempt(reason=f"{reason}, and none of {TRIES} points refutes it", method="combination")


def proof(problem: Problem) -> dict[str, Any] | None:
    """A proof of entries >= 0 (> 0); None if there is none. Raises Unsupported."""
    return exactly(problem, lambda session: _proof(session, problem.claim.kind == "positive"))


def _proof(session: Session, strict: bool) -> dict[str, Any] | None:
    entries = []
    known = _known(session)
    for value in session.claim():
        entry = entry_of(session, value, strict, known)
        if entry is None:
            return None
        entries.append(entry)
    return session.proof("combination", entries=entries)


def _known(session: Session) -> Known:
    """The author's advice, evaluated. A form whose matrix is not assumed to be definite is left out."""
    advice = session.problem.advice
    if advice is None:
        return Known()
    values = list(session.environment.outputs(ADVICE, {"i": "i", "j": "j"}))
    times = session.carrier(values.pop(0)) if advice.times else None
    squares = tuple(session.carrier(values.pop(0)) for _ in range(advice.squares))
    forms = []
    for n in advice.sizes:
        matrix, x = values[: n * n], values[n * n : n * n + n]
        values = values[n * n + n :]
        form = form_of(session, matrix, x)
        if form is not None:
            forms.append(form)
    return Known(times, squares, tuple(forms))
