"""Remeshing: tiles of the size asked for, closed, of the same genus, without crossings, and notes where not."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from polyhedra import octahedron

from fabricate.errors import MeshError, PrepareError
from fabricate.formats.reading import read_mesh
from fabricate.mesh.closed import checked_closed, genus, signed_volume
from fabricate.mesh.cube import cube
from fabricate.mesh.knot import trefoil
from fabricate.mesh.pierced import double_torus, genus_six
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus
from fabricate.prepare import remesh
from fabricate.prepare.quadriflow import quadriflow_exists
from fabricate.prepare.remesh import Cells, Remeshed, remeshed
from fabricate.prepare.soundness import crossing_faces, distances
from fabricate.prepare.tile_sides import tile_sides
from fabricate.prepare.triangle_mesh import fanned
from fabricate.triangles.normals import area_vectors

CORPUS = Path(os.environ.get("FABRICATE_CORPUS", "none")) / "good"
KINDS: tuple[Cells, ...] = get_args(Cells)
SHAPES = {
    "ball": (sphere(faces="triangles", frequency=8).scaled(40.0), 6.0, 0),
    "torus": (torus(around=24, across=10, tube=0.45).scaled(40.0), 6.0, 1),
    "knot": (trefoil(around=96, across=10, tube=0.4).scaled(20.0), 3.0, 1),
    "double torus": (double_torus(hole=0.5, depth=0.5).scaled(50.0), 5.0, 2),
    "octahedron": (octahedron().scaled(50.0), 6.0, 0),
}
"""Meshes, mm, a tile size that suits them and the number of handles."""

needs_quadriflow = pytest.mark.skipif(not quadriflow_exists(), reason="QuadriFlow's wheels are for x86-64 only")


def sampled(mesh: PolygonMesh) -> np.ndarray:
    """Return 2000 random places on a mesh, evenly by area."""
    rng, triangles = np.random.default_rng(1), fanned(mesh)
    areas = np.linalg.norm(area_vectors(triangles.points, triangles.triangles), axis=1)
    corners = triangles.points[triangles.triangles[rng.choice(len(areas), 2000, p=areas / areas.sum())]]
    return np.einsum("ij,ijk->ik", rng.dirichlet([1, 1, 1], 2000), corners)


def check_sound(made: Remeshed, mesh: PolygonMesh, *, tile_size: float, handles: int) -> None:
    cells = checked_closed(made.mesh)
    assert genus(cells) == handles
    assert len(crossing_faces(cells)) == 0
    assert signed_volume(cells) == pytest.approx(signed_volume(mesh), rel=0.3)
    assert np.quantile(distances(cells, sampled(mesh)), 0.99) < 2 * tile_size


@pytest.mark.slow
@pytest.mark.parametrize("cells", KINDS)
@pytest.mark.parametrize("name", SHAPES)
def test_tiles_have_the_size_asked_for(name: str, cells: Cells) -> None:
    mesh, tile_size, handles = SHAPES[name]
    made = remeshed(mesh, cells=cells, tile_size=tile_size, seed=1)
    check_sound(made, mesh, tile_size=tile_size, handles=handles)
    assert np.median(tile_sides(made.mesh)) == pytest.approx(tile_size, rel=0.15)
    if cells != "quads":
        assert made.notes == ()


@needs_quadriflow
def test_quads_are_quads() -> None:
    mesh, tile_size, _ = SHAPES["ball"]
    made = remeshed(mesh, cells="quads", tile_size=tile_size, seed=1)
    assert (made.mesh.face_sizes == 4).all()
    assert made.notes == ()


def test_triangles_are_triangles_and_hexagons_mostly_hexagons() -> None:
    mesh, tile_size, _ = SHAPES["ball"]
    assert (remeshed(mesh, cells="triangles", tile_size=tile_size, seed=1).mesh.face_sizes == 3).all()
    sizes = remeshed(mesh, cells="hexagons", tile_size=tile_size, seed=1).mesh.face_sizes
    assert np.median(sizes) == 6
    assert (6 - sizes).sum() == 12  # Euler: as many corners are missing as in a football


@pytest.mark.parametrize("cells", KINDS)
def test_the_density_of_the_input_does_not_matter(cells: Cells) -> None:
    """A cube of 6 faces and one of 2400 get as many cells."""
    counts = []
    for divisions in (1, 20):
        mesh = cube(divisions=divisions)
        mesh = mesh.scaled(60.0 / float(np.ptp(mesh.points[:, 0])))
        counts.append(len(remeshed(mesh, cells=cells, tile_size=6.0, seed=1).mesh.corners))
    assert counts[0] == pytest.approx(counts[1], rel=0.25)
    assert counts[1] == pytest.approx(600, rel=0.3)


@pytest.mark.parametrize("cells", KINDS)
def test_the_same_input_gives_the_same_cells(cells: Cells) -> None:
    mesh, tile_size, _ = SHAPES["ball"]
    first, again = (remeshed(mesh, cells=cells, tile_size=tile_size, seed=5) for _ in range(2))
    assert first.mesh.points.tobytes() == again.mesh.points.tobytes()
    assert first.mesh.corners.tobytes() == again.mesh.corners.tobytes()


def test_without_quadriflow_triangles_take_the_place_of_quads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(remesh, "quadriflow_exists", lambda: False)
    mesh, tile_size, handles = SHAPES["torus"]
    made = remeshed(mesh, cells="quads", tile_size=tile_size, seed=1)
    check_sound(made, mesh, tile_size=tile_size, handles=handles)
    assert made.notes == ("QuadriFlow is not installed: the cells are triangles instead of quads",)


@pytest.mark.parametrize("broken", ["nothing", "another shape", "too small"])
def test_quads_that_are_not_sound_are_not_taken(broken: str, monkeypatch: pytest.MonkeyPatch) -> None:
    mesh, tile_size, handles = SHAPES["torus"]
    wrong = {
        "nothing": None,
        "another shape": cube(divisions=4).scaled(40.0),
        "too small": torus(around=90, across=40, tube=0.45).scaled(40.0),
    }
    monkeypatch.setattr(remesh, "quadriflow", lambda *_, **__: wrong[broken])
    monkeypatch.setattr(remesh, "quadriflow_exists", lambda: True)
    made = remeshed(mesh, cells="quads", tile_size=tile_size, seed=1)
    check_sound(made, mesh, tile_size=tile_size, handles=handles)
    assert made.notes == ("QuadriFlow found no sound quads of this size: the cells are triangles instead of quads",)


def test_tiles_too_large_for_thin_parts_are_smaller_and_that_is_said() -> None:
    ring = torus(around=60, across=8, tube=0.08).scaled(50.0)
    made = remeshed(ring, cells="triangles", tile_size=15.0, seed=1)
    assert genus(checked_closed(made.mesh)) == 1
    assert len(made.notes) == 1
    assert "not 15 mm: larger ones would lose thin parts" in made.notes[0]


def test_cells_that_cross_are_noted(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh, tile_size, _ = SHAPES["ball"]
    points = np.array(mesh.points)
    points[0] *= -1.2
    monkeypatch.setattr(remesh, "fitted", lambda *_, **__: mesh.moved(points))
    made = remeshed(mesh, cells="triangles", tile_size=tile_size, seed=1)
    assert any("triangles of the cells cross each other" in note for note in made.notes)


def test_lost_parts_are_noted(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh, tile_size, _ = SHAPES["ball"]
    halved = mesh.moved(np.minimum(mesh.points, [99, 99, 10]))
    monkeypatch.setattr(remesh, "fitted", lambda *_, **__: halved)
    made = remeshed(mesh, cells="triangles", tile_size=tile_size, seed=1)
    assert any("of the surface is more than 12 mm away" in note for note in made.notes)


def test_another_genus_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh, tile_size, _ = SHAPES["ball"]
    monkeypatch.setattr(remesh, "fitted", lambda *_, **__: SHAPES["torus"][0])
    with pytest.raises(PrepareError, match="the genus became 1 instead of 0; ask for a smaller"):
        remeshed(mesh, cells="triangles", tile_size=tile_size, seed=1)


@pytest.mark.parametrize("tile_size", [0.0, -1.0, 81.0, float("nan")])
def test_tile_sizes_that_make_no_sense(tile_size: float) -> None:
    with pytest.raises(PrepareError, match="must be positive and no larger than the body, which is 80 mm"):
        remeshed(cube(divisions=1).scaled(80.0 / 2.0), cells="quads", tile_size=tile_size, seed=1)


def test_more_tiles_than_can_be_remeshed() -> None:
    with pytest.raises(PrepareError, match="would be about 3840000, and at most 250000"):
        remeshed(cube(divisions=1).scaled(80.0 / 2.0), cells="quads", tile_size=0.1, seed=1)


def test_fewer_tiles_than_handles_need_are_refused_with_sizes_that_do() -> None:
    frame = genus_six().scaled(20.0)
    side = float(np.sqrt(fanned(frame).area / 110.0))
    with pytest.raises(PrepareError, match=r"6 handles needs at least 120 tiles, .* is room for 110 on") as refused:
        remeshed(frame, cells="triangles", tile_size=side, seed=1)
    size, tile_size = re.findall(r"at (?:least|most) ([\d.]+) mm", str(refused.value))
    extent = float(np.ptp(frame.points, axis=0).max())
    for mesh, asked in ((frame.scaled(float(size) / extent), side), (frame, float(tile_size))):
        assert genus(remeshed(mesh, cells="triangles", tile_size=asked, seed=1).mesh) == 6


def test_an_open_surface_is_an_error() -> None:
    mesh = cube(divisions=1)
    with pytest.raises(MeshError, match="open boundary"):
        remeshed(PolygonMesh(mesh.points, mesh.corners[4:], mesh.offsets[:-1]), cells="quads", tile_size=1.0, seed=1)


def test_progress_is_told() -> None:
    mesh, tile_size, _ = SHAPES["ball"]
    told: list[str] = []
    remeshed(mesh, cells="hexagons", tile_size=tile_size, seed=1, progress=told.append)
    assert told == ["sampling the surface", "making hexagons, attempt 1"]


@pytest.mark.slow
@pytest.mark.skipif(not CORPUS.is_dir(), reason="FABRICATE_CORPUS names no folder with meshes in good/")
@pytest.mark.parametrize("cells", KINDS)
@pytest.mark.parametrize("name", ["kitten_g1.obj", "caesar_bust.ply", "spinal_implant_mesh_g10.obj"])
def test_scans_and_machine_parts_keep_their_shape(name: str, cells: Cells) -> None:
    mesh = checked_closed(read_mesh(CORPUS / name))
    mesh = mesh.scaled(120.0 / float(np.ptp(mesh.points, axis=0).max()))
    made = remeshed(mesh, cells=cells, tile_size=3.8, seed=1)
    check_sound(made, mesh, tile_size=3.8, handles=genus(mesh))
    assert np.median(tile_sides(made.mesh)) == pytest.approx(3.8, rel=0.2)
