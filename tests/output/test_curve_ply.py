"""The curve as PLY: points come back exactly, edges make one closed loop."""

from __future__ import annotations

from pathlib import Path

import networkx as nx
import numpy as np
import pytest
import trimesh

from fabricate.formats.read_ply import read_ply_numbers
from fabricate.output.curve_ply import write_curves

ANGLE = np.linspace(0, 2 * np.pi, 101)[:-1]
CURVE = np.stack([np.cos(ANGLE), np.sin(2 * ANGLE), np.sin(ANGLE) / 3], axis=1) * 50


def read(path: Path) -> tuple[list[str], np.ndarray, np.ndarray]:
    """Header lines, points and edges, by the PLY format's own description in the header."""
    header, _, body = path.read_bytes().partition(b"end_header\n")
    lines = header.decode("ascii").splitlines()
    counts = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element")}
    points = np.frombuffer(body, "<f8", 3 * counts["vertex"]).reshape(-1, 3)
    edges = np.frombuffer(body[points.nbytes :], "<i4").reshape(-1, 2)
    assert len(edges) == counts["edge"]
    return lines, points, edges


def test_points_come_back_exactly_and_edges_close_one_loop(tmp_path: Path) -> None:
    write_curves(tmp_path / "curve.ply", [CURVE])
    lines, points, edges = read(tmp_path / "curve.ply")
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"]
    assert sum(line.startswith("property double") for line in lines) == 3
    np.testing.assert_array_equal(points, CURVE)
    loop = nx.Graph(edges.tolist())
    assert nx.is_connected(loop)
    assert all(degree == 2 for _, degree in loop.degree)
    assert len(loop) == len(CURVE)
    assert edges[-1].tolist() == [len(CURVE) - 1, 0]


def test_several_curves_are_loops_of_their_own(tmp_path: Path) -> None:
    curves = [CURVE, CURVE[::2] + 1.0, CURVE[:5]]
    write_curves(tmp_path / "curve.ply", curves)
    lines, points, edges = read(tmp_path / "curve.ply")
    assert any("3 closed curves" in line for line in lines)
    np.testing.assert_array_equal(points, np.concatenate(curves))
    loops = nx.Graph(edges.tolist())
    assert [len(loop) for loop in nx.connected_components(loops)] == [100, 50, 5]
    assert all(degree == 2 for _, degree in loops.degree)


def test_the_second_file_is_the_same_and_the_curve_is_untouched(tmp_path: Path) -> None:
    before = CURVE.copy()
    for name in ("a.ply", "b.ply"):
        write_curves(tmp_path / name, [CURVE])
    assert (tmp_path / "a.ply").read_bytes() == (tmp_path / "b.ply").read_bytes()
    np.testing.assert_array_equal(CURVE, before)
    assert CURVE.flags.writeable


@pytest.mark.parametrize("points", [np.zeros((2, 3)), np.zeros((5, 2)), np.zeros(9)])
def test_what_is_no_closed_curve_is_refused(tmp_path: Path, points: np.ndarray) -> None:
    with pytest.raises(ValueError, match="expected"):
        write_curves(tmp_path / "curve.ply", [CURVE, points])
    assert not list(tmp_path.iterdir())


def test_no_curve_at_all_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="found 0"):
        write_curves(tmp_path / "curve.ply", [])


def test_places_under_the_curve_are_properties_of_its_points(tmp_path: Path) -> None:
    under = np.stack([0.9 * CURVE, 0.8 * CURVE])
    write_curves(tmp_path / "curve.ply", [CURVE, 2 * CURVE], [under, 2 * under])
    found = read_ply_numbers((tmp_path / "curve.ply").read_bytes(), prefix="joint")
    np.testing.assert_array_equal(found, np.tile(np.concatenate([CURVE, 2 * CURVE]), 2) * np.repeat([0.9, 0.8], 3))
    read_back = trimesh.load(tmp_path / "curve.ply")
    np.testing.assert_allclose(read_back.vertices[:100], CURVE)
