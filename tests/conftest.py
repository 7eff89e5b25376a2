"""What all tests share: none reads or writes the user's own store of verdicts."""

import sys
from pathlib import Path

import pytest

from symctrl import cli

SYMCTRL = Path(sys.executable).with_name("symctrl")


@pytest.fixture(scope="session", autouse=True)
def _store_of_its_own(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SYMCTRL_CACHE", str(tmp_path_factory.mktemp("store")))
        yield


@pytest.fixture
def run(capsys, tmp_path, monkeypatch):
    """Runs the command line in a folder of its own; gives exit code, standard output and standard error."""
    monkeypatch.chdir(tmp_path)

    def run(*args):
        code = cli.run([str(arg) for arg in args])
        out, err = capsys.readouterr()
        return code, out, err

    return run
