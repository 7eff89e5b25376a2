"""The remark after (3), that q0 != 0 may be assumed: what is true of it."""

from __future__ import annotations

from derivations.liang2016_formation.control import V, s, tau
from derivations.liang2016_formation.disturbance import d_bar, no_component_of_d_exceeds
from derivations.liang2016_formation.model import dq
from derivations.liang2016_formation.rate import (
    closed_loop_corrected,
    d,
    omega_from_rate,
    rate_of_scalar_part,
)
from derivations.liang2016_formation.symbols import K_o, K_q, K_v, beta, fleet, q, study
from symctrl import apart, claim, exists, initially, undefined
from symctrl.vectors import absolute, sgn, stack

i, j = fleet.node, fleet.neighbour
Lambda = study.gain("Lambda", unit="1", tex=r"\Lambda")  # an upper bound of the Laplacian's eigenvalues
delta = study.gain("delta", tex=r"\delta")  # by which K_v exceeds the disturbance
c = study.gain("c", unit="1")
INERTIA = [[100, 0, 0], [0, 100, 0], [0, 0, 100]]  # of a counterexample


@study.printed(
    "after (3)",
    reading="the assumption q0 != 0 takes nothing away: the loop is defined for every attitude",
    finding={
        "refuted": "A craft that has turned by half a turn has q0 = 0: there the law divides by zero. The "
        "assumption is one about the trajectory, which the theorem must make or show."
    },
)
def chart_takes_nothing_away():
    """From every attitude with a norm of one the closed loop has a solution for all time."""
    return claim(then=[exists()], trajectory=False)


@study.counterexample(chart_takes_nothing_away)
def half_a_turn():
    return undefined(on_a_path({"q": [0, 0, 1], "q0": 0}, {"q": [0, 0, 1], "q0": 0}), graph="path:2")


def on_a_path(first, second):
    """Two craft at rest, with these attitudes."""
    at_rest = {"omega": [0, 0, 0], "u_d": [0, 0, 0], "J": INERTIA}
    values = {f"{name}.1": value for name, value in (at_rest | first).items()}
    values |= {f"{name}.2": value for name, value in (at_rest | second).items()}
    return values | {"u_bar": 1, "alpha": "0.01"}


def ones():
    return stack(1, 1, 1)


def own(i):
    """The sum over the neighbours of the differences of the rates: L dq."""
    return fleet.sum(j, dq(i) - dq(j))


def lengths(i):
    """The sum of the components' absolute values."""
    return ones().T @ absolute(q[i].vector)


def gains():
    return [fleet.eigenvalues_at_most(Lambda), K_o >= beta * Lambda]


def small_at_the_beginning():
    """Initial states from which the chart is never left, and a K_v that exceeds the disturbance by delta."""
    return [
        K_v - delta >= d_bar(),
        1 - c > 0,
        initially(delta * c - V() - delta * fleet.sum(i, lengths(i)) >= 0),
    ]


def in_rates():
    return fleet.sum(i, K_o * dq(i).T @ dq(i) - beta * dq(i).T @ own(i))


def in_differences():
    return fleet.sum(i, beta * K_q * s(i).T @ s(i))


def of_switches():
    return fleet.sum(i, K_v * ones().T @ absolute(tau(i)) - d(i).T @ tau(i))


def the_chart_is_kept(run):
    """V + delta sum |q_i|_1 does not rise: d|q_i|_1/dt <= |tau_i|_1 - beta sgn(q_i)'s_i, where the last term
    is not negative in the sum over all nodes.
    """
    run.holds(d(i) <= (K_v - delta) * ones())
    run.holds(d(i) >= -(K_v - delta) * ones())
    run.falls(V, by=[in_rates(), in_differences(), of_switches()])
    run.holds(V() >= 0)
    run.holds(in_rates() >= 0)
    run.holds(in_differences() >= 0)
    run.holds(of_switches() - delta * fleet.sum(i, ones().T @ absolute(tau(i))) >= 0)
    signs = sgn(q[i].vector)
    run.holds(fleet.sum(i, ones().T @ absolute(tau(i)) - signs.T @ tau(i)) >= 0)
    run.holds(fleet.sum(i, fleet.sum(j, signs.T @ (q[i].vector - q[j].vector))) >= 0)
    run.keeps(delta * c - V() - delta * fleet.sum(i, lengths(i)))
    run.part(lengths(i), of=fleet.sum(i, lengths(i)))
    run.holds(delta * (c - lengths(i)) >= 0)
    run.holds(c - lengths(i) >= 0)
    run.apart(q[i].scalar, least=1 - c**2)
    run.bounded(dq(i), by=V, least=K_q / (2 * (K_q + beta * K_o)))
    run.exists()


@study.corrected(
    chart_takes_nothing_away,
    using=[closed_loop_corrected, omega_from_rate, rate_of_scalar_part, no_component_of_d_exceeds],
    why="From small initial states, and with a gain above the disturbance, the chart is never left.",
)
def chart_is_kept():
    """From small initial states the scalar part stays apart from zero, and solutions exist for all time."""
    return claim(
        given=[*gains(), *small_at_the_beginning()],
        then=[apart(q[i].scalar)],
        free=[d, d_bar],
        trajectory=False,
    )


@study.argument(chart_is_kept)
def by_what_does_not_rise(run):
    the_chart_is_kept(run)
