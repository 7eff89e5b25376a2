"""Sums over the nodes of a fleet: nonnegative node by node, or mode by mode of the graph's Laplacian."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from symctrl.decide import bound
from symctrl.decide.identity import _at_node, _of_totals
from symctrl.decide.session import Session, exactly
from symctrl.kernel import values as kernel
from symctrl.kernel.argument import OBLIGATION
from symctrl.kernel.certificate import Declined, Invalid
from symctrl.kernel.sums import opened
from symctrl.kernel.total import _at_a_node, _in_modes, _statement, at_a_node
from symctrl.problem import Problem

Convert = Callable[[kernel.Statement, Sequence[kernel.Assumption]], Problem]


def speaks_of_totals(problem: Problem) -> bool:
    return any(meaning.is_ == "total" for meaning in problem.names.values())


def each(statement: kernel.Statement, problem: Problem, convert: Convert) -> dict[str, Any] | None:
    """The proof that a combination of sums over nodes holds, for that of their terms does everywhere."""
    try:
        inner = at_a_node(statement)
    except Invalid:
        return None
    draft = exactly(problem, _draft)
    entry = None if draft is None else _inner(inner, convert)
    return None if entry is None or draft is None else dict(draft) | {"kind": "each", "term": entry}


def spectral(statement: kernel.Statement, problem: Problem, convert: Convert) -> dict[str, Any] | None:
    """The proof mode by mode, where the graph's eigenvalues are bounded by assumption.

    problem: the claim under the statement's assumptions, which must have no equation about the states among
    them.
    """
    at = next((k for k, a in enumerate(statement.given) if a.kind == "laplacian_bound"), None)
    if at is None:
        return None
    draft = exactly(problem, _draft)
    if draft is None:
        return None
    evaluation = json.loads(json.dumps(draft))
    try:
        test, outputs = opened(statement, evaluation, ("nonnegative",))
        inner = _statement(statement, test, _in_modes(test, _at_a_node(test, outputs[0])), at)
    except (Invalid, Declined):
        return None
    entry = _inner(inner, convert)
    return None if entry is None else evaluation | {"kind": "spectral", "bound": at, "modes": entry}


def _draft(session: Session) -> dict[str, Any] | None:
    (value,) = session.claim()
    coefficients = _of_totals(session, value)
    if not coefficients:
        return None
    _at_node(session, coefficients, "i")
    return session.proof("spectral")


def _inner(statement: kernel.Statement, convert: Convert) -> dict[str, Any] | None:
    """The proof of the inner claim, with the numbers of the assumptions that it uses."""
    listings = {**statement.listings, OBLIGATION: statement.listings[statement.claim.listing]}
    renamed = replace(statement, listings=listings, claim=replace(statement.claim, listing=OBLIGATION))
    problem = convert(renamed, statement.given)
    proof = bound.proof(problem)
    if proof is None:
        return None
    from symctrl.rules.loop import assumption_of

    own = [assumption_of(a) for a in statement.given]
    return {"given": [own.index(a) for a in problem.given], "proof": proof}
