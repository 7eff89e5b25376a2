"""Equations that follow from assumptions by signs: minus an even power of the difference is a combination."""

from __future__ import annotations

from typing import Any

from symctrl.decide.combination import Known, entry_of
from symctrl.decide.identity import residuals
from symctrl.decide.session import Session

POWERS = (1, 2)


def proof(session: Session) -> dict[str, Any] | None:
    """The proof that each entry's difference vanishes because -(difference)^2n is not negative, or None."""
    if not session.problem.given:
        return None
    entries = []
    for value in residuals(session):
        entry = next((e for n in POWERS if (e := _entry(session, value, n)) is not None), None)
        if entry is None:
            return None
        entries.append(entry)
    return session.proof("squeeze", entries=entries)


def _entry(session: Session, value: Any, n: int) -> dict[str, Any] | None:
    power = session.domain.neg_(session.domain.power(value, 2 * n))
    variables = tuple(session.domain.simplified(value).values())
    entry = entry_of(session, power, False, Known(squares=variables))
    return None if entry is None else {"power": n} | entry
