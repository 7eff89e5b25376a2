"""How fast an enclosure is: Arb's balls by the pre-bound walk and by one that looks up; mpmath's intervals.

Run: python benchmarks/interval.py
"""

from __future__ import annotations

import timeit
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import casadi as ca
from mpmath import iv

from symctrl.domains.domain import Domain, Operators
from symctrl.domains.interval import IntervalDomain, ball
from symctrl.graph import Tape, prebound, read


def closed_loop() -> Tape:
    """A rigid body under quaternion feedback, saturated in its rate: acceleration, and rate of energy."""
    q, w, t, entries = (ca.SX.sym(name, size) for name, size in (("q", 3), ("w", 3), ("t", 3), ("J", 6)))
    inertia = ca.reshape(entries[[0, 1, 2, 1, 3, 4, 2, 4, 5]], 3, 3)
    scalar = ca.sqrt(4 - ca.sumsqr(q))
    torque = -2 * q - ca.tanh(w / 2) + ca.sin(t)
    acceleration = ca.inv(inertia) @ (torque - ca.cross(w, inertia @ w))
    turning = (scalar * w + ca.cross(q, w)) / 2
    energy_rate = ca.dot(w, inertia @ acceleration) + ca.dot(q, turning) + ca.exp(-ca.sumsqr(w))
    return read(ca.Function("closed_loop", [q, w, t, entries], [energy_rate, acceleration]))


class MpmathIntervals(Operators[Any]):
    """The operations of the example in mpmath's interval context."""

    name = "mpmath iv"
    exp_, sin_, cos_ = (staticmethod(function) for function in (iv.exp, iv.sin, iv.cos))

    def constant(self, value: Fraction) -> Any:
        return iv.mpf(value.numerator) / value.denominator

    def sq_(self, a: Any) -> Any:
        return a**2

    def sqrt_(self, a: Any) -> Any:
        return iv.sqrt(a)

    def tanh_(self, a: Any) -> Any:
        return 1 - 2 / (iv.exp(2 * a) + 1)


def looked_up(tape: Tape, domain: Domain[Any]) -> Callable[[Sequence[Any]], list[Any]]:
    """The walk that looks up each operation at each instruction."""

    def run(inputs: Sequence[Any]) -> list[Any]:
        given = iter(inputs)
        work: list[Any] = []
        for step in tape.code:
            if step.op == "INPUT":
                work.append(next(given))
            elif step.op == "CONST":
                work.append(domain.constant(step.value))
            else:
                work.append(domain.operation(step.op)(*[work[a] for a in step.args]))
        return [work[r] for r in tape.outputs]

    return run


def seconds(run: Callable[[], object]) -> float:
    """The best of five of one evaluation."""
    return min(timeit.repeat(run, number=20, repeat=5)) / 20


def main() -> None:
    tape = closed_loop()
    middles = [*(Fraction(k, 10) for k in range(1, 10)), *map(Fraction, (20, 1, 2, 17, 3, 15))]
    ends = [(middle, middle + Fraction(1, 1000)) for middle in middles]
    domain = IntervalDomain(bits=128)
    iv.prec = 128
    bound, searching = prebound(tape, domain), looked_up(tape, domain)
    mpmath = prebound(tape, MpmathIntervals())
    boxes = [iv.mpf([float(low), float(high)]) for low, high in ends]
    with domain.working():
        balls = [ball(*box) for box in ends]
        rows = {
            "arb, pre-bound walk": seconds(lambda: bound(balls)),
            "arb, operations looked up": seconds(lambda: searching(balls)),
            "mpmath iv, pre-bound walk": seconds(lambda: mpmath(boxes)),
        }
    print(f"{len(tape.code)} instructions, {len(tape.inputs)} inputs, 128 bits")
    for name, time in rows.items():
        ratio = time / rows["arb, pre-bound walk"]
        each = time / len(tape.code) * 1e6
        print(f"{name:<28}{1 / time:>10.0f} boxes/s {each:8.2f} us/instruction {ratio:7.1f}x")


if __name__ == "__main__":
    main()
