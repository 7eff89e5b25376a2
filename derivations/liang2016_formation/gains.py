"""The gains: when Pi and V are definite, on which graphs, and what K_v must be."""

from derivations.liang2016_formation.control import stiffness
from derivations.liang2016_formation.model import q_cross
from derivations.liang2016_formation.rate import d
from derivations.liang2016_formation.symbols import (
    J_0,
    J,
    K_o,
    K_q,
    K_v,
    alpha,
    beta,
    fleet,
    q,
    study,
    u_bar,
    u_d,
)
from symctrl import (
    at_values,
    equal,
    implies,
    nonnegative,
    positive_definite,
    positive_semidefinite,
    sufficiently_small,
)
from symctrl.graphs import parse
from symctrl.vectors import diagonal, eye, inverse, kron, skew, sqrt, stack, tanh

i = fleet.node

GRAPHS = {spec: parse(spec) for spec in ("ring:8", "path:8", "star:8", "complete:8")}


def Pi_of(graph):
    """Pi with M (x) I_3 and the corrected M = K_o I - beta L of a graph."""
    n = len(graph)
    return diagonal(kron(K_o * eye(n) - beta * fleet.laplacian(graph), eye(3)), beta * K_q * eye(3 * n))


@study.printed("after (10)", reading="K_o and K_q much larger than beta: beta is small enough")
def Pi_definite_for_small_beta():
    """If K_o and K_q are much larger than beta, Pi is positive definite."""
    return sufficiently_small(beta, positive_definite(Pi_of(fleet.graph)))


@study.printed(
    "section 3",
    readings=GRAPHS,
    finding={
        "refuted": "With the paper's gains the proof does not cover this formation: beta lambda_max(L) "
        "exceeds K_o, and K_o must grow or beta shrink before these gains are used on it."
    },
)
def Pi_definite_at_the_gains(graph):
    """With the paper's gains Pi is positive definite."""
    return at_values(positive_definite(Pi_of(graph)))


@study.claimed("section 3", readings=GRAPHS)
def Pi_definite_exactly(graph):
    """Pi is positive definite if K_o exceeds beta times an upper bound of the graph's largest eigenvalue."""
    upper = fleet.largest_eigenvalue(graph).high
    return implies(K_o > upper * beta, positive_definite(Pi_of(graph)))


@study.claimed("section 3", readings=GRAPHS)
def Pi_not_definite_below(graph):
    """If K_o is at most beta times a lower bound of the largest eigenvalue, a vector x has x'Mx <= 0."""
    bound = fleet.largest_eigenvalue(graph)
    x = stack(*bound.vector)
    M = K_o * eye(len(graph)) - beta * fleet.laplacian(graph)
    return implies(K_o <= bound.low * beta, nonnegative(-x.T @ M @ x))


@study.claimed("before (5)", readings=GRAPHS)
def V_nonnegative_if(graph):
    """V is nonnegative if K_q + beta K_o is at least beta^2 times a bound of the largest eigenvalue."""
    upper = fleet.largest_eigenvalue(graph).high
    incidence = fleet.incidence(graph)
    edges = incidence.T @ incidence
    return implies(
        stiffness() >= upper * beta**2,
        positive_semidefinite(stiffness() * eye(edges.shape[0]) - beta**2 * edges),
    )


@study.condition("after (10)")
def Pi_is_definite():
    """Pi is positive definite."""
    return [K_o - beta * fleet.eigenvalue > 0, beta * K_q > 0]


@study.condition("before (5)")
def Theta_is_definite(i):
    """Theta_i is positive definite for every craft."""
    return stiffness() - 2 * fleet.degree(i) * beta**2 > 0


@study.condition("before (5)")
def V_is_nonnegative():
    """V is nonnegative."""
    return stiffness() - beta**2 * fleet.eigenvalue >= 0


@study.claimed("before (7)")
def row_of_Q_inverse():
    """No row of the inverse of Q is longer than 1/2."""
    rows = (q[i].scalar * eye(3) + q_cross(i)) / 2
    return nonnegative(stack(*["1/4" - rows[k, :] @ rows[k, :].T for k in range(3)]))


v = study.parameter("v", shape=(3, 1))  # any vector, then J_0 v is any torque
a = study.parameter("a", shape=(3, 1))  # a row of the inverse of Q
w = study.parameter("w", shape=(3, 1))  # the inverse of J times u_d
bound = alpha * u_bar


@study.claimed("before (7)")
def acceleration_bound():
    """|v| <= alpha |J v|: the inverse of J lengthens no torque by more than alpha."""
    torque = J_0 @ v
    return nonnegative(alpha**2 * torque.T @ torque - v.T @ v).by(
        squares=[alpha * torque - v], forms=[(alpha * J_0 - eye(3), v)]
    )


@study.claimed("before (7)")
def disturbance_norm(i):
    """|u_d|^2 <= 3 u_bar^2."""
    return nonnegative(3 * u_bar**2 - u_d[i].T @ u_d[i])


@study.claimed("in (7)")
def disturbance_in_d(i):
    """d, the disturbance in the acceleration of q, is the inverse of Q times that of J times u_d."""
    return equal(d(i), (q[i].scalar * eye(3) + q_cross(i)) / 2 @ inverse(J[i]) @ u_d[i])


def assumed():
    """What the three bounds say of a row a of the inverse of Q and of w, the inverse of J times u_d."""
    return [1 - 4 * a.T @ a >= 0, 3 * bound**2 - w.T @ w >= 0]


STEPS = [row_of_Q_inverse, acceleration_bound, disturbance_norm, disturbance_in_d]


@study.printed(
    "before (6)",
    reading="component by component, with K_v = u_bar alpha_max of the inverse of J",
    using=STEPS,
)
def K_v_is_enough():
    """For any a with |a| <= 1/2 and w with |w| <= sqrt(3) u_bar alpha, K_v = u_bar alpha is at least a'w.

    By the four steps the components of A^-1 Q'u_d are such a'w.
    """
    claim = nonnegative(bound - a.T @ w).by(times=6 * bound, squares=[3 * bound * a - w])
    return implies(assumed(), claim)


@study.claimed("before (6)", using=STEPS)
def K_v_smallest():
    """For the same a and w already K_v = (sqrt(3)/2) u_bar alpha is at least a'w."""
    claim = nonnegative(sqrt(3) / 2 * bound - a.T @ w).by(
        times=4 * sqrt(3) * bound, squares=[2 * sqrt(3) * bound * a - w]
    )
    return implies(assumed(), claim)


@study.claimed("before (6)")
def K_v_smallest_is_attained():
    """At J = I/alpha one attitude and torque reach (sqrt(3)/2) u_bar alpha: no smaller constant will do."""
    part = 1 / sqrt(3)
    row = (part * eye(3) + skew(stack(0, part, -part)))[0, :] / 2
    return equal(row @ (alpha * eye(3)) @ (u_bar * stack(1, 1, 1)), sqrt(3) / 2 * bound)


tau_k = study.parameter("tau_k")  # one component of tau and of d
d_k = study.parameter("d_k")


@study.printed(
    "discussion 1", reading="what keeps V falling, K_v |tau| >= d tau, with tanh in the place of sgn"
)
def tanh_in_the_place_of_sgn():
    """The hyperbolic tangent may replace the sign function."""
    given = [K_v - d_k >= 0, K_v + d_k >= 0]
    return implies(given, nonnegative(K_v * tanh(tau_k) * tau_k - d_k * tau_k))


study.rejected(
    tanh_in_the_place_of_sgn,
    why="Near tau = 0 the disturbance is not dominated: synchronisation to a neighbourhood is left.",
)
