"""Geometry of a part: volume, area, exact self-intersection, and whether Manifold takes it as a solid."""

from __future__ import annotations

import numpy as np
from manifold3d import Error, Manifold, Mesh64

from fabricate.arrays import Floats, Indices
from fabricate.checks.check import Check
from fabricate.checks.wording import counted
from fabricate.solid.part import Part
from fabricate.triangles.normals import area_vectors

VOLUME_TOLERANCE = 1e-6
"""Largest relative difference between Manifold's volume of a part and ours."""


def signed_volume(part: Part) -> float:
    """Return the volume that a closed part encloses, mm3; negative if it is inside out."""
    return enclosed_volume(part, area_vectors(part.points, part.triangles))


def enclosed_volume(part: Part, vectors: Floats) -> float:
    """Return the same, mm3, where the part's area vectors, (m, 3) mm2, are known already."""
    if not len(part.points):
        return 0.0
    middle = (part.points.min(axis=0) + part.points.max(axis=0)) / 2  # less cancellation
    return float(np.einsum("ij,ij->", (part.points - middle)[part.triangles[:, 0]], vectors) / 6)


def area(vectors: Floats) -> float:
    """Return the surface area, mm2, of triangles with these area vectors, (m, 3) mm2."""
    return 0.5 * float(np.linalg.norm(vectors, axis=1).sum())


def triangle_areas(part: Part) -> Floats:
    """Return the area of each triangle, (m,) float, mm2."""
    areas: Floats = 0.5 * np.linalg.norm(area_vectors(part.points, part.triangles), axis=1)
    return areas


def as_manifold(part: Part) -> Manifold:
    """Return the part as Manifold holds it; empty, with a status that says why, if it is none."""
    return Manifold(Mesh64(np.array(part.points), part.triangles.astype(np.uint64)))


def is_solid(manifold: Manifold) -> bool:
    """Tell whether a Manifold is one that encloses a volume, the right side out."""
    return bool(manifold.status() == Error.NoError and manifold.volume() > 0.0)


def volume_check(part: Part, volume: float) -> Check:
    """Check that a part's volume is positive, which it is when the triangles face outward."""
    return Check(
        f"{part.name}.volume",
        ok=volume > 0.0,
        message=f"the volume of {part.name} must be positive, and it is {volume:.6g} mm3"
        + ("" if volume >= 0.0 else "; its triangles face inward"),
    )


def self_intersection_check(part: Part, pairs: Indices) -> Check:
    """Check that no triangles cross; points at the smaller triangle of each pair.

    Parameters
    ----------
    part : Part
    pairs : (k, 2) int
        As `fabricate.triangles.crossing.crossing_triangles` returns them.
    """
    code = f"{part.name}.self_intersections"
    if not len(pairs):
        return Check(code, ok=True, message=f"no triangles of {part.name} cross")
    areas = triangle_areas(part)
    smaller = np.unique(np.where(areas[pairs[:, 0]] <= areas[pairs[:, 1]], pairs[:, 0], pairs[:, 1]))
    return Check(
        code,
        ok=False,
        message=f"no triangles of {part.name} may cross, "
        f"but {counted(len(pairs), 'pair')} of {len(part.triangles)} triangles do",
        where=part.points[part.triangles[smaller]].mean(axis=1),
    )


def manifold_check(part: Part, manifold: Manifold, *, volume: float) -> Check:
    """Check that Manifold takes the part as a solid, and finds the same volume in it."""
    code = f"{part.name}.manifold"
    if not is_solid(manifold):
        fine = manifold.status() == Error.NoError
        reason = "finds no volume in it" if fine else f"says {manifold.status().name}"
        return Check(code, ok=False, message=f"Manifold must take {part.name} as a solid, but it {reason}")
    found = manifold.volume()
    return Check(
        code,
        ok=abs(found - volume) <= VOLUME_TOLERANCE * abs(volume),
        message=f"Manifold takes {part.name} as a solid of {found:.8g} mm3, and {volume:.8g} mm3 is expected",
    )
