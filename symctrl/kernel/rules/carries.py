"""A fact about some quantities is carried over to others.

Soundness-critical. Last reviewed 2026-11-24.

Theorems, for every solution, with constants a > 0, d != 0 and k:

- bounded: where it is composed of what is bounded (`traits`), or is c_1 z_1 + .. with bounded z and c; where
  a |e| or a e^2 is at most k + V_1 + .. with bounded V; where e'P e is, with a constant positive definite P
  (every component of e); where e^2 <= g and a log(1 + g) <= V; where its rate has a finite integral.
- tends to zero: where d e = c_1 z_1 + .. with z that tend to zero and bounded c (d constant, or apart from
  zero); where a e^2 <= V and V tends to zero.
- For a fleet, a sum over all nodes (and neighbours) of squares may take the place of the square, and is not
  less than it; and the sum over all nodes of what tends to zero at each node tends to zero.
- summable: where a |e| <= W_1 + .. with summable W.
- exponentially: |e| decays at half the rate of V where a e^2 <= V.
- apart from zero: where e is a constant that is not zero; where e^2 >= k > 0, or e = c z or e^2 >= z^2 for a
  constant c != 0 and z that stays apart from zero.
- sets: where a set is reached, reached and kept, or holds for all large times, so does every set that
  contains it.

Proofs. Each is immediate.
"""

from __future__ import annotations

from collections.abc import Callable

from symctrl.kernel.argument import OBLIGATION, Argument, Beside
from symctrl.kernel.rules.roles import Roles
from symctrl.kernel.values import Assumption

SET_WORDS = ("enters", "settles", "eventually")  # a set that is never left may lie in one that is


def carries(at: Argument, of: Roles) -> None:
    """Roles: word, how, and those of the way chosen."""
    word, how = of.word("word", {word for word, _ in WAYS}), of.word("how", {how for _, how in WAYS})
    at.require("there is such a way", (word, how) in WAYS, f"{word} is not carried by {how}")
    WAYS[word, how](at, of)


def _composed(at: Argument, of: Roles) -> None:
    e = of.one("e")
    at.require(
        "e is composed of what is bounded",
        at.traits(e).bounded,
        f"{e} is not composed of what is known to be bounded",
    )
    at.learn("bounded", e)


def _square(at: Argument, of: Roles) -> None:
    """a e^2 <= k + V_1 + ..."""
    e, bounds, offset, least = of.one("e"), of.many("by"), of.maybe("offset"), of.maybe("least")
    formula, roles = _sum(at, "bounded", bounds, offset)
    formula, more = _less_square(at, formula, e, least, of.maybe("total"))
    at.prove("the square is bounded", "nonnegative", formula, **roles, **more)
    at.learn("bounded", e)


def _form(at: Argument, of: Roles) -> None:
    """e'P e <= k + V_1 + ..., P column by column."""
    parts, matrix, bounds, offset = of.many("e"), of.many("P"), of.many("by"), of.maybe("offset")
    n = len(parts)
    at.require("P is square", n > 0 and len(matrix) == n * n, "the matrix does not fit the vector")
    for entry in matrix:
        at.require_constant("P is constant", entry)
    entries = {f"p{k}": entry for k, entry in enumerate(matrix)}
    at.prove("P is positive definite", "positive_definite", list(entries), **entries)
    formula, roles = _sum(at, "bounded", bounds, offset)
    for r in range(n):
        for c in range(n):
            formula += f" e{r} p{r + n * c} * e{c} * -"
    named = {f"e{k}": part for k, part in enumerate(parts)}
    at.prove("the form is bounded", "nonnegative", formula, **roles, **entries, **named)
    for part in parts:
        at.learn("bounded", part)


def _by_rate(at: Argument, of: Roles) -> None:
    e, S = of.one("e"), of.one("by")
    at.require_differentiable("e is differentiable", e)
    at.need("the bound of the rate is summable", "summable", S)
    at.prove("S bounds the rate of e", "nonnegative", "S e' -", S=S, e=e)
    at.prove("S bounds minus the rate of e", "nonnegative", "S e' +", S=S, e=e)
    at.learn("bounded", e)


def _bounded_combination(at: Argument, of: Roles) -> None:
    """e = c_1 z_1 + ..."""
    _combination(at, of, "bounded")


def _small_combination(at: Argument, of: Roles) -> None:
    """d e = c_1 z_1 + ..."""
    _combination(at, of, "tends")


def _combination(at: Argument, of: Roles, word: str) -> None:
    e, parts, factors, d = of.one("e"), of.many("of"), of.many("times"), of.maybe("divisor")
    at.require(
        "there is a factor for each part", len(parts) == len(factors), "factors and parts differ in number"
    )
    for k, (z, c) in enumerate(zip(parts, factors, strict=False), start=1):
        at.need(f"part {k}: {word}", word, z)
        at.need(f"factor {k} is bounded", "bounded", c)
    named = {f"z{k}": z for k, z in enumerate(parts)} | {f"c{k}": c for k, c in enumerate(factors)}
    total = "0" + "".join(f" c{k} z{k} * +" for k in range(len(parts)))
    left, roles = "e", {"e": e}
    if d is not None:
        if not at.has("apart", d):
            at.require_constant("the divisor is constant", d)
            at.prove("the divisor is not zero", "positive", "d d *", d=d)
        left, roles = "e d *", roles | {"d": d}
    at.prove("e is the combination", "equal", [left, total], **roles, **named)
    at.learn(word, e)


def _under(at: Argument, of: Roles) -> None:
    """a e^2 <= V where V tends to zero."""
    e, V, least = of.one("e"), of.one("by"), of.maybe("least")
    decaying = ("exists", "") in at.facts and at.has("exponentially", V)
    at.require("V tends to zero", decaying or at.has("tends", V), f"{V} is not known to tend to zero")
    formula, roles = _less_square(at, "V", e, least, of.maybe("total"))
    at.prove("the square is below V", "nonnegative", formula, V=V, **roles)
    at.learn("tends", e)


def _sum_of_small(at: Argument, of: Roles) -> None:
    """The sum over nodes of what tends to zero at each."""
    total, e = of.one("e"), of.one("by")
    at.need("the term tends to zero", "tends", e)
    at.require(
        "e is the sum over nodes", at.is_total_of(total, e), f"{total} is not the sum over nodes of {e}"
    )
    at.learn("tends", total)


def _bounded_by_parts(at: Argument, of: Roles) -> None:
    _below_parts(at, of, "bounded")


def _summable(at: Argument, of: Roles) -> None:
    _below_parts(at, of, "summable")


def _below_parts(at: Argument, of: Roles, word: str) -> None:
    """a |e| <= W_1 + .."""
    e, parts, least = of.one("e"), of.many("by"), of.maybe("least")
    formula, roles = _sum(at, word, parts, None)
    bound = "e"
    if least is not None:
        _positive(at, least)
        bound, roles = "e a *", roles | {"a": least}
    at.prove("the parts bound e", "nonnegative", f"{formula} {bound} -", e=e, **roles)
    at.prove("the parts bound minus e", "nonnegative", f"{formula} {bound} +", e=e, **roles)
    at.learn(word, e)


def _logarithm(at: Argument, of: Roles) -> None:
    """e^2 <= g and a log(1 + g) <= V."""
    e, g, V, least = of.one("e"), of.one("inside"), of.one("by"), of.one("least")
    at.need("V is bounded", "bounded", V)
    _positive(at, least)
    at.prove("the logarithm is below V", "nonnegative", "V 1 g + log a * -", V=V, g=g, a=least)
    at.prove("the square is below the inside", "nonnegative", "g e e * -", g=g, e=e)
    at.learn("bounded", e)


def _rate(at: Argument, of: Roles) -> None:
    e, V, least = of.one("e"), of.one("by"), of.maybe("least")
    half, full = of.one("half"), of.one("rate")
    known = any(("exponentially", f"{key} {at.traits(full).key}") in at.facts for key in at.keys(V))
    at.require("V decays at the rate", known, f"{V} is not known to decay at this rate")
    formula, roles = _less_square(at, "V", e, least)
    at.prove("the square is below V", "nonnegative", formula, V=V, **roles)
    at.prove("the rate is half that of V", "equal", ["h 2 *", "r"], h=half, r=full)
    for key in at.keys(e):
        at.facts |= {("exponentially", key), ("exponentially", f"{key} {at.traits(half).key}")}


def _apart_as_multiple(at: Argument, of: Roles) -> None:
    """e = c z."""
    e, z, c = of.one("e"), of.one("by"), of.one("times")
    at.need("z stays apart from zero", "apart", z)
    at.require_constant("the factor is constant", c)
    at.prove("the factor is not zero", "positive", "c c *", c=c)
    at.prove("e is the multiple", "equal", ["e", "c z *"], e=e, c=c, z=z)
    at.learn("apart", e)


def _apart_constant(at: Argument, of: Roles) -> None:
    """A constant that is not zero."""
    e = of.one("e")
    at.require_constant("e is constant", e)
    at.prove("e is not zero", "positive", "e e *", e=e)
    at.learn("apart", e)


def _apart_above(at: Argument, of: Roles) -> None:
    """e^2 >= z^2."""
    e, z = of.one("e"), of.one("by")
    at.need("z stays apart from zero", "apart", z)
    at.prove("the square is above that of z", "nonnegative", "e e * z z * -", e=e, z=z)
    at.learn("apart", e)


def _apart(at: Argument, of: Roles) -> None:
    e, k = of.one("e"), of.one("least")
    _positive(at, k)
    at.prove("the square stays above", "nonnegative", "e e * k -", e=e, k=k)
    at.learn("apart", e)


def _set(at: Argument, of: Roles, word: str) -> None:
    """The set {zero or g >= 0} contains the one that is known: {V = 0} or {s >= 0}."""
    zero, wide = of.word("of_zeros", ("yes", "no")) == "yes", of.many("e")
    inner_zero, inner, time = of.word("by_zeros", ("yes", "no")) == "yes", of.many("by"), of.maybe("time")
    key = at.set_key(
        inner_zero, [at.traits(q).key for q in inner], "" if time is None else at.traits(time).key
    )
    at.require(
        f"the smaller set {word}", (word, key) in at.facts, "nothing of the kind is known of the smaller set"
    )
    kind = "zero" if inner_zero else "nonnegative"
    extra = [Assumption(kind, ((q, 0),), text="in the smaller set", about=OBLIGATION) for q in inner]
    for n, quantity in enumerate(wide, start=1):
        formulas = ["e", "0"] if zero else "e"
        at.prove(
            f"part {n} of the set",
            "equal" if zero else "nonnegative",
            formulas,
            Beside(tuple(extra)),
            e=quantity,
        )
    at.learn_set(word, zero, wide, time)


def _sum(at: Argument, word: str, parts: list[str], offset: str | None) -> tuple[str, dict[str, str]]:
    for k, V in enumerate(parts, start=1):
        at.need(f"bound {k} is {word}", word, V)
    roles = {f"v{k}": V for k, V in enumerate(parts)}
    formula = "0" + "".join(f" {name} +" for name in roles)
    if offset is not None:
        at.require_constant("the offset is constant", offset)
        formula, roles = f"{formula} k +", roles | {"k": offset}
    return formula, roles


def _less_square(
    at: Argument, formula: str, e: str, least: str | None, total: str | None = None
) -> tuple[str, dict[str, str]]:
    """The formula less a e^2, or less a times the sum over all nodes of e^2."""
    square, roles = "e e *", {"e": e}
    if total is not None:
        at.require_total(total, e)
        square, roles = "T", {"T": total}
    if least is None:
        return f"{formula} {square} -", roles
    _positive(at, least)
    return f"{formula} {square} a * -", roles | {"a": least}


def _positive(at: Argument, quantity: str) -> None:
    at.require_constant("the factor is constant", quantity)
    at.prove("the factor is positive", "positive", "a", a=quantity)


def _word(word: str) -> Callable[[Argument, Roles], None]:
    return lambda at, of: _set(at, of, word)


WAYS: dict[tuple[str, str], Callable[[Argument, Roles], None]] = {
    ("bounded", "composed"): _composed,
    ("bounded", "square"): _square,
    ("bounded", "form"): _form,
    ("bounded", "parts"): _bounded_by_parts,
    ("bounded", "logarithm"): _logarithm,
    ("bounded", "rate"): _by_rate,
    ("bounded", "combination"): _bounded_combination,
    ("tends", "combination"): _small_combination,
    ("tends", "square"): _under,
    ("tends", "sum"): _sum_of_small,
    ("apart", "multiple"): _apart_as_multiple,
    ("apart", "above"): _apart_above,
    ("apart", "constant"): _apart_constant,
    ("summable", "parts"): _summable,
    ("exponentially", "square"): _rate,
    ("apart", "square"): _apart,
    **{(word, "set"): _word(word) for word in SET_WORDS},
}
