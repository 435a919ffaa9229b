"""Files that appear whole or not at all, and readable reasons when they can't be written."""

from __future__ import annotations

import errno
import secrets
from pathlib import Path

from fabricate.errors import OutputError

_ADVICE = {
    errno.EACCES: "choose a place that you may write to",
    errno.EPERM: "choose a place that you may write to",
    errno.EROFS: "choose a place that is not read-only",
    errno.ENOSPC: "free some space or choose another disk",
    errno.EDQUOT: "free some space or choose another disk",
    errno.ENOTDIR: "a file is in the way of a folder: move it or choose another name",
    errno.EEXIST: "a file is in the way of a folder: move it or choose another name",
    errno.EISDIR: "a folder is in the way of a file: move it or choose another name",
    errno.ENAMETOOLONG: "choose a shorter name",
}


def output_error(path: Path, reason: OSError) -> OutputError:
    """Return an `OutputError` of one line: what could not be written, why, and what to do."""
    cause = (reason.strerror or str(reason)).lower()
    advice = _ADVICE.get(reason.errno or 0, "choose another place")
    return OutputError(f"cannot write {path}: {cause}; {advice}")


def beside(path: Path, purpose: str) -> Path:
    """Return a hidden, unused name in the same folder, from which a rename to `path` is atomic."""
    return path.with_name(f".{path.name}.{secrets.token_hex(4)}.{purpose}")


def check_writable(path: Path) -> None:
    """Raise an error if a file can't be written, before work is spent on what it is to hold.

    Raises
    ------
    OutputError
    """
    temporary = beside(path, "part")
    try:
        if path.is_dir():
            raise IsADirectoryError(errno.EISDIR, "Is a directory")
        temporary.touch()
        temporary.unlink()
    except OSError as reason:
        raise output_error(path, reason) from reason


def write_whole(path: Path, content: bytes) -> None:
    """Write a file beside `path` and rename it to `path`; a file already there is replaced.

    Raises
    ------
    OutputError
        If it can't be written; `path` is then as it was before.
    """
    temporary = beside(path, "part")
    try:
        try:
            temporary.write_bytes(content)
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as reason:
        raise output_error(path, reason) from reason
