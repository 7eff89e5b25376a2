"""What a line of an argument names: its quantities by the role that they play.

Soundness-critical. Last reviewed 2026-11-24.

Relies on no theorem. Every role that a line brings must be read by its rule.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from symctrl.kernel.certificate import Invalid, typed


class Roles:
    """The quantities of a line. known: all that there are."""

    def __init__(self, table: Any, known: Collection[str], where: str) -> None:
        self.table: dict[str, Any] = typed(table, dict, where)
        self.known = known
        self.where = where
        self.read: set[str] = set()

    def one(self, role: str) -> str:
        self.read.add(role)
        return self._quantity(self.table.get(role), role)

    def maybe(self, role: str) -> str | None:
        return self.one(role) if role in self.table else None

    def many(self, role: str) -> list[str]:
        """In the order of the line; none where the role is left out."""
        self.read.add(role)
        return [self._quantity(entry, role) for entry in typed(self.table.get(role, []), list, self.where)]

    def numbers(self, role: str) -> dict[str, Any]:
        """A table of exact numbers by symbol, as it stands."""
        self.read.add(role)
        return typed(self.table.get(role, {}), dict, self.where)

    def word(self, role: str, allowed: Collection[str]) -> str:
        self.read.add(role)
        if self.table.get(role) not in allowed:
            raise Invalid(f"{self.where}: {role} is one of {', '.join(sorted(allowed))}")
        return str(self.table[role])

    def close(self) -> None:
        idle = sorted(set(self.table) - self.read)
        if idle:
            raise Invalid(f"{self.where}: the rule has no role {idle[0][:60]!r}")

    def _quantity(self, value: Any, role: str) -> str:
        if type(value) is not str or value not in self.known:
            raise Invalid(f"{self.where}: {role} is no quantity of the argument")
        return value
