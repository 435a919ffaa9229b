"""Which closed components lie inside which."""

from __future__ import annotations

from collections.abc import Sequence

import igl
import numpy as np

from fabricate.arrays import Floats, Indices, Mask
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.ear_clipping import ear_clipped


def containers(parts: Sequence[PolygonMesh]) -> tuple[Indices, ...]:
    """Return for each closed component the numbers of the others that it lies in, ascending.

    One of its points decides, by the winding number of the other round it, which may be wound either way;
    components that cross each other are not nested if a bounding box tells so.
    """
    low = np.array([part.points.min(axis=0) for part in parts]).reshape(-1, 3)
    high = np.array([part.points.max(axis=0) for part in parts]).reshape(-1, 3)
    within: list[list[int]] = [[] for _ in parts]
    for outer, part in enumerate(parts):
        boxed = ((low > low[outer]) & (high < high[outer])).all(axis=1)
        inner = np.flatnonzero(boxed)
        probes = np.array([parts[number].points[0] for number in inner.tolist()]).reshape(-1, 3)
        for number in inner[_is_inside(part, probes)].tolist():
            within[number].append(outer)
    return tuple(np.array(numbers, dtype=np.int64) for numbers in within)


def _is_inside(part: PolygonMesh, probes: Floats) -> Mask:
    if not len(probes):
        return np.zeros(0, dtype=bool)
    triangles = np.ascontiguousarray(ear_clipped(part).triangles)
    inside: Mask = np.abs(igl.winding_number(np.ascontiguousarray(part.points), triangles, probes)) > 0.5
    return inside
