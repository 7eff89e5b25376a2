"""What `verify` says of a study: one row for each claim, with the fields that other programs read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass(frozen=True)
class Units:
    consistent: bool
    mismatch: str | None = None
    inferred: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Twins:
    """Negative twins: how many were made, the text of those that are true all the same, and of those that
    counted as not proved because an error ended the attempt, with the error.
    """

    tried: int
    still_true: tuple[str, ...] = ()
    failed: tuple[str, ...] = ()


@dataclass(frozen=True)
class Numeric:
    """Second evidence in floating point: the largest residual relative to the largest intermediate value."""

    samples: int
    max_residual: float


@dataclass(frozen=True)
class Given:
    text: str
    about: str  # parameter, initial, signal or trajectory


@dataclass(frozen=True)
class Discharged:
    """A condition of the verdict and who vouches for it: an assumption, a statement's id, or nobody."""

    condition: str
    by: str | None


@dataclass(frozen=True)
class Row:
    id: str
    equation: str
    statement: str
    latex: str
    form: str  # printed, corrected, claimed, definition, law, step, obligation, fact
    corrects: str | None
    kind: str
    verdict: str
    stands: bool
    conditional: bool
    reason: str
    method: str
    reading: str | None = None
    given: tuple[Given, ...] = ()
    conditions: tuple[Discharged, ...] = ()
    holds_for: str = "all"
    rule: str | None = None
    role: str | None = None
    rests_on: tuple[str, ...] = ()
    unmet: tuple[str, ...] = ()
    blocked_by: str | None = None
    units: Units | None = None
    twins: Twins | None = None
    shown: tuple[str, ...] = ()  # assumptions about the trajectory, of what it rests on, that it shows
    witness: Mapping[str, Any] | None = None
    certificate: Mapping[str, Any] | None = field(default=None, repr=False)
    numeric: Numeric | None = None
    residual: str | None = None
    settled: bool = True
    point_known: bool = True
    finding: str | None = None
    seconds: float = 0.0

    def as_json(self) -> dict[str, Any]:
        return asdict(self)

    def _repr_html_(self) -> str:
        from symctrl import notebook

        return notebook.row(self)


@dataclass(frozen=True, repr=False)
class Report:
    """All rows of one study, what the paper numbers and the study has not entered, and the inputs' digest."""

    study: str
    source: str
    graph: str | None
    rows: tuple[Row, ...]
    missing: tuple[str, ...]
    inputs_sha256: str
    seconds: float

    @property
    def settled(self) -> bool:
        return all(row.settled for row in self.rows)

    def __repr__(self) -> str:
        return (
            f"<report on {self.study}: {len(self.rows)} rows, {'settled' if self.settled else 'not settled'}>"
        )

    def as_json(self, tool: str) -> dict[str, Any]:
        return {
            "format": "symctrl-verify/1",
            "tool": tool,
            "study": self.study,
            "graph": self.graph,
            "inputs_sha256": self.inputs_sha256,
            "claims": [row.as_json() for row in self.rows],
            "missing": list(self.missing),
            "seconds": self.seconds,
        }

    def _repr_html_(self) -> str:
        from symctrl import notebook

        return notebook.report(self)
