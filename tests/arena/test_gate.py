"""The arena: the kernel answers every case as expected, and no checker passes that does not check."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from symctrl.kernel.certificate import Invalid, Unreadable
from symctrl.kernel.check import check_file
from symctrl.kernel.loading import load
from tests.arena import build

ROOT = Path(__file__).parent
EXPECTED = json.loads((ROOT / "expected.json").read_text(encoding="utf-8"))
Checker = Callable[[Path], str]


def kernel(path: Path) -> str:
    return check_file(path).status


def parse_only(path: Path) -> str:
    try:
        load(path.read_text(encoding="utf-8"))
    except Unreadable:
        return "unreadable"
    except Invalid:
        return "invalid"
    except ValueError:
        return "declined"
    return "valid"


def wrong(checker: Checker, folder: str) -> list[str]:
    """The cases of a folder that a checker answers otherwise than expected."""
    cases = [name for name in EXPECTED if name.startswith(f"{folder}/")]
    return [name for name in cases if checker(ROOT / name) != EXPECTED[name]]


@pytest.mark.parametrize("folder", ["good", "bad", "corner"])
def test_the_kernel_passes(folder):
    assert wrong(kernel, folder) == []


@pytest.mark.parametrize(
    ("checker", "folder"),
    [(lambda path: "valid", "bad"), (lambda path: "invalid", "good"), (parse_only, "bad")],
    ids=["always valid", "always invalid", "parse only"],
)
def test_a_checker_that_does_not_check_fails(checker, folder):
    assert wrong(checker, folder)


def test_the_files_are_those_that_are_built(tmp_path, monkeypatch):
    """So that what is committed can be made again, and no case is left over or missing."""
    monkeypatch.setattr(build, "ROOT", tmp_path)
    build.main()
    made = {path.relative_to(tmp_path): path.read_text() for path in tmp_path.rglob("*.json")}
    kept = {path.relative_to(ROOT): path.read_text() for path in ROOT.rglob("*.json")}
    assert made == kept
