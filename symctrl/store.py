"""Verdicts kept between runs, by the digest of what was decided.

An entry is only a proposal: whoever takes a certificate from here has the kernel check it again.
"""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Mapping
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from symctrl import files
from symctrl.certify import digest as digest_of

FORMAT = "symctrl-store/1"


class Store:
    """A folder with one file a verdict. It may be shared by processes and lost at any time.

    folder: made when the first verdict is put.
    run: if given, only entries that a store with the same `run` has put are found: the store begins empty.
    """

    def __init__(self, folder: Path, run: str = "") -> None:
        self.folder = folder
        self.run = run

    def get(self, digest: str) -> dict[str, Any] | None:
        """The verdict put under `digest` by this same library, or None, also where the entry is damaged."""
        path = self._path(digest)
        try:
            entry = json.loads(path.read_bytes())
        except (OSError, ValueError, RecursionError):
            return None
        if not isinstance(entry, dict) or not isinstance(entry.get("verdict"), dict):
            return None
        verdict: dict[str, Any] = entry["verdict"]
        run = self.run or entry.get("run")
        return verdict if entry == _entry(digest, verdict, run) else None

    def put(self, digest: str, verdict: Mapping[str, Any]) -> None:
        """Keep `verdict`, which must be JSON; what was there under `digest` is replaced.

        Nothing is kept, and nothing is said, where the folder cannot be written: a run without a store is
        slower and otherwise the same.
        """
        path = self._path(digest)
        text = files.as_text(_entry(digest, verdict, self.run))
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            files.write(path, text)
        except OSError:
            return

    def _path(self, digest: str) -> Path:
        if not re.fullmatch("[0-9a-f]{64}", digest):
            raise ValueError(f"a digest must be 64 hexadecimal digits, instead got {digest!r}")
        return self.folder / digest[:2] / f"{digest[2:]}.json"


def folder() -> Path:
    """Where verdicts are kept: SYMCTRL_CACHE, or the user's cache folder as the platform has it."""
    given = os.environ.get("SYMCTRL_CACHE")
    if given:
        return Path(given)
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", Path.home() / "AppData" / "Local")) / "symctrl" / "Cache"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches" / "symctrl"
    base = Path(os.environ.get("XDG_CACHE_HOME", ""))
    return (base if base.is_absolute() else Path.home() / ".cache") / "symctrl"


def _entry(digest: str, verdict: Mapping[str, Any], run: object) -> dict[str, Any]:
    return {
        "format": FORMAT,
        "library": _library(),
        "run": run,
        "digest": digest,
        "sha256": digest_of(verdict),
        "verdict": verdict,
    }


@cache
def _library() -> str:
    """Digest of the library's own source: what other code has decided is decided again."""
    root = Path(__file__).parent
    total = sha256()
    for path in sorted(root.rglob("*.py")):
        total.update(f"{path.relative_to(root)}\0".encode() + sha256(path.read_bytes()).digest())
    return total.hexdigest()
