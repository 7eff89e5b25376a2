"""From zeta = 0 to synchronisation, and the second Lyapunov function."""

from derivations.liang2016_formation.control import e, s, tau
from derivations.liang2016_formation.model import dq, product
from derivations.liang2016_formation.rate import de
from derivations.liang2016_formation.symbols import beta, fleet, omega, q, study
from symctrl import equal, nonnegative
from symctrl.quaternion import Quaternion
from symctrl.statements import implies
from symctrl.vectors import stack

i, j = fleet.node, fleet.neighbour
q_a, q_b = study.unit_quaternion("q_a"), study.unit_quaternion("q_b")  # two craft of the formation


@study.printed("after (10)")
def rate_gives_omega(i):
    """The angular velocity is twice the product of the conjugate quaternion and its rate."""
    rate = study.rate(q[i].stacked)
    back = product(q[i].conjugate, Quaternion(rate[:3], rate[3]))
    return equal(stack(omega[i], 0), 2 * back.stacked)


@study.printed("after (10)", readings={"as printed": lambda x: x, "q_i transposed": lambda x: x.T})
def sum_of_squares(transposed):
    """The sum of q_i'(q_i - q_j) over both directions of every edge is half that of |q_i - q_j|^2."""
    left = fleet.sum(i, transposed(q[i].vector) @ s(i))
    return equal(left, fleet.sum(i, fleet.sum(j, e(i, j).T @ e(i, j))) / 2)


@study.printed("after (10)")
def zero_square_gives_equal_vectors():
    """If |q_a - q_b|^2 = 0, the vector parts are equal."""
    difference = q_a.vector - q_b.vector
    return implies(equal(difference.T @ difference, 0), equal(q_a.vector, q_b.vector))


@study.printed(
    "after (10)",
    finding={
        "refuted": "Equal vector parts leave the sign of the scalar part open: "
        "the attitudes may differ by a turn."
    },
)
def equal_vectors_give_equal_attitude():
    """If the vector parts are equal, the quaternions are equal."""
    return implies(equal(q_a.vector, q_b.vector), equal(q_a.scalar, q_b.scalar))


@study.corrected(
    equal_vectors_give_equal_attitude,
    why="It takes that both scalar parts have the same sign, as in q0 in [0, 1].",
)
def equal_vectors_and_signs_give_equal_attitude():
    """If the vector parts are equal and no scalar part is negative, the quaternions are equal."""
    given = [equal(q_a.vector, q_b.vector), nonnegative(q_a.scalar), nonnegative(q_b.scalar)]
    return implies(given, equal(q_a.scalar, q_b.scalar))


@study.definition("second Lyapunov function")
def V_2():
    return fleet.sum(i, fleet.sum(j, e(i, j).T @ e(i, j))) / 2


@study.printed("second Lyapunov function")
def rate_of_V_2_in_differences():
    """The rate of the second function is the sum of (q_i - q_j)'(dq_i - dq_j)."""
    return equal(study.rate(V_2), fleet.sum(i, 2 * fleet.sum(j, e(i, j).T @ de(i, j))) / 2)


@study.printed("second Lyapunov function")
def rate_of_V_2():
    """The rate of the second function is the sum of dq_i'(q_i - q_j)."""
    return equal(study.rate(V_2), fleet.sum(i, dq(i).T @ s(i)))


@study.corrected(rate_of_V_2, why="Both directions of an edge count, so that a factor two is missing.")
def rate_of_V_2_doubled():
    """The rate of the second function is twice the sum of dq_i'(q_i - q_j)."""
    return equal(study.rate(V_2), 2 * fleet.sum(i, dq(i).T @ s(i)))


@study.printed("second Lyapunov function", reading="where tau_i = 0 the last sum is zero")
def rate_of_V_2_on_the_surface():
    """Where tau_i = 0 the rate of the second function is -beta times the sum of |sum of (q_i - q_j)|^2."""
    return equal(study.rate(V_2), -beta * fleet.sum(i, s(i).T @ s(i)) + fleet.sum(i, tau(i).T @ s(i)))


@study.corrected(rate_of_V_2_on_the_surface, why="The factor two of the line before is missing here too.")
def rate_of_V_2_on_the_surface_doubled():
    """Where tau_i = 0 the rate of the second function is -2 beta times the sum of |sum of (q_i - q_j)|^2."""
    return equal(study.rate(V_2), -2 * beta * fleet.sum(i, s(i).T @ s(i)) + 2 * fleet.sum(i, tau(i).T @ s(i)))
