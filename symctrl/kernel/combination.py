"""A quantity is nonnegative as a combination of assumptions and squares.

Soundness-critical. Last reviewed 2026-11-24.

Theorem: a sum of terms c g_1 .. g_k p_1^2 .. p_m^2 with c > 0, where each g is nonnegative on the domain,
is nonnegative there; it is positive where in one term each g is positive and each p is not zero. A
quotient has the sign of its numerator times the factors of odd exponent in its denominator, and that of
its numerator alone where those factors are positive; all factors are nonzero on the domain.

Theorem (`cases`): every real b has b >= 0 and |b| = b, or b <= 0 and |b| = -b. What holds in both cases
holds. `{"by": k, "cases": [entry, entry]}` splits by the argument b of generator k, an absolute value: the
first entry is shown where b >= 0, the second where b <= 0, each null where what is known excludes the case.
In a case nothing is evaluated and no generator or factor is used for the first time, so that none is real or
not zero because of the case alone.

Theorem (`lemmas`): a polynomial that is shown not to be negative, or positive, on the domain has this sign in
whatever is shown after it. `{"lemmas": [[kind, POLY, entry], ..], "then": entry}`. The sign of log a by that
of a - 1, and those beside functions, roots and sizes, are known by such a polynomial.

The terms add up to the quantity, or to it times positive POLYs (`times`).
A term is `[c, [g, ..], [POLY, ..]]`. A g is the index of an assumption that a scalar is positive or
nonnegative, and stands for the numerator of that scalar times its factors of odd exponent; or it is a
POLY whose sign the kernel knows (a root, an absolute value, an exponential, ..); or `{"given", "vector"}`,
which is x'Px for an assumed definite P and a vector x of POLYs.
"""

from __future__ import annotations

from typing import Any

from symctrl.kernel.certificate import Invalid, fields, natural, rational, several, typed
from symctrl.kernel.conditions import SIGNS
from symctrl.kernel.field import Value
from symctrl.kernel.polynomial import Poly
from symctrl.kernel.replay import Replay
from symctrl.kernel.sums import SumIdentity, opened
from symctrl.kernel.values import Condition, Statement


def needed_conditions(statement: Statement, proof: dict[str, Any]) -> set[Condition]:
    """The conditions under which the proof shows the claim. Raises Invalid or Declined where it does not."""
    test, outputs = opened(statement, proof, ("nonnegative", "positive"), "entries")
    entries = several(proof["entries"], len(outputs), "entries")
    for k, (value, entry) in enumerate(zip(outputs, entries, strict=True)):
        prove_sign(test, value, entry, statement.claim.kind == "positive", f"entry {k}")
    return test.replay.close()


def prove_sign(test: SumIdentity, value: Value, entry: Any, strict: bool, where: str) -> None:
    """Returns if the terms prove the value nonnegative, or positive if `strict`. Raises Invalid."""
    if "cases" in typed(entry, dict, where):
        _prove_cases(test, value, entry, strict, where)
        return
    if "lemmas" in entry:
        _prove_lemmas(test, value, entry, strict, where)
        return
    replay, ring = test.replay, test.replay.field.ring
    total: Poly = {}
    positive = False
    table = fields(entry, ("terms",), where, optional=("times",))
    times: Poly = {0: 1}
    for factor in typed(table.get("times", []), list, where):
        times = ring.mul(times, _positive(replay, factor, where))
    for k, term in enumerate(typed(table["terms"], list, where)):
        product, sure = _term(replay, term, f"{where}, term {k}")
        total = ring.add(total, product)
        positive = positive or sure
    if strict and not positive:
        raise Invalid(f"{where}: no term is certainly positive")
    forms = [ring.mul(times, form) for form in _forms(replay, value)]
    sides: list[Value] = [{(): ring.add(form, ring.scale(total, -1))} for form in forms]
    if not any(_is_zero(test, side, where) for side in sides[:-1]):
        test.require_zero(sides[-1], where)


def _prove_lemmas(test: SumIdentity, value: Value, entry: Any, strict: bool, where: str) -> None:
    table = fields(entry, ("lemmas", "then"), where)
    for n, lemma in enumerate(typed(table["lemmas"], list, where)):
        said = f"{where}, lemma {n}"
        kind, poly, inner = several(lemma, 3, f"{said}, [kind, POLY, entry]")
        if kind not in ("positive", "nonnegative"):
            raise Invalid(f"{said}: a lemma says that something is positive or nonnegative")
        p = test.replay.poly(poly, said)
        prove_sign(test, {(): p} if p else {}, inner, kind == "positive", said)
        test.replay.learn_sign(kind, p)
    prove_sign(test, value, table["then"], strict, where)


def _prove_cases(test: SumIdentity, value: Value, entry: Any, strict: bool, where: str) -> None:
    table = fields(entry, ("by", "cases"), where)
    if test.sums.totals:
        raise Invalid(f"{where}: a sum over all nodes is not shown by cases")
    k = natural(table["by"], len(test.replay.table), where)
    sides = zip((1, -1), several(table["cases"], 2, where), strict=True)
    for side, inner in sides:
        said = f"{where}, {'first' if side > 0 else 'second'} case"
        with test.replay.supposing(k, side, said) as possible:
            if possible and inner is None:
                raise Invalid(f"{said}: it is not excluded by what is known")
            if not possible and inner is not None:
                raise Invalid(f"{said}: it never occurs")
            if possible:
                prove_sign(test, value, inner, strict, said)


def _is_zero(test: SumIdentity, value: Value, where: str) -> bool:
    try:
        test.require_zero(value, where)
    except Invalid:
        return False
    return True


def _forms(replay: Replay, value: Value) -> list[Poly]:
    """Polynomials with the sign of the value."""
    numerator, key = replay.field.fraction(value)
    odd = [replay.field.factors[factor] for factor, exponent in key if exponent % 2]
    if odd and all(replay.signs.of(p) - {0} == SIGNS["positive"] for p in odd):
        return [numerator, replay.signs.carrier(value)]
    return [replay.signs.carrier(value)]


def _term(replay: Replay, value: Any, where: str) -> tuple[Poly, bool]:
    """The polynomial of a term, and whether it is certainly positive."""
    number, factors, squares = several(value, 3, f"{where}, [number, [assumption, ..], [POLY, ..]]")
    c = rational(number, where)
    if c <= 0:
        raise Invalid(f"{where}: the number {c} is not positive")
    result: Poly = {0: c.numerator if c.denominator == 1 else c}
    positive = True
    for g in typed(factors, list, where):
        p, sure = _nonnegative(replay, g, where)
        result = replay.field.ring.mul(result, p)
        positive = positive and sure
    for square in typed(squares, list, where):
        p = replay.poly(square, where)
        result = replay.field.ring.mul(result, replay.field.ring.mul(p, p))
        positive = positive and (replay.is_factor(p) or 0 not in replay.signs.of(p))
    return result, positive


def _positive(replay: Replay, value: Any, where: str) -> Poly:
    p = replay.poly(value, where)
    if replay.signs.of_learned(p) != SIGNS["positive"]:
        raise Invalid(f"{where}: {replay.signs.printer.poly(p)[:200]} is not known to be positive")
    return p


def _nonnegative(replay: Replay, g: Any, where: str) -> tuple[Poly, bool]:
    """A polynomial that is not negative, and whether it is positive."""
    if type(g) is dict:
        return _form(replay, g, where), False
    if type(g) is list:
        p = replay.poly(g, where)
        signs = replay.signs.of_learned(p)
        if not signs <= SIGNS["nonnegative"]:
            raise Invalid(f"{where}: the sign of {replay.signs.printer.poly(p)[:200]} is not known")
        return p, 0 not in signs
    k = natural(g, len(replay.given), where)
    kind = replay.statement.given[k].kind
    if kind not in ("positive", "nonnegative"):
        raise Invalid(f"{where}: assumption {k} says {kind}, which gives no factor of a term")
    return replay.signs.carrier(replay.given[k][0]), kind == "positive"


def _form(replay: Replay, g: dict[str, Any], where: str) -> Poly:
    """x'Px for a matrix P that is assumed to be definite or semidefinite."""
    table = fields(g, ("given", "vector"), where)
    k = natural(table["given"], len(replay.given), where)
    n = replay.statement.given[k].size
    x = [replay.poly(entry, where) for entry in typed(table["vector"], list, where)]
    if not replay.statement.given[k].kind.startswith("positive_") or len(x) != n:
        raise Invalid(f"{where}: assumption {k} is not about a {len(x)}x{len(x)} matrix that is definite")
    field = replay.field
    total: Value = {}
    for r in range(n):
        for c in range(n):
            product = field.mul({(): field.ring.mul(x[r], x[c])}, replay.given[k][r + n * c])
            total = field.add(total, product)
    numerator, key = field.fraction(total)
    if key:
        raise Invalid(f"{where}: the matrix of assumption {k} has denominators")
    return numerator
