"""Motions of a few scalars as problems, and their tubes, for the tests of enclosed solutions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

import casadi as ca

from symctrl.graph import Tape, read, unfolded
from symctrl.kernel.form import read_statement
from symctrl.kernel.tube import Segment, verify_tube
from symctrl.problem import Claim, Meaning, Problem
from symctrl.trajectories import enclose
from symctrl.tubes import Tube

Formulas = Callable[..., Sequence[Any]]


def motion(
    rates: Formulas,
    law: Formulas | None = None,
    rated: tuple[str, Formulas] | None = None,
    **kinds: str,
) -> Problem:
    """x' = rates(..), with the inputs law(..) under the law "law"; kinds: of all scalars, states first.

    rated: a name, and the formula of which it is the rate.
    """
    symbols = {name: ca.SX.sym(name) for name in kinds}
    named = symbols | ({rated[0]: ca.SX.sym(rated[0])} if rated else {})
    states = [name for name, kind in kinds.items() if kind == "state"]
    inputs = [name for name, kind in kinds.items() if kind == "input"]

    def tape(formulas: Sequence[Any]) -> Tape:
        entries = ca.vertcat(*formulas)
        return read(ca.Function("f", [ca.vertcat(*named.values())], [ca.densify(entries)]), list(named))

    with unfolded():
        listings = {f"motion {x}": tape([f]) for x, f in zip(states, rates(**named), strict=True)}
        listings |= {"law": tape(law(**symbols))} if law else {}
        listings |= {"rated": tape(rated[1](**symbols))} if rated else {}
    return Problem(
        "motions",
        "tube",
        "a motion",
        listings,
        Claim("conforms", f"motion {states[0]}", (1, 1)),
        scalars=kinds,
        names={rated[0]: Meaning("rate", ("rated", 0))} if rated else {},
        motion={name: (f"motion {name}", 0) for name in states},
        laws={"law": {name: ("law", k) for k, name in enumerate(inputs)}} if law else {},
    )


def numbers(**values: str | int) -> dict[str, Fraction]:
    return {name: Fraction(value) for name, value in values.items()}


def verified(
    problem: Problem, values: Mapping[str, Fraction], tube: Tube, law: str | None = None
) -> list[Segment]:
    """What the kernel says about the tube."""
    return verify_tube(read_statement(problem.statement()), law, values, tube.as_json())


def both(
    problem: Problem, values: Mapping[str, Fraction], until: str | int, law: str | None = None, **options: Any
) -> Tube:
    """A tube that the kernel has verified, with the same boxes."""
    tube = enclose(problem, law, values, Fraction(until), **options)
    segments = verified(problem, values, tube, law)
    assert [segment.t1 for segment in segments] == list(tube.times[1:])
    for segment in segments:
        ends = {name: (x.lo, x.hi) for name, x in segment.end.items()}
        assert ends == tube.at(segment.t1)
    return tube


OSCILLATOR = motion(lambda x, v: (v, -x), x="state", v="state")
LOGISTIC = motion(lambda x: (x * (1 - x),), x="state")
BODY = motion(
    lambda a, b, c, J, K, L: ((K - L) * b * c / J, (L - J) * c * a / K, (J - K) * a * b / L),
    **dict.fromkeys("abc", "state"),
    **dict.fromkeys("JKL", "parameter"),
)
SPIN = numbers(a=1, b="1/100", c=1, J=1, K=2, L=3)
PENDULUM = motion(
    lambda x, v, u, w: (v, -ca.sin(x) + u + w),
    lambda x, v, u, w: (-ca.tanh(2 * v) / 2,),
    x="state",
    v="state",
    u="input",
    w="signal",
)
