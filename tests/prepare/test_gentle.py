"""Gentle repair: what was broken without moving a point comes back whole, and what is whole is left alone."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from breaking import box, inside_out, moebius, shuffled, turned, united, unwelded, with_faces, without
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import HANDLES, Faces, face_lists, octahedron, polyhedra, seeds, surfaces, tetrahedron

from fabricate.errors import FabricateError
from fabricate.formats.reading import read_mesh
from fabricate.mesh.closed import checked_closed, genus, signed_volume
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.components import split
from fabricate.prepare.gentle import gently_repaired, is_closed_manifold

CORPUS = os.environ.get("FABRICATE_CORPUS")
FILES = sorted(Path(CORPUS).glob("*/*")) if CORPUS else []
HEAVY_FACES = 110_000  # larger files take many seconds and show nothing that others don't

choices = st.sets(st.integers(0, 60), max_size=8)


def actions(mesh: PolygonMesh) -> dict[str, int]:
    return {action.name: action.count for action in gently_repaired(mesh).actions}


def cycles(mesh: PolygonMesh) -> list[list[tuple[float, ...]]]:
    """Return the faces as places, each beginning with its lowest, in sorted order."""
    found = []
    for face in face_lists(mesh):
        places = [tuple(place) for place in mesh.points[face].tolist()]
        start = places.index(min(places))
        found.append(places[start:] + places[:start])
    return sorted(found)


def with_copies(faces: Faces, which: set[int], rng: np.random.Generator) -> Faces:
    copies = [face for n, face in enumerate(faces) if n in which]
    return faces + [face[::-1] if rng.random() < 0.5 else face[1:] + face[:1] for face in copies]


def with_nothing(faces: Faces, which: set[int]) -> Faces:
    """Repeat corners of some faces, and add faces that have no area for it."""
    stuttering = [[*face, face[-1]] if n in which else face for n, face in enumerate(faces)]
    return stuttering + [[face[0], face[0], face[1]] for n, face in enumerate(faces) if n in which]


@settings(max_examples=60)
@given(surfaces(), choices, choices, choices, st.booleans(), seeds)
def test_a_broken_surface_comes_back_as_it_was(
    mesh: PolygonMesh, flips: set[int], copied: set[int], empty: set[int], apart: bool, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    broken = with_faces(mesh, with_nothing(with_copies(face_lists(turned(mesh, flips)), copied, rng), empty))
    broken = shuffled(unwelded(broken) if apart else broken, rng)
    found = gently_repaired(PolygonMesh(np.concatenate([broken.points, np.eye(3)]), broken.corners, broken.offsets))
    whole = checked_closed(found.mesh)
    assert whole is found.mesh  # outward already
    assert genus(whole) == genus(mesh)
    assert signed_volume(whole) == pytest.approx(signed_volume(mesh))
    assert cycles(whole) == cycles(mesh)


@given(surfaces())
def test_a_clean_mesh_is_the_same_object(mesh: PolygonMesh) -> None:
    found = gently_repaired(mesh)
    assert found.mesh is mesh
    assert found.actions == ()


@settings(max_examples=30)
@given(polyhedra(), choices, seeds)
def test_repairing_twice_changes_nothing_more(mesh: PolygonMesh, lost: set[int], seed: int) -> None:
    rng = np.random.default_rng(seed)
    faces = [face for n, face in enumerate(face_lists(mesh)) if n not in lost] or [[0, 1, 2]]
    once = gently_repaired(shuffled(unwelded(with_faces(mesh, with_copies(faces, lost, rng))), rng)).mesh
    again = gently_repaired(once)
    assert again.mesh is once


def test_fans_that_touch_on_a_rim_stay_apart() -> None:
    """Two open strips share one place, each with its own point: welding there would only have to be undone."""
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0], [-1, 0, 0], [0, -1, 0]], dtype=float)
    mesh = PolygonMesh(points, np.arange(6), np.array([0, 3, 6]))
    assert gently_repaired(mesh).mesh is mesh
    joined = PolygonMesh(points, np.array([0, 1, 2, 0, 4, 5]), mesh.offsets)
    assert actions(joined) == {"points without a face dropped": 1, "touching points split": 1}
    assert len(gently_repaired(joined).mesh.points) == 6


@given(surfaces(), choices, seeds)
def test_no_point_is_moved(mesh: PolygonMesh, lost: set[int], seed: int) -> None:
    broken = shuffled(unwelded(without(mesh, lost)), np.random.default_rng(seed))
    before = {tuple(place) for place in broken.points.tolist()}
    assert {tuple(place) for place in gently_repaired(broken).mesh.points.tolist()} <= before


def test_every_kind_of_change_is_counted() -> None:
    mesh = box()
    assert actions(inside_out(mesh)) == {"faces flipped": 6}
    assert actions(turned(mesh, {2})) == {"faces flipped": 1}
    assert actions(unwelded(mesh)) == {"points welded": 16}
    faces = face_lists(mesh)
    assert actions(with_faces(mesh, [*faces, faces[0][::-1]])) == {"duplicate faces dropped": 1}
    assert actions(with_faces(mesh, [[*faces[0], faces[0][0]], *faces[1:]])) == {"repeated corners dropped": 1}
    assert actions(with_faces(mesh, [*faces, [0, 1, 1]])) == {"degenerate faces dropped": 1}
    assert actions(PolygonMesh(np.vstack([mesh.points, [9, 9, 9]]), mesh.corners, mesh.offsets)) == {
        "points without a face dropped": 1
    }


def test_bodies_that_touch_in_a_point_get_their_own() -> None:
    faces = face_lists(tetrahedron())
    points = np.concatenate([tetrahedron().points, 2 * tetrahedron().points[0] - tetrahedron().points[1:]])
    other = [[corner + 3 if corner else 0 for corner in face] for face in faces]
    found = gently_repaired(PolygonMesh.from_faces(points, faces + other))
    assert found.actions[0].name == "touching points split"
    assert [signed_volume(checked_closed(part)) for part in split(found.mesh)] == pytest.approx(
        2 * [signed_volume(tetrahedron())]
    )


def test_closed_bodies_that_touch_are_not_welded_into_one() -> None:
    pair = united(box(), box(at=(1.0, 1.0, 0.0)))  # they have an edge in common
    assert gently_repaired(pair).mesh is pair


def test_an_edge_without_length_is_welded_where_no_handle_hangs_on_it() -> None:
    mesh = octahedron()
    a, b = face_lists(mesh)[0][:2]
    points = mesh.points.copy()
    points[b] = points[a]
    found = gently_repaired(mesh.moved(points))
    whole = checked_closed(found.mesh)
    assert (len(whole.points), len(whole.offsets) - 1, genus(whole)) == (5, 6, 0)


def test_an_edge_without_length_stays_where_a_handle_hangs_on_it() -> None:
    mesh, handles = HANDLES["torus"]  # rings of 3 points: one edge that shrinks makes a sliver of the tube
    ring = next(face for face in face_lists(mesh))[:2]
    around = {0, 1, 2} if set(ring) <= {0, 1, 2} else set(ring)
    points = mesh.points.copy()
    points[list(around)] = points[min(around)]
    whole = checked_closed(gently_repaired(mesh.moved(points)).mesh)
    assert genus(whole) == handles


def test_a_cavity_stays_one_and_a_body_turned_inside_out_takes_its_cavity_along() -> None:
    hollow = united(box(4.0), inside_out(box(1.0)))
    assert gently_repaired(hollow).mesh is hollow
    found = gently_repaired(inside_out(hollow)).mesh
    assert sorted(round(signed_volume(part)) for part in split(found)) == [-1, 64]


def test_a_body_beside_another_is_turned_outward_by_itself() -> None:
    found = gently_repaired(united(box(), inside_out(box(at=(5.0, 0.0, 0.0))))).mesh
    assert [signed_volume(part) for part in split(found)] == pytest.approx([1.0, 1.0])


@pytest.mark.parametrize("mesh", [moebius(), without(box(), {0}), united(box(), without(box(at=(3.0, 0, 0)), {1}))])
def test_what_cannot_be_mended_is_left(mesh: PolygonMesh) -> None:
    found = gently_repaired(mesh)
    assert not is_closed_manifold(found.mesh)
    assert len(found.mesh.offsets) == len(mesh.offsets)


def test_a_mesh_of_nothing_but_degenerate_faces_ends_without_faces() -> None:
    found = gently_repaired(PolygonMesh.from_faces(np.eye(3), [[0, 0, 1], [1, 2, 2]]))
    assert len(found.mesh.offsets) == 1
    assert len(found.mesh.points) == 0


@pytest.mark.skipif(not CORPUS, reason="FABRICATE_CORPUS is not set")
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_real_files_get_no_worse(path: Path) -> None:
    try:
        mesh = read_mesh(path)
    except FabricateError:
        return
    if len(mesh.offsets) > HEAVY_FACES:
        pytest.skip("too large for a quick test")
    found = gently_repaired(mesh)
    if is_closed_manifold(mesh):
        assert is_closed_manifold(found.mesh)
        before, after = (
            len(each.points) - len(each.corners) // 2 + len(each.offsets) - 1 for each in (mesh, found.mesh)
        )
        assert after == before
    assert gently_repaired(found.mesh).mesh is found.mesh
