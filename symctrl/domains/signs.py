"""What is known of the sign of a polynomial: by its terms, or by an assumption."""

from __future__ import annotations

from dataclasses import dataclass, field

from symctrl.domains.field import Field, Poly, coefficient

NONNEGATIVE_KINDS = frozenset(("root", "abs", "exp", "power"))


@dataclass
class Signs:
    """What is known of generators, and of the polynomials in `facts`: positive, nonnegative or nonzero."""

    field_: Field
    generator: dict[int, str] = field(default_factory=dict)
    facts: list[tuple[Poly, str]] = field(default_factory=list)

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

    def of(self, p: Poly) -> str | None:
        """positive, nonnegative or nonzero where that is known of p; None where nothing is."""
        best = self._by_terms(p)
        if best == "positive":
            return best
        for fact, kind in self.facts:
            ratio = _ratio(p, fact)
            if ratio is None:
                continue
            if ratio > 0:
                best = kind if best is None or kind == "positive" else _both(best, kind)
            if ratio < 0 and kind in ("positive", "nonzero") and best is None:
                best = "nonzero"
        if best is None and (self._by_terms(-p) == "positive" or self._is_nonzero_monomial(p)):
            best = "nonzero"
        return best

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
        if g.kind != "function" or g.name != "log" or set(g.argument[0]) != {()}:
            return None
        return self.of(g.argument[0][()] - 1)


def _ratio(p: Poly, q: Poly) -> int | None:
    """The sign of c where p = c q for a rational c."""
    if len(p) != len(q) or p.is_zero():
        return None
    c = p.leading_coefficient() / q.leading_coefficient()
    return (1 if c > 0 else -1) if p == q * c else None


def _both(a: str, b: str) -> str:
    """What two known kinds of sign say together: whatever two different ones say, it is positive."""
    return a if a == b else "positive"
