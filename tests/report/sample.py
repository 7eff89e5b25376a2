"""A small study with one of each: proved, refuted, ill-formed, corrected, readings, theorems, an angle."""

from __future__ import annotations

from functools import cache

from symctrl import Study, claim, equal, exists, nonnegative, tends
from symctrl.report import build
from symctrl.rows import Report
from symctrl.vectors import cos, eye
from symctrl.verify import verify


@cache
def study() -> Study:
    made = Study("spring", source="A textbook <with> signs & such, 1999")
    made.numbered("(1)-(4)", "theorem 1")
    x, v = made.state("x", unit="m"), made.state("v", unit="m/s")
    y = made.state("y", 3)
    m, s, c = made.gain("m", "2", unit="kg"), made.gain("s", "1/3", unit="N/m"), made.gain("c")
    u = made.input("u", unit="N")
    made.motion(x, v)
    made.motion(v, (u - s * x) / m)

    @made.law("(1)", u)
    def damping():
        return -c * v

    @made.definition("(2)")
    def E():
        return m * v**2 / 2 + s * x**2

    @made.corrected(E, why="The energy of the spring has a half, too.")
    def E_halved():
        return m * v**2 / 2 + s * x**2 / 2

    @made.printed("(3)", finding={"refuted": "The printed energy with K_o does not fall at this rate."})
    def energy_rate():
        """E falls at the rate c v^2."""
        return equal(made.rate(E, damping), -c * v**2)

    @made.corrected(energy_rate, why="With the corrected energy it does.")
    def energy_rate_corrected():
        """E falls at the rate c v^2."""
        return equal(made.rate(E, damping), -c * v**2)

    @made.printed("after (3)", readings={"half": lambda e: e / 2, "whole": lambda e: e})
    def square(read):
        """v^2 is the square of the speed."""
        return equal(read(v * v), v**2)

    @made.printed("after (3)")
    def mixed():
        """A matrix is a vector."""
        return equal(eye(3), y)

    @made.printed("(4)", finding={"refuted": "Cosines are negative, too."})
    def cosine():
        """The cosine is not negative."""
        return nonnegative(cos(c))

    z = made.state("z", system="theorem")
    made.motion(z, -z)

    @made.printed("theorem 1")
    def vanishes():
        """z tends to zero."""
        return claim(then=[tends(z)])

    @made.argument(vanishes)
    def by_barbalat(run):
        run.falls(z**2 / 2, by=z**2)
        run.barbalat(z, of=z**2)

    w = made.state("w", system="false")
    made.motion(w, w)

    @made.printed("theorem 2", finding={"refuted": "What grows does not vanish."})
    def grows():
        """w tends to zero."""
        return claim(then=[exists(), tends(w)])

    @made.argument(grows)
    def in_vain(run):
        run.falls(w**2 / 2, by=w**2)

    return made


@cache
def report() -> Report:
    return verify(study())


@cache
def page():
    return build.page(report(), study(), "spring.py", "A spring & its damper")
