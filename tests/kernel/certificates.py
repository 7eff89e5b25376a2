"""Builders of small certificates for the tests of the kernel."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator
from typing import Any

from symctrl.kernel.certificate import digest
from symctrl.kernel.check import check_text, needed_conditions

Json = dict[str, Any]


def listing(text: str) -> Json:
    """A listing from lines like `a = ADD b c`; an undefined word is an INPUT or, if a number, a CONST.

    The last line is `return a b ..`.
    """
    code: list[list[Any]] = []
    register: dict[str, int] = {}

    def at(word: str) -> int:
        if word not in register:
            number = word.lstrip("-")[:1].isdigit()
            code.append(["CONST" if number else "INPUT", word])
            register[word] = len(code) - 1
        return register[word]

    *lines, last = [line.split() for line in text.strip().splitlines()]
    for target, _, op, *args in lines:
        row = [op, *map(at, args)]
        code.append(row)
        register[target] = len(code) - 1
    body = {"code": code, "outputs": [at(word) for word in last[1:]]}
    return {**body, "sha256": digest(body)}


def seal(certificate: Json) -> Json:
    """The certificate with all its digests recomputed."""
    for one in certificate["statement"]["listings"].values():
        one["sha256"] = digest({"code": one["code"], "outputs": one["outputs"]})
    rest = {key: value for key, value in certificate.items() if key != "sha256"}
    return {**rest, "sha256": digest(rest)}


def certificate(
    listings: dict[str, str],
    proof: Json,
    *,
    scalars: dict[str, str],
    claim: Json | None = None,
    conditions: list[Json] | None = None,
    **tables: Any,
) -> Json:
    """An identity with one entry from the listing `claim`, unless said otherwise.

    conditions: by default those that the kernel finds.
    """
    statement: Json = {
        "study": "tests",
        "id": "one",
        "text": "a small claim",
        "listings": {name: listing(text) for name, text in listings.items()},
        "scalars": scalars,
        "names": {},
        "motion": {},
        "laws": {},
        "given": [],
        "claim": claim or {"kind": "equal", "shape": [1, 1], "listing": "claim"},
        "conditions": conditions or [],
        **tables,
    }
    whole = {"format": "symctrl-certificate/1", "tool": "tests", "statement": statement}
    whole["proof"] = {
        "kind": "identity",
        "generators": [],
        "factors": [],
        "hints": [],
        **copy.deepcopy(proof),
    }
    if conditions is None:
        found = needed_conditions(json.dumps(seal(whole)))
        statement["conditions"] = [{"kind": c.kind, "of": c.of} for c in sorted(found, key=str)]
    return json.loads(json.dumps(seal(whole)))  # no part of it shared with another


def free(*names: str) -> list[Json]:
    return [{"free": name} for name in names]


def given(kind: str, name: str, k: int = 0) -> Json:
    return {"kind": kind, "of": [name, k], "text": "as assumed", "about": "parameter"}


def status(certificate: Json) -> str:
    return check_text(json.dumps(certificate)).status


def explain(certificate: Json) -> str:
    answer = check_text(json.dumps(certificate))
    return f"{answer.status}: {answer.reason}"


def mutations(certificate: Json) -> Iterator[tuple[str, Json]]:
    """Every certificate whose proof differs in one number, string, or shortened list, with right digests."""
    for path in list(_leaves(certificate["proof"], ())):
        for change in _changes(_get(certificate["proof"], path)):
            other = copy.deepcopy(certificate)
            _set(other["proof"], path, change)
            yield f"{path} -> {change}", seal(other)


def _leaves(value: Any, path: tuple[Any, ...]) -> Iterator[tuple[Any, ...]]:
    if isinstance(value, dict | list):
        if path and isinstance(value, list) and value:
            yield path
        items = value.items() if isinstance(value, dict) else enumerate(value)
        for key, child in items:
            yield from _leaves(child, (*path, key))
    elif path:
        yield path


def _changes(value: Any) -> list[Any]:
    if isinstance(value, list):
        return [value[:-1], value[1:], []]
    if isinstance(value, int):
        return [value + 1, value - 1, -value if value else 7]
    return [new for new in (value + "1", "-" + value, "2", "") if new != value]


def _get(value: Any, path: tuple[Any, ...]) -> Any:
    for key in path:
        value = value[key]
    return value


def _set(value: Any, path: tuple[Any, ...], new: Any) -> None:
    _get(value, path[:-1])[path[-1]] = new
