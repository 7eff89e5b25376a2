"""Units of a claim, judged beside its verdict: those that the equations force, or the first mismatch."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from symctrl.decide.place import is_fleet
from symctrl.domains.tangent import NotDifferentiable
from symctrl.domains.units import Measured, UnitsDomain
from symctrl.evaluate import Environment, NoRate
from symctrl.problem import Problem, split, star
from symctrl.rows import Units

if TYPE_CHECKING:
    from symctrl.study import Study


class _Terms:
    """A sum has the unit of what it sums."""

    def value(self, at: Environment, name: str, level: int, law: str | None) -> Any:
        meaning = at.problem.names[star(name)]
        assert meaning.of is not None
        node = split(name)[1] or "i"
        return at.output(meaning.of, {"i": node, "j": "j" if node == "i" else "i"}, level, law)


def units_of(study: Study, problem: Problem) -> Units | None:
    """The judgement of one problem; None where it takes a rate that there is not."""
    domain = UnitsDomain()
    environment = Environment(problem, domain, lambda name: _symbol(study, domain, name), _Terms())
    binding = {"i": "i", "j": "j"} if is_fleet(problem) else {}
    try:
        outputs = environment.outputs(problem.claim.listing, binding)
        for state, of in problem.motion.items():
            rate = environment.output(of, {"i": "i"})
            domain.same(f"motion of {state}", rate, _per_second(domain, environment, state))
    except (NoRate, NotDifferentiable):
        return None
    if problem.claim.kind == "equal":
        half = len(outputs) // 2
        for left, right in zip(outputs[:half], outputs[half:], strict=True):
            domain.same("equation", left, right)
    gains = {name for name in problem.scalars if _is_open(study, name)}
    inferred = {name: domain.solved[name].text for name in sorted(gains) if name in domain.found}
    return Units(domain.mismatch is None, domain.mismatch, inferred)


def _symbol(study: Study, domain: UnitsDomain, name: str) -> Measured:
    general = star(name)
    return domain.symbol(general, _unit(study, general))


def _is_open(study: Study, name: str) -> bool:
    """Is it a symbol of the study that has no unit of its own?"""
    base, node, _ = split(name)
    declared = study.symbols.get(base if node is None else f"{base}.*")
    return declared is not None and declared.unit is None


def _unit(study: Study, name: str) -> str | None:
    base, node, _ = split(name)
    declared = study.symbols.get(base if node is None else f"{base}.*")
    return declared.unit if declared is not None else None


def _per_second(domain: UnitsDomain, environment: Environment, state: str) -> Measured:
    value: Measured = environment.name(state.replace(".*", ".i"), 0, None)
    result: Measured = domain.operation("DIV")(value, domain.symbol("second", "s"))
    return result
