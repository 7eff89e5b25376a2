"""Certificates of refuted theorems, and every alteration of one that the kernel must refuse."""

import copy
import json
from fractions import Fraction
from functools import cache

import pytest

from symctrl import claim
from symctrl.certify import certificate, listing
from symctrl.counterexample import along, at, enclosed, leaves, t, undefined, unstable
from symctrl.facts import bounded, stable, stays, tends
from symctrl.kernel.certificate import Declined
from symctrl.kernel.check import check_text
from symctrl.kernel.instability import characteristic, grows, kernel, rank, restricted
from symctrl.rules.against import Refuted, contradict
from symctrl.rules.loop import Loop
from symctrl.vectors import cos, exp, sin
from tests.rules import systems


def _duffing():
    study, x, v = systems.duffing()
    return study, [tends(x - 1), tends(v), stays(x >= 5), stable(x=0, v=0)], at(x=-1, v=0)


def _friction():
    study, x, v = systems.friction()
    return study, [tends(x), tends(v)], at(x=1, v=0)


def _oscillator():
    study, x, v, _ = systems.oscillator()
    path = along(x=cos(2 * t), v=-2 * sin(2 * t), k=4)
    return study, [tends(x), bounded(v), tends(v)], path


def _decay():
    study, x = systems.scalar(lambda x: -x)
    return study, [stays(x >= 1), stays(x >= 0)], along(x=exp(-t))


def _blow_up():
    study, x = systems.scalar(lambda x: x**2)
    return study, [bounded(x)], along(x=1 / (1 - t), until=1)


def _leaves():
    study, x = systems.scalar(lambda x: -x)
    return study, [stays(x >= 1), stays(x >= 0)], leaves(x=1)


def _undefined():
    study, x, *_ = systems.quotient()
    return study, [tends(x)], undefined(x=1, y=2, a=2)


def _unstable():
    study, x, _ = systems.pendulum()
    return study, [stable(x=0, v=0), bounded(x)], unstable(x=0, v=0)


def _enclosed():
    study, x = systems.scalar(lambda x: -x)
    return study, [stays(x >= 1), stays(x >= "1/10")], enclosed(1, x=1)


def _consensus():
    study, _, y, i = systems.consensus()
    return study, [tends(y[i])], at({"y.1": 2, "y.2": 2, "y.3": 2}, graph="path:3")


CASES = {
    "at": _duffing,
    "switch": _friction,
    "along": _oscillator,
    "decay": _decay,
    "blow_up": _blow_up,
    "leaves": _leaves,
    "undefined": _undefined,
    "unstable": _unstable,
    "enclosed": _enclosed,
    "fleet": _consensus,
}


@cache
def _made(name):
    study, then, counterexample = CASES[name]()
    found = contradict(Loop(study, claim(then=then), "theorem"), counterexample, None)
    assert isinstance(found, Refuted), found
    return found.certificate


def made(name):
    whole = copy.deepcopy(_made(name))
    return whole["statement"], whole["proof"]


def answer(statement, proof):
    """All digests are recomputed: what is refused is refused for what it says."""
    for entry in statement["listings"].values():
        entry["sha256"] = listing(entry["code"], entry["outputs"])["sha256"]
    for entry in proof.get("listings", {}).values():
        entry["sha256"] = listing(entry["code"], entry["outputs"])["sha256"]
    return check_text(json.dumps(certificate(statement, proof)))


def refused(statement, proof, *why):
    found = answer(statement, proof)
    assert found.status in ("invalid", "declined"), found
    assert any(reason in found.reason for reason in why), found.reason


@pytest.mark.parametrize("name", CASES)
def test_is_accepted_and_said_to_be_false(name):
    found = answer(*made(name))
    assert found.status == "valid"
    assert "it is false that" in found.statement


@pytest.mark.parametrize("name", CASES)
def test_a_field_more_or_less(name):
    for key in made(name)[1]:
        statement, proof = made(name)
        del proof[key]
        refused(statement, proof, "lacks the field", "is not known", "has no proof", "graph")
    statement, proof = made(name)
    refused(statement, proof | {"idle": 1}, "unknown field 'idle'")


@pytest.mark.parametrize("name", [name for name in CASES if "along" not in name])
def test_other_values(name):
    statement, proof = made(name)
    for key in proof.get("values", {}):
        statement, proof = made(name)
        proof["values"][key] = str(Fraction(proof["values"][key]) + Fraction(7, 3))
        found = answer(statement, proof)
        idle = (name == "undefined" and key == "x") or (name in ("unstable", "fleet") and key in ("c", "k"))
        assert found.status == "valid" if idle else found.status in ("invalid", "declined"), key


def test_other_conclusions():
    for name, others in {
        "at": (1, 2, 3, "exists"),
        "switch": (1, "exists"),
        "along": (1, "exists"),
        "decay": (1, "exists"),
        "blow_up": (0,),
        "leaves": (1, "exists"),
        "undefined": (0,),
        "unstable": (1, "exists"),
        "enclosed": (1, "exists"),
        "fleet": ("exists",),
    }.items():
        for then in others:
            statement, proof = made(name)
            assert answer(statement, proof | {"then": then}).status == "invalid", (name, then)


@pytest.mark.parametrize("then", [9, -1, True, "tends", None, [0], 0.0])
def test_what_is_no_conclusion(then):
    statement, proof = made("at")
    assert answer(statement, proof | {"then": then}).status != "valid"


def test_another_kind():
    for name in CASES:
        statement, proof = made(name)
        for how in ("at", "leaves", "undefined", "unstable", "along", "enclosed", "other", 1):
            if how != proof["how"]:
                assert answer(statement, proof | {"how": how}).status != "valid"


def test_a_statement_that_is_no_theorem():
    statement, proof = made("at")
    statement["claim"] = {"kind": "nonnegative", "shape": [3, 1], "listing": "claim"}
    statement["motion"] = {}
    found = answer(statement, proof)
    assert found.status == "invalid"


def test_a_condition():
    statement, proof = made("at")
    statement["conditions"] = [{"kind": "nonzero", "of": "x"}]
    refused(statement, proof, "has no conditions")


@pytest.mark.parametrize(
    ("switches", "why"),
    [
        (["1/2"], "no rest point"),
        ([], "a list of 1"),
        (["-1/2", "0"], "a list of 1"),
        (["-3/2"], "from -1 to 1"),
        ("-1/2", "must be of type list"),
    ],
)
def test_other_switches(switches, why):
    statement, proof = made("switch")
    refused(statement, proof | {"switches": switches}, why)


def test_switches_where_there_is_none():
    statement, proof = made("at")
    refused(statement, proof | {"switches": ["0"]}, "a list of 0")


def _changed(statement, name, old, new):
    """Put one instruction for another in a listing."""
    code = statement["listings"][name]["code"]
    code[[step[0] for step in code].index(old)][0] = new


def test_another_field():
    statement, proof = made("at")
    _changed(statement, "motion v", "SUB", "ADD")
    refused(statement, proof, "no rest point")
    statement, proof = made("along")
    _changed(statement, "motion v", "NEG", "SQ")
    refused(statement, proof, "the rate of v")
    statement, proof = made("leaves")
    _changed(statement, "motion x", "NEG", "SQ")
    refused(statement, proof, "not left here")


def test_an_assumption_that_is_added():
    for name in ("at", "along", "leaves", "unstable"):
        statement, proof = made(name)
        statement["listings"]["own"] = listing([["INPUT", "x"], ["CONST", "9"], ["SUB", 0, 1]], [2])
        for about in ("initial", "trajectory", "parameter"):
            given = {"kind": "nonnegative", "of": ["own", 0], "text": "x >= 9", "about": about}
            changed = copy.deepcopy(statement)
            changed["given"].append(given)
            refused(changed, proof, "x >= 9")


class TestFunctions:
    def test_another_one(self):
        statement, proof = made("along")
        proof["listings"]["x of t"]["code"][0] = ["CONST", "3"]
        refused(statement, proof, "the rate of")

    @pytest.mark.parametrize("key", ["c", "k"])
    def test_other_constants(self, key):
        statement, proof = made("along")
        proof["numbers"][key] = "5"
        refused(statement, proof, "the conclusion is contradicted")

    @pytest.mark.parametrize("numbers", [{"c": "0"}, {"c": "-1"}, {"k": "-1"}, {"entry": 1}, {"entry": "0"}])
    def test_constants_that_show_nothing(self, numbers):
        statement, proof = made("along")
        proof["numbers"] |= numbers
        refused(statement, proof, "numbers: c is positive", "entry: ")

    def test_a_bound_on_time(self):
        statement, proof = made("along")
        refused(statement, proof | {"until": "100"}, "up to a time only", "assumptions", "proof of its own")
        statement, proof = made("blow_up")
        refused(statement, proof | {"until": "2"}, "sign of", "rate of x")
        statement, proof = made("blow_up")
        refused(statement, proof | {"until": None}, "sign of", "functions at all times", "given", "rate of x")

    @pytest.mark.parametrize("time", ["0", "-1", "1/1000000000"])
    def test_another_time(self, time):
        statement, proof = made("decay")
        proof["numbers"]["at"] = time
        found = answer(statement, proof)
        assert found.status == ("valid" if time.startswith("1/") else "invalid")

    def test_a_proof_less_or_of_another(self):
        statement, proof = made("along")
        roles = list(proof["proofs"])
        for role in roles:
            changed = copy.deepcopy(proof)
            del changed["proofs"][role]
            refused(statement, changed, "has no proof of its own")
        changed = copy.deepcopy(proof)
        changed["proofs"]["idle"] = changed["proofs"][roles[0]]
        refused(statement, changed, "is not wanted")
        changed = copy.deepcopy(proof)
        changed["proofs"][roles[0]] = {"given": [], "proof": {"kind": "conforms"}}
        refused(statement, changed, "is not known")

    def test_a_function_that_reads_a_state(self):
        statement, proof = made("decay")
        proof["listings"]["x of t"] = listing([["INPUT", "x"]], [0])
        refused(statement, proof, "reads x")

    def test_a_listing_with_the_name_of_another(self):
        statement, proof = made("decay")
        proof["listings"]["motion x"] = proof["listings"].pop("x of t")
        proof["functions"]["x"] = ["motion x", 0]
        refused(statement, proof, "belongs to the statement")

    @pytest.mark.parametrize("time", ["x", "t.i", "1t", ""])
    def test_a_name_that_is_no_time(self, time):
        statement, proof = made("decay")
        refused(statement, proof | {"time": time}, "name")

    def test_another_scalar(self):
        statement, proof = made("along")
        proof["functions"]["w"] = proof["functions"]["x"]
        refused(statement, proof, "unknown field 'w'")

    def test_an_idle_listing(self):
        statement, proof = made("decay")
        proof["listings"]["idle"] = listing([["CONST", "1"]], [0])
        refused(statement, proof, "is no function")

    def test_a_parameter_that_moves(self):
        statement, proof = made("along")
        proof["functions"]["k"] = proof["functions"]["x"]
        refused(statement, proof, "the parameter k is not constant")


class TestGraphs:
    @pytest.mark.parametrize(
        "graph", [[], [["1", "2"]], [["1", "2"], ["2", "1"], ["2", "3"]], [["1", "1"], ["2", "3"]], "path:3"]
    )
    def test_what_is_no_graph_of_these_nodes(self, graph):
        statement, proof = made("fleet")
        assert answer(statement, proof | {"graph": graph}).status == "invalid"

    def test_another_graph_of_these_nodes(self):
        statement, proof = made("fleet")
        edges = [["1", "2"], ["2", "3"], ["1", "3"]]
        assert answer(statement, proof | {"graph": edges}).status == "valid"


class TestTubes:
    def test_a_narrower_box(self):
        statement, proof = made("enclosed")
        low, high = proof["tube"]["end"][0]
        proof["tube"]["end"][0] = [low, str((Fraction(low) + Fraction(high)) / 2)]
        refused(statement, proof, "may miss the solution")

    def test_no_steps(self):
        statement, proof = made("enclosed")
        proof["tube"]["steps"] = []
        refused(statement, proof, "at least one step")


class TestMatrices:
    @staticmethod
    def rows(*rows):
        return [[Fraction(x) for x in row] for row in rows]

    def test_characteristic_polynomials(self):
        assert characteristic(self.rows([2])) == [1, -2]
        assert characteristic(self.rows([0, 1], [-6, -5])) == [1, 5, 6]
        assert characteristic(self.rows([0, 1, 0], [0, 0, 1], [-4, -3, -2])) == [1, 2, 3, 4]

    @pytest.mark.parametrize(
        ("coefficients", "grown"),
        [
            ([3], False),
            ([3, 2], False),
            ([0, 0], False),
            ([0, 1], False),
            ([-1, 2], True),
            ([1, 1, 6], True),
            ([6, 11, 6], False),
            ([1, 3, 3, 1][1:], False),
            ([1, 1, 1, 10], False),  # a zero in the first column decides nothing
            ([2, 1, 1, 10], True),
            ([2, 5, 8, 4][::-1], False),
            ([0, 1, 0, 4], False),
        ],
    )
    def test_roots_with_a_positive_real_part(self, coefficients, grown):
        n = len(coefficients)
        below = [[int(j == i + 1) for j in range(n)] for i in range(n - 1)]
        matrix = self.rows(*below, [-c for c in coefficients[::-1]])
        assert characteristic(matrix) == [1, *coefficients]
        assert grows(matrix) == grown

    def test_the_kernel_and_what_a_map_does_on_it(self):
        basis = kernel(self.rows([1, 1, 0]), 3)
        assert basis == self.rows([-1, 1, 0], [0, 0, 1])
        assert rank(self.rows([1, 2], [2, 4], [0, 0])) == 1
        turn = self.rows([2, 0, 0], [0, 2, 0], [0, 0, 5])
        assert restricted(turn, basis) == self.rows([2, 0], [0, 5])
        with pytest.raises(Declined, match="does not keep"):
            restricted(self.rows([2, 0, 0], [0, 3, 0], [0, 0, 5]), basis)
