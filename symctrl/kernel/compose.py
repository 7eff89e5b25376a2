"""An obligation as a listing: the formula of a rule over quantities of an argument and their rates.

Soundness-critical. Last reviewed 2026-11-24.

Relies on no theorem: a formula in postfix notation ("w1 V' -" is w1 less the rate of V, "@x[1] 2 -" a state
less a number) is put together from the listings of the quantities, each of one output. Formulas belong to the
rules of the kernel; a certificate brings none.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from symctrl.kernel.values import Listing, Meaning, Step

MAX_RATES = 6
OPERATIONS = {
    "+": "ADD",
    "-": "SUB",
    "*": "MUL",
    "/": "DIV",
    "^": "POW",
    "neg": "NEG",
    "abs": "FABS",
    "log": "LOG",
}
UNARY = frozenset(("neg", "abs", "log"))


def composed(listings: Mapping[str, Listing], formulas: Sequence[str], roles: Mapping[str, str]) -> Listing:
    """The formulas as the outputs of one listing. roles: the listing of each name in them."""
    maker = _Maker(listings, roles)
    outputs = tuple(maker.formula(text) for text in formulas)
    return Listing(tuple(maker.code), outputs, "")


def rate_listing(quantity: str, order: int) -> str:
    return quantity + "'" * order


def rates_of(
    quantity: str, listing: Listing, law: str | None
) -> tuple[dict[str, Listing], dict[str, Meaning]]:
    """Listings and names of a quantity's rates up to MAX_RATES; one that speaks of two nodes has none."""
    listings: dict[str, Listing] = {}
    names: dict[str, Meaning] = {}
    if listing.letters - {"i"}:
        return listings, names
    for order in range(1, MAX_RATES + 1):
        scalar = f"rate{order}_{quantity}"
        names[f"{scalar}.*" if listing.letters else scalar] = Meaning(
            "rate", of=(rate_listing(quantity, order - 1), 0), law=law
        )
        step = Step("INPUT", name=f"{scalar}.i" if listing.letters else scalar)
        listings[rate_listing(quantity, order)] = Listing((step,), (0,), "")
    return listings, names


class _Maker:
    def __init__(self, listings: Mapping[str, Listing], roles: Mapping[str, str]) -> None:
        self.listings = listings
        self.roles = roles
        self.code: list[Step] = []
        self.at: dict[Step, int] = {}

    def formula(self, text: str) -> int:
        stack: list[int] = []
        for word in text.split():
            if word in OPERATIONS:
                count = 1 if word in UNARY else 2
                args = tuple(stack[-count:])
                del stack[-count:]
                stack.append(self.emit(Step(OPERATIONS[word], args)))
            elif word[0].isdigit():
                stack.append(self.emit(Step("CONST", value=Fraction(word))))
            elif word[0] == "@":
                stack.append(self.emit(Step("INPUT", name=word[1:])))
            else:
                name = word.rstrip("'")
                stack.append(self.inlined(rate_listing(self.roles[name], len(word) - len(name))))
        (result,) = stack
        return result

    def inlined(self, name: str) -> int:
        listing = self.listings[name]
        registers: list[int] = []
        for step in listing.code:
            args = tuple(registers[a] for a in step.args)
            registers.append(self.emit(Step(step.op, args, step.name, step.value)))
        return registers[listing.outputs[0]]

    def emit(self, step: Step) -> int:
        at = self.at.setdefault(step, len(self.code))
        if at == len(self.code):
            self.code.append(step)
        return at
