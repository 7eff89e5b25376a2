"""Sentences with the names of quantities in them set as mathematics: `K_o`, `beta`, `lambda_max`, `q0`."""

from __future__ import annotations

import re

from markupsafe import Markup, escape

from symctrl.latex import name_latex
from symctrl.report.formula import GREEK
from symctrl.report.mathml import math

_LETTER = rf"(?:[A-Za-z]|{'|'.join(sorted(GREEK, key=len, reverse=True))})"
_GREEK = "|".join(sorted((name for name in GREEK if len(name) > 2 and name != "ell"), key=len, reverse=True))
_NAME = re.compile(rf"(?<![\w/\\])(?<!\w-)({_LETTER}(?:_\w+)+|[a-zA-Z]\d|{_GREEK}|Pi|Xi|mu|nu)(?![\w-])")


def prose(text: str) -> Markup:
    """The sentence as HTML. What is no name of a quantity stays as it is written."""
    pieces = _NAME.split(text)
    shown = [math(name_latex(piece)) if k % 2 else escape(piece) for k, piece in enumerate(pieces)]
    return Markup("").join(shown)
