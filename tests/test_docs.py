"""What the README and docs/ show is what happens: files are written, commands run, output compared.

A block that begins with three backquotes, a language and NAME is the file NAME. In a block of the language
console a line after `$ ` is a command, and the lines up to the next one are what it prints; times may differ.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = ["README.md", "docs/own_study.md"]
BLOCK = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.M | re.S)


def without_times(text):
    text = re.sub(r" *\d+\.\d s\b", " 0.0 s", text)
    return "\n".join(line.rstrip() for line in text.strip().splitlines())


def commands(block):
    """Pairs of a command and what it is said to print."""
    for part in re.split(r"(?m)^\$ ", block)[1:]:
        command, _, output = part.partition("\n")
        yield command, output


@pytest.mark.parametrize("page", PAGES)
def test_what_a_page_shows_is_what_happens(page, tmp_path):
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    ran = 0
    for language, name, body in BLOCK.findall((ROOT / page).read_text(encoding="utf-8")):
        if name:
            (tmp_path / name).write_text(body, encoding="utf-8")
        if language != "console":
            continue
        for command, output in commands(body):
            done = subprocess.run(
                command,
                shell=True,
                cwd=tmp_path,
                env=os.environ | {"PATH": path},
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                check=False,
            )
            assert without_times(done.stdout) == without_times(output), command
            ran += 1
    assert ran > 3
