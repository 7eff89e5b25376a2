"""Small textbook studies with a factor on each addend, and which claims each factor decides.

A study is built from factors that are all 1 in the textbook; with any other value of one factor exactly the
claims named beside it are false.
"""

from fractions import Fraction

from symctrl import Study, equal
from symctrl.vectors import absolute, cross, inverse, sgn, stack

ONE = Fraction(1)


def quaternion_feedback(
    spin=ONE, turn=ONE, gyro=ONE, stiff=ONE, damp=ONE, kinetic=ONE, potential=ONE, fall=ONE
):
    """A rigid body under quaternion feedback, where |q| = 1 takes a part."""
    study = Study("quaternion_feedback")
    q, omega = study.unit_quaternion("q"), study.state("omega", 3)
    J, k, c = study.inertia("J"), study.gain("k"), study.gain("c")
    u = study.input("u", 3)
    study.motion(q, stack(spin * q.scalar * omega + cross(q.vector, omega), -turn * q.vector.T @ omega) / 2)
    study.motion(omega, inverse(J) @ (u - gyro * cross(omega, J @ omega)))

    @study.law("law", u)
    def feedback():
        return -stiff * k * q.vector - damp * c * omega

    @study.definition("V")
    def V():
        return kinetic * omega.T @ J @ omega / 2 + potential * k * (
            q.vector.T @ q.vector + (1 - q.scalar) ** 2
        )

    @study.claimed("1")
    def norm_is_kept():
        """The norm of q is kept."""
        return equal(study.rate(q.vector.T @ q.vector + q.scalar**2), 0)

    @study.claimed("2")
    def euler():
        """Euler's equation."""
        return equal(J @ study.rate(omega), u - cross(omega, J @ omega))

    @study.claimed("3")
    def energy_rate():
        """V falls at the rate c |omega|^2."""
        return equal(study.rate(V, feedback), -fall * c * omega.T @ omega)

    return study


def sliding_surface(slope=ONE, push=ONE, brake=ONE, switch=ONE, hit=ONE, gain=ONE):
    """A double integrator on a sliding surface, with a switch and a disturbance."""
    study = Study("sliding_surface")
    x, v = study.state("x"), study.state("v")
    lam, K = study.gain("lam"), study.gain("K")
    u, d = study.input("u"), study.disturbance("d")
    study.motion(x, v)
    study.motion(v, u + push * d)

    @study.definition("s")
    def s():
        return slope * lam * x + v

    @study.law("law", u)
    def switching():
        return -brake * lam * v - switch * K * sgn(s())

    @study.claimed("1")
    def reaching():
        """The square of s falls by K |s| but for the disturbance."""
        return equal(study.rate(s() ** 2 / 2, switching), hit * s() * d - gain * K * absolute(s()))

    @study.claimed("2")
    def on_the_surface():
        """The law has no gradient across the surface but the switch."""
        return equal(study.rate(v, switching) + lam * v - d, -K * sgn(s()))

    return study


def adaptive_loop(plant=ONE, estimate=ONE, feedback=ONE, update=ONE, state=ONE, error=ONE, fall=ONE):
    """A scalar plant whose pole is estimated."""
    study = Study("adaptive_loop")
    x, hat = study.state("x"), study.state("hat")
    a, k, gamma = study.parameter("a"), study.gain("k"), study.gain("gamma")
    u = study.input("u")
    study.motion(x, plant * a * x + u)
    study.motion(hat, update * gamma * x**2)

    @study.law("law", u)
    def certainty_equivalence():
        return -estimate * hat * x - feedback * k * x

    @study.definition("V")
    def V():
        return state * x**2 / 2 + error * (hat - a) ** 2 / (2 * gamma)

    @study.claimed("1")
    def closed_loop():
        """The loop with the error of the estimate."""
        return equal(study.rate(x, certainty_equivalence), (a - hat - k) * x)

    @study.claimed("2")
    def energy_rate():
        """V falls at the rate k x^2."""
        return equal(study.rate(V, certainty_equivalence), -fall * k * x**2)

    return study


def consensus(strength=ONE, own=ONE, others=ONE, size=ONE, fall=ONE):
    """Single integrators that go where their neighbours are, on two nodes or any other graph."""
    study = Study("consensus")
    fleet = study.fleet(default="path:2")
    i, j = fleet.node, fleet.neighbour
    x, u = fleet.state("x"), fleet.input("u")
    k = study.gain("k")
    fleet.motion(x, lambda i: u[i])

    @study.law("law", u)
    def protocol(i):
        return -strength * k * fleet.sum(j, own * x[i] - others * x[j])

    @study.definition("V")
    def V():
        return fleet.sum(i, size * x[i] ** 2 / 2)

    @study.claimed("1")
    def the_sum_is_kept():
        """The sum of all states is kept."""
        return equal(study.rate(fleet.sum(i, x[i]), protocol), 0)

    @study.claimed("2")
    def disagreements_count():
        """V falls by all disagreements, each edge counted from both ends."""
        return equal(study.rate(V, protocol), -fall * k / 2 * fleet.sum(i, fleet.sum(j, (x[i] - x[j]) ** 2)))

    return study


# For each factor the claims that hold only where it is 1.
STUDIES = {
    quaternion_feedback: {
        "spin": {"norm_is_kept", "energy_rate"},
        "turn": {"norm_is_kept", "energy_rate"},
        "gyro": {"euler"},
        "stiff": {"energy_rate"},
        "damp": {"energy_rate"},
        "kinetic": {"energy_rate"},
        "potential": {"energy_rate"},
        "fall": {"energy_rate"},
    },
    sliding_surface: {
        "slope": {"reaching"},
        "push": {"reaching", "on_the_surface"},
        "brake": {"reaching", "on_the_surface"},
        "switch": {"reaching", "on_the_surface"},
        "hit": {"reaching"},
        "gain": {"reaching"},
    },
    adaptive_loop: {
        "plant": {"closed_loop", "energy_rate"},
        "estimate": {"closed_loop", "energy_rate"},
        "feedback": {"closed_loop", "energy_rate"},
        "update": {"energy_rate"},
        "state": {"energy_rate"},
        "error": {"energy_rate"},
        "fall": {"energy_rate"},
    },
    consensus: {
        "strength": {"disagreements_count"},
        "own": {"the_sum_is_kept", "disagreements_count"},
        "others": {"the_sum_is_kept", "disagreements_count"},
        "size": {"disagreements_count"},
        "fall": {"disagreements_count"},
    },
}
