"""Inspections: what run would do is what it does."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.errors import MeshError
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.mesh.torus import torus
from fabricate.prepare.inspection import inspected
from fabricate.prepare.prepared import prepared

RING = torus(around=8, across=4, tube=0.45)


def without_first_face(mesh: PolygonMesh) -> PolygonMesh:
    size = int(mesh.offsets[1])
    return PolygonMesh(mesh.points, mesh.corners[size:], mesh.offsets[1:] - size)


def with_first_face_flipped(mesh: PolygonMesh) -> PolygonMesh:
    corners = mesh.corners.copy()
    corners[: mesh.offsets[1]] = corners[: mesh.offsets[1]][::-1]
    return PolygonMesh(mesh.points, corners, mesh.offsets)


def twice(mesh: PolygonMesh) -> PolygonMesh:
    count = len(mesh.points)
    return PolygonMesh(
        np.concatenate([mesh.points, mesh.points + 5.0]),
        np.concatenate([mesh.corners, mesh.corners + count]),
        np.concatenate([mesh.offsets, mesh.offsets[1:] + len(mesh.corners)]),
    )


@pytest.mark.parametrize(
    ("mesh", "usable", "words"),
    [
        (RING, True, ("as it is", "genus 1", "its own 32 faces")),
        (geodesic_sphere(frequency=30), True, ("as it is", "genus 0", "new quads", "18000 triangles")),
        (with_first_face_flipped(RING), True, ("repair it: 1", "genus 1")),
        (without_first_face(RING), False, ("refuse", "open boundary of 4 edges", "wrap")),
        (twice(cube(divisions=2)), False, ("2 bodies", '"largest"', '"each"')),
    ],
)
def test_the_plan_is_what_a_run_does(mesh: PolygonMesh, *, usable: bool, words: tuple[str, ...]) -> None:
    found = inspected(mesh)
    assert found.usable == usable
    assert [word for word in words if word not in "; ".join(found.plan)] == []
    if usable:
        (body,) = prepared(mesh, repair="gentle", components="only", crease=None)
        assert sum(action.count for action in body.actions) == ("repair it: 1" in words)
    else:
        with pytest.raises(MeshError):
            prepared(mesh, repair="gentle", components="only", crease=None)
