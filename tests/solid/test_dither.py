"""Dither: flat, slanting faces are no longer exactly flat, by next to nothing, and everything else stays as it is."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.crease import creased
from fabricate.mesh.cube import cube
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.torus import torus
from fabricate.solid.assembly import Assembly, assembly
from fabricate.solid.dither import REACH, dithered
from fabricate.solid.part import Part
from fabricate.solid.settling import fitted_cut
from fabricate.solid.solids import solids
from fabricate.surface.sizing import sized, tiled
from fabricate.triangles.crossing import crossing_triangles

HALF = np.sqrt(0.5)
TURN = np.array([[HALF, -HALF, 0.0], [HALF, HALF, 0.0], [0.0, 0.0, 1.0]])
"""By 45 degrees about the z axis."""


def skin(mesh: PolygonMesh, *, clearance: float) -> Assembly:
    """Return the parts of a body hardly under its surface."""
    surface = fitted_cut(
        grown_duotone(tiled(sized(mesh, size=60), tile_size=12), tree="random", seed=3),
        tolerance=0.3,
        clearance=clearance,
    )
    return assembly(surface, surface.points - 0.01 * surface.normals, clearance=clearance, core="hollow")


def turned_cube() -> PolygonMesh:
    mesh = creased(cube(divisions=2), angle=40.0)
    return mesh.moved(mesh.points @ TURN.T)


def alarms(part: Part) -> int:
    """Return how many triangles PyMeshLab takes for crossing, which tests in floating point."""
    pymeshlab = pytest.importorskip("pymeshlab")
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(pymeshlab.Mesh(part.points, part.triangles.astype(np.int32)))
    meshes.compute_selection_by_self_intersections_per_face()
    return int(meshes.current_mesh().selected_face_number())


@pytest.fixture(scope="module")
def flat() -> Assembly:
    return skin(turned_cube(), clearance=0.0)


def test_slanting_faces_move_by_nanometres_and_faces_in_coordinate_planes_stay_in_them(flat: Assembly) -> None:
    moves = np.abs(dithered(flat).points - flat.points)
    assert moves.max() <= REACH + np.spacing(np.float32(30.0))
    top = flat.points[:, 2].max()
    of_side = np.abs(flat.points[:, 2]) < top - 3.0
    assert (moves[of_side].max(axis=1) > 0.0).mean() > 0.9
    of_top = (flat.points[:, 2] > top - 0.1) & (np.abs(flat.points[:, :2]).sum(axis=1) < 25.0)
    assert (moves[of_top].max(axis=1) > 0.0).mean() < 0.1


def test_the_same_assembly_gives_the_same_points(flat: Assembly) -> None:
    assert (dithered(flat).points == dithered(flat).points).all()


@pytest.mark.parametrize("mesh", [torus(around=8, across=4, tube=0.45), creased(cube(divisions=2), angle=40.0)])
def test_round_bodies_stay_and_boxes_nearly_so(mesh: PolygonMesh) -> None:
    made = skin(mesh, clearance=0.3)
    moved = (dithered(made).points != made.points).any(axis=1)
    assert moved.mean() < 0.05


def test_parts_that_touch_share_their_faces_to_the_last_bit(flat: Assembly) -> None:
    yellow, blue = ({tuple(point) for point in part.points.tolist()} for part in dithered(flat).parts)
    before = [{tuple(point) for point in part.points.tolist()} for part in flat.parts]
    assert len(yellow & blue) == len(before[0] & before[1]) > 0


def test_what_would_cross_stays_as_it_was(flat: Assembly, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fabricate.solid.dither.REACH", 1.0)
    assert dithered(flat) is flat


def test_a_test_in_floating_point_gives_no_false_alarm(monkeypatch: pytest.MonkeyPatch) -> None:
    duotone = grown_duotone(tiled(sized(turned_cube(), size=60), tile_size=12), tree="random", seed=3)
    surface = fitted_cut(duotone, tolerance=0.3, clearance=0.3)
    with monkeypatch.context() as context:
        context.setattr("fabricate.solid.solids.dithered", lambda made: made)
        plain = solids(surface, thickness=2.0, clearance=0.3)
    assert sum(map(alarms, plain.parts)) > 0, "the case does not show what it is for"
    made = solids(surface, thickness=2.0, clearance=0.3)
    assert sum(map(alarms, made.parts)) == 0
    assert all(len(crossing_triangles(part.points, part.triangles)) == 0 for part in made.parts)
