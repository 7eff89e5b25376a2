"""A study is found by name or path, imported once, and its author's errors are told in the author's lines."""

import subprocess
import sys
from pathlib import Path

import pytest

from symctrl import registry
from symctrl.written import StudyError

NAMED = "from symctrl.study import Study\nstudy = Study('{}', source='s')\n"
GOOD = '''\
"""A study of one's own.

More about it.
"""
from symctrl.study import Study
import neighbour

study = Study("mine", source="own design")
seen = neighbour.VALUE
'''


@pytest.fixture
def install(tmp_path, monkeypatch):
    """Installs a distribution whose entry points are the given studies, as `pip` would lay it out."""
    site = tmp_path / "site"
    info = site / "plugin-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: plugin\nVersion: 1.0\n")
    monkeypatch.syspath_prepend(str(site))

    def add(**modules):
        lines = [f"[{registry.GROUP}]", *(f"{name} = {module}" for name, module in modules.items())]
        (info / "entry_points.txt").write_text("\n".join(lines))
        return site

    return add


@pytest.fixture
def write(tmp_path):
    def to(name, text):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return str(path)

    return to


def test_installed_studies_are_listed_without_importing_them(install):
    site = install(zeta="wrecked", alpha="wrecked.inner")
    (site / "wrecked.py").write_text('"""What it is about.\n\nMore."""\nraise SystemExit("imported")\n')
    found = registry.installed()
    assert found.items() >= {"zeta": "wrecked", "alpha": "wrecked.inner"}.items()
    assert list(found) == sorted(found)
    assert registry.summary("wrecked") == "What it is about."
    assert "wrecked" not in sys.modules


@pytest.mark.parametrize("text", ["x = 1", "def (", "\0", ""])
def test_a_module_without_a_readable_docstring_has_no_summary(install, text):
    (install(odd="odd_module") / "odd_module.py").write_text(text)
    assert registry.summary("odd_module") == ""
    assert registry.summary("no_such_module") == ""
    assert registry.summary("no_such_package.module") == ""


def test_an_installed_study_is_loaded(install):
    package = install(mine="plugin_of_mine") / "plugin_of_mine"
    package.mkdir()
    (package / "__init__.py").write_text(NAMED.format("mine"))
    assert registry.load("mine").name == "mine"
    assert registry.load("mine") is registry.load("mine")


def test_a_users_file_is_imported_once_with_its_folder_at_hand_only_then(write, tmp_path, monkeypatch):
    write("neighbour.py", "VALUE = 7\n")
    path = write("own.py", GOOD)
    before = list(sys.path)
    study = registry.load(path)
    assert study.name == "mine"
    assert sys.path == before
    monkeypatch.chdir(tmp_path)
    assert registry.load("own.py") is study
    assert "own" not in sys.modules
    sys.modules.pop("neighbour")


def test_two_files_of_one_name_are_two_studies(write):
    paths = [write(f"{name}/own.py", NAMED.format(name)) for name in "ab"]
    assert [registry.load(path).name for path in paths] == ["a", "b"]


def test_an_edit_within_the_same_second_is_seen(write):
    """A bytecode file would still be valid: the source has the same length and the same second."""
    names = []
    for name in ("one", "two"):
        path = write("own.py", NAMED.format(name))
        code = f"from symctrl import registry; print(registry.load({path!r}).name)"
        names.append(subprocess.check_output([sys.executable, "-c", code], text=True))
    assert names == ["one\n", "two\n"]


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        ("quaternion_fedback", "nearest: quaternion_feedback"),
        ("zzz", "installed: .*quaternion_feedback"),
        ("own", "for the file write own.py"),
        ("missing.py", "no such file"),
        ("folder/missing", "no such file"),
        (".", "no such file"),
        ("gone", "its module no_such_module is missing"),
    ],
)
def test_an_unknown_name_is_met_with_the_nearest(install, write, monkeypatch, asked, says):
    install(quaternion_feedback="x", gone="no_such_module")
    monkeypatch.chdir(Path(write("own.py", GOOD)).parent)
    with pytest.raises(registry.StudyNotFoundError, match=says) as caught:
        registry.load(asked)
    assert "\n" not in str(caught.value)


def test_an_error_in_the_authors_code_is_told_in_the_authors_lines(write):
    path = write("own.py", "import json\n\ndef broken():\n    return json.loads('{')\n\nbroken()\n")
    with pytest.raises(registry.StudyFailedError) as caught:
        registry.load(path)
    lines = str(caught.value).splitlines()
    assert lines[0] == f"{path}: the study's code failed:"
    assert [line.strip() for line in lines[1:] if path in line] == [
        f'File "{path}", line 6, in <module>',
        f'File "{path}", line 4, in broken',
    ]
    assert "return json.loads('{')" in str(caught.value)
    assert lines[-1].startswith("json.decoder.JSONDecodeError: Expecting property name")
    assert len([line for line in lines if "json/decoder.py" in line]) == 1
    assert "registry.py" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("x = (\n", "'\\(' was never closed"),
        ("import no_such_library\n", "No module named 'no_such_library'"),
        ("import sys\nsys.exit('no')\n", "SystemExit: no"),
        ("\0", "null bytes"),
        ("x = 1\n", "has no `study`"),
        ("study = 3\n", "must be a Study, instead got a int"),
    ],
)
def test_a_file_that_is_no_study_is_refused(write, text, says):
    path = write("own.py", text)
    with pytest.raises(registry.StudyFailedError, match=says) as caught:
        registry.load(path)
    assert "own.py" in str(caught.value)


def test_an_error_in_an_installed_study_names_the_package_alone(install):
    package = install(bad="bad_plugin") / "bad_plugin"
    package.mkdir()
    (package / "__init__.py").write_text("from bad_plugin import inner\n")
    (package / "inner.py").write_text("1 / 0\n")
    with pytest.raises(registry.StudyFailedError) as caught:
        registry.load("bad")
    text = str(caught.value)
    assert text.count("  File ") == 2
    assert text.endswith("1 / 0\n    ~~^~~\nZeroDivisionError: division by zero")


def test_an_error_of_the_tool_itself_is_not_blamed_on_the_author(write):
    place = registry.locate(write("own.py", GOOD))
    with pytest.raises(ZeroDivisionError), place.blamed():
        _ = 1 / 0


def test_what_the_study_does_not_have_is_one_line(write):
    place = registry.locate(write("own.py", GOOD))
    says = r"^study .*own.py: no gain k; its gains are c$"
    with pytest.raises(registry.InputError, match=says), place.blamed():
        raise StudyError("no gain k; its gains are c")
