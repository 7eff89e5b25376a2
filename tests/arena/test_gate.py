"""The arena: the kernel answers every case as expected, and no checker passes that does not check."""

import json
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from symctrl.kernel import check
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


def test_the_kernel_stands_alone(tmp_path):
    """A copy of its folder answers the same where Python finds the standard library and nothing else."""
    shutil.copytree(Path(check.__file__).parent, tmp_path / "symctrl" / "kernel")
    files = [str(ROOT / name) for name in EXPECTED]
    command = [sys.executable, "-S", "-E", "-s", "-m", "symctrl.kernel", *files]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.stderr == ""
    for name, status in EXPECTED.items():
        assert f"{ROOT / name}: {status}: " in done.stdout


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
