"""Section 2.2: the control law (4), the Lyapunov function and the matrix Theta."""

from derivations.liang2016_formation.model import A, B, Q, dq
from derivations.liang2016_formation.symbols import K_o, K_q, K_v, beta, fleet, q, study, u
from symctrl import equal
from symctrl.statements import equivalent, positive_definite, sufficiently_small
from symctrl.vectors import block, eye, inverse, kron, sgn

i, j = fleet.node, fleet.neighbour
m = study.gain("m", unit="1")  # number of neighbours of a craft, m_i in the paper


def e(i, j):
    """The difference of the vector parts of two neighbours."""
    return q[i].vector - q[j].vector


@study.definition("before (4)")
def s(i):
    return fleet.sum(j, e(i, j))


@study.definition("(8)")
def tau(i):
    return dq(i) + beta * s(i)


@study.law("(4)", u)
def control(i):
    inner = (B(i) - K_o * A(i)) @ dq(i) - K_q * A(i) @ s(i) - K_v * A(i) @ sgn(tau(i))
    return inverse(Q(i)).T @ inner


def stiffness():
    return K_q + beta * K_o


@study.definition("after theorem 1")
def V_i(i):
    """The part of one craft in the Lyapunov function."""
    pairs = fleet.sum(j, e(i, j).T @ e(i, j))
    return stiffness() / 4 * pairs + dq(i).T @ dq(i) / 2 + beta * fleet.sum(j, e(i, j).T @ dq(i))


@study.definition("after theorem 1")
def V():
    return fleet.sum(i, V_i(i))


def all_entries():
    return beta * (eye(3) * 0 + [[1, 1, 1], [1, 1, 1], [1, 1, 1]])


def diagonal_blocks():
    return beta * eye(3)


@study.printed(
    "before (5)",
    readings={"every entry of Omega is beta": all_entries, "Omega has the blocks beta I": diagonal_blocks},
)
def V_is_the_quadratic_form(i, omega_block):
    """V_i is the quadratic form of Theta_i in the rate of q_i and the differences to its neighbours."""
    corner = dq(i).T @ (eye(3) / 2) @ dq(i)
    border = fleet.sum(j, e(i, j).T @ (omega_block() / 2) @ dq(i))
    spokes = fleet.sum(j, e(i, j).T @ (stiffness() / 4 * eye(3)) @ e(i, j))
    return equal(V_i(i), corner + border + dq(i).T @ (omega_block().T / 2) @ fleet.sum(j, e(i, j)) + spokes)


def theta():
    """Theta_i = theta (x) I_3, reduced: with m equal spokes it is definite exactly where this 2 x 2 matrix
    is.

    The Schur complement of the spokes, 1/2 - m (beta/2) (4/(K_q + beta K_o)) (beta/2), is that of the lower
    entry.
    """
    return block([["1/2", beta / 2], [beta / 2, stiffness() / (4 * m)]])


@study.printed("before (5)")
def theta_definite_for_small_beta():
    """By the Schur complement Theta_i is positive definite when beta is small enough."""
    return sufficiently_small(beta, positive_definite(kron(theta(), eye(3))))


@study.claimed("before (5)")
def theta_definite_exactly():
    """Theta_i is positive definite exactly where K_q + beta K_o > 2 m_i beta^2, for a craft with m_i
    neighbours.
    """
    return equivalent(stiffness() - 2 * m * beta**2 > 0, positive_definite(kron(theta(), eye(3))))


@study.claimed("before (5)")
def V_in_squares():
    """V is a sum of squares of tau_i and of differences, less the squares of the sums of differences."""
    squares = tau(i).T @ tau(i) / 2 - beta**2 / 2 * s(i).T @ s(i)
    return equal(V(), fleet.sum(i, squares + stiffness() / 4 * fleet.sum(j, e(i, j).T @ e(i, j))))
