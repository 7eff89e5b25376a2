"""The largest eigenvalue of a fleet's Laplacian: time, memory and bounds, beside what floating point offers.

Run: python benchmarks/fleet.py [NODES] [SECONDS]

Each row is a process of its own: it reads the graph from a file, so that peak memory has all of it. `check`
is the kernel on the certificate of the upper bound. eigsh is that of SciPy, dense is NumPy's eigvalsh, and
CVXPY minimises t over t I - L semidefinite with Clarabel; none of the three gives a bound that is proved.
"""

from __future__ import annotations

import json
import random
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

NODES = 100_000
SECONDS = 120
SIZES = {"dense": 2000, "cvxpy": 100}
WAYS = ("symctrl", "eigsh")
Pairs = Iterator[tuple[int, int]]


def ring(n: int) -> Pairs:
    return ((k, (k + 1) % n) for k in range(n))


def grid(n: int) -> Pairs:
    side = int(n**0.5)
    for k in range(side * side):
        if (k + 1) % side:
            yield k, k + 1
        if k + side < side * side:
            yield k, k + side


def tree(n: int) -> Pairs:
    return ((k, (k - 1) // 2) for k in range(1, n))


def barabasi_albert(n: int) -> Pairs:
    import networkx as nx

    return iter(nx.barabasi_albert_graph(n, 3, seed=1).edges)


def random_regular(n: int) -> Pairs:
    import networkx as nx

    return iter(nx.random_regular_graph(4, n, seed=1).edges)


GRAPHS: dict[str, Callable[[int], Pairs]] = {
    "ring": ring,
    "grid": grid,
    "binary tree": tree,
    "Barabasi-Albert m=3": barabasi_albert,
    "random 4-regular": random_regular,
}


def main(n: int, limit: float) -> None:
    """Print a row for each graph and way, and the ratio of its time to that of symctrl."""
    print(f"{'graph':>20} {'nodes':>7} {'edges':>7} {'way':>8} {'read':>6} {'time':>7} {'ratio':>6} "
          f"{'check':>6} {'peak':>8}  result")  # fmt: skip
    with tempfile.TemporaryDirectory() as folder:
        for name, pairs in GRAPHS.items():
            _rows(Path(folder), name, pairs, n, WAYS, limit)
            for way, size in SIZES.items():
                _rows(Path(folder), name, pairs, size, ("symctrl", way), limit)


def _rows(
    folder: Path, name: str, pairs: Callable[[int], Pairs], n: int, ways: tuple[str, ...], limit: float
) -> None:
    path = folder / "graph.txt"
    edges = list(pairs(n))
    nodes = max(max(edge) for edge in edges) + 1
    lines = [f"{a} {b}\n" for a, b in edges]
    random.Random(1).shuffle(lines)
    path.write_text("".join(lines), encoding="utf-8")
    own = 0.0
    for way in ways:
        found = _run(way, path, limit)
        head = f"{name:>20} {nodes:>7} {len(lines):>7} {way:>8}"
        if isinstance(found, str):
            print(f"{head} {found}")
            continue
        own = own or found["time"]
        check = f"{found['check']:5.2f}s" if "check" in found else ""
        print(f"{head} {found['read']:5.2f}s {found['time']:6.2f}s {found['time'] / own:6.1f} {check:>6} "
              f"{found['peak'] / 1024:5.0f}MiB  {found['result']}", flush=True)  # fmt: skip


def _run(way: str, path: Path, limit: float) -> dict[str, float] | str:
    command = [sys.executable, __file__, way, str(path)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit, check=False)
    except subprocess.TimeoutExpired:
        return f"stopped after {limit:.0f} s"
    if done.returncode:
        return f"failed: {done.stderr.strip().splitlines()[-1][:80] if done.stderr else done.returncode}"
    return json.loads(done.stdout)


def work(way: str, path: str) -> dict[str, object]:
    """What one process does: read, then bound or approximate; the check of the kernel apart."""
    from symctrl.graphs import parse

    began = time.perf_counter()
    graph = parse(path)
    read = time.perf_counter()
    found: dict[str, object] = {"read": read - began}
    if way == "symctrl":
        from symctrl.spectral.bracket import extreme_eigenvalue

        bracket = extreme_eigenvalue(graph)
        found |= {"time": time.perf_counter() - read, "peak": _peak()}
        found |= {
            "result": f"[{float(bracket.low):.9g}, {float(bracket.high):.9g}] by {bracket.proof['kind']}"
        }
        return found | {"check": _check(graph, bracket.high)}
    value = {"eigsh": _eigsh, "dense": _dense, "cvxpy": _cvxpy}[way](graph)
    return found | {"time": time.perf_counter() - read, "peak": _peak(), "result": f"{value:.9g}"}


def _check(graph: object, t: object) -> float:
    from symctrl.certify import canonical
    from symctrl.kernel.check import check_text
    from symctrl.spectral.bracket import decide_at_most

    text = canonical(decide_at_most(graph, t).certificate)
    began = time.perf_counter()
    if check_text(text).status != "valid":
        raise SystemExit("the kernel does not accept the certificate")
    return time.perf_counter() - began


def _eigsh(graph: object) -> float:
    import networkx as nx
    from scipy.sparse.linalg import eigsh

    L = nx.laplacian_matrix(graph).astype(float)
    return float(eigsh(L, k=1, which="LA", return_eigenvectors=False)[0])


def _dense(graph: object) -> float:
    import networkx as nx
    import numpy as np

    return float(np.linalg.eigvalsh(nx.laplacian_matrix(graph).toarray().astype(float))[-1])


def _cvxpy(graph: object) -> float:
    import cvxpy as cp
    import networkx as nx
    import numpy as np

    L = nx.laplacian_matrix(graph).toarray().astype(float)
    t = cp.Variable()
    cp.Problem(cp.Minimize(t), [t * np.eye(len(L)) - L >> 0]).solve(solver=cp.CLARABEL)
    return float(t.value)


def _peak() -> int:
    """KiB; from Linux itself, for the figure of `resource` begins with that of the parent."""
    try:
        return int(Path("/proc/self/status").read_text().partition("VmHWM:")[2].split()[0])
    except (OSError, IndexError):
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


if __name__ == "__main__":
    if sys.argv[1:2] and not sys.argv[1].isdigit():
        print(json.dumps(work(*sys.argv[1:3])))
    else:
        main(int((sys.argv[1:] or [NODES])[0]), float((sys.argv[2:] or [SECONDS])[0]))
