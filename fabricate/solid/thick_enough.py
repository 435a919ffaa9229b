"""Whether a body is thick enough to be made in two parts at all: most of it thicker than the gap between them."""

from __future__ import annotations

import numpy as np

from fabricate.arrays import Floats, Indices
from fabricate.errors import SolidError
from fabricate.triangles.normals import area_vectors, unit
from fabricate.triangles.ray_casting import first_hits

START = 1e-3
"""How far under the surface a ray begins, mm, so that it does not hit where it comes from."""


def check_thick(points: Floats, triangles: Indices, *, clearance: float) -> None:
    """Raise an error if the body under half of a closed surface, mm, is thinner than the clearance.

    Raises
    ------
    SolidError
    """
    typical = _typical_thickness(points, triangles)
    if typical < clearance:
        raise SolidError(
            f"half of the body is no more than {typical:.2g} mm thick, and the clearance is {clearance:g} mm: that is "
            "no body to make walls of; ask for a larger source.size or a smaller solid.clearance, or thicken the mesh, "
            'as prepare.repair = "wrap" does with sheets'
        )


def _typical_thickness(points: Floats, triangles: Indices) -> float:
    """Return the median over the surface of how far it is straight through the body, mm."""
    vectors = area_vectors(points, triangles)
    areas, inward = np.linalg.norm(vectors, axis=1), -unit(vectors)
    through = first_hits(points, triangles, points[triangles].mean(axis=1) + START * inward, inward).distance
    order = np.argsort(through)
    covered = np.cumsum(areas[order])
    return float(through[order][np.searchsorted(covered, 0.5 * covered[-1])])
