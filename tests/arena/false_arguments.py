"""Theorems that are false, as certificates whose proofs pretend.

FALSE has with each name a part of the reason for which the kernel refuses it. The certificates are those of
the folder bad/: all that can be proved has its proof there, and what is false has that of something else.
`python -m tests.arena.false_arguments` writes them again.
"""

from __future__ import annotations

import json

from tests.arena.arguments import EXISTS, SQUARE, STABLE, START, V
from tests.arena.stated import ROOT, carry, say, stored, theorem, with_proofs
from tests.kernel.certificates import Json, seal

EMPTY = {"kind": "combination", "generators": [], "factors": [], "hints": [], "entries": [{"terms": []}]}
Bad = dict[str, tuple[str, Json]]


def pretending(case: Json, to_prove: tuple[int, str] | None = None, by: Json | None = None) -> Json:
    """With all proofs that are found, and that of something else for what is false."""
    whole = with_proofs(case)
    if to_prove is None:
        return whole
    n, wanted = to_prove
    lines = whole["proof"]["lines"]
    lines[n]["proofs"][wanted] = by or {"given": [], "proof": EMPTY}
    return seal(whole)


BARBALAT = ("barbalat", {"e": "x", "W": "V", "power": "2"})
ONE = {"one": "1", "less": "-1"}
FRICTION: Json = {"x": "v", "v": "x neg v sign -"}

# Each with the line and the obligation for which it pretends a proof, or None where a rule refuses it.
FALSE: dict[str, tuple[str, tuple[int, str] | None, Json]] = {
    "falls_without_a_bound": (
        "V is bounded below",
        (0, "V is bounded below"),
        theorem({"x": "1"}, ["x neg"], [say("bounded", 0)], {"V": "x neg"}, [("falls", {"V": "V"}), EXISTS]),
    ),
    "escape": (
        "x stays finite",
        None,
        theorem(
            {"x": "x x *"}, ["x"], [say("stays", 0)], {"x": "x"}, [("keeps", {"g": "x", "a": "x"}), EXISTS]
        ),
    ),
    "spikes": (
        "the rate of e is bounded",
        None,
        theorem(
            {"x": "d"},
            ["x", "x x *"],
            [say("tends", 0)],
            {**V, "d": "d"},
            [EXISTS, BARBALAT],
            scalars={"d": "signal"},
            suppose=[say("bounded", 0), say("summable", 1)],
        ),
    ),
    "product_with_what_grows": (
        "factor 1 is bounded",
        None,
        theorem(
            {"x": "x neg", "z": "1"},
            ["x z *"],
            [say("tends", 0)],
            {**V, "z": "z", "e": "x z *"},
            [*START, BARBALAT, carry("tends", "combination", e="e", of=["x"], times=["z"])],
        ),
    ),
    "offset_to_zero": (
        "no line gives the conclusion that tends",
        None,
        theorem(
            {"x": "x neg 1 +"},
            ["x"],
            [say("tends", 0)],
            {**V, **ONE},
            [("decays", {"V": "V", "a": "one", "c": "one"}), SQUARE, EXISTS],
        ),
    ),
    "finite_time_with_a_linear_law": (
        "gamma is below one",
        (0, "gamma is below one"),
        theorem(
            STABLE,
            ["x x *"],
            [say("settles", 0, zero=True)],
            {**V, "b": "2", "g": "1", "rho": "x abs"},
            [
                ("decays", {"V": "V", "b": "b", "gamma": "g", "rho": "rho"}),
                SQUARE,
                EXISTS,
            ],
        ),
    ),
    "time_too_early": (
        "the time is late enough",
        (3, "the time is late enough"),
        theorem(
            {"x": "x sign x abs 1/3 ^ * neg"},
            ["x x *", "x abs 2/3 ^"],
            [say("settles", 0, zero=True, by=1)],
            {**V, "b": "2", "g": "1/3", "rho": "x abs", "T": "x abs 2/3 ^"},
            [
                ("decays", {"V": "V", "b": "b", "gamma": "g", "rho": "rho"}),
                SQUARE,
                ("exists", {"edges": ["rho"]}),
                ("decays", {"V": "V", "b": "b", "gamma": "g", "rho": "rho", "time": "T"}),
            ],
        ),
    ),
    "radius_at_which_it_does_not_fall": (
        "V falls at the radius",
        (3, "V falls at the radius"),
        theorem(
            {"x": "x -2 * 1 +"},
            ["1/8 x x * -"],
            [say("stays", 0)],
            {**V, **ONE, "r": "1/8", "set": "1/8 x x * -"},
            [
                ("decays", {"V": "V", "a": "one", "c": "one"}),
                SQUARE,
                EXISTS,
                ("decays", {"V": "V", "a": "one", "c": "one", "radius": "r", "set": "set"}),
            ],
        ),
    ),
    "kept_at_the_boundary_only": (
        "g is kept",
        (1, "g is kept"),
        theorem(
            {"x": "x abs 1/2 ^ neg"},
            ["x"],
            [say("stays", 0)],
            {"x": "x", "size": "x abs"},
            [("exists", {"edges": ["size"]}), ("keeps", {"g": "x"})],
            suppose=[say("bounded", 0)],
        ),
    ),
    "dry_friction": (
        "the rate of v is continuous",
        None,
        theorem(
            FRICTION,
            ["x"],
            [say("tends", 0)],
            {"V": "x x * v v * +", "x": "x", "v": "v"},
            [
                ("falls", {"V": "V"}),
                SQUARE,
                carry("bounded", "square", e="v", by=["V"]),
                EXISTS,
                ("lasalle", {"V": "V", "zero": ["v"], "limit": ["x"]}),
            ],
        ),
    ),
    "damping_that_varies": (
        "has no signal",
        (4, "limit 1 vanishes on the invariant set"),
        theorem(
            {"x": "v", "v": "x neg d d * v * - v -"},
            ["x"],
            [say("tends", 0)],
            {"V": "x x * v v * +", "x": "x", "v": "v"},
            [
                ("falls", {"V": "V"}),
                SQUARE,
                carry("bounded", "square", e="v", by=["V"]),
                EXISTS,
                ("lasalle", {"V": "V", "zero": ["v"], "limit": ["x"], "order": {"rates": 1}}),
            ],
            scalars={"d": "signal"},
        ),
    ),
    "limit_set_of_an_unbounded_state": (
        "x is bounded",
        None,
        theorem(
            {"x": "1", "y": "y x x * 1 + / neg"},
            ["y"],
            [say("tends", 0)],
            {"V": "y y *", "y": "y", "q": "x x * 1 +"},
            [
                ("falls", {"V": "V"}),
                carry("bounded", "square", e="y", by=["V"]),
                ("exists", {"edges": ["q"]}),
                ("lasalle", {"V": "V", "zero": ["y"], "limit": ["y"]}),
            ],
        ),
    ),
    "damping_that_fades": (
        "limit 1 vanishes on the invariant set",
        (6, "limit 1 vanishes on the invariant set"),
        theorem(
            {"x": "v", "v": "x neg z z * v * -", "z": "z neg"},
            ["v"],
            [say("tends", 0)],
            {"V": "x x * v v * +", "Z": "z z *", "x": "x", "v": "v", "z": "z", "e": "z v *"},
            [
                ("falls", {"V": "V"}),
                ("falls", {"V": "Z"}),
                SQUARE,
                carry("bounded", "square", e="v", by=["V"]),
                carry("bounded", "square", e="z", by=["Z"]),
                EXISTS,
                ("lasalle", {"V": "V", "zero": ["e"], "limit": ["v"]}),
            ],
        ),
    ),
    "rate_with_a_switch": (
        "the rate of e has no switch",
        None,
        theorem(
            {"x": "x neg x sign -"},
            ["x x sign +"],
            [say("tends", 0)],
            {**V, "W": "x x * 2 *"},
            [
                ("falls", {"V": "V", "by": ["W"]}),
                SQUARE,
                EXISTS,
                ("barbalat", {"e": "x", "W": "W", "power": "2"}),
                ("barbalat_rate", {"e": "x"}),
            ],
        ),
    ),
    "point_outside_the_domain": (
        "V is zero at the point",
        (3, "V is zero at the point"),
        theorem(
            {"x": "y", "y": "x neg"},
            ["x"],
            [say("stable", at={"x": "0", "y": "0"})],
            {"V": "x x * y y * +", "x": "x", "y": "y", "one": "1"},
            [
                carry("bounded", "square", e="x", by=[], offset="one"),
                carry("bounded", "square", e="y", by=[], offset="one"),
                EXISTS,
                ("lyapunov", {"V": "V", "at": {"x": "0", "y": "0"}}),
            ],
            given=[("zero", "x x * y y * + 1 -", "initial")],
        ),
    ),
    "point_at_which_v_is_not_zero": (
        "V is zero at the point",
        (3, "V is zero at the point"),
        theorem(
            STABLE,
            ["x"],
            [say("stable", at={"x": "1"})],
            {**V, "U": "x x * x 1 - x 1 - * +"},
            [*START, ("lyapunov", {"V": "U", "at": {"x": "1"}})],
        ),
    ),
    "without_the_trajectory": (
        "V decays",
        (4, "V decays"),
        theorem(
            {"x": "x y y * * neg", "y": "x x * y * neg"},
            ["x"],
            [say("tends", 0)],
            {"E": "x x * y y * +", "V": "x x *", "x": "x", "y": "y", "two": "2"},
            [
                ("falls", {"V": "E"}),
                carry("bounded", "square", e="x", by=["E"]),
                carry("bounded", "square", e="y", by=["E"]),
                EXISTS,
                ("decays", {"V": "V", "a": "two"}),
                carry("tends", "square", e="x", by="V"),
            ],
            given=[("nonnegative", "y y * 1 -", "initial")],
        ),
    ),
    "edge_by_an_open_domain": (
        "is nonzero",
        (1, "x is nonzero"),
        theorem(
            {"x": "-1 x /"},
            ["x"],
            [say("bounded", 0)],
            {"V": "x x *", "x": "x"},
            [carry("bounded", "composed", e="x"), ("exists", {"edges": ["x"]})],
            given=[("positive", "x", "trajectory")],
            suppose=[say("bounded", 0)],
        ),
    ),
    "boundary_pushed_by_a_signal": (
        "a has no signal",
        None,
        theorem(
            {"x": "d x *"},
            ["x"],
            [say("stays", 0)],
            {"x": "x", "a": "d neg"},
            [EXISTS, ("keeps", {"g": "x", "a": "a"})],
            scalars={"d": "signal"},
            suppose=[say("bounded", 0)],
        ),
    ),
    "disagreement_at_zero": (
        "W bounds the power of e",
        (3, "W bounds the power of e"),
        theorem(
            {"x.*": "S.i neg"},
            ["x.i"],
            [say("tends", 0)],
            {"V": "H", "W": "F", "x": "x.i"},
            [
                ("falls", {"V": "V", "by": ["W"]}),
                carry("bounded", "square", e="x", by=["V"], total="V"),
                EXISTS,
                ("barbalat", {"e": "x", "W": "W", "power": "total", "total": "V"}),
            ],
            given=[("laplacian_bound", "B", "parameter"), ("positive", "B", "parameter")],
            scalars={"B": "parameter"},
            names={"S.*": {"is": "sum", "of": ["edge", 0]}},
            more={"edge": "x.i x.j -"},
            added={
                "H": {"is": "total", "of": ["square at i", 0]},
                "F": {"is": "total", "of": ["form at i", 0]},
            },
            own={"square at i": "x.i x.i *", "form at i": "x.i S.i *"},
        ),
    ),
}


def stored_false() -> Bad:
    found = stored("bad", FALSE)
    return {
        name: (FALSE[name][0], found[f"argument_{name}"]) for name in FALSE if f"argument_{name}" in found
    }


REFUSED: Bad = stored_false()
CASES: dict[str, Json] = {f"argument_{name}": case for name, (_, case) in REFUSED.items()}

if __name__ == "__main__":
    for name, (_, pretended, case) in FALSE.items():
        text = json.dumps(pretending(case, pretended), sort_keys=True)
        (ROOT / "bad" / f"argument_{name}.json").write_text(text + "\n", encoding="utf-8")
