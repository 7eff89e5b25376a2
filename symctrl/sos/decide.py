"""The order in which a problem is tried: what is cheap and certain first, floats only as proposals."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, Literal

from symctrl.certify import canonical, certificate
from symctrl.kernel.check import check_text
from symctrl.sos.basis import half_newton, parities, split
from symctrl.sos.deadline import Deadline, Late
from symctrl.sos.problem import Problem
from symctrl.sos.programme import Block, Programme, TooLarge
from symctrl.sos.proof import Proof
from symctrl.sos.refute import Refuter
from symctrl.sos.ring import monomial, terms
from symctrl.sos.search import Found, search

Verdict = Literal["proved", "refuted", "undecided"]


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

    def run(self) -> Outcome:
        try:
            self._all()
        except Decided as done:
            return done.outcome
        except Late as late:
            self.tried.append(f"stopped by {late}")
        return Outcome("undecided", "neither a proof nor a witness was found", tried=self.tried)

    def _all(self) -> None:
        self.tried.append("points on a grid and on curves")
        self.refuted(self.refuter.quick())
        self._squares()
        self.tried.append("descents")
        self.refuted(self.refuter.thorough())

    def _squares(self) -> None:
        problem = self.problem
        if not problem.everywhere or problem.strict:
            return
        basis = half_newton(terms(problem.polynomial))
        signs = parities([problem.polynomial])
        one = problem.ring.constant(1)
        blocks = tuple(
            Block((), one, tuple(monomial(problem.ring, b) for b in part)) for part in split(basis, signs)
        )
        try:
            found = search(Programme(problem.polynomial, blocks), self.deadline)
        except TooLarge as error:
            self.tried.append(f"a sum of squares, too large: {error}")
            return
        self.tried.append(f"a sum of squares over {len(basis)} monomials")
        if isinstance(found, Found):
            self.proved(Proof(found.parts), "it is a sum of squares")

    def refuted(self, point: tuple[Fraction, ...] | None) -> None:
        """Ends with the witness, if there is one."""
        if point is None:
            return
        values = {name: str(x) for name, x in zip(self.problem.names, point, strict=True)}
        self._accept(
            "refuted", {"kind": "witness", "values": values}, "the polynomial is negative there", values
        )

    def proved(self, proof: Proof, reason: str) -> None:
        """Ends with the proof, if the kernel accepts it."""
        self._accept("proved", proof.as_json(), reason, None)

    def _accept(self, verdict: Verdict, proof: dict[str, Any], reason: str, values: Any) -> None:
        made = certificate(self.problem.statement(), proof)
        answer = check_text(canonical(made))
        if answer.status != "valid":
            self.tried.append(f"a certificate that the kernel answers with {answer.status}: {answer.reason}")
            return
        raise Decided(Outcome(verdict, reason, made, values, tried=self.tried))


def decide(problem: Problem, seconds: float) -> Outcome:
    """Is the polynomial nonnegative on the set? Within so many seconds, or undecided."""
    return Decision(problem, Deadline(seconds)).run()
