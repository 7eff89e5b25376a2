"""A claim as pure data: instruction lists, what each name means, assumptions, and what is claimed.

A `Problem` is all that a decision needs: it knows no CasADi. Its JSON form is the statement of a certificate.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from symctrl.certify import canonical
from symctrl.graph import Tape

Output = tuple[str, int]  # output k of a listing
ADVICE = "advice"
PROVED = "statement"  # what an assumption is about that is a proved statement
LEMMA = "lemma"  # what an assumption is about that a line of an argument has shown
OBLIGATION = "obligation"  # what an assumption is about that belongs to one obligation of a rule


@dataclass(frozen=True)
class Meaning:
    """What a name stands for: `is_` is constant, value, rate, sum (over neighbours) or total (over nodes)."""

    is_: str
    of: Output | None = None
    law: str | None = None
    value: str | None = None

    def as_json(self) -> dict[str, Any]:
        if self.is_ == "constant":
            return {"is": "constant", "value": self.value}
        assert self.of is not None
        meaning: dict[str, Any] = {"is": self.is_, "of": list(self.of)}
        return meaning | {"law": self.law} if self.is_ == "rate" else meaning


@dataclass(frozen=True)
class Assumption:
    """`kind` is zero, nonzero, positive, nonnegative, positive_definite or positive_semidefinite.

    of: one output, or size² of them, column by column. about: parameter, initial, signal or trajectory.
    """

    kind: str
    of: tuple[Output, ...]
    text: str
    about: str = "parameter"
    size: int = 1

    def as_json(self) -> dict[str, Any]:
        shared = {"kind": self.kind, "text": self.text, "about": self.about}
        if self.kind.startswith("positive_"):
            return shared | {"size": self.size, "of": [list(o) for o in self.of]}
        return shared | {"of": list(self.of[0])}


@dataclass(frozen=True)
class Claim:
    """`kind` is equal, nonnegative, positive, positive_definite, positive_semidefinite, conforms or theorem.

    matrix: for definiteness, the tree of docs/certificates.md. small: a gain; the claim is for its small
    positive values. theorem: the law of the closed loop, and what is supposed and concluded of its solutions.
    """

    kind: str
    listing: str
    shape: tuple[int, int] = (1, 1)
    matrix: Mapping[str, Any] | None = None
    small: str | None = None
    theorem: Mapping[str, Any] | None = None

    def __post_init__(self) -> None:
        if self.small is not None and self.matrix is None:
            raise ValueError(f"a claim of the kind {self.kind} cannot be for small values of {self.small}")

    def as_json(self) -> dict[str, Any]:
        if self.matrix is not None:
            small = {"small": self.small} if self.small is not None else {}
            return {"kind": self.kind, "matrix": self.matrix, "listing": self.listing} | small
        if self.theorem is not None:
            return {"kind": self.kind, "listing": self.listing} | dict(self.theorem)
        return {"kind": self.kind, "shape": list(self.shape), "listing": self.listing}


@dataclass(frozen=True)
class Advice:
    """An author's hint for a bound, as a listing beside the statement: [times], squares, then for each form P
    and x.

    sizes: of the vectors of the forms.
    """

    tape: Tape
    times: bool
    squares: int
    sizes: tuple[int, ...]


@dataclass(frozen=True)
class Use:
    """A proved statement that the claim rests on, by id and by the digest of its problems.

    listing: what came of it.
    """

    id: str
    sha256: str
    listing: str


@dataclass(frozen=True)
class Problem:
    study: str
    id: str
    text: str
    listings: Mapping[str, Tape]
    claim: Claim
    scalars: Mapping[str, str] = field(default_factory=dict)
    names: Mapping[str, Meaning] = field(default_factory=dict)
    motion: Mapping[str, Output] = field(default_factory=dict)
    laws: Mapping[str, Mapping[str, Output]] = field(default_factory=dict)
    given: tuple[Assumption, ...] = ()
    advice: Advice | None = None
    uses: tuple[Use, ...] = ()

    def tape(self, listing: str) -> Tape:
        """The instruction list of that name; the one of the advice is called "advice"."""
        if listing == ADVICE and self.advice is not None:
            return self.advice.tape
        return self.listings[listing]

    def statement(self, conditions: Sequence[Mapping[str, str]] = ()) -> dict[str, Any]:
        """The `statement` of a certificate."""
        uses = [{"id": use.id, "sha256": use.sha256} for use in self.uses]
        return ({"uses": uses} if uses else {}) | {
            "study": self.study,
            "id": self.id,
            "text": self.text,
            "listings": {
                name: tape.as_json() | {"sha256": tape.sha256} for name, tape in self.listings.items()
            },
            "scalars": dict(self.scalars),
            "names": {name: meaning.as_json() for name, meaning in self.names.items()},
            "motion": {name: list(of) for name, of in self.motion.items()},
            "laws": {law: {name: list(of) for name, of in what.items()} for law, what in self.laws.items()},
            "given": [assumption.as_json() for assumption in self.given],
            "claim": self.claim.as_json(),
            "conditions": [dict(c) for c in conditions],
        }

    @property
    def sha256(self) -> str:
        """Digest of the whole statement before conditions: the key under which a verdict is kept."""
        return hashlib.sha256(canonical(self.statement()).encode()).hexdigest()


def star(name: str) -> str:
    """The name with its node, if it has one, replaced by *: `q.i[1]` becomes `q.*[1]`."""
    base, node, index = split(name)
    return name if node is None else f"{base}.*{index}"


def split(name: str) -> tuple[str, str | None, str]:
    """Symbol, node (None outside fleets) and index of a scalar's name: `q.i[1]` is ("q", "i", "[1]")."""
    head, bracket, index = name.rstrip("'").partition("[")
    base, dot, node = head.partition(".")
    return base, node if dot else None, bracket + index
