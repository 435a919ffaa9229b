"""Walls: thicknesses known from construction, thin places found where they were made."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from fabricate.checks import walls as walls_module
from fabricate.checks.walls import Walls
from fabricate.solid.part import Part
from fabricate.triangles.normals import area_vectors
from fabricate.triangles.search_tree import SearchTree


def walls(part: Part) -> Walls:
    tree = SearchTree.of(part.points, part.triangles)
    return walls_module.walls(part, tree, area_vectors(part.points, part.triangles))


def part_of(*meshes: trimesh.Trimesh) -> Part:
    offsets = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    triangles = [mesh.faces + offset for mesh, offset in zip(meshes, offsets, strict=False)]
    return Part("red", np.concatenate([mesh.vertices for mesh in meshes]), np.concatenate(triangles))


def plate(*, cells: int = 40, thickness: float = 2.0) -> Part:
    """Return a square plate, 1 mm per cell, with finely divided top and bottom."""
    across = np.linspace(0, cells, cells + 1)
    x, y = np.meshgrid(across, across, indexing="ij")
    flat = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    number = np.arange(x.size).reshape(x.shape)
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    top = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)]).reshape(-1, 3) + x.size
    rim = np.concatenate([number[:-1, 0], number[-1, :-1], number[:0:-1, -1], number[0, :0:-1]])
    ahead = np.roll(rim, -1)
    sides = np.concatenate(
        [np.column_stack([rim, ahead, ahead + x.size]), np.column_stack([rim, ahead + x.size, rim + x.size])]
    )
    return Part(
        "red",
        np.concatenate([flat, flat + np.array([0, 0, thickness])]),
        np.concatenate([top, top[:, ::-1] - x.size, sides]),
    )


def shell(outer: float, inner: float) -> Part:
    """Return a hollow sphere."""
    big, small = (trimesh.creation.icosphere(subdivisions=3, radius=r) for r in (outer, inner))
    small.invert()
    return part_of(big, small)


def measured(part: Part) -> tuple[float, float]:
    spread = walls(part).spread
    assert spread is not None
    return spread.min, spread.median


@given(st.tuples(*3 * [st.floats(0.5, 20.0)]))
def test_the_thinnest_wall_of_a_box_is_its_shortest_side(sides: tuple[float, float, float]) -> None:
    part = part_of(trimesh.creation.box(sides))
    assert measured(part)[0] == pytest.approx(min(sides), rel=1e-4)
    assert walls(part).thickness.max() == pytest.approx(max(sides), rel=1e-4)
    assert (walls(part).areas > 0.0).sum() == 12


def test_median_is_weighted_by_area() -> None:
    assert measured(part_of(trimesh.creation.box((10, 10, 1)))) == pytest.approx((1, 1), rel=1e-4)
    assert measured(part_of(trimesh.creation.box((1, 1, 10)))) == pytest.approx((1, 1), rel=1e-4)
    fine = plate(cells=10, thickness=1.0)
    assert measured(fine) == pytest.approx((1, 1), rel=1e-4)


@pytest.mark.parametrize("shift", [0.0, 500.0])
def test_a_hollow_sphere_has_the_wall_between_its_radii(shift: float) -> None:
    made = shell(30.0, 28.0)
    part = Part("red", made.points + shift, made.triangles)
    corners = made.points[made.triangles[: len(made.triangles) // 2]]  # outer facets; parallel to inner ones
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    depths = np.einsum("ij,ij->i", corners[:, 0], normals) / np.linalg.norm(normals, axis=1) / 30.0
    least, median = measured(part)
    assert least == pytest.approx(2.0 * depths.min(), abs=1e-3)
    assert 2.0 * depths.min() <= median <= 2.0 * depths.max()


def test_a_dent_is_found_where_it_is() -> None:
    made = plate()
    points = made.points.copy()
    near = (np.abs(points[:, :2] - [17.0, 23.0]) <= 1.0).all(axis=1)
    points[near & (points[:, 2] == 2.0), 2] = 0.5  # a square of 2 mm
    found = walls(Part("red", points, made.triangles))
    assert found.spread is not None
    assert found.spread.min == pytest.approx(0.5, rel=1e-4)
    assert (np.abs(found.places[found.thickness < 0.6][:, :2] - [17.0, 23.0]) < 1.0).all()
    assert 0.0 < found.share_below(1.5) < 0.01
    assert walls(made).share_below(1.5) == 0.0


def test_thinnest_places_come_first() -> None:
    found = walls(shell(10.0, 8.0))
    assert (np.diff(found.thickness) >= 0.0).all()


def test_edges_are_no_walls() -> None:
    tetrahedron = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], dtype=float)
    found = walls(Part("red", tetrahedron, np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])))
    assert len(found.thickness) == 0  # normals of neighbours have the cosine -1/3
    assert found.spread is None


def test_a_knife_edge_is_a_wall_that_gets_thin() -> None:
    blade = [[0, 0, 0], [10, -1, 0], [10, 1, 0], [0, 0, 5], [10, -1, 5], [10, 1, 5]]
    triangles = [[0, 2, 1], [3, 4, 5], [0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]]
    found = walls(Part("red", np.array(blade), np.array(triangles)))
    assert found.spread is not None
    assert found.spread.min == pytest.approx(2 / 3, rel=0.05)  # from the triangles' middles


def test_faces_that_look_at_each_other_from_outside_are_no_wall() -> None:
    one, other = trimesh.creation.box((10, 10, 10)), trimesh.creation.box((10, 10, 10))
    other.apply_translation((0, 0, 10.2))  # 0.2 mm of air
    assert measured(part_of(one, other))[0] == pytest.approx(10, rel=1e-4)


def test_an_empty_part_has_no_walls() -> None:
    assert walls(Part("red", np.zeros((0, 3)), np.zeros((0, 3), dtype=int))).spread is None


def test_triangles_without_area_send_no_rays() -> None:
    box = part_of(trimesh.creation.box((1, 2, 3)))
    found = walls(Part("red", box.points, np.array([*box.triangles, [0, 0, 1]])))
    assert (found.areas > 0.0).sum() == 12


def test_large_parts_send_fewer_rays(monkeypatch: pytest.MonkeyPatch) -> None:
    every = walls(plate())
    monkeypatch.setattr(walls_module, "MOST_RAYS", 1000)
    some = walls(plate())
    assert (some.areas > 0.0).sum() <= 1000 < (every.areas > 0.0).sum()
    assert some.spread == pytest.approx(every.spread)
    assert np.array_equal(some.places, walls(plate()).places)


def test_records_are_read_only() -> None:
    found = Walls(np.ones(1), np.zeros((1, 3)), np.ones(1), np.zeros((1, 2)))
    with pytest.raises(ValueError, match="read-only"):
        found.thickness[0] = 2.0
