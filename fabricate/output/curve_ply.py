"""Closed curves as a PLY file of vertices and edges."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from fabricate.arrays import Floats, frozen
from fabricate.output.files import write_whole

HEADER = """ply
format binary_little_endian 1.0
comment {curves}, millimetres, z up
element vertex {count}
property double x
property double y
property double z
{joints}element edge {count}
property int vertex1
property int vertex2
end_header
"""


def write_curves(path: Path, polylines: Sequence[Floats], middles: Sequence[Floats] = ()) -> None:
    """Write points, (n, 3) mm for each of one or more closed curves: an edge from each to the next, and last to first.

    `middles` are, for each curve, r places on the mid-line of the joint under each of its points, (r, n, 3) mm. A point
    has them as properties: joint0_x, joint0_y, joint0_z and so on.

    Raises
    ------
    ValueError
        If the shape differs, there are no curves, or one has fewer than three points.
    OutputError
        If the file can't be written.
    """
    curves = [frozen(polyline, np.float64, (None, 3)) for polyline in polylines]
    fewest = min(map(len, curves), default=0)
    if fewest < 3:
        raise ValueError(f"expected closed curves of at least 3 points, found {len(curves)}, the shortest of {fewest}")
    under = [frozen(each, np.float64, (None, len(curve), 3)) for each, curve in zip(middles, curves, strict=False)]
    points = np.concatenate(curves)
    rows = np.concatenate([points[None], np.concatenate(under, axis=1)]) if under else points[None]
    joints = "".join(f"property double joint{k}_{axis}\n" for k in range(len(rows) - 1) for axis in "xyz")
    starts = np.split(np.arange(len(points)), np.cumsum([len(curve) for curve in curves])[:-1])
    edges = np.concatenate([np.stack([start, np.roll(start, -1)], axis=1) for start in starts])
    said = "one closed curve" if len(curves) == 1 else f"{len(curves)} closed curves, one after the other"
    header = HEADER.format(curves=said, count=len(points), joints=joints).encode("ascii")
    write_whole(path, header + rows.swapaxes(0, 1).astype("<f8").tobytes() + edges.astype("<i4").tobytes())
