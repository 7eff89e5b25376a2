"""Arguments and counterexamples with one place altered: refused, or a right proof of what is then stated.

That an altered theorem holds, or is refuted by an altered solution, is confirmed by solutions that are
computed step by step with floating point numbers, which share no code with the kernel.
"""

from __future__ import annotations

import copy
import json
import math
from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings

from symctrl.kernel.certificate import digest
from symctrl.kernel.check import check_text
from tests.arena.arguments import CASES as ARGUMENTS
from tests.arena.stated import postfix
from tests.kernel.certificates import Json, seal
from tests.kernel.test_against import CASES as COUNTEREXAMPLES
from tests.kernel.test_against import _made
from tests.kernel.test_mutations import WORDS, alterations

STEP, END = 0.02, 40.0
HUGE, SMALL = 1e6, 0.3
State = dict[str, float]
Path = list[tuple[float, State]]
SETS = ("stays", "enters", "settles", "eventually")


def certificate_of(name: str) -> Json:
    return ARGUMENTS[name] if name in ARGUMENTS else json.loads(json.dumps(_made(name)))


def resealed(certificate: Json) -> Json | None:
    """With all digests recomputed, where there is still something to take them of."""
    try:
        for one in certificate["proof"].get("listings", {}).values():
            one["sha256"] = digest({"code": one["code"], "outputs": one["outputs"]})
        return seal(certificate)
    except (KeyError, TypeError, AttributeError):
        return None


def said(statement: Json) -> Json:
    """The statement without the words that the certificate brings."""
    plain = {key: value for key, value in statement.items() if key not in WORDS}
    return {**plain, "given": [{**one, "text": ""} for one in statement["given"]]}


@pytest.mark.parametrize("name", [*ARGUMENTS, *COUNTEREXAMPLES])
def test_an_altered_certificate_is_refused_or_right(name):
    certificate = certificate_of(name)
    assert check_text(json.dumps(certificate)).status == "valid"

    @settings(max_examples=60, deadline=None, database=None, suppress_health_check=list(HealthCheck))
    @given(alterations(certificate))
    def check(altered):
        _, other = altered
        again = resealed(other)
        if again is None or again == certificate or check_text(json.dumps(again)).status != "valid":
            return
        if said(again["statement"]) != said(certificate["statement"]):
            confirm(again)

    check()


def confirm(certificate: Json) -> None:
    """Solutions do what the theorem says, or the one that is offered does not."""
    statement, proof = certificate["statement"], certificate["proof"]
    if any("*" in key for key in statement["scalars"]):
        return
    system = System(statement)
    if proof["kind"] == "argument":
        for begin in system.beginnings():
            path = system.solution(begin)
            if all(system.meets(one, path) for one in statement["given"]):
                assert path[-1][0] >= END - 2 * STEP, "a solution ends"
                for sentence in statement["claim"]["then"]:
                    assert system.holds(sentence, path), json.dumps(sentence)
        return
    if "values" not in proof or proof["then"] == "exists":
        return
    begin = {name: number(value) for name, value in proof["values"].items()}
    sentence = statement["claim"]["then"][proof["then"]]
    if sentence["word"] in ("tends", "stays", "bounded", *SETS):
        path = system.solution(begin)
        assert not system.holds(sentence, path), json.dumps(sentence)


def number(text: Any) -> float:
    top, _, bottom = str(text).partition("/")
    return int(top) / int(bottom or 1)


UNARY: dict[str, Callable[[float], float]] = {
    "NEG": lambda a: -a,
    "SQ": lambda a: a * a,
    "TWICE": lambda a: a + a,
    "FABS": abs,
    "SIGN": lambda a: float((a > 1e-3) - (a < -1e-3)) if abs(a) > 1e-3 else a / 1e-3,
    "INV": lambda a: 1 / a,
    "SIN": math.sin,
    "COS": math.cos,
    "EXP": math.exp,
    "TANH": math.tanh,
    "SQRT": math.sqrt,
}
BINARY: dict[str, Callable[[float, float], float]] = {
    "ADD": lambda a, b: a + b,
    "SUB": lambda a, b: a - b,
    "MUL": lambda a, b: a * b,
    "DIV": lambda a, b: a / b,
    "POW": lambda a, b: a**b,
    "FMIN": min,
    "FMAX": max,
}


class System:
    """The closed loop of a statement for one vehicle, with floating point numbers."""

    def __init__(self, statement: Json) -> None:
        self.statement = statement
        self.law = statement["laws"].get(statement["claim"]["law"], {})

    def value(self, ref: list[Any], at: State) -> float:
        name, k = ref
        listing = self.statement["listings"][name]
        work: list[float] = []
        for op, *args in listing["code"]:
            if op == "INPUT":
                work.append(self.read(args[0], at))
            elif op == "CONST":
                work.append(number(args[0]))
            elif op in UNARY:
                work.append(UNARY[op](work[args[0]]))
            else:
                work.append(BINARY[op](work[args[0]], work[args[1]]))
        return float(work[listing["outputs"][k]])

    def read(self, name: str, at: State) -> float:
        if name in self.law:
            return self.value(self.law[name], at)
        return at[name] if name in at else self.value(self.statement["names"][name]["of"], at)

    def beginnings(self) -> Iterator[State]:
        """Values of states and parameters; signals vanish with time."""
        kinds = self.statement["scalars"]
        names = [name for name, kind in kinds.items() if kind != "input"]
        few = (-1.5, 0.4, 1.0) if len(names) < 4 else (0.4, -1.0)
        for values in product(*[few if kinds[name] != "parameter" else (1.0, 2.5) for name in names]):
            yield dict(zip(names, values, strict=True))

    def now(self, at: State, t: float) -> State:
        """With the values of signals at the time."""
        kinds, moving = self.statement["scalars"], self.statement["motion"]
        free = [name for name in at if kinds[name] == "signal" and name not in moving]
        return {**at, **{name: at[name] * math.exp(-t) for name in free}}

    def rates(self, at: State, t: float) -> State:
        now = self.now(at, t)
        return {name: self.value(ref, now) for name, ref in self.statement["motion"].items()}

    def solution(self, begin: State) -> Path:
        """By Heun's method, up to where there is no value or it is huge."""
        t, at = 0.0, dict(begin)
        path = [(t, at)]
        while t < END:
            try:
                first = self.rates(at, t)
                guess = {**at, **{n: at[n] + STEP * r for n, r in first.items()}}
                second = self.rates(guess, t + STEP)
            except (ArithmeticError, ValueError, TypeError):
                return path
            at = {**at, **{n: at[n] + STEP * (first[n] + second[n]) / 2 for n in first}}
            if any(abs(at[n]) > HUGE for n in first):
                return path
            t += STEP
            path.append((t, self.now(at, t)))
        return path

    def meets(self, one: Json, path: Path) -> bool:
        """Is the assumption met: at the beginning, or at all times if it is about them?"""
        tests = {
            "zero": lambda x: abs(x) < 1e-9,
            "nonzero": lambda x: x != 0,
            "positive": lambda x: x > 0,
            "nonnegative": lambda x: x >= 0,
        }
        if one["kind"] not in tests:
            return False
        places = path if one["about"] == "trajectory" else path[:1]
        try:
            return all(tests[one["kind"]](self.value(one["of"], at)) for _, at in places)
        except (ArithmeticError, ValueError, TypeError):
            return False

    def holds(self, sentence: Json, path: Path) -> bool:
        """What a conclusion says, as far as a solution for a finite time shows it."""
        claim = self.statement["claim"]["listing"]
        for k in sentence["of"]:
            values = [self.value([claim, k], at) for _, at in path]
            late = values[len(values) * 9 // 10 :]
            if not self._one(sentence, path, values, late, claim):
                return False
        return True

    def _one(
        self,
        sentence: Json,
        path: Path,
        values: list[float],
        late: list[float],
        claim: str,
    ) -> bool:
        word, near = sentence["word"], max(map(abs, late))
        if word == "tends":
            return near < SMALL
        if word == "bounded":
            return near < 1e4
        if word == "summable":
            return STEP * sum(map(abs, values[len(values) // 2 :])) < SMALL
        if word == "apart":
            return min(map(abs, values)) > 1e-4
        if word == "exponentially":
            rate = self.value([claim, sentence["by"]], path[0][1]) if "by" in sentence else 0.0
            soon = [(t, x) for (t, _), x in zip(path, values, strict=True) if rate * t < 10]
            return all(abs(x) * math.exp(rate * t) < 50 for t, x in soon)
        if word == "stays" and (values[0] < 0 or (sentence.get("zero") and values[0])):
            return True
        inside = values if word == "stays" else late
        return all(abs(x) < 0.05 if sentence.get("zero") else x > -0.05 for x in inside)


@pytest.mark.parametrize(
    ("name", "listing", "formula"),
    [
        ("argument_falls", "rate of x", "x"),
        ("argument_decays", "claim", "k 2 *"),
        ("argument_barbalat_rate", "rate of v", "x neg"),
        ("decay", "claim", None),
    ],
)
def test_what_does_not_hold_is_noticed(name, listing, formula):
    """The confirmation itself finds a false theorem, and a solution that contradicts nothing."""
    other = copy.deepcopy(certificate_of(name))
    if formula is None:
        other["proof"]["values"], other["proof"]["then"] = {"x": "1"}, 1
    elif listing == "claim":
        other["statement"]["listings"][listing] = postfix("x", formula)
    else:
        other["statement"]["listings"][listing] = postfix(formula)
    with pytest.raises(AssertionError):
        confirm(other)
