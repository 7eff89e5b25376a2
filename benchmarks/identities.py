"""Identities of attitude dynamics in the exact domain, against what a user of SymPy would do.

    python benchmarks/identities.py [--limit SECONDS] [CASE ...]

Each case is one claim left = right, entry by entry. `exact` is from the claim's instruction lists to "zero on
the domain"; `certified` also has the certificate made and accepted by the kernel. SymPy gets left minus right
of the same lists. `simplify`, `trigsimp` and `cancel` work entry by entry; where the result is not zero and a
norm is given, it is put in and simplified again. `field` is what an expert would write: sympy.field over the
symbols with a sine and a cosine for each angle, and the remainder of the numerator by the relations. Each is
the best of three in one run, in a process of its own that is ended at the limit. Ratios are over `exact`.
"""

from __future__ import annotations

import argparse
import multiprocessing
import time
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

import casadi as ca
import sympy

from symctrl import Study, equal
from symctrl.collect import Collector
from symctrl.decide.decision import decide
from symctrl.decide.identity import residuals, vanishes
from symctrl.decide.session import Session, exactly
from symctrl.domains.domain import Operators
from symctrl.domains.sympy_ import SympyDomain
from symctrl.evaluate import Environment
from symctrl.expr import Expr, foreign
from symctrl.problem import Problem
from symctrl.vectors import cos, cross, eye, inverse, row, sin, skew, stack, tan
from symctrl.verdict import Outcome

REPEATS = 3
Result = tuple[float, bool]  # seconds, and whether every entry was found to be zero


# The claims


def angles() -> Problem:
    """a: the rate of a direction cosine matrix by the angles 3-2-1 is -w^x R."""
    study = Study("a")
    at, w = study.state("a", 3), study.state("w", 3)
    return claim(study, _along(_matrix(at), (at, _angle_rates(at, w))), -skew(w) @ _matrix(at))


def quaternion() -> Problem:
    """b: the direction cosine matrix of a unit quaternion is orthogonal."""
    study = Study("b")
    q = study.unit_quaternion("q")
    v, s = q.vector, q.scalar
    R = (s**2 - v.T @ v) * eye(3) + 2 * (v @ v.T) - 2 * s * skew(v)
    return claim(study, R.T @ R, eye(3))


def parameters() -> Problem:
    """c1: G'G = (1 + s's)²/16 I for the rate s' = G w of modified Rodrigues parameters."""
    study = Study("c1")
    s = study.state("s", 3)
    n = s.T @ s
    G = ((1 - n) * eye(3) + 2 * skew(s) + 2 * (s @ s.T)) / 4
    return claim(study, G.T @ G, (1 + n) ** 2 / 16 * eye(3))


def composition() -> Problem:
    """c2: two rotations one after the other by modified Rodrigues parameters (Schaub and Junkins, 3.6)."""
    study = Study("c2")
    s, r = study.state("s", 3), study.state("r", 3)
    a, b = s.T @ s, r.T @ r
    both = ((1 - a) * r + (1 - b) * s - 2 * cross(r, s)) / (1 + a * b - 2 * (s.T @ r))
    return claim(study, _rodrigues(both), _rodrigues(r) @ _rodrigues(s))


def two_bodies() -> Problem:
    """d: rates of relative attitude (9 entries) and of the relative place of a point (3), of 21 symbols."""
    study = Study("d")
    one, two, w1, w2 = (study.state(name, 3) for name in ("a", "b", "u", "w"))
    place, speed, arm = (study.state(name, 3) for name in ("r", "v", "p"))
    A, B = _matrix(one), _matrix(two)
    seen = A @ (place + B.T @ arm)
    motion = (one, _angle_rates(one, w1)), (two, _angle_rates(two, w2)), (place, speed)
    attitude = -skew(w2) @ B @ A.T + B @ A.T @ skew(w1)
    moved = cross(seen, w1) + A @ speed + A @ B.T @ cross(w2, arm)
    left = [_along(B @ A.T, *motion)[:, c] for c in range(3)]
    right = [attitude[:, c] for c in range(3)]
    return claim(study, stack(*left, _along(seen, *motion)), stack(*right, moved))


def regressor() -> Problem:
    """f: J a + w^x J w is linear in the six moments of inertia, with w seen in another frame."""
    study = Study("f")
    q = study.unit_quaternion("q")
    w, a = study.state("w", 3), study.state("a", 3)
    J = study.inertia("J")
    v, s = q.vector, q.scalar
    seen = 2 * (s**2 * w + (v.T @ w) * v - s * cross(v, w)) - w
    moments = stack(J[0, 0], J[1, 1], J[2, 2], J[1, 2], J[0, 2], J[0, 1])
    Y = _linear(a) + skew(seen) @ _linear(seen)
    return claim(study, J @ a + cross(seen, J @ seen), Y @ moments)


def formation() -> Problem:
    """e: the motion of one craft of a formation in the vector part of its quaternion."""
    study = Study("e")
    q = study.unit_quaternion("q")
    w, J, u = study.state("w", 3), study.inertia("J"), study.input("u", 3)
    Q = (q.scalar * eye(3) + skew(q.vector)) / 2
    study.motion(q.vector, Q @ w)
    study.motion(q.scalar, -q.vector.T @ w / 2)
    study.motion(w, inverse(J) @ (u - cross(w, J @ w)))
    P = inverse(Q)
    moved = study.rate(Q) @ w
    left = P.T @ J @ P @ study.rate(study.rate(q.vector))
    return claim(study, left, P.T @ (u - cross(w, J @ w)) + P.T @ J @ P @ moved)


CASES: Mapping[str, Callable[[], Problem]] = {
    "a": angles,
    "b": quaternion,
    "c1": parameters,
    "c2": composition,
    "d": two_bodies,
    "f": regressor,
    "e": formation,
}


def claim(study: Study, left: Expr, right: Expr) -> Problem:
    return Collector(study).problem(equal(left, right), study.name)


def _matrix(at: Expr) -> Expr:
    (cf, sf), (ct, st), (cp, sp) = ((cos(at[k]), sin(at[k])) for k in range(3))
    first = stack(row(1, 0, 0), row(0, cf, sf), row(0, -sf, cf))
    second = stack(row(ct, 0, -st), row(0, 1, 0), row(st, 0, ct))
    third = stack(row(cp, sp, 0), row(-sp, cp, 0), row(0, 0, 1))
    return first @ second @ third


def _angle_rates(at: Expr, w: Expr) -> Expr:
    f, t = at[0], at[1]
    turned = sin(f) * w[1] + cos(f) * w[2]
    return stack(w[0] + tan(t) * turned, cos(f) * w[1] - sin(f) * w[2], turned / cos(t))


def _along(M: Expr, *motion: tuple[Expr, Expr]) -> Expr:
    """The rate of M by CasADi."""
    change = sum(ca.mtimes(ca.jacobian(ca.vec(M.sx), x.sx), dx.sx) for x, dx in motion)
    return foreign(ca.reshape(change, *M.shape), "rate")


def _rodrigues(s: Expr) -> Expr:
    n = s.T @ s
    return eye(3) + (8 * (skew(s) @ skew(s)) - 4 * (1 - n) * skew(s)) / (1 + n) ** 2


def _linear(a: Expr) -> Expr:
    """L(a) with J a = L(a) (J11, J22, J33, J23, J13, J12)."""
    x, y, z = a[0], a[1], a[2]
    return stack(row(x, 0, 0, 0, z, y), row(0, y, 0, z, 0, x), row(0, 0, z, y, x, 0))


# The ways


def exact(problem: Problem) -> bool:
    def work(session: Session) -> bool:
        return all(vanishes(session, value) for value in residuals(session))

    return exactly(problem, work)


def certified(problem: Problem) -> bool:
    return decide(problem).outcome is Outcome.PROVED


class Field(Operators[Any]):
    """Elements of sympy.field over the symbols and a sine and cosine for each."""

    name = "sympy.field"

    def __init__(self, problem: Problem) -> None:
        names = sorted(
            {n for tape in problem.listings.values() for n in tape.inputs if n not in problem.names}
        )
        angles = "SIN" in {step.op for tape in problem.listings.values() for step in tape.code}
        plain = [sympy.Symbol(n) for n in names]
        turned = [sympy.Symbol(f"{f}({n})") for f in ("sin", "cos") for n in names] if angles else []
        self.field = sympy.polys.fields.FracField([*turned, *plain], sympy.QQ, sympy.lex)
        gens = self.field.gens
        self.at = dict(zip(names, gens[len(turned) :], strict=True))
        self.turned = {g: (gens[k], gens[k + len(names)]) for k, g in enumerate(self.at.values()) if angles}
        self.relations = [s.numer**2 + c.numer**2 - 1 for s, c in self.turned.values()]

    def constant(self, value: Fraction) -> Any:
        return self.field(sympy.QQ(value.numerator, value.denominator))

    def sin_(self, a: Any) -> Any:
        return self.turned[a][0]

    def cos_(self, a: Any) -> Any:
        return self.turned[a][1]

    def pow_(self, a: Any, b: Any) -> Any:
        return a ** int(b.as_expr())


def field(problem: Problem) -> bool:
    domain = Field(problem)
    at = Environment(problem, domain, domain.at.__getitem__, _NoSums())
    given = [at.output(of, {}).numer for a in problem.given if a.kind == "zero" for of in a.of]
    relations = domain.relations + given
    return all(not value.numer.rem(relations) for value in _differences(problem, at))


def entrywise(simplify: Callable[[Any], Any]) -> Callable[[Problem], bool]:
    """Every entry by a function of SymPy, and again with the norm put in where that is not enough."""

    def work(problem: Problem) -> bool:
        domain = SympyDomain()
        at = Environment(problem, domain, domain.symbol, _NoSums())
        norms = [at.output(of, {}) for a in problem.given if a.kind == "zero" for of in a.of]
        put = [(q**2, sympy.expand(q**2 - norm)) for norm in norms for q in [max(norm.free_symbols, key=str)]]
        entries = [simplify(value) for value in _differences(problem, at)]
        return all(e == 0 or (put and simplify(sympy.expand(e).subs(put)) == 0) for e in entries)

    return work


def _differences(problem: Problem, at: Environment) -> list[Any]:
    outputs = at.outputs(problem.claim.listing, {})
    half = len(outputs) // 2
    return [a - b for a, b in zip(outputs[:half], outputs[half:], strict=True)]


class _NoSums:
    def value(self, at: Environment, name: str, level: int, law: str | None) -> Any:
        raise LookupError(f"the identities of this benchmark have no sums over a graph: {name}")


WAYS: Mapping[str, Callable[[Problem], bool]] = {
    "exact": exact,
    "certified": certified,
    "simplify": entrywise(sympy.simplify),
    "trigsimp": entrywise(sympy.trigsimp),
    "cancel": entrywise(lambda e: sympy.cancel(sympy.together(e))),
    "field": field,
}


def timed(way: str, case: str, limit: float) -> Result | None:
    """The best of three in a process of its own; None at the limit."""
    context = multiprocessing.get_context("fork")
    ours, theirs = context.Pipe(duplex=False)
    process = context.Process(target=_measure, args=(way, case, theirs))
    process.start()
    found: Result | None = None
    try:
        while ours.poll(limit):
            message = ours.recv()
            if message is None:
                break
            found = message if found is None else (min(found[0], message[0]), message[1])
    finally:
        process.kill()
        process.join()
    return found


def _measure(way: str, case: str, out: Any) -> None:
    problem = CASES[case]()
    for _ in range(REPEATS):
        sympy.core.cache.clear_cache()
        start = time.perf_counter()
        done = WAYS[way](problem)
        out.send((time.perf_counter() - start, done))
    out.send(None)


def shown(found: Result | None, base: float, limit: float) -> str:
    if found is None:
        return f"> {limit:g} s, > x{limit / base:.0f}"
    return f"{1000 * found[0]:.1f} ms x{found[0] / base:.1f}" + ("" if found[1] else " (not all zero)")


def main() -> None:
    options = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    options.add_argument("--limit", type=float, default=60.0, help="seconds for each way and case")
    options.add_argument("cases", nargs="*", default=list(CASES), metavar="CASE")
    given = options.parse_args()
    for case in given.cases:
        size = sum(len(tape.code) for tape in CASES[case]().listings.values())
        base = timed("exact", case, given.limit)
        if base is None or not base[1]:
            raise SystemExit(f"{case}: the exact domain does not show it")
        print(f"{case} ({size} instructions): exact {1000 * base[0]:.2f} ms", flush=True)
        for way in list(WAYS)[1:]:
            if way == "trigsimp" and case not in ("a", "d"):
                continue
            print(f"    {way:10} {shown(timed(way, case, given.limit), base[0], given.limit)}", flush=True)


if __name__ == "__main__":
    main()
