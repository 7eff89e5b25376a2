"""The proof graph: each theorem with its argument and what that rests on, printed and corrected."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from symctrl.report.claims import place
from symctrl.report.drawing import draw
from symctrl.report.names import SHAPES, Group, anchor, base, capital, chip, few, in_words, standing_chip
from symctrl.report.page import Branch, Chip, Leaf, Limb, ProofPair, Tree
from symctrl.report.words import counted
from symctrl.rows import Report, Row

PRINTED, CORRECTED = "As printed", "Corrected"


def pairs(report: Report, grouped: Sequence[Group]) -> tuple[ProofPair, ...]:
    """For each theorem its tree as printed and, where it has one, that of its correction."""
    made = []
    for group in grouped:
        if group.rows[0].kind != "theorem":
            continue
        view = _View(report, grouped)
        trees = [view.tree(group, row, PRINTED if row.form == "printed" else "") for row in group.rows]
        trees += [view.tree(group, row, CORRECTED) for row in group.corrections]
        made.append(
            ProofPair(capital(group.rows[0].equation), tuple(replace(t, drawing=draw(t)) for t in trees))
        )
    return tuple(made)


class _View:
    """The rows by id, as a theorem looks at them."""

    def __init__(self, report: Report, grouped: Sequence[Group]) -> None:
        self.rows = {row.id: row for row in report.rows}
        self.groups = {group.base: group for group in grouped}
        self.corrections = {r.corrects: r for r in report.rows if r.form == "corrected" and r.corrects}

    def tree(self, group: Group, row: Row, side: str) -> Tree:
        limbs = [*self._counterexample(row), *self._arguments(row)]
        used = self._used(row, side)
        if used:
            limbs.append(Limb("statements and definitions in use", tuple(used)))
        return Tree(
            side=side,
            chip=chip(row) if side != CORRECTED else standing_chip(row),
            equation=capital(row.equation),
            name=row.id,
            target=place(group, row),
            summary=_summary(limbs),
            limbs=tuple(limbs),
        )

    def _counterexample(self, row: Row) -> Iterator[Limb]:
        if row.verdict == "refuted":
            name = row.method.removeprefix("counterexample ")
            branch = Branch(
                Chip("refuted", "refuted"),
                name,
                (),
                "contradicts a conclusion",
                cut=True,
                target=_own_place(row),
            )
            yield Limb("counterexample", (branch,))

    def _arguments(self, row: Row) -> Iterator[Limb]:
        steps = [r for r in self.rows.values() if r.form == "step" and r.id.startswith(f"{row.id}/")]
        for name in dict.fromkeys(step.id.split("/")[-2] for step in steps):
            lines = [self._line(step) for step in steps if step.id.split("/")[-2] == name]
            closes = row.method == f"argument {name}"
            heading = f"argument {name}" + ("" if closes else ", which does not close")
            yield Limb(heading, tuple(lines))

    def _line(self, step: Row) -> Branch:
        below = [self.rows[id_] for id_ in step.rests_on if id_ in self.rows]
        open_ = [r for r in below if r.verdict != "proved"]
        met = len(below) - len(open_)
        number = step.id.rpartition("/")[2]
        leaves = tuple(Leaf(_plain(r), r.role or r.statement, r.verdict == "refuted") for r in open_)
        text = f"{number} {step.rule}" if number != "0" else "0 assumptions are kept"
        more = f"{counted(met, 'obligation')} met" if met else ""
        if step.blocked_by:
            more = "a line above it is broken"
        return Branch(
            _plain(step),
            text,
            leaves,
            more,
            cut=step.verdict == "refuted",
            tainted=step.verdict == "undecided",
            detail=step.statement.partition("(")[2].removesuffix(")") if number != "0" else "",
        )

    def _used(self, row: Row, side: str) -> Iterator[Branch] | list[Branch]:
        """Statements first, then definitions that are corrected, then the others in one line."""
        names = [id_ for id_ in row.rests_on if "/" not in id_]
        statements, faulty, plain = [], [], []
        for name in names:
            below = self.rows.get(name)
            if below is None:
                continue
            if below.kind != "conforms" or below.form == "corrected":
                statements.append(self._statement(below))
            elif name in self.corrections and side == PRINTED:
                text = name
                leaf = Leaf(Chip("proved", "corrected"), f"corrected by {self.corrections[name].id}")
                faulty.append(
                    Branch(Chip("broken", "corrected"), text, (leaf,), tainted=True, target=anchor(name, "d"))
                )
            else:
                plain.append(name)
        rest = [Branch(Chip("proved", "conform"), _definitions(plain), (), few(plain, 6))] if plain else []
        return [*statements, *faulty, *rest]

    def _statement(self, row: Row) -> Branch:
        below = few([id_ for id_ in row.rests_on if "/" not in id_], 5)
        group = self.groups.get(row.corrects or base(row.id))
        target = place(group, row) if group is not None else None
        return Branch(standing_chip(row), row.id, (), f"on {below}" if below else "", target=target)


def _definitions(names: Sequence[str]) -> str:
    return counted(len(names), "definition")


def _plain(row: Row) -> Chip:
    return Chip(SHAPES[row.verdict], row.verdict)


def _own_place(row: Row) -> str:
    return anchor(base(row.id), "f")


def _summary(limbs: Sequence[Limb]) -> str:
    """How many lines there are, and how many links are cut."""
    branches = [b for limb in limbs for b in limb.branches]
    cut = sum(b.cut for b in branches) + sum(leaf.cut for b in branches for leaf in b.leaves)
    arguments = [limb for limb in limbs if limb.heading.startswith("argument")]
    lines = sum(len(limb.branches) for limb in arguments)
    said = [counted(lines, "line")] if lines else []
    said += [f"{counted(cut, 'link')} cut"] if cut else ["no link cut"]
    return in_words(said)
