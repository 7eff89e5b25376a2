"""The one graph and the one walk.

A CasADi SX `Function` is a flat list of scalar instructions. `read` turns it into a `Tape`, plain data in
static single assignment form, and `interpret` evaluates a tape (or a Function) in any `Domain`. A new
analysis is a new domain, never a second walk.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property
from itertools import accumulate
from typing import Any, Protocol, TypeVar

import casadi as ca

Value = TypeVar("Value")
Meant_co = TypeVar("Meant_co", covariant=True)

# Every scalar opcode that a CasADi SX function can hold and that has a meaning in at least one domain,
# with its number of arguments.
# fmt: off
_UNARY = (
    "NEG", "EXP", "LOG", "SQRT", "SQ", "TWICE", "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "SINH", "COSH",
    "TANH", "ASINH", "ACOSH", "ATANH", "FABS", "SIGN", "FLOOR", "CEIL", "NOT", "ERF", "ERFINV", "INV",
    "LOG1P", "EXPM1",
)
_BINARY = (
    "ADD", "SUB", "MUL", "DIV", "POW", "CONSTPOW", "LT", "LE", "EQ", "NE", "AND", "OR", "FMOD", "REMAINDER",
    "COPYSIGN", "IF_ELSE_ZERO", "FMIN", "FMAX", "ATAN2", "HYPOT",
)
# fmt: on
ARITY: Mapping[str, int] = {**dict.fromkeys(_UNARY, 1), **dict.fromkeys(_BINARY, 2)}
_TRANSPARENT = frozenset(("ASSIGN", "LIFT"))
_OPCODE_NAMES = {getattr(ca, name): name[3:] for name in dir(ca) if name.startswith("OP_")}
MAX_LITERAL_DIGITS = 10


class Operations(Protocol[Meant_co]):
    """What the walk needs of a domain (symctrl.domains.domain)."""

    def operation(self, op: str) -> Callable[..., Meant_co]: ...
    def constant(self, value: Fraction) -> Meant_co: ...


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
    """Build CasADi expressions as written: its simplification is off inside.

    The switch is global to the process; it is restored after, also on errors and when nested.
    """
    before = ca.GlobalOptions.getSimplificationOnTheFly()
    ca.GlobalOptions.setSimplificationOnTheFly(False)
    try:
        yield
    finally:
        ca.GlobalOptions.setSimplificationOnTheFly(before)


def exact_literal(value: float) -> Fraction:
    """The decimal that a double was written as, if that has at most ten significant digits; any integer.

    A computed double (1/3, pi, 0.1 + 0.2) has no short decimal and is refused: GraphError.
    """
    text = repr(float(value))
    if not math.isfinite(value):
        raise GraphError(
            f"the constant {text} has no exact value: somewhere a literal is divided by zero or overflows"
        )
    if float(value).is_integer() and abs(value) <= 2**53:
        return Fraction(int(value))
    mantissa = text.split("e")[0].replace(".", "").lstrip("-0")
    if len(mantissa.rstrip("0")) > MAX_LITERAL_DIGITS:
        raise GraphError(
            f"the literal {text} has more than {MAX_LITERAL_DIGITS} digits, so it is not known which number "
            'is meant; write it as a string, like "1/3" or "0.12345678901", or as a parameter'
        )
    return Fraction(text)


def read(function: ca.Function, names: Sequence[str] | None = None) -> Tape:
    """The tape of a function: MX and nested calls expanded, literals exact, equal instructions merged.

    names: one per scalar nonzero of all inputs, in order, all different; by default `input[k]`. Inputs on
    which no output depends are not in the tape.
    Raises GraphError for a free symbol, an operation without a scalar meaning, or an inexact literal.
    """
    sizes = [(function.name_in(k), function.nnz_in(k)) for k in range(function.n_in())]
    if names is None:
        names = [f"{name}[{j + 1}]" for name, size in sizes for j in range(size)]
    count = sum(size for _, size in sizes)
    if len(names) != count:
        raise GraphError(
            f"function {function.name()} has {count} scalar inputs, but {len(names)} names were given"
        )
    twice = sorted(name for name, times in Counter(names).items() if times > 1)
    if twice:
        raise GraphError(f"function {function.name()} needs different names, but {twice[0]} was given twice")
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
            free = ", ".join(map(str, function.get_free()))
            raise GraphError(
                f"function {function.name()} has free symbols: {free}; every symbol must be an input"
            )
        function = _scalar(function)
        first_in = _offsets([function.nnz_in(k) for k in range(function.n_in())])
        first_out = _offsets([function.nnz_out(k) for k in range(function.n_out())])
        work: dict[int, int] = {}
        results: dict[int, int] = {}
        nodes: Any = None
        for k in range(function.n_instructions()):
            op = _OPCODE_NAMES.get(function.instruction_id(k), str(function.instruction_id(k)))
            into, source = function.instruction_output(k), function.instruction_input(k)
            if op == "INPUT":
                work[into[0]] = inputs[first_in[source[0]] + source[1]]
            elif op == "OUTPUT":
                results[first_out[into[0]] + into[1]] = work[source[0]]
            elif op == "CONST":
                work[into[0]] = self.emit(Instruction("CONST", value=_literal(function, k)))
            elif op == "CALL":
                nodes = function.instructions_sx() if nodes is None else nodes
                called = self.expand(nodes.nz[k].which_function(), [work[s] for s in source])
                work.update((w, r) for w, r in zip(into, called, strict=True) if w >= 0)
            elif op in _TRANSPARENT:
                work[into[0]] = work[source[0]]
            elif op in ARITY:
                work[into[0]] = self.emit(Instruction(op, tuple(work[s] for s in source[: ARITY[op]])))
            else:
                raise GraphError(
                    f"instruction {k} of function {function.name()} is {op.lower()}, which has no exact "
                    "meaning; write it with scalar operations"
                )
        return [results[k] for k in range(first_out[-1])]

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


def _scalar(function: ca.Function) -> ca.Function:
    """The function as scalar instructions, expanded as written if it is one of matrices."""
    if function.is_a("SXFunction"):
        return function
    named = f"function {function.name()} ({function.class_name()})"
    if not function.is_a("MXFunction"):
        raise GraphError(f"{named} has no scalar instructions to read; write it with scalar operations")
    try:
        with unfolded():
            expanded = function.expand()
    except RuntimeError as error:
        reason = str(error).strip().splitlines()[-1]
        raise GraphError(f"{named} cannot be expanded into scalar instructions: {reason}") from error
    if any(called.__hash__() == function.__hash__() for called in _called(expanded)):
        raise GraphError(f"{named} is marked never_inline, so CasADi does not expand it; leave the mark out")
    return expanded


def _called(function: ca.Function) -> list[ca.Function]:
    steps = [k for k in range(function.n_instructions()) if function.instruction_id(k) == ca.OP_CALL]
    nodes: Any = function.instructions_sx() if steps else None
    return [nodes.nz[k].which_function() for k in steps]


def _literal(function: ca.Function, k: int) -> Fraction:
    """The exact value of the constant in instruction k; an error also says where the constant is used."""
    try:
        return exact_literal(function.instruction_constant(k))
    except GraphError as error:
        where = f"in function {function.name()}, {_use(function, k)}"
        raise GraphError(f"{error} ({where})") from None


def _use(function: ca.Function, k: int) -> str:
    """Where the result of instruction k is first used."""
    (register,) = function.instruction_output(k)
    later = (j for j in range(k + 1, function.n_instructions()) if function.instruction_id(j) != ca.OP_INPUT)
    user = next(j for j in later if register in function.instruction_input(j))
    op = _OPCODE_NAMES[function.instruction_id(user)].lower()
    if op == "output":
        name = function.name_out(function.instruction_output(user)[0])
        return f"as entry {function.instruction_output(user)[1] + 1} of output {name}"
    return f"as an argument of instruction {user}, {op}"


def _offsets(sizes: Sequence[int]) -> list[int]:
    return [0, *accumulate(sizes)]


def interpret(
    function: ca.Function | Tape, domain: Operations[Value], inputs: Mapping[str, Value] | Sequence[Value]
) -> list[Value]:
    """The values of all scalar outputs in `domain`.

    inputs: by scalar name, or one per scalar nonzero (of a tape: per name in `tape.inputs`) in order.
    Raises GraphError where the function cannot be read or an input has no value, Unsupported where the domain
    gives an operation no meaning, and the domain's own error where it has no value.
    """
    if isinstance(function, Tape):
        tape = function
        if not isinstance(inputs, Mapping):
            return prebound(tape, domain)(inputs)
    else:
        names = None
        if not isinstance(inputs, Mapping):
            inputs = {f"#{k + 1}": value for k, value in enumerate(inputs)}
            names = list(inputs)
        tape = read(function, names)
    missing = [name for name in tape.inputs if name not in inputs]
    if missing:
        raise GraphError(f"no value was given for {', '.join(missing)}")
    return prebound(tape, domain)([inputs[name] for name in tape.inputs])


def prebound(tape: Tape, domain: Operations[Value]) -> Callable[[Sequence[Value]], list[Value]]:
    """The walk over `tape` in `domain` with every operation looked up once, for many evaluations.

    The result takes one value per name in `tape.inputs`, in order, and raises GraphError for another number.
    Raises Unsupported where the domain gives an operation no meaning.
    """
    position = {name: k for k, name in enumerate(tape.inputs)}
    operation = cache(domain.operation)
    steps: list[tuple[int, Any, tuple[int, ...]]] = []
    for step in tape.code:
        if step.op == "INPUT":
            steps.append((_TAKE, position[step.name], ()))
        elif step.op == "CONST":
            steps.append((_CONSTANT, domain.constant(step.value), ()))
        else:
            steps.append((len(step.args), operation(step.op), step.args))

    def run(inputs: Sequence[Value]) -> list[Value]:
        if len(inputs) != len(position):
            raise GraphError(f"the tape has {len(position)} inputs, but {len(inputs)} values were given")
        work: list[Value] = []
        push = work.append
        for kind, what, args in steps:
            if kind == 2:
                push(what(work[args[0]], work[args[1]]))
            elif kind == 1:
                push(what(work[args[0]]))
            elif kind == _TAKE:
                push(inputs[what])
            else:
                push(what)
        return [work[r] for r in tape.outputs]

    return run


_TAKE, _CONSTANT = 3, 0  # kinds of a step beside the number of an operation's arguments
