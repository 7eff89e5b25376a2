"""A sum of squares for a programme: solve in floats, round at the first point that is far enough inside."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from math import frexp
from typing import Any

import numpy as np

from symctrl.sos.deadline import Deadline
from symctrl.sos.face import reduced
from symctrl.sos.generic import Rounding
from symctrl.sos.interior import iterates
from symctrl.sos.precise import solve
from symctrl.sos.programme import Programme, grams, sample
from symctrl.sos.proof import Part
from symctrl.sos.ring import Poly, to_fmpq
from symctrl.sos.rounding import monomial_parts

# Relative to the margin, what may be left of the identity when rounding is tried.
_RESIDUAL = 0.05
_CLEAR = 1e-9
_ZERO = 1e-12
_NEAR = 1e-4
_FACES = 5


@dataclass(frozen=True)
class Found:
    """An exact identity: the target is the sum of the parts and of the multiples times what is zero."""

    parts: tuple[Part, ...]
    multiples: tuple[Poly, ...] = ()


@dataclass(frozen=True)
class Missed:
    """No identity. lam: the best margin in floats, None where there is none; bound: of the dual."""

    lam: float | None
    scale: float = 1.0
    moments: Any = None
    points: Any = None

    @property
    def near(self) -> bool:
        """May the best margin be zero or positive, as far as floats can tell?"""
        return self.lam is not None and self.lam > -_NEAR * self.scale


def search(programme: Programme, deadline: Deadline, zero: tuple[Poly, ...] = ()) -> Found | Missed:
    """An exact identity for the programme. Raises TooLarge and Late."""
    programme.require_room(seconds=max(deadline.left, 1.0))
    if not programme.reaches:
        return Missed(None)
    if not programme.blocks:
        return _by_multiples(programme, zero) or Missed(None)
    samples = sample(programme)
    if samples.free is not None and _vanishes(samples):
        found = _by_multiples(programme, zero)
        if found is not None:
            return found
    last = None
    for point in iterates(samples):
        deadline.check()
        last = point
        if point.lam > 0 and point.residual < _RESIDUAL * point.lam:
            found = _rounded(programme, samples, point.grams, zero)
            if found is not None:
                return found
        if (
            point.dual_residual < 1e-9
            and point.bound < -_CLEAR
            and point.lam < 0
            and point.residual < -point.lam
        ):
            break
    if last is None:
        return _by_multiples(programme, zero) or Missed(None)
    size = float(np.abs(samples.target).max()) or 1.0
    return Missed(max(last.lam, -abs(last.bound)), size, last.moments, samples.points)


def on_boundary(
    programme: Programme, deadline: Deadline, zero: tuple[Poly, ...] = (), bits: int = 320
) -> Found | Missed:
    """The same where the best margin is zero: face by face, each found with numbers of many bits."""
    current = programme
    for _ in range(_FACES):
        deadline.check()
        samples = sample(current)
        if samples.free is not None and not samples.free.size:
            return Missed(None)
        best = solve(current, samples, bits, deadline)
        if best is None or best.lam < -_ZERO:
            return Missed(None if best is None else best.lam)
        if best.lam > 0:
            done = _rounded(current, samples, best.orthonormal, zero)
            if done is not None:
                return done
        first = None
        for smaller in reduced(current, best.grams, min(1e-10, max(best.mu, 1e-200))):
            first = first or smaller
            found = search(smaller, deadline, zero)
            if isinstance(found, Found):
                return found
        if first is None or not first.blocks:
            return Missed(best.lam)
        current = first
    return Missed(0.0)


def bounds(programme: Programme, deadline: Deadline) -> Iterator[Fraction]:
    """Numbers that may be subtracted from the target, the largest first, as floats have it."""
    programme.require_room(seconds=max(deadline.left, 1.0))
    best = None
    for point in iterates(sample(programme), constant=True):
        deadline.check()
        if point.residual < 1e-6 * (1 + abs(point.lam)):
            best = point.lam
    if best is None:
        return
    size = max(1.0, abs(best))
    for loss in (1e-7, 1e-5, 1e-3, 1e-1, 1.0):
        unit = Fraction(2) ** (frexp(loss * size)[1] - 2)
        yield ((Fraction(best) - Fraction(loss * size)) // unit) * unit


def _rounded(programme: Programme, samples: Any, found: Any, zero: tuple[Poly, ...]) -> Found | None:
    hs = grams(samples, found)
    bases = [block.monomials for block in programme.blocks]
    over = programme.target.context()
    if not programme.multiples and all(b is not None for b in bases):
        parts = monomial_parts(programme.target, [b for b in bases if b is not None], hs, over)
        return None if parts is None else Found(tuple(parts))
    gap = samples.target - sum(
        w * ((q @ g) * q).sum(axis=1) for q, w, g in zip(samples.rows, samples.weights, found, strict=True)
    )
    floats: list[float] = []
    if programme.multiples:
        floats = np.linalg.lstsq(samples.multiples, gap, rcond=None)[0].tolist()
    return _exactly(programme, hs, floats, zero)


def _vanishes(samples: Any) -> bool:
    """Is the target zero modulo the multiples, as far as floats can tell?"""
    rest = samples.free.T @ samples.target
    return not rest.size or float(np.abs(rest).max()) < 1e-9 * float(np.abs(samples.target).max())


def _by_multiples(programme: Programme, zero: tuple[Poly, ...]) -> Found | None:
    """The target as a combination of the multiples alone."""
    if not programme.multiples:
        return None
    return _exactly(replace(programme, blocks=()), [], [0.0] * len(programme.multiples), zero)


def _exactly(
    programme: Programme, hs: list[Any], floats: list[float], zero: tuple[Poly, ...]
) -> Found | None:
    """An identity near these Gram matrices and multiples."""
    done = Rounding(programme, hs, floats).run() or Rounding(programme, hs, floats, 24).run()
    if done is None:
        return None
    sums = [0 * programme.target for _ in zero]
    for (j, by, _), c in zip(programme.multiples, done[1], strict=True):
        if c:
            sums[j] = sums[j] + by * to_fmpq(c)
    return Found(tuple(done[0]), tuple(sums))
