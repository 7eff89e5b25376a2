"""That a quantity stays apart from zero: as a constant, as a multiple, above another's square."""

from __future__ import annotations

from symctrl.rules.algebra import algebra
from symctrl.rules.chain import Chain
from symctrl.rules.constants import constant_quotient
from symctrl.rules.quantities import claimed


def stays_apart(chain: Chain, name: str) -> bool:
    """As a constant, as a constant multiple of what stays apart, or above its square."""
    if chain.at.is_constant(name):
        return chain.attempt("carries", {"word": "apart", "how": "constant", "e": name})
    return any(
        _apart_with(chain, name, z) for z in _apart(chain) if z != name and not chain.at.is_constant(z)
    )


def _apart(chain: Chain) -> list[str]:
    """What is supposed or known to stay apart from zero."""
    suppose = chain.loop.statement.claim.suppose
    supposed = [claimed(chain, k) for sentence in suppose if sentence.word == "apart" for k in sentence.of]
    return list(dict.fromkeys([*supposed, *chain.having("apart")]))


def _apart_with(chain: Chain, name: str, z: str) -> bool:
    """As a multiple of z, or with a square above that of z."""
    table = {"word": "apart", "e": name, "by": z}
    factor = algebra(chain, [name, z], constant_quotient, relations=True)
    if factor is not None and chain.attempt("carries", table | {"how": "multiple", "times": chain.q(factor)}):
        return True
    return chain.attempt("carries", table | {"how": "above"})
