"""A report page as data: what the templates print, in the order of the page. Nothing is decided here."""

from __future__ import annotations

from dataclasses import dataclass

from markupsafe import Markup


@dataclass(frozen=True)
class Chip:
    """A verdict as it is always shown: shape, which has a colour, and word."""

    shape: str  # proved, refuted, illformed, undecided or broken
    word: str


@dataclass(frozen=True)
class Link:
    """A link inside the page, or into no place at all where the target is not on it."""

    text: str
    target: str | None = None


@dataclass(frozen=True)
class Mark:
    """One claim in the verdict strip: its verdict as printed and what stands in its place."""

    label: str
    target: str
    printed: Chip | None
    corrected: Chip | None


@dataclass(frozen=True)
class MarkGroup:
    """The claims of one equation in the strip."""

    equation: str
    marks: tuple[Mark, ...]


@dataclass(frozen=True)
class Count:
    chip: Chip
    number: int


@dataclass(frozen=True)
class Header:
    title: str
    study: str
    source: str
    lead: tuple[str, ...]
    strip: tuple[MarkGroup, ...]
    printed: tuple[Count, ...]
    corrected: tuple[Count, ...]
    entered: str


@dataclass(frozen=True)
class Note:
    """What a finding means for a reader: "If you ..", the author's sentence, what holds instead."""

    head: str
    text: str
    link: Link


@dataclass(frozen=True)
class ClaimLine:
    anchor: str
    id: str
    equation: str
    sentence: str
    formula: Markup
    long: bool  # is the formula folded away?
    more: str
    reading: str | None
    printed: Chip | None
    corrected: Chip | None
    evidence: Link
    attention: bool


@dataclass(frozen=True)
class Formula:
    """A formula of the study with its number; where it is corrected, both and why."""

    anchor: str
    equation: str
    printed: Markup
    chip: Chip
    corrected: Markup | None = None
    why: str | None = None
    reason: str | None = None


@dataclass(frozen=True)
class SymbolLine:
    symbol: Markup
    kind: str
    value: str
    unit: str


@dataclass(frozen=True)
class StudyBlock:
    motions: tuple[Markup, ...]
    formulas: tuple[Formula, ...]
    symbols: tuple[SymbolLine, ...]


@dataclass(frozen=True)
class Leaf:
    """What a line or a statement of the proof graph rests on. cut: it is refuted, and the link with it."""

    chip: Chip
    text: str
    cut: bool = False
    target: str | None = None


@dataclass(frozen=True)
class Branch:
    """A line of an argument, or a statement that a theorem uses, with what it rests on."""

    chip: Chip
    text: str
    leaves: tuple[Leaf, ...]
    more: str = ""  # what else it rests on, in few words
    detail: str = ""  # what the line says
    cut: bool = False
    tainted: bool = False
    target: str | None = None


@dataclass(frozen=True)
class Limb:
    """The lines of one argument, or the statements that are used, under a heading."""

    heading: str
    branches: tuple[Branch, ...]


@dataclass(frozen=True)
class Tree:
    """A theorem and what it rests on."""

    side: str  # "As printed" or "Corrected"
    chip: Chip
    equation: str
    name: str
    target: str
    summary: str
    limbs: tuple[Limb, ...]
    drawing: Markup | None = None


@dataclass(frozen=True)
class ProofPair:
    equation: str
    trees: tuple[Tree, ...]


@dataclass(frozen=True)
class Value:
    """A symbol's exact value in a witness."""

    symbol: Markup
    value: str
    unit: str


@dataclass(frozen=True)
class Script:
    """A program that evaluates a witness: its text, or, where it is long, the command that runs the general
    one on the certificate. why_not: why there is none.
    """

    text: str = ""
    command: str = ""
    why_not: str = ""


@dataclass(frozen=True)
class WitnessBlock:
    values: tuple[Value, ...]
    zeros: str
    graph: str | None
    outcome: tuple[str, ...]
    hypotheses: tuple[str, ...]
    script: Script
    again: bool = False  # are the values those of an earlier reading?


@dataclass(frozen=True)
class CertificateBlock:
    of: str
    kind: str
    size: int
    sha256: str
    command: str


@dataclass(frozen=True)
class TwinsBlock:
    tried: int
    refuted: int
    still_true: tuple[str, ...]


@dataclass(frozen=True)
class Reading:
    """One reading of a printed statement, with its verdict."""

    name: str | None
    chip: Chip
    formula: Markup
    reason: str
    through: tuple[Link, ...]  # corrected definitions through which it fails
    witness: WitnessBlock | None
    certificate: CertificateBlock | None


@dataclass(frozen=True)
class Correction:
    id: str
    chip: Chip
    sentence: str
    formula: Markup
    same: bool  # the printed formula, with corrected definitions in it
    conditions: tuple[str, ...]
    certificate: CertificateBlock | None
    twins: TwinsBlock | None


@dataclass(frozen=True)
class Failure:
    anchor: str
    id: str
    equation: str
    sentence: str
    kind: str  # of the first verdict that is not proved: a shape
    chips: tuple[Chip, ...]
    why: tuple[str, ...]
    reading_note: str | None
    readings: tuple[Reading, ...]
    corrections: tuple[Correction, ...]


@dataclass(frozen=True)
class GainLine:
    """One condition on gains. text and formula: what it says, one of them or both. note: why it is open."""

    text: str
    formula: Markup
    chip: Chip
    note: str
    margin: str
    source: Link


@dataclass(frozen=True)
class Fact:
    name: str
    value: Markup


@dataclass(frozen=True)
class Gains:
    """A map of gains: two drawings of it, the conditions that decide, and the command that makes it again."""

    wide: Markup
    narrow: Markup
    caption: Markup
    bounds: tuple[GainLine, ...]
    heads: tuple[str, ...]
    command: tuple[str, ...]  # in parts between which a line may break
    facts: tuple[Fact, ...] = ()


@dataclass(frozen=True)
class EvidenceLine:
    equation: str
    claim: Link
    samples: str
    residual: str
    twins: str


@dataclass(frozen=True)
class Evidence:
    lines: tuple[EvidenceLine, ...]
    twins: TwinsBlock
    unread: tuple[str, ...]  # claims whose twins hold too


@dataclass(frozen=True)
class Assumption:
    kind: str  # assumed, not stated, not entered, reading or chosen
    formula: Markup
    text: str
    used: str


@dataclass(frozen=True)
class Scope:
    subject: str
    verdict: str  # proved, measured or out
    note: str


@dataclass(frozen=True)
class CertificateLine:
    anchor: str
    equation: str
    id: str
    kind: str
    size: int
    sha256: str


@dataclass(frozen=True)
class Check:
    commands: tuple[str, ...]
    program: str  # the general program that evaluates a witness
    certificates: tuple[CertificateLine, ...]


@dataclass(frozen=True)
class Footer:
    tool: str
    inputs_sha256: str
    command: str


@dataclass(frozen=True)
class Page:
    header: Header
    notes: tuple[Note, ...]
    claims: tuple[ClaimLine, ...]
    study: StudyBlock
    proofs: tuple[ProofPair, ...]
    failures: tuple[Failure, ...]
    evidence: Evidence
    assumptions: tuple[Assumption, ...]
    scope: tuple[Scope, ...]
    check: Check
    footer: Footer
    gains: Gains | None = None
