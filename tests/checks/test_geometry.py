"""Geometry: volumes and areas against formulas, self-crossing and inside-out parts caught where they are."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from fabricate.checks.geometry import (
    area,
    as_manifold,
    is_solid,
    manifold_check,
    self_intersection_check,
    signed_volume,
    triangle_areas,
    volume_check,
)
from fabricate.solid.part import Part
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.normals import area_vectors

lengths = st.floats(0.5, 50.0)
shifts = st.tuples(*3 * [st.floats(-100.0, 100.0)])


def part_of(*meshes: trimesh.Trimesh) -> Part:
    offsets = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    triangles = [mesh.faces + offset for mesh, offset in zip(meshes, offsets, strict=False)]
    return Part("red", np.concatenate([mesh.vertices for mesh in meshes]), np.concatenate(triangles))


def two_spheres(distance: float) -> Part:
    """Return two spheres of radius 10 mm as one mesh, the second shifted along x."""
    one, other = trimesh.creation.icosphere(radius=10), trimesh.creation.icosphere(radius=10)
    other.apply_translation((distance, 0.1, 0.2))
    return part_of(one, other)


@given(lengths, lengths, lengths, shifts)
def test_box_has_the_volume_and_area_of_a_box(a: float, b: float, c: float, shift: tuple[float, float, float]) -> None:
    mesh = trimesh.creation.box((a, b, c))
    mesh.apply_translation(shift)
    part = part_of(mesh)
    a, b, c = np.ptp(part.points, axis=0).tolist()  # as rounded to float32
    assert signed_volume(part) == pytest.approx(a * b * c, rel=1e-9)
    assert area(area_vectors(part.points, part.triangles)) == pytest.approx(2 * (a * b + b * c + c * a), rel=1e-9)


@pytest.mark.parametrize("subdivisions", [1, 2, 3])
def test_sphere_agrees_with_trimesh(subdivisions: int) -> None:
    part = part_of(trimesh.creation.icosphere(subdivisions=subdivisions, radius=20))
    judge = trimesh.Trimesh(part.points, part.triangles, process=False)
    assert signed_volume(part) == pytest.approx(judge.volume)
    assert np.allclose(triangle_areas(part), judge.area_faces)


def test_a_part_inside_out_has_no_positive_volume() -> None:
    box = part_of(trimesh.creation.box((1, 2, 3)))
    inverted = Part("red", box.points, box.triangles[:, ::-1])
    assert signed_volume(inverted) == pytest.approx(-6)
    good, bad = volume_check(box, signed_volume(box)), volume_check(inverted, signed_volume(inverted))
    assert good.ok
    assert bad.failed
    assert bad.code == "red.volume"
    assert not is_solid(as_manifold(inverted))
    assert manifold_check(inverted, as_manifold(inverted), volume=-6.0).failed
    assert "inward" in bad.message


def test_an_empty_part_has_no_volume() -> None:
    nothing = Part("red", np.zeros((0, 3)), np.zeros((0, 3), dtype=int))
    assert (signed_volume(nothing), area(area_vectors(nothing.points, nothing.triangles))) == (0.0, 0.0)
    assert volume_check(nothing, 0.0).failed
    assert not is_solid(as_manifold(nothing))
    assert manifold_check(nothing, as_manifold(nothing), volume=0.0).failed


def test_spheres_apart_do_not_cross_and_spheres_within_each_other_do() -> None:
    apart, within = two_spheres(21.0), two_spheres(15.0)
    assert self_intersection_check(apart, crossing_triangles(apart.points, apart.triangles)).ok
    pairs = crossing_triangles(within.points, within.triangles)
    found = self_intersection_check(within, pairs)
    assert found.failed
    assert found.code == "red.self_intersections"
    assert f"{len(pairs)} pairs" in found.message
    edge = np.linalg.norm(np.diff(within.points[within.triangles[0]], axis=0), axis=1).max()
    assert np.abs(found.where[:, 0] - 7.5).max() < edge  # they cross in a circle at x = 7.5 mm
    assert np.abs(np.linalg.norm(found.where[:, 1:], axis=1) - np.sqrt(100 - 7.5**2)).max() < edge


def test_a_part_folded_through_itself_crosses() -> None:
    mesh = trimesh.creation.icosphere(radius=10)
    points = mesh.vertices.copy()
    top = int(points[:, 2].argmax())
    points[top] = (0.3, 0.2, -12.0)  # pulled down through the bottom
    part = Part("red", points, mesh.faces)
    found = self_intersection_check(part, crossing_triangles(part.points, part.triangles))
    assert found.failed
    assert np.linalg.norm(found.where - [0.3, 0.2, -10.0], axis=1).min() < 2.0


def test_manifold_takes_a_solid_and_finds_its_volume() -> None:
    part = part_of(trimesh.creation.torus(10, 3))
    manifold, volume = as_manifold(part), signed_volume(part)
    assert is_solid(manifold)
    assert manifold_check(part, manifold, volume=volume).ok
    assert manifold_check(part, manifold, volume=volume * (1 + 2e-6)).failed
    assert manifold_check(part, manifold, volume=volume * (1 + 5e-7)).ok


@pytest.mark.parametrize("fault", ["hole", "flipped", "not a number"])
def test_manifold_refuses_what_is_no_solid(fault: str) -> None:
    whole = part_of(trimesh.creation.icosphere())
    triangles, points = whole.triangles.copy(), whole.points.copy()
    if fault == "hole":
        triangles = triangles[1:]
    elif fault == "flipped":
        triangles[0] = triangles[0, ::-1]
    else:
        points[0, 0] = np.nan
    part = Part("red", points, triangles)
    found = manifold_check(part, as_manifold(part), volume=1.0)
    assert found.failed
    assert ("NotManifold" if fault != "not a number" else "NonFiniteVertex") in found.message


def test_parts_stay_as_they_are() -> None:
    part = part_of(trimesh.creation.box())
    points, triangles = part.points.copy(), part.triangles.copy()
    as_manifold(part)
    signed_volume(part)
    assert np.array_equal(part.points, points)
    assert np.array_equal(part.triangles, triangles)
