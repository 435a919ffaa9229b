"""Repair by policy: closed components with volume, or one line that names the fault and its cure."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from breaking import box, inside_out, moebius, turned, united, without
from hypothesis import given
from polyhedra import surfaces

from fabricate.errors import FabricateError, MeshError
from fabricate.formats.reading import read_mesh
from fabricate.mesh.closed import checked_closed
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.components import components
from fabricate.prepare.ear_clipping import ear_clipped
from fabricate.prepare.enclosure import is_sheet
from fabricate.prepare.repair import RepairPolicy, repaired
from fabricate.triangles.crossing import crossing_triangles

CORPUS = os.environ.get("FABRICATE_CORPUS")
BAD = sorted(Path(CORPUS, "bad").iterdir()) if CORPUS else []

WRAP, GENTLE = r'; prepare.repair = "wrap" would cure it$', r'; prepare.repair = "gentle" would cure it$'


def flat() -> PolygonMesh:
    """Return a closed surface without volume."""
    return box().moved(box().points * [1, 1, 0])


@given(surfaces())
@pytest.mark.parametrize("policy", ["none", "gentle", "wrap"])
def test_a_clean_mesh_passes_as_it_is(policy: RepairPolicy, mesh: PolygonMesh) -> None:
    crossing = len(crossing_triangles(mesh.points, ear_clipped(mesh).triangles))
    if policy != "wrap" or not (crossing or is_sheet(mesh)):
        assert repaired(mesh, policy=policy).mesh is mesh


def test_several_components_and_an_inside_out_one_pass() -> None:
    mesh = united(box(4.0), inside_out(box()), box(at=(9, 0, 0)))
    assert repaired(mesh, policy="none").mesh is mesh
    assert repaired(inside_out(box()), policy="none").actions == ()


@pytest.mark.parametrize(
    ("mesh", "policy", "message"),
    [
        (without(box(), {0}), "gentle", rf"open boundary of 4 edges in 1 loop, .* at \(.*{WRAP}"),
        (without(box(), {0}), "none", rf"open boundary.*{WRAP}"),
        (moebius(), "gentle", rf"non-orientable.*{WRAP}"),
        (flat(), "gentle", rf"no volume.*{WRAP}"),
        (united(box(), flat()), "gentle", rf"no volume.*{WRAP}"),
        (turned(box(), {1}), "none", rf"wound inconsistently.*{GENTLE}"),
        (PolygonMesh.from_faces(np.zeros((3, 3)), [[0, 0, 1]]), "gentle", "no faces"),
    ],
)
def test_what_is_left_is_named_with_its_cure(mesh: PolygonMesh, policy: RepairPolicy, message: str) -> None:
    with pytest.raises(MeshError, match=message) as caught:
        repaired(mesh, policy=policy)
    assert "\n" not in str(caught.value)


def test_no_cure_is_promised_where_there_is_none() -> None:
    for policy in ("none", "gentle"):
        with pytest.raises(MeshError) as caught:
            repaired(
                PolygonMesh.from_faces(np.ones((4, 3)), [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]), policy=policy
            )
        assert "prepare.repair" not in str(caught.value)


def test_wrap_is_only_put_on_what_needs_it() -> None:
    pytest.importorskip("pymeshlab")
    assert [action.name for action in repaired(turned(box(), {1}), policy="wrap").actions] == ["faces flipped"]
    crossing = united(box(), box(at=(0.5, 0.4, 0.3)))
    assert repaired(crossing, policy="gentle").mesh is crossing
    assert repaired(crossing, policy="wrap").actions[-1].name == "surfaces wrapped"
    plate = box().moved(box().points * [1.0, 1.0, 0.003])
    assert repaired(plate, policy="gentle").mesh is plate
    assert repaired(plate, policy="wrap").actions[-1].name == "surfaces wrapped"


@pytest.mark.slow
@pytest.mark.skipif(not CORPUS, reason="FABRICATE_CORPUS is not set")
@pytest.mark.parametrize("path", BAD, ids=lambda path: path.name)
def test_bad_files_are_cured_by_wrapping(path: Path) -> None:
    pytest.importorskip("pymeshlab")
    try:
        mesh = read_mesh(path)
    except FabricateError:
        return
    found = repaired(mesh, policy="wrap").mesh
    assert len(crossing_triangles(found.points, ear_clipped(found).triangles)) == 0
    for part in components(found):
        checked_closed(part)
    try:
        repaired(mesh, policy="gentle")
    except MeshError as error:
        assert str(error).endswith("would cure it")  # noqa: PT017
