"""symctrl: machine-checked verdicts on the claims of control papers, from one CasADi expression graph.

The author's side: `Study` and its decorators, `equal` and the other statements, the functions of vectors.
What is heavy is loaded when it is first used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from symctrl.counterexample import along as along
    from symctrl.counterexample import at as at
    from symctrl.counterexample import leaves as leaves
    from symctrl.counterexample import undefined as undefined
    from symctrl.counterexample import unstable as unstable
    from symctrl.facts import apart as apart
    from symctrl.facts import bounded as bounded
    from symctrl.facts import enters as enters
    from symctrl.facts import eventually as eventually
    from symctrl.facts import exists as exists
    from symctrl.facts import exponentially as exponentially
    from symctrl.facts import settles as settles
    from symctrl.facts import stable as stable
    from symctrl.facts import stays as stays
    from symctrl.facts import summable as summable
    from symctrl.facts import tends as tends
    from symctrl.statements import at_values as at_values
    from symctrl.statements import conforms as conforms
    from symctrl.statements import equal as equal
    from symctrl.statements import equivalent as equivalent
    from symctrl.statements import implies as implies
    from symctrl.statements import nonnegative as nonnegative
    from symctrl.statements import nonzero as nonzero
    from symctrl.statements import positive as positive
    from symctrl.statements import positive_definite as positive_definite
    from symctrl.statements import positive_semidefinite as positive_semidefinite
    from symctrl.statements import skew_symmetric as skew_symmetric
    from symctrl.statements import sufficiently_small as sufficiently_small
    from symctrl.statements import symmetric as symmetric
    from symctrl.study import Study as Study
    from symctrl.theorem import along_trajectory as along_trajectory
    from symctrl.theorem import claim as claim
    from symctrl.theorem import initially as initially

_HOME = {
    "along": "symctrl.counterexample",
    "at": "symctrl.counterexample",
    "leaves": "symctrl.counterexample",
    "undefined": "symctrl.counterexample",
    "unstable": "symctrl.counterexample",
    "apart": "symctrl.facts",
    "bounded": "symctrl.facts",
    "enters": "symctrl.facts",
    "eventually": "symctrl.facts",
    "exists": "symctrl.facts",
    "exponentially": "symctrl.facts",
    "settles": "symctrl.facts",
    "stable": "symctrl.facts",
    "stays": "symctrl.facts",
    "summable": "symctrl.facts",
    "tends": "symctrl.facts",
    "at_values": "symctrl.statements",
    "conforms": "symctrl.statements",
    "equal": "symctrl.statements",
    "equivalent": "symctrl.statements",
    "implies": "symctrl.statements",
    "nonnegative": "symctrl.statements",
    "nonzero": "symctrl.statements",
    "positive": "symctrl.statements",
    "positive_definite": "symctrl.statements",
    "positive_semidefinite": "symctrl.statements",
    "skew_symmetric": "symctrl.statements",
    "sufficiently_small": "symctrl.statements",
    "symmetric": "symctrl.statements",
    "Study": "symctrl.study",
    "along_trajectory": "symctrl.theorem",
    "claim": "symctrl.theorem",
    "initially": "symctrl.theorem",
}
__all__ = sorted(_HOME)  # noqa: PLE0605


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"symctrl has no {name}; it has {', '.join(__all__)}")
    return getattr(import_module(_HOME[name]), name)
