"""Identities with sums over neighbours and nodes: for every graph, or refuted on a small one."""

import json

import pytest

from symctrl import Study, equal
from symctrl.decide.decision import decide
from symctrl.decide.identity import residuals, vanishes
from symctrl.decide.session import exactly
from symctrl.kernel.check import check_text
from symctrl.verdict import Outcome
from tests.decide.problems import problem


def start():
    study = Study("s")
    fleet = study.fleet()
    return study, fleet, fleet.state("x"), fleet.state("y"), fleet.node, fleet.neighbour


def both(name):
    study, fleet, x, y, i, j = start()
    total, near = (lambda e: fleet.sum(i, e)), (lambda e, **at: fleet.sum(j, e, **at))
    claims = {
        "what belongs to the node goes out": (near(x[i] * y[j]), x[i] * near(y[j], at=i)),
        "linear": (near(x[i] - x[j]), fleet.degree(i) * x[i] - near(x[j], at=i)),
        "square": (
            near((x[i] - x[j]) ** 2),
            fleet.degree(i) * x[i] ** 2 - 2 * x[i] * near(x[j], at=i) + near(x[j] ** 2, at=i),
        ),
        "both directions": (total(y[i] * near(x[i] - x[j])), total(near((y[i] - y[j]) * (x[i] - x[j]))) / 2),
        "differences add up to nothing": (total(near(x[i] - x[j])), 0),
        "handshake": (total(near(x[j], at=i)), total(fleet.degree(i) * x[i])),
        "a neighbour is not the node": (near(x[j], at=i), fleet.degree(i) * x[i]),
        "half is missing": (total(y[i] * near(x[i] - x[j])), total(near((y[i] - y[j]) * (x[i] - x[j])))),
        "a product of sums": (near(x[j], at=i) ** 2, near(x[j] ** 2, at=i)),
        "squares do not add up to nothing": (total(near((x[i] - x[j]) ** 2)), 0),
        "not symmetric": (total(x[i] ** 2 * near(y[j], at=i)), total(x[i] * near(x[j] * y[j], at=i))),
    }
    return study, claims[name]


HOLD = (
    "what belongs to the node goes out", "linear", "square", "both directions",
    "differences add up to nothing", "handshake",
)  # fmt: skip
FAIL = (
    "a neighbour is not the node", "half is missing", "a product of sums", "squares do not add up to nothing",
    "not symmetric",
)  # fmt: skip


def zero(made):
    return exactly(made, lambda session: all(vanishes(session, v) for v in residuals(session)))


@pytest.mark.parametrize("name", HOLD)
def test_what_holds_on_every_graph_is_proved(name):
    study, sides = both(name)
    made = problem(study, equal(*sides))
    assert zero(made)
    found = decide(made)
    assert found.outcome is Outcome.PROVED
    assert check_text(json.dumps(found.certificate)).status == "valid"


@pytest.mark.parametrize("name", FAIL)
def test_what_fails_is_refuted_on_a_small_graph(name):
    study, sides = both(name)
    made = problem(study, equal(*sides))
    assert not zero(made)
    found = decide(made)
    assert found.outcome is Outcome.REFUTED
    assert found.witness["graph"]
    assert check_text(json.dumps(found.certificate)).status == "valid"
