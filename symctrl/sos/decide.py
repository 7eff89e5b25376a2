"""The order in which a problem is tried: what is cheap and certain first, floats only as proposals."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any, Literal

from symctrl.certify import canonical, certificate
from symctrl.kernel.check import check_text
from symctrl.sos import line
from symctrl.sos.basis import TooMany, half_newton, parities, split
from symctrl.sos.cliques import groups, search_groups
from symctrl.sos.constrained import programmes
from symctrl.sos.deadline import Deadline, Late, one_thread
from symctrl.sos.multiplier import multipliers
from symctrl.sos.problem import Problem
from symctrl.sos.programme import Block, Programme, TooLarge
from symctrl.sos.proof import Part, Proof, times_square
from symctrl.sos.refute import Refuter
from symctrl.sos.ring import Poly, monomial, terms, to_fmpq, to_fraction, value_at
from symctrl.sos.scaling import Scaled, scaled
from symctrl.sos.search import Found, Missed, bounds, on_boundary, search

Verdict = Literal["proved", "refuted", "undecided"]


# From so many variables on, groups of variables are looked for first.
_MANY = 4


@dataclass
class Outcome:
    """What is known about a problem: `proved` and `refuted` with a certificate that the kernel accepts."""

    verdict: Verdict
    reason: str
    certificate: dict[str, Any] | None = None
    witness: dict[str, str] | None = None
    bound: Fraction | None = None
    tried: list[str] = field(default_factory=list)
    vacuous: bool = False
    point: tuple[Fraction, ...] | None = None
    proof: Proof | None = None


@dataclass(frozen=True)
class Later:
    """A programme without a margin, in the variables of `better`; extra: the multiplier in it."""

    programme: Programme
    better: Scaled
    words: str
    extra: tuple[Part, ...] = ()


class Decided(Exception):  # noqa: N818
    """The search ends here."""

    def __init__(self, outcome: Outcome) -> None:
        super().__init__(outcome.reason)
        self.outcome = outcome


class Decision:
    """One problem on its way to an outcome."""

    def __init__(self, problem: Problem, deadline: Deadline) -> None:
        self.problem = problem
        self.deadline = deadline
        self.tried: list[str] = []
        self.refuter = Refuter(problem, deadline)
        self.later: list[Later] = []
        self.empty_tried = False
        self.point: tuple[Fraction, ...] | None = None
        self.proof: Proof | None = None

    def run(self) -> Outcome:
        try:
            self._all()
        except Decided as done:
            done.outcome.point, done.outcome.proof = self.point, self.proof
            return done.outcome
        except Late as late:
            self.tried.append(f"stopped by {late}")
        bound = lower_bound(self.problem, self.deadline)
        reason = "neither a proof nor a witness was found"
        return Outcome("undecided", reason, bound=bound, tried=self.tried)

    def _all(self) -> None:
        problem = self.problem
        self._trivial()
        self._line()
        self.tried.append("points on a grid and on curves")
        self.refuted(self.refuter.quick())
        if problem.everywhere and not problem.strict:
            self._squares()
            self._factors()
        elif problem.everywhere:
            self._strictly()
        self.tried.append("descents")
        self.refuted(self.refuter.thorough())
        if not problem.everywhere:
            self._constrained()
        self._boundary()
        if problem.everywhere and not problem.strict:
            self._multiplied()

    def _trivial(self) -> None:
        p = self.problem.polynomial
        if p == 0 and not self.problem.strict:
            self.proved(Proof(()), "it is the zero polynomial")
        value = to_fraction(p.leading_coefficient()) if p.is_constant() and p != 0 else Fraction(0)
        if value > 0:
            self.proved(Proof((), margin=value), "it is a positive number")

    def _line(self) -> None:
        """One variable, or a form in two: decided completely on the line, half-lines and intervals."""
        problem = self.problem
        k, form = line.variable_of(problem), line.form_of(problem)
        if k is None and form is None:
            return
        self.tried.append("the sign between all real roots")
        found = line.points(problem, k) if k is not None else line.form_points(problem, form or (0, 0))
        for point in found:
            self.refuted(point if self.refuter.contradicts(point) else None)
        if not problem.everywhere:
            self._emptiness()
        if k is not None:
            proof = line.prove(problem, k, self.deadline)
        else:
            proof = line.prove_form(problem, form or (0, 0), self.deadline)
        if proof is not None:
            self.proved(
                proof, "it is a sum of squares" + ("" if problem.everywhere else " with the constraints")
            )

    def _squares(self) -> None:
        p = self.problem.polynomial
        self._in_groups(p)
        found = self._square_programme(p)
        if found is not None:
            self.proved(Proof(found.parts), "it is a sum of squares")

    def _in_groups(self, p: Poly) -> None:
        found = groups(p) if sum(map(bool, p.degrees())) >= _MANY else None
        if found is None:
            return
        words = "a sum of squares in groups of variables"
        self.tried.append(words)
        parts = search_groups(p, found, self.deadline)
        if parts is not None:
            self.proved(Proof(tuple(parts)), f"it is {words}")
        one = self.problem.ring.constant(1)
        polys = [tuple(monomial(self.problem.ring, b) for b in basis) for basis in found.bases]
        programme = Programme(p, tuple(Block((), one, basis) for basis in polys))
        n = len(self.problem.names)
        same = Scaled(self.problem, (Fraction(0),) * n, (Fraction(1),) * n)
        self.later.append(Later(programme, same, words))

    def _square_programme(self, p: Poly, extra: tuple[Part, ...] = (), words: str = "") -> Found | None:
        """p as a sum of squares over half its Newton polytope, in floats first. extra: see `_multiplied`."""
        better = scaled(Problem(self.problem.names, p))
        target = better.problem.polynomial
        try:
            basis = half_newton(terms(target))
        except TooMany as error:
            self.tried.append(f"{words or 'a sum of squares'}, too large ({error})")
            return None
        one = self.problem.ring.constant(1)
        blocks = tuple(
            Block((), one, tuple(monomial(self.problem.ring, b) for b in part))
            for part in split(basis, parities([target]))
        )
        self.tried.append(f"{words or 'a sum of squares'} over {len(basis)} monomials")
        programme = Programme(target, blocks)
        found = self._search(programme)
        if isinstance(found, Found):
            return Found(better.back(Proof(found.parts)).parts)
        if isinstance(found, Missed) and found.near and not self.problem.strict:
            self.later.append(Later(programme, better, words or "a sum of squares", extra))
        return None

    def _multiplied(self) -> None:
        """s p as a sum of squares, for powers s of the sum of squares of the variables."""
        for name, s, part in multipliers(self.problem.polynomial):
            self.later = []
            words = f"a sum of squares after multiplication by {name}"
            found = self._square_programme(s * self.problem.polynomial, (part,), words)
            if found is not None:
                self.proved(Proof(found.parts, constant=Fraction(0), multiplier=(part,)), f"it is {words}")
            self._boundary()

    def _boundary(self) -> None:
        """The programmes that had no margin, again with many digits, the small ones first."""
        for entry in sorted(self.later, key=lambda entry: len(entry.programme.support)):
            self.tried.append(f"{entry.words}, on the boundary")
            try:
                found = on_boundary(entry.programme, self.deadline, entry.better.problem.zero)
            except TooLarge as error:
                self.tried[-1] += f", too large ({error})"
                continue
            if isinstance(found, Found):
                proof = entry.better.back(Proof(found.parts, found.multiples))
                if entry.extra:
                    proof = replace(proof, constant=Fraction(0), multiplier=entry.extra)
                self.proved(proof, f"it is {entry.words}")

    def _search(self, programme: Programme, zero: tuple[Poly, ...] = ()) -> Found | Missed | None:
        try:
            return search(programme, self.deadline, zero)
        except TooLarge as error:
            self.tried[-1] += f", too large ({error})"
            return None

    def _factors(self) -> None:
        """p = q s^2: squares of factors need no proof."""
        unit, factors = self.problem.polynomial.factor()
        q, s = self.problem.ring.constant(unit), self.problem.ring.constant(1)
        for f, e in factors:
            q, s = (q * f if e % 2 else q), s * f ** (int(e) // 2)
        if s.is_constant():
            return
        self.tried.append("factors")
        inner = decide(Problem(self.problem.names, q), max(self.deadline.left / 2, 0.1))
        if inner.verdict == "refuted" and inner.point is not None:
            self.refuted(self._beside(inner.point))
        elif inner.proof is not None:
            self.proved(times_square(inner.proof, s), "it is a square times a sum of squares")

    def _beside(self, point: tuple[Fraction, ...]) -> tuple[Fraction, ...] | None:
        """A point near one where the square-free part is negative, at which the square is not zero."""
        for k in range(4, 60):
            near = tuple(x + Fraction(j + 1, 2**k) for j, x in enumerate(point))
            for candidate in (point, near):
                if self.refuter.contradicts(candidate):
                    return candidate
        return None

    def _strictly(self) -> None:
        """p - e as a sum of squares with some e > 0."""
        p = self.problem.polynomial
        size = max(abs(to_fraction(c)) for c in p.coeffs())
        for k in (4, 10, 20, 30):
            e = Fraction(2) ** (size.numerator.bit_length() - size.denominator.bit_length() - k)
            found = self._square_programme(p - to_fmpq(e))
            if found is not None:
                self.proved(Proof(found.parts, margin=e), f"less {e}, it is a sum of squares")

    def _emptiness(self) -> None:
        """Where no point of the set is known: -1 as a sum of squares times constraints."""
        if self.refuter.admissible is not None or self.empty_tried:
            return
        self.empty_tried = True
        better = scaled(self.problem)
        inner = better.problem
        for words, programme in programmes(inner, -inner.ring.constant(1), 1):
            self.tried.append(f"emptiness of the set with {words}")
            found = self._search(programme, inner.zero)
            if isinstance(found, Found):
                proof = better.back(Proof(found.parts, found.multiples, margin=Fraction(1)))
                reason = "no point satisfies the constraints"
                self._accept("proved", proof.as_json(empty=True), reason, None)

    def _constrained(self) -> None:
        self._emptiness()
        better = scaled(self.problem)
        inner = better.problem
        for words, programme in programmes(inner, inner.polynomial):
            self.tried.append(f"squares times {words}")
            found = self._search(programme, inner.zero)
            if isinstance(found, Found):
                proof = better.back(Proof(found.parts, found.multiples))
                self.proved(proof, f"it is a sum of squares times {words}")
            if isinstance(found, Missed) and found.near:
                self.later.append(Later(programme, better, f"a sum of squares times {words}"))

    def refuted(self, point: tuple[Fraction, ...] | None) -> None:
        """Ends with the witness, if there is one."""
        if point is None:
            return
        self.point = point
        values = {name: str(x) for name, x in zip(self.problem.names, point, strict=True)}
        value = value_at(self.problem.polynomial, point)
        sign = "zero" if value == 0 else "negative"
        shown = f" ({value})" if value and len(str(value)) < 40 else ""
        reason = f"the polynomial is {sign}{shown} at the witness"
        self._accept("refuted", {"kind": "witness", "values": values}, reason, values)

    def proved(self, proof: Proof, reason: str) -> None:
        """Ends with the proof, if the kernel accepts it."""
        if not proof.multiples:
            proof = replace(proof, multiples=tuple(0 * h for h in self.problem.zero))
        self.proof = proof
        self._accept("proved", proof.as_json(), reason, None)

    def _accept(self, verdict: Verdict, proof: dict[str, Any], reason: str, values: Any) -> None:
        made = certificate(self.problem.statement(), proof)
        answer = check_text(canonical(made))
        if answer.status != "valid":
            self.tried.append(f"a certificate that the kernel answers with {answer.status}: {answer.reason}")
            return
        vacuous = proof["kind"] == "empty"
        bound = Fraction(0) if verdict == "proved" and not vacuous else None
        raise Decided(Outcome(verdict, reason, made, values, bound, self.tried, vacuous))


def lower_bound(problem: Problem, deadline: Deadline) -> Fraction | None:
    """A number that the polynomial does not go below on the set, by a proof that the kernel accepts."""
    better = scaled(problem)
    inner = better.problem
    programme = None
    if problem.everywhere:
        try:
            basis = half_newton([*terms(inner.polynomial), (0,) * len(problem.names)])
        except TooMany:
            return None
        signs = parities([inner.polynomial])
        one = inner.ring.constant(1)
        parts = [tuple(monomial(inner.ring, b) for b in part) for part in split(basis, signs)]
        programme = Programme(inner.polynomial, tuple(Block((), one, part) for part in parts))
    else:
        programme = next((made for _, made in programmes(inner, inner.polynomial, 0)), None)
    late = Deadline(max(2.0, min(5.0, deadline.seconds / 5)))
    if programme is None or not programme.reaches:
        return None
    try:
        with one_thread():
            return _best(problem, programme, better, late)
    except (Late, TooLarge):
        return None


def _best(problem: Problem, programme: Programme, better: Scaled, late: Deadline) -> Fraction | None:
    for value in bounds(programme, late):
        shifted = replace(programme, target=programme.target - to_fmpq(value))
        found = search(shifted, late, better.problem.zero)
        if isinstance(found, Found):
            claim = replace(problem, polynomial=problem.polynomial - to_fmpq(value), strict=False)
            proof = better.back(Proof(found.parts, found.multiples))
            made = certificate(claim.statement(), proof.as_json())
            if check_text(canonical(made)).status == "valid":
                return value
    return None


def decide(problem: Problem, seconds: float) -> Outcome:
    """Is the polynomial nonnegative on the set? Within so many seconds, or undecided.

    With one thread: several in one small matrix product wait for each other when the machine is busy.
    """
    with one_thread():
        return Decision(problem, Deadline(seconds)).run()
