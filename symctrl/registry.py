"""Finding a study by name or by path, and saying whose error it is when that fails.

The installed studies are the entry points of the group `symctrl.studies`; none is imported to list them.
"""

from __future__ import annotations

import ast
import sys
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from hashlib import sha256
from importlib import import_module
from importlib.metadata import entry_points
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from symctrl.files import InputError

if TYPE_CHECKING:
    from symctrl.study import Study

GROUP = "symctrl.studies"

Frame = traceback.FrameSummary


class StudyNotFoundError(InputError):
    """There is no study of that name; the message has the nearest ones that there are."""


class StudyFailedError(InputError):
    """The study's own code raised an error; the message is the traceback, shortened to the author's lines."""


def installed() -> dict[str, str]:
    """The module of each installed study by the study's name, in the order of names. Nothing is imported."""
    return {point.name: point.module for point in sorted(entry_points(group=GROUP))}


def summary(module: str) -> str:
    """The first line of a module's docstring, read without running the module; empty where there is none."""
    try:
        origin = _origin(module)
        text = ast.get_docstring(ast.parse(origin.read_bytes())) if origin else None
    except (OSError, SyntaxError, ValueError):
        return ""
    return text.strip().split("\n")[0] if text else ""


def load(name_or_path: str) -> Study:
    """The study of an installed name or of a user's file, imported once.

    Raises StudyNotFoundError; StudyFailedError where the study's code raises an error or has no `study`.
    """
    place = locate(name_or_path)
    with place.blamed():
        module = _run_file(place.origin) if place.module is None else import_module(place.module)
    from symctrl.study import Study

    if not hasattr(module, "study"):
        raise StudyFailedError(f'{place.origin}: has no `study`; it needs study = Study("name", source="..")')
    if not isinstance(module.study, Study):
        found = type(module.study).__name__
        raise StudyFailedError(f"{place.origin}: `study` must be a Study, instead got a {found}")
    return module.study


@dataclass(frozen=True)
class Place:
    """Where a study's code is: a file, and the module's name if it is installed."""

    name: str
    origin: Path
    module: str | None = None

    @contextmanager
    def blamed(self) -> Iterator[None]:
        """Errors inside are told as the user can use them.

        One that has passed through the author's code becomes StudyFailedError. A StudyError that has not
        becomes InputError: the user has asked for what the study does not have. Others are the tool's own.
        """
        try:
            yield
        except (InputError, KeyboardInterrupt):
            raise
        except (Exception, SystemExit) as error:
            frames = traceback.extract_tb(error.__traceback__)
            authors = [frame for frame in frames if self._owns(frame.filename)]
            if not authors and not isinstance(error, SyntaxError):
                raise _asked_in_vain(self.name, error) from None
            raise StudyFailedError(f"{self.origin}: {_shortened(error, authors, frames[-1])}") from None

    def _owns(self, filename: str) -> bool:
        path = Path(filename)
        if self.origin.name == "__init__.py":
            return self.origin.parent in path.parents
        return path == self.origin


def locate(name_or_path: str) -> Place:
    """Where the study is, without importing it. Raises StudyNotFoundError."""
    names = installed()
    if name_or_path in names:
        origin = _origin(names[name_or_path])
        if origin is None:
            raise StudyNotFoundError(f"study {name_or_path}: its module {names[name_or_path]} is missing")
        return Place(name_or_path, origin, names[name_or_path])
    path = Path(name_or_path)
    if path.is_file():
        return Place(name_or_path, path.resolve())
    if path.suffix == ".py" or path.name != name_or_path:
        raise StudyNotFoundError(f"study {name_or_path}: there is no such file")
    hint = _nearest(name_or_path, names)
    raise StudyNotFoundError(f"study {name_or_path}: there is none of that name; {hint}")


def _nearest(name: str, names: dict[str, str]) -> str:
    if Path(f"{name}.py").is_file():
        return f"for the file write {name}.py"
    close = get_close_matches(name, names, n=3, cutoff=0.4)
    if close:
        return f"nearest: {', '.join(close)}"
    return f"installed: {', '.join(names)}" if names else "no study is installed"


def _origin(module: str) -> Path | None:
    try:
        spec = find_spec(module)
    except ImportError:
        return None
    return Path(spec.origin) if spec and spec.origin else None


@cache
def _run_file(path: Path) -> ModuleType:
    """The module of a user's file, under a name of its own.

    It is compiled anew, never read from a bytecode file: such a file knows its source by the second of the
    last change, and an edit within that second would be judged by the text before it.
    """
    name = f"symctrl_study_{path.stem}_{sha256(str(path).encode()).hexdigest()[:8]}"
    module = ModuleType(name)
    module.__file__ = str(path)
    sys.modules[name] = module
    before = list(sys.path)
    sys.path.insert(0, str(path.parent))
    try:
        exec(compile(path.read_bytes(), str(path), "exec"), module.__dict__)
    except BaseException:
        del sys.modules[name]
        raise
    finally:
        sys.path[:] = before
    return module


def _asked_in_vain(name: str, error: BaseException) -> BaseException:
    from symctrl.written import StudyError

    return InputError(f"study {name}: {error}") if isinstance(error, StudyError) else error


def _shortened(error: BaseException, authors: list[Frame], last: Frame) -> str:
    lines = traceback.format_list(authors)
    if authors and last != authors[-1] and Path(__file__).parent not in Path(last.filename).parents:
        lines.append(f"  raised below it in {last.filename}, line {last.lineno}\n")
    return "the study's code failed:\n" + "".join(lines + traceback.format_exception_only(error)).rstrip()
