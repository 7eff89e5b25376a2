"""The gains: when Pi and V are definite, and on which graphs."""

from derivations.liang2016_formation.control import stiffness
from derivations.liang2016_formation.symbols import (
    K_o,
    K_q,
    K_v,
    beta,
    fleet,
    study,
)
from symctrl import (
    at_values,
    implies,
    nonnegative,
    positive_definite,
    positive_semidefinite,
    sufficiently_small,
)
from symctrl.graphs import parse
from symctrl.vectors import diagonal, eye, kron, stack, tanh

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
