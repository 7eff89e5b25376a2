"""The conditions on gains of a study: what its standing theorem assumes of parameters, and what it names."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from symctrl.bounds import Bound, Statement
from symctrl.collect import Collector
from symctrl.context import within
from symctrl.entries import component_names
from symctrl.fleet import EIGENVALUE
from symctrl.gains.requirement import DEGREE, Requirement, read_names
from symctrl.problem import Problem
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
    the Laplacian; besides: the text of all else, and what it is about; all of it in one problem.
    """

    conditions: tuple[Condition, ...] = ()
    bounds: tuple[str, ...] = ()
    besides: tuple[tuple[str, str], ...] = ()
    problem: Problem | None = None


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


def conditions(study: Study, theorem: Entry | None) -> Conditions:
    """The conditions of the standing theorem, then those that the study names. Raises StudyError."""
    with within(replace(study.instance, variant="corrected")):
        assumed = of_theorem(study, theorem) if theorem is not None else Hypotheses()
        named = [_named(study, entry) for entry in study.conditions.values()]
    each = (*assumed.conditions, *named)
    if not each:
        raise StudyError(
            f"the study {study.name} has no condition on gains: no theorem of it stands that assumes one, "
            "and it names none with @study.condition"
        )
    return Conditions(theorem.id if theorem else None, each, assumed)


def of_theorem(study: Study, entry: Entry) -> Hypotheses:
    """What a theorem assumes. Raises StudyError, and what calling the entry raises."""
    claim = entry.call(study)
    assert isinstance(claim, Theorem)
    made = Loop(study, claim, entry.id)
    statements = {one.claim.text(): one.claim for one in claim.given}
    statements |= {one.claim.text(): one.claim for one in study.assumed}
    found: list[Condition] = []
    bounds, besides, positive = [], [], []
    for text, about in dict.fromkeys((given.text, given.about) for given in made.problem.given):
        statement = statements.get(text)
        if isinstance(statement, LaplacianBound):
            bounds.append(_symbol(statement))
        elif statement is not None and _is_positive_gain(study, statement):
            positive.append(statement)
        elif statement is not None and about == "parameter" and _is_constant(study, statement):
            id_, source = f"{entry.id}/{len(found) + 1}", f"{entry.equation} {entry.id}"
            found.append(_condition(study, id_, text, source, True, [statement]))
        else:
            besides.append((text, about))
    if positive:
        text = f"{', '.join(one.text().removesuffix(' > 0') for one in positive)} > 0"
        found.append(_condition(study, f"{entry.id}/positive", text, "all gains", True, positive))
    return Hypotheses(tuple(found), tuple(bounds), tuple(besides), made.problem)


def _named(study: Study, entry: Entry) -> Condition:
    claimed = entry.call(study)
    listed = claimed if isinstance(claimed, list | tuple) else [claimed]
    for one in listed:
        if not isinstance(one, Bound | Definite | Equal | Nonzero):
            raise StudyError(
                f"the condition {entry.id} must be a bound or a matrix that is definite, or a list of these"
            )
    made = _condition(study, entry.id, entry.sentence, f"{entry.equation} {entry.id}", False, listed)
    for name in made.names:
        if name not in (EIGENVALUE, DEGREE) and not _is_parameter(study, name):
            raise StudyError(
                f"the condition {entry.id} speaks of {name}, which is no parameter: it must be one on gains"
            )
    return made


def _condition(
    study: Study, id_: str, text: str, source: str, of_theorem: bool, listed: Sequence[Statement]
) -> Condition:
    requirements = tuple(requirement(study, one, id_) for one in listed)
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


def _is_constant(study: Study, statement: Statement) -> bool:
    """Does it read parameters alone that belong to no node?"""
    problem = requirement(study, statement, "constant").problem
    plain = not any(meaning.is_ in ("sum", "total", "rate") for meaning in problem.names.values())
    return plain and all(kind == "parameter" and ".*" not in name for name, kind in problem.scalars.items())


def _is_parameter(study: Study, name: str) -> bool:
    return any(
        name in component_names(base, symbol.expr.shape, symbol.expr.args[2])
        for base, symbol in study.symbols.items()
        if symbol.kind == "parameter" and ".*" not in base
    )
