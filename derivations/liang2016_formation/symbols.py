"""Symbols of the paper, with units and the exact values of section 3."""

from symctrl import Study
from symctrl.statements import nonzero, positive_semidefinite
from symctrl.vectors import eye

study = Study(
    "liang2016_formation",
    source="Liang, Wang, Sun, Zhang: Decentralized attitude synchronization of spacecraft formation under "
    "disturbances. Journal of Harbin Institute of Technology 48(4), 2016, 13-19",
)
study.numbered("(1)-(10)", "lemma 1", "lemma 2", "theorem 1", "table 1")

fleet = study.fleet("G", default="ring:8")  # the paper's Fig. 2 is lost: the graph is the user's
i, j = fleet.node, fleet.neighbour

q = fleet.unit_quaternion("q", "q0")  # attitude of the body frame relative to the inertial frame
omega = fleet.state("omega", 3, unit="rad/s")  # of the body relative to the inertial frame, in the body frame
J = fleet.inertia("J")
u = fleet.input("u", 3, unit="N*m")

u_bar = study.gain("u_bar", "0.003", unit="N*m", tex=r"\bar{u}_d")  # of section 3: see data.py
u_d = fleet.disturbance("u_d", 3, unit="N*m", bound=u_bar)

K_o = study.gain("K_o", "1.6")
K_q = study.gain("K_q", "0.4")
K_v = study.gain("K_v", "0.01")
beta = study.gain("beta", "0.3")

# "In what follows q0 != 0 is assumed, so that Q is invertible" (after (3)).
study.assume(nonzero(q[i].scalar), about="trajectory")

# alpha_max(A), the largest eigenvalue: alpha is at least that of the inverse of J exactly if alpha J - I >=
# 0.
alpha = study.gain("alpha", "0.021", unit="1/(kg*m^2)")  # of section 3: see data.py
study.assume(positive_semidefinite(alpha * J[i] - eye(3)))
