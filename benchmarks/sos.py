"""Exact proofs of nonnegativity, against the float answers of solvers to the same questions.

    OPENBLAS_NUM_THREADS=1 python benchmarks/sos.py [--limit SECONDS] [--sizes 4 6 8 10] [--chains 6 10 20 40]

Dense quartics p = z'(RR' + I)z in all monomials z of degree 2 with a random integer R, and chains of
Rosenbrock's function made strictly positive. `proof` is everything from the polynomial to the acceptance of
its certificate by the kernel; `check` is the kernel alone. Peers build and solve, and give floats: Clarabel
called directly with its faster factorisation (faer); SumOfSquares.py and Drake where they are installed. None
is asked again once it takes longer than the limit, nor where its Gram matrix has more than
100 rows (it would take gigabytes). Ratios are peer over proof; each time is the best of two.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
import time
from collections.abc import Callable
from importlib.util import find_spec
from itertools import pairwise
from math import comb
from typing import Any

import clarabel
import numpy as np
from scipy import sparse

from symctrl.certify import canonical
from symctrl.kernel.check import check_text
from symctrl.sos.basis import half_newton, monomials
from symctrl.sos.decide import decide
from symctrl.sos.problem import Problem
from symctrl.sos.ring import from_terms, ring, terms


def dense(n: int) -> Problem:
    """z'(RR' + I)z with entries of R from -3 to 3."""
    draw = np.random.default_rng(n)
    basis = monomials(n, 2)
    r = draw.integers(-3, 4, (len(basis), len(basis)))
    gram = r @ r.T + np.eye(len(basis), dtype=int)
    table: dict[Any, int] = {}
    for a, row in zip(basis, gram.tolist(), strict=True):
        for b, value in zip(basis, row, strict=True):
            m = tuple(x + y for x, y in zip(a, b, strict=True))
            table[m] = table.get(m, 0) + value
    names = tuple(f"x{k}" for k in range(n))
    return Problem(names, from_terms(ring(names), table))


def chain(n: int) -> Problem:
    """The sum of 10 (x_{k+1} - x_k^2)^2 + (1 - x_k)^2, plus 1/10 and small fourth powers."""
    names = tuple(f"x{k}" for k in range(n))
    xs = ring(names).gens()
    p = sum(10 * (b - a * a) ** 2 + (1 - a) ** 2 for a, b in pairwise(xs))
    return Problem(names, (100 * p + sum(x**4 for x in xs) + 10) / 100)


def ours(problem: Problem) -> tuple[float, float]:
    """Seconds for the proof, and for its check alone."""
    start = time.perf_counter()
    found = decide(problem, 300)
    seconds = time.perf_counter() - start
    if found.verdict != "proved":
        raise SystemExit(f"{found.verdict}: {found.reason}")
    text = canonical(found.certificate)
    start = time.perf_counter()
    if check_text(text).status != "valid":
        raise SystemExit("the certificate is not valid")
    return seconds, time.perf_counter() - start


def by_clarabel(problem: Problem) -> float:
    """Is p a sum of squares? One Gram matrix, coefficients matched."""
    start = time.perf_counter()
    table = terms(problem.polynomial)
    basis = half_newton(table)
    size = max(abs(float(c)) for c in table.values())
    place: dict[Any, int] = {}
    rows, values = [], []
    for i, a in enumerate(basis):
        for j in range(i + 1):
            m = tuple(x + y for x, y in zip(a, basis[j], strict=True))
            rows.append(place.setdefault(m, len(place)))
            values.append(1.0 if i == j else np.sqrt(2))
    count = len(rows)
    match = sparse.csc_matrix((values, (rows, range(count))), shape=(len(place), count))
    right = np.zeros(len(place))
    for m, c in table.items():
        right[place[m]] = float(c) / size
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_threads = 1
    settings.direct_solve_method = "faer"
    clarabel.DefaultSolver(
        sparse.csc_matrix((count, count)),
        np.zeros(count),
        sparse.vstack([match, -sparse.eye(count, format="csc")], format="csc"),
        np.concatenate([right, np.zeros(count)]),
        [clarabel.ZeroConeT(len(place)), clarabel.PSDTriangleConeT(len(basis))],
        settings,
    ).solve()
    return time.perf_counter() - start


def by_sumofsquares(problem: Problem) -> float:
    """SumOfSquares.py with CVXOPT, as its users call it."""
    import sympy as sp
    from SumOfSquares import SOSProblem

    start = time.perf_counter()
    xs = sp.symbols(list(problem.names))
    whole = SOSProblem()
    whole.add_sos_constraint(sp.sympify(str(problem.polynomial).replace("^", "**")), xs)
    whole.solve(solver="cvxopt")
    return time.perf_counter() - start


def by_drake(problem: Problem) -> float:
    """Drake with Clarabel."""
    from pydrake.solvers import ClarabelSolver, MathematicalProgram
    from pydrake.symbolic import Polynomial

    start = time.perf_counter()
    program = MathematicalProgram()
    xs = program.NewIndeterminates(len(problem.names), "x")
    total = 0.0
    for m, c in terms(problem.polynomial).items():
        term = float(c)
        for x, e in zip(xs, m, strict=True):
            if e:
                term = term * x**e
        total = total + term
    program.AddSosConstraint(Polynomial(total))
    ClarabelSolver().Solve(program)
    return time.perf_counter() - start


PEERS: dict[str, tuple[str, Callable[[Problem], float]]] = {
    "Clarabel": ("clarabel", by_clarabel),
    "SumOfSquares.py": ("SumOfSquares", by_sumofsquares),
    "Drake": ("pydrake", by_drake),
}


def compare(title: str, make: Callable[[int], Problem], sizes: list[int], limit: float) -> None:
    peers = {name: run for name, (module, run) in PEERS.items() if find_spec(module)}
    print(f"{title:>8} {'proof':>9} {'check':>9} " + " ".join(f"{name:>17} {'ratio':>8}" for name in peers))
    asked = dict.fromkeys(peers, True)
    for n in sizes:
        problem = make(n)
        best = min(ours(problem), ours(problem))
        line = f"{n:8} {best[0]:9.4f} {best[1]:9.4f} "
        for name, run in peers.items():
            if not asked[name] or comb(n + 2, 2) > 100:
                line += f" {'not asked':>17} {'':>8}"
                continue
            seconds = run(problem)
            asked[name] = seconds <= limit
            seconds = min(seconds, run(problem)) if asked[name] else seconds
            line += f" {seconds:17.4f} {seconds / best[0]:8.1f}"
        print(line, flush=True)


def main() -> None:
    options = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    options.add_argument("--limit", type=float, default=3.0)
    options.add_argument("--sizes", type=int, nargs="*", default=[4, 5, 6, 7, 8, 9, 10])
    options.add_argument("--chains", type=int, nargs="*", default=[6, 8, 10, 20, 40, 100])
    asked = options.parse_args()
    print("seconds; ratio: peer / proof")
    compare("dense n", dense, asked.sizes, asked.limit)
    compare("chain n", chain, asked.chains, asked.limit)


if __name__ == "__main__":
    main()
