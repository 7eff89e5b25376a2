"""Names on a page: verdicts as chips, anchors, numbers, and the claims that belong together."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from symctrl.certify import canonical
from symctrl.report.page import Chip
from symctrl.rows import Row
from symctrl.runs import file_name
from symctrl.table import ARGUMENT

SHAPES = {"proved": "proved", "refuted": "refuted", "ill-formed": "illformed", "undecided": "undecided"}
FOLDER = "certificates"  # in which the page's commands put certificates


@dataclass(frozen=True)
class Group:
    """A statement with its readings and what corrects it."""

    base: str
    rows: tuple[Row, ...]
    corrections: tuple[Row, ...]

    @property
    def form(self) -> str:
        return self.rows[0].form

    @property
    def fails(self) -> bool:
        """Is there a reading that is not proved, or is proved and does not stand?"""
        return any(row.verdict != "proved" or not row.stands for row in self.rows)

    @property
    def standing(self) -> tuple[Row, ...]:
        """What holds instead: corrections that stand, or else readings that do."""
        return tuple(r for r in self.corrections if r.stands) or tuple(r for r in self.rows if r.stands)


def base(id_: str) -> str:
    return id_.partition("[")[0]


def groups(rows: Sequence[Row]) -> tuple[Group, ...]:
    """All claims of a report, in the order of the paper."""
    own: dict[str, list[Row]] = {}
    corrections: dict[str, list[Row]] = {}
    for row in rows:
        if row.form == "corrected":
            corrections.setdefault(row.corrects or "", []).append(row)
        elif row.form not in ARGUMENT:
            own.setdefault(base(row.id), []).append(row)
    return tuple(Group(b, tuple(rs), tuple(corrections.get(b, ()))) for b, rs in own.items())


def chip(row: Row) -> Chip:
    """The verdict as printed."""
    if row.verdict == "undecided" and row.unmet:
        return Chip("broken", "proof broken")
    if row.verdict == "proved" and not row.stands:
        return Chip("undecided", "proved, does not stand")
    return Chip(SHAPES[row.verdict], row.verdict)


def standing_chip(row: Row) -> Chip:
    """Whether what is in the place of a printed claim stands."""
    if not row.stands:
        return chip(row)
    return Chip("proved", "stands, if …" if row.conditional else "stands")


def anchor(id_: str, prefix: str = "c") -> str:
    """The name of the place of a claim on the page; claims differ in what is replaced by its code."""
    safe = re.sub(r"[^A-Za-z0-9_]", lambda m: "-" if m[0] in " []" else f"-{ord(m[0]):x}-", id_)
    return f"{prefix}-{safe}"


def numbers(text: str) -> str:
    """The text with a minus sign, and not a hyphen, before numbers."""
    return re.sub(r"(?<![\w-])-(?=[\d(])", "−", text)


def decimal(value: Fraction) -> str:
    """About what the number is; empty for an integer of few digits."""
    if value.denominator == 1 and abs(value) < 10_000:
        return ""
    return numbers(f"≈ {float(value):.4g}")


def in_words(names: Sequence[str]) -> str:
    """`a, b and c`."""
    return " and ".join(filter(None, [", ".join(names[:-1]), *names[-1:]]))


def few(names: Sequence[str], most: int = 6) -> str:
    """The names; of many the first, and how many more there are."""
    kept = list(dict.fromkeys(names))
    if len(kept) <= most:
        return ", ".join(kept)
    return f"{', '.join(kept[: most - 1])} and {len(kept) - most + 1} more"


def capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def certificate_path(study: str, row: Row) -> str:
    """Where `symctrl verify --certificates` puts the certificate of a row."""
    return f"{FOLDER}/{file_name(study)}/{file_name(row.id)}.json"


def certificate_size(row: Row) -> int:
    """The bytes of that file."""
    return len(canonical(row.certificate).encode()) + 1


def certificate_kind(row: Row) -> str:
    """The kind of proof, or of the proofs of the parts."""
    made = row.certificate or {}
    parts = made.get("parts", [made])
    kinds = list(dict.fromkeys(_kind(part) for part in parts))
    return f"{len(parts)} parts, {', '.join(kinds)}" if "parts" in made else ", ".join(kinds)


def _kind(certificate: object) -> str:
    proof = certificate.get("proof", {}) if isinstance(certificate, dict) else {}
    return str(proof.get("kind", ""))


def find(rows: Sequence[Row], id_: str) -> Iterator[Row]:
    """The row of an id, or the rows of its readings."""
    return (row for row in rows if row.id == id_ or base(row.id) == id_)
