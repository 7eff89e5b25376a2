"""Certificates as values: strict reading of the JSON form of docs/certificates.md.

Soundness-critical. Last reviewed 2026-11-24.

Relies on no theorem, but everything else relies on it: what `load` returns is completely checked for form. Each
field is known and used, each listing is in single assignment form without an idle instruction, each digest is
right, and no name is defined through itself (`closure`). What a certificate claims is read off these values only.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import gcd
from typing import Any, TypeVar

FORMAT = "symctrl-certificate/1"
MAX_TEXT = 64 * 2**20
MAX_DIGITS = 4000
MAX_INSTRUCTIONS = 2_000_000
MAX_STRING = 20_000
MAX_SIZE = 10_000  # rows or columns of a claim

ARITY: Mapping[str, int] = {
    **dict.fromkeys(
        "NEG EXP LOG SQRT SQ TWICE SIN COS TAN ASIN ACOS ATAN SINH COSH TANH ASINH ACOSH ATANH "
        "FABS SIGN FLOOR CEIL NOT ERF INV LOG1P EXPM1".split(),
        1,
    ),
    **dict.fromkeys(
        "ADD SUB MUL DIV POW CONSTPOW LT LE EQ NE AND OR IF_ELSE_ZERO FMIN FMAX ATAN2 HYPOT".split(), 2
    ),
}
SCALAR_KINDS = ("state", "parameter", "input", "signal")
SIGN_KINDS = ("zero", "nonzero", "positive", "nonnegative")
DEFINITE_KINDS = ("positive_definite", "positive_semidefinite")
CONDITION_KINDS = ("nonzero", "nonnegative", "positive")


class Unreadable(ValueError):
    """Not a certificate of a known version at all."""


class Invalid(ValueError):
    """The certificate is malformed, or does not prove what it states; the message says where."""


class Declined(ValueError):
    """The kernel has no rule for this, or it exceeds a bound on work: neither valid nor invalid."""


Ref = tuple[str, int]  # output k (from 0) of a listing


@dataclass(frozen=True, slots=True)
class Step:
    """One instruction: `args` are registers, `name` belongs to INPUT and `value` to CONST."""

    op: str
    args: tuple[int, ...] = ()
    name: str = ""
    value: Fraction = Fraction(0)


@dataclass(frozen=True, slots=True)
class Listing:
    code: tuple[Step, ...]
    outputs: tuple[int, ...]
    sha256: str

    @property
    def letters(self) -> frozenset[str]:
        """The node letters that the names of its inputs mention."""
        found = (split_name(step.name)[1] for step in self.code if step.op == "INPUT")
        return frozenset(letter for letter in found if letter)


@dataclass(frozen=True, slots=True)
class Meaning:
    """What a name stands for: `kind` is constant, value, rate, sum or total."""

    kind: str
    value: Fraction = Fraction(0)
    of: Ref = ("", 0)
    law: str | None = None


@dataclass(frozen=True, slots=True)
class Assumption:
    """`of` has one reference for a sign kind, size*size of them (column by column) for a definite kind."""

    kind: str
    of: tuple[Ref, ...]
    size: int = 1
    text: str = ""
    about: str = ""


@dataclass(frozen=True, slots=True)
class Claim:
    """`matrix` is the checked tree of positions of the outputs for a definite kind, else None."""

    kind: str
    listing: str
    shape: tuple[int, int]
    matrix: Any = None


@dataclass(frozen=True, slots=True)
class Condition:
    kind: str
    of: str


@dataclass(frozen=True, slots=True)
class Statement:
    """All that is claimed; a table's keys have the node written `*`."""

    study: str
    id: str
    text: str
    listings: Mapping[str, Listing]
    scalars: Mapping[str, str]
    names: Mapping[str, Meaning]
    motion: Mapping[str, Ref]
    laws: Mapping[str, Mapping[str, Ref]]
    given: tuple[Assumption, ...]
    claim: Claim
    conditions: tuple[Condition, ...]


@dataclass(frozen=True, slots=True)
class Certificate:
    tool: str
    statement: Statement
    proof: dict[str, Any]


_NAME = re.compile(r"([^\W\d]\w*)(?:\.(\w+|\*))?(\[[1-9]\d{0,8}(?:,[1-9]\d{0,8})?\])?")
_RATIONAL = re.compile(r"(-?[1-9][0-9]*|0)(?:/([1-9][0-9]*))?")


def split_name(name: str) -> tuple[str, str]:
    """(key in the tables, node letter i or j, or "") of a name in a listing. Raises Invalid for another form."""
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
    """An exact number: an integer, or a string `"p"` or `"p/q"` in lowest terms with q > 1. Raises Invalid."""
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


def fields(value: Any, required: Collection[str], where: str, optional: Collection[str] = ()) -> dict[str, Any]:
    """`value`, if it is an object with exactly these fields. Raises Invalid naming the first that is wrong."""
    table = typed(value, dict, where)
    missing = [name for name in required if name not in table]
    unknown = [name for name in table if name not in required and name not in optional]
    if missing or unknown:
        what = f"lacks the field {missing[0]!r}" if missing else f"has the unknown field {unknown[0][:60]!r}"
        raise Invalid(f"{where} {what}")
    return table


def natural(value: Any, below: int, where: str) -> int:
    """A non-negative integer below the bound. Raises Invalid."""
    if type(value) is not int or not 0 <= value < below:
        raise Invalid(f"{where}: {str(value)[:40]} is not an integer from 0 to {below - 1}")
    return value


def digest(value: Any) -> str:
    """SHA-256 of the canonical JSON: sorted keys, no spaces, UTF-8."""
    text = json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    return hashlib.sha256(text.encode()).hexdigest()


def load(text: str) -> Certificate:
    """The certificate that the text holds.

    Raises Unreadable for what is no certificate of this version, Invalid for one that is malformed, and Declined
    for one that exceeds a size limit.
    """
    from symctrl.kernel.closure import require_closed  # noqa: PLC0415  (it needs the types of this file)

    top = _parse(text)
    fields(top, ("format", "tool", "statement", "proof", "sha256"), "the certificate")
    rest = {key: value for key, value in top.items() if key != "sha256"}
    if top["sha256"] != digest(rest):
        raise Invalid("the sha256 of the certificate is not that of its content")
    statement = _statement(top["statement"])
    require_closed(statement)
    proof = typed(top["proof"], dict, "proof")
    return Certificate(_text(top["tool"], "tool"), statement, proof)


def _parse(text: str) -> dict[str, Any]:
    if len(text) > MAX_TEXT:
        raise Declined(f"the certificate is longer than {MAX_TEXT} characters")
    try:
        top = json.loads(
            text, object_pairs_hook=_object, parse_int=_integer, parse_float=_no_float, parse_constant=_no_constant
        )
        text.encode()
    except (json.JSONDecodeError, UnicodeError) as error:
        raise Unreadable(f"not JSON: {str(error)[:200]}") from None
    except RecursionError:
        raise Declined("the certificate is nested too deeply") from None
    version = top.get("format") if type(top) is dict else None
    if version != FORMAT:
        raise Unreadable(f"its format is {str(version)[:60]!r}, and only {FORMAT!r} is known")
    return typed(top, dict, "the certificate")


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


def _text(value: Any, where: str) -> str:
    if len(typed(value, str, where)) > MAX_STRING:
        raise Declined(f"{where} is longer than {MAX_STRING} characters")
    return str(value)


def _statement(value: Any) -> Statement:
    s = fields(value, Statement.__dataclass_fields__, "statement")
    listings = {name: _listing(entry, f"listing {name[:60]!r}") for name, entry in _table(s, "listings")}
    if sum(len(listing.code) for listing in listings.values()) > MAX_INSTRUCTIONS:
        raise Declined(f"the listings have more than {MAX_INSTRUCTIONS} instructions")
    scalars = {_key(name): _one_of(kind, SCALAR_KINDS, f"scalar {name}") for name, kind in _table(s, "scalars")}
    names = {_key(name): _meaning(name, entry, listings) for name, entry in _table(s, "names")}
    motion = {_key(name): _ref(entry, listings, f"motion of {name}") for name, entry in _table(s, "motion")}
    laws = {
        law: {_key(u): _ref(ref, listings, f"law {law}") for u, ref in typed(entry, dict, f"law {law}").items()}
        for law, entry in _table(s, "laws")
    }
    given = tuple(_assumption(g, listings, f"given {k}") for k, g in enumerate(typed(s["given"], list, "given")))
    conditions = tuple(_condition(c) for c in typed(s["conditions"], list, "conditions"))
    if len(set(conditions)) != len(conditions):
        raise Invalid("a condition is listed twice")
    words = (_text(s[field], field) for field in ("study", "id", "text"))
    claim = _claim(s["claim"], listings)
    return Statement(*words, listings, scalars, names, motion, laws, given, claim, conditions)


def _table(statement: dict[str, Any], field: str) -> list[tuple[str, Any]]:
    return list(typed(statement[field], dict, field).items())


def _key(name: str) -> str:
    if split_name(name)[1]:
        raise Invalid(f"{name} in a table must have its node written as *")
    return name


def _one_of(value: Any, allowed: Collection[str], where: str) -> str:
    if type(value) is not str or value not in allowed:
        raise Invalid(f"{where}: {str(value)[:60]!r} is not one of {', '.join(allowed)}")
    return value


def _listing(value: Any, where: str) -> Listing:
    table = fields(value, ("code", "outputs", "sha256"), where)
    if table["sha256"] != digest({"code": table["code"], "outputs": table["outputs"]}):
        raise Invalid(f"{where}: the sha256 is not that of its content")
    code = tuple(_step(step, k, f"{where}, instruction {k}") for k, step in enumerate(typed(table["code"], list, where)))
    outputs = tuple(natural(r, len(code), f"{where}, outputs") for r in typed(table["outputs"], list, where))
    if not outputs:
        raise Invalid(f"{where} has no outputs")
    if len(set(code)) != len(code):
        raise Invalid(f"{where} has two equal instructions")
    needed = set(outputs)
    for k in range(len(code) - 1, -1, -1):
        if k not in needed:
            raise Invalid(f"{where}: instruction {k} is not needed by any output")
        needed.update(code[k].args)
    return Listing(code, outputs, table["sha256"])


def _step(value: Any, k: int, where: str) -> Step:
    step = typed(value, list, where)
    op = step[0] if step and type(step[0]) is str else ""
    if op not in ARITY and op not in ("INPUT", "CONST"):
        raise Declined(f"{where}: the operation {op[:40]!r} is not known")
    if len(step) - 1 != ARITY.get(op, 1):
        raise Invalid(f"{where}: {op} with {len(step) - 1} arguments")
    if op == "INPUT":
        name = typed(step[1], str, where)
        if split_name(name)[0] == name and per_node(name):
            raise Invalid(f"{where}: a listing names the node i or j, not *")
        return Step("INPUT", name=name)
    if op == "CONST":
        return Step("CONST", value=rational(typed(step[1], str, where), where))
    return Step(op, tuple(natural(a, k, where) for a in step[1:]))


def _ref(value: Any, listings: Mapping[str, Listing], where: str) -> Ref:
    ref = typed(value, list, where)
    if len(ref) != 2 or type(ref[0]) is not str or ref[0] not in listings:
        raise Invalid(f"{where}: {str(value)[:60]} is not [name of a listing, position of an output]")
    return ref[0], natural(ref[1], len(listings[ref[0]].outputs), where)


def _meaning(name: str, value: Any, listings: Mapping[str, Listing]) -> Meaning:
    where = f"name {name}"
    kind = _one_of(typed(value, dict, where).get("is"), ("constant", "value", "rate", "sum", "total"), where)
    if kind == "constant":
        text = typed(fields(value, ("is", "value"), where)["value"], str, where)
        return Meaning(kind, rational(text, where))
    table = fields(value, ("is", "of", "law") if kind == "rate" else ("is", "of"), where)
    if kind in ("sum", "total") and per_node(name) != (kind == "sum"):
        raise Invalid(f"{where}: a sum over neighbours belongs to a node, a total to none")
    law = table.get("law")
    if law is not None:
        typed(law, str, where)
    return Meaning(kind, of=_ref(table["of"], listings, where), law=law)


def _assumption(value: Any, listings: Mapping[str, Listing], where: str) -> Assumption:
    kind = _one_of(typed(value, dict, where).get("kind"), (*SIGN_KINDS, *DEFINITE_KINDS), where)
    if kind in SIGN_KINDS:
        table = fields(value, ("kind", "of", "text", "about"), where)
        size, of = 1, (_ref(table["of"], listings, where),)
    else:
        table = fields(value, ("kind", "size", "of"), where, optional=("text", "about"))
        size = natural(table["size"], MAX_SIZE, where)
        of = tuple(_ref(ref, listings, where) for ref in typed(table["of"], list, where))
        if size == 0 or len(of) != size * size:
            raise Invalid(f"{where}: a matrix of size {size} has {size * size} > 0 entries, not {len(of)}")
    return Assumption(kind, of, size, _text(table.get("text", ""), where), _text(table.get("about", ""), where))


def _claim(value: Any, listings: Mapping[str, Listing]) -> Claim:
    kind = typed(value, dict, "claim").get("kind")
    allowed = ("equal", "nonnegative", "positive", "conforms", *DEFINITE_KINDS)
    kind = _one_of(kind, allowed, "claim")
    shaped = kind not in DEFINITE_KINDS
    table = fields(value, ("kind", "shape" if shaped else "matrix", "listing"), "claim")
    listing = _one_of(table["listing"], listings, "claim")
    count = len(listings[listing].outputs)
    if not shaped:
        used: set[int] = set()
        size = _tree(table["matrix"], count, used)
        if len(used) != count:
            raise Invalid("claim: the matrix does not use every output of its listing")
        return Claim(kind, listing, (size, size), table["matrix"])
    shape = [natural(n, MAX_SIZE, "claim") for n in typed(table["shape"], list, "claim")]
    if len(shape) != 2 or shape[0] * shape[1] == 0 or shape[0] * shape[1] * (2 if kind == "equal" else 1) != count:
        raise Invalid(f"claim: shape {shape} does not fit the {count} outputs of listing {listing[:60]!r}")
    return Claim(kind, listing, (shape[0], shape[1]))


def _tree(value: Any, count: int, used: set[int]) -> int:
    """The size of the square matrix that a TREE describes; collects the positions it uses."""
    tree = typed(value, dict, "matrix")
    if "entries" in tree:
        rows = typed(fields(tree, ("entries",), "matrix")["entries"], list, "matrix")
        if not rows or any(len(typed(row, list, "matrix")) != len(rows) for row in rows):
            raise Invalid("claim: the entries of the matrix are not square")
        used.update(natural(k, count, "matrix") for row in rows for k in row)
        return len(rows)
    if "kron_identity" in tree:
        table = fields(tree, ("kron_identity", "size"), "matrix")
        size = natural(table["size"], MAX_SIZE, "matrix") * _tree(table["kron_identity"], count, used)
    else:
        blocks = typed(fields(tree, ("blocks",), "matrix")["blocks"], list, "matrix")
        size = sum(_tree(block, count, used) for block in blocks)
    if size == 0:
        raise Invalid("claim: an empty matrix")
    return size


def _condition(value: Any) -> Condition:
    table = fields(value, ("kind", "of"), "condition")
    return Condition(_one_of(table["kind"], CONDITION_KINDS, "condition"), _text(table["of"], "condition"))
