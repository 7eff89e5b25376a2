r"""LaTeX, as the library prints it, read into a tree of MathML elements.

The subset is that of `symctrl.latex`: groups, scripts, fractions, roots, accents, brackets by
\left and \right, matrices, words. A command that is not known stands as its own name.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

_TOKEN = re.compile(r"\\([A-Za-z]+|.)|(\d+(?:\.\d+)?)|(\s+)|(.)", re.DOTALL)

GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ϵ", "zeta": "ζ", "eta": "η",
    "theta": "θ", "iota": "ι", "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π",
    "rho": "ρ", "sigma": "σ", "tau": "τ", "upsilon": "υ", "phi": "ϕ", "chi": "χ", "psi": "ψ", "omega": "ω",
    "Gamma": "Γ", "Delta": "Δ", "Theta": "Θ", "Lambda": "Λ", "Xi": "Ξ", "Pi": "Π", "Sigma": "Σ",
    "Upsilon": "Υ", "Phi": "Φ", "Psi": "Ψ", "Omega": "Ω", "ell": "ℓ", "varepsilon": "ε", "vartheta": "ϑ",
    "varrho": "ϱ", "varphi": "φ",
}  # fmt: skip
_OPERATORS = {
    "cdot": "⋅", "times": "×", "otimes": "⊗", "ge": "≥", "geq": "≥", "le": "≤", "leq": "≤", "ne": "≠",
    "neq": "≠", "succ": "≻", "succeq": "⪰", "prec": "≺", "preceq": "⪯", "implies": "⟹", "iff": "⟺", "to": "→",
    "in": "∈", "cdots": "⋯", "vdots": "⋮", "ddots": "⋱", "pm": "±", "mapsto": "↦", "mid": "∣", "|": "‖",
}  # fmt: skip
_SPACES = {";": "0.28em", ",": "0.17em", ":": "0.22em", "quad": "1em", "qquad": "2em", "!": None}
_FUNCTIONS = frozenset(
    (
        "sin",
        "cos",
        "tan",
        "exp",
        "log",
        "sinh",
        "cosh",
        "tanh",
        "det",
        "arcsin",
        "arccos",
        "arctan",
        "min",
        "max",
    )
)
_ACCENTS = {"dot": "˙", "ddot": "¨", "bar": "¯", "tilde": "~", "hat": "^", "check": "ˇ", "vec": "→"}
_LETTERS = {"mathsf": 0x1D5A0, "mathtt": 0x1D670, "mathbb": 0x1D538}  # of a capital A
_BOARD = {"C": "ℂ", "N": "ℕ", "Q": "ℚ", "R": "ℝ", "Z": "ℤ"}
RELATIONS = frozenset("=≥≤≠≻⪰≺⪯⟹⟺→∈<>")
SIGNS = frozenset("+−")
BRACKETS = frozenset("()[]{}")


@dataclass(frozen=True)
class Element:
    """A MathML element: a leaf with text, or one with parts. attributes: as they are written."""

    tag: str
    parts: tuple[Element, ...] = ()
    text: str = ""
    attributes: str = ""

    @property
    def is_operator(self) -> bool:
        return self.tag == "mo"


def row(parts: Sequence[Element]) -> Element:
    """The parts as one element."""
    return parts[0] if len(parts) == 1 else Element("mrow", tuple(parts))


def parse(latex: str) -> tuple[Element, ...]:
    """The elements of a formula, in order. Never raises: what is not understood is shown as it is written."""
    return tuple(_signed(_Reader(latex).until(())))


class _Reader:
    def __init__(self, latex: str) -> None:
        shown = "".join(sign if sign.isprintable() else " " for sign in latex)
        self.tokens = [m.group() for m in _TOKEN.finditer(shown)]
        self.at = 0

    def until(self, ends: Sequence[str]) -> list[Element]:
        """Elements up to one of the tokens `ends`, which is consumed, or to the end of the text."""
        found: list[Element] = []
        while self.at < len(self.tokens):
            token = self._next()
            if token in ends:
                break
            if token.isspace() or token == "~":
                continue
            if token in ("_", "^", "'"):
                base = found.pop() if found else Element("mrow")
                found.append(self._scripted(base, token))
            else:
                found += self._element(token)
        return found

    def _next(self) -> str:
        self.at += 1
        return self.tokens[self.at - 1]

    def _argument(self) -> Element:
        """A group, or the one element that follows."""
        while self.at < len(self.tokens) and self.tokens[self.at].isspace():
            self.at += 1
        if self.at == len(self.tokens):
            return Element("mrow")
        token = self._next()
        return row(_signed(self.until("}"))) if token == "{" else row(self._element(token))

    def _raw(self) -> str:
        """The text of a group, as it is written."""
        if self.at < len(self.tokens) and self.tokens[self.at] == "{":
            end = self.tokens.index("}", self.at) if "}" in self.tokens[self.at :] else len(self.tokens)
            text = "".join(self.tokens[self.at + 1 : end])
            self.at = end + 1
            return text
        return self._next() if self.at < len(self.tokens) else ""

    def _scripted(self, base: Element, token: str) -> Element:
        script = Element("mo", text="′") if token == "'" else self._argument()
        kind = {"_": "sub", "^": "sup", "'": "sup"}[token]
        is_sum = base.is_operator and base.text == "∑"
        if base.tag in ("msub", "msup") and base.tag != f"m{kind}":
            inner, other = base.parts
            below, above = (script, other) if kind == "sub" else (other, script)
            return Element("msubsup", (inner, below, above))
        return Element("munder" if is_sum and kind == "sub" else f"m{kind}", (base, script))

    def _element(self, token: str) -> list[Element]:
        if token.startswith("\\"):
            return self._command(token[1:])
        if token == "{":
            inner = _signed(self.until("}"))
            return [row(inner)] if inner else []
        if token[0].isdigit():
            return [Element("mn", text=token)]
        if token.isalpha():
            return [Element("mi", text=token)]
        if token == "|":
            return [Element("mo", text=token, attributes=' stretchy="false"')]
        return [Element("mo", text={"-": "−", "*": "∗"}.get(token, token))]

    def _command(self, name: str) -> list[Element]:
        if name in GREEK:
            return [Element("mi", text=GREEK[name])]
        if name in _OPERATORS:
            return [Element("mo", text=_OPERATORS[name])]
        if name in _SPACES:
            width = _SPACES[name]
            return [Element("mspace", attributes=f' width="{width}"')] if width else []
        if name in _FUNCTIONS:
            return [Element("mi", text=name)]
        if name in _ACCENTS:
            return [_accented(self._argument(), _ACCENTS[name])]
        if name in ("frac", "tfrac", "dfrac"):
            return [Element("mfrac", (self._argument(), self._argument()))]
        if name == "sqrt":
            return [Element("msqrt", (self._argument(),))]
        if name == "left":
            return [self._fenced()]
        if name == "begin":
            return [self._matrix()]
        if name in ("text", "operatorname", "mathrm", "mathsf", "mathtt", "mathbb"):
            return self._words(name)
        plain = {"sum": "∑", "int": "∫", "prod": "∏", "infty": "∞", "{": "{", "}": "}", "_": "_", "%": "%"}
        if name in plain:
            return [Element("mi" if name == "infty" else "mo", text=plain[name])]
        return [Element("mtext", text=name if name.isalpha() else "")] if name.strip() else []

    def _words(self, name: str) -> list[Element]:
        text = self._raw()
        if not text.strip():
            return []
        if name == "text":
            return [Element("mtext", text=text.replace(" ", "\N{NO-BREAK SPACE}"))]
        if name in _LETTERS and len(text) == 1 and text.isalpha():
            styled = _BOARD.get(text) if name == "mathbb" else None
            return [Element("mi", text=styled or _styled(text, _LETTERS[name]))]
        upright = ' mathvariant="normal"' if len(text) == 1 else ""
        return [Element("mi", text=text.replace("\\", ""), attributes=upright)]

    def _fenced(self) -> Element:
        opening = self._delimiter()
        inner = _signed(self.until(("\\right",)))
        closing = self._delimiter()
        return Element("mrow", (_fence(opening, "prefix"), row(inner), _fence(closing, "postfix")))

    def _delimiter(self) -> str:
        token = self._next() if self.at < len(self.tokens) else "."
        return {".": "", "\\|": "‖", "\\{": "{", "\\}": "}"}.get(token, token)

    def _matrix(self) -> Element:
        self._raw()
        lines: list[list[Element]] = [[]]
        cell: list[Element] = []
        while self.at < len(self.tokens):
            token = self._next()
            if token in ("&", "\\\\", "\\end"):
                lines[-1].append(Element("mtd", tuple(_signed(cell))))
                cell = []
                if token == "\\end":
                    self._raw()
                    break
                if token == "\\\\":
                    lines.append([])
            elif token in ("_", "^", "'"):
                base = cell.pop() if cell else Element("mrow")
                cell.append(self._scripted(base, token))
            elif not token.isspace():
                cell += self._element(token)
        table = Element("mtable", tuple(Element("mtr", tuple(line)) for line in lines))
        return Element("mrow", (_fence("(", "prefix"), table, _fence(")", "postfix")))


def _accented(part: Element, sign: str) -> Element:
    """The accent over a letter, not over its subscript."""
    if part.tag in ("msub", "msubsup"):
        return Element(part.tag, (_accented(part.parts[0], sign), *part.parts[1:]))
    if sign == "˙" and part.tag == "mover" and part.parts[1].text == sign:
        part, sign = part.parts[0], "¨"
    return Element("mover", (part, Element("mo", text=sign)), "", ' accent="true"')


def _signed(parts: Sequence[Element]) -> list[Element]:
    """The parts with signs told apart: one that follows a sign or relation is marked as a prefix."""
    told: list[Element] = []
    for k, part in enumerate(parts):
        if part.is_operator and part.text in SIGNS and not part.attributes:
            before = next((p for p in reversed(parts[:k]) if p.tag != "mspace"), None)
            leads = (
                before is not None and before.is_operator and before.text in RELATIONS | SIGNS | set(",⋅×")
            )
            told.append(Element("mo", text=part.text, attributes=' form="prefix"' if leads else ""))
        else:
            told.append(part)
    return told


def _fence(text: str, form: str) -> Element:
    """A bracket; browsers know on which side it stands where its sign says so."""
    return Element("mo", text=text, attributes="" if text in BRACKETS else f' fence="true" form="{form}"')


def _styled(letter: str, capital: int) -> str:
    return chr(capital + ord(letter) - 65 if letter.isupper() else capital + 26 + ord(letter) - 97)
