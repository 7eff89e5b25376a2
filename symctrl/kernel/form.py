"""The form of a statement: its JSON, completely checked, as values.

Soundness-critical. Last reviewed 2026-11-24.

Relies on no theorem. A listing is in single assignment form: register k is written by instruction k alone,
from registers below k. No two instructions are equal and each is needed by an output, so that no change of
one goes unseen.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from symctrl.kernel.certificate import (
    Declined,
    Invalid,
    digest,
    fields,
    natural,
    per_node,
    rational,
    split_name,
    text_field,
    typed,
)
from symctrl.kernel.values import (
    Assumption,
    Claim,
    Condition,
    Listing,
    Meaning,
    Ref,
    Sentence,
    Statement,
    Step,
    Use,
)

MAX_INSTRUCTIONS = 2_000_000
OWN = frozenset(("obligation", "mode", "modes", "mode is", "mode below"))  # listings that the kernel makes
MAX_SIZE = 10_000  # rows or columns of a claim
SCALAR_KINDS = ("state", "parameter", "input", "signal")
SIGN_KINDS = ("zero", "nonzero", "positive", "nonnegative", "laplacian_bound")
DEFINITE_KINDS = ("positive_definite", "positive_semidefinite")
WORDS = (
    "exists",
    "tends",
    "exponentially",
    "stays",
    "enters",
    "settles",
    "eventually",
    "bounded",
    "apart",
    "summable",
    "stable",
)
SETS = frozenset(("stays", "enters", "settles", "eventually"))
TIMED = frozenset(("exponentially", "bounded", "enters", "settles"))  # those with a rate, a bound or a time
SUPPOSABLE = ("tends", "bounded", "apart", "summable")
CONDITION_KINDS = ("nonzero", "nonnegative", "positive")

_UNARY = (
    "NEG EXP LOG SQRT SQ TWICE SIN COS TAN ASIN ACOS ATAN SINH COSH TANH ASINH ACOSH ATANH FABS SIGN FLOOR "
    "CEIL NOT ERF INV LOG1P EXPM1"
)
_BINARY = "ADD SUB MUL DIV POW CONSTPOW LT LE EQ NE AND OR IF_ELSE_ZERO FMIN FMAX ATAN2 HYPOT"
ARITY: Mapping[str, int] = {**dict.fromkeys(_UNARY.split(), 1), **dict.fromkeys(_BINARY.split(), 2)}


def read_statement(value: Any) -> Statement:
    s = fields(value, set(Statement.__dataclass_fields__) - {"uses", "along"}, "statement", ("uses",))
    listings = {name: _listing(entry, f"listing {name[:60]!r}") for name, entry in _table(s, "listings")}
    if sum(len(listing.code) for listing in listings.values()) > MAX_INSTRUCTIONS:
        raise Declined(f"the listings have more than {MAX_INSTRUCTIONS} instructions")
    tables = _tables(s, listings)
    given = tuple(
        _assumption(g, listings, f"given {k}") for k, g in enumerate(typed(s["given"], list, "given"))
    )
    conditions = tuple(_condition(c) for c in typed(s["conditions"], list, "conditions"))
    if len(set(conditions)) != len(conditions):
        raise Invalid("a condition is listed twice")
    study, id_, words = (text_field(s[field], field) for field in ("study", "id", "text"))
    claim = _claim(s["claim"], listings)
    if claim.kind == "theorem":
        _require_foreign(listings)
    if claim.small is not None and tables["scalars"].get(claim.small) != "parameter":
        raise Declined(f"the claim is about small values of {claim.small[:60]}, which is no parameter of it")
    uses = tuple(map(_use, typed(s["uses"], list, "uses") if "uses" in s else ()))
    if "uses" in s and not uses:
        raise Invalid("uses: an empty list is left out")
    return Statement(
        study,
        id_,
        words,
        listings,
        tables["scalars"],
        tables["names"],
        tables["motion"],
        tables["laws"],
        given,
        claim,
        conditions,
        uses,
    )


def read_tables(s: Mapping[str, Any], known: Mapping[str, Listing]) -> dict[str, dict[str, Any]]:
    """The tables that an argument adds to a statement whose listings are known."""
    new = {name: _listing(entry, f"listing {name[:60]!r}") for name, entry in _table(s, "listings")}
    _require_foreign(new)
    if sum(len(listing.code) for listing in new.values()) > MAX_INSTRUCTIONS:
        raise Declined(f"the listings have more than {MAX_INSTRUCTIONS} instructions")
    return {"listings": new} | _tables(s, {**known, **new})


def _require_foreign(listings: Mapping[str, Listing]) -> None:
    taken = sorted(OWN & listings.keys())
    if taken:
        raise Invalid(f"the name {taken[0]} of a listing belongs to the rules")


def _tables(s: Mapping[str, Any], listings: Mapping[str, Listing]) -> dict[str, dict[str, Any]]:
    return {
        "scalars": {
            _key(name): _one_of(kind, SCALAR_KINDS, f"scalar {name}") for name, kind in _table(s, "scalars")
        },
        "names": {_key(name): _meaning(name, entry, listings) for name, entry in _table(s, "names")},
        "motion": {_key(name): _ref(ref, listings, f"motion of {name}") for name, ref in _table(s, "motion")},
        "laws": {
            law: {
                _key(u): _ref(ref, listings, f"law {law}") for u, ref in typed(of, dict, f"law {law}").items()
            }
            for law, of in _table(s, "laws")
        },
    }


def _use(value: Any) -> Use:
    table = fields(value, ("id", "sha256"), "uses")
    sha256 = text_field(table["sha256"], "uses")
    if len(sha256) != 64 or set(sha256) - set("0123456789abcdef"):
        raise Invalid("uses: a digest is 64 hexadecimal digits")
    return Use(text_field(table["id"], "uses"), sha256)


def _table(statement: Mapping[str, Any], field: str) -> list[tuple[str, Any]]:
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
    code = tuple(
        _step(step, k, f"{where}, instruction {k}")
        for k, step in enumerate(typed(table["code"], list, where))
    )
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
    op = typed(step[0], str, where) if step else ""
    if not op:
        raise Invalid(f"{where} has no operation")
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
        size = 1
        of: tuple[Ref, ...] = (_ref(table["of"], listings, where),)
    else:
        table = fields(value, ("kind", "size", "of"), where, optional=("text", "about"))
        size = natural(table["size"], MAX_SIZE, where)
        of = tuple(_ref(ref, listings, where) for ref in typed(table["of"], list, where))
        if size == 0 or len(of) != size * size:
            raise Invalid(f"{where}: a matrix of size {size} has {size * size} > 0 entries, not {len(of)}")
    return Assumption(
        kind, of, size, text_field(table.get("text", ""), where), text_field(table.get("about", ""), where)
    )


def _claim(value: Any, listings: Mapping[str, Listing]) -> Claim:
    kind = typed(value, dict, "claim").get("kind")
    if kind == "theorem":
        return _theorem(value, listings)
    allowed = ("equal", "nonnegative", "positive", "conforms", *DEFINITE_KINDS)
    kind = _one_of(kind, allowed, "claim")
    shaped = kind not in DEFINITE_KINDS
    optional = () if shaped else ("small",)
    table = fields(value, ("kind", "shape" if shaped else "matrix", "listing"), "claim", optional)
    listing = _one_of(table["listing"], listings, "claim")
    count = len(listings[listing].outputs)
    if not shaped:
        used: set[int] = set()
        size = _tree(table["matrix"], count, used)
        if len(used) != count:
            raise Invalid("claim: the matrix does not use every output of its listing")
        small = text_field(table["small"], "claim") if "small" in table else None
        return Claim(kind, listing, (size, size), table["matrix"], small)
    shape = [natural(n, MAX_SIZE, "claim") for n in typed(table["shape"], list, "claim")]
    sides = 2 if kind == "equal" else 1
    if len(shape) != 2 or shape[0] * shape[1] == 0 or shape[0] * shape[1] * sides != count:
        raise Invalid(f"claim: shape {shape} does not fit the {count} outputs of listing {listing[:60]!r}")
    return Claim(kind, listing, (shape[0], shape[1]))


def _theorem(value: Any, listings: Mapping[str, Listing]) -> Claim:
    table = fields(value, ("kind", "listing", "law", "suppose", "then"), "claim")
    listing = _one_of(table["listing"], listings, "claim")
    count = len(listings[listing].outputs)
    law = None if table["law"] is None else text_field(table["law"], "claim, law")
    suppose, then = (
        tuple(_sentence(s, count, f"claim, {part}") for s in typed(table[part], list, f"claim, {part}"))
        for part in ("suppose", "then")
    )
    if not then:
        raise Invalid("claim: a theorem concludes something")
    for part in suppose:
        if part.word not in SUPPOSABLE:
            raise Invalid(f"claim: {part.word} is not supposed of solutions")
    return Claim("theorem", listing, (count, 1), law=law, suppose=suppose, then=then)


def _sentence(value: Any, count: int, where: str) -> Sentence:
    table = fields(value, ("word", "of"), where, ("zero", "by", "at"))
    word = _one_of(table["word"], WORDS, where)
    of = tuple(natural(k, count, where) for k in typed(table["of"], list, where))
    by = natural(table["by"], count, where) if "by" in table else None
    at = {_key(name): rational(x, where) for name, x in typed(table.get("at", {}), dict, where).items()}
    zero = typed(table.get("zero", False), bool, where)
    unfit = (by is not None and word not in TIMED) or (zero and word not in SETS)
    if unfit or (word in ("exists", "stable")) == bool(of) or (word == "stable") != bool(at):
        raise Invalid(f"{where}: {word} is not said like this")
    return Sentence(word, of, zero, by, tuple(sorted(at.items())))


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
    elif "congruence" in tree:
        table = fields(tree, ("congruence", "factor"), "matrix")
        rows = [typed(row, list, "matrix") for row in typed(table["factor"], list, "matrix")]
        size = len(rows[0]) if rows else 0
        if len(rows) != _tree(table["congruence"], count, used) or any(len(row) != size for row in rows):
            raise Invalid("claim: the factor of a congruence does not fit its matrix")
        used.update(natural(k, count, "matrix") for row in rows for k in row)
    else:
        blocks = typed(fields(tree, ("blocks",), "matrix")["blocks"], list, "matrix")
        size = sum(_tree(block, count, used) for block in blocks)
    if size == 0:
        raise Invalid("claim: an empty matrix")
    return size


def _condition(value: Any) -> Condition:
    table = fields(value, ("kind", "of"), "condition")
    return Condition(
        _one_of(table["kind"], CONDITION_KINDS, "condition"), text_field(table["of"], "condition")
    )
