"""Quantities as polynomials over their free symbols, to look for constants and combinations."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, TypeVar

from symctrl.decide.coefficients import coefficient_of, generator_of
from symctrl.decide.session import Session, exactly
from symctrl.domains.field import Exact, Poly
from symctrl.graph import Instruction, Tape
from symctrl.kernel.argument import OBLIGATION
from symctrl.kernel.compose import composed, rate_listing
from symctrl.kernel.values import Claim, Listing
from symctrl.problem import star
from symctrl.rules.seeker import NO_MEANING

if TYPE_CHECKING:
    from symctrl.rules.chain import Chain

Result = TypeVar("Result")


@dataclass
class Algebra:
    """Exact values of quantities in one session without assumptions."""

    session: Session
    values: list[Exact]
    scalars: Any

    def occurring(self, value: Exact) -> set[int]:
        """The generators of the value, and those that they are made of."""
        field = self.session.domain.field
        found = {g for p in value.values() if not p.is_zero() for g in field.occurring(p)}
        found |= {g for key in value for f, _ in key for g in field.occurring(field.factors[f])}
        waiting = list(found)
        while waiting:
            for g in field.made_of(waiting.pop()) - found:
                found.add(g)
                waiting.append(g)
        return found

    def is_constant(self, value: Exact) -> bool:
        """Is it made of parameters alone?"""
        field = self.session.domain.field
        free = [field.generators[g] for g in self.occurring(value) if field.generators[g].kind == "free"]
        return all(self.scalars.get(star(g.name)) == "parameter" for g in free) and not any(
            field.generators[g].kind == "sum" for g in self.occurring(value)
        )

    def coefficient(self, value: Exact, powers: dict[int, int]) -> Exact:
        """The coefficient of a product of generators, which must not be in a denominator."""
        field = self.session.domain.field
        found = {key: coefficient_of(field, p, powers) for key, p in value.items()}
        return {key: p for key, p in found.items() if not p.is_zero()}

    def tape(self, value: Exact) -> Tape | None:
        """The value as instructions; None where it has generators that have none here."""
        maker = _Tape(self.session)
        return maker.finish(value)


def algebra(
    chain: Chain, quantities: Sequence[str], work: Callable[[Algebra], Result], relations: bool = False
) -> Result | None:
    """`work` on the exact values of quantities, by themselves or reduced by the equations that are assumed;
    None where these have no exact meaning.
    """
    listings = [chain.at.statement.listings[name] for name in quantities]
    code, outputs = _together(listings)
    whole = chain.at.statement
    claim = Claim("conforms", OBLIGATION, (len(outputs), 1))
    stated = replace(
        whole, listings={**whole.listings, OBLIGATION: Listing(code, outputs, "")}, given=(), claim=claim
    )
    given = [a for a in chain.at.available if a.kind == "zero"] if relations else []
    problem = chain.seeker.problem(stated, given)
    try:
        return exactly(problem, lambda s: work(Algebra(s, s.claim(), problem.scalars)))
    except NO_MEANING:
        return None


def symbol_of(found: Algebra, value: Exact) -> int | None:
    """The generator that a value is; None where it is anything else."""
    return generator_of(found.session.domain.field, value)


def rate_over(chain: Chain, listing: str) -> Tape | None:
    """The rate of a listing of one output over itself, where that is a polynomial."""
    return algebra(chain, [rate_listing(listing, 1), listing], _exact_quotient)


def _exact_quotient(found: Algebra) -> Tape | None:
    domain = found.session.domain
    above, below = found.values
    (numerator, key), (divisor, own) = domain.together(above), domain.together(below)
    if divisor.is_zero() or not found.is_constant({key: domain.field.polynomial(1)}) or own:
        return None
    quotient, rest = divmod(numerator, divisor)
    return found.tape({key: quotient} if not quotient.is_zero() else {}) if rest.is_zero() else None


def _together(listings: Sequence[Listing]) -> tuple[Any, Any]:
    named = {f"q{k}": listing for k, listing in enumerate(listings)}
    made = composed(named, list(named), {name: name for name in named})
    return made.code, made.outputs


class _Tape:
    """Instructions of an exact value, each once."""

    def __init__(self, session: Session) -> None:
        self.field = session.domain.field
        self.domain = session.domain
        self.code: list[Instruction] = []
        self.at: dict[Instruction, int] = {}

    def finish(self, value: Exact) -> Tape | None:
        out = self.value(value)
        if out is None:
            return None
        needed = {out}
        for r in range(len(self.code) - 1, -1, -1):
            if r in needed:
                needed.update(self.code[r].args)
        new = {old: n for n, old in enumerate(sorted(needed))}
        code = tuple(
            Instruction(s.op, tuple(new[a] for a in s.args), s.name, s.value)
            for r, s in enumerate(self.code)
            if r in needed
        )
        return Tape(code, (new[out],))

    def emit(self, op: str, *args: int, name: str = "", value: Fraction = Fraction(0)) -> int:
        step = Instruction(op, args, name, value)
        at = self.at.setdefault(step, len(self.code))
        if at == len(self.code):
            self.code.append(step)
        return at

    def value(self, value: Exact) -> int | None:
        total: int | None = None
        for key, p in value.items():
            part = self.polynomial(p)
            for f, e in key:
                below = self.polynomial(self.field.factors[f])
                if part is None or below is None:
                    return None
                for _ in range(e):
                    part = self.emit("DIV", part, below)
            if part is None:
                return None
            total = part if total is None else self.emit("ADD", total, part)
        return self.emit("CONST", value=Fraction(0)) if total is None else total

    def polynomial(self, p: Poly) -> int | None:
        total: int | None = None
        for exponents, c in p.terms():
            number = Fraction(int(c.p), int(c.q))
            term: int | None = None if number == 1 and any(exponents) else self.emit("CONST", value=number)
            for v, e in enumerate(exponents):
                for _ in range(int(e)):
                    g = self.generator(self.field.size - 1 - v)
                    if g is None:
                        return None
                    term = g if term is None else self.emit("MUL", term, g)
            assert term is not None
            total = term if total is None else self.emit("ADD", total, term)
        return self.emit("CONST", value=Fraction(0)) if total is None else total

    def generator(self, k: int) -> int | None:
        g = self.field.generators[k]
        if g.kind == "free":
            return self.emit("INPUT", name=g.name)
        if g.kind in ("abs", "sign"):
            inner = self.polynomial(g.argument)
            return None if inner is None else self.emit("FABS" if g.kind == "abs" else "SIGN", inner)
        if g.kind in ("sin", "cos", "exp"):
            inner = self.value(g.argument)
            return None if inner is None else self.emit(g.kind.upper(), inner)
        if g.kind == "root":
            inner = self.polynomial(g.argument)
            if inner is None:
                return None
            return self.emit("POW", inner, self.emit("CONST", value=Fraction(1, g.degree)))
        return None
