"""Equations: proved in the exact domain, refuted by a point."""

from __future__ import annotations

from typing import Any

from symctrl.decide import squeeze
from symctrl.decide.attempt import Attempt
from symctrl.decide.identity import residuals, vanishes
from symctrl.decide.session import Session, exactly
from symctrl.decide.solve import NoPoint
from symctrl.decide.witness import Witness, refute
from symctrl.domains.domain import Unsupported
from symctrl.problem import Problem

METHOD = "exact domain"
FIRST_TRIES = 4
MAX_RESIDUAL_SIZE = 300


def attempt(problem: Problem) -> Attempt:
    """A proof or a witness of left = right. Raises what the exact domain and the search for points raise."""
    first = _first_look(problem)
    if first is not None:
        return Attempt(witness=first, residual=_residual(problem), method=METHOD)
    try:
        proof, residual = exactly(problem, _proof)
    except Unsupported as error:
        found = refute(problem)
        if found is None:
            raise
        return Attempt(witness=found, residual=None, reason=str(error))
    if proof is not None:
        return Attempt(proof=proof, reason="left and right have the same normal form", method=METHOD)
    by_signs = exactly(problem, squeeze.proof)
    if by_signs is not None:
        return Attempt(
            proof=by_signs, reason="minus a square of the difference is not negative", method="squeeze"
        )
    found = refute(problem)
    if found is not None:
        return Attempt(witness=found, residual=residual, method=METHOD)
    return Attempt(
        reason="left minus right is not zero by the known relations, and no point was found where it differs",
        method=METHOD,
        residual=residual,
    )


def proof(problem: Problem) -> dict[str, Any] | None:
    """A proof of left = right by normal forms, or by signs; None if there is none. Raises Unsupported."""
    return exactly(problem, _proof)[0] or exactly(problem, squeeze.proof)


def _first_look(problem: Problem) -> Witness | None:
    """A witness among a few points: what is false by much is refuted before it is evaluated exactly."""
    try:
        return refute(problem, FIRST_TRIES)
    except (NoPoint, Unsupported):
        return None


def _residual(problem: Problem) -> str | None:
    """LaTeX of the first entry of left minus right that is not zero; None for a large problem."""
    if sum(len(tape.code) for tape in problem.listings.values()) > MAX_RESIDUAL_SIZE:
        return None
    try:
        return exactly(problem, _proof)[1]
    except Unsupported:
        return None


def _proof(session: Session) -> tuple[dict[str, Any] | None, str | None]:
    values = residuals(session)
    wrong = [value for value in values if not vanishes(session, value)]
    if not wrong:
        return session.proof("identity"), None
    return None, session.latex(wrong[0])
