"""Each bad argument is refused for its own reason, and good ones have no line too many."""

import pytest

from tests.arena.arguments import CASES as GOOD
from tests.arena.bad_arguments import BAD
from tests.arena.changes import changed
from tests.arena.false_arguments import FALSE, REFUSED
from tests.kernel.certificates import explain

# Lines that only show a way, by what they carry.
WAYS = {"argument_barbalat_1": {1}, "argument_carries_apart": {4}, "argument_carries_rate": {4, 5}}


@pytest.mark.parametrize("name", sorted({**BAD, **REFUSED}))
def test_it_is_refused_for_its_own_reason(name):
    reason, case = {**BAD, **REFUSED}[name]
    answer = explain(case)
    assert answer.startswith("invalid: ")
    assert reason in answer


def test_every_false_theorem_is_stored():
    assert REFUSED.keys() == FALSE.keys()


@pytest.mark.parametrize("name", sorted(GOOD))
def test_every_line_is_needed(name):
    lines = GOOD[name]["proof"]["lines"]
    kept = [k for k in range(len(lines)) if k not in WAYS.get(name, ())]
    for k in kept:
        shorter = changed(GOOD[name], "proof", "lines", to=[*lines[:k], *lines[k + 1 :]])
        assert explain(shorter).startswith("invalid"), k
