"""A verified statement as plain text, built from its own content.

Soundness-critical. Last reviewed 2026-11-24.

Relies on no theorem. Formulas are read back from the listings; a listing too long for a line is named by
its digest. Words that the certificate brings are marked as such and cannot break out of their line.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from symctrl.kernel.values import Listing, Meaning, Ref, Sentence, Statement

MAX_FORMULA = 400
SET_WORDS = ("stays", "enters", "settles", "eventually")
_INFIX = {"ADD": "+", "SUB": "-", "MUL": "*", "DIV": "/", "POW": "^", "CONSTPOW": "^"}
_PREFIX = {"NEG": "-{}", "SQ": "{}^2", "TWICE": "2*{}", "INV": "1/{}"}


def line(text: str) -> str:
    """The text with everything that does not print written as an escape."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def print_statement(statement: Statement, refuted: bool = False) -> str:
    """All that the statement says: the claim, what it is about, and under which conditions."""
    return "\n".join(_Printer(statement).lines(refuted))


class _Printer:
    def __init__(self, statement: Statement) -> None:
        self.statement = statement
        self.texts: dict[str, dict[int, str]] = {}

    def lines(self, refuted: bool) -> Iterator[str]:
        s = self.statement
        yield f'statement {line(s.id)} of {line(s.study)}, in the words of the certificate: "{line(s.text)}"'
        yield ("it is false that wherever what is given holds, " if refuted else "") + self.claim()
        for given in s.given:
            of = ", ".join(map(self.formula, given.of))
            about = f" (about {line(given.about)})" if given.about else ""
            yield f"given{about}: {of} {given.kind.replace('_', ' ')}"
        for use in s.uses:
            yield f"using the statement {line(use.id)} (sha256 {use.sha256})"
        for condition in s.conditions:
            yield f"if {line(condition.of)} is {condition.kind}"
        for name, meaning in s.names.items():
            yield f"where {name} is {self.meaning(meaning)}"
        for name, ref in s.motion.items():
            yield f"where d/dt {name} = {self.formula(ref)}"
        for law, table in s.laws.items():
            for name, ref in table.items():
                yield f"where the law {line(law)} has {name} = {self.formula(ref)}"
        for kind in sorted(set(s.scalars.values())):
            yield f"for all {kind}: " + ", ".join(name for name, of in s.scalars.items() if of == kind)

    def claim(self) -> str:
        claim = self.statement.claim
        if claim.kind == "theorem":
            return self.theorem()
        listing = self.statement.listings[claim.listing]
        outputs = [self.formula((claim.listing, k)) for k in range(len(listing.outputs))]
        size = f"claim ({claim.shape[0]}x{claim.shape[1]}): "
        if claim.small is not None:
            size = (
                f"for all positive {claim.small} below a bound that depends on the other parameters, {size}"
            )
        if listing.letters:
            size = f"for every {'node i' + (' and neighbour j' if 'j' in listing.letters else '')}, {size}"
        if claim.kind == "equal":
            half = len(outputs) // 2
            return f"{size}[{'; '.join(outputs[:half])}] = [{'; '.join(outputs[half:])}]"
        of = "; ".join(outputs) if claim.matrix is None else _matrix(claim.matrix, outputs)
        return f"{size}[{of}] {claim.kind.replace('_', ' ')}"

    def theorem(self) -> str:
        """What every solution of the closed loop does, and what is supposed of it."""
        claim = self.statement.claim
        law = f" under the law {line(claim.law)}" if claim.law is not None else ""
        supposed = f", if {self.sentences(claim.suppose)}" if claim.suppose else ""
        return f"theorem: every solution{law}{supposed} exists for all time, and {self.sentences(claim.then)}"

    def sentences(self, sentences: Sequence[Sentence]) -> str:
        return " and ".join(self.sentence(s) for s in sentences)

    def sentence(self, s: Sentence) -> str:
        of = "; ".join(self.formula((self.statement.claim.listing, k)) for k in s.of)
        if s.at:
            of = ", ".join(f"{name} = {value}" for name, value in s.at)
        about = f"[{of}]" + (" = 0" if s.zero else " >= 0" if s.word in SET_WORDS else "") if of else ""
        by = f" by {self.formula((self.statement.claim.listing, s.by))}" if s.by is not None else ""
        return f"{s.word} {about}{by}".strip()

    def meaning(self, meaning: Meaning) -> str:
        if meaning.kind == "constant":
            return str(meaning.value)
        of = self.formula(meaning.of)
        law = f" under the law {line(meaning.law)}" if meaning.law is not None else ""
        return {
            "value": of,
            "rate": f"d/dt ({of}){law}",
            "sum": f"the sum over neighbours j of {of}",
            "total": f"the sum over all nodes i of {of}",
        }[meaning.kind]

    def formula(self, ref: Ref) -> str:
        listing = self.statement.listings[ref[0]]
        if ref[0] not in self.texts:
            self.texts[ref[0]] = _read_back(listing)
        text = self.texts[ref[0]].get(listing.outputs[ref[1]])
        return text or f"output {ref[1]} of {line(ref[0])} (sha256 {listing.sha256})"


def _matrix(tree: Any, outputs: Sequence[str]) -> str:
    """A tree of blocks as text: rows of entries, A (x) I_n, diag(A, B), or C' A C with C in rows."""
    if "entries" in tree:
        return _rows(tree["entries"], outputs)
    if "kron_identity" in tree:
        return f"{_matrix(tree['kron_identity'], outputs)} (x) I_{tree['size']}"
    if "congruence" in tree:
        return f"C' {_matrix(tree['congruence'], outputs)} C with C = {_rows(tree['factor'], outputs)}"
    return f"diag({', '.join(_matrix(block, outputs) for block in tree['blocks'])})"


def _rows(rows: Sequence[Sequence[int]], outputs: Sequence[str]) -> str:
    return f"({'; '.join(', '.join(outputs[k] for k in row) for row in rows)})"


def _read_back(listing: Listing) -> dict[int, str]:
    """The formula of each register whose formula is not too long."""
    texts: dict[int, str] = {}
    for k, step in enumerate(listing.code):
        args = [texts.get(a) for a in step.args]
        if step.op in ("INPUT", "CONST"):
            plain = step.value.denominator == 1 and step.value >= 0
            text = step.name or (str(step.value) if plain else f"({step.value})")
        elif None in args:
            continue
        elif step.op in _INFIX:
            text = f"({args[0]} {_INFIX[step.op]} {args[1]})"
        elif step.op in _PREFIX:
            text = f"({_PREFIX[step.op].format(args[0])})"
        else:
            text = f"{step.op.lower()}({', '.join(map(str, args))})"
        if len(text) <= MAX_FORMULA:
            texts[k] = text
    return texts
