"""What is known of the sign of a polynomial: by its terms, or by an assumption."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from symctrl.domains import beside
from symctrl.domains.field import Field, Poly, coefficient, is_number

MAX_ASKED = 4  # polynomials whose signs are asked for, one for another
MAX_BESIDE = 12  # terms of a polynomial that is compared with what definitions say
NONNEGATIVE_KINDS = frozenset(("root", "abs", "exp", "power"))


@dataclass
class Signs:
    """What is known of generators, and of the polynomials in `facts`: positive, nonnegative or nonzero."""

    field_: Field
    generator: dict[int, str] = field(default_factory=dict)
    facts: list[tuple[Poly, str]] = field(default_factory=list)
    _asked: list[Poly] = field(default_factory=list)

    def learn(self, p: Poly, kind: str) -> None:
        """The assumption `kind` about p."""
        p = self.field_.normal(p)
        if len(p) == 1 and len(occurring := self.field_.occurring(p)) == 1:
            (k,) = occurring
            c = coefficient(p)
            if p == self.field_.variable(k) * p.leading_coefficient() and c > 0:
                self.generator[k] = _both(self.generator.get(k, kind), kind)
                return
        self.facts.append((p, kind))

    def suppose(self, b: Poly) -> bool:
        """Suppose that b is not negative, under a relation that is new; False where it always is.

        Facts are read again under the relation.
        """
        before = self.facts
        if self.of(-b) == "positive" or self.of(-self.field_.normal(b)) == "positive":
            return False
        self.facts = []
        for p, kind in [(b, "nonnegative"), *before]:
            form = self.field_.normal(p)
            if not form.is_zero() and not is_number(form):
                self.learn(form, kind)
            elif not _fits(form, kind):
                return False
        return not any(
            kind in ("positive", "nonnegative") and self.of(-p) == "positive" for p, kind in self.facts
        )

    def of(self, p: Poly) -> str | None:
        """positive, nonnegative or nonzero where that is known of p; None where nothing is."""
        best = self._by_terms(p)
        if best == "positive":
            return best
        best = self._by_facts(p, best)
        if best is None and (self._by_terms(-p) == "positive" or self._is_nonzero_monomial(p)):
            best = "nonzero"
        return best if best == "positive" or p.is_zero() else self._by_definitions(p, best)

    def _by_facts(self, p: Poly, best: str | None) -> str | None:
        """By a fact that is a multiple of p, or p times something positive."""
        for fact, kind in self.facts:
            ratio = _ratio(p, fact)
            if ratio is None:
                of = self._as_factor(p, fact, kind)
                best = best if of is None else of if best is None else _both(best, of)
                continue
            if ratio > 0:
                best = kind if best is None or kind == "positive" else _both(best, kind)
            if ratio < 0 and kind in ("positive", "nonzero") and best is None:
                best = "nonzero"
        return best

    def _by_definitions(self, p: Poly, best: str | None) -> str | None:
        """By what the definitions of the generators in p say of polynomials beside them."""
        if p in self._asked or len(self._asked) >= MAX_ASKED or len(p) > MAX_BESIDE:
            return best
        self._asked.append(p)
        for k in sorted(self.field_.occurring(p)):
            for kind in self._beside(p, k):
                best = kind if best is None or kind == "positive" else _both(best, kind)
        self._asked.pop()
        return best

    def _beside(self, p: Poly, k: int) -> Iterator[str]:
        """Signs of p by what stands beside generator k."""
        field_ = self.field_
        for q, strict in beside.not_negative(field_, k):
            if (_ratio(p, q) or 0) > 0:
                yield "positive" if strict else "nonnegative"
        for u, v in (*beside.pairs_of_one_sign(field_, k), *beside.differences(field_, p, k)):
            yield from (of for of in self._by_other(p, u, v) if of in ("positive", "nonnegative"))
            kind = self._as_multiple(p, u * v)
            if kind is not None:
                never = any(self.of(w) in ("positive", "nonzero") for w in (u, v))
                yield kind if never else "nonnegative"
        made = beside.conjugate(field_, p, k)
        if made is not None:
            c, r, other, D = made
            known = self._by_terms(c) is not None or self._by_terms(other) == "positive"
            signs = [self.of(field_.normal(D))] if known else []
            signs += [self.of(field_.normal(-D))] if self._by_terms(r) is not None else []
            yield from (of for of in signs if of in ("positive", "nonnegative"))

    def _by_other(self, p: Poly, u: Poly, v: Poly) -> Iterator[str | None]:
        """The sign of p where it is a multiple of one of two polynomials of one sign, by the other."""
        for w, other in ((u, v), (v, u)):
            ratio = _ratio(p, w)
            if ratio is not None:
                yield self.of(self.field_.normal(other * ratio))

    def _as_multiple(self, p: Poly, q: Poly) -> str | None:
        """The sign of p where it is q times something of known sign, or q is p times something positive."""
        if p.is_zero() or q.is_zero():
            return None
        r, rest = divmod(p, q)
        if rest.is_zero():
            of = self.of(r)
            return of if of in ("positive", "nonnegative") else None
        r, rest = divmod(q, p)
        return "positive" if rest.is_zero() and self.of(r) == "positive" else None

    def _as_factor(self, p: Poly, fact: Poly, kind: str) -> str | None:
        """The sign of p where the fact is p times something positive."""
        if len(p) < 2 or len(fact) < 2 or kind == "nonzero":
            return None
        r, rest = divmod(fact, p)
        return kind if rest.is_zero() and self._by_terms(r) == "positive" else None

    def _is_nonzero_monomial(self, p: Poly) -> bool:
        return len(p) == 1 and all(self._variable(k, 2) == "positive" for k in self.field_.occurring(p))

    def _by_terms(self, p: Poly) -> str | None:
        strict = False
        for exponents, c in p.terms():
            if c < 0:
                return None
            signs = [self._variable(self.field_.size - 1 - v, int(e)) for v, e in enumerate(exponents) if e]
            if None in signs:
                return None
            strict = strict or all(s == "positive" for s in signs)
        return "positive" if strict else "nonnegative"

    def _variable(self, k: int, exponent: int) -> str | None:
        known = self.generator.get(k) or self._of_logarithm(k)
        kind = self.field_.generators[k].kind
        if kind == "exp" or known == "positive":
            return "positive"
        if exponent % 2 == 0:
            return "positive" if known == "nonzero" else "nonnegative"
        return "nonnegative" if known == "nonnegative" or kind in NONNEGATIVE_KINDS else None

    def _of_logarithm(self, k: int) -> str | None:
        """log a has the sign of a - 1."""
        g = self.field_.generators[k]
        if g.kind != "function" or g.name != "log":
            return None
        return self.of(self.field_.normal(beside.carrier(self.field_, g.argument[0], less=1)))


def _ratio(p: Poly, q: Poly) -> int | None:
    """The sign of c where p = c q for a rational c."""
    if len(p) != len(q) or p.is_zero():
        return None
    c = p.leading_coefficient() / q.leading_coefficient()
    return (1 if c > 0 else -1) if p == q * c else None


def _fits(p: Poly, kind: str) -> bool:
    """May a number have a sign of this kind?"""
    c = coefficient(p)
    return {"positive": c > 0, "nonnegative": c >= 0, "nonzero": c != 0}[kind]


def _both(a: str, b: str) -> str:
    """What two known kinds of sign say together: whatever two different ones say, it is positive."""
    return a if a == b else "positive"
