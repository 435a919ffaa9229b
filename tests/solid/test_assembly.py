"""Assemblies: closed parts, gap and shell out of layers; walls that face each other; and what they add up to."""

from __future__ import annotations

import numpy as np
import pytest
from small_ring import CLEARANCE, ring_surface

from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.torus import torus
from fabricate.solid.assembly import Assembly, Core, assembly
from fabricate.solid.part import Part
from fabricate.solid.settling import fitted_cut
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled

THICKNESS = 2.0
CORES: tuple[Core, ...] = ("hollow", "yellow", "blue")


@pytest.fixture(scope="module")
def surface() -> CutSurface:
    return ring_surface()


def built(surface: CutSurface, *, clearance: float = CLEARANCE, core: Core = "hollow") -> Assembly:
    inner = surface.points - THICKNESS * surface.normals
    return assembly(surface, inner, clearance=clearance, core=core)


def volume(part: Part) -> float:
    corners = part.points[part.triangles]
    return float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6)


def unmatched(triangles: np.ndarray) -> int:
    """Return how many directed edges have no other running the opposite way, or run twice."""
    edges = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    found = {(int(a), int(b)) for a, b in edges}
    return sum(edge[::-1] not in found for edge in found) + len(edges) - len(found)


@pytest.mark.parametrize("core", CORES)
@pytest.mark.parametrize("clearance", [0.0, CLEARANCE])
def test_parts_and_spaces_are_closed(surface: CutSurface, core: Core, clearance: float) -> None:
    made = built(surface, clearance=clearance, core=core)
    for part in (*made.parts, *made.spaces):
        assert unmatched(part.triangles) == 0
        assert len(np.unique(part.triangles)) == len(part.points)
    assert [part.name for part in (*made.parts, *made.spaces)] == ["yellow", "blue", "gap", "shell"]


@pytest.mark.parametrize("core", CORES)
@pytest.mark.parametrize("clearance", [0.0, CLEARANCE])
def test_parts_and_gap_add_up_to_the_whole(surface: CutSurface, core: Core, clearance: float) -> None:
    made = built(surface, clearance=clearance, core=core)
    gap, shell = (volume(part) for part in made.spaces)
    assert sum(volume(part) for part in made.parts) + gap == pytest.approx(volume(made.spaces[1]), rel=1e-3)
    assert (gap > 0) == (clearance > 0)
    assert all(0 < volume(part) < shell for part in made.parts)


def test_the_gap_is_as_wide_as_the_clearance(surface: CutSurface) -> None:
    curve = surface.points[surface.curves[0]]
    length = np.linalg.norm(np.roll(curve, -1, axis=0) - curve, axis=1).sum()
    assert volume(built(surface).spaces[0]) == pytest.approx(length * THICKNESS * CLEARANCE, rel=0.3)


def test_a_core_is_what_the_other_part_and_the_gap_leave_of_the_body(surface: CutSurface) -> None:
    solid, hollow = built(surface, core="blue"), built(surface)
    corners = surface.points[surface.triangles]
    body = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    assert volume(solid.spaces[1]) == pytest.approx(body, rel=1e-5)
    assert volume(solid.parts[0]) == pytest.approx(volume(hollow.parts[0]), rel=1e-2)
    assert volume(solid.parts[1]) > 2 * volume(hollow.parts[1])


@pytest.mark.parametrize("core", CORES)
def test_without_clearance_facing_triangles_are_the_same_reversed(surface: CutSurface, core: Core) -> None:
    made = built(surface, clearance=0.0, core=core)
    assert len(made.gap) == 0

    def cycles(triangles: np.ndarray) -> set[tuple[int, ...]]:
        first = triangles.argmin(axis=1)[:, None]
        return set(map(tuple, np.take_along_axis(triangles, (first + np.arange(3)) % 3, axis=1).tolist()))

    shared = cycles(made.bodies[0]) & cycles(made.bodies[1][:, ::-1])
    covered = {"hollow": 0, "yellow": (surface.regions == 1).sum(), "blue": (surface.regions == 0).sum()}[core]
    assert len(shared) == 2 * surface.curves.size + covered


@pytest.mark.parametrize("core", CORES)
def test_coordinates_are_those_of_an_stl(surface: CutSurface, core: Core) -> None:
    points = built(surface, core=core).points
    assert (points == points.astype(np.float32)).all()
    assert len(points) % len(surface.points) == 0


def test_the_outer_surface_is_the_limit_surface(surface: CutSurface) -> None:
    made, count = built(surface), len(surface.points)
    away = np.unique(surface.rays[:, :, [0, -1]])
    for block in (0, 2):
        assert made.points[block * count :][:count][away] == pytest.approx(surface.points[away], rel=1e-6, abs=1e-5)


@pytest.mark.parametrize("core", CORES)
@pytest.mark.parametrize("clearance", [0.0, CLEARANCE])
def test_the_inner_side_is_the_one_that_was_asked_for(surface: CutSurface, core: Core, clearance: float) -> None:
    made = built(surface, clearance=clearance, core=core)
    assert made.inner == pytest.approx(surface.points - THICKNESS * surface.normals, rel=1e-6, abs=1e-5)


def test_it_is_frozen(surface: CutSurface) -> None:
    made = built(surface)
    for array in (made.points, *made.bodies, made.gap, made.shell):
        with pytest.raises(ValueError, match="read-only"):
            array[0, 0] = 0


RINGS = (0.36, 0.5, 0.615)


@pytest.fixture(scope="module")
def multitone() -> CutSurface:
    quads = tiled(sized(torus(around=8, across=4, tube=0.45), size=100), tile_size=20)
    duotone = grown_duotone(quads, tree="random", seed=3)
    return fitted_cut(duotone, rings=RINGS, tolerance=0.5, clearance=CLEARANCE)


@pytest.mark.parametrize("core", CORES)
@pytest.mark.parametrize("clearance", [0.0, CLEARANCE])
def test_all_parts_of_a_multitone_are_closed_and_add_up(multitone: CutSurface, core: Core, clearance: float) -> None:
    made = built(multitone, clearance=clearance, core=core)
    assert [part.name for part in made.parts] == ["yellow", "band-1", "band-2", "blue"]
    for part in (*made.parts, *made.spaces):
        assert unmatched(part.triangles) == 0
        assert len(np.unique(part.triangles)) == len(part.points)
    gap, shell = (volume(part) for part in made.spaces)
    assert sum(volume(part) for part in made.parts) + gap == pytest.approx(shell, rel=1e-3)
    assert (gap > 0) == (clearance > 0)
    assert all(0 < volume(part) < shell for part in made.parts)


def test_a_band_s_copies_keep_to_either_side_of_its_middle(multitone: CutSurface) -> None:
    made, count = built(multitone), len(multitone.points)
    middles = [half_rays.right[:, -1] for half_rays in multitone.half_rays[:-1]]
    for band, middle in enumerate(middles, start=1):
        copy = made.points[2 * band * count :][:count]
        assert copy[middle] == pytest.approx(multitone.points[middle], rel=1e-6, abs=1e-5)
        before, after = (
            np.linalg.norm(copy[curve] - copy[middle], axis=1) for curve in multitone.curves[band - 1 :][:2]
        )
        width = np.linalg.norm(np.diff(multitone.points[multitone.curves[band - 1 :][:2]], axis=0)[0], axis=1)
        assert (before + after < width).all()
        assert CLEARANCE <= np.median(width - before - after) <= 1.5 * CLEARANCE


@pytest.mark.parametrize("clearance", [0.0, 0.2])
def test_joint_faces_are_all_that_is_neither_outside_nor_inside(multitone: CutSurface, clearance: float) -> None:
    made = built(multitone, clearance=clearance)
    for region, body in enumerate(made.bodies):
        faces = {tuple(triangle) for triangle in np.sort(made.joint_faces(multitone.curves, region), axis=1).tolist()}
        whole = {tuple(triangle) for triangle in np.sort(body, axis=1).tolist()}
        assert faces < whole
        assert len(whole) - len(faces) == 2 * (multitone.regions == region).sum()


def test_points_have_moved_since_where_a_copy_lies_elsewhere(surface: CutSurface) -> None:
    inner = surface.points - 2.0 * surface.normals
    before = assembly(surface, inner, clearance=CLEARANCE, core="hollow")
    assert not before.moved_since(before).any()
    far = int(surface.half_rays[0].left[0, -1])
    inner[far] -= 0.1 * surface.normals[far]
    moved = assembly(surface, inner, clearance=CLEARANCE, core="hollow").moved_since(before)
    assert moved[far]
    assert not moved.all()
