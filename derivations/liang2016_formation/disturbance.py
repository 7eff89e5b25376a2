"""How large the disturbance is as it enters the acceleration of q, and what K_v must be."""

from derivations.liang2016_formation.model import q_cross
from derivations.liang2016_formation.rate import d
from derivations.liang2016_formation.symbols import J, alpha, fleet, q, study, u_bar, u_d
from symctrl import equal, nonnegative
from symctrl.vectors import eye, inverse, skew, sqrt, stack

i = fleet.node
bound = alpha * u_bar


@study.definition("in (7)")
def w(i):
    """The angular acceleration that the disturbance gives."""
    return inverse(J[i]) @ u_d[i]


@study.claimed("in (7)")
def torque_of_w(i):
    """No component of J w exceeds u_bar."""
    torque = J[i] @ w(i)
    return nonnegative(stack(*(u_bar - torque[k] for k in range(3)), *(u_bar + torque[k] for k in range(3))))


@study.claimed("in (7)", using=[torque_of_w])
def w_is_bounded(i):
    """|w|^2 <= 3 (alpha u_bar)^2."""
    return nonnegative(3 * bound**2 - w(i).T @ w(i)).by(
        squares=[alpha * J[i] @ w(i) - w(i), alpha], forms=[(alpha * J[i] - eye(3), w(i))]
    )


@study.claimed("in (7)")
def d_in_w(i):
    """d is half of (q0 I + q x) w."""
    return equal(d(i), (q[i].scalar * eye(3) + q_cross(i)) / 2 @ w(i))


@study.claimed("in (7)", using=[d_in_w, w_is_bounded])
def d_is_bounded(i):
    """|d|^2 <= (3/4) (alpha u_bar)^2, for 4 |d|^2 = |w|^2 - (q'w)^2."""
    return nonnegative("3/4" * bound**2 - d(i).T @ d(i)).by(squares=[q[i].vector.T @ w(i)])


@study.definition("in (7)")
def d_bar():
    """What no component of d exceeds."""
    return sqrt(3) / 2 * bound


@study.claimed("in (7)", using=[d_is_bounded])
def no_component_of_d_exceeds(i):
    """No component of d exceeds d_bar."""
    sides = [d_bar() - sign * d(i)[k] for sign in (1, -1) for k in range(3)]
    return nonnegative(stack(*sides)).by(times=2 * d_bar(), squares=[*sides, d(i)])


@study.printed(
    "before (6)",
    reading="component by component, with K_v = u_bar alpha_max of the inverse of J",
    using=[d_is_bounded],
)
def K_v_is_enough(i):
    """K_v = u_bar alpha is at least every component of d."""
    sides = [bound - sign * d(i)[k] for sign in (1, -1) for k in range(3)]
    return nonnegative(stack(*sides)).by(times=2 * bound, squares=[*sides, d(i)])


@study.claimed("before (6)")
def K_v_smallest_is_attained():
    """At J = I/alpha one attitude and torque reach (sqrt(3)/2) u_bar alpha: no smaller constant will do."""
    part = 1 / sqrt(3)
    row = (part * eye(3) + skew(stack(0, part, -part)))[0, :] / 2
    return equal(row @ (alpha * eye(3)) @ (u_bar * stack(1, 1, 1)), d_bar())
