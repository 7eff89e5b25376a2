"""Putting a certificate together: instruction lists with their digests, and the whole with its own."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.metadata import version
from typing import Any

FORMAT = "symctrl-certificate/1"
BUNDLE_FORMAT = "symctrl-certificates/1"


@cache
def tool() -> str:
    """The tool's name and version, as it stands in every JSON that the tool writes."""
    return f"symctrl {version('symctrl')}"


def canonical(obj: object) -> str:
    """The JSON text of `obj` that digests are taken over: sorted keys, no spaces, only JSON's own values.

    Raises ValueError for a NaN or an infinity, TypeError for what JSON has no form for.
    """
    return json.dumps(obj, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)


def digest(obj: object) -> str:
    """SHA-256 of the canonical JSON of `obj` in UTF-8, in hexadecimal."""
    return hashlib.sha256(canonical(obj).encode()).hexdigest()


def listing(code: Sequence[Sequence[Any]], outputs: Sequence[int]) -> dict[str, Any]:
    """An instruction list (docs/certificates.md) with its digest.

    code: `["INPUT", name]`, `["CONST", "p/q"]` or `[OP, register..]`; outputs: registers, in order.
    """
    body = {"code": [list(step) for step in code], "outputs": list(outputs)}
    return {**body, "sha256": digest(body)}


def certificate(statement: Mapping[str, Any], proof: Mapping[str, Any]) -> dict[str, Any]:
    """A complete certificate of `statement` by `proof`, with the digest over everything else in it."""
    body = {"format": FORMAT, "tool": tool(), "statement": dict(statement), "proof": dict(proof)}
    return {**body, "sha256": digest(body)}


def bundle(parts: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Certificates of the parts of one claim, in order, with the digest over everything else in it."""
    body = {"format": BUNDLE_FORMAT, "tool": tool(), "parts": [dict(part) for part in parts]}
    return {**body, "sha256": digest(body)}
