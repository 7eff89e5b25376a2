"""The rules by the names of an argument's lines."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from symctrl.rules.barbalat import barbalat, barbalat_rate
from symctrl.rules.carries import carries
from symctrl.rules.chain import Chain
from symctrl.rules.lasalle import lasalle
from symctrl.rules.lines import decays, exists, falls, holds, keeps, lyapunov, outside, part

PLANNERS: Mapping[str, Callable[[Chain, Mapping[str, Any]], bool]] = {
    "falls": falls,
    "decays": decays,
    "outside": outside,
    "holds": holds,
    "part": part,
    "keeps": keeps,
    "exists": exists,
    "carries": carries,
    "barbalat": barbalat,
    "barbalat_rate": barbalat_rate,
    "lasalle": lasalle,
    "lyapunov": lyapunov,
}
