"""The question: is a polynomial nonnegative on a set; and the statement of it in a certificate."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from symctrl.sos.ring import Poly, Ring, degree, rational_terms, ring
from symctrl.sos.text import check_names, names_in, parse_claim, parse_constraints


@dataclass(frozen=True)
class Problem:
    """Is `polynomial` >= 0 (strict: > 0) where each g of `nonnegative` is >= 0 and each h of `zero` is 0?"""

    names: tuple[str, ...]
    polynomial: Poly
    nonnegative: tuple[Poly, ...] = ()
    zero: tuple[Poly, ...] = ()
    strict: bool = False
    id: str = "sos"
    text: str = ""

    @cached_property
    def ring(self) -> Ring:
        return ring(self.names)

    @cached_property
    def degree(self) -> int:
        """The largest of all degrees."""
        return max(map(degree, (self.polynomial, *self.nonnegative, *self.zero)))

    @property
    def everywhere(self) -> bool:
        """Is the set the whole space?"""
        return not self.nonnegative and not self.zero

    def statement(self) -> dict[str, Any]:
        """The statement of a certificate (docs/certificates.md)."""
        return {
            "study": "sos",
            "id": self.id,
            "text": self.text,
            "variables": list(self.names),
            "polynomial": rational_terms(self.polynomial),
            "nonnegative": [rational_terms(g) for g in self.nonnegative],
            "zero": [rational_terms(h) for h in self.zero],
            "claim": "positive" if self.strict else "nonnegative",
        }


def read(
    poly: str, names: tuple[str, ...] | None, on: str = "", id_: str = "sos", where: str = ""
) -> Problem:
    """The problem that a user writes; without names its variables are those that occur. Raises InputError."""
    at = {"poly": f"{where}: poly", "on": f"{where}: on"} if where else {"poly": "POLY", "on": "--on"}
    if names is None:
        found = names_in(poly, "claim", at["poly"])
        if on.strip():
            found += [name for name in names_in(on, "constraints", at["on"]) if name not in found]
        names = check_names(found, at["poly"])
    claim = parse_claim(poly, names, at["poly"])
    relations = parse_constraints(on, names, at["on"])
    words = f"{poly if len(poly) <= 2000 else poly[:2000] + '..'}" + (
        f" on {on[:2000]}" if on.strip() else ""
    )
    return Problem(
        names,
        claim.polynomial,
        tuple(r.polynomial for r in relations if r.sign == ">="),
        tuple(r.polynomial for r in relations if r.sign == "=="),
        claim.sign == ">",
        id_,
        words,
    )
