"""Section 3: inertias, table 1, disturbance model and gains, as the paper prints them."""

from fractions import Fraction

from derivations.liang2016_formation.symbols import alpha, fleet, study, u_bar
from symctrl import at_values, nonnegative, positive, positive_definite
from symctrl.expr import lift
from symctrl.spectral.matrix import largest_eigenvalue
from symctrl.statements import positive_semidefinite
from symctrl.vectors import diagonal, eye, skew, stack

i = fleet.node

INERTIAS = [
    [["50", "0", "4"], ["0", "55", "0"], ["4", "0", "60"]],
    [["52", "1", "0.5"], ["1", "54", "3"], ["0.5", "3", "62"]],
    [["53", "0.4", "0"], ["0.4", "54", "0.8"], ["0", "0.8", "58"]],
    [["55", "0.8", "2"], ["0.8", "59", "1"], ["2", "1", "61"]],
    [["58", "0.4", "0"], ["0.4", "57", "0.6"], ["0", "0.6", "59"]],
    [["52", "0.2", "0.3"], ["0.2", "59", "0"], ["0.3", "0", "58"]],
    [["61", "2", "0.3"], ["2", "54", "0.2"], ["0.3", "0.2", "60"]],
    [["51", "0.2", "1"], ["0.2", "56", "0.2"], ["1", "0.2", "60"]],
]

# Table 1: angular velocity in rad/s, vector part of the attitude.
INITIAL = [
    (["0.85", "-0.43", "0.77"], ["0.1", "0.4", "-0.3"]),
    (["0.52", "-0.26", "0.33"], ["0.3", "0.2", "0.3"]),
    (["-0.26", "0.22", "-0.13"], ["-0.2", "0.1", "-0.1"]),
    (["0.45", "0.33", "-0.57"], ["-0.4", "0.2", "-0.1"]),
    (["-0.15", "0.62", "-0.41"], ["0.3", "-0.5", "0.1"]),
    (["-0.76", "0.12", "-0.37"], ["0.2", "0.2", "-0.3"]),
    (["0.34", "-0.53", "0.62"], ["-0.1", "-0.5", "0.5"]),
    (["0.15", "-0.44", "-0.32"], ["-0.3", "0.2", "0.6"]),
]

# Not in the paper: the Earth's gravitational parameter and equatorial radius; its altitude is 400 km.
MU, RADIUS = Fraction("3.986004418e14"), Fraction("6378137") + 400000


@study.printed("section 3")
def inertias_are_definite():
    """The inertia matrices of the eight craft are positive definite."""
    return [positive_definite(lift(rows)) for rows in INERTIAS]


@study.claimed("section 3")
def inertias_are_physical():
    """The inertias are those of rigid bodies: the trace is at least twice the largest moment of inertia."""
    return [positive_semidefinite(_trace(rows) * eye(3) - 2 * lift(rows)) for rows in INERTIAS]


@study.printed("table 1")
def initial_attitudes():
    """The vector parts in table 1 are those of unit quaternions."""
    return [nonnegative(1 - lift(q).T @ lift(q)) for _, q in INITIAL]


mu = study.gain("mu", unit="m^3/s^2")
R = study.parameter("R", shape=(3, 1), unit="m")
J_g = study.inertia("J_g")
alpha_g = study.gain("alpha_g", unit="kg*m^2")  # alpha_max of the inertia, or more
study.assume(positive_semidefinite(alpha_g * eye(3) - J_g))


@study.printed(
    "section 3",
    reading="the torque of the text times |R|^5 / (3 mu), each component, is at most alpha_max |R|^2",
)
def gravity_gradient_bound():
    """No component of R x J R exceeds alpha_max(J) |R|^2, as the disturbance in section 3 takes it."""
    claims = []
    for k in range(3):
        axis = [1 if n == k else 0 for n in range(3)]
        turned = skew(stack(*axis)) @ R  # (R x J R)_k = -turned'J R
        torque = (skew(R) @ J_g @ R)[k]
        forms = [
            (J_g, R + turned),
            (J_g, R - turned),
            (alpha_g * eye(3) - J_g, R),
            (alpha_g * eye(3) - J_g, turned),
        ]
        for side in (torque, -torque):
            claims.append(nonnegative(alpha_g * R.T @ R - side).by(forms=forms))
    return claims


@study.printed("section 3", reading="gravitational parameter and radius of the Earth are not in the text")
def K_v_at_the_data():
    """K_v = 0.01 exceeds u_bar alpha_max of the inverse of J for each craft, with the text's disturbance."""
    return [positive(Fraction("0.01") - _disturbance(rows) * _inverse_bound(rows)) for rows in INERTIAS]


@study.claimed("section 3")
def alpha_at_the_data():
    """alpha is at least the largest eigenvalue of the inverse of each inertia."""
    return at_values(positive_semidefinite(diagonal(*(alpha * lift(rows) - eye(3) for rows in INERTIAS))))


@study.claimed("section 3")
def u_bar_at_the_data():
    """u_bar is at least the text's disturbance for each craft."""
    return [at_values(nonnegative(u_bar - _disturbance(rows))) for rows in INERTIAS]


def _trace(rows):
    return sum(Fraction(rows[k][k]) for k in range(3))


def _exact(rows):
    return [[Fraction(x) for x in row] for row in rows]


def _disturbance(rows):
    """A bound of a component of u_d: 6/5 of alpha_max(J) 30 mu / |R|^3."""
    largest = largest_eigenvalue(_exact(rows)).high
    return Fraction(6, 5) * largest * 30 * MU / RADIUS**3


def _inverse_bound(rows):
    """A bound of alpha_max of the inverse of J: one over a lower bound of the smallest eigenvalue."""
    return 1 / -largest_eigenvalue([[-x for x in row] for row in _exact(rows)]).high
