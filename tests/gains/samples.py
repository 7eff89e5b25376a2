"""Small studies with conditions on gains, and independent exact code that decides each of them at a point."""

from fractions import Fraction

import sympy

from symctrl import Study, claim, exponentially, positive_definite
from symctrl.gains.answer import gains
from symctrl.vectors import absolute, maximum, power, row, sqrt, stack

PRINCIPAL = [(0,), (1,), (2,), (0, 1), (0, 2), (1, 2), (0, 1, 2)]


def conditions(name, gains, *functions, fleet=None):
    """A study with these gains and one condition for each function of them."""
    study = Study(name)
    symbols = [study.gain(key, value) for key, value in gains.items()]
    if fleet is not None:
        study.fleet(default=fleet)
    for function in functions:
        study.condition("section 1")(_written(function, symbols))
    return study


def _written(function, symbols):
    def written():
        return function(*symbols)

    name = function.__name__ if function.__name__.isidentifier() else "asked"
    written.__name__, written.__doc__ = name, f"{name} holds."
    return written


def crossing():
    """Two boundaries that cross, a parabola and a hyperbola."""

    def below_the_parabola(a, b):
        return a**2 - b > 0

    def above_the_hyperbola(a, b):
        return a * b - 1 >= 0

    return conditions("crossing", {"a": "2", "b": "1"}, below_the_parabola, above_the_hyperbola)


def crossing_holds(a, b):
    return a > 0 and b > 0 and a * a > b and a * b >= 1


def rational():
    """A quotient whose divisor changes its sign within the map."""

    def quotient(a, b):
        return a / (b - 1) - 2 > 0

    return conditions("rational", {"a": "3", "b": "2"}, quotient)


def rational_holds(a, b):
    return a > 0 and b > 0 and b != 1 and a / (b - 1) > 2


def matrix():
    """A 3x3 matrix of products of gains."""

    def definite(a, b):
        return positive_definite(stack(row(a, a * b / 2, b), row(a * b / 2, 2, a / 3), row(b, a / 3, a * a)))

    return conditions("matrix", {"a": "2", "b": "1/2"}, definite)


def matrix_holds(a, b):
    """By the leading principal minors."""
    A = sympy.Matrix([[a, a * b / 2, b], [a * b / 2, 2, a / 3], [b, a / 3, a * a]])
    return a > 0 and b > 0 and all(A[:k, :k].det() > 0 for k in (1, 2, 3))


def kinks():
    """Absolute values, maxima and a root."""

    def kinked(a, b):
        return maximum(a, b) - absolute(a - 2 * b) > 0

    def rooted(a, b):
        return sqrt(a) - b >= 0

    return conditions("kinks", {"a": "2", "b": "1"}, kinked, rooted)


def kinks_holds(a, b):
    return a > 0 and b > 0 and max(a, b) - abs(a - 2 * b) > 0 and a >= b * b


def powers():
    """Whole powers, a negative one and one of a half."""

    def powered(a, b):
        return power(a, 3) - power(b, -2) + power(b, "3/2") - 3 >= 0

    return conditions("powers", {"a": "2", "b": "1"}, powered)


def powers_holds(a, b):
    """b^(3/2) >= c exactly if c <= 0 or b^3 >= c^2."""
    if a <= 0 or b <= 0:
        return False
    c = 3 + 1 / b**2 - a**3
    return c <= 0 or b**3 >= c * c


def formation(graph="ring:6"):
    """A condition on every eigenvalue of the Laplacian, and one on the number of neighbours."""
    study = Study("formation")
    k, beta = study.gain("k", "2"), study.gain("beta", "3/10")
    fleet = study.fleet(default=graph)

    @study.condition("(1)")
    def stiff():
        """The stiffness exceeds the coupling."""
        return k - beta * fleet.eigenvalue > 0

    @study.condition("(2)")
    def damped(i):
        """Every craft is damped."""
        return k * k - beta * fleet.degree(i) >= 0

    return study


def decaying():
    """A loop that decays at the rate a + b, if b stays below a^2."""
    study = Study("decaying")
    x, u = study.state("x"), study.input("u")
    a, b = study.gain("a", "2"), study.gain("b", "1")
    study.motion(x, -a * x + u)

    @study.law("law", u)
    def feedback():
        return -b * x

    @study.claimed("theorem")
    def decay():
        """x decays exponentially."""
        return claim(given=[b <= a**2, a + b <= 4], then=[exponentially(x, rate=a + b)])

    @study.argument(decay)
    def by_comparison(run):
        run.decays(x**2, a=2 * (a + b))
        run.exponentially(x, by=x**2, least=1)

    return study


def answered(study, *sweeps, **options):
    return gains(study, sweeps, **options)


def corners(axes):
    """The exact edges of each axis, written here and not taken from the library."""
    return [
        [axis.lo + (axis.hi - axis.lo) * Fraction(k, axis.count) for k in range(axis.count + 1)]
        for axis in axes
    ]
