"""The command line: it reads what was asked, calls the library, prints, writes and exits; it decides nothing.

Heavy libraries are imported by the command that uses them, so that `symctrl --help` is quick.
"""

from __future__ import annotations

import os
import sys
import textwrap
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from symctrl import files
from symctrl.files import InputError

if TYPE_CHECKING:
    from symctrl.rows import Report

app = typer.Typer(add_completion=False, rich_markup_mode=None, pretty_exceptions_enable=False)

# What typer raises for an unknown option and the like, wherever this version of it keeps that class.
_UsageError: type[Any] = typer.BadParameter.__mro__[2]

INTERRUPTED = 130
GRAPH = "ring:N, path:N, star:N, complete:N, tree:N, grid:RxC or a file of edges."

JsonFile = Annotated[
    str | None, typer.Option("--json", metavar="FILE", help="Write JSON; - is standard output.")
]


def main() -> None:
    """The console script."""
    sys.exit(run())


def run(args: Sequence[str] | None = None) -> int:
    """The exit code of `symctrl ARGS`. Bad input is one message on standard error, and 2."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # a terminal without a ✓ gets a question mark and no traceback
            stream.reconfigure(errors="replace")
    try:
        code = int(app(args, prog_name="symctrl", standalone_mode=False) or 0)
        sys.stdout.flush()
    except InputError as error:
        return _complain(str(error))
    except _UsageError as error:
        where = error.ctx.command_path if getattr(error, "ctx", None) else "symctrl"
        return _complain(f"{error.format_message().rstrip('.')}; see {where} --help")
    except (KeyboardInterrupt, typer.Abort):
        code = INTERRUPTED
    except BrokenPipeError:
        # Python would complain once more when it flushes at its end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    # Newer typers make an exit code of an interrupt themselves.
    return _complain("interrupted", code) if code == INTERRUPTED else code


def _complain(message: str, code: int = 2) -> int:
    print(f"symctrl: {message}", file=sys.stderr)
    return code


@app.callback(invoke_without_command=True)
def root(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Print the version.")] = False,
) -> None:
    """Machine-checked verdicts on the claims of control papers."""
    if version:
        from symctrl.certify import tool

        print(tool())
        raise typer.Exit
    if context.invoked_subcommand is None:
        print(context.get_help())


@app.command()
def studies(json: JsonFile = None) -> None:
    """List the installed studies."""
    from symctrl import registry
    from symctrl.certify import digest, tool

    _refuse_early(json)
    found = [
        {"study": name, "module": module, "summary": registry.summary(module)}
        for name, module in registry.installed().items()
    ]
    if json != "-":
        width = max((len(entry["study"]) for entry in found), default=0)
        for entry in found:
            print(f"{entry['study']:{width}}  {entry['summary']}".rstrip())
    body = {"format": "symctrl-studies/1", "tool": tool(), "inputs_sha256": digest(found), "studies": found}
    _emit(json, body)


@app.command()
def new(name: Annotated[str, typer.Argument(metavar="NAME")]) -> None:
    """Write NAME.py, a small study to start from."""
    from symctrl import template

    path = template.new(name, Path())
    print(f"wrote {path}; see it with: symctrl verify {path}")


@app.command()
def verify(
    *,
    studies: Annotated[list[str] | None, typer.Argument(metavar="STUDY...", show_default=False)] = None,
    every: Annotated[bool, typer.Option("--all", help="All installed studies.")] = False,
    claim: Annotated[
        list[str] | None, typer.Option(metavar="ID", help="Only this claim; repeatable.")
    ] = None,
    graph: Annotated[str | None, typer.Option(metavar="G", help=GRAPH)] = None,
    setting: Annotated[
        list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="An exact value; repeatable.")
    ] = None,
    tree: Annotated[bool, typer.Option("--tree", help="Show what rests on what.")] = False,
    strict: Annotated[bool, typer.Option("--strict", help="Conditional claims do not count.")] = False,
    fresh: Annotated[bool, typer.Option("--fresh", help="Ignore the verdicts of earlier runs.")] = False,
    jobs: Annotated[
        int | None,
        typer.Option(metavar="N", min=1, help="Processes; as many as pay unless given.", show_default=False),
    ] = None,
    json: JsonFile = None,
    certificates: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write DIR/STUDY/ID.json for each claim that has one.")
    ] = None,
) -> None:
    """Decide every claim of the studies. Exits 0 when all are settled, 1 when one is not."""
    # Before numpy comes in: the work is shared out by claims, not inside a matrix product.
    os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    from symctrl import runs
    from symctrl.certify import tool
    from symctrl.parallel import Request
    from symctrl.table import settled

    requests = [
        Request(name, graph, _values(setting or [])) for name in _chosen("verify", studies or [], every)
    ]
    decided = runs.decide(requests, claim or None, jobs=jobs, fresh=fresh, watch=_watch)
    if certificates is not None:
        files.refuse_unwritable_folder(certificates)
    _refuse_early(json, certificates)
    reports = []
    for study, report in decided:
        reports.append(report)
        if json != "-":
            _show(report, len(study.numbers), tree=tree, strict=strict)
        if certificates is not None:
            runs.write_certificates(report, certificates)
    answers = [report.as_json(tool()) for report in reports]
    _emit(json, answers if every or len(answers) > 1 else answers[0])
    raise typer.Exit(0 if all(settled(row, strict) for report in reports for row in report.rows) else 1)


@app.command()
def report(
    studies: Annotated[list[str] | None, typer.Argument(metavar="STUDY...", show_default=False)] = None,
    every: Annotated[bool, typer.Option("--all", help="All installed studies.")] = False,
    out: Annotated[
        Path, typer.Option(metavar="DIR", help="The folder of the pages; it is made if it is not there.")
    ] = Path("reports"),
) -> None:
    """Write one HTML page for each study, DIR/STUDY.html, and DIR/index.html over all pages there.

    A page needs nothing but itself: what holds, what fails, what holds instead, and how to check it. Verdicts
    of earlier runs are used, as by verify. Exits 0 when the pages are written, whatever they say.
    """
    os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    from symctrl.report import writing

    for path in writing.write(_chosen("report", studies or [], every), out, _watch):
        print(f"wrote {path}")


@app.command()
def gains(
    study: Annotated[str, typer.Argument(metavar="STUDY")],
    *,
    graph: Annotated[str | None, typer.Option(metavar="G", help=GRAPH)] = None,
    sweep: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=LO:HI:COUNT", help="A map over COUNT cells of this gain; once or twice."),
    ] = None,
    setting: Annotated[
        list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="An exact value; repeatable.")
    ] = None,
    maximize: Annotated[
        str | None, typer.Option(metavar="decay|margin", help="Look for the gains with the largest one.")
    ] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Ignore the verdicts of earlier runs.")] = False,
    json: JsonFile = None,
    plot: Annotated[
        Path | None, typer.Option(metavar="FILE", help="The map as a picture: .png, .svg or .pdf.")
    ] = None,
) -> None:
    """Decide which gains may be used: at a point, on a map, with the edge as a formula and the margin to it.

    Exits 0 feasible, 1 infeasible, 3 undecided.
    """
    os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    from symctrl.gains import command

    _refuse_early(json)
    values = _values(setting or [])
    asked = command.Asked(study, graph, values, tuple(sweep or ()), maximize, fresh, plot, json)
    found = command.run(asked, _watch)
    if json != "-":
        command.show(found)
    _emit(json, found.as_json())
    raise typer.Exit(command.exit_code(found))


@app.command()
def check(paths: Annotated[list[Path], typer.Argument(metavar="FILE...")]) -> None:
    """Check certificate files with the kernel alone.

    Exits 0 all valid, 1 one invalid, 2 one unreadable, 3 one declined; the worst counts.
    """
    from symctrl.kernel.check import check_file, exit_code

    answers = []
    for path in paths:
        answer = check_file(path)
        answers.append(answer)
        if answer.status == "unreadable":
            _complain(f"{path}: unreadable: {answer.reason}")
            continue
        print(f"{path}: {answer.status}: {answer.reason}")
        if answer.statement:
            print(textwrap.indent(answer.statement, "  "))
    raise typer.Exit(exit_code(answers))


@app.command()
def posdef(
    paths: Annotated[list[Path], typer.Argument(metavar="MATRIX.json...")], json: JsonFile = None
) -> None:
    """Decide exactly whether matrices are semidefinite.

    One file: exits 0 proved, 1 refuted, 3 undecided. Several: 0 when each has an answer.
    """
    from symctrl.posdef import PosdefError, answer, read

    _refuse_early(json)
    try:
        answers = [answer(read(path), str(path)) for path in paths]
    except PosdefError as error:
        raise InputError(str(error)) from None
    if json != "-":
        for path, found in zip(paths, answers, strict=True):
            words = f"{found['definiteness']}, rank {found['rank']}; {found['reason']}"
            print(f"{path}: {found['verdict']}: {words}")
    _emit(json, answers if len(answers) > 1 else answers[0])
    raise typer.Exit(0 if len(answers) > 1 else {"proved": 0, "refuted": 1}.get(answers[0]["verdict"], 3))


@app.command()
def sos(
    poly: Annotated[str | None, typer.Argument(metavar="POLY", show_default=False)] = None,
    *,
    names: Annotated[
        str | None,
        typer.Option("--vars", metavar="x,y", help="The variables; those that occur unless given."),
    ] = None,
    on: Annotated[
        str | None, typer.Option("--on", metavar="CONSTRAINTS", help="Like '1-x^2>=0, x*y==0'.")
    ] = None,
    batch: Annotated[
        Path | None, typer.Option(metavar="PROBLEMS.json", help='A list of {"id", "poly", "vars", "on"}.')
    ] = None,
    certify: Annotated[
        Path | None,
        typer.Option(metavar="FILE.json", help="A Gram matrix or Lyapunov function in floats, made exact."),
    ] = None,
    limit: Annotated[
        float | None, typer.Option(metavar="SECONDS", help="For each problem; 30 unless given.")
    ] = None,
    json: JsonFile = None,
) -> None:
    """Decide exactly whether a polynomial is nonnegative, everywhere or on a set.

    One problem: exits 0 proved, 1 refuted, 3 undecided. A batch: 0 when each has an answer.
    """
    os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    from symctrl.sos import command

    _refuse_early(json)
    if sum(given is not None for given in (poly, batch, certify)) != 1:
        raise InputError(
            "sos: give one polynomial, or a file of problems with --batch, or --certify FILE.json"
        )
    if batch is None:
        found = (
            command.single(poly, names, on, limit) if poly is not None else command.made_exact(certify, limit)
        )
        if json != "-":
            print(command.line(found))
        _emit(json, found)
        raise typer.Exit(command.EXIT_CODES[found["verdict"]])
    if names is not None or on is not None:
        raise InputError("sos: the variables and sets of a batch stand in its file")
    answers = []
    with _watch("sos") as watch:
        for found in command.batch(batch, limit, watch):
            answers.append(found)
            if json != "-":
                print(f"{found['id']}: {command.line(found)}", flush=True)
    _emit(json, answers)


def _chosen(command: str, names: Sequence[str], every: bool) -> list[str]:
    from symctrl import registry

    if every and names:
        raise InputError(f"{command}: give the names of studies or --all, not both")
    if not every and not names:
        raise InputError(
            f"{command}: which study? Give names or files, or --all; `symctrl studies` lists names"
        )
    if every and not registry.installed():
        raise InputError(f"{command}: --all, but no study is installed")
    return list(names) or list(registry.installed())


def _values(settings: Sequence[str]) -> dict[str, str]:
    values: dict[str, str] = {}
    for setting in settings:
        name, equals, value = (part.strip() for part in setting.partition("="))
        if not (name and equals and value):
            raise InputError(f"--set {setting}: must be like NAME=VALUE, as in k=1/3")
        if name in values:
            raise InputError(f"--set {setting}: {name} is set twice")
        values[name] = value
    return values


@contextmanager
def _watch(study: str) -> Iterator[Callable[[str], None]]:
    """On a terminal, one line that says what is being decided, and for how long it has been."""
    from rich.console import Console
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda _: None
        return
    columns = SpinnerColumn(), TimeElapsedColumn(), TextColumn("{task.description}", markup=False)
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(study)
        yield lambda text: bar.update(task, description=f"{study}: {text}")


def _show(report: Report, numbered: int, *, tree: bool, strict: bool) -> None:
    from rich.console import Console

    from symctrl import table

    table.show(report, Console(highlight=False), numbered=numbered, tree=tree, strict=strict)


def _refuse_early(json: str | None, to_be_made: Path | None = None) -> None:
    if json in (None, "-") or (to_be_made and Path(json).absolute().parent == to_be_made.absolute()):
        return
    files.refuse_unwritable(Path(json))


def _emit(json: str | None, answer: Any) -> None:
    if json is None:
        return
    text = files.as_text(answer)
    if json == "-":
        sys.stdout.write(text)
        return
    try:
        files.write(Path(json), text)
    except OSError as error:
        raise InputError(f"{json}: cannot be written: {error.strerror}") from None
