"""symctrl: machine-checked verdicts on the claims of control papers, from one CasADi expression graph.

The author's side: `Study` and its decorators, `equal` and the other statements, the functions of vectors.
What is heavy is loaded when it is first used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from symctrl.statements import (
        at_values as at_values,
    )
    from symctrl.statements import (
        conforms as conforms,
    )
    from symctrl.statements import (
        equal as equal,
    )
    from symctrl.statements import (
        equivalent as equivalent,
    )
    from symctrl.statements import (
        implies as implies,
    )
    from symctrl.statements import (
        nonnegative as nonnegative,
    )
    from symctrl.statements import (
        nonzero as nonzero,
    )
    from symctrl.statements import (
        positive as positive,
    )
    from symctrl.statements import (
        positive_definite as positive_definite,
    )
    from symctrl.statements import (
        positive_semidefinite as positive_semidefinite,
    )
    from symctrl.statements import (
        skew_symmetric as skew_symmetric,
    )
    from symctrl.statements import (
        sufficiently_small as sufficiently_small,
    )
    from symctrl.statements import (
        symmetric as symmetric,
    )
    from symctrl.study import Study as Study

_HOME = {"Study": "symctrl.study"} | dict.fromkeys(
    [
        "at_values",
        "conforms",
        "equal",
        "equivalent",
        "implies",
        "nonnegative",
        "nonzero",
        "positive",
        "positive_definite",
        "positive_semidefinite",
        "skew_symmetric",
        "sufficiently_small",
        "symmetric",
    ],
    "symctrl.statements",
)
__all__ = sorted(_HOME)  # noqa: PLE0605


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"symctrl has no {name}; it has {', '.join(__all__)}")
    return getattr(import_module(_HOME[name]), name)
