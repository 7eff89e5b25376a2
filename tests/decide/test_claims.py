"""From a claim to its verdict: what is kept between runs, and under which digest."""

from symctrl import Study, nonnegative
from symctrl.decide.claims import remembered
from symctrl.store import Store
from symctrl.verdict import Outcome, Verdict
from tests.decide.problems import problem


def test_what_was_not_decided_is_tried_again_with_another_hint(tmp_path):
    study = Study("hinted")
    x, b = study.state("x"), study.gain("b")
    claim = nonnegative(b - x)
    tried = []

    def decider(asked):
        tried.append(asked)
        return Verdict(Outcome.UNDECIDED, "no proof was found")

    store = Store(tmp_path)
    for hinted in (claim, claim.by(times=2 * b), claim.by(squares=[b - x]), claim, claim.by(times=2 * b)):
        remembered(problem(study, hinted), store, decider)
    assert len({one.sha256 for one in tried}) == 1
    assert len(tried) == 3
