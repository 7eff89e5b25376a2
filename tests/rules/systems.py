"""Closed loops for tests of counterexamples."""

from symctrl import Study
from symctrl.vectors import absolute, inverse, sgn, signed_power, sin, skew, sqrt


def duffing():
    study = Study("duffing")
    x, v = study.state("x"), study.state("v")
    study.motion(x, v)
    study.motion(v, x - x**3 - v)
    return study, x, v


def oscillator():
    study = Study("oscillator")
    x, v, k = study.state("x"), study.state("v"), study.gain("k")
    study.motion(x, v)
    study.motion(v, -k * x)
    return study, x, v, k


def scalar(rate, name="scalar"):
    """x' = rate(x)."""
    study = Study(name)
    x = study.state("x")
    study.motion(x, rate(x))
    return study, x


def friction(push=lambda x, v: -x - v):
    """A mass with dry friction."""
    study = Study("friction")
    x, v = study.state("x"), study.state("v")
    study.motion(x, v)
    study.motion(v, push(x, v) - 2 * sgn(v))
    return study, x, v


def disturbed():
    study = Study("disturbed")
    x, D = study.state("x"), study.gain("D")
    w = study.disturbance("w", bound=D)
    study.motion(x, -x + w)
    return study, x, w, D


def quotient():
    study = Study("quotient")
    x, y, a = study.state("x"), study.state("y"), study.parameter("a")
    study.assume(a > 1)
    study.motion(x, -x / (y - a) + sqrt(y + 9))
    study.motion(y, -y)
    return study, x, y, a


def pendulum():
    """From the upright position."""
    study = Study("pendulum")
    x, v, c = study.state("x"), study.state("v"), study.gain("c", "1/2")
    study.motion(x, v)
    study.motion(v, sin(x) - c * v)
    return study, x, v


def attitude():
    study = Study("attitude")
    q, omega = study.unit_quaternion("q"), study.state("omega", 3)
    J = study.inertia("J", [["22.7", "0.3", "-0.2"], ["0.3", "23.5", "0.5"], ["-0.2", "0.5", "24.6"]])
    k, c, u = study.gain("k", "2"), study.gain("c"), study.input("u", 3)
    study.motion(q.vector, (q.scalar * omega + skew(q.vector) @ omega) / 2)
    study.motion(q.scalar, -q.vector.T @ omega / 2)
    study.motion(omega, inverse(J) @ (-skew(omega) @ J @ omega + u))

    @study.law("law", u)
    def feedback():
        return -k * q.vector - c * omega

    return study, q, omega


def reaching():
    """A sliding surface with a root beside the switch."""
    study = Study("reaching")
    x, v = study.state("x"), study.state("v")
    s = v + x
    study.motion(x, v)
    study.motion(v, -v - signed_power(s, "1/2") - sgn(s) + absolute(s))
    return study, x, v


def consensus():
    """Each node goes to the mean of its neighbours."""
    study = Study("consensus")
    fleet = study.fleet("G")
    i, j = fleet.node, fleet.neighbour
    y, k = fleet.state("y"), study.gain("k", "1")
    fleet.motion(y, lambda n: k * fleet.sum(j, y[j] - y[i], at=n))
    return study, fleet, y, i
