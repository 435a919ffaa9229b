"""How large a mesh file may be: beyond that it is refused before its size is paid for."""

from __future__ import annotations

from dataclasses import dataclass

from fabricate.errors import ReadError

_MEGABYTE = 1 << 20
_POINTS_PER_FACE = 3  # what triangles that share no points need
_NUMBERS_PER_FACE = 24  # points and faces written as text, with normals, colours and texture coordinates


@dataclass(frozen=True)
class ReadLimits:
    """The largest file that is read; files declare sizes that they do not have, and archives hide theirs.

    Attributes
    ----------
    max_bytes : int
        Size of the file, and of everything unpacked from it together.
    max_faces : int
        Number of faces; those of a part that is placed several times count each time.
    """

    max_bytes: int = 1 << 30
    max_faces: int = 5_000_000

    @property
    def max_points(self) -> int:
        """How many points the faces can use at most, were all of them triangles."""
        return _POINTS_PER_FACE * self.max_faces

    @property
    def max_numbers(self) -> int:
        """How many numbers a text needs for that many faces, whatever else it says about points."""
        return _NUMBERS_PER_FACE * self.max_faces

    def check_bytes(self, count: int, *, what: str = "the file") -> None:
        """Raise ReadError if a file, or what is packed into it, is larger than is read."""
        if count > self.max_bytes:
            raise ReadError(
                f"at most {self.max_bytes / _MEGABYTE:.6g} MB are read, but {what} has {count / _MEGABYTE:.6g} MB; "
                "raise prepare.max_file_mb if it is meant to be that large"
            )

    def check_faces(self, count: int) -> None:
        """Raise ReadError if there are more faces than are read."""
        _check_count(count, self.max_faces, "faces")

    def check_points(self, count: int) -> None:
        """Raise ReadError if there are more points than all faces that are read could use."""
        _check_count(count, self.max_points, "points")

    def check_numbers(self, count: int) -> None:
        """Raise ReadError if a text holds more numbers than all faces that are read could need."""
        _check_count(count, self.max_numbers, "numbers")


DEFAULT_LIMITS = ReadLimits()
"""1024 MB and 5 million faces: larger than any printable part, and less than a workstation's memory."""


def _check_count(count: int, most: int, name: str) -> None:
    if count > most:
        raise ReadError(
            f"at most {most} {name} are read, found {count} or more; raise prepare.max_faces if the mesh is meant "
            "to be that large, or reduce it first"
        )
