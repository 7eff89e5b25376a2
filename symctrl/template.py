"""The study that `symctrl new` writes: a small one that verifies, to be changed into one's own."""

from __future__ import annotations

from keyword import iskeyword
from pathlib import Path

from symctrl.files import InputError, write

_TEMPLATE = '''\
"""A mass on a spring, damped by feedback: replace it by your own design."""
from symctrl import Study, equal

study = Study("{name}", source="own design")

x, v = study.state("x", unit="m"), study.state("v", unit="m/s")
m, s = study.parameter("m", "2", unit="kg"), study.parameter("s", "3", unit="N/m")
c = study.gain("c", "1/2")  # the equations say its unit
u = study.input("u", unit="N")
study.assume(m > 0, s > 0)

study.motion(x, v)
study.motion(v, (u - s * x) / m)


@study.law("law", u)
def damping():
    return -c * v


@study.definition("energy")
def E():
    return m * v**2 / 2 + s * x**2 / 2


@study.claimed("decay")
def energy_falls():
    """Along the closed loop the energy falls at the rate c v^2."""
    return equal(study.rate(E, damping), -c * v**2)
'''


def new(name: str, folder: Path) -> Path:
    """Write NAME.py into `folder`. Raises InputError for a name that is none, or where the file exists."""
    if not name.isidentifier() or iskeyword(name) or not name.isascii():
        raise InputError(f"{name!r} must be a Python name: letters, digits and _, not beginning with a digit")
    path = folder / f"{name}.py"
    if path.exists():
        raise InputError(f"{path} is there already; nothing was written")
    try:
        write(path, _TEMPLATE.format(name=name))
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror}") from None
    return path
