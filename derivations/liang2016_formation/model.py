"""Section 1.1: quaternions, kinematics (1), dynamics (2) and the Lagrange form (3)."""

from derivations.liang2016_formation.symbols import J, fleet, omega, q, study, u, u_bar, u_d
from symctrl import equal
from symctrl.quaternion import Quaternion
from symctrl.statements import implies, nonnegative, positive_semidefinite, skew_symmetric
from symctrl.vectors import block, cos, eye, inverse, sin, skew, stack

i, j = fleet.node, fleet.neighbour

n = study.parameter("n", shape=(3, 1), unit="1")  # Euler axis
theta = study.parameter("theta", unit="1", tex=r"\theta")  # Euler angle


def product(a, b):
    """The quaternion product of the paper, vector part above scalar part."""
    vector = a.scalar * b.vector + b.scalar * a.vector + skew(a.vector) @ b.vector
    return Quaternion(vector, a.scalar * b.scalar - a.vector.T @ b.vector)


def direction_cosine(a):
    """Direction cosine matrix from the inertial to the body frame of an attitude quaternion."""
    v, s = a.vector, a.scalar
    return (s**2 - v.T @ v) * eye(3) + 2 * v @ v.T - 2 * s * skew(v)


def rate_quaternion(w):
    return Quaternion(w, 0 * w[0])


def body_rate(i):
    """The derivative of the attitude, half the product of the quaternion and (omega, 0)."""
    return product(q[i], rate_quaternion(omega[i])).stacked / 2


fleet.motion(q.vector, lambda i: body_rate(i)[:3])
fleet.motion(q.scalar, lambda i: body_rate(i)[3])
fleet.motion(omega, lambda i: inverse(J[i]) @ (-skew(omega[i]) @ J[i] @ omega[i] + u[i] + u_d[i]))


@study.printed("before (1)")
def unit_norm():
    """A quaternion made of a unit Euler axis and an angle has norm one."""
    v, s = n * sin(theta / 2), cos(theta / 2)
    return implies(equal(n.T @ n, 1), equal(v.T @ v + s**2, 1))


@study.printed(
    "before (1)", finding={"refuted": "An Euler angle beyond half a turn has a negative scalar part."}
)
def scalar_part_range():
    """The scalar part cos(theta/2) lies in [0, 1]."""
    return [nonnegative(cos(theta / 2)), nonnegative(1 - cos(theta / 2))]


@study.corrected(scalar_part_range, why="The cosine of half an Euler angle lies in [-1, 1], not in [0, 1].")
def scalar_part_bounds():
    """The square of the scalar part is at most one."""
    return nonnegative(1 - cos(theta / 2) ** 2)


@study.definition("after (1)")
def q_cross(i):
    v = q[i].vector
    return block([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], -v[0], 0]])


@study.corrected(
    q_cross,
    why="The entry in row 3, column 2 is +(q)_1: only then is the matrix skew and q^x v a cross product.",
)
def q_cross_skew(i):
    return skew(q[i].vector)


@study.printed("after (1)")
def q_cross_is_skew(i):
    """The matrix q^x is skew-symmetric."""
    return skew_symmetric(q_cross(i))


@study.corrected(
    q_cross_is_skew, why="With the sign of the entry in row 3, column 2 put right, the matrix is skew."
)
def q_cross_corrected_is_skew(i):
    """The matrix q^x is skew-symmetric."""
    return skew_symmetric(q_cross(i))


@study.printed(
    "(1)",
    readings={
        "the whole quaternion": lambda i: study.rate(q[i].stacked),
        "the vector part": lambda i: study.rate(q[i].vector),
    },
)
def kinematics(i, left):
    """The vector part of the attitude turns with (q0 I + q^x) omega / 2."""
    return equal(left(i), (q[i].scalar * eye(3) + q_cross(i)) @ omega[i] / 2)


@study.corrected(kinematics, why="The left side is the rate of the vector part, and q^x is the skew matrix.")
def kinematics_vector(i):
    """The vector part of the attitude turns with (q0 I + q^x) omega / 2."""
    return equal(study.rate(q[i].vector), (q[i].scalar * eye(3) + q_cross(i)) @ omega[i] / 2)


@study.printed("(1), second line")
def kinematics_scalar(i):
    """The scalar part falls with q'omega / 2."""
    return equal(study.rate(q[i].scalar), -q[i].vector.T @ omega[i] / 2)


@study.claimed("convention of (1)")
def norm_is_kept(i):
    """The motion keeps the norm of the quaternion."""
    return equal(study.rate(q[i].vector.T @ q[i].vector + q[i].scalar ** 2), 0)


@study.claimed("convention of (1)")
def poisson(i):
    """With the direction cosine matrix R from the inertial to the body frame, R' = -omega^x R: omega is in
    body axes.
    """
    return equal(study.rate(direction_cosine(q[i])), -skew(omega[i]) @ direction_cosine(q[i]))


@study.claimed("convention of the relative attitude")
def relative_attitude(i, j):
    """The relative attitude q_j* (x) q_i turns from the frame of j to that of i."""
    relative = product(q[j].conjugate, q[i])
    return equal(direction_cosine(relative), direction_cosine(q[i]) @ direction_cosine(q[j]).T)


@study.printed("(2)")
def euler(i):
    """Euler's equation of the rigid body with the control and the disturbance torque."""
    w = omega[i]
    return equal(J[i] @ study.rate(w), -skew(w) @ J[i] @ w + u[i] + u_d[i])


@study.definition("after (3)")
def Q(i):
    return inverse((q[i].scalar * eye(3) + q_cross(i)) / 2)


@study.definition("after (3)")
def A(i):
    return Q(i).T @ J[i] @ Q(i)


def dq(i):
    return study.rate(q[i].vector)


def coriolis(i, second):
    return -(Q(i).T @ skew(J[i] @ Q(i) @ dq(i)) @ Q(i) + second)


@study.definition("after (3)")
def B(i):
    return coriolis(i, Q(i).T @ study.rate(J[i]) @ Q(i))


@study.definition("after (3)")
def B_with_rate_of_Q(i):
    return coriolis(i, Q(i).T @ J[i] @ study.rate(Q(i)))


def coriolis_needed(i):
    """The coefficient of dq that follows from (1) and (2)."""
    return Q(i).T @ J[i] @ study.rate(Q(i)) - Q(i).T @ skew(J[i] @ Q(i) @ dq(i)) @ Q(i)


@study.corrected(
    B, why="The second term is the rate of Q, not of J, and its sign is plus: B = Q'J dQ/dt - Q'(J Q dq)^x Q."
)
def B_corrected(i):
    return coriolis_needed(i)


@study.printed("(3)", readings={"the dot on J": B, "the dot on Q": B_with_rate_of_Q})
def lagrange(i, coefficient):
    """The attitude obeys A ddq + B dq = Q'u + Q'u_d."""
    left = A(i) @ study.rate(dq(i)) + coefficient(i) @ dq(i)
    return equal(left, Q(i).T @ u[i] + Q(i).T @ u_d[i])


@study.corrected(lagrange, why="It follows from (1) and (2) with B = Q'J dQ/dt - Q'(J Q dq)^x Q.")
def lagrange_corrected(i):
    """The attitude obeys A ddq + B dq = Q'u + Q'u_d."""
    left = A(i) @ study.rate(dq(i)) + B(i) @ dq(i)
    return equal(left, Q(i).T @ u[i] + Q(i).T @ u_d[i])


@study.printed("after (3)")
def A_semidefinite(i):
    """The matrix A is positive semidefinite."""
    return positive_semidefinite(A(i))


@study.printed("after (3)", readings={"B as printed": B, "B as (3) needs it": coriolis_needed})
def B_is_skew(i, coefficient):
    """The matrix B is skew-symmetric."""
    return skew_symmetric(coefficient(i))


@study.claimed("after (3)")
def rate_of_A_minus_2B_is_skew(i):
    """What is skew-symmetric with the B that (3) needs is dA/dt - 2 B."""
    return skew_symmetric(study.rate(A(i)) - 2 * B(i))


@study.printed("after (2)")
def disturbance_bound(i):
    """Each component of the disturbance torque is at most u_bar in absolute value."""
    return u_d[i] <= u_bar * stack(1, 1, 1)
