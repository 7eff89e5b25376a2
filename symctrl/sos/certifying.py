"""`symctrl sos --certify`: a Gram matrix or a Lyapunov function that somebody found with floats, made exact.

    {"poly": "x^2 - x*y + y^2", "vars": ["x", "y"], "basis": ["x", "y"], "gram": [[1.0, -0.5], [-0.5, 1.0]]}
    {"vars": ["x", "y"], "field": {"x": "-x + y", "y": "-x - y"}, "lyapunov": "x^2 + y^2", "on": "x <= 4"}

A Gram matrix is rounded and what it misses of the polynomial is put on it exactly; where that does not give a
proof, the polynomial is decided without it. Of a Lyapunov function V, that V >= 0 and that its rate along the
field is at most 0, on the set; numbers are exact as written.
"""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

import numpy as np

from symctrl import files
from symctrl.certify import bundle, canonical, certificate
from symctrl.files import InputError
from symctrl.kernel.check import check_text
from symctrl.sos.answer import answer_apart
from symctrl.sos.problem import Problem, read
from symctrl.sos.proof import Proof
from symctrl.sos.ring import Monomial
from symctrl.sos.rounding import monomial_parts
from symctrl.sos.text import check_names, parse_claim

_SHAPE = 'it must have "poly", "vars", "basis" and "gram", or "vars", "field" and "lyapunov"'


def certify(path: Path, limit: float) -> dict[str, Any]:
    """The answer for the file, as `symctrl sos --json` writes it. Raises InputError."""
    try:
        body = json.loads(files.read(path))
    except (json.JSONDecodeError, RecursionError) as error:
        raise InputError(f"{path}: not JSON ({error})") from None
    if not isinstance(body, dict) or not isinstance(body.get("vars"), list):
        raise InputError(f"{path}: {_SHAPE}")
    names = check_names(body["vars"], f"{path}: vars")
    if set(body) == {"poly", "vars", "basis", "gram"}:
        return _gram(body, names, path, limit)
    if {"vars", "field", "lyapunov"} <= set(body) <= {"vars", "field", "lyapunov", "on"}:
        return _lyapunov(body, names, path, limit)
    raise InputError(f"{path}: {_SHAPE}")


def _text(value: Any, where: str) -> str:
    if not isinstance(value, str):
        raise InputError(f"{where}: must be a text, instead got {str(value)[:40]}")
    return value


def _gram(body: dict[str, Any], names: tuple[str, ...], path: Path, limit: float) -> dict[str, Any]:
    start = time.perf_counter()
    problem = read(_text(body["poly"], f"{path}: poly"), names, "", path.stem, str(path))
    basis = _basis(body["basis"], problem, path)
    matrix = _matrix(body["gram"], len(basis), path)
    inputs = {key: body[key] for key in ("poly", "vars", "basis")} | {"gram": matrix.tolist()}
    parts = monomial_parts(problem.polynomial, [basis], [matrix], problem.ring)
    made = None if parts is None else certificate(problem.statement(), Proof(tuple(parts)).as_json())
    accepted = made is not None and check_text(canonical(made)).status == "valid"
    if problem.strict or not accepted:
        found = answer_apart(problem, inputs, limit)
        found["reason"] += "; the Gram matrix as given, rounded, gives no proof"
        return found
    found = answer_apart(Problem(names, 0 * problem.polynomial, id=path.stem), inputs, limit)
    seconds = round(time.perf_counter() - start, 6)
    reason = "the Gram matrix, rounded and corrected, is exact"
    return found | {"certificate": made, "reason": reason, "seconds": seconds, "tried": ["the Gram matrix"]}


def _basis(value: Any, problem: Problem, path: Path) -> list[Monomial]:
    if not isinstance(value, list) or not value:
        raise InputError(f"{path}: basis: must be a list of monomials")
    found: list[Monomial] = []
    for entry in value:
        p = parse_claim(_text(entry, f"{path}: basis"), problem.names, f"{path}: basis").polynomial
        if len(p) != 1 or p.leading_coefficient() != 1:
            raise InputError(f"{path}: basis: {entry[:40]} is not a monomial")
        found.append(tuple(map(int, p.monoms()[0])))
    if len(set(found)) != len(found):
        raise InputError(f"{path}: basis: a monomial is there twice")
    return found


def _matrix(value: Any, n: int, path: Path) -> Any:
    try:
        matrix = np.array(value, dtype=float)
    except (TypeError, ValueError):
        raise InputError(f"{path}: gram: must be rows of numbers") from None
    if matrix.shape != (n, n):
        raise InputError(f"{path}: gram: must have {n} rows of {n} numbers, as the basis has")
    if not np.isfinite(matrix).all():
        raise InputError(f"{path}: gram: has a number that is not finite")
    if np.abs(matrix - matrix.T).max() > 1e-6 * max(1e-300, float(np.abs(matrix).max())):
        raise InputError(f"{path}: gram: the matrix is not symmetric")
    return (matrix + matrix.T) / 2


def _lyapunov(body: dict[str, Any], names: tuple[str, ...], path: Path, limit: float) -> dict[str, Any]:
    field = body["field"]
    if not isinstance(field, dict) or set(field) != set(names):
        raise InputError(f"{path}: field: must give the rate of each of {', '.join(names)}")
    on = _text(body.get("on", ""), f"{path}: on")
    first = read(_text(body["lyapunov"], f"{path}: lyapunov"), names, on, "V", str(path))
    rate = 0 * first.polynomial
    for name in names:
        speed = parse_claim(_text(field[name], f"{path}: field"), names, f"{path}: field, {name}").polynomial
        rate = rate + first.polynomial.derivative(name) * speed
    text = "the rate of V along the field is at most 0"
    second = Problem(names, -rate, first.nonnegative, first.zero, False, "rate of V", text)
    answers = [(label, answer_apart(p, body, limit)) for label, p in (("V", first), ("-V'", second))]
    worst = max(answers, key=lambda entry: ("proved", "undecided", "refuted").index(entry[1]["verdict"]))[1]
    found = dict(worst)
    found["id"] = path.stem
    found["reason"] = "; ".join(
        f"{label}: {answer['verdict']}, {answer['reason']}" for label, answer in answers
    )
    found["seconds"] = round(sum(answer["seconds"] for _, answer in answers), 6)
    if worst["verdict"] == "proved":
        found["certificate"] = bundle([answer["certificate"] for _, answer in answers])
    return found
