"""Sums over nodes whose terms divide by what belongs to the node: by a positive gain of each, by no other."""

from symctrl import Study, claim, tends
from symctrl.verify import verify


def weighted(positive):
    """x_i' = -k_i sum over neighbours (x_i - x_j), with V = sum x_i^2 / (2 k_i)."""
    study = Study("weighted")
    fleet = study.fleet(default="ring:4")
    i, j = fleet.node, fleet.neighbour
    x, k = fleet.state("x"), fleet.parameter("k")
    m, c = study.gain("m"), study.gain("c")
    if positive:
        study.assume(k[i] > 0)
    fleet.motion(x, lambda i: -k[i] * fleet.sum(j, x[i] - x[j], at=i))
    V = fleet.sum(i, x[i] * x[i] / (2 * k[i]))
    form = fleet.sum(i, x[i] * fleet.sum(j, x[i] - x[j]))
    squares = fleet.sum(i, fleet.sum(j, (x[i] - x[j]) * (x[i] - x[j])))

    @study.claimed("1")
    def agreement():
        """The nodes agree."""
        return claim(given=[fleet.eigenvalues_at_most(m), c >= k[i]], then=[tends(x[i] - x[j])])

    @study.argument(agreement)
    def by_weights(run):
        run.falls(V, by=form)
        run.bounded(x[i], by=V, least=1 / (2 * c))
        run.exists()
        run.barbalat(form)
        run.tends(squares, by=form, times=2)
        run.tends(x[i] - x[j], by=squares)

    return verify(study).rows


def test_weighted_consensus():
    (row,) = [row for row in weighted(True) if row.id == "agreement"]
    assert row.verdict == "proved", row.reason


def test_weights_of_unknown_sign_prove_nothing():
    rows = weighted(False)
    (row,) = [row for row in rows if row.id == "agreement"]
    assert row.verdict == "undecided"
