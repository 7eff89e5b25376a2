"""From the text of a certificate to its content, completely checked.

Soundness-critical. Last reviewed 2026-11-24.

Relies on no theorem. Another format or version, a key twice, and what is too large or no JSON are unreadable;
every field is known and used, and every digest is recomputed.
"""

from __future__ import annotations

import json
from typing import Any

from symctrl.kernel.certificate import (
    MAX_DIGITS,
    Declined,
    Invalid,
    Unreadable,
    digest,
    fields,
    text_field,
    typed,
)
from symctrl.kernel.closure import require_closed
from symctrl.kernel.form import read_statement
from symctrl.kernel.values import Certificate

FORMAT = "symctrl-certificate/1"
BUNDLE_FORMAT = "symctrl-certificates/1"
MAX_PARTS = 1000
MAX_TEXT = 64 * 2**20  # characters


def load(text: str) -> Certificate:
    """The one certificate that the text holds; see `read_all`. Raises Invalid for a bundle."""
    certificates = read_all(text)
    if len(certificates) != 1:
        raise Invalid(f"a bundle of {len(certificates)} certificates, where one is wanted")
    return read(certificates[0])


def read_all(text: str) -> list[Any]:
    """The JSON of the certificate that the text holds, or that of each part of a bundle.

    Raises Unreadable for what is no certificate of a known version, Invalid for one that is malformed, and
    Declined for one that exceeds a size limit.
    """
    top = _parse(text)
    if type(top) is not dict or top.get("format") != BUNDLE_FORMAT:
        return [top]
    fields(top, ("format", "tool", "parts", "sha256"), "the bundle")
    _require_digest(top, "the bundle")
    text_field(top["tool"], "tool")
    parts = typed(top["parts"], list, "parts")
    if not parts:
        raise Invalid("the bundle has no parts")
    if len(parts) > MAX_PARTS:
        raise Declined(f"a bundle of more than {MAX_PARTS} parts")
    return parts


def read(value: Any) -> Certificate:
    """A certificate from its JSON. Raises as `read_all` does."""
    top = opened(value)
    statement = read_statement(top["statement"])
    require_closed(statement)
    proof = typed(top["proof"], dict, "proof")
    return Certificate(text_field(top["tool"], "tool"), statement, proof)


def opened(value: Any) -> dict[str, Any]:
    """The fields of a certificate, its format and digest being right. Raises as `read_all` does."""
    version = value.get("format") if type(value) is dict else None
    if version != FORMAT:
        raise Unreadable(f"its format is {str(version)[:60]!r}, and only {FORMAT!r} is known")
    top = fields(value, ("format", "tool", "statement", "proof", "sha256"), "the certificate")
    _require_digest(top, "the certificate")
    return top


def _require_digest(top: dict[str, Any], what: str) -> None:
    if top["sha256"] != digest({key: value for key, value in top.items() if key != "sha256"}):
        raise Invalid(f"the sha256 of {what} is not that of its content")


def _parse(text: str) -> Any:
    if len(text) > MAX_TEXT:
        raise Unreadable(f"the certificate is longer than {MAX_TEXT} characters")
    try:
        text.encode()
        return json.loads(
            text,
            object_pairs_hook=_object,
            parse_int=_integer,
            parse_float=_no_float,
            parse_constant=_no_constant,
        )
    except (json.JSONDecodeError, UnicodeError) as error:
        raise Unreadable(f"not JSON: {str(error)[:200]}") from None
    except RecursionError:
        raise Unreadable("the certificate is nested too deeply") from None


def _object(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    table = dict(pairs)
    if len(table) != len(pairs):
        raise Unreadable("an object has the same key twice")
    return table


def _integer(text: str) -> int:
    if len(text) > MAX_DIGITS:
        raise Declined(f"a number has more than {MAX_DIGITS} digits")
    if text == "-0":
        raise Invalid("the number -0 is written as 0")
    return int(text)


def _no_float(text: str) -> Any:
    raise Invalid(f'{text[:40]} is a decimal; exact numbers are integers or strings like "-3/4"')


def _no_constant(text: str) -> Any:
    raise Unreadable(f"{text} is not a number of JSON")
