"""Real certificates with one place altered: refused, or a right proof of the statement that is printed.

That an altered statement holds is confirmed by evaluating it at random admissible points with the engine,
which shares no code with the kernel.
"""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Iterator
from contextlib import suppress
from fractions import Fraction
from functools import cache
from itertools import islice
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from derivations.liang2016_formation import study
from symctrl.decide.place import Place, evaluation
from symctrl.decide.points import points
from symctrl.decide.solve import NoPoint
from symctrl.domains.domain import Unsupported
from symctrl.domains.fraction import FractionDomain, NoExactValue
from symctrl.graph import Instruction, Tape
from symctrl.kernel.check import check_text
from symctrl.posdef import answer
from symctrl.problem import Assumption, Claim, Meaning, Problem
from symctrl.verify import verify
from tests.kernel.certificates import Json, seal

CLAIMS = (
    "norm_is_kept",
    "kinematics_vector",
    "V_in_squares",
    "theta_definite_for_small_beta",
    "A_semidefinite",
    "both_directions",
    "rate_of_V_2_doubled",
    "rate_of_V_2",
    "disturbance_bound",
    "zero_square_gives_equal_vectors",
    "K_v_is_enough",
    "rate_of_V_corrected",
)
WORDS = {"tool", "study", "id", "text", "about"}
POINTS = 3
TINY = Fraction(1, 10**6)  # a small value of a gain


@cache
def certificates() -> dict[str, Json]:
    """The certificates of the claims, by id, and one of a definite matrix."""
    rows = verify(study, CLAIMS).rows
    found = {row.id: json.loads(json.dumps(row.certificate)) for row in rows if row.certificate is not None}
    matrix = {"matrix": [["4", "1", "0"], ["1", "3", "-1/2"], ["0", "-1/2", "2"]]}
    found["posdef"] = json.loads(json.dumps(answer(json.dumps(matrix), "matrix.json")["certificate"]))
    return found


def places(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The path of every part of a JSON value, digests aside."""
    if path and path[-1] != "sha256":
        yield path
    for key, part in (
        value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    ):
        yield from places(part, (*path, key))


def at(value: Any, path: tuple[Any, ...]) -> Any:
    for key in path:
        value = value[key]
    return value


@st.composite
def alterations(draw: st.DrawFn, certificate: Json) -> tuple[tuple[Any, ...], Json]:
    """One place of the certificate, and the certificate with that place altered."""
    path = draw(st.sampled_from(sorted(places(certificate), key=str)))
    other = copy.deepcopy(certificate)
    holder, key = at(other, path[:-1]), path[-1]
    old = holder[key]
    strings = sorted(set(re.findall(r'"([^"]*)"', json.dumps(certificate))))
    ways: list[Any] = ["remove"]
    if isinstance(old, bool | None):
        ways += [0, "x"]
    elif isinstance(old, int):
        ways += [old + 1, old - 1, -old, 0, 7]
    elif isinstance(old, str):
        ways += [draw(st.sampled_from(strings)), "-" + old, "2", "1/3"]
    elif isinstance(old, list):
        ways += [old[::-1], old[1:], old + old[-1:], []]
    else:
        ways += [{}, dict(reversed(old.items()))]
    new = draw(st.sampled_from(ways))
    if new == "remove":
        del holder[key]
    else:
        holder[key] = new
    if isinstance(holder, dict) and draw(st.booleans()) and new != "remove":
        holder[draw(st.sampled_from(strings))] = holder.pop(key)
    return path, other


def sealed(certificate: Json) -> Json | None:
    """With all digests recomputed, where there is still something to take them of."""
    try:
        return seal(certificate)
    except (KeyError, TypeError, AttributeError):
        return None


@pytest.mark.parametrize("name", [*CLAIMS, "posdef"])
def test_an_altered_certificate_is_refused_or_right(name):
    certificate = certificates()[name]
    assert check_text(json.dumps(certificate)).status == "valid"

    @settings(max_examples=250, deadline=None, database=None, suppress_health_check=list(HealthCheck))
    @given(alterations(certificate))
    def check(altered):
        path, other = altered
        if other == certificate:
            return
        assert check_text(json.dumps(other)).status != "valid"
        again = sealed(other)
        if again is None or path[-1] in WORDS or again == certificate:
            return
        if check_text(json.dumps(again)).status == "valid":
            confirm(again)

    check()


def confirm(certificate: Json) -> None:
    """The statement holds at random admissible points, or fails at the point that refutes it."""
    problem = read(certificate["statement"])
    if certificate["proof"]["kind"] == "witness":
        with suppress(NoExactValue):  # an altered operation may have an irrational value there
            assert not holds(problem, place_of(certificate["proof"]))
        return
    if problem.claim.kind == "conforms":
        return
    try:
        found = list(islice(points(problem), POINTS))
    except (NoPoint, Unsupported, ValueError):  # none is found, or an assumed matrix is not symmetric
        return
    for place in found:
        small = {problem.claim.small: TINY} if problem.claim.small else {}
        here = Place({**place.values, **small}, place.edges)
        try:
            if meets(certificate["statement"]["conditions"], here):
                assert holds(problem, here), json.dumps(certificate["statement"])
        except (NoExactValue, ZeroDivisionError):
            continue


def holds(problem: Problem, place: Place) -> bool:
    """Is the claim true at the place?"""
    claim = problem.claim
    outputs = evaluation(problem, place, FractionDomain()).outputs(claim.listing, place.binding)
    if claim.kind == "equal":
        half = len(outputs) // 2
        return outputs[:half] == outputs[half:]
    if claim.matrix is not None:
        least = np.linalg.eigvalsh(dense(claim.matrix, [float(entry) for entry in outputs])).min()
        return bool(least > -1e-9 if claim.kind == "positive_semidefinite" else least > 0)
    return all(entry > 0 if claim.kind == "positive" else entry >= 0 for entry in outputs)


def dense(tree: Any, outputs: list[float]) -> np.ndarray:
    """The matrix of a tree; a block diagonal one by its blocks."""
    if "entries" in tree:
        return np.array([[outputs[k] for k in row] for row in tree["entries"]])
    if "kron_identity" in tree:
        return np.kron(dense(tree["kron_identity"], outputs), np.eye(tree["size"]))
    if "congruence" in tree:
        factor = np.array([[outputs[k] for k in row] for row in tree["factor"]])
        return factor.T @ dense(tree["congruence"], outputs) @ factor
    blocks = [dense(block, outputs) for block in tree["blocks"]]
    whole = np.zeros((sum(map(len, blocks)),) * 2)
    start = 0
    for block in blocks:
        whole[start : start + len(block), start : start + len(block)] = block
        start += len(block)
    return whole


def meets(conditions: list[Json], place: Place) -> bool:
    """Do the conditions hold at the place? Those with functions are taken not to, which only tests less."""
    for condition in conditions:
        text = re.sub(r"[^\W\d]\w*(\.\w+)?(\[[\d,]+\])?", lambda name: f"v[{name[0]!r}]", condition["of"])
        values = {**place.values, **at_letters(place)}
        if "(" in text or any(name not in values for name in re.findall(r"v\['(.*?)'\]", text)):
            return False
        number = eval(re.sub(r"\b(\d+)\b(?!['\]])", r"Fraction(\1)", text.replace("^", "**")),
                      {"v": values, "Fraction": Fraction})  # fmt: skip
        if not {"nonzero": number != 0, "positive": number > 0, "nonnegative": number >= 0}[
            condition["kind"]
        ]:
            return False
    return True


def at_letters(place: Place) -> dict[str, Fraction]:
    """The values by the letters i and j that a condition names."""
    return {
        name.replace(f".{node}", f".{letter}", 1): value
        for letter, node in place.binding.items()
        for name, value in place.values.items()
        if f".{node}" in name
    }


def place_of(proof: Json) -> Place:
    values = {name: Fraction(value) for name, value in proof["values"].items()}
    edges = [tuple(edge) for edge in proof.get("graph", [])]
    if "node" in proof:  # the first edge is the one whose ends i and j stand for
        edges.sort(key=lambda edge: proof["node"] not in edge)
        first = edges[0] if edges[0][0] == proof["node"] else edges[0][::-1]
        edges[0] = first
    return Place(values, tuple(edges))


def read(statement: Json) -> Problem:
    """The engine's own form of a statement."""
    claim = {key: value for key, value in statement["claim"].items() if key != "shape"}
    return Problem(
        statement["study"],
        statement["id"],
        statement["text"],
        {name: tape(one) for name, one in statement["listings"].items()},
        Claim(shape=tuple(statement["claim"].get("shape", (1, 1))), **claim),
        statement["scalars"],
        {name: meaning(one) for name, one in statement["names"].items()},
        {name: tuple(of) for name, of in statement["motion"].items()},
        {law: {u: tuple(of) for u, of in table.items()} for law, table in statement["laws"].items()},
        tuple(map(assumption, statement["given"])),
    )


def tape(listing: Json) -> Tape:
    steps = []
    for op, *args in listing["code"]:
        if op == "INPUT":
            steps.append(Instruction(op, name=args[0]))
        elif op == "CONST":
            steps.append(Instruction(op, value=Fraction(args[0])))
        else:
            steps.append(Instruction(op, tuple(args)))
    return Tape(tuple(steps), tuple(listing["outputs"]))


def meaning(one: Json) -> Meaning:
    of = tuple(one["of"]) if "of" in one else None
    return Meaning(one["is"], of, one.get("law"), one.get("value"))


def assumption(one: Json) -> Assumption:
    of = tuple(tuple(ref) for ref in one["of"]) if "size" in one else (tuple(one["of"]),)
    return Assumption(one["kind"], of, one.get("text", ""), one.get("about", "parameter"), one.get("size", 1))
