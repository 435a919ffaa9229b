from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from polyhedra import directed_edges, face_lists, surfaces

from fabricate.mesh.closed import genus
from fabricate.mesh.half_edges import half_edges, twin_half_edges
from fabricate.mesh.polygon_mesh import PolygonMesh

MESHES = surfaces()


@given(mesh=MESHES)
def test_twins_are_found_as_by_looking_up_every_edge(mesh: PolygonMesh) -> None:
    edges = directed_edges(face_lists(mesh))
    number = {edge: h for h, edge in enumerate(edges)}
    assert half_edges(mesh).twin.tolist() == [number[b, a] for a, b in edges]


@given(mesh=MESHES)
def test_twins_are_involutive_and_run_opposite(mesh: PolygonMesh) -> None:
    found = half_edges(mesh)
    numbers = np.arange(len(found.twin))
    head = found.tail[found.following]
    assert (found.twin[found.twin] == numbers).all()
    assert (found.twin != numbers).all()
    assert (found.tail[found.twin] == head).all()
    assert (found.face[found.twin] != found.face).all()


@given(mesh=MESHES)
def test_following_and_preceding_undo_each_other_within_a_face(mesh: PolygonMesh) -> None:
    found = half_edges(mesh)
    numbers = np.arange(len(found.twin))
    assert (found.preceding[found.following] == numbers).all()
    assert (found.following[found.preceding] == numbers).all()
    assert (found.face[found.following] == found.face).all()


@given(mesh=MESHES)
def test_turning_round_a_point_meets_all_its_corners(mesh: PolygonMesh) -> None:
    found = half_edges(mesh)
    valence = np.bincount(mesh.corners)
    spoke, turned = np.arange(len(found.twin)), np.zeros(len(found.twin), dtype=int)
    home = np.zeros(len(found.twin), dtype=bool)
    for _ in range(valence.max()):
        spoke = found.twin[found.preceding[spoke]]
        turned += ~home
        home |= spoke == np.arange(len(spoke))
        assert (found.tail[spoke] == found.tail).all()
    assert (turned == valence[found.tail]).all()


@given(mesh=MESHES)
def test_edges_are_numbered_by_their_first_half_edge(mesh: PolygonMesh) -> None:
    found = half_edges(mesh)
    number: dict[frozenset[int], int] = {}
    for edge in directed_edges(face_lists(mesh)):
        number.setdefault(frozenset(edge), len(number))
    assert found.edge.tolist() == [number[frozenset(edge)] for edge in directed_edges(face_lists(mesh))]
    assert len(mesh.points) - len(number) + len(mesh.offsets) - 1 == 2 - 2 * genus(mesh)


@given(mesh=MESHES)
def test_corner_h_is_half_edge_h(mesh: PolygonMesh) -> None:
    found = half_edges(mesh)
    assert found.tail is mesh.corners
    assert found.face.tolist() == mesh.face_of_corner.tolist()


def test_large_point_numbers_do_not_collide() -> None:
    far = 3_000_000
    tail = np.array([0, 1, far, 1, 0, far])
    head = np.array([1, far, 0, 0, far, 1])
    assert twin_half_edges(tail, head).tolist() == [3, 5, 4, 0, 2, 1]


@pytest.mark.parametrize("name", ["tail", "following", "preceding", "face", "twin"])
def test_arrays_are_frozen(name: str) -> None:
    mesh = PolygonMesh.from_faces(np.eye(3), [[0, 1, 2], [2, 1, 0]])
    with pytest.raises(ValueError, match="read-only"):
        getattr(half_edges(mesh), name)[0] = 0
