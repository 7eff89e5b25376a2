"""The project keeps its own rules: style, types, and a README whose commands are the ones that CI runs."""

import json
import re
import subprocess
import sys
from importlib.metadata import distribution
from pathlib import Path

import pytest

import symctrl

ROOT = Path(__file__).parents[1]
USE = "python3 -m venv .venv && .venv/bin/pip install -q . && .venv/bin/symctrl verify --all"
TEST = "python3 -m venv .venv && .venv/bin/pip install -q '.[test]' && .venv/bin/pytest -n 2"


@pytest.mark.parametrize("tool", [("ruff", "check"), ("mypy",)], ids=lambda tool: tool[0])
def test_the_code_passes(tool):
    command = [sys.executable, "-m", *tool]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_first_two_commands_of_the_readme_set_up_use_and_test():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```(\w*).*?\n(.*?)^```$", readme, re.M | re.S)
    shell = [body for language, body in blocks if language == "sh"]
    assert shell[:2] == [f"{USE}\n", f"{TEST}\n"]


def test_ci_runs_the_second_command_of_the_readme(tmp_path):
    (tmp_path / ".ci").mkdir()
    script = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    (tmp_path / ".ci" / "run").write_text(re.sub(r"(?m)^DEBIAN_TOOLS=\([^)]*\)", "DEBIAN_TOOLS=()", script))
    blocks = [("text", "no"), ("sh", "echo first"), ("sh", "echo 'second' && exit 7"), ("sh", "echo third")]
    readme = "".join(f"Words.\n```{language}\n{body}\n```\n" for language, body in blocks)
    (tmp_path / "README.md").write_text(readme)
    done = subprocess.run(["bash", ".ci/run"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 7
    assert done.stdout.splitlines()[1:] == ["second"]


def test_the_tests_see_the_installed_package():
    """A checkout that stands in front of the installed package would hide what the package lacks."""
    installed = distribution("symctrl")
    direct = json.loads(installed.read_text("direct_url.json") or "{}")
    editable = direct.get("dir_info", {}).get("editable", False)
    expected = ROOT if editable else Path(str(installed.locate_file("")))
    assert Path(symctrl.__file__).resolve() == (expected / "symctrl" / "__init__.py").resolve()
