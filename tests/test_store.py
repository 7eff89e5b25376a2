"""The store gives back what was put, or nothing: never something else."""

import hashlib
import json
import multiprocessing
import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from symctrl import files, store
from symctrl.store import Store

KEY, OTHER = "0" * 64, "1" * 64
VERDICT = {"outcome": "proved", "certificate": {"proof": ["1/3", 2, None]}}

plain = st.none() | st.booleans() | st.integers() | st.text()
values = st.recursive(plain, lambda inner: st.lists(inner, max_size=3), max_leaves=6)


@given(st.dictionaries(st.text(), values, max_size=4), st.binary())
def test_what_was_put_is_got_under_its_digest_alone(tmp_path_factory, verdict, key):
    digest = hashlib.sha256(key).hexdigest()
    kept = Store(tmp_path_factory.mktemp("store"))
    assert kept.get(digest) is None
    kept.put(digest, verdict)
    assert kept.get(digest) == verdict
    assert kept.get(hashlib.sha256(digest.encode()).hexdigest()) is None


def entry(kept):
    (path,) = kept.folder.rglob("*.json")
    return path


@pytest.mark.parametrize("damage", [b"", b"{", b"[]", b'"x"', b"\xff", b"[" * 100_000, b"null"])
def test_a_damaged_entry_is_no_entry_and_can_be_put_again(tmp_path, damage):
    kept = Store(tmp_path)
    kept.put(KEY, VERDICT)
    entry(kept).write_bytes(damage)
    assert kept.get(KEY) is None
    kept.put(KEY, VERDICT)
    assert kept.get(KEY) == VERDICT


@pytest.mark.parametrize("field", ["format", "library", "digest", "sha256", "verdict"])
def test_a_changed_field_is_seen(tmp_path, field):
    kept = Store(tmp_path)
    kept.put(KEY, VERDICT)
    body = json.loads(entry(kept).read_text())
    body[field] = {"outcome": "refuted"} if field == "verdict" else "else"
    entry(kept).write_text(json.dumps(body))
    assert kept.get(KEY) is None


def test_an_entry_under_another_name_is_not_believed(tmp_path):
    kept = Store(tmp_path)
    kept.put(KEY, VERDICT)
    target = kept.folder / OTHER[:2] / f"{OTHER[2:]}.json"
    target.parent.mkdir()
    entry(kept).rename(target)
    assert kept.get(OTHER) is None


def test_what_another_version_of_the_library_decided_is_decided_again(tmp_path, monkeypatch):
    kept = Store(tmp_path)
    kept.put(KEY, VERDICT)
    monkeypatch.setattr(store, "_library", lambda: "another")
    assert kept.get(KEY) is None


def test_a_run_of_its_own_begins_empty_and_is_found_later(tmp_path):
    Store(tmp_path).put(KEY, VERDICT)
    fresh = Store(tmp_path, run="b")
    assert fresh.get(KEY) is None
    fresh.put(KEY, {"outcome": "undecided"})
    assert Store(tmp_path, run="b").get(KEY) == {"outcome": "undecided"}
    assert Store(tmp_path, run="c").get(KEY) is None
    assert Store(tmp_path).get(KEY) == {"outcome": "undecided"}


@pytest.mark.parametrize("digest", ["", "../../etc/passwd", "0" * 63, "G" * 64])
def test_what_is_no_digest_is_refused(tmp_path, digest):
    with pytest.raises(ValueError, match="64 hexadecimal digits"):
        Store(tmp_path).get(digest)


def test_a_folder_that_cannot_be_made_costs_only_the_keeping(tmp_path):
    (tmp_path / "file").write_text("in the way")
    kept = Store(tmp_path / "file" / "store")
    kept.put(KEY, VERDICT)
    assert kept.get(KEY) is None


def test_a_write_that_is_cut_short_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch):
    path = tmp_path / "answer.json"
    files.write(path, "old")

    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(files.os, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        files.write(path, "new")
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_written_file_has_the_rights_that_the_user_gives_new_files(tmp_path):
    (tmp_path / "plain").touch()
    files.write(tmp_path / "ours", "text")
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "plain").stat().st_mode


def _put_often(folder, text):
    for _ in range(400):
        Store(folder).put(KEY, {"outcome": text * 5000})


def test_readers_and_writers_at_once_see_whole_verdicts(tmp_path):
    context = multiprocessing.get_context("spawn")
    writers = [context.Process(target=_put_often, args=(tmp_path, text)) for text in "ab"]
    for writer in writers:
        writer.start()
    seen = set()
    while any(writer.is_alive() for writer in writers):
        found = Store(tmp_path).get(KEY)
        if found is not None:
            seen.add(found["outcome"])
    for writer in writers:
        writer.join()
        assert writer.exitcode == 0
    assert seen <= {"a" * 5000, "b" * 5000}
    assert seen
    assert not list(tmp_path.rglob("*.tmp"))


def test_the_folder_is_the_users_cache(tmp_path, monkeypatch):
    monkeypatch.setattr(store.sys, "platform", "linux")
    monkeypatch.setenv("HOME", str(tmp_path))
    for variable in ("SYMCTRL_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(variable, raising=False)
    assert store.folder() == tmp_path / ".cache" / "symctrl"
    monkeypatch.setenv("XDG_CACHE_HOME", "not/absolute")
    assert store.folder() == tmp_path / ".cache" / "symctrl"
    monkeypatch.setenv("XDG_CACHE_HOME", os.sep + "xdg")
    assert store.folder() == Path("/xdg/symctrl")
    monkeypatch.setenv("SYMCTRL_CACHE", str(tmp_path / "mine"))
    assert store.folder() == tmp_path / "mine"
