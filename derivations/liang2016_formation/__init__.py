"""Decentralised attitude synchronisation of a spacecraft formation under disturbances (Liang et al. 2016)."""

from derivations.liang2016_formation import (
    conclusion,
    control,
    data,
    disturbance,
    gains,
    model,
    rate,
    theorem,
)
from derivations.liang2016_formation.symbols import study

__all__ = ["conclusion", "control", "data", "disturbance", "gains", "model", "rate", "study", "theorem"]
