"""`symctrl posdef`: a matrix from a file, its definiteness, and a certificate for the kernel."""

from __future__ import annotations

import hashlib
import json
import re
import time
from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import log10
from pathlib import Path
from typing import Any

from symctrl.certify import canonical, certificate, listing, tool
from symctrl.decide.definiteness import Definiteness, decide_matrix
from symctrl.kernel.certificate import Declined
from symctrl.kernel.check import verify
from symctrl.kernel.loading import load

FORMAT = "symctrl-posdef/1"
MAX_SIZE = 1000
MAX_DIGITS = 3900  # of a number written out; certificates hold numbers of this length

_TOO_LONG = "their numbers are longer than a certificate may hold"
_NUMBER = re.compile(r"[+-]?(\d+/\d+|(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,6})?)", re.ASCII)
_SHAPE = 'a file must be like {"matrix": [["2", "1/3"], ["1/3", "0.5"]]}'


class PosdefError(ValueError):
    """A matrix that cannot be read; the message is one line: which file, where, what would be right."""


class _Number(str):
    """A JSON number, kept as it is written."""


def read(path: Path | str) -> str:
    """The text of a file. Raises PosdefError where there is none to read."""
    try:
        return Path(path).read_bytes().decode()
    except FileNotFoundError:
        raise PosdefError(f"{path}: there is no such file") from None
    except UnicodeDecodeError:
        raise PosdefError(f"{path}: the file is not UTF-8 text; {_SHAPE}") from None
    except OSError as error:
        raise PosdefError(f"{path}: the file cannot be read ({error.strerror})") from None


def parse(text: str, name: str) -> list[list[Fraction]]:
    """The rows of the symmetric matrix in the JSON `text`, exactly: 0.1 is 1/10.

    name: of the file, for messages. Raises PosdefError where the text is not such a matrix.
    """
    body = _load(text, name)
    if not isinstance(body, dict) or "matrix" not in body:
        raise PosdefError(f'{name}: the field "matrix" is missing; {_SHAPE}')
    unknown = sorted(set(body) - {"matrix"})
    if unknown:
        raise PosdefError(f'{name}: unknown field {json.dumps(unknown[0])}; the only field is "matrix"')
    written = body["matrix"]
    if not isinstance(written, list) or not written:
        raise PosdefError(f'{name}: "matrix" must be a list of at least one row; {_SHAPE}')
    if len(written) > MAX_SIZE:
        raise PosdefError(
            f"{name}: the matrix has {len(written)} rows; at most {MAX_SIZE} can be decided here"
        )
    rows = [_row(row, i, len(written), name) for i, row in enumerate(written, start=1)]
    _check_symmetry(rows, name)
    return rows


def answer(text: str, name: str) -> dict[str, Any]:
    """What `symctrl posdef --json` writes for the file `name` with this text. Raises PosdefError.

    `proved` and `refuted` only with a certificate that the kernel has accepted.
    """
    start = time.perf_counter()
    rows = parse(text, name)
    found = decide_matrix(rows)
    proof = _certificate(rows, found, name)
    doubt = _TOO_LONG if proof is None else _declined(proof)
    return {
        "format": FORMAT,
        "tool": tool(),
        "inputs_sha256": hashlib.sha256(text.encode()).hexdigest(),
        "verdict": "undecided" if doubt else "proved" if found.witness is None else "refuted",
        "definiteness": found.definiteness,
        "rank": found.rank,
        "certificate": None if doubt else proof,
        "witness": None if doubt or found.witness is None else {"x": [str(v) for v in found.witness]},
        "reason": f"exact factors say {found.definiteness}, but {doubt}" if doubt else _reason(rows, found),
        "seconds": round(time.perf_counter() - start, 6),
    }


def _load(text: str, name: str) -> Any:
    def pairs(items: list[tuple[str, Any]]) -> dict[str, Any]:
        names = [key for key, _ in items]
        twice = next((key for key in names if names.count(key) > 1), None)
        if twice is not None:
            raise PosdefError(
                f"{name}: the field {json.dumps(twice)} stands there twice; a field may stand once"
            )
        return dict(items)

    try:
        return json.loads(
            text, object_pairs_hook=pairs, parse_float=_Number, parse_int=_Number, parse_constant=_Number
        )
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        raise PosdefError(f"{name}: not JSON ({error.msg.lower()} at {where}); {_SHAPE}") from None
    except RecursionError:
        raise PosdefError(f"{name}: the JSON is nested too deeply; {_SHAPE}") from None


def _row(row: Any, i: int, n: int, name: str) -> list[Fraction]:
    if not isinstance(row, list):
        raise PosdefError(f"{name}: row {i} must be a list of numbers, instead got {_shown(row)}; {_SHAPE}")
    if len(row) != n:
        raise PosdefError(
            f"{name}: the matrix has {n} rows, but row {i} has {len(row)} entries; "
            "a symmetric matrix has as many entries in each row as it has rows"
        )
    return [_entry(value, f"{name}: entry ({i}, {j})") for j, value in enumerate(row, start=1)]


def _entry(value: Any, where: str) -> Fraction:
    if not isinstance(value, str) or not _NUMBER.fullmatch(value):
        raise PosdefError(f'{where} is {_shown(value)}; it must be a finite number like "2/3", "0.5" or 1e-3')
    exponent = value.lower().partition("e")[2]
    if len(value) + abs(int(exponent or "0")) > MAX_DIGITS:
        raise PosdefError(
            f"{where} is {_shown(value)}; a number may have at most {MAX_DIGITS} digits written out"
        )
    try:
        return Fraction(value)
    except ZeroDivisionError:
        raise PosdefError(f"{where} is {_shown(value)}; its denominator must not be zero") from None


def _shown(value: Any) -> str:
    text = str(value) if isinstance(value, _Number) else json.dumps(value)
    return text if len(text) <= 40 else text[:37] + "..."


def _check_symmetry(rows: Sequence[Sequence[Fraction]], name: str) -> None:
    for i, row in enumerate(rows):
        for j in range(i):
            if row[j] != rows[j][i]:
                raise PosdefError(
                    f"{name}: the matrix is not symmetric: entry ({i + 1}, {j + 1}) is {_cut(row[j])} and "
                    f"entry ({j + 1}, {i + 1}) is {_cut(rows[j][i])}; they must be equal"
                )


def _cut(value: Fraction) -> str:
    """The number, or its size where it is long."""
    bits = value.numerator.bit_length(), value.denominator.bit_length()
    if max(bits) < 120:
        return str(value)
    return f"about {'-' if value < 0 else ''}1e{round((bits[0] - bits[1]) * log10(2))}"


def _declined(proof: Mapping[str, Any]) -> str:
    """Why the kernel does not check the certificate, "" if it accepts it. Raises Invalid if it refuses it."""
    try:
        verify(load(canonical(proof)))
    except Declined as declined:
        return f"the kernel does not check the certificate: {declined}"
    return ""


def _reason(rows: Sequence[Sequence[Fraction]], found: Definiteness) -> str:
    x = found.witness
    if x is not None:
        return f"for the witness x, x'Ax = {_cut(_form(rows, x))} < 0"
    if "ldl" in (found.leaf or {}):
        sign = "positive" if found.definiteness == "positive definite" else "nonnegative"
        return f"A = L D L' exactly, with unit lower triangular L and {sign} D of rank {found.rank}"
    return "A - L L' is exactly diagonally dominant for the L of the certificate"


def _long(value: Fraction) -> bool:
    return max(value.numerator.bit_length(), value.denominator.bit_length()) > MAX_DIGITS / log10(2)


def _form(rows: Sequence[Sequence[Fraction]], x: Sequence[Fraction]) -> Fraction:
    support = [i for i, value in enumerate(x) if value]
    return sum((x[i] * rows[i][j] * x[j] for i in support for j in support), Fraction(0))


def _certificate(rows: Sequence[Sequence[Fraction]], found: Definiteness, name: str) -> dict[str, Any] | None:
    """The claim that holds, proved; or the claim of semidefiniteness, shown false."""
    proof: dict[str, Any]
    if any(_long(v) for v in found.witness or ()):
        return None
    if found.witness is not None:
        kind = "positive_semidefinite"
        proof = {"kind": "witness", "values": {}, "x": [str(v) for v in found.witness]}
    elif found.leaf is None:
        return None
    else:
        kind = found.definiteness.replace(" ", "_")
        empty: dict[str, Any] = {"generators": [], "factors": [], "hints": []}
        proof = {"kind": "definite", **empty, "matrix": found.leaf}
    return certificate(_statement(rows, kind, name), proof)


def _statement(rows: Sequence[Sequence[Fraction]], kind: str, name: str) -> dict[str, Any]:
    """One constant a distinct value; an entry and its mirror image are one output."""
    n = len(rows)
    register: dict[Fraction, int] = {}
    outputs = [register.setdefault(rows[i][j], len(register)) for i in range(n) for j in range(i + 1)]
    at = [[max(i, j) * (max(i, j) + 1) // 2 + min(i, j) for j in range(n)] for i in range(n)]
    return {
        "study": "posdef",
        "id": Path(name).stem,
        "text": f"the {n} x {n} matrix of {Path(name).name} is {kind.replace('_', ' ')}",
        "listings": {"matrix": listing([["CONST", str(value)] for value in register], outputs)},
        "scalars": {},
        "names": {},
        "motion": {},
        "laws": {},
        "given": [],
        "claim": {"kind": kind, "matrix": {"entries": at}, "listing": "matrix"},
        "conditions": [],
    }
