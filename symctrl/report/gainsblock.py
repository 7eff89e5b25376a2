"""The gains of a study on its page: where the theorem applies, what decides it, and how to see it again."""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
from markupsafe import Markup

from symctrl.bounds import Bound
from symctrl.context import within
from symctrl.domains.units import Measured, UnitsDomain
from symctrl.evaluate import Environment, NoRate
from symctrl.files import InputError
from symctrl.gains import answer
from symctrl.gains.conditions import Condition, Conditions, conditions, is_gain
from symctrl.gains.definite import FAILS, HOLDS, OPEN
from symctrl.gains.maps import Axis, Map
from symctrl.gains.point import Answer
from symctrl.gains.requirement import Requirement
from symctrl.gains.theorem import standing_theorem
from symctrl.latex import latex, name_latex
from symctrl.problem import star
from symctrl.report import gainsmap
from symctrl.report.claims import place
from symctrl.report.mathml import UNBROKEN, math, signs
from symctrl.report.names import groups, in_words, numbers
from symctrl.report.page import Chip, Fact, GainLine, Gains, Link
from symctrl.report.studyblock import letter, readable, units_of
from symctrl.rows import Report
from symctrl.store import Store
from symctrl.study import Study
from symctrl.written import Entry, StudyError

CELLS = 240, 160
BEYOND = Fraction(5, 2)  # how far a map goes, in parts of the study's value
SMALL = Fraction(1, 100)  # of its end, where it begins
HEADS = "Condition", "Verdict", "Certified margin", "From"
_CHIPS = {
    HOLDS: Chip("proved", "holds"),
    FAILS: Chip("refuted", "fails"),
    OPEN: Chip("undecided", "undecided"),
}
_NODES = {"i": "i", "j": "j"}
_OUTSIDE = {False: "the proof does not apply", True: "one of them fails"}
_BOUNDS = ("positive", "nonnegative")


def block(
    report: Report,
    study: Study,
    asked: str,
    store: Store | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Gains | None:
    """None where the study has no conditions on gains, or no gains with values that one of them reads.

    asked: the study's name or path, as the user gave it.
    """
    decided = {row.id: row for row in report.rows}
    theorem = standing_theorem(study, store, progress, decided)
    try:
        with within(study.instance):
            found = conditions(study, theorem, study.all_values())
    except StudyError:
        return None
    axes = axes_of(study, found)
    if not axes:
        return None
    try:
        made = answer.gains(study, axes, None, store, progress, decided)
    except InputError:  # a condition reads what has no value
        return None
    return _Written(report, study, theorem, made).block(asked)


def axes_of(study: Study, found: Conditions) -> tuple[Axis, ...]:
    """The first two gains with values that one condition reads, or the first one, from small values to beyond
    the study's.
    """
    values = study.all_values()
    read = [
        [n for n in one.names if is_gain(study, n) and values.get(n, Fraction(0)) > 0]
        for one in found.deciding
        if not _is_positivity(one)
    ]
    names = next((some[:2] for some in read if len(some) > 1), None)
    names = names or next((some[:1] for some in read if some), [])
    return tuple(_axis(name, values[name], count) for name, count in zip(names, CELLS, strict=False))


def _axis(name: str, value: Fraction, count: int) -> Axis:
    end = gainsmap.ceiling(BEYOND * value)
    return Axis(name, SMALL * end, end, count)


def _is_positivity(one: Condition) -> bool:
    return one.id.rpartition("/")[2] == "positive"


@dataclass(frozen=True)
class _Written:
    """An answer in words and drawings."""

    report: Report
    study: Study
    theorem: Entry | None
    found: answer.Gains

    def block(self, asked: str) -> Gains:
        assert self.found.map is not None
        scene = self.scene(self.found.map)
        sweeps = [f"--sweep {a.name}={a.lo}:{a.hi}:{a.count}" for a in self.found.map.axes]
        return Gains(
            gainsmap.draw(scene, gainsmap.WIDE),
            gainsmap.draw(scene, gainsmap.NARROW),
            self.caption(self.found.map),
            tuple(map(self.line, self.found.conditions)),
            HEADS,
            (f"symctrl gains {shlex.quote(asked)}", *sweeps),
            tuple(self.facts()),
        )

    @cached_property
    def units(self) -> dict[str, str]:
        """Those of the report, and of what only the conditions read."""
        made = units_of(self.study, self.report)
        for one in (r for a in self.found.conditions for r in a.condition.requirements):
            made = _measured(one, made)[1] | made
        return made

    @property
    def words(self) -> dict[int, str]:
        outside = "a condition fails" if self.theorem is None else "not covered by the proof"
        return {HOLDS: "feasible", FAILS: outside, OPEN: "undecided"}

    # The drawing

    def scene(self, made: Map) -> gainsmap.Scene:
        names = [axis.name for axis in made.axes]
        units = self.units
        return gainsmap.Scene(
            made,
            tuple(letter(name, self.study.symbols[name]) for name in names),
            tuple(units.get(name, "") for name in names),
            tuple(self.found.gains[name] for name in names),
            self.found.state,
            self.words,
            self.label(made, units),
        )

    def label(self, made: Map, units: Mapping[str, str]) -> str:
        ranges = [
            f"{axis.name} from {_with(gainsmap.plain(axis.lo), '')} to "
            f"{_with(gainsmap.plain(axis.hi), units.get(axis.name, ''))}"
            for axis in made.axes
        ]
        at = [_with(f"{a.name} = {self.found.gains[a.name]}", units.get(a.name, "")) for a in made.axes]
        parts = in_words([f"{self.words[state]} {share}" for state, share in shares(made).items()])
        return (
            f"Map of {in_words(ranges)}: {parts}. The study's gains, {in_words(at)}: "
            f"{self.words[self.found.state]}."
        )

    # Words

    def caption(self, made: Map) -> Markup:
        share = shares(made)
        count = "\N{NO-BREAK SPACE}×\N{NO-BREAK SPACE}".join(str(axis.count) for axis in made.axes)
        where = f" on the graph {self.found.graph}" if self.found.graph else ""
        others = ", all other gains at the study's values" if len(self.found.gains) > len(made.axes) else ""
        dark = " (the grey cells)" if (made.states == OPEN).any() else ""
        rest = (
            f"{where}{others}: {count} cells, each decided as a whole, with its edges. {share[HOLDS]} of "
            f"the map is feasible, in {share[FAILS]} {_OUTSIDE[self.theorem is None]}, and "
            f"{share[OPEN]}{dark} is undecided."
        )
        if self.theorem is not None:
            rest += (
                " The conditions are sufficient: what is not covered by the proof is not thereby unstable."
            )
        if self.found.reason:
            rest += f" The study's gains are undecided: {self.found.reason}."
        return Markup("Where {}{}").format(self.what(), rest)

    def what(self) -> Markup:
        if self.theorem is None:
            return Markup("all conditions hold that the study names")
        target = self.target(self.theorem.id)
        name = self.theorem.equation
        said = Markup('<a href="#{}">{}</a>').format(target, name) if target else name
        return Markup("{} applies").format(said)

    # The table

    def line(self, one: Answer) -> GainLine:
        text, formula = self.said(one.condition)
        source = self.source(one.condition)
        return GainLine(text, formula, _CHIPS[one.state], one.reason, self.margin(one), source)

    def said(self, condition: Condition) -> tuple[str, Markup]:
        """What a condition says: the study's sentence, where it has one; a formula that fits into a line."""
        if not condition.requirements:
            return condition.statement, Markup("")
        if _is_positivity(condition):
            read = (r.statement for r in condition.requirements)
            return "", math(",".join(latex(s.expr) for s in read if isinstance(s, Bound)) + " > 0")
        text = "" if condition.of_theorem else condition.statement
        fits = condition.of_theorem or signs(condition.latex) <= UNBROKEN
        return text, math(condition.latex) if fits and "matrix" not in condition.latex else Markup("")

    def margin(self, one: Answer) -> str:
        """At least so much, in the condition's unit; none where its parts have several units."""
        if one.margin is None:
            return ""
        measured = {self.unit(r) for r in one.condition.requirements if r.kind in _BOUNDS}
        if len(measured) > 1:
            return ""
        return _with(f"≥ {at_least(one.margin)}", next(iter(measured), None) or "")

    def unit(self, one: Requirement) -> str | None:
        return _measured(one, self.units)[0]

    def source(self, condition: Condition) -> Link:
        named = condition.source.rpartition(" ")[2]
        return Link(condition.source, self.target(named) if condition.source != "all gains" else None)

    def target(self, id_: str) -> str | None:
        """Where on the page a claim is; None for what is no claim, as a condition that the study names."""
        return self.places.get(id_)

    @cached_property
    def places(self) -> dict[str, str]:
        return {
            row.id: place(group, row)
            for group in groups(self.report.rows)
            for row in (*group.rows, *group.corrections)
        }

    # Beside it

    def facts(self) -> Iterator[Fact]:
        units = self.units
        if self.found.boundary:
            edges = [math(self._written(text)) for text in self.found.boundary.split("; ")]
            yield Fact("Edge, exactly", Markup(", ").join(edges))
        if self.found.margin is not None:
            within_ = f"{_percent(self.found.margin, up=False)} of the study's values"
            yield Fact("Relative margin", Markup("feasible for all gains within {}").format(within_))
        if self.found.spectrum is not None:
            low, high = at_least(self.found.spectrum.low), at_most(self.found.spectrum.high)
            between = low if low == high else f"from {low} to {high}"
            yield Fact("Largest eigenvalue of the Laplacian", Markup("{}").format(between))
        if self.found.chosen:
            made = [
                math(f"{self._letter(name)} = {_fraction(value)}") + _unit_behind(units.get(name, ""))
                for name, value in self.found.chosen.items()
            ]
            yield Fact("Constants that the proof may choose, as chosen here", Markup(", ").join(made))

    def _letter(self, name: str) -> str:
        symbol = self.study.symbols.get(name)
        return name_latex(name) if symbol is None else letter(name, symbol)

    def _written(self, text: str) -> str:
        """A formula as `symctrl gains` prints it, in LaTeX."""
        made = re.sub(r"\^(\d+)", r"^{\1}", text)
        made = re.sub(r"[^\W\d]\w*", lambda m: f"{{{self._letter(m[0])}}}", made)
        return made.replace("*", r" \, ")


def _fraction(value: Fraction) -> str:
    text = str(abs(value.numerator))
    made = text if value.denominator == 1 else rf"\frac{{{text}}}{{{value.denominator}}}"
    return f"-{made}" if value < 0 else made


def _with(number: str, unit: str) -> str:
    return f"{number}\N{NO-BREAK SPACE}{unit}" if unit else number


def _unit_behind(unit: str) -> Markup:
    return Markup("\N{NO-BREAK SPACE}{}").format(unit) if unit else Markup("")


def at_least(value: Fraction) -> str:
    """The number exactly; where that is long, a decimal that is no larger."""
    return _rounded(value, ROUND_FLOOR)


def at_most(value: Fraction) -> str:
    return _rounded(value, ROUND_CEILING)


def _rounded(value: Fraction, way: str) -> str:
    if len(str(value)) <= gainsmap.LONG:
        return numbers(str(value))
    made = Context(prec=4, rounding=way).divide(Decimal(value.numerator), Decimal(value.denominator))
    return numbers(f"{made:f}")


def _percent(share: Fraction, up: bool) -> str:
    """In tenths of a percent, rounded up or down."""
    tenths = -(-share * 1000 // 1) if up else share * 1000 // 1
    text = f"{tenths // 10}.{tenths % 10}" if share * 100 % 1 else str(share * 100)
    return f"{text}\N{NO-BREAK SPACE}%"


def shares(made: Map) -> dict[int, str]:
    """The part of each class; what is undecided is rounded up, and what is decided down."""
    count = {state: int(np.count_nonzero(made.states == state)) for state in (HOLDS, FAILS, OPEN)}
    return {
        state: _percent(Fraction(number, made.states.size), up=state == OPEN)
        for state, number in count.items()
    }


class _Terms:
    """A sum has the unit of what it sums."""

    def value(self, at: Environment, name: str, level: int, law: str | None) -> Any:
        of = at.problem.names[star(name)].of
        assert of is not None
        return at.output(of, _NODES, level, law)


def _measured(one: Requirement, units: Mapping[str, str]) -> tuple[str | None, dict[str, str]]:
    """The unit of a bound, None where it is not known, and those that it forces on what it reads."""
    domain = UnitsDomain()

    def free(name: str) -> Measured:
        known = units.get(star(name).partition("[")[0].partition(".")[0])
        return domain.symbol(star(name), known or "1" if known is not None else None)

    try:
        values = Environment(one.problem, domain, free, _Terms()).outputs(one.problem.claim.listing, _NODES)
    except NoRate:
        return None, {}
    if domain.mismatch is not None:
        return None, {}
    found = {name: readable(domain.solved[name].text) for name in domain.found}
    resolved = [domain.resolve(value.unit) for value in values if value.unit is not None]
    texts = {"" if unit.unknown else readable(unit.text) for unit in resolved}
    return (texts.pop() if len(texts) == 1 else None), found
