from __future__ import annotations

import json

import numpy as np
import pytest
from breaking import box, moebius, turned, united, with_faces, without
from hypothesis import given, settings
from polyhedra import face_lists, surfaces

from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.prepare.diagnosis import diagnosed
from fabricate.prepare.diagnosis_text import diagnosis_data, diagnosis_text


@settings(max_examples=20)
@given(surfaces())
def test_the_data_is_json_and_says_what_the_record_says(mesh: PolygonMesh) -> None:
    found = diagnosed(mesh)
    data = json.loads(json.dumps(diagnosis_data(found), allow_nan=False))
    assert data["faces"] == found.faces
    assert data["polygons"] == [{"corners": kind.corners, "faces": kind.faces} for kind in found.polygons]
    assert data["largest_components"][0]["genus"] == found.largest_components[0].genus
    assert data["crossings"]["count"] == found.crossings.count


def test_a_clean_box_has_no_faults() -> None:
    text = diagnosis_text(diagnosed(box()))
    assert "8 vertices, 6 faces: 6 quads" in text
    assert "genus 0, faces outward" in text
    assert text.endswith("no faults: closed, manifold, wound consistently, without crossings")


@pytest.mark.parametrize(
    ("mesh", "words"),
    [
        (without(box(2.0), {0}), "1 boundary loop: 4 edges of length 8 at ("),
        (turned(box(), {0}), "4 edges wound inconsistently, at ("),
        (moebius(), "non-orientable"),
        (with_faces(box(), [*face_lists(box()), [0, 1, 1]]), "1 degenerate face, at ("),
        (with_faces(box(), 2 * face_lists(box())), "6 duplicate faces, at ("),
        (united(box(), box(at=(0.5, 0.4, 0.3))), "pairs of triangles that cross"),
        (united(*(box(at=(3.0 * n, 0, 0)) for n in range(5))), "and 2 more"),
        (PolygonMesh(np.vstack([box().points, [9, 9, 9]]), box().corners, box().offsets), "1 point without a face"),
    ],
)
def test_every_fault_has_its_line(mesh: PolygonMesh, words: str) -> None:
    assert words in diagnosis_text(diagnosed(mesh))
