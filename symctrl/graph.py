"""The one graph and the one walk.

A CasADi SX `Function` is a flat list of scalar instructions. `read` turns it into a `Tape`, plain data in
static single assignment form, and `interpret` evaluates a tape (or a Function) in any `Domain`. A new
analysis is a new domain, never a second walk.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeVar

import casadi as ca

if TYPE_CHECKING:
    from symctrl.domains.domain import Domain

Value = TypeVar("Value")

# Every scalar opcode that a CasADi SX function can hold and that has a meaning in at least one domain,
# with its number of arguments.
ARITY: Mapping[str, int] = {
    **dict.fromkeys(
        "NEG EXP LOG SQRT SQ TWICE SIN COS TAN ASIN ACOS ATAN SINH COSH TANH ASINH ACOSH ATANH "
        "FABS SIGN FLOOR CEIL NOT ERF ERFINV INV LOG1P EXPM1".split(),
        1,
    ),
    **dict.fromkeys(
        "ADD SUB MUL DIV POW CONSTPOW LT LE EQ NE AND OR FMOD REMAINDER COPYSIGN IF_ELSE_ZERO FMIN FMAX "
        "ATAN2 HYPOT".split(),
        2,
    ),
}
_TRANSPARENT = frozenset(("ASSIGN", "LIFT"))
_OPCODE_NAMES = {getattr(ca, name): name[3:] for name in dir(ca) if name.startswith("OP_")}
MAX_LITERAL_DIGITS = 10


class GraphError(ValueError):
    """A graph that cannot be read exactly; the message names the instruction and says what would be right."""


@dataclass(frozen=True, slots=True)
class Instruction:
    """One scalar instruction; its result is the register with the instruction's own position."""

    op: str
    args: tuple[int, ...] = ()
    name: str = ""  # of an INPUT
    value: Fraction = Fraction(0)  # of a CONST

    def as_json(self) -> list[Any]:
        if self.op == "INPUT":
            return ["INPUT", self.name]
        if self.op == "CONST":
            return ["CONST", str(self.value)]
        return [self.op, *self.args]


@dataclass(frozen=True)
class Tape:
    """An instruction list: register k holds the result of `code[k]`; `outputs` are registers, in order."""

    code: tuple[Instruction, ...]
    outputs: tuple[int, ...]

    @cached_property
    def inputs(self) -> tuple[str, ...]:
        return tuple(step.name for step in self.code if step.op == "INPUT")

    def as_json(self) -> dict[str, Any]:
        return {"code": [step.as_json() for step in self.code], "outputs": list(self.outputs)}

    @cached_property
    def sha256(self) -> str:
        text = json.dumps(self.as_json(), sort_keys=True, separators=(",", ":"), ensure_ascii=False)
        return hashlib.sha256(text.encode()).hexdigest()


@contextmanager
def unfolded() -> Iterator[None]:
    """Build CasADi expressions as written: its simplification is off inside and restored after, also on errors."""
    before = ca.GlobalOptions.getSimplificationOnTheFly()
    ca.GlobalOptions.setSimplificationOnTheFly(False)
    try:
        yield
    finally:
        ca.GlobalOptions.setSimplificationOnTheFly(before)


def exact_literal(value: float) -> Fraction:
    """The decimal that a double was written as, if that has at most ten significant digits.

    A computed double (1/3, pi, 0.1 + 0.2) has no short decimal and is refused: GraphError.
    """
    text = repr(float(value))
    if text in ("nan", "inf", "-inf"):
        raise GraphError(f"the constant {text} has no exact value; an expression divides by a literal zero or overflows")
    if float(value).is_integer() and abs(value) <= 2**53:
        return Fraction(int(value))
    mantissa = text.split("e")[0].replace(".", "").lstrip("-0")
    if len(mantissa.rstrip("0")) > MAX_LITERAL_DIGITS:
        raise GraphError(
            f"the literal {text} has more than {MAX_LITERAL_DIGITS} digits, so it is not known which number is meant; "
            'write it as a string, like "1/3" or "0.12345678901", or as a parameter with an exact value'
        )
    return Fraction(text)


def read(function: ca.Function, names: Sequence[str] | None = None) -> Tape:
    """The tape of an SX function: nested calls expanded, literals exact, equal instructions merged.

    names: one per scalar nonzero of all inputs, in order; by default `input[k]`.
    Raises GraphError for a free symbol, an operation without a scalar meaning, or an inexact literal.
    """
    count = sum(function.nnz_in(k) for k in range(function.n_in()))
    if names is None:
        names = [
            f"{function.name_in(k)}[{j + 1}]" for k in range(function.n_in()) for j in range(function.nnz_in(k))
        ]
    if len(names) != count:
        raise GraphError(f"function {function.name()} has {count} scalar inputs, but {len(names)} names were given")
    builder = _Builder()
    outputs = builder.expand(function, [builder.emit(Instruction("INPUT", name=name)) for name in names])
    return builder.finish(outputs)


class _Builder:
    def __init__(self) -> None:
        self.code: list[Instruction] = []
        self.register: dict[Instruction, int] = {}

    def emit(self, step: Instruction) -> int:
        at = self.register.setdefault(step, len(self.code))
        if at == len(self.code):
            self.code.append(step)
        return at

    def expand(self, function: ca.Function, inputs: Sequence[int]) -> list[int]:
        """Registers of all output nonzeros of `function` applied to the registers `inputs`."""
        if function.has_free():
            raise GraphError(f"function {function.name()} has free symbols: {', '.join(map(str, function.get_free()))}")
        if not function.is_a("SXFunction"):
            raise GraphError(f"a call to {function.name()} ({function.class_name()}) has no scalar instructions to read")
        first_in = _offsets([function.nnz_in(k) for k in range(function.n_in())])
        first_out = _offsets([function.nnz_out(k) for k in range(function.n_out())])
        work: dict[int, int] = {}
        results = [-1] * first_out[-1]
        calls: Any = None
        for k in range(function.n_instructions()):
            op = _OPCODE_NAMES.get(function.instruction_id(k), str(function.instruction_id(k)))
            into, source = function.instruction_output(k), function.instruction_input(k)
            if op == "INPUT":
                work[into[0]] = inputs[first_in[source[0]] + source[1]]
            elif op == "OUTPUT":
                results[first_out[into[0]] + into[1]] = work[source[0]]
            elif op == "CONST":
                value = exact_literal(function.instruction_constant(k))
                work[into[0]] = self.emit(Instruction("CONST", value=value))
            elif op == "CALL":
                calls = function.instructions_sx() if calls is None else calls
                called = self.expand(calls.nz[k].which_function(), [work[s] for s in source])
                work.update((w, r) for w, r in zip(into, called, strict=True) if w >= 0)
            elif op in _TRANSPARENT:
                work[into[0]] = work[source[0]]
            elif op in ARITY:
                work[into[0]] = self.emit(Instruction(op, tuple(work[s] for s in source[: ARITY[op]])))
            else:
                raise GraphError(f"instruction {k} of function {function.name()} is {op}, which has no exact meaning here")
        zero = Instruction("CONST")
        return [self.emit(zero) if r < 0 else r for r in results]

    def finish(self, outputs: Sequence[int]) -> Tape:
        """Only what the outputs need, renumbered."""
        needed = set(outputs)
        for k in range(len(self.code) - 1, -1, -1):
            if k in needed:
                needed.update(self.code[k].args)
        new = {old: k for k, old in enumerate(sorted(needed))}
        code = tuple(
            Instruction(s.op, tuple(new[a] for a in s.args), s.name, s.value)
            for k, s in enumerate(self.code)
            if k in needed
        )
        return Tape(code, tuple(new[r] for r in outputs))


def _offsets(sizes: Sequence[int]) -> list[int]:
    result = [0]
    for size in sizes:
        result.append(result[-1] + size)
    return result


def interpret(
    function: ca.Function | Tape, domain: Domain[Value], inputs: Mapping[str, Value] | Sequence[Value]
) -> list[Value]:
    """The values of all scalar outputs in `domain`.

    inputs: by scalar name, or one per scalar nonzero in order. Raises GraphError where the function cannot be
    read, and the domain's own error where it gives an operation no meaning.
    """
    names = None
    if not isinstance(function, Tape):
        if not isinstance(inputs, Mapping):
            inputs = {f"#{k}": value for k, value in enumerate(inputs)}
            names = list(inputs)
        function = read(function, names)
    elif not isinstance(inputs, Mapping):
        inputs = dict(zip(function.inputs, inputs, strict=True))
    work: list[Value] = []
    for step in function.code:
        if step.op == "INPUT":
            work.append(inputs[step.name])
        elif step.op == "CONST":
            work.append(domain.constant(step.value))
        else:
            work.append(domain.operation(step.op)(*[work[a] for a in step.args]))
    return [work[r] for r in function.outputs]


def prebound(tape: Tape, domain: Domain[Value]) -> Callable[[Sequence[Value]], list[Value]]:
    """The walk over `tape` in `domain` with every operation looked up once, for many evaluations.

    The result takes one value per name in `tape.inputs`, in order.
    """
    names = {name: k for k, name in enumerate(tape.inputs)}
    steps: list[tuple[int, Any, tuple[int, ...]]] = []
    for step in tape.code:
        if step.op == "INPUT":
            steps.append((0, names[step.name], ()))
        elif step.op == "CONST":
            steps.append((1, domain.constant(step.value), ()))
        else:
            steps.append((len(step.args) + 1, domain.operation(step.op), step.args))

    def run(inputs: Sequence[Value]) -> list[Value]:
        work: list[Value] = []
        push = work.append
        for kind, what, args in steps:
            if kind == 3:
                push(what(work[args[0]], work[args[1]]))
            elif kind == 2:
                push(what(work[args[0]]))
            elif kind == 0:
                push(inputs[what])
            else:
                push(what)
        return [work[r] for r in tape.outputs]

    return run
