"""Solutions exist for all time where the field grows at most like |x|, and not where it grows faster."""

import pytest

from symctrl import bounded
from symctrl.vectors import absolute, cross, saturate, sgn, stack, tanh
from tests.arena.stated import postfix, say, theorem, with_proofs
from tests.kernel.certificates import explain, seal
from tests.rules.theorem_rows import decided, states
from tests.rules.theorem_rows import theorem as theorem_of


def exists(build):
    """Is the line proved? The study's last quantity is bounded anyway."""
    study, x, v = states("x", "v")
    k, D = study.gain("k"), study.gain("D")
    n, d = study.parameter("n"), study.disturbance("d", bound=D)
    build(study, x, v, k, n, d)
    row, unmet = decided(theorem_of(study, [bounded(tanh(x))], lambda run: run.exists()))
    return row.verdict == "proved" and not unmet


@pytest.mark.parametrize(
    "build",
    [
        lambda study, x, v, k, n, d: (study.motion(x, k * x + d), study.motion(v, -v)),
        lambda study, x, v, k, n, d: (study.motion(x, n * x + d), study.motion(v, -v)),
        lambda study, x, v, k, n, d: (study.motion(x, v), study.motion(v, -k * x + d)),
        lambda study, x, v, k, n, d: (study.motion(x, v), study.motion(v, -k * saturate(x, 1) + d)),
        lambda study, x, v, k, n, d: (study.motion(x, v), study.motion(v, -k * tanh(x) - v)),
        lambda study, x, v, k, n, d: (study.motion(x, -k * sgn(x) + d), study.motion(v, -absolute(v))),
    ],
)
def test_affine_growth_is_enough(build):
    assert exists(build)


@pytest.mark.parametrize(
    "build",
    [
        lambda study, x, v, k, n, d: (study.motion(x, x**2), study.motion(v, -v)),
        lambda study, x, v, k, n, d: (study.motion(x, k * x * absolute(x)), study.motion(v, -v)),
        lambda study, x, v, k, n, d: (study.motion(x, x * v), study.motion(v, -v + x)),
        lambda study, x, v, k, n, d: (study.motion(x, v), study.motion(v, x**3)),
    ],
)
def test_what_may_grow_faster_is_not_said_to_exist(build):
    assert not exists(build)


def test_a_field_that_turns_fast_has_no_such_growth_but_a_constant_length():
    """w' = w x Jw: |w| is constant, so that V = 1 + |w|^2 does not grow at all."""
    study, _ = states("x")
    w = study.state("w", 3)
    study.motion(study.symbols["x"].expr, 0 * w.T @ w)
    study.motion(w, cross(w, stack(w[0], 2 * w[1], 3 * w[2])))
    row, unmet = decided(theorem_of(study, [bounded(tanh(w[0]))], lambda run: run.exists()))
    assert (row.verdict, unmet) == ("proved", {})


GROWS = {"V": "x x * 1 +", "b": "3", "x": "x", "W": "x 2 *", "t": "x x *"}


def certified(motion="x 1 +", **roles):
    line = ("exists", {"V": "V", "rate": "b", "grows": ["x"], **roles})
    return with_proofs(theorem({"x": motion}, ["x x *"], [say("exists")], GROWS, [line]))


def test_the_line_is_accepted():
    assert explain(seal(certified())) == "valid: verified by its argument"


@pytest.mark.parametrize(
    "change",
    [
        {"grows": ["W"]},
        {"grows": []},
        {"grows": ["x", "W"]},
        {"V": "b"},
        {"V": "t"},
        {"rate": "t"},
        {"rate": "x"},
    ],
)
def test_near_misses_are_refused(change):
    case = certified()
    case["proof"]["lines"][0]["of"] |= change
    assert explain(seal(case)).startswith("invalid")


@pytest.mark.parametrize("role", ["V", "rate", "grows"])
def test_a_role_that_is_left_out(role):
    case = certified()
    del case["proof"]["lines"][0]["of"][role]
    assert explain(seal(case)).startswith("invalid")


def test_another_motion_is_refused():
    case = certified()
    case["statement"]["listings"]["motion"] = postfix("x x *")
    assert explain(seal(case)).startswith("invalid")
