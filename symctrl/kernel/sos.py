"""Proofs that a polynomial is nonnegative, or positive, on a set given by polynomials; points that refute it.

Soundness-critical. Last reviewed 2026-11-24.

p, g_1, .., g_k and h_1, .., h_m are polynomials over Q, and S is the set of real points with all g_i >= 0 and
all h_j = 0; without g and h it is the whole space.

Theorem (`squares`). Let s p = e + sum of G_a q_a + sum of c_j h_j, where e >= 0 is a number, each G_a is a
product of some g_i (of none: 1), each q_a is a sum of squares, and s = c + q with a number c >= 0 and a sum
of squares q. Then p >= 0 on S if c > 0, and also if s is not the zero polynomial and S is the whole space;
and p > 0 on S if e > 0. Proof: on S the right side is at least e. If c > 0, s is positive. If e > 0, s p is
positive and s is not negative, so both s and p are positive. If S is the whole space, p >= 0 wherever s is
not zero; that is a dense set, as s is not the zero polynomial, and p is continuous.

Theorem (`empty`). If 0 = e + sum of G_a q_a + sum of c_j h_j with e > 0, S is empty: every claim about its
points holds, and says nothing. Proof: at a point of S the right side would be at least e.

Sums of squares. b' H b / d, with polynomials b, a symmetric integer matrix H and an integer d > 0, is a sum
of squares of polynomials over R if t H - L L' is diagonally dominant for an integer t > 0 and some integer
matrix L: then H is positive semidefinite (`matrices`), and b' H b = |H^(1/2) b|^2.

Theorem (`witness`). A point of S with rational coordinates at which p < 0 (p <= 0) shows that p >= 0 (p > 0)
on S is false.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from symctrl.kernel.certificate import Declined, Invalid, digest, fields, rational, text_field, typed
from symctrl.kernel.printing import line
from symctrl.kernel.terms import Rational, Work, exponents, integer_poly, longest, rational_poly, sign_at

MAX_VARIABLES = 2000
MAX_CONSTRAINTS = 1000
MAX_PARTS = 20_000
MAX_ROWS = 1500  # of a Gram matrix
MAX_WORK = 10**11  # rows cubed times bits
PRINTED_TERMS = 60
CLAIMS = ("nonnegative", "positive")

_NAME = re.compile(r"[^\W\d]\w*(\[[1-9]\d{0,8}(,[1-9]\d{0,8})?\])?")


@dataclass(frozen=True, slots=True)
class Statement:
    """Is the polynomial nonnegative (strict: positive) where `nonnegative` and `zero` are what they say?"""

    study: str
    id: str
    text: str
    variables: tuple[str, ...]
    polynomial: Rational
    nonnegative: tuple[Rational, ...]
    zero: tuple[Rational, ...]
    strict: bool
    sha256: str


def is_meant(statement: Any) -> bool:
    """Is this the JSON of a statement about a polynomial, right or wrong?"""
    return type(statement) is dict and "polynomial" in statement


def read_statement(value: Any) -> Statement:
    """The statement from its JSON. Raises Invalid, or Declined for one that is too large."""
    names = ("study", "id", "text", "variables", "polynomial", "nonnegative", "zero", "claim")
    s = fields(value, names, "statement")
    study, id_, words = (text_field(s[field], field) for field in ("study", "id", "text"))
    variables = typed(s["variables"], list, "variables")
    if len(variables) > MAX_VARIABLES:
        raise Declined(f"more than {MAX_VARIABLES} variables")
    for name in variables:
        if type(name) is not str or len(name) > 200 or not _NAME.fullmatch(name):
            raise Invalid(f"variables: {str(name)[:60]!r} is not a name like x or q[1]")
    if not variables or len(set(variables)) != len(variables):
        raise Invalid("variables: there is none, or one is named twice")
    if type(s["claim"]) is not str or s["claim"] not in CLAIMS:
        raise Invalid(f"claim: {str(s['claim'])[:60]!r} is not one of {', '.join(CLAIMS)}")
    n = len(variables)
    polynomial = rational_poly(s["polynomial"], n, "polynomial")
    given = {}
    for field in ("nonnegative", "zero"):
        table = typed(s[field], list, field)
        if len(table) > MAX_CONSTRAINTS:
            raise Declined(f"more than {MAX_CONSTRAINTS} constraints")
        given[field] = tuple(rational_poly(g, n, f"{field} {k}") for k, g in enumerate(table))
    about = {field: s[field] for field in ("variables", "polynomial", "nonnegative", "zero", "claim")}
    return Statement(
        study,
        id_,
        words,
        tuple(variables),
        polynomial,
        given["nonnegative"],
        given["zero"],
        s["claim"] == "positive",
        digest(about),
    )


def print_statement(s: Statement, refuted: bool) -> str:
    """All that the statement says."""
    return "\n".join(_lines(s, refuted))


def _lines(s: Statement, refuted: bool) -> Iterator[str]:
    yield f'statement {line(s.id)} of {line(s.study)}, in the words of the certificate: "{line(s.text)}"'
    false = "it is false that " if refuted else ""
    where = " with what is given" if s.nonnegative or s.zero else ""
    sign = ">" if s.strict else ">="
    yield f"{false}{_shown(s.polynomial, s.variables)} {sign} 0 for all real {', '.join(s.variables)}{where}"
    for g in s.nonnegative:
        yield f"given: {_shown(g, s.variables)} >= 0"
    for h in s.zero:
        yield f"given: {_shown(h, s.variables)} = 0"
    yield f"sha256 of the polynomials {s.sha256}"


def _shown(p: Rational, variables: Sequence[str]) -> str:
    if len(p.terms) > PRINTED_TERMS:
        return f"a polynomial of degree {p.degree} with {len(p.terms)} terms"
    text = ""
    for m, c in p.terms.items():
        factors = [variables[k] if e == 1 else f"{variables[k]}^{e}" for k, e in exponents(m)]
        number = abs(Fraction(c, p.denominator))
        shown = str(number)
        if len(shown) > 200:
            shown = f"(a number of {len(shown)} digits)"
        words = [shown] * (number != 1 or not factors) + factors
        sign = "-" if c < 0 else "+"
        text += (f" {sign} " if text else sign.replace("+", "")) + "*".join(words)
    return text or "0"


def verify(s: Statement, proof: dict[str, Any]) -> None:
    """Raises Invalid or Declined unless the proof shows the claim, or a witness that it is false."""
    kind = proof.get("kind")
    if kind == "squares":
        _verify_squares(s, fields(proof, ("kind", "multiplier", "margin", "parts", "multiples"), "proof"))
    elif kind == "empty":
        _verify_empty(s, fields(proof, ("kind", "margin", "parts", "multiples"), "proof"))
    elif kind == "witness":
        _verify_witness(s, fields(proof, ("kind", "values"), "proof")["values"])
    else:
        raise Declined(f"a proof of the kind {str(kind)[:60]!r} is not known for a polynomial")


def _verify_squares(s: Statement, proof: dict[str, Any]) -> None:
    margin = _at_least_zero(proof["margin"], "margin")
    multiplier = fields(proof["multiplier"], ("constant", "parts"), "multiplier")
    constant = _at_least_zero(multiplier["constant"], "the constant of the multiplier")
    work = Work()
    scale = work.total(_sums(multiplier["parts"], s, "multiplier", (), work), constant)
    everywhere = not s.nonnegative and not s.zero
    if s.strict and margin == 0:
        raise Invalid("the claim is strict, and the margin is zero")
    if margin == 0 and constant == 0 and not (everywhere and scale.terms):
        raise Invalid("the multiplier may be zero at points of the set")
    if not scale.terms:
        raise Invalid("the multiplier is zero")
    _require_equal(work.times(scale, s.polynomial), _right_side(s, proof, margin, work))


def _verify_empty(s: Statement, proof: dict[str, Any]) -> None:
    margin = _at_least_zero(proof["margin"], "margin")
    if margin == 0:
        raise Invalid("the margin is zero, so that nothing shows the set to be empty")
    _require_equal(Rational({}, 1, 0), _right_side(s, proof, margin, Work()))


def _at_least_zero(value: Any, where: str) -> Fraction:
    number = rational(typed(value, str, where), where)
    if number < 0:
        raise Invalid(f"{where} is negative")
    return number


def _require_equal(left: Rational, right: Rational) -> None:
    p, q = left.denominator, right.denominator
    if len(left.terms) != len(right.terms) or any(
        c * q != right.terms.get(m, 0) * p for m, c in left.terms.items()
    ):
        raise Invalid("the identity does not hold")


def _right_side(s: Statement, proof: Mapping[str, Any], margin: Fraction, work: Work) -> Rational:
    summands = _sums(proof["parts"], s, "proof", s.nonnegative, work)
    multiples = typed(proof["multiples"], list, "multiples")
    if len(multiples) != len(s.zero):
        raise Invalid(f"there are {len(multiples)} multiples of {len(s.zero)} polynomials that are zero")
    for k, (c, h) in enumerate(zip(multiples, s.zero, strict=True)):
        summands.append(work.times(rational_poly(c, len(s.variables), f"multiple {k}"), h))
    return work.total(summands, margin)


def _sums(value: Any, s: Statement, where: str, weights: tuple[Rational, ...], work: Work) -> list[Rational]:
    """What each part stands for: a product of weights times a sum of squares."""
    parts = typed(value, list, where)
    if len(parts) > MAX_PARTS:
        raise Declined(f"{where}: more than {MAX_PARTS} parts")
    return [_part(part, s, f"{where}, part {k}", weights, work) for k, part in enumerate(parts)]


def _part(value: Any, s: Statement, where: str, weights: tuple[Rational, ...], work: Work) -> Rational:
    part = fields(value, ("product", "basis", "gram", "denominator", "lower", "scale"), where)
    product = typed(part["product"], list, where)
    if any(type(k) is not int or not 0 <= k < len(weights) for k in product):
        raise Invalid(f"{where}: the product names a constraint that there is not")
    if any(a >= b for a, b in pairwise(product)):
        raise Invalid(f"{where}: the constraints of the product do not increase")
    basis = [integer_poly(b, len(s.variables), where) for b in typed(part["basis"], list, where)]
    if not 0 < len(basis) <= MAX_ROWS:
        raise Declined(f"{where}: a basis of none or of more than {MAX_ROWS} polynomials")
    gram = _triangle(part["gram"], len(basis), f"{where}, gram")
    lower = _triangle(part["lower"], len(basis), f"{where}, lower")
    d, t = typed(part["denominator"], int, where), typed(part["scale"], int, where)
    if d < 1 or t < 1:
        raise Invalid(f"{where}: the denominator or the scale is not positive")
    if not _dominant(gram, lower, t, where):
        raise Invalid(f"{where}: the Gram matrix is not shown to be positive semidefinite")
    result = Rational(work.form(basis, gram), d, 2 * max(b.degree for b in basis))
    for k in product:
        result = work.times(result, weights[k])
    return result


def _triangle(value: Any, n: int, where: str) -> list[list[int]]:
    rows = typed(value, list, where)
    if len(rows) != n:
        raise Invalid(f"{where}: {len(rows)} rows for a basis of {n}")
    for k, row in enumerate(rows):
        if type(row) is not list or len(row) != k + 1 or any(type(a) is not int for a in row):
            raise Invalid(f"{where}: row {k + 1} is not a list of {k + 1} integers")
    return rows


def _dominant(gram: list[list[int]], lower: list[list[int]], t: int, where: str) -> bool:
    """Is R = t H - L L' dominant: R_ii >= the sum of |R_ij| over j other than i, for each i?

    Row i of L L' is the sum of L_ik times column k; a column is one integer, with a digit of `width` bytes a
    row, so that the products of a row with all columns are few products of long integers.
    """
    n = len(gram)
    width = (2 * longest(lower) + n.bit_length() + 9) // 8
    if n**3 * (8 * width) + n**2 * (longest(gram) + t.bit_length()) > MAX_WORK:
        raise Declined(f"{where}: a Gram matrix of {n} rows with numbers of this length is too much work")
    bits = 8 * width
    columns = [sum(lower[j][k] << (bits * j) for j in range(k, n)) for k in range(n)]
    half = 1 << (bits - 1)
    offset = sum(half << (bits * j) for j in range(n))
    slack = [0] * n
    for i in range(n):
        row = sum((a * columns[k] for k, a in enumerate(lower[i]) if a), offset)
        digits = row.to_bytes(width * n, "little")
        for j in range(i + 1):
            square = int.from_bytes(digits[width * j : width * (j + 1)], "little") - half
            r = t * gram[i][j] - square
            if i == j:
                slack[i] += r
            else:
                slack[i] -= abs(r)
                slack[j] -= abs(r)
    return min(slack) >= 0


def _verify_witness(s: Statement, value: Any) -> None:
    values = fields(value, s.variables, "values")
    point = [rational(typed(values[name], str, name), name) for name in s.variables]
    for k, g in enumerate(s.nonnegative):
        if sign_at(g, point) < 0:
            raise Invalid(f"the witness is not in the set: polynomial {k} of `nonnegative` is negative there")
    for k, h in enumerate(s.zero):
        if sign_at(h, point) != 0:
            raise Invalid(f"the witness is not in the set: polynomial {k} of `zero` is not zero there")
    sign = sign_at(s.polynomial, point)
    if sign > 0 or (sign == 0 and not s.strict):
        raise Invalid("the witness does not contradict the claim")
