"""Certificates as values.

Soundness-critical. Last reviewed 2026-11-24.

Relies on no theorem, but everything else relies on it: what a certificate claims is read off these values
and from nowhere else.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from symctrl.kernel.certificate import split_name

Ref = tuple[str, int]  # output k (from 0) of a listing


@dataclass(frozen=True, slots=True)
class Step:
    """One instruction: `args` are registers, `name` belongs to INPUT and `value` to CONST."""

    op: str
    args: tuple[int, ...] = ()
    name: str = ""
    value: Fraction = Fraction(0)


@dataclass(frozen=True, slots=True)
class Listing:
    code: tuple[Step, ...]
    outputs: tuple[int, ...]
    sha256: str

    @property
    def letters(self) -> frozenset[str]:
        """The node letters that the names of its inputs mention."""
        found = (split_name(step.name)[1] for step in self.code if step.op == "INPUT")
        return frozenset(letter for letter in found if letter)


@dataclass(frozen=True, slots=True)
class Meaning:
    """What a name stands for: `kind` is constant, value, rate, sum or total."""

    kind: str
    value: Fraction = Fraction(0)
    of: Ref = ("", 0)
    law: str | None = None


@dataclass(frozen=True, slots=True)
class Assumption:
    """`of` has one reference for a sign kind, size*size of them (column by column) for a definite kind."""

    kind: str
    of: tuple[Ref, ...]
    size: int = 1
    text: str = ""
    about: str = ""


@dataclass(frozen=True, slots=True)
class Claim:
    """`matrix` is the checked tree of positions of the outputs for a definite kind, else None.

    Of a theorem: the law of the closed loop, what is supposed of solutions, and what then holds for all of
    them.
    """

    kind: str
    listing: str
    shape: tuple[int, int]
    matrix: Any = None
    small: str | None = None
    law: str | None = None
    suppose: tuple[Sentence, ...] = ()
    then: tuple[Sentence, ...] = ()


@dataclass(frozen=True, slots=True)
class Sentence:
    """A word about outputs of the claim's listing; zero: the set where they vanish, else where they are >= 0.

    by: the output that is a time, a bound or a rate. at: the numbers of a point, by state.
    """

    word: str
    of: tuple[int, ...]
    zero: bool = False
    by: int | None = None
    at: tuple[tuple[str, Fraction], ...] = ()


@dataclass(frozen=True, slots=True)
class Condition:
    kind: str
    of: str


@dataclass(frozen=True, slots=True)
class Use:
    """A proved statement that an assumption or a replaced name came from; this proof does not lean on it."""

    id: str
    sha256: str


@dataclass(frozen=True, slots=True)
class Statement:
    """All that is claimed; a table's keys have the node written `*`."""

    study: str
    id: str
    text: str
    listings: Mapping[str, Listing]
    scalars: Mapping[str, str]
    names: Mapping[str, Meaning]
    motion: Mapping[str, Ref]
    laws: Mapping[str, Mapping[str, Ref]]
    given: tuple[Assumption, ...]
    claim: Claim
    conditions: tuple[Condition, ...]
    uses: tuple[Use, ...] = ()
    along: bool = False  # rates are those along solutions, where |a| has the rate s a' for any s if a = 0


@dataclass(frozen=True, slots=True)
class Certificate:
    tool: str
    statement: Statement
    proof: dict[str, Any]
