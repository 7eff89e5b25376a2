"""What stands beside the verdicts: second evidence, assumptions and what is missing, the scope."""

from __future__ import annotations

import math as real
from collections.abc import Iterator, Sequence

from symctrl.report.claims import place
from symctrl.report.mathml import math
from symctrl.report.names import Group, few
from symctrl.report.page import Assumption, Evidence, EvidenceLine, Link, Scope, TwinsBlock
from symctrl.report.studyblock import letter
from symctrl.report.words import counted
from symctrl.rows import Report, Row
from symctrl.study import Study

_BETWEEN = r",\; "
_SCOPE = {
    "sampling": "the proofs are in continuous time",
    "delay": "signals and inputs act at once",
    "quantisation": "numbers are real numbers",
    "saturation": "no input is limited unless the law limits it",
    "wheel limits": "torque is applied as commanded",
    "flexible modes": "the equations are those entered, and no others",
    "estimator": "states are known exactly",
    "faults": "nothing fails",
}


def evidence(grouped: Sequence[Group]) -> Evidence:
    """Residuals in floating point, and negative twins, of what is proved."""
    pairs = [(g, r) for g in grouped for r in (*g.rows, *g.corrections) if r.numeric or r.twins]
    made = [r.twins for _, r in pairs if r.twins is not None]
    still = [f"{r.id}: {text}" for _, r in pairs if r.twins for text in r.twins.still_true]
    tried = sum(one.tried for one in made)
    return Evidence(
        tuple(_line(group, row) for group, row in pairs),
        TwinsBlock(tried, tried - len(still), tuple(still)),
        tuple(still),
    )


def _line(group: Group, row: Row) -> EvidenceLine:
    samples, residual = "–", "–"
    if row.numeric is not None:
        samples, residual = str(row.numeric.samples), above(row.numeric.max_residual)
    twins = (
        "–" if row.twins is None else f"{row.twins.tried - len(row.twins.still_true)} of {row.twins.tried}"
    )
    return EvidenceLine(row.equation, Link(row.id, place(group, row)), samples, residual, twins)


def above(residual: float) -> str:
    """A power of ten that the residual does not exceed, so that rounding elsewhere says the same."""
    if residual == 0:
        return "0"
    power = real.ceil(real.log10(residual))
    return f"≤ 10{str(power).translate(str.maketrans('-0123456789', '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'))}"


def assumptions(report: Report, study: Study) -> tuple[Assumption, ...]:
    return (
        *_assumed(report, study),
        *_suppositions(report, study),
        *_chosen(study),
        *_open(study),
        *_readings(report, study),
    )


def _assumed(report: Report, study: Study) -> Iterator[Assumption]:
    """The study's assumptions, those about the same and used by the same claims together."""
    told: dict[tuple[str, str], dict[str, str]] = {}
    for one in study.assumed:
        text = one.claim.text()
        told.setdefault((_about(one.about), _used(report, text)), {})[text] = one.claim.latex()
    for (about, used), formulas in told.items():
        yield Assumption("assumed", math(_BETWEEN.join(formulas.values())), f"({about})", used)


def _suppositions(report: Report, study: Study) -> Iterator[Assumption]:
    """What single claims assume of the motion beyond the study's own assumptions."""
    own = {one.claim.text() for one in study.assumed}
    told: dict[str, None] = {}
    for row in report.rows:
        for given in row.given:
            if given.about in ("trajectory", "signal") and given.text not in own | set(told):
                told[given.text] = None
                yield Assumption(
                    "assumed", math(""), f"{given.text} ({_about(given.about)})", _used(report, given.text)
                )


def _about(about: str) -> str:
    return {
        "parameter": "of the parameters",
        "initial": "at the beginning",
        "signal": "of the signals, at all times",
        "trajectory": "along the motion: what rests on it stands conditionally",
    }.get(about, about)


def _used(report: Report, text: str) -> str:
    rows = [row for row in report.rows if any(given.text == text for given in row.given)]
    equations = few([row.equation for row in rows], 5)
    return f"{counted(len(rows), 'claim')}: {equations}" if rows else "no claim"


def _chosen(study: Study) -> Iterator[Assumption]:
    if study.of_fleet is not None:
        yield Assumption("graph", math(""), f"{study.graph}", "claims that hold for one graph only say so")


def _open(study: Study) -> Iterator[Assumption]:
    """Parameters without a value: verdicts hold for all values that meet the assumptions."""
    names = [
        letter(name, symbol)
        for name, symbol in study.symbols.items()
        if symbol.kind == "parameter" and not symbol.values
    ]
    if names:
        yield Assumption("no value", math(_BETWEEN.join(names)), "", "every value that meets the assumptions")


def _readings(report: Report, study: Study) -> Iterator[Assumption]:
    for missing in report.missing:
        yield Assumption("not entered", math(""), missing, "numbered in the paper")
    for entry in study.entries.values():
        if entry.reading:
            yield Assumption("reading", math(""), entry.reading, f"{entry.equation} {entry.id}")
        if entry.readings:
            names = few(list(entry.readings), 6)
            yield Assumption(
                "readings", math(""), names, f"{entry.equation} {entry.id}: each has its verdict"
            )


def scope() -> tuple[Scope, ...]:
    """What the verdicts do not speak of; nothing here has been measured or proved for the study."""
    return tuple(Scope(subject, "out", note) for subject, note in _SCOPE.items())
