"""A closed curve as a PLY file of vertices and edges."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from fabricate.arrays import Floats, frozen
from fabricate.output.files import write_whole

HEADER = """ply
format binary_little_endian 1.0
comment one closed curve, millimetres, z up
element vertex {count}
property double x
property double y
property double z
element edge {count}
property int vertex1
property int vertex2
end_header
"""


def write_curve(path: Path, polyline: Floats) -> None:
    """Write (n, 3) points, mm, as a closed curve: an edge from each to the next, and from last to first.

    Raises
    ------
    ValueError
        If the shape differs or there are fewer than three points.
    OutputError
        If the file can't be written.
    """
    points = frozen(polyline, np.float64, (None, 3))
    if len(points) < 3:
        raise ValueError(f"expected a closed curve of at least 3 points, found {len(points)}")
    start = np.arange(len(points))
    edges = np.stack([start, np.roll(start, -1)], axis=1)
    header = HEADER.format(count=len(points)).encode("ascii")
    write_whole(path, header + points.astype("<f8").tobytes() + edges.astype("<i4").tobytes())
