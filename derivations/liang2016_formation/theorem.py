"""Theorem 1 and the lemmas of section 1.2: what the paper concludes, and what holds instead."""

from __future__ import annotations

from derivations.liang2016_formation.chart import (
    gains,
    in_differences,
    in_rates,
    on_a_path,
    ones,
    own,
    small_at_the_beginning,
    the_chart_is_kept,
)
from derivations.liang2016_formation.conclusion import V_2
from derivations.liang2016_formation.control import V, e, s, tau
from derivations.liang2016_formation.disturbance import d_bar, no_component_of_d_exceeds
from derivations.liang2016_formation.model import Q, dq
from derivations.liang2016_formation.rate import (
    closed_loop_corrected,
    d,
    omega_from_rate,
    quadratic_form,
    rate_of_scalar_part,
)
from derivations.liang2016_formation.symbols import (
    K_o,
    K_q,
    K_v,
    alpha,
    beta,
    fleet,
    omega,
    q,
    study,
    u_bar,
)
from symctrl import (
    along,
    along_trajectory,
    at,
    bounded,
    claim,
    equal,
    initially,
    summable,
    tends,
)
from symctrl.vectors import absolute, power

i, j = fleet.node, fleet.neighbour

# A Lyapunov function that falls at the rate w_t, and a quantity with the rate y_t, along one solution.
V_t, x_t = study.state("V_t", system="lemma 1"), study.state("x_t", system="lemma 1")
w_t, y_t = study.disturbance("w_t"), study.disturbance("y_t")
c_t = study.gain("c_t")
study.motion(V_t, -w_t)
study.motion(x_t, y_t)

# A function of time, its rate, and an exponent.
f_t, g_t = study.state("f_t", system="lemma 2"), study.disturbance("g_t")
p_t = study.parameter("p_t", unit="1")
study.motion(f_t, g_t)


@study.printed(
    "lemma 1",
    reading="along one solution, with x = 0 the set G; f is continuous, so that x has a bounded rate",
)
def lemma_1():
    """A bounded quantity x with V' <= -c x^2 for a V that is not negative tends to zero."""
    return claim(
        given=[w_t >= c_t * x_t**2, along_trajectory(V_t >= 0), bounded(x_t, y_t)],
        then=[tends(x_t)],
    )


@study.argument(lemma_1)
def along_one_solution(run):
    run.falls(V_t, by=c_t * x_t**2)
    run.barbalat(x_t)


@study.printed(
    "lemma 2",
    finding={
        "refuted": "A constant has all that the lemma asks: the function, and not its rate, must lie in L_p."
    },
)
def lemma_2():
    """A bounded function whose rate is bounded and lies in L_p, with p >= 1, tends to zero."""
    return claim(given=[p_t >= 1, bounded(f_t, g_t), summable(power(absolute(g_t), p_t))], then=[tends(f_t)])


@study.counterexample(lemma_2)
def a_constant():
    return along(f_t=1, g_t=0, p_t=2)


@study.corrected(lemma_2, why="The function itself lies in L_p; of its rate it is enough that it is bounded.")
def lemma_2_of_the_function():
    """A function that lies in L_p, with p >= 1, and has a bounded rate tends to zero."""
    return claim(given=[p_t >= 1, bounded(f_t, g_t), summable(power(absolute(f_t), p_t))], then=[tends(f_t)])


@study.argument(lemma_2_of_the_function)
def by_uniform_continuity(run):
    run.barbalat(f_t, of=power(absolute(f_t), p_t), power=p_t)


@study.printed(
    "theorem 1",
    finding={
        "refuted": "Two craft at rest whose quaternions have opposite signs stay so: their attitudes are the "
        "same, their quaternions are not."
    },
)
def theorem_1():
    """With the law (4) and a bounded disturbance all quaternions and all angular velocities become equal."""
    return claim(
        given=[equal(K_v, u_bar * alpha)],
        then=[
            tends(omega[i] - omega[j]),
            tends(q[i].vector - q[j].vector),
            tends(q[i].scalar - q[j].scalar),
        ],
    )


@study.counterexample(theorem_1, against=tends(q[i].scalar - q[j].scalar))
def opposite_quaternions():
    first, second = {"q": [0, 0, "3/5"], "q0": "4/5"}, {"q": [0, 0, "3/5"], "q0": "-4/5"}
    return at(on_a_path(first, second), graph="path:2")


@study.argument(theorem_1)
def with_definite_Pi(run):
    run.falls(V, by=[of_zeta(), of_switches()])  # (6) to (10)
    run.lasalle(V, zero=[dq(i), s(i)], limit=[dq(i), s(i)])  # "according to lemma 1, zeta = 0"


@study.argument(theorem_1)
def with_semidefinite_Pi(run):
    run.falls(V, by=[of_switches()])
    run.bounded(dq(i), e(i, j), by=V)  # "V is bounded, hence dq_i and q_i - q_j"
    run.barbalat(tau(i))  # "according to lemma 2"
    run.falls(V_2, by=[beta * fleet.sum(i, s(i).T @ s(i))])  # "using tau_i = 0"
    run.tends(e(i, j), by=V_2)  # "according to lemma 1"


def of_zeta():
    return fleet.sum(i, quadratic_form(i, K_o - beta, "0.5" * beta))


def of_switches():
    """The sum of eps_i |tau_i| as a product of components."""
    return fleet.sum(i, (K_v * ones() - d(i)).T @ absolute(tau(i)))


@study.corrected(
    theorem_1,
    using=[closed_loop_corrected, omega_from_rate, rate_of_scalar_part, no_component_of_d_exceeds],
    why="With the corrected B the loop is as designed; K_o is at least beta times the graph's largest "
    "eigenvalue, K_v exceeds the disturbance, and the initial states are small, so that no scalar part "
    "reaches zero.",
)
def synchronisation():
    """If beta lambda_max(L) <= K_o and K_v is at least (sqrt(3)/2) alpha u_bar + delta, all attitudes become
    equal and all angular velocities zero, on every connected graph, from all initial states with positive
    scalar parts and V + delta sum |q_i|_1 < delta.
    """
    return claim(
        given=[*gains(), *small_at_the_beginning(), initially(q[i].scalar > 0)],
        then=[
            tends(omega[i]),
            tends(q[i].vector - q[j].vector),
            tends(q[i].scalar - q[j].scalar),
        ],
        free=[d, d_bar],
        trajectory=False,
    )


@study.argument(synchronisation)
def by_barbalat(run):
    the_chart_is_kept(run)
    run.keeps(q[i].scalar > 0)
    run.barbalat(s(i), of=in_differences(), least=beta * K_q)
    run.barbalat_rate(s(i))
    run.barbalat(in_rates())
    coupling = fleet.sum(i, dq(i).T @ own(i))
    run.tends(coupling)
    rates = fleet.sum(i, dq(i).T @ dq(i))
    run.tends(rates, by=[in_rates(), coupling], times=[1, beta], divisor=K_o)
    run.tends(dq(i), by=rates)
    for k in range(3):
        run.tends(omega[i][k], by=dq(i), times=[Q(i)[k, n] for n in range(3)])
    potential = fleet.sum(i, q[i].vector.T @ s(i))
    run.tends(potential)
    differences = fleet.sum(i, fleet.sum(j, e(i, j).T @ e(i, j)))
    run.tends(differences, by=potential, times=2)
    run.tends(e(i, j), by=differences)
    run.tends(
        q[i].scalar - q[j].scalar,
        by=e(i, j),
        times=-(q[i].vector + q[j].vector),
        divisor=q[i].scalar + q[j].scalar,
    )
