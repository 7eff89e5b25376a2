"""A quaternion by its vector part and its scalar part."""

from __future__ import annotations

from dataclasses import dataclass

from symctrl.expr import Expr
from symctrl.vectors import stack


@dataclass(frozen=True)
class Quaternion:
    """A quaternion by its vector part (3x1) and its scalar part."""

    vector: Expr
    scalar: Expr

    @property
    def stacked(self) -> Expr:
        """Vector part above scalar part, 4x1."""
        return stack(self.vector, self.scalar)

    @property
    def conjugate(self) -> Quaternion:
        return Quaternion(-self.vector, self.scalar)
