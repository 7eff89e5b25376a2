"""Every known way to fool a prover, each with all digests recomputed unless the digest is the point."""

from __future__ import annotations

from tests.arena.bad_algebra import ALGEBRA
from tests.arena.bad_form import FORM
from tests.arena.bad_signs import MATRICES, SIGNS, VALUES

CASES = {**FORM, **ALGEBRA, **SIGNS, **MATRICES, **VALUES}
assert len(CASES) == sum(map(len, (FORM, ALGEBRA, SIGNS, MATRICES, VALUES))), "a name is there twice"
