"""Fitting: the limit surface comes to lie on the target, stays crossing-free, and keeps tiles and colours."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from fabricate.duotone.catmull_clark import catmull_clark, subdivided
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.errors import SolidError
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus
from fabricate.prepare.triangle_mesh import fanned
from fabricate.surface import fitting
from fabricate.surface.cut import CutSurface, cut
from fabricate.surface.deviation import Deviation, deviation
from fabricate.surface.fitting import fitted
from fabricate.surface.limit import LimitSurface, limit_vertices
from fabricate.triangles.crossing import crossing_triangles


def surface_of(quads: QuadMesh) -> CutSurface:
    return cut(random_duotone(quads, seed=1), LimitSurface.of(quads), rings=(0.5,), resolution=3)


def off(quads: QuadMesh, onto: trimesh.Trimesh) -> Deviation:
    made = surface_of(quads)
    return deviation(made.points, made.triangles, np.array(onto.vertices), np.array(onto.faces))


def fitted_to(quads: QuadMesh, onto: trimesh.Trimesh) -> QuadMesh:
    return fitted(quads, np.array(onto.vertices), np.array(onto.faces))


CASES = {
    "cube as a sphere": (cube(divisions=2).scaled(1.2), trimesh.creation.icosphere(subdivisions=4, radius=1)),
    "sphere": (sphere(faces="triangles", frequency=2), trimesh.creation.icosphere(subdivisions=4)),
    "torus": (
        torus(around=12, across=6, tube=0.4).scaled(10.0),
        trimesh.creation.torus(10.0, 4.0, major_sections=96, minor_sections=48),
    ),
    "ellipsoid": (
        sphere(faces="triangles", frequency=2),
        trimesh.creation.icosphere(subdivisions=4).apply_scale([1.3, 1.0, 0.8]),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_the_limit_comes_to_lie_on_the_target(name: str) -> None:
    mesh, onto = CASES[name]
    quads = subdivided(mesh, levels=1)
    made = fitted_to(quads, onto)
    assert off(made, onto).mean < 0.5 * off(quads, onto).mean
    assert off(made, onto).max < 0.02 * float(np.linalg.norm(onto.extents))
    surface = surface_of(made)
    assert len(crossing_triangles(surface.points, surface.triangles)) == 0


def test_only_points_move() -> None:
    mesh, onto = CASES["torus"]
    quads = subdivided(mesh, levels=1)
    made = fitted_to(quads, onto)
    assert (made.tiles == quads.tiles).all()
    assert (made.yellow == quads.yellow).all()
    assert made.genus == quads.genus == 1


def test_a_limit_that_lies_there_already_stays() -> None:
    quads = subdivided(CASES["torus"][0], levels=1)
    finer = catmull_clark(catmull_clark(catmull_clark(quads).mesh).mesh).mesh
    corners = finer.tiles[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)
    made = fitted(quads, limit_vertices(finer), corners)
    assert np.linalg.norm(made.points - quads.points, axis=1).max() < 0.05


def crossing_bow() -> PolygonMesh:
    """Return a cage whose two ends, far apart along it, lie within each other."""
    box = cube(divisions=6)
    x, y, z = box.points.T
    angle = 3.4 * x
    radius = 1.0 + 0.2 * z
    return PolygonMesh(
        np.stack([radius * np.sin(angle), 0.2 * y, radius * np.cos(angle)], axis=1), box.corners, box.offsets
    )


def test_a_limit_that_crosses_itself_is_undone_or_refused() -> None:
    quads = subdivided(crossing_bow(), levels=1)
    crossing = surface_of(quads)
    assert len(crossing_triangles(crossing.points, crossing.triangles)) > 0
    ball = trimesh.creation.icosphere(subdivisions=3)
    try:
        made = surface_of(fitted_to(quads, ball))
    except SolidError as error:
        assert "crosses itself" in str(error)  # noqa: PT017
    else:
        assert len(crossing_triangles(made.points, made.triangles)) == 0


@pytest.mark.parametrize("crosses", [True, False])
def test_a_refusal_says_whether_the_target_crosses_itself(crosses: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise SolidError("no way")

    monkeypatch.setattr(fitting, "untangled", refuse)
    bow, ball = fanned(crossing_bow()), trimesh.creation.icosphere(subdivisions=3)
    onto = trimesh.Trimesh(bow.points, bow.triangles, process=False) if crosses else ball
    said = '^no way; the mesh crosses itself, too, .* prepare.repair = "wrap"' if crosses else "^no way$"
    with pytest.raises(SolidError, match=said):
        fitted_to(subdivided(crossing_bow(), levels=1), onto)


def test_a_limit_that_crosses_itself_where_it_misses_its_target_is_drawn_out_of_itself() -> None:
    """A cage pulled through itself at one point, on a target that is not: nothing is lost by untangling."""
    mesh, onto = CASES["torus"]
    quads = subdivided(mesh, levels=1)
    points = quads.points.copy()
    points[np.argmax(points[:, 2])] -= [0.0, 0.0, 26.0]
    pulled = replace(quads, points=points)
    tangled = surface_of(pulled)
    assert len(crossing_triangles(tangled.points, tangled.triangles)) > 0
    made = fitted_to(pulled, onto)
    surface = surface_of(made)
    assert len(crossing_triangles(surface.points, surface.triangles)) == 0
    assert off(made, onto).max < 0.03 * float(np.linalg.norm(onto.extents))
