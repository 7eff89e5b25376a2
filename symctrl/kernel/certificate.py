"""Outcomes, names and numbers: strict reading of the smallest parts of a certificate.

Soundness-critical. Last reviewed 2026-11-24.

Relies on no theorem: a number has one way of being written, a table has exactly its fields, and a name has
one meaning at each node.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Collection
from fractions import Fraction
from math import gcd
from typing import Any, TypeVar

MAX_DIGITS = 4000
MAX_STRING = 20_000


class Refused(ValueError):  # noqa: N818  (an outcome, named as it is printed)
    """Why a certificate is not valid; `status` is the answer."""

    status = ""


class Unreadable(Refused):
    """Not a certificate of a known version at all."""

    status = "unreadable"


class Invalid(Refused):
    """The certificate is malformed, or does not prove what it states; the message says where."""

    status = "invalid"


class Declined(Refused):
    """The kernel has no rule for this, or it exceeds a bound on work: neither valid nor invalid."""

    status = "declined"


_NAME = re.compile(r"([^\W\d]\w*)(?:\.(\w+|\*))?(\[[1-9]\d{0,8}(?:,[1-9]\d{0,8})?\])?")
_RATIONAL = re.compile(r"(-?[1-9][0-9]*|0)(?:/([1-9][0-9]*))?")


def split_name(name: str) -> tuple[str, str]:
    """(key in the tables, node letter i or j, or "") of a name in a listing. Raises Invalid otherwise."""
    match = _NAME.fullmatch(name) if len(name) <= 200 else None
    if match is None:
        raise Invalid(f"{name[:60]!r} is not a name like q[1], J[1,2] or q.i[1]")
    symbol, node, index = match.groups()
    if node not in ("i", "j"):
        return name, ""
    return f"{symbol}.*{index or ''}", node


def at_node(key: str, node: str) -> str:
    """The name of a table's key at a node: `q.*[1]` at `2` is `q.2[1]`."""
    return key.replace(".*", f".{node}", 1)


def per_node(key: str) -> bool:
    """Does the key of a table speak of every node?"""
    return ".*" in key


def rational(value: Any, where: str) -> Fraction:
    """An integer, or a string `"p"` or `"p/q"` in lowest terms with q > 1, as a number. Raises Invalid."""
    if type(value) is int:
        return Fraction(value)
    match = _RATIONAL.fullmatch(value) if type(value) is str and len(value) <= 2 * MAX_DIGITS else None
    if match is None:
        raise Invalid(f'{where}: {str(value)[:60]!r} is not an integer or a string like "-3/4"')
    top, bottom = match.groups()
    if max(len(top), len(bottom or "")) > MAX_DIGITS:
        raise Declined(f"{where}: a number has more than {MAX_DIGITS} digits")
    if bottom is None:
        return Fraction(int(top))
    if bottom == "1" or gcd(int(top), int(bottom)) != 1:
        raise Invalid(f"{where}: {value[:60]!r} is not in lowest terms")
    return Fraction(int(top), int(bottom))


Wanted = TypeVar("Wanted")


def typed(value: Any, kind: type[Wanted], where: str) -> Wanted:
    """`value`, if its type is exactly `kind` (a bool is not an int). Raises Invalid."""
    if type(value) is not kind:
        raise Invalid(f"{where} must be of type {kind.__name__}, but is {type(value).__name__}")
    return value


def fields(
    value: Any, required: Collection[str], where: str, optional: Collection[str] = ()
) -> dict[str, Any]:
    """`value`, if it is an object with exactly these fields. Raises Invalid naming one that is wrong."""
    table = typed(value, dict, where)
    missing = [name for name in required if name not in table]
    unknown = [name for name in table if name not in required and name not in optional]
    if missing or unknown:
        what = f"lacks the field {missing[0]!r}" if missing else f"has the unknown field {unknown[0][:60]!r}"
        raise Invalid(f"{where} {what}")
    return table


def several(value: Any, count: int, where: str) -> list[Any]:
    """`value`, if it is a list of so many entries. Raises Invalid."""
    if len(typed(value, list, where)) != count:
        raise Invalid(f"{where}: a list of {count} entries is wanted, and this one has {len(value)}")
    return list(value)


def natural(value: Any, below: int, where: str) -> int:
    """A non-negative integer below the bound. Raises Invalid."""
    if type(value) is not int or not 0 <= value < below:
        raise Invalid(f"{where}: {str(value)[:40]} is not an integer from 0 to {below - 1}")
    return value


def digest(value: Any) -> str:
    """SHA-256 of the canonical JSON: sorted keys, no spaces, UTF-8."""
    text = json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    try:
        return hashlib.sha256(text.encode()).hexdigest()
    except UnicodeError:
        raise Invalid("a string holds half of a character") from None


def text_field(value: Any, where: str) -> str:
    """A string of bounded length. Raises Invalid or Declined."""
    if len(typed(value, str, where)) > MAX_STRING:
        raise Declined(f"{where} is longer than {MAX_STRING} characters")
    return str(value)
