"""The conditions on gains of a study: what its standing theorem assumes of parameters, and what it names."""

from __future__ import annotations

import random
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from symctrl import deciding
from symctrl.bounds import Bound, Statement, claimed
from symctrl.collect import Collector
from symctrl.context import within
from symctrl.decide.claims import parts
from symctrl.decide.place import is_fleet
from symctrl.domains.boxes import Boxes
from symctrl.domains.domain import Unsupported
from symctrl.fleet import EIGENVALUE
from symctrl.gains.definite import is_symmetric
from symctrl.gains.requirement import DEGREE, Requirement, outputs, reached, read_names
from symctrl.problem import PROVED, Problem
from symctrl.rules.loop import Loop
from symctrl.statements import Definite, Equal, LaplacianBound, Nonzero, nonnegative
from symctrl.theorem import Theorem
from symctrl.written import Entry, StudyError

if TYPE_CHECKING:
    from symctrl.study import Study


@dataclass(frozen=True)
class Condition:
    """id: of the study's condition, or of the theorem and the number of its assumption. source: the equation
    and the id of what it comes from. of_theorem: is it an assumption of the theorem?
    """

    id: str
    statement: str
    latex: str
    source: str
    of_theorem: bool
    requirements: tuple[Requirement, ...]

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys(name for one in self.requirements for name in one.names))


@dataclass(frozen=True)
class Hypotheses:
    """What a theorem assumes: conditions on gains; bounds: symbols that are no less than any eigenvalue of
    the Laplacian; besides: the text of all else, and what it is about; all of it in one problem. of_fleet: is
    the theorem one about every connected graph with two nodes or more?
    """

    conditions: tuple[Condition, ...] = ()
    bounds: tuple[str, ...] = ()
    besides: tuple[tuple[str, str], ...] = ()
    problem: Problem | None = None
    of_fleet: bool = False


@dataclass(frozen=True)
class Conditions:
    """All of a study. theorem: the id of the one that they make applicable, if there is one."""

    theorem: str | None
    each: tuple[Condition, ...]
    assumed: Hypotheses

    @property
    def deciding(self) -> tuple[Condition, ...]:
        """Those that say whether the gains are feasible: the theorem's; without a theorem all."""
        return tuple(one for one in self.each if one.of_theorem or self.theorem is None)


def conditions(study: Study, theorem: Entry | None, fixed: Collection[str] = ()) -> Conditions:
    """The conditions of the standing theorem, then those that the study names. Raises StudyError.

    fixed: gains with a value or a range. Among them a bound of the Laplacian's eigenvalues is no choice, but
    has to be one.
    """
    with within(replace(study.instance, variant=variant_of(theorem))):
        assumed = of_theorem(study, theorem, fixed) if theorem is not None else Hypotheses()
    with within(replace(study.instance, variant="corrected")):
        named = [_named(study, entry) for entry in study.conditions.values()]
        named += _assumed(study, named) if theorem is None else []
    each = (*assumed.conditions, *named)
    if not each:
        raise StudyError(
            f"the study {study.name} has no condition on gains: no theorem that assumes one stands for all "
            "values, and it names none with @study.condition"
        )
    return Conditions(theorem.id if theorem else None, each, assumed)


def variant_of(theorem: Entry | None) -> str:
    """With which definitions the theorem is decided."""
    return "printed" if theorem is not None and theorem.form == "printed" else "corrected"


def of_theorem(study: Study, entry: Entry, fixed: Collection[str] = ()) -> Hypotheses:
    """What a theorem assumes. Raises StudyError, and what calling the entry raises."""
    claim = entry.call(study)
    assert isinstance(claim, Theorem)
    made = Loop(study, claim, entry.id)
    statements = {one.claim.text(): one.claim for one in claim.given}
    statements |= {one.claim.text(): one.claim for one in study.assumed}
    found: list[Condition] = []
    bounds, besides, positive = [], [], []
    for written, about in dict.fromkeys([*_given(made.problem), *_given_of_used(study, entry)]):
        statement = statements.get(written)
        if isinstance(statement, LaplacianBound):
            if _symbol(statement) in fixed:
                found.append(_bounding(study, f"{entry.id}/{len(found) + 1}", statement))
            else:
                bounds.append(_symbol(statement))
        elif statement is not None and _is_positive_gain(study, statement):
            positive.append(statement)
        elif statement is not None and about == "parameter" and _is_on_gains(study, statement):
            id_, source = f"{entry.id}/{len(found) + 1}", f"{entry.equation} {entry.id}"
            found.append(_condition(study, id_, written, source, True, [statement]))
        else:
            besides.append((written, about))
    if positive:
        found.append(_all_positive(study, f"{entry.id}/positive", True, positive))
    return Hypotheses(tuple(found), tuple(bounds), tuple(besides), made.problem, is_fleet(made.problem))


def _given(problem: Problem) -> list[tuple[str, str]]:
    return [(given.text, given.about) for given in problem.given if given.about != PROVED]


def _given_of_used(study: Study, entry: Entry) -> Iterator[tuple[str, str]]:
    """What the statements assume that the theorem uses."""
    for used in entry.using:
        below = tuple(deciding.used(study, other) for other in used.using)
        for part in parts(study, used.call(study), used.id, using=below):
            yield from _given(part.problem)
        yield from _given_of_used(study, used)


def _bounding(study: Study, id_: str, statement: LaplacianBound) -> Condition:
    """That no eigenvalue exceeds the number, as a condition on any eigenvalue."""
    assert study.of_fleet is not None
    claim = claimed(study.of_fleet.eigenvalue <= statement.expr)
    return _condition(study, id_, statement.text(), "the graph", True, [claim])


def _all_positive(study: Study, id_: str, of_theorem: bool, listed: Sequence[Statement]) -> Condition:
    text = f"{', '.join(one.text().removesuffix(' > 0') for one in listed)} > 0"
    return _condition(study, id_, text, "all gains", of_theorem, listed)


def _assumed(study: Study, named: Sequence[Condition]) -> list[Condition]:
    """What the study assumes of the gains of which its conditions speak: first that they are positive."""
    read = {name for one in named for name in one.names if is_gain(study, name)}
    claims = [a.claim for a in study.assumed if a.about == "parameter" and _is_on_gains(study, a.claim)]
    claims = [one for one in claims if read & set(requirement(study, one, "assumed").names)]
    positive = [one for one in claims if _is_positive_gain(study, one)]
    others = [one for one in claims if one not in positive]
    made = [_all_positive(study, "positive", False, positive)] if positive else []
    for k, one in enumerate(others, 1):
        made.append(_condition(study, f"assumed/{k}", one.text(), "assumed", False, [one]))
    return made


def _named(study: Study, entry: Entry) -> Condition:
    made = entry.call(study)
    listed = made if isinstance(made, list | tuple) else [made]
    for one in listed:
        if not isinstance(one, Bound | Definite | Equal | Nonzero):
            raise StudyError(
                f"the condition {entry.id} must be a bound, an equation, nonzero(x) or a matrix that is "
                "definite, or a list of these"
            )
    if not listed:
        raise StudyError(f"the condition {entry.id} is an empty list")
    for name in dict.fromkeys(n for one in listed for n in requirement(study, one, entry.id).names):
        if name not in (EIGENVALUE, DEGREE) and name not in study.parameter_names():
            raise StudyError(
                f"the condition {entry.id} speaks of {name}, which is no parameter: it must be one on gains"
            )
    return _condition(study, entry.id, entry.sentence, f"{entry.equation} {entry.id}", False, listed)


def _condition(
    study: Study, id_: str, text: str, source: str, of_theorem: bool, listed: Sequence[Statement]
) -> Condition:
    requirements = tuple(requirement(study, one, id_) for one in listed)
    for one in requirements:
        if isinstance(one.statement, Definite) and not _is_symmetric(one):
            raise StudyError(f"the condition {id_}: the matrix is not symmetric: {one.statement.text()}")
    latex = r",\; ".join(one.latex() for one in listed)
    return Condition(id_, text, latex, source, of_theorem, requirements)


def requirement(study: Study, statement: Statement, id_: str) -> Requirement:
    """The statement as a requirement; an equation as left less right being zero."""
    kind, plain = statement.kind, statement
    if isinstance(statement, Equal):
        kind, plain = "zero", nonnegative(statement.left - statement.right)
    elif isinstance(statement, Nonzero):
        plain = nonnegative(statement.expr)
    problem = Collector(study).problem(plain, id_, expanded=_is_product(statement))
    return Requirement(statement, problem, kind, tuple(read_names(problem)))


def _is_symmetric(made: Requirement) -> bool:
    """Are the entries those of a symmetric matrix at a point that was not chosen for it?"""
    domain, generator = Boxes(), random.Random(1)
    at = {name: Fraction(generator.randint(10**6, 10**7), 10**6) for name in made.names}
    boxes = {name: domain.between(value, value) for name, value in at.items()}
    assert made.problem.claim.matrix is not None
    try:
        return is_symmetric(made.problem.claim.matrix, outputs(made, boxes, domain))
    except Unsupported:
        return True  # it is not decided over boxes


def _is_product(statement: Statement) -> bool:
    """Is a matrix written as a product, so that only its entries say when it is definite?"""
    return isinstance(statement, Definite) and any(part.op == "matmul" for part in _parts(statement.matrix))


def _parts(matrix: Any) -> Iterator[Any]:
    yield matrix
    if matrix.op in ("kron", "diagonal"):
        for part in matrix.args:
            yield from _parts(part)


def _symbol(statement: LaplacianBound) -> str:
    if statement.expr.op != "symbol":
        raise StudyError(f"{statement.text()}: for gains, the bound of the eigenvalues must be a symbol")
    return str(statement.expr.args[0])


def _is_positive_gain(study: Study, statement: Statement) -> bool:
    """Is it what the study assumes of every gain?"""
    if not isinstance(statement, Bound) or not statement.strict or statement.expr.op != "symbol":
        return False
    symbol = study.symbols.get(statement.expr.args[0])
    return symbol is not None and symbol.gain


def _is_on_gains(study: Study, statement: Statement) -> bool:
    """Does it read constants that belong to no node, and among them a gain, or none without a value?"""
    made = requirement(study, statement, "constant")
    scalars, names = [name for name in made.names if name != DEGREE], made.problem.names
    read = reached(made.problem)
    if any(name in names and names[name].is_ in ("total", "rate") for name in read):
        return False
    if not set(scalars) <= set(study.parameter_names()):
        return False
    return any(is_gain(study, n) for n in scalars) or all(study.value(n) is not None for n in scalars)


def is_gain(study: Study, name: str) -> bool:
    symbol = study.symbols.get(name)
    return symbol is not None and symbol.gain
