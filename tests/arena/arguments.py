"""Small theorems by argument, one or more for each rule, as the arena stores them.

The certificates are those of the folder good/. `python -m tests.arena.arguments` looks for their proofs
again, from the statements and lines below, and writes them there.
"""

from __future__ import annotations

from tests.arena.stated import Lines, carry, say, stored, theorem, write
from tests.kernel.certificates import Json

V = {"V": "x x *", "x": "x"}
FALLS: tuple[str, Json] = ("falls", {"V": "V", "by": ["V"]})
SQUARE = carry("bounded", "square", e="x", by=["V"])
EXISTS: tuple[str, Json] = ("exists", {})
START: Lines = [FALLS, SQUARE, EXISTS]
STABLE = {"x": "x neg"}
OSCILLATOR = {"x": "v", "v": "x neg v -"}
ENERGY = {"V": "x x * v v * +", "W": "v v * 2 *", "x": "x", "v": "v", "dv": "x neg v -", "less": "-1"}
SWING: Lines = [
    ("falls", {"V": "V", "by": ["W"]}),
    SQUARE,
    carry("bounded", "square", e="v", by=["V"]),
    EXISTS,
]
LASALLE = {"V": "V", "zero": ["v"], "limit": ["x", "v"], "order": {"rates": 1}}
DECAY = {"V": "x x *", "x": "x", "a": "k 2 *", "k": "k"}
POWER = {"V": "V", "b": "b2", "gamma": "g", "rho": "rho"}
ROOT_RATE = {"V": "x x *", "x": "x", "b2": "b 2 *", "g": "1/3", "rho": "x abs", "T": "x abs 2/3 ^ 3/2 * b /"}
ULTIMATE = {"V": "x x *", "x": "x", "one": "1", "four": "4", "set": "4 x x * -", "wide": "5 x x * -"}
INTO = {"V": "V", "a": "one", "c": "one"}
OUTSIDE = {"V": "V", "radius": "one", "rate": "two", "set": "set", "beyond": "beyond"}
OUTER = {"V": "x x *", "x": "x", "one": "1", "two": "2", "set": "1 x x * -", "beyond": "x x * 1 -"}
OUTER |= {"T": "x x * 2 /"}
PLANE = {"x": "x neg", "y": "y neg"}
POSITIVE_K = ("positive", "k", "parameter")
FLEET = {"S.*": {"is": "sum", "of": ["edge", 0]}}
HALF = {"half": "H", "x": "x.i", "h": "1/2", "form": "F", "e": "x.i x.j -", "squares": "Q", "two": "2"}
HALF |= {"whole": "A"}
TOTALS = {
    "H": {"is": "total", "of": ["half at i", 0]},
    "F": {"is": "total", "of": ["form at i", 0]},
    "Q": {"is": "total", "of": ["squares at i", 0]},
    "A": {"is": "total", "of": ["whole at i", 0]},
    "R.*": {"is": "sum", "of": ["square of an edge", 0]},
}

STATEMENTS: dict[str, Json] = {
    "falls": theorem(STABLE, ["x x *"], [say("bounded", 0), say("summable", 0)], V, START),
    "decays": theorem(
        {"x": "x k * neg"},
        ["x", "k"],
        [say("exponentially", 0, by=1), say("tends", 0)],
        DECAY,
        [
            ("decays", {"V": "V", "a": "a"}),
            SQUARE,
            EXISTS,
            carry("exponentially", "square", e="x", by="V", half="k", rate="a"),
            carry("tends", "square", e="x", by="V"),
        ],
        given=[POSITIVE_K],
        scalars={"k": "parameter"},
    ),
    "decays_in_finite_time": theorem(
        {"x": "x sign x abs 1/3 ^ * b * neg"},
        ["x x *", "x abs 2/3 ^ 3/2 * b /"],
        [say("settles", 0, zero=True, by=1)],
        ROOT_RATE,
        [("decays", POWER), SQUARE, ("exists", {"edges": ["rho"]}), ("decays", {**POWER, "time": "T"})],
        given=[("positive", "b", "parameter")],
        scalars={"b": "parameter"},
    ),
    "decays_into_a_set": theorem(
        {"x": "x -2 * 1 +"},
        ["4 x x * -", "5 x x * -"],
        [say("stays", 0), say("settles", 0), say("eventually", 1)],
        ULTIMATE,
        [
            ("decays", INTO),
            SQUARE,
            EXISTS,
            ("decays", {**INTO, "radius": "four", "set": "set"}),
            carry("eventually", "set", of_zeros="no", e=["wide"], by_zeros="no", by=["set"]),
        ],
    ),
    "decays_with_an_input": theorem(
        {"x": "x neg d +"},
        ["x", "d"],
        [say("tends", 0)],
        {"V": "x x *", "x": "x", "d": "d", "w": "d d *", "one": "1"},
        [
            ("decays", {"V": "V", "a": "one", "input": "w"}),
            SQUARE,
            EXISTS,
            carry("tends", "combination", e="w", of=["d"], times=["d"]),
            ("decays", {"V": "V", "a": "one", "input": "w"}),
            carry("tends", "square", e="x", by="V"),
        ],
        scalars={"d": "signal"},
        suppose=[say("tends", 1)],
    ),
    "outside": theorem(
        STABLE,
        ["1 x x * -", "x x * 2 /"],
        [say("stays", 0), say("settles", 0, by=1)],
        OUTER,
        [("outside", OUTSIDE), SQUARE, EXISTS, ("outside", {**OUTSIDE, "time": "T"})],
    ),
    "keeps": theorem(
        {"x": "x 1 x - *"},
        ["x"],
        [say("stays", 0), say("bounded", 0)],
        {"x": "x", "a": "x 1 -", "h": "1 x -", "one": "1"},
        [
            ("keeps", {"g": "x", "a": "a"}),
            ("keeps", {"g": "h", "a": "x"}),
            carry("bounded", "square", e="x", by=[], offset="one"),
            EXISTS,
        ],
        given=[("nonnegative", "x", "initial"), ("nonnegative", "1 x -", "initial")],
    ),
    "carries_form": theorem(
        PLANE,
        ["x", "y"],
        [say("bounded", 0, 1)],
        {"V": "x x * x y * + y y * + 2 *", "x": "x", "y": "y", "one": "1", "two": "2"},
        [
            ("falls", {"V": "V", "by": []}),
            carry("bounded", "form", e=["x", "y"], P=["two", "one", "one", "two"], by=["V"]),
            EXISTS,
        ],
    ),
    "carries_rate": theorem(
        {"x": "x neg", "y": "x x *"},
        ["y", "x y +", "y y * x +"],
        [say("bounded", 0, 1, 2)],
        {**V, "y": "y", "s": "x y +", "c": "y y * x +", "one": "1"},
        [
            FALLS,
            SQUARE,
            carry("bounded", "rate", e="y", by="V"),
            EXISTS,
            carry("bounded", "combination", e="s", of=["x", "y"], times=["one", "one"]),
            carry("bounded", "composed", e="c"),
        ],
    ),
    "carries_apart": theorem(
        STABLE,
        ["x x * 1 +", "k 2 *", "x x * 1 + 2 *", "x x * 2 *", "x x x * 1 + /", "x"],
        [say("apart", 0), say("apart", 1), say("apart", 2), say("summable", 3), say("tends", 4)],
        {
            **V,
            "k": "k",
            "kk": "k 2 *",
            "q": "x x * 1 +",
            "qq": "x x * 1 + 2 *",
            "one": "1",
            "two": "2",
            "twice": "x x * 2 *",
            "e": "x x x * 1 + /",
        },
        [
            *START,
            carry("apart", "square", e="q", least="one"),
            carry("apart", "constant", e="k"),
            carry("apart", "multiple", e="kk", by="k", times="two"),
            carry("apart", "above", e="qq", by="q"),
            carry("summable", "parts", e="twice", by=["V", "V"]),
            ("barbalat", {"e": "x", "W": "V", "power": "2"}),
            carry("tends", "combination", e="e", of=["x"], times=["one"], divisor="q"),
        ],
        given=[POSITIVE_K],
        scalars={"k": "parameter"},
    ),
    "exists_with_an_edge": theorem(
        {"x": "x x x * 1 + / neg"},
        ["x"],
        [say("bounded", 0)],
        {**V, "q": "x x * 1 +"},
        [("falls", {"V": "V", "by": []}), SQUARE, ("exists", {"edges": ["q"]})],
    ),
    "barbalat_1": theorem(
        {"x": "x sign neg"},
        ["x"],
        [say("tends", 0)],
        {"V": "x x *", "W": "x abs", "x": "x"},
        [
            ("falls", {"V": "V", "by": ["W"]}),
            SQUARE,
            EXISTS,
            ("barbalat", {"e": "x", "W": "W", "power": "1"}),
        ],
    ),
    "barbalat_p": theorem(
        {"x": "x x abs 1/2 ^ * neg"},
        ["x"],
        [say("tends", 0)],
        {"V": "x x * 1/2 *", "x": "x", "W": "x abs 5/2 ^", "p": "5/2", "half": "1/2", "size": "x abs"},
        [
            ("falls", {"V": "V", "by": ["W"]}),
            carry("bounded", "square", e="x", by=["V"], least="half"),
            ("exists", {"edges": ["size"]}),
            ("barbalat", {"e": "x", "W": "W", "power": "p", "p": "p"}),
        ],
    ),
    "barbalat_with_a_rate": theorem(
        STABLE,
        ["x x *"],
        [say("tends", 0)],
        {**V, "S": "x x * 2 *"},
        [
            ("falls", {"V": "V", "by": ["S"]}),
            SQUARE,
            EXISTS,
            ("barbalat", {"e": "V", "W": "S", "power": "1", "rate": "S"}),
        ],
    ),
    "barbalat_rate": theorem(
        OSCILLATOR,
        ["x", "v"],
        [say("tends", 0, 1)],
        ENERGY,
        [
            *SWING,
            ("barbalat", {"e": "v", "W": "W", "power": "2"}),
            ("barbalat_rate", {"e": "v"}),
            carry("tends", "combination", e="x", of=["dv", "v"], times=["less", "less"]),
        ],
    ),
    "lasalle": theorem(OSCILLATOR, ["x", "v"], [say("tends", 0, 1)], ENERGY, [*SWING, ("lasalle", LASALLE)]),
    "lasalle_implied": theorem(
        OSCILLATOR,
        ["x", "v"],
        [say("tends", 0, 1)],
        ENERGY,
        [*SWING, ("lasalle", {**LASALLE, "implied": {"x": [["less", "v", 1], ["less", "v", 0]]}})],
    ),
    "lyapunov": theorem(
        STABLE,
        ["x"],
        [say("stable", at={"x": "0"})],
        V,
        [*START, ("lyapunov", {"V": "V", "at": {"x": "0"}})],
    ),
    "lyapunov_in_a_ball": theorem(
        {"x": "x neg x x * x * +"},
        ["x"],
        [say("stable", at={"x": "0"})],
        {**V, "g": "1 x x * -", "a": "x x * -2 *", "one": "1", "r": "1/4", "in": "1/4 x x * -"},
        [
            ("keeps", {"g": "g", "a": "a"}),
            carry("bounded", "square", e="x", by=[], offset="one"),
            EXISTS,
            ("lyapunov", {"V": "V", "at": {"x": "0"}, "least": "one", "radius": "r", "inside": "in"}),
        ],
        given=[("nonnegative", "1 x x * -", "initial")],
    ),
    "equation_with_a_cofactor": theorem(
        {"x": "y x x x * y y * + * - x +", "y": "x neg y x x * y y * + * - y +"},
        ["x", "y"],
        [say("bounded", 0, 1)],
        {"x": "x", "y": "y", "one": "1", "c": "x x * y y * + -2 *"},
        [
            carry("bounded", "square", e="x", by=[], offset="one"),
            carry("bounded", "square", e="y", by=[], offset="one"),
            EXISTS,
        ],
        given=[("zero", "x x * y y * + 1 -", "initial")],
        cofactors={"relation1": "c"},
    ),
    "along_a_trajectory": theorem(
        {"x": "x y y * * neg", "y": "x x * y * neg"},
        ["x"],
        [say("tends", 0)],
        {"E": "x x * y y * +", "V": "x x *", "x": "x", "y": "y", "two": "2"},
        [
            ("falls", {"V": "E", "by": []}),
            carry("bounded", "square", e="x", by=["E"]),
            carry("bounded", "square", e="y", by=["E"]),
            EXISTS,
            ("decays", {"V": "V", "a": "two"}),
            carry("tends", "square", e="x", by="V"),
        ],
        given=[("nonnegative", "y y * 1 -", "trajectory")],
    ),
    "fleet_node_by_node": theorem(
        {"x.*": "x.i neg"},
        ["x.i", "T"],
        [say("tends", 0, 1)],
        {"V": "Q", "W": "D", "x": "x.i", "T": "T"},
        [
            ("falls", {"V": "V", "by": ["W"]}),
            carry("bounded", "square", e="x", by=["V"], total="V"),
            EXISTS,
            ("barbalat", {"e": "x", "W": "W", "power": "total", "total": "V"}),
            carry("tends", "sum", e="T", by="x"),
        ],
        names={"T": {"is": "total", "of": ["term", 0]}},
        more={"term": "x.i"},
        added={
            "Q": {"is": "total", "of": ["square at i", 0]},
            "D": {"is": "total", "of": ["twice at i", 0]},
        },
        own={"square at i": "x.i x.i *", "twice at i": "x.i x.i * 2 *"},
    ),
    "fleet_mode_by_mode": theorem(
        {"x.*": "S.i neg"},
        ["x.i", "x.i x.j -"],
        [say("bounded", 0), say("tends", 1)],
        HALF,
        [
            ("falls", {"V": "half", "by": ["form"]}),
            carry("bounded", "square", e="x", by=["half"], total="whole", least="h"),
            EXISTS,
            ("barbalat", {"e": "form", "W": "form", "power": "1"}),
            carry("tends", "combination", e="squares", of=["form"], times=["two"]),
            carry("tends", "square", e="e", by="squares", total="squares"),
        ],
        given=[("laplacian_bound", "B", "parameter"), ("positive", "B", "parameter")],
        scalars={"B": "parameter"},
        names=FLEET,
        more={"edge": "x.i x.j -"},
        added=TOTALS,
        own={
            "half at i": "x.i x.i * 1/2 *",
            "form at i": "x.i S.i *",
            "squares at i": "R.i",
            "square of an edge": "x.i x.j - sq",
            "whole at i": "x.i x.i *",
        },
    ),
}

CASES: dict[str, Json] = stored("good", STATEMENTS)

if __name__ == "__main__":
    write("good", STATEMENTS)
