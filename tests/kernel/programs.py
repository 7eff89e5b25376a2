"""Statements for tests of the kernel, written as text and read back as a certificate file is."""

import json

from symctrl.certify import certificate, listing
from symctrl.kernel import check
from symctrl.kernel.loading import load

OPS = {"+": "ADD", "-": "SUB", "*": "MUL", "/": "DIV"}


def program(*outputs):
    """A listing with these outputs: each a name, a number, or (op, argument, ..) of the same."""
    code = []

    def emit(step):
        if step not in code:
            code.append(step)
        return code.index(step)

    def register(expression):
        if isinstance(expression, tuple):
            op = OPS.get(expression[0], expression[0])
            return emit([op, *[register(argument) for argument in expression[1:]]])
        if isinstance(expression, str) and not expression.lstrip("-")[0].isdigit():
            return emit(["INPUT", expression])
        return emit(["CONST", str(expression)])

    return listing(code, [register(expression) for expression in outputs])


def assume(kind, name, size=None):
    """An assumption about output 0 of the listing `name`, or about the matrix of all its size^2 outputs."""
    if size is None:
        return {"kind": kind, "of": [name, 0], "text": f"{name} {kind}", "about": "parameter"}
    return {"kind": kind, "size": size, "of": [[name, k] for k in range(size * size)]}


def statement(claim, listings, scalars=(), given=(), **more):
    """claim: without its listing, which is `claim`; scalars: names of parameters, or a table of kinds."""
    tables = {"names": {}, "motion": {}, "laws": {}, "conditions": []}
    kinds = scalars if isinstance(scalars, dict) else dict.fromkeys(scalars, "parameter")
    return {
        "study": "test",
        "id": "claim",
        "text": "a claim",
        "listings": listings,
        "scalars": kinds,
        "given": list(given),
        "claim": {**claim, "listing": "claim"},
        **tables,
        **more,
    }


def verify(stated, proof):
    """The kernel on the certificate of this statement and proof."""
    read = load(json.dumps(certificate(stated, proof)))
    check.verify(read)
