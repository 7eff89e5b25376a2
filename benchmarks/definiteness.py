"""Exact definiteness with a checked certificate, against the float answer of CVXPY with Clarabel.

    OPENBLAS_NUM_THREADS=1 python benchmarks/definiteness.py [--limit SECONDS]

Random Gram matrices with rational entries, positive definite. `answer` is everything from the text of the
matrix to the acceptance of its certificate by the kernel; `check` is `symctrl check` of the certificate file
again. The peer maximises t subject to A - t I >= 0, as its users do; it is not asked again for larger ones
once it takes longer than the limit. The ratio is peer over answer. Each is the best of two.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
import json
import random
import time
import warnings
from collections.abc import Callable
from typing import Any

import cvxpy as cp
import numpy as np

from symctrl.kernel.check import check_text
from symctrl.posdef import answer

SIZES = (5, 10, 20, 40, 60, 80, 100, 150, 200)


def matrix(n: int) -> list[list[str]]:
    """B B'/4 + I/8 for a random integer B: entries as strings "p/q"."""
    draw = random.Random(n)
    b = np.array([[draw.randint(-9, 9) for _ in range(n + 2)] for _ in range(n)])
    return [[f"{2 * int(v) + (i == j)}/8" for j, v in enumerate(row)] for i, row in enumerate(b @ b.T)]


def ours(text: str) -> tuple[float, str]:
    """Seconds until the answer, and its certificate as text."""
    start = time.perf_counter()
    found = answer(text, "matrix.json")
    seconds = time.perf_counter() - start
    if found["verdict"] != "proved" or found["definiteness"] != "positive definite":
        raise SystemExit(f"the answer is {found['verdict']}: {found['reason']}")
    return seconds, json.dumps(found["certificate"])


def check(certificate: str) -> float:
    """Seconds for the checker on the certificate."""
    start = time.perf_counter()
    checked = check_text(certificate)
    if checked.status != "valid":
        raise SystemExit(f"the certificate is {checked.status}: {checked.reason}")
    return time.perf_counter() - start


def peer(a: Any) -> float:
    """Seconds for the largest t with A - t I >= 0; a has shape (n, n)."""
    start = time.perf_counter()
    t = cp.Variable()
    problem = cp.Problem(cp.Maximize(t), [a - t * np.eye(len(a)) >> 0])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        problem.solve(solver=cp.CLARABEL)
    return time.perf_counter() - start


def best(run: Callable[[], Any]) -> Any:
    return min(run(), run())


def main() -> None:
    options = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    options.add_argument(
        "--limit", type=float, default=10.0, help="seconds after which the peer is not asked again"
    )
    limit = options.parse_args().limit
    asked = True
    print(f"{'n':>4} {'answer':>9} {'check':>9} {'CVXPY + Clarabel':>17} {'ratio':>8}   (seconds)")
    for n in SIZES:
        rows = matrix(n)
        text = json.dumps({"matrix": rows})
        answered, certificate = best(lambda text=text: ours(text))
        checked = best(lambda certificate=certificate: check(certificate))
        line = f"{n:4} {answered:9.4f} {checked:9.4f}"
        if not asked:
            print(f"{line} {'not asked':>17} {'':>8}")
            continue
        a = np.array([[float(int(v.split("/")[0]) / 8) for v in row] for row in rows])
        seconds = best(lambda a=a: peer(a))
        asked = seconds <= limit
        print(f"{line} {seconds:17.4f} {seconds / answered:8.1f}", flush=True)


if __name__ == "__main__":
    main()
