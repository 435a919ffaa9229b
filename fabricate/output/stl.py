"""Parts as binary STL files."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from fabricate.output.files import write_whole
from fabricate.solid.part import Part

# Readers take a file that begins with "solid" for the ASCII form.
HEADER = b"binary STL, millimetres, z up".ljust(80)
TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def write_stl(path: Path, part: Part) -> None:
    """Write a part as binary STL: coordinates in mm, exactly those of the part.

    Normals are computed from the corners as they are stored; a triangle without area has normal zero.

    Raises
    ------
    OutputError
        If the file can't be written.
    """
    corners = part.points[part.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    records = np.zeros(len(corners), dtype=TRIANGLE)
    records["normal"] = normals / np.where(lengths > 0, lengths, 1.0)
    records["corners"] = corners
    write_whole(path, HEADER + np.uint32(len(records)).astype("<u4").tobytes() + records.tobytes())
