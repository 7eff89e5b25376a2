"""The rate of V: (5), its form along the closed loop, and (6) to (10)."""

from derivations.liang2016_formation.control import V, V_i, control, e, s, stiffness, tau
from derivations.liang2016_formation.model import A, Q, dq
from derivations.liang2016_formation.symbols import K_o, K_q, K_v, beta, fleet, omega, q, study, u_d
from symctrl import conforms, equal
from symctrl.statements import nonzero, positive
from symctrl.vectors import absolute, det, diagonal, eye, inverse, kron, sgn, stack

i, j = fleet.node, fleet.neighbour
K_p = study.undefined("K_p")


def de(i, j):
    return dq(i) - dq(j)


@study.definition("in (7)")
def d(i):
    """The disturbance as it enters the acceleration of q."""
    return inverse(A(i)) @ Q(i).T @ u_d[i]


@study.claimed("before (5)")
def A_is_invertible(i):
    """The determinant of A is positive."""
    return positive(det(A(i)))


@study.claimed("before (4)")
def Q_is_invertible(i):
    """The determinant of Q is not zero."""
    return nonzero(det(Q(i)))


@study.claimed("after (1)")
def omega_from_rate(i):
    """The angular velocity is Q times the rate of the vector part."""
    return equal(omega[i], Q(i) @ dq(i))


@study.claimed("after (1)")
def rate_of_scalar_part(i):
    """The norm stays one: q0 times the rate of q0 is -q'dq."""
    return equal(study.rate(q[i].scalar), -q[i].vector.T @ dq(i) / q[i].scalar)


@study.printed("(5)", using=[A_is_invertible])
def rate_of_V_i(i):
    """The rate of V_i before the dynamics are put in."""
    first = stiffness() / 2 * fleet.sum(j, e(i, j).T @ de(i, j))
    second = (dq(i) + beta * s(i)).T @ inverse(A(i)) @ A(i) @ study.rate(dq(i))
    return equal(study.rate(V_i(i)), first + second + beta * fleet.sum(j, de(i, j).T @ dq(i)))


@study.printed("before (6)")
def closed_loop(i):
    """Along the closed loop ddq = -K_o dq - K_q s - K_v sgn(tau) + A^-1 Q'u_d."""
    return equal(study.rate(dq(i), control), -K_o * dq(i) - K_q * s(i) - K_v * sgn(tau(i)) + d(i))


@study.corrected(closed_loop, why="The law cancels the dynamics only with the corrected B in it.")
def closed_loop_corrected(i):
    """Along the closed loop ddq = -K_o dq - K_q s - K_v sgn(tau) + A^-1 Q'u_d."""
    return equal(study.rate(dq(i), control), -K_o * dq(i) - K_q * s(i) - K_v * sgn(tau(i)) + d(i))


def rate_terms(i, gain, switching):
    """The terms of the rate of V_i along the closed loop, the last one given."""
    return (
        stiffness() / 2 * fleet.sum(j, e(i, j).T @ de(i, j))
        + beta * fleet.sum(j, de(i, j).T @ dq(i))
        - (gain + beta * K_o) * dq(i).T @ s(i)
        - K_o * dq(i).T @ dq(i)
        - beta * gain * s(i).T @ s(i)
        - switching
    )


def switching_printed(i):
    return (K_v - d(i)).T @ absolute(tau(i))


def switching_by_component(i):
    return (K_v * stack(1, 1, 1) - d(i)).T @ absolute(tau(i))


def switching_corrected(i):
    return (K_v * stack(1, 1, 1)).T @ absolute(tau(i)) - d(i).T @ tau(i)


@study.printed(
    "after (5)",
    readings={
        "as printed": (K_p, switching_printed),
        "K_p is K_q, K_v in each component": (K_q, switching_by_component),
    },
)
def rate_of_V_i_closed(i, parts):
    """The rate of V_i along the closed loop."""
    gain, switching = parts
    return equal(study.rate(V_i(i), control), rate_terms(i, gain, switching(i)))


@study.corrected(
    rate_of_V_i_closed,
    using=[closed_loop_corrected],
    why="K_p is K_q, and the disturbance enters with tau, not with |tau|: its sign need not help.",
)
def rate_of_V_i_corrected(i):
    """The rate of V_i along the closed loop."""
    return equal(study.rate(V_i(i), control), rate_terms(i, K_q, switching_corrected(i)))


@study.printed("before (6)")
def both_directions():
    """Over both directions of every edge, the sum of (q_i - q_j)'(dq_i - dq_j) is that of 2 q_i'(dq_i -
    dq_j).
    """
    left = fleet.sum(i, fleet.sum(j, e(i, j).T @ de(i, j)))
    return equal(left, fleet.sum(i, 2 * q[i].vector.T @ fleet.sum(j, de(i, j))))


@study.printed("before (6)")
def both_directions_of_rates():
    """Over both directions of every edge, the sum of 2 q_i'(dq_i - dq_j) is that of 2 dq_i'(q_i - q_j)."""
    left = fleet.sum(i, 2 * q[i].vector.T @ fleet.sum(j, de(i, j)))
    return equal(left, fleet.sum(i, 2 * dq(i).T @ s(i)))


@study.definition("(7)")
def epsilon(i):
    return K_v - d(i)


@study.corrected(
    epsilon, why="K_v is a scalar and d a vector; component by component it is K_v - sgn(tau) d."
)
def epsilon_by_component(i):
    return K_v * stack(1, 1, 1) - diagonal(*sgn(tau(i))) @ d(i)


@study.definition("(9)")
def zeta(i):
    """The two parts of zeta that belong to craft i."""
    return stack(dq(i), s(i))


@study.definition("(10)")
def Pi():
    """The block of M, on the instance's graph, beside N."""
    return diagonal(M(), beta * K_q * eye(3 * fleet.size))


@study.definition("after (10)")
def M():
    return (K_o - beta) * eye(fleet.size) + "0.5" * beta * fleet.adjacency()


@study.corrected(
    M,
    why="The rate of V has K_o - m_i beta on the diagonal and beta beside it: M = K_o I - beta L.",
)
def M_corrected():
    return K_o * eye(fleet.size) - beta * fleet.laplacian()


def all_of_zeta():
    """A vector with the 6n components that zeta has for n craft."""
    return stack(*[dq(i)] * fleet.size, *[s(i)] * fleet.size)


@study.printed("(9), (10)")
def Pi_acts_on_zeta():
    """Pi, with the n x n matrix M and the 3n x 3n matrix N, acts on zeta, which has 6n components."""
    return conforms(Pi() @ all_of_zeta())


@study.corrected(Pi_acts_on_zeta, why="The rates of q_i are vectors, so that M (x) I_3 takes the place of M.")
def Pi_for_vectors_acts_on_zeta():
    """Pi with M (x) I_3 acts on zeta, which has 6n components."""
    whole = diagonal(kron(M(), eye(3)), beta * K_q * eye(3 * fleet.size))
    return conforms(whole @ all_of_zeta())


@study.printed(
    "after (10)",
    finding={
        "refuted": "Who checks K_o > beta, as the printed M suggests, checks too little: what counts is "
        "K_o > beta lambda_max(L), which grows with the number of neighbours."
    },
)
def M_is_that_of_the_rate():
    """M is the matrix of the rate of V in the rates dq_i, which (6) makes K_o I - beta L."""
    return equal(M(), K_o * eye(fleet.size) - beta * fleet.laplacian())


@study.corrected(M_is_that_of_the_rate, why="M has K_o - m_i beta on the diagonal and beta beside it.")
def M_corrected_is_that_of_the_rate():
    """M is the matrix of the rate of V in the rates dq_i: K_o I - beta times degrees, and beta beside it."""
    degrees = diagonal(*[row @ stack(*[1] * fleet.size) for row in _rows(fleet.adjacency())])
    return equal(M(), K_o * eye(fleet.size) - beta * degrees + beta * fleet.adjacency())


def _rows(matrix):
    return [matrix[k, :] for k in range(matrix.shape[0])]


def quadratic_form(i, own, coupling):
    """The part of craft i in zeta'Pi zeta, with M (x) I_3 in the place of M."""
    return own * dq(i).T @ dq(i) + coupling * dq(i).T @ fleet.sum(j, dq(j), at=i) + beta * K_q * s(i).T @ s(i)


@study.printed("(6)", reading="M stands for M (x) I_3; eps_i |tau_i| is a product of components")
def rate_of_V():
    """The rate of V is -zeta'Pi zeta less the sum of eps_i |tau_i|."""
    form = quadratic_form(i, K_o - beta, "0.5" * beta)
    return equal(study.rate(V, control), -fleet.sum(i, form) - fleet.sum(i, epsilon(i).T @ absolute(tau(i))))


@study.corrected(
    rate_of_V,
    using=[closed_loop_corrected],
    why="With M = K_o I - beta L and the disturbance beside tau the rate is as printed.",
)
def rate_of_V_corrected():
    """The rate of V is -zeta'Pi zeta less the sum of eps_i |tau_i|."""
    form = quadratic_form(i, K_o - fleet.degree(i) * beta, beta)
    return equal(study.rate(V, control), -fleet.sum(i, form) - fleet.sum(i, epsilon(i).T @ absolute(tau(i))))
