"""A proof of a theorem: an argument, line by line, and that its facts are the conclusions.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: a conclusion holds for every solution where a chain of rules gives it. The rules' theorems are in
`kernel.rules`; `argument` composes their obligations, each of which has a proof of one of the kinds below.

Proof fields: `listings`, `names`, `scalars`, `motion`, `laws`, more of what the statement has, for the
argument alone; `quantities`, those of the listings, of one output each, that its lines speak of; `edges`, of
these, that the field divides by; `relations`, the proofs that equations are kept, and `cofactors` c with g' =
c g by the names of these; `lines`, each
{rule, of, proofs}. `of` has the quantities by role, `proofs` by role of the obligation {given, proof}: which
of the available assumptions the proof uses, and the proof.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from symctrl.kernel import combination, definite, identity, squeeze, total
from symctrl.kernel.argument import Argument, Obligation, extended
from symctrl.kernel.certificate import Declined, Invalid, fields, natural, typed
from symctrl.kernel.closure import Reach
from symctrl.kernel.form import read_tables
from symctrl.kernel.rules.barbalat import barbalat, barbalat_rate
from symctrl.kernel.rules.carries import carries
from symctrl.kernel.rules.decays import decays
from symctrl.kernel.rules.exists import exists
from symctrl.kernel.rules.falls import falls
from symctrl.kernel.rules.holds import holds, part
from symctrl.kernel.rules.keeps import keeps, keeps_sign
from symctrl.kernel.rules.lasalle import lasalle
from symctrl.kernel.rules.lyapunov import lyapunov, point_key
from symctrl.kernel.rules.outside import outside
from symctrl.kernel.rules.roles import Roles
from symctrl.kernel.values import Condition, Sentence, Statement

RULES: dict[str, Callable[[Argument, Roles], None]] = {
    "falls": falls,
    "decays": decays,
    "outside": outside,
    "keeps": keeps,
    "keeps_sign": keeps_sign,
    "holds": holds,
    "part": part,
    "carries": carries,
    "exists": exists,
    "barbalat": barbalat,
    "barbalat_rate": barbalat_rate,
    "lasalle": lasalle,
    "lyapunov": lyapunov,
}
POINTWISE: dict[str, Callable[[Statement, dict[str, Any]], set[Condition]]] = {
    "identity": identity.needed_conditions,
    "combination": combination.needed_conditions,
    "definite": definite.needed_conditions,
    "squeeze": squeeze.needed_conditions,
    "each": total.needed_conditions_each,
    "spectral": total.needed_conditions_spectral,
}
TABLES = ("listings", "names", "scalars", "motion", "laws")
MAX_LINES = 1000


def needed_conditions(statement: Statement, proof: dict[str, Any]) -> set[Condition]:
    """The conditions that the argument's proofs need. Raises Invalid or Declined where it does not close."""
    if statement.claim.kind != "theorem":
        raise Invalid(f"an argument does not prove the claim {statement.claim.kind}")
    needed = ("kind", *TABLES, "quantities", "relations", "cofactors", "lines")
    table = fields(proof, needed, "proof", ("edges",))
    whole, quantities = _whole(statement, table)
    checker = Checker()
    at = Argument(whole, quantities, checker, stated=frozenset(statement.motion))
    suppose(at)
    checker.proofs = typed(table["relations"], dict, "relations")
    cofactors = typed(table["cofactors"], dict, "cofactors")
    edges = typed(table.get("edges", []), list, "edges")
    if any(c not in quantities for c in (*cofactors.values(), *edges)):
        raise Invalid("a cofactor or an edge is no quantity of the argument")
    at.begin(cofactors, edges)
    checker.close("relations")
    lines = typed(table["lines"], list, "lines")
    if len(lines) > MAX_LINES:
        raise Declined(f"an argument of more than {MAX_LINES} lines")
    for n, value in enumerate(lines, start=1):
        _line(at, checker, value, f"line {n}")
    for sentence in (Sentence("exists", ()), *statement.claim.then):
        if not concluded(at, sentence):
            raise Invalid(f"no line gives the conclusion that {sentence.word} {list(sentence.of)}")
    return checker.conditions


class Checker:
    """Settles obligations by the proofs of a certificate; each must be wanted once."""

    def __init__(self) -> None:
        self.proofs: dict[str, Any] = {}
        self.conditions: set[Condition] = set()
        self.used: set[str] = set()

    def prove(self, at: Argument, obligation: Obligation) -> None:
        if obligation.role not in self.proofs or obligation.role in self.used:
            raise Invalid(f"the obligation that {obligation.role} has no proof of its own")
        self.used.add(obligation.role)
        entry = fields(self.proofs[obligation.role], ("given", "proof"), obligation.role)
        self.conditions |= proved(at, obligation, entry["given"], entry["proof"])

    def require(self, role: str, holds: bool, why: str) -> None:
        if not holds:
            raise Invalid(f"{role}: {why}")

    def close(self, where: str) -> None:
        idle = sorted(set(self.proofs) - self.used)
        if idle:
            raise Invalid(f"{where}: a proof that {idle[0][:60]!r} is not wanted")
        self.used = set()


def proved(at: Argument, obligation: Obligation, given: Any, proof: Any) -> set[Condition]:
    """The conditions of a proof of an obligation under the assumptions with these numbers. Raises Invalid."""
    usable = at.usable(obligation)
    numbers = [natural(k, len(usable), f"{obligation.role}, given") for k in typed(given, list, "given")]
    if numbers != sorted(set(numbers)):
        raise Invalid(f"{obligation.role}: the assumptions are numbered in order, each once")
    kind = typed(proof, dict, obligation.role).get("kind")
    if kind not in POINTWISE:
        raise Declined(f"{obligation.role}: a proof of the kind {str(kind)[:40]!r} is not known")
    try:
        return POINTWISE[kind](at.composed(obligation, [usable[k] for k in numbers]), proof)
    except (Invalid, Declined) as error:
        raise type(error)(f"{obligation.role}: {error}") from None


def suppose(at: Argument) -> None:
    """The facts that are supposed of every solution."""
    for sentence in at.statement.claim.suppose:
        for k in sentence.of:
            if at.output_traits((at.statement.claim.listing, k)).jumps:
                raise Invalid(f"what is supposed, that {sentence.word}, jumps where a switch turns")
            at.facts.add((sentence.word, output_key(at, k)))


def concluded(at: Argument, sentence: Sentence) -> bool:
    """Do the facts give the conclusion?"""
    if sentence.word == "exists":
        return ("exists", "") in at.facts
    if sentence.word == "stable":
        moving = {key for key, _ in sentence.at} <= set(at.stated)
        return moving and ("stable", point_key(dict(sentence.at))) in at.facts
    outputs = [at.output_traits((at.statement.claim.listing, k)) for k in sentence.of]
    if any(traits.jumps or not at.edges_are_known(traits) for traits in outputs):
        return False  # it is not shown to be defined along every solution, or is so up to a switch's value
    keys = [output_key(at, k) for k in sentence.of]
    by = "" if sentence.by is None else output_key(at, sentence.by)
    if sentence.word in ("stays", "enters", "settles", "eventually"):
        return _set_is_known(at, sentence, keys, by)
    if sentence.word == "exponentially":
        return all(("exponentially", f"{key} {by}".strip()) in at.facts for key in keys)
    if sentence.word == "bounded" and by:
        raise Declined("a bound in words of the initial state")
    if sentence.word == "bounded":
        return all(_output_is_bounded(at, k) for k in sentence.of)
    return all((sentence.word, key) in at.facts for key in keys)


def _set_is_known(at: Argument, sentence: Sentence, keys: list[str], by: str) -> bool:
    """What is never left, or held from a time on, part by part is so as a whole; being reached is not so."""
    if (sentence.word, at.set_key(sentence.zero, keys, by)) in at.facts:
        return True
    alone = [(sentence.word, at.set_key(sentence.zero, [key], by)) for key in keys]
    return sentence.word != "enters" and all(fact in at.facts for fact in alone)


def output_key(at: Argument, k: int) -> str:
    return at.output_traits((at.statement.claim.listing, k)).key


def _output_is_bounded(at: Argument, k: int) -> bool:
    return at.output_traits((at.statement.claim.listing, k)).bounded


def _line(at: Argument, checker: Checker, value: Any, where: str) -> None:
    line = fields(value, ("rule", "of", "proofs"), where)
    rule = line["rule"]
    if type(rule) is not str or rule not in RULES:
        raise Declined(f"{where}: the rule {str(rule)[:40]!r} is not known")
    checker.proofs = typed(line["proofs"], dict, where)
    roles = Roles(line["of"], at.quantities, where)
    try:
        RULES[rule](at, roles)
    except (Invalid, Declined) as error:
        raise type(error)(f"{where}, {rule}: {error}") from None
    roles.close()
    checker.close(where)


def _require_new(statement: Statement, more: Mapping[str, Mapping[str, Any]]) -> None:
    """What an argument brings must not say more of the symbols of the statement, as how a signal moves."""
    for key in more["motion"]:
        if key not in more["scalars"]:
            raise Invalid(f"the motion of {key[:60]} is not the argument's to say")
    for key in more["names"]:
        if key in statement.scalars or key in more["scalars"]:
            raise Invalid(f"{key[:60]} is both a scalar and a name")
    for key in more["scalars"]:
        if key in statement.names:
            raise Invalid(f"{key[:60]} is a name of the statement")


def _whole(statement: Statement, table: Mapping[str, Any]) -> tuple[Statement, tuple[str, ...]]:
    """The statement with what the argument adds, which must be defined and without a circle."""
    more = read_tables(table, statement.listings)
    _require_new(statement, more)
    merged: dict[str, dict[str, Any]] = {}
    for name in TABLES:
        own, new = dict(getattr(statement, name)), more[name]
        taken = sorted(set(own) & set(new))
        if taken:
            raise Invalid(f"{name}: {taken[0][:60]} belongs to the statement")
        merged[name] = own | new
    quantities = tuple(typed(q, str, "quantities") for q in typed(table["quantities"], list, "quantities"))
    for quantity in quantities:
        if quantity not in more["listings"] or len(more["listings"][quantity].outputs) != 1:
            raise Invalid(
                f"the quantity {quantity[:60]} is no listing of one output that the argument brings"
            )
    if len(set(quantities)) != len(quantities):
        raise Invalid("a quantity is named twice")
    whole = replace(
        statement,
        listings=merged["listings"],
        names=merged["names"],
        scalars=merged["scalars"],
        motion=merged["motion"],
        laws=merged["laws"],
    )
    walk = Reach(whole)
    for quantity in quantities:
        walk.listing(quantity, "ij", 0, statement.claim.law)
    walk.listing(statement.claim.listing, "ij", 0, statement.claim.law)
    walk.closed_loop(statement.claim.law)
    return extended(whole, quantities), quantities
