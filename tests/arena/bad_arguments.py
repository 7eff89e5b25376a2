"""Right arguments with one place altered, each with a part of the reason for which the kernel refuses it."""

from __future__ import annotations

from typing import Any

from tests.arena.arguments import CASES as GOOD
from tests.arena.changes import changed, more
from tests.arena.stated import postfix
from tests.kernel.certificates import Json

G = {name.removeprefix("argument_"): case for name, case in GOOD.items()}
Bad = dict[str, tuple[str, Json]]


def proofs(name: str, n: int) -> Json:
    return G[name]["proof"]["lines"][n]["proofs"]


def proved_by(name: str, n: int, role: str, entry: Json) -> Json:
    """With another proof of one obligation."""
    return changed(G[name], "proof", "lines", n, "proofs", role, to=entry)


def given_numbers(name: str, n: int, role: str, numbers: list[int]) -> Json:
    return changed(G[name], "proof", "lines", n, "proofs", role, "given", to=numbers)


def without_line(name: str, n: int) -> Json:
    return changed(G[name], "proof", "lines", n, to=...)


def ordered(name: str, *order: int) -> Json:
    lines = G[name]["proof"]["lines"]
    return changed(G[name], "proof", "lines", to=[lines[k] for k in order])


def role(name: str, n: int, key: str, value: Any) -> Json:
    """With a role of a line set, or left out (`...`)."""
    return changed(G[name], "proof", "lines", n, "of", key, to=value)


def concluding(name: str, **what: Any) -> Json:
    """With another first conclusion."""
    first = {**G[name]["statement"]["claim"]["then"][0], **what}
    return changed(G[name], "statement", "claim", "then", 0, to=first)


def quantity(name: str, q: str, formula: str) -> Json:
    return changed(G[name], "proof", "listings", q, to=postfix(formula))


def moving(name: str, x: str, formula: str) -> Json:
    return changed(G[name], "statement", "listings", f"rate of {x}", to=postfix(formula))


EMPTY = {"kind": "combination", "generators": [], "factors": [], "hints": [], "entries": [{"terms": []}]}
OTHER: Json = proofs("decays", 0)["the rate is positive"]

BAD: Bad = {
    "weaker_obligation": ("V decays: ", proved_by("decays", 0, "V decays", OTHER)),
    "nothing_proved": ("V falls: ", proved_by("falls", 0, "V falls", {"given": [], "proof": EMPTY})),
    "proof_of_fewer_parts": (
        "part 2 is not negative has no proof",
        role("falls", 0, "by", ["V", "V"]),
    ),
    "obligation_left_out": (
        "V is bounded below has no proof of its own",
        proved_by("falls", 0, "V is bounded below", ...),
    ),
    "both_sides_by_one_proof": (
        "W bounds minus e has no proof of its own",
        proved_by("barbalat_1", 3, "W bounds minus e", ...),
    ),
    "proof_too_many": (
        "is not wanted",
        proved_by("falls", 0, "V is small", proofs("falls", 0)["V falls"]),
    ),
    "role_left_out": ("V is no quantity", role("falls", 0, "V", ...)),
    "role_too_many": ("the rule has no role 'a'", role("falls", 0, "a", "V")),
    "role_of_another_kind": ("must be of type list", role("falls", 0, "by", "V")),
    "quantity_of_the_statement": ("V is no quantity", role("falls", 0, "V", "claim")),
    "line_left_out": ("bound 1 is bounded", without_line("falls", 0)),
    "existence_left_out": ("no line gives the conclusion that exists", without_line("falls", 2)),
    "lines_swapped": ("bound 1 is bounded", ordered("falls", 1, 0, 2)),
    "existence_before_bounds": ("x stays finite", ordered("falls", 2, 0, 1)),
    "barbalat_before_existence": ("existence", ordered("barbalat_1", 0, 1, 3, 2)),
    "limit_before_the_rate": ("part 1: tends", ordered("barbalat_rate", 0, 1, 2, 3, 4, 6, 5)),
    "kept_after_it_is_used": (" is not an integer from", ordered("keeps", 1, 0, 2, 3)),
    "another_word": ("no line gives the conclusion that tends", concluding("falls", word="tends")),
    "another_output": ("no line gives", concluding("decays", of=[1])),
    "another_time": ("no line gives", concluding("decays_in_finite_time", by=0)),
    "another_set": ("no line gives", concluding("decays_into_a_set", of=[1])),
    "zeros_for_signs": ("no line gives", concluding("decays_into_a_set", zero=True)),
    "a_rate_that_is_not_its_own": ("no line gives", concluding("decays", by=0)),
    "another_point": ("no line gives", concluding("lyapunov", at={"x": "1"})),
    "another_point_in_the_line": ("V is zero at the point", role("lyapunov", 3, "at", {"x": "1"})),
    "point_of_no_state": ("every state is named", role("lyapunov", 3, "at", {"V": "0"})),
    "formula_of_a_conclusion": (
        "no line gives",
        changed(G["falls"], "statement", "listings", "claim", to=postfix("x x * x *")),
    ),
    "another_quantity": ("part 1 is not negative", quantity("falls", "V", "x x * x *")),
    "another_motion": ("V falls", moving("falls", "x", "x")),
    "motion_that_the_argument_brings": (
        "motion of x is not the argument's to say",
        changed(G["falls"], "proof", "motion", to={"x": ["V", 0]}),
    ),
    "motion_of_a_signal_brought": (
        "motion of d is not the argument's to say",
        changed(G["decays_with_an_input"], "proof", "motion", to={"d": ["d", 0]}),
    ),
    "scalar_that_shadows": (
        "k belongs to the statement",
        changed(G["decays"], "proof", "scalars", to={"k": "parameter"}),
    ),
    "name_that_shadows": (
        "is both a scalar and a name",
        changed(G["falls"], "proof", "names", to={"x": {"is": "value", "of": ["V", 0]}}),
    ),
    "listing_that_shadows": (
        "claim belongs to the statement",
        changed(G["falls"], "proof", "listings", "claim", to=postfix("x")),
    ),
    "listing_of_a_rate": (
        "belongs to the rules",
        changed(G["falls"], "proof", "listings", "V'", to=postfix("x")),
    ),
    "scalar_of_a_rate": (
        "belongs to the rules",
        changed(G["falls"], "proof", "scalars", to={"rate1_V": "parameter"}),
    ),
    "quantity_twice": ("named twice", more(G["falls"], "proof", "quantities", by="V")),
    "quantity_that_is_not_listed": (
        "no listing of one output",
        more(G["falls"], "proof", "quantities", by="W"),
    ),
    "cofactor_that_jumps": (
        "jumps",
        quantity("equation_with_a_cofactor", "c", "x x * y y * + -2 * x sign +"),
    ),
    "cofactor_that_is_another": ("is kept: ", quantity("equation_with_a_cofactor", "c", "x x * -2 *")),
    "cofactor_left_out": (
        "is kept: ",
        changed(G["equation_with_a_cofactor"], "proof", "cofactors", to={}),
    ),
    "cofactor_that_is_no_quantity": (
        "a cofactor or an edge is no quantity",
        changed(G["equation_with_a_cofactor"], "proof", "cofactors", "relation1", to="claim"),
    ),
    "equation_that_is_not_shown_to_be_kept": (
        "is kept has no proof",
        changed(G["equation_with_a_cofactor"], "proof", "relations", to={}),
    ),
    "edge_that_is_not_named": ("the field stays defined", role("exists_with_an_edge", 2, "edges", [])),
    "edge_in_vain": ("named in vain", role("exists_with_an_edge", 2, "edges", ["q", "V"])),
    "edge_of_a_root_that_is_not_named": (
        "the field stays defined",
        role("decays_in_finite_time", 2, "edges", []),
    ),
    "assumption_out_of_range": ("is not an integer from", given_numbers("decays", 0, "V decays", [1])),
    "assumption_twice": ("numbered in order, each once", given_numbers("decays", 0, "V decays", [0, 0])),
    "assumption_of_the_beginning": ("is not an integer from", given_numbers("keeps", 0, "g is kept", [0])),
    "trajectory_taken_for_the_beginning": (
        "is not an integer from",
        changed(G["along_a_trajectory"], "statement", "given", 0, "about", to="initial"),
    ),
    "what_is_supposed_left_out": (
        "the input is known",
        changed(G["decays_with_an_input"], "statement", "claim", "suppose", to=[]),
    ),
    "half_rate_that_is_whole": ("the rate is half that of V", role("decays", 3, "half", "a")),
    "order_too_high": ("the order is a number of rates", role("lasalle", 4, "order", {"rates": 6})),
    "order_too_low": ("limit 1 vanishes", role("lasalle", 4, "order", {"rates": 0})),
    "order_that_is_true": ("the order is a number of rates", role("lasalle", 4, "order", {"rates": True})),
    "zero_that_is_none": ("V' = 0 gives zero 1", role("lasalle", 4, "zero", ["x"])),
    "implied_by_other_factors": (
        "is a combination of rates",
        role("lasalle_implied", 4, "implied", {"x": [["less", "v", 1]]}),
    ),
    "implied_by_what_is_no_zero": (
        "a part is a factor, a zero",
        role("lasalle_implied", 4, "implied", {"x": [["less", "x", 0]]}),
    ),
    "form_of_another_matrix": (
        "P is positive definite",
        role("carries_form", 1, "P", ["two", "one", "one", "one"]),
    ),
    "form_that_is_not_square": ("P is square", role("carries_form", 1, "P", ["two", "one"])),
    "way_that_there_is_not": ("is not carried by", role("falls", 1, "how", "above")),
    "fewer_factors_than_parts": (
        "there is a factor for each part",
        role("barbalat_rate", 6, "times", ["less"]),
    ),
    "ball_without_its_radius": (
        "V grows with the distance, ",
        role("lyapunov_in_a_ball", 3, "radius", ...),
    ),
    "total_of_another_square": ("is not the sum of the squares", role("fleet_node_by_node", 1, "total", "W")),
    "sum_of_another_term": ("is not the sum over nodes", role("fleet_node_by_node", 4, "e", "V")),
    "term_of_another_sum": (
        "part 1 is not negative",
        changed(G["fleet_node_by_node"], "proof", "listings", "twice at i", to=postfix("x.i x.i * -2 *")),
    ),
    "modes_without_a_bound": (
        "does not bound the eigenvalues",
        changed(G["fleet_mode_by_mode"], "statement", "given", 0, "kind", to="nonnegative"),
    ),
}

CASES: dict[str, Json] = {f"argument_{name}": case for name, (_, case) in BAD.items()}
DECLINED: dict[str, tuple[str, Json]] = {
    "argument_rule_that_is_not_known": (
        "declined",
        changed(G["falls"], "proof", "lines", 0, "rule", to="energy"),
    ),
    "argument_proof_that_is_not_known": (
        "declined",
        changed(G["falls"], "proof", "lines", 0, "proofs", "V falls", "proof", "kind", to="oracle"),
    ),
}
