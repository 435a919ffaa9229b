"""Spacing: room is made for the clearance where tiles are tiny or a body is thin, and nothing moves where there is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus
from fabricate.solid.faults import crossing_points
from fabricate.solid.settling import fitted_cut
from fabricate.solid.solids import solids
from fabricate.solid.spacing import ENOUGH, outer_copies, spaced
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled
from fabricate.triangles.crossing import crossing_triangles
from fabricate.triangles.search_tree import SearchTree

CLEARANCE = 0.4


def cut_of(mesh: PolygonMesh, *, size: float, tile: float, squeezed: float = 1.0) -> CutSurface:
    """Return the cut surface of a body that is thin along z: squeezed by a factor once it is cut."""
    quads = tiled(sized(mesh, size=size), tile_size=tile)
    surface = fitted_cut(grown_duotone(quads, tree="random", seed=3), tolerance=0.3, clearance=CLEARANCE)
    scale = np.array([1.0, 1.0, squeezed])
    normals = surface.normals / scale
    points = surface.points * scale
    return replace(
        surface,
        points=points,
        base=points,
        normals=normals / np.linalg.norm(normals, axis=1, keepdims=True),
    )


def smallest_gap(surface: CutSurface) -> float:
    """Return the smallest distance of a point of one region's copy from the other's."""
    copies = outer_copies(surface, clearance=CLEARANCE)
    yellow, blue = (surface.triangles[surface.regions == region] for region in (0, 1))
    ways = ((copies[0][np.unique(yellow)], copies[1], blue), (copies[1][np.unique(blue)], copies[0], yellow))
    return min(float(SearchTree.of(other, of).nearest(own).distance.min()) for own, other, of in ways)


@pytest.fixture(scope="module")
def lens() -> CutSurface:
    """A ball squeezed to a lens twice as thick as the gap and a knife's edge round it."""
    return cut_of(sphere(faces="triangles", frequency=1), size=30, tile=8, squeezed=0.8 / 30)


@pytest.fixture(scope="module")
def needle() -> CutSurface:
    """A ring whose tube is hardly thicker than the gap, along z."""
    return cut_of(torus(around=8, across=4, tube=0.3), size=40, tile=9, squeezed=0.6 / 9)


def test_where_there_is_room_the_surface_is_returned_as_it_is() -> None:
    surface = cut_of(sphere(faces="triangles", frequency=1), size=30, tile=8)
    assert spaced(surface, clearance=CLEARANCE) is surface
    assert spaced(surface, clearance=0.0) is surface


def test_a_thin_body_gives_way_until_the_clearance_fits(needle: CutSurface) -> None:
    assert smallest_gap(needle) < 0.8 * CLEARANCE
    roomy = spaced(needle, clearance=CLEARANCE)
    assert smallest_gap(roomy) >= ENOUGH * CLEARANCE
    assert not len(crossing_triangles(roomy.points, roomy.triangles))
    assert np.linalg.norm(roomy.points - needle.points, axis=1).max() < 3.0 * CLEARANCE


def test_what_has_no_room_at_all_gains_some_and_stays_embedded(lens: CutSurface) -> None:
    roomy = spaced(lens, clearance=CLEARANCE)
    assert smallest_gap(roomy) > smallest_gap(lens)
    assert not len(crossing_triangles(roomy.points, roomy.triangles))


@pytest.mark.parametrize("body", ["lens", "needle"])
def test_parts_of_thin_bodies_do_not_cross(body: str, request: pytest.FixtureRequest) -> None:
    roomy = spaced(request.getfixturevalue(body), clearance=CLEARANCE)
    made = solids(roomy, thickness=2.0, clearance=CLEARANCE)
    assert not crossing_points(made, clearance=CLEARANCE, moved=np.ones(len(roomy.points), dtype=bool)).any()
    for part in made.parts:
        assert not len(crossing_triangles(part.points, part.triangles))


def test_the_base_moves_with_the_surface(needle: CutSurface) -> None:
    deeper = replace(needle, base=needle.base - 0.1 * needle.normals)
    roomy = spaced(deeper, clearance=CLEARANCE)
    assert roomy.base - roomy.points == pytest.approx(deeper.base - deeper.points, abs=1e-5)
