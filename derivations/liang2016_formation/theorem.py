"""Theorem 1 and the lemmas of section 1.2: what the paper concludes, and what holds instead."""

from __future__ import annotations

from derivations.liang2016_formation.control import V, e, s, tau
from derivations.liang2016_formation.model import Q, dq
from derivations.liang2016_formation.rate import closed_loop_corrected, d
from derivations.liang2016_formation.symbols import K_o, K_q, K_v, beta, fleet, omega, q, study
from symctrl import along_trajectory, claim, equal, tends
from symctrl.vectors import absolute, stack

i, j = fleet.node, fleet.neighbour
Lambda = study.gain("Lambda", unit="1", tex=r"\Lambda")  # an upper bound of the Laplacian's eigenvalues


@study.claimed("after (1)")
def omega_from_rate(i):
    """The angular velocity is Q times the rate of the vector part."""
    return equal(omega[i], Q(i) @ dq(i))


def ones():
    return stack(1, 1, 1)


@study.claimed("theorem 1", using=[closed_loop_corrected, omega_from_rate])
def synchronisation():
    """If beta lambda_max(L) <= K_o and no component of the disturbance, as it enters the acceleration of q,
    exceeds K_v, all attitudes become equal and all angular velocities zero, on every connected graph, as long
    as no scalar part reaches zero.
    """
    return claim(
        given=[
            fleet.eigenvalues_at_most(Lambda),
            K_o >= beta * Lambda,
            d(i) <= K_v * ones(),
            d(i) >= -K_v * ones(),
            along_trajectory(q[i].scalar > 0),
        ],
        then=[
            tends(omega[i]),
            tends(q[i].vector - q[j].vector),
            tends(q[i].scalar - q[j].scalar),
        ],
        free=[d],
    )


def own(i):
    """The sum over the neighbours of the differences of the rates: L dq."""
    return fleet.sum(j, dq(i) - dq(j))


@study.argument(synchronisation)
def by_barbalat(run):
    in_rates = fleet.sum(i, K_o * dq(i).T @ dq(i) - beta * dq(i).T @ own(i))
    in_differences = fleet.sum(i, beta * K_q * s(i).T @ s(i))
    of_switches = fleet.sum(i, K_v * ones().T @ absolute(tau(i)) - d(i).T @ tau(i))
    run.falls(V, by=[in_rates, in_differences, of_switches])
    run.bounded(dq(i), by=V, least=K_q / (2 * (K_q + beta * K_o)))
    run.exists()
    run.barbalat(s(i), of=in_differences, least=beta * K_q)
    run.barbalat_rate(s(i))
    run.barbalat(in_rates)
    coupling = fleet.sum(i, dq(i).T @ own(i))
    run.tends(coupling)
    rates = fleet.sum(i, dq(i).T @ dq(i))
    run.tends(rates, by=[in_rates, coupling], times=[1, beta], divisor=K_o)
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
