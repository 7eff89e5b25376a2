"""What the README and docs/ show is what happens: files are written, commands run, output compared.

A block that begins with three backquotes, a language and NAME is the file NAME. In a block of the language
console a line after `$ ` is a command, and the lines up to the next one are what it prints; times may differ.
`python tests/test_docs.py` writes what the commands print now into the pages.
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = [
    "README.md",
    "docs/own_study.md",
    "docs/theorems.md",
    "docs/extending.md",
    "docs/sos.md",
    "docs/gains.md",
]
BLOCK = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.M | re.S)


def played(page, folder):
    """The text of a page with what its commands print when they are run in `folder`."""
    return BLOCK.sub(lambda block: _played(block, folder), (ROOT / page).read_text(encoding="utf-8"))


def _played(block, folder):
    language, name, body = block.groups()
    if name:
        (folder / name).write_text(body, encoding="utf-8")
    if language != "console":
        return block.group()
    lines = [f"$ {command}\n{_printed(command, folder)}" for command in re.findall(r"(?m)^\$ (.*)$", body)]
    return f"```console\n{''.join(lines)}```"


def _printed(command, folder):
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    both = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    done = subprocess.run(
        command, shell=True, cwd=folder, env=os.environ | {"PATH": path}, text=True, check=False, **both
    )
    return re.sub(r"\n+\Z", "\n", done.stdout)


def without_times(text):
    return re.sub(r" *\d+\.\d s\b", " 0.0 s", text)


@pytest.mark.parametrize("page", PAGES)
def test_what_a_page_shows_is_what_happens(page, tmp_path):
    text = (ROOT / page).read_text(encoding="utf-8")
    assert len(re.findall(r"(?m)^\$ ", text)) >= 3
    assert without_times(played(page, tmp_path)) == without_times(text)


if __name__ == "__main__":
    for shown in PAGES:
        with tempfile.TemporaryDirectory() as scratch:
            (ROOT / shown).write_text(played(shown, Path(scratch)), encoding="utf-8")
