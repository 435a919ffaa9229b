"""Results of long preparation, kept on disk by content: another curve on the same scan does not wait for them."""

from __future__ import annotations

import hashlib
import io
import json
import secrets
import zipfile
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

import numpy as np

from fabricate.errors import PrepareError
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.versions import installed_version

WORTH_KEEPING = 1.0
"""Work that takes less time than this, s, is done again instead."""

MOST_KEPT = 200
"""Results kept; the oldest goes first."""

MAKERS = ("numpy", "scipy", "pymeshlab", "pyquadriflow", "libigl")
"""Libraries whose version decides what comes out, beside this program's own source."""


@dataclass(frozen=True, eq=False)
class Kept:
    """A mesh, and sentences about how it was made."""

    mesh: PolygonMesh
    words: tuple[str, ...]


@dataclass(frozen=True)
class Store:
    """A folder of results, each named by the hash of all that it was made from; None keeps nothing.

    A folder that can't be read or written, and a damaged file in it, cost time and nothing else.
    """

    folder: Path | None = None

    def recalled(self, mesh: PolygonMesh, asked: str, make: Callable[[], Kept]) -> Kept:
        """Return what `make` makes of a mesh, or made when it was last `asked` for the same with the same mesh."""
        if self.folder is None:
            return make()
        path = self.folder / f"{_fingerprint(mesh, asked)}.npz"
        found = _read(path)
        if found is not None:
            return found
        begin = perf_counter()
        made = make()
        if perf_counter() - begin > WORTH_KEEPING:
            _write(path, made)
        return made


NOTHING_KEPT = Store()


def checked_store(folder: Path) -> Store:
    """Return the store of a folder that somebody named: one that cannot be used is a mistake.

    Raises
    ------
    PrepareError
        If the folder can't be made or written.
    """
    trial = folder / f".{secrets.token_hex(4)}.part"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        trial.touch()
        trial.unlink()
    except OSError as reason:
        cause = (reason.strerror or str(reason)).lower()
        raise PrepareError(f"cannot keep anything in the cache folder {folder}: {cause}; name another one") from reason
    return Store(folder)


def _fingerprint(mesh: PolygonMesh, asked: str) -> str:
    digest = hashlib.sha256(f"{asked}\n{_makers()}\n".encode())
    for array in (mesh.points, mesh.corners, mesh.offsets, mesh.creases):
        digest.update(f"{array.shape}\n".encode() + array.tobytes())
    return digest.hexdigest()


def _makers() -> str:
    """Return what would make the result: the versions of libraries, and a hash of this package's source."""
    package = Path(__file__).parents[1]
    source = hashlib.sha256()
    for path in sorted(package.rglob("*.py")):
        source.update(path.read_bytes())
    return " ".join([source.hexdigest(), *(f"{name} {installed_version(name)}" for name in MAKERS)])


def _read(path: Path) -> Kept | None:
    try:
        with np.load(path, allow_pickle=False) as arrays:
            mesh = PolygonMesh(arrays["points"], arrays["corners"], arrays["offsets"], arrays["creases"])
            return Kept(mesh, tuple(json.loads(arrays["words"].tobytes())))
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None


def _write(path: Path, made: Kept) -> None:
    content = io.BytesIO()
    mesh, words = made.mesh, np.frombuffer(json.dumps(made.words).encode(), dtype=np.uint8)
    np.savez(content, points=mesh.points, corners=mesh.corners, offsets=mesh.offsets, creases=mesh.creases, words=words)
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(4)}.part")
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            temporary.write_bytes(content.getvalue())
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
        for old in sorted(path.parent.glob("*.npz"), key=lambda each: each.stat().st_mtime)[:-MOST_KEPT]:
            old.unlink(missing_ok=True)
