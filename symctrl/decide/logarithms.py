"""Signs of logarithms: log a has that of a - 1, which is shown first, as a lemma."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from symctrl.decide.session import Session
from symctrl.domains.beside import carrier
from symctrl.domains.field import Exact, Poly

Entry = dict[str, Any]


def by_logarithms(
    session: Session, p: Poly, prove: Callable[[Exact], Entry | None], then: Callable[[], Entry | None]
) -> Entry | None:
    """The entry of p after lemmas about the arguments of its logarithms; None where there is none."""
    field, signs = session.domain.field, session.domain.signs
    lemmas: list[list[Any]] = []
    for k in sorted(field.occurring(p)) if not p.is_zero() else ():
        g = field.generators[k]
        if g.kind != "function" or g.name != "log" or k in session.told:
            continue
        session.told.add(k)
        above = field.normal(carrier(field, g.argument[0], less=1))
        for q in (above, -above):
            if signs.of(q) in ("positive", "nonnegative"):
                continue
            shown = prove(session.domain.polynomial(q))
            if shown is not None:
                lemmas.append(["nonnegative", field.json(q), shown])
                signs.learn(q, "nonnegative")
                break
    found = then() if lemmas else None
    return None if found is None else {"lemmas": lemmas, "then": found}
