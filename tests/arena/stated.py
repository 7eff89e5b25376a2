"""Theorems with the lines of an argument, written in short, and the proofs that are found for them."""

from __future__ import annotations

import copy
import json
from contextlib import suppress
from pathlib import Path
from typing import Any

from symctrl.kernel.certificate import digest
from tests.kernel.certificates import Json, seal

ROOT = Path(__file__).parent
OPERATIONS = {"+": "ADD", "-": "SUB", "*": "MUL", "/": "DIV", "^": "POW"}
FUNCTIONS = {"neg": "NEG", "abs": "FABS", "sign": "SIGN", "sq": "SQ"}
Lines = list[tuple[str, Json]]


def postfix(*formulas: str) -> Json:
    """A listing from formulas in postfix notation: `x 2 *` is 2 x."""
    code: list[list[Any]] = []

    def emit(*row: Any) -> int:
        if list(row) not in code:
            code.append(list(row))
        return code.index(list(row))

    outputs = []
    for formula in formulas:
        stack: list[int] = []
        for word in formula.split():
            if word in OPERATIONS:
                b, a = stack.pop(), stack.pop()
                stack.append(emit(OPERATIONS[word], a, b))
            elif word in FUNCTIONS:
                stack.append(emit(FUNCTIONS[word], stack.pop()))
            else:
                stack.append(emit("CONST" if word.lstrip("-")[0].isdigit() else "INPUT", word))
        outputs.append(stack.pop())
    body = {"code": code, "outputs": outputs}
    return {**body, "sha256": digest(body)}


def theorem(
    motion: dict[str, str],
    out: list[str],
    then: list[Json],
    quantities: dict[str, str],
    lines: Lines,
    *,
    given: list[tuple[str, str, str]] | None = None,
    scalars: dict[str, str] | None = None,
    names: Json | None = None,
    more: dict[str, str] | None = None,
    suppose: list[Json] | None = None,
    cofactors: dict[str, str] | None = None,
    added: Json | None = None,
    own: dict[str, str] | None = None,
) -> Json:
    """A certificate without proofs. given: (kind, formula, about); more: listings that names need.

    added: names that the argument brings, with its own listings.
    """
    listings = {"claim": postfix(*out), **{f"rate of {x}": postfix(f) for x, f in motion.items()}}
    listings |= {f"given {k}": postfix(f) for k, (_, f, _) in enumerate(given or [])}
    listings |= {name: postfix(f) for name, f in (more or {}).items()}
    statement = {
        "study": "tests",
        "id": "one",
        "text": "a small theorem",
        "listings": listings,
        "scalars": dict.fromkeys(motion, "state") | (scalars or {}),
        "names": names or {},
        "motion": {x: [f"rate of {x}", 0] for x in motion},
        "laws": {},
        "given": [
            {"kind": kind, "of": [f"given {k}", 0], "text": f"assumption {k + 1}", "about": about}
            for k, (kind, _, about) in enumerate(given or [])
        ],
        "claim": {"kind": "theorem", "listing": "claim", "law": None, "suppose": suppose or [], "then": then},
        "conditions": [],
    }
    proof = {
        "kind": "argument",
        "listings": {q: postfix(f) for q, f in {**quantities, **(own or {})}.items()},
        **{table: {} for table in ("scalars", "motion", "laws")},
        "names": added or {},
        "quantities": list(quantities),
        "relations": {},
        "cofactors": cofactors or {},
        "lines": [{"rule": rule, "of": of, "proofs": {}} for rule, of in lines],
    }
    whole = {"format": "symctrl-certificate/1", "tool": "tests", "statement": statement, "proof": proof}
    return json.loads(json.dumps(seal(whole)))


def say(word: str, *of: int, **more: Any) -> Json:
    return {"word": word, "of": list(of), **more}


def carry(word: str, how: str, **of: Any) -> tuple[str, Json]:
    return "carries", {"word": word, "how": how, **of}


def stored(folder: str, names: Any) -> dict[str, Json]:
    """The certificates in the folder, by their names there."""
    files = {f"argument_{name}": ROOT / folder / f"argument_{name}.json" for name in names}
    return {
        name: json.loads(file.read_text(encoding="utf-8")) for name, file in files.items() if file.exists()
    }


def with_proofs(case: Json) -> Json:
    """The certificate with the proofs that are found, and the conditions that they need."""
    from symctrl.kernel import theorem as kernel
    from symctrl.kernel.argument import Argument
    from symctrl.kernel.certificate import Declined, Invalid
    from symctrl.kernel.loading import load
    from symctrl.kernel.rules.roles import Roles
    from symctrl.rules.seeker import Seeker

    case = copy.deepcopy(case)
    read = load(json.dumps(case))
    whole, quantities = kernel._whole(read.statement, read.proof)
    seeker = Seeker("one", thorough=False)
    at = Argument(whole, quantities, seeker, stated=frozenset(read.statement.motion))
    conditions = set()

    def taken() -> Json:
        found = [o for o in seeker.outcomes if o.proof is not None]
        conditions.update(c for o in found for c in o.conditions)
        seeker.outcomes = []
        return {o.role: {"given": list(o.given), "proof": o.proof} for o in found}

    kernel.suppose(at)
    at.begin(read.proof["cofactors"])
    case["proof"]["relations"] = taken()
    for line in case["proof"]["lines"]:
        with suppress(Invalid, Declined):
            kernel.RULES[line["rule"]](at, Roles(line["of"], quantities, line["rule"]))
        line["proofs"] = taken()
    case["statement"]["conditions"] = [{"kind": c.kind, "of": c.of} for c in sorted(conditions, key=str)]
    return json.loads(json.dumps(seal(case)))


def write(folder: str, statements: dict[str, Json]) -> None:
    for name, statement in statements.items():
        text = json.dumps(with_proofs(statement), sort_keys=True)
        (ROOT / folder / f"argument_{name}.json").write_text(text + "\n", encoding="utf-8")
