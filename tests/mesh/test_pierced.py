from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shape_oracles import crossings

from fabricate.errors import MeshError
from fabricate.mesh.closed import checked_closed, genus, signed_volume
from fabricate.mesh.cube import cube
from fabricate.mesh.pierced import double_torus, genus_six, pierced, triple_torus
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import (
    dodecahedron,
    geodesic_sphere,
    truncated_cuboctahedron,
    truncated_icosahedron,
)

Frame = Callable[..., PolygonMesh]

SHELLS = [
    cube(divisions=1),
    cube(divisions=3),
    geodesic_sphere(frequency=2),
    dodecahedron(),
    truncated_icosahedron(),
    truncated_cuboctahedron(),
]
FRAMES = [(double_torus, 2, 44, 46), (triple_torus, 3, 62, 66), (genus_six, 6, 80, 90)]
shells = st.sampled_from(SHELLS)
holes = st.floats(0.1, 0.9)
depths = st.floats(0.1, 2)


def checkerboard(rows: int, columns: int) -> PolygonMesh:
    """Return a flat plate of unit squares, facing up."""
    number = np.arange((rows + 1) * (columns + 1)).reshape(rows + 1, columns + 1)
    x, y = np.divmod(number.ravel(), columns + 1)
    quads = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], axis=-1)
    points = np.stack([x, y, np.zeros(len(x))], axis=1)
    return PolygonMesh(points, quads.ravel(), np.arange(0, quads.size + 1, 4))


@given(shell=shells, hole=holes, scale=st.floats(0.2, 0.95))
def test_shell_pierced_everywhere(shell: PolygonMesh, hole: float, scale: float) -> None:
    mesh = pierced(shell, shell.points * scale, hole=hole)
    assert len(mesh.points) == 2 * len(shell.points) + 2 * len(shell.corners)
    assert mesh.face_sizes.tolist() == [4] * (3 * len(shell.corners))
    assert checked_closed(mesh) is mesh
    assert genus(mesh) == len(shell.offsets) - 2


@given(shell=shells, hole=holes, scale=st.floats(0.2, 0.95))
def test_volume_left_of_a_shell(shell: PolygonMesh, hole: float, scale: float) -> None:
    mesh = pierced(shell, shell.points * scale, hole=hole)
    left = signed_volume(shell) * (1 - scale**3) * (1 - hole**2)
    assert signed_volume(mesh) == pytest.approx(left, rel=1e-9)


@given(shell=shells, hole=holes, scale=st.floats(0.2, 0.95))
def test_pierced_shell_does_not_cross_itself(shell: PolygonMesh, hole: float, scale: float) -> None:
    assert crossings(pierced(shell, shell.points * scale, hole=hole)) == 0


def test_crossings_would_be_found() -> None:
    shell = cube(divisions=1)
    assert crossings(pierced(shell, -shell.points / 2, hole=0.5)) > 0


@given(rows=st.integers(1, 4), columns=st.integers(1, 4), hole=holes, depth=depths)
def test_plate_pierced_everywhere(rows: int, columns: int, hole: float, depth: float) -> None:
    plate = checkerboard(rows, columns)
    mesh = pierced(plate, plate.points - [0, 0, depth], hole=hole)
    cells, boundary = rows * columns, 2 * (rows + columns)
    assert len(mesh.points) == 2 * len(plate.points) + 8 * cells
    assert mesh.face_sizes.tolist() == [4] * (12 * cells + boundary)
    assert checked_closed(mesh) is mesh
    assert genus(mesh) == cells
    assert signed_volume(mesh) == pytest.approx(cells * depth * (1 - hole**2), rel=1e-9)
    assert crossings(mesh) == 0


@pytest.mark.parametrize(("frame", "handles", "points", "quads"), FRAMES)
def test_frame_counts(frame: Frame, handles: int, points: int, quads: int) -> None:
    mesh = frame()
    assert len(mesh.points) == points
    assert mesh.face_sizes.tolist() == [4] * quads
    assert genus(mesh) == handles


@pytest.mark.parametrize(("frame", "handles"), [(frame, handles) for frame, handles, _, _ in FRAMES])
@given(hole=holes, depth=depths)
def test_frame_is_a_closed_solid_over_the_whole_range(frame: Frame, handles: int, hole: float, depth: float) -> None:
    mesh = frame(hole=hole, depth=depth)
    assert checked_closed(mesh) is mesh
    assert genus(mesh) == handles
    assert crossings(mesh) == 0
    np.testing.assert_allclose(mesh.points.mean(axis=0), 0, atol=1e-12)


@given(hole=holes, depth=depths)
def test_volume_of_genus_six(hole: float, depth: float) -> None:
    height = np.cos(np.pi / 5)  # half of it, for pentagons with corners at distance 1
    prism = 5 * np.sin(2 * np.pi / 5) * height / np.hypot(1, height) ** 3
    left = prism * (1 - 1 / (1 + depth) ** 3) * (1 - hole**2)
    assert signed_volume(genus_six(hole=hole, depth=depth)) == pytest.approx(left, rel=1e-9)


@pytest.mark.parametrize("frame", [double_torus, triple_torus])
@given(hole=holes, depth=depths)
def test_plates_have_the_thickness_asked_for(frame: Frame, hole: float, depth: float) -> None:
    heights = frame(hole=hole, depth=depth).points[:, 2]
    np.testing.assert_allclose(np.abs(heights), depth * 3**0.5 / 2, rtol=1e-12)


@pytest.mark.parametrize("frame", [double_torus, triple_torus])
@given(hole=holes)
def test_rim_of_a_plate_is_as_wide_as_the_bars_between_holes(frame: Frame, hole: float) -> None:
    apothem = 3**0.5 / 2  # the outermost hexagon has its centre and its farthest side at 1 and 2 of these
    width = frame(hole=hole).points[:, 0].max() - (1 + hole) * apothem
    between = 2 * (1 - hole) * apothem
    assert width == pytest.approx(between)


@pytest.mark.parametrize("frame", [double_torus, triple_torus])
def test_plates_are_mirror_symmetric(frame: Frame) -> None:
    points = frame().points
    for mirror in ([-1, 1, 1], [1, 1, -1]):
        distances = np.linalg.norm((points * mirror)[:, None] - points, axis=2).min(axis=1)
        np.testing.assert_allclose(distances, 0, atol=1e-12)


@pytest.mark.parametrize("frame", [double_torus, triple_torus, genus_six])
@pytest.mark.parametrize("hole", [0.05, 0.95, float("nan")])
def test_hole_out_of_range_is_an_error(frame: Frame, hole: float) -> None:
    with pytest.raises(MeshError, match=rf"hole must be between 0\.1 and 0\.9, found {hole:g}"):
        frame(hole=hole)


@pytest.mark.parametrize("frame", [double_torus, triple_torus, genus_six])
@pytest.mark.parametrize("depth", [0.05, 2.5, float("nan")])
def test_depth_out_of_range_is_an_error(frame: Frame, depth: float) -> None:
    with pytest.raises(MeshError, match=rf"depth must be between 0\.1 and 2, found {depth:g}"):
        frame(depth=depth)


@pytest.mark.parametrize("hole", [0.0, 1.0, -1.0, float("nan")])
def test_a_hole_that_is_nothing_or_everything_is_an_error(hole: float) -> None:
    shell = cube(divisions=1)
    with pytest.raises(MeshError, match="hole must be above 0 and below 1"):
        pierced(shell, shell.points / 2, hole=hole)


def test_inner_points_must_match() -> None:
    with pytest.raises(MeshError, match=r"shape \(8, 3\), one for each outer point, found \(7, 3\)"):
        pierced(cube(divisions=1), np.zeros((7, 3)), hole=0.5)
