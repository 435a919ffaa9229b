"""Binary STL: exact coordinates, unit normals, a header no reader takes for ASCII, and what slicers think."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
import trimesh

from fabricate.output.stl import write_stl
from fabricate.solid.part import Part

TORUS = trimesh.creation.torus(10, 3)
PART = Part("yellow", TORUS.vertices * 1.1 + 0.3, TORUS.faces)


def test_coordinates_and_order_come_back_exactly(tmp_path: Path) -> None:
    write_stl(tmp_path / "a.stl", PART)
    mesh = trimesh.load(tmp_path / "a.stl", process=False)
    np.testing.assert_array_equal(mesh.triangles, PART.points[PART.triangles])
    np.testing.assert_array_equal(np.diff(mesh.faces.ravel()), 1)


def test_normals_are_unit_and_outward_by_the_right_hand_rule(tmp_path: Path) -> None:
    write_stl(tmp_path / "a.stl", PART)
    mesh = trimesh.load(tmp_path / "a.stl", process=False)
    raw = np.frombuffer((tmp_path / "a.stl").read_bytes()[84:], np.uint8).reshape(-1, 50)
    normals = np.ascontiguousarray(raw[:, :12]).view("<f4")
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-6)
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    np.testing.assert_allclose(np.einsum("mx,mx->m", normals, b - a), 0, atol=1e-5)
    assert (np.einsum("mx,mx->m", normals, np.cross(b - a, c - a)) > 0).all()
    assert mesh.volume > 0


def test_the_size_is_that_of_the_format_and_the_header_is_not_ascii_stl(tmp_path: Path) -> None:
    write_stl(tmp_path / "a.stl", Part("solid", PART.points, PART.triangles))
    content = (tmp_path / "a.stl").read_bytes()
    assert len(content) == 84 + 50 * len(PART.triangles)
    assert int.from_bytes(content[80:84], "little") == len(PART.triangles)
    assert not content.lower().startswith(b"solid")


def test_the_second_file_is_the_same_and_the_part_is_untouched(tmp_path: Path) -> None:
    points, triangles = PART.points.copy(), PART.triangles.copy()
    for name in ("a.stl", "b.stl"):
        write_stl(tmp_path / name, PART)
    assert (tmp_path / "a.stl").read_bytes() == (tmp_path / "b.stl").read_bytes()
    np.testing.assert_array_equal(PART.points, points)
    np.testing.assert_array_equal(PART.triangles, triangles)


def test_a_triangle_without_area_has_a_zero_normal(tmp_path: Path) -> None:
    needle = Part("needle", np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]), np.array([[0, 1, 2]]))
    write_stl(tmp_path / "a.stl", needle)
    assert (tmp_path / "a.stl").read_bytes()[84:96] == bytes(12)


@pytest.mark.slicer
def test_a_slicer_finds_one_manifold_part_with_nothing_to_repair(tmp_path: Path) -> None:
    slicer = shutil.which("prusa-slicer")
    if slicer is None:
        pytest.skip("prusa-slicer IS MISSING, nothing was judged: install the package prusa-slicer")
    write_stl(tmp_path / "a.stl", PART)
    info = subprocess.run(
        [slicer, "--info", str(tmp_path / "a.stl")], capture_output=True, text=True, check=True
    ).stdout
    assert "manifold = yes" in info
    assert "number_of_parts =  1" in info
    assert f"number_of_facets = {len(PART.triangles)}" in info
    for repair in ("open_edges", "facets_reversed", "facets_removed", "edges_fixed"):
        assert repair not in info
