"""Files that are written whole or not at all, and the one kind of error for what the user gave."""

from __future__ import annotations

import json
import os
import tempfile
from pathlib import Path
from typing import Any


class InputError(ValueError):
    """What the user gave cannot be used; the message says what, where, and what would be right."""


def write(path: Path, text: str) -> None:
    """`path` holds `text` in UTF-8 when this returns, and is as it was if it does not. Raises OSError."""
    write_bytes(path, text.encode())


def write_bytes(path: Path, content: bytes) -> None:
    """As `write`."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name[:50]}.", suffix=".tmp")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.chmod(name, 0o666 & ~_umask())
        os.replace(name, path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def as_text(obj: Any) -> str:
    """One line of JSON. Raises ValueError for a NaN or an infinity, which JSON has no form for."""
    return json.dumps(obj, ensure_ascii=False, allow_nan=False) + "\n"


def read(path: Path) -> str:
    """The text of a file that the user named. Raises InputError where it cannot be read or is not UTF-8."""
    try:
        return path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        byte = error.object[error.start]
        raise InputError(f"{path}: is not UTF-8 text: byte {error.start + 1} is 0x{byte:02x}") from None


def refuse_unwritable(path: Path) -> None:
    """Raises InputError now if a file could not be written at `path` later, so that no long work is lost."""
    if path.is_dir():
        raise InputError(f"{path}: is a folder, a file name is needed")
    try:
        with tempfile.TemporaryFile(dir=path.parent):
            return
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror}") from None


def refuse_unwritable_folder(path: Path) -> None:
    """Raises InputError now if `path` is no folder in which files could be written later; nothing is made."""
    there = next(folder for folder in (path, *path.absolute().parents) if folder.exists())
    try:
        with tempfile.TemporaryFile(dir=there):
            return
    except OSError as error:
        raise InputError(f"{path}: is not a folder that can be written: {error.strerror}") from None


def _umask() -> int:
    mask = os.umask(0o077)
    os.umask(mask)
    return mask
