"""Components: all faces are dealt out, cavities are told from bodies, and policies choose."""

from __future__ import annotations

import numpy as np
import pytest
from breaking import box, inside_out, shuffled, united
from hypothesis import given, settings
from hypothesis import strategies as st
from polyhedra import face_lists, polyhedra, seeds, tetrahedron

from fabricate.errors import MeshError
from fabricate.mesh.closed import checked_closed, signed_volume
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.components import anatomy, chosen, components, split


@settings(max_examples=40)
@given(st.lists(polyhedra(), min_size=1, max_size=4), seeds)
def test_shuffled_components_are_sorted_out(meshes: list[PolygonMesh], seed: int) -> None:
    apart = [mesh.scaled(1 + n).moved((1 + n) * mesh.points + 10 * n) for n, mesh in enumerate(meshes)]
    found = components(shuffled(united(*apart), np.random.default_rng(seed)))
    volumes = [signed_volume(checked_closed(part)) for part in found]
    assert volumes == sorted(volumes, reverse=True)
    assert volumes == pytest.approx(sorted(map(signed_volume, apart), reverse=True))
    assert sum(len(part.points) for part in found) == sum(len(mesh.points) for mesh in meshes)


def test_components_keep_their_order_of_points_and_faces() -> None:
    first, second = split(united(box(), tetrahedron()))
    assert (first.points == box().points).all()
    assert face_lists(first) == face_lists(box())
    assert face_lists(second) == face_lists(tetrahedron())


def test_one_component_is_the_same_object_and_spare_points_are_in_none() -> None:
    mesh = box()
    assert split(mesh)[0] is mesh
    (found,) = split(PolygonMesh(np.vstack([[[9, 9, 9]], mesh.points]), mesh.corners + 1, mesh.offsets))
    assert len(found.points) == 8


def test_of_equal_components_the_first_comes_first() -> None:
    found = components(united(box(at=(5, 0, 0)), box(), box(at=(-5, 0, 0))))
    assert [part.points[:, 0].mean() for part in found] == [5, 0, -5]


def test_cavities_are_inward_and_inside() -> None:
    rattle = united(box(8.0), inside_out(box(4.0)), box(1.0), inside_out(box(2.0, at=(20.0, 0.0, 0.0))))
    found = anatomy(rattle)
    assert [round(signed_volume(part)) for part in found.bodies] == [512, -8, 1]
    assert [round(signed_volume(part)) for part in found.cavities] == [-64]


def test_only_takes_one_and_names_the_other_policies() -> None:
    mesh = box()
    assert chosen(mesh, policy="only") == (mesh,)
    with pytest.raises(MeshError, match=r'found 3 bodies, .*components = "largest".*"each" to make all 3$'):
        chosen(united(box(), box(at=(5, 0, 0)), tetrahedron()), policy="only")


def test_only_tells_of_cavities() -> None:
    hollow = united(box(4.0), inside_out(box(1.0)))
    with pytest.raises(MeshError, match=r"found 1 body with 1 cavity inside.* as if it were filled$"):
        chosen(hollow, policy="only")
    with pytest.raises(MeshError, match=r"found 2 bodies with 1 cavity inside.*both leave cavities out$"):
        chosen(united(hollow, box(at=(9, 0, 0))), policy="only")


def test_largest_and_each_leave_cavities_out() -> None:
    mesh = united(inside_out(box(1.0)), box(2.0, at=(9, 0, 0)), box(4.0))
    assert [round(signed_volume(part)) for part in chosen(mesh, policy="largest")] == [64]
    assert [round(signed_volume(part)) for part in chosen(mesh, policy="each")] == [64, 8]
