"""Small changes of certificates, with all digests right again."""

from __future__ import annotations

import copy
from typing import Any

from tests.arena.good import (
    X,
    signs,
    states,
)
from tests.kernel.certificates import Json, certificate, given, listing, seal


def changed(case: Json, *path: Any, to: Any, reseal: bool = True) -> Json:
    """The case with one place replaced (`...`: removed), its digests right again."""
    other = copy.deepcopy(case)
    place: Any = other
    for key in path[:-1]:
        place = place[key]
    if to is ...:
        del place[path[-1]]
    else:
        place[path[-1]] = to
    return seal(other) if reseal else other


def more(case: Json, *path: Any, by: Any) -> Json:
    """The case with one more element in a list."""
    place: Any = case
    for key in path:
        place = place[key]
    return changed(case, *path, to=[*place, by])


def relisted(case: Json, name: str, text: str) -> Json:
    return changed(case, "statement", "listings", name, to=listing(text))


def identity(text: str, proof: Json, **tables: Any) -> Json:
    return certificate({"claim": text, **tables.pop("listings", {})}, proof, **{"conditions": [], **tables})


def from_given(kind: str, of: str, proof: Json, conditions: list[Json] | None = None) -> Json:
    """x > 0 by what is given of a listing, where a trick makes it seem known."""
    return signs(
        "positive",
        {"claim": "return x", "g": of},
        [[["1", [X], []]]],
        proof=proof,
        **states("x"),
        given=[given(kind, "g")],
        conditions=conditions or [],
    )
