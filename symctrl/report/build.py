"""From the verdicts of a study to its page. The library knows no paper: its words come from the study."""

from __future__ import annotations

from collections.abc import Sequence

from symctrl.certify import tool
from symctrl.report import beside, claims, failures, scripts, studyblock, trees
from symctrl.report.names import (
    FOLDER,
    Group,
    anchor,
    certificate_kind,
    certificate_size,
    groups,
)
from symctrl.report.page import CertificateLine, Check, Footer, Gains, Page
from symctrl.report.witnesses import Symbols
from symctrl.rows import Report
from symctrl.runs import file_name
from symctrl.study import Study


def page(report: Report, study: Study, asked: str, title: str, gains: Gains | None = None) -> Page:
    """The page of a report. asked: the study's name or path, as the user gave it."""
    grouped = groups(report.rows)
    units = studyblock.units_of(study, report)
    symbols = Symbols(units, studyblock.latex_of(study))
    return Page(
        header=claims.header(report, title, grouped, len(study.numbers)),
        notes=claims.notes(grouped),
        claims=claims.lines(grouped),
        study=studyblock.block(study, grouped, units),
        proofs=trees.pairs(report, grouped),
        failures=failures.blocks(
            report, study, grouped, symbols, lambda row: scripts.script(report.study, row)
        ),
        evidence=beside.evidence(grouped),
        assumptions=beside.assumptions(report, study),
        scope=beside.scope(),
        check=_check(report, asked, grouped),
        footer=Footer(tool(), report.inputs_sha256, f"symctrl report {asked}"),
        gains=gains,
    )


def _check(report: Report, asked: str, grouped: Sequence[Group]) -> Check:
    rows = [row for group in grouped for row in (*group.rows, *group.corrections) if row.certificate]
    lines = tuple(
        CertificateLine(
            anchor(row.id, "cert"),
            row.equation,
            row.id,
            certificate_kind(row),
            certificate_size(row),
            str((row.certificate or {})["sha256"]),
        )
        for row in rows
    )
    commands = (
        f"symctrl verify {asked} --certificates {FOLDER}",
        f"symctrl check {FOLDER}/{file_name(report.study)}/*.json",
    )
    return Check(commands, scripts.PROGRAM, lines)
