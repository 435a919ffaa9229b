"""Closedness: laws on shapes of known topology, an oracle on voxels and real files, every fault caught."""

from __future__ import annotations

import csv
import os
import re
from collections import Counter
from itertools import pairwise, product
from pathlib import Path

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.errors import FabricateError, MeshError
from fabricate.formats.reading import read_mesh
from fabricate.mesh.closed import checked_closed, genus, signed_volume
from fabricate.mesh.polygon_mesh import PolygonMesh

CORPUS = os.environ.get("FABRICATE_CORPUS")
GOOD = sorted(Path(CORPUS, "good").iterdir()) if CORPUS else []
BAD = sorted(Path(CORPUS, "bad").iterdir()) if CORPUS else []
CATALOGUE = Path(CORPUS, "catalogue.csv").read_text(encoding="utf-8").splitlines() if CORPUS else []
ORACLE_FACES = 30_000  # the oracle walks face by face

CUBE_POINTS = np.array(list(product((0.0, 1.0), repeat=3)))
CUBE_FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TETRAHEDRON_FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


def cube() -> PolygonMesh:
    return PolygonMesh.from_faces(CUBE_POINTS, CUBE_FACES)


def prism(sides: int, height: float = 1.0) -> PolygonMesh:
    angles = 2 * np.pi * np.arange(sides) / sides
    ring = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(sides)])
    walls = [(i, (i + 1) % sides, sides + (i + 1) % sides, sides + i) for i in range(sides)]
    caps: list[tuple[int, ...]] = [tuple(reversed(range(sides))), tuple(range(sides, 2 * sides))]
    return PolygonMesh.from_faces(np.concatenate([ring, ring + np.array([0, 0, height])]), [*caps, *walls])


def grid(columns: int, rows: int, *, mirrored: bool) -> list[tuple[int, ...]]:
    """Quads of a grid that closes in both directions: a torus, or a Klein bottle if one seam is mirrored."""

    def point(i: int, j: int) -> int:
        turns, i = divmod(i, columns)
        return i * rows + (-j if mirrored and turns else j) % rows

    return [
        (point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1))
        for i in range(columns)
        for j in range(rows)
    ]


def torus(columns: int, rows: int) -> PolygonMesh:
    around, across = np.meshgrid(
        np.linspace(0, 2 * np.pi, columns, endpoint=False),
        np.linspace(0, 2 * np.pi, rows, endpoint=False),
        indexing="ij",
    )
    radius = 3 + np.cos(across)
    points = np.stack([radius * np.cos(around), radius * np.sin(around), np.sin(across)], axis=-1)
    return PolygonMesh.from_faces(points.reshape(-1, 3), grid(columns, rows, mirrored=False))


def voxels(cells: set[tuple[int, int, int]]) -> PolygonMesh:
    """The unit squares between cells that are filled and cells that are not."""
    numbers: dict[tuple[int, ...], int] = {}
    faces = []
    for cell in sorted(cells):
        for face in CUBE_FACES:
            corners = CUBE_POINTS[list(face)]
            outward = np.rint(2 * (corners.mean(axis=0) - 0.5)).astype(int)
            if tuple(np.add(cell, outward).tolist()) not in cells:
                places = [tuple(place) for place in (corners + cell).astype(int).tolist()]
                faces.append([numbers.setdefault(place, len(numbers)) for place in places])
    return PolygonMesh.from_faces(list(numbers), faces)


def face_lists(mesh: PolygonMesh) -> list[list[int]]:
    return [mesh.corners[begin:end].tolist() for begin, end in pairwise(mesh.offsets.tolist())]


def with_faces(mesh: PolygonMesh, faces: list[list[int]]) -> PolygonMesh:
    return PolygonMesh.from_faces(mesh.points, faces)


def flipped(mesh: PolygonMesh, which: set[int]) -> PolygonMesh:
    faces = face_lists(mesh)
    return with_faces(mesh, [face[::-1] if number in which else face for number, face in enumerate(faces)])


def places_in(message: str) -> list[tuple[float, ...]]:
    return [tuple(map(float, found.split(","))) for found in re.findall(r"\(([-\d., e+]+)\)", message)]


def naive_fault(mesh: PolygonMesh) -> str | None:
    """Say which fault a mesh has, walking over it face by face and round every point."""
    faces = face_lists(mesh)
    if any(len(set(face)) < len(face) for face in faces):
        return "more than once"
    if len({frozenset(face) for face in faces}) < len(faces):
        return "same corners"
    directed = Counter((a, b) for face in faces for a, b in pairwise([*face, face[0]]))
    undirected: Counter[frozenset[int]] = Counter()
    for (a, b), times in directed.items():
        undirected[frozenset((a, b))] += times
    if max(undirected.values()) > 2:
        return "non-manifold edge"
    if min(undirected.values()) < 2:
        return "open boundary|non-orientable"
    if max(directed.values()) > 1:
        return "wound inconsistently|non-orientable"
    links: dict[int, nx.Graph] = {}
    for face in faces:
        for before, point, after in zip([face[-1], *face], face, [*face[1:], face[0]], strict=False):
            links.setdefault(point, nx.Graph()).add_edge((before, point), (after, point))
    if any(nx.number_connected_components(link) > 1 for link in links.values()):
        return "non-manifold vert"
    if nx.number_connected_components(nx.Graph(directed.keys())) > 1:
        return "components"
    return "no volume" if abs(naive_volume(mesh)) < 1e-9 * np.ptp(mesh.points, axis=0).max() ** 3 else None


def naive_volume(mesh: PolygonMesh) -> float:
    volume = 0.0
    for face in face_lists(mesh):
        centre = mesh.points[face].mean(axis=0)
        for a, b in pairwise([*face, face[0]]):
            volume += float(np.linalg.det([centre, mesh.points[a], mesh.points[b]])) / 6
    return volume


@given(st.integers(3, 12), st.floats(0.1, 10))
def test_prism_is_a_sphere_with_the_volume_of_its_formula(sides: int, height: float) -> None:
    closed = checked_closed(prism(sides, height))
    assert genus(closed) == 0
    assert signed_volume(closed) == pytest.approx(height * sides / 2 * np.sin(2 * np.pi / sides))


@given(st.integers(3, 12), st.integers(3, 12))
def test_torus_has_one_handle(columns: int, rows: int) -> None:
    closed = checked_closed(torus(columns, rows))
    assert genus(closed) == 1
    assert signed_volume(closed) == pytest.approx(naive_volume(closed))


@pytest.mark.parametrize("holes", [1, 2, 3])
def test_plate_has_one_handle_per_hole(holes: int) -> None:
    plate = {(i, j, 0) for i in range(2 * holes + 1) for j in range(3)}
    closed = checked_closed(voxels(plate - {(2 * hole + 1, 1, 0) for hole in range(holes)}))
    assert genus(closed) == holes
    assert signed_volume(closed) == pytest.approx(len(plate) - holes)


@given(st.sets(st.tuples(*3 * [st.integers(0, 2)]), min_size=1, max_size=20))
def test_voxels_are_judged_as_by_the_oracle(cells: set[tuple[int, int, int]]) -> None:
    mesh = voxels(cells)
    fault = naive_fault(mesh)
    if fault is None:
        assert signed_volume(checked_closed(mesh)) == pytest.approx(len(cells))
    else:
        with pytest.raises(MeshError, match=fault):
            checked_closed(mesh)


@given(st.sets(st.integers(0, 7)))
def test_flipped_faces_are_counted_or_make_the_whole_inside_out(which: set[int]) -> None:
    mesh = flipped(prism(6), which)
    if 0 < len(which) < 8:
        with pytest.raises(MeshError, match=rf"flipping {min(len(which), 8 - len(which))} face"):
            checked_closed(mesh)
    else:
        assert signed_volume(checked_closed(mesh)) > 0


@given(
    st.sets(st.tuples(*3 * [st.integers(0, 1)]), min_size=1),
    st.sets(st.integers(0, 23), max_size=4),
    st.sets(st.integers(0, 23), max_size=4),
)
def test_voxels_with_lost_and_flipped_faces_are_judged_as_by_the_oracle(
    cells: set[tuple[int, int, int]], lost: set[int], turned: set[int]
) -> None:
    whole = flipped(voxels(cells), turned)
    faces = [face for number, face in enumerate(face_lists(whole)) if number not in lost] or [[0, 1, 2]]
    used, corners = np.unique(np.concatenate(faces), return_inverse=True)
    offsets = np.concatenate([[0], np.cumsum([len(face) for face in faces])])
    mesh = PolygonMesh(whole.points[used], corners, offsets)
    fault = naive_fault(mesh)
    if fault is None:
        checked_closed(mesh)
    else:
        with pytest.raises(MeshError, match=fault):
            checked_closed(mesh)


def test_inside_out_mesh_comes_back_reversed_face_by_face() -> None:
    mesh = flipped(prism(5), set(range(7)))
    closed = checked_closed(mesh)
    assert signed_volume(closed) == pytest.approx(-signed_volume(mesh))
    for before, after in zip(face_lists(mesh), face_lists(closed), strict=True):
        assert after == [before[0], *before[:0:-1]]


def test_a_mesh_that_is_right_comes_back_as_it_is() -> None:
    mesh = cube()
    assert checked_closed(mesh) is mesh


@given(st.lists(st.tuples(*3 * [st.floats(-1, 1)]), min_size=8, max_size=8), st.integers(0, 3))
def test_volume_does_not_depend_on_where_polygons_begin_or_where_they_are(
    points: list[tuple[float, float, float]], turns: int
) -> None:
    mesh = PolygonMesh.from_faces(points, CUBE_FACES)
    turned = with_faces(mesh, [[*face[turns:], *face[:turns]] for face in face_lists(mesh)])
    volume = signed_volume(mesh)
    assert volume == pytest.approx(naive_volume(mesh), abs=1e-12)
    assert signed_volume(turned) == pytest.approx(volume, abs=1e-12)
    assert signed_volume(mesh.moved(mesh.points + 100)) == pytest.approx(volume, abs=1e-9)
    assert signed_volume(mesh.scaled(2)) == pytest.approx(8 * volume, abs=1e-12)


def test_open_boundary_counts_edges_and_loops_and_shows_one() -> None:
    faces = face_lists(cube())
    with pytest.raises(MeshError, match=r"open boundary of 4 edges in 1 loop\b") as caught:
        checked_closed(with_faces(cube(), faces[1:]))
    assert places_in(str(caught.value))[0] in {(0, 0, 0.5), (0, 0.5, 0), (0, 1, 0.5), (0, 0.5, 1)}
    with pytest.raises(MeshError, match="open boundary of 8 edges in 2 loops"):
        checked_closed(with_faces(cube(), faces[2:]))


def test_points_that_coincide_are_named_as_the_cause_of_an_open_boundary() -> None:
    mesh = cube()
    unwelded = PolygonMesh(mesh.points[mesh.corners], np.arange(24), mesh.offsets)
    with pytest.raises(MeshError, match=r"24 edges in 6 loops.*16 boundary points .*merge"):
        checked_closed(unwelded)


def test_two_cubes_on_one_edge_have_a_non_manifold_edge() -> None:
    with pytest.raises(MeshError, match=r"1 non-manifold edge where.* 4 faces") as caught:
        checked_closed(voxels({(0, 0, 0), (1, 1, 0)}))
    assert places_in(str(caught.value)) == [(1, 1, 0.5)]


def test_two_cubes_on_one_point_have_a_non_manifold_vertex() -> None:
    with pytest.raises(MeshError, match=r"1 non-manifold vertex where.* 2 fans") as caught:
        checked_closed(voxels({(0, 0, 0), (1, 1, 1)}))
    assert places_in(str(caught.value)) == [(1, 1, 1)]


def test_three_cubes_in_a_diagonal_row_have_two_non_manifold_vertices() -> None:
    with pytest.raises(MeshError, match="2 non-manifold vertices"):
        checked_closed(voxels({(0, 0, 0), (1, 1, 1), (2, 2, 2)}))


def test_components_are_counted() -> None:
    with pytest.raises(MeshError, match="3 components"):
        checked_closed(voxels({(0, 0, 0), (2, 0, 0), (0, 2, 0)}))


def test_klein_bottle_is_non_orientable_although_it_is_closed() -> None:
    points = np.random.default_rng(1).random((20, 3))
    with pytest.raises(MeshError, match="non-orientable, like a Moebius strip"):
        checked_closed(PolygonMesh.from_faces(points, grid(5, 4, mirrored=True)))


def test_moebius_strip_is_called_non_orientable_rather_than_open() -> None:
    points = np.random.default_rng(1).random((10, 3))
    strip = [(i, i + 1, i + 6, i + 5) for i in range(4)] + [(4, 5, 0, 9)]
    with pytest.raises(MeshError, match=r"non-orientable.* 1 edge wound inconsistently"):
        checked_closed(PolygonMesh.from_faces(points, strip))


def test_face_that_repeats_a_point_is_caught() -> None:
    faces = face_lists(cube())
    with pytest.raises(MeshError, match="1 face with a point used more than once") as caught:
        checked_closed(with_faces(cube(), [[0, 1, 3, 1], *faces[1:]]))
    assert places_in(str(caught.value))[0] == tuple(CUBE_POINTS[1])


@pytest.mark.parametrize("copy", [[0, 1, 3, 2], [3, 2, 0, 1], [2, 3, 1, 0]])
def test_face_on_top_of_another_is_caught(copy: list[int]) -> None:
    with pytest.raises(MeshError, match="1 face with exactly the same corners") as caught:
        checked_closed(with_faces(cube(), [*face_lists(cube()), copy]))
    assert places_in(str(caught.value))[0] == (0, 0.5, 0.5)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_flat_mesh_has_no_volume_whatever_its_size(scale: float) -> None:
    with pytest.raises(MeshError, match="no volume"):
        checked_closed(cube().moved(cube().points * [scale, scale, 0]))
    assert signed_volume(checked_closed(cube().scaled(scale))) == pytest.approx(scale**3)


def test_points_that_all_coincide_have_no_volume() -> None:
    with pytest.raises(MeshError, match="no volume"):
        checked_closed(PolygonMesh.from_faces(np.ones((4, 3)), TETRAHEDRON_FACES))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("size", [3.4e38, 1e45])
def test_coordinates_that_float32_cannot_hold_are_taken(size: float) -> None:
    huge = cube().scaled(size / float(np.abs(cube().points).max()))
    assert checked_closed(huge) is huge
    assert signed_volume(huge) == pytest.approx(float(np.ptp(huge.points[:, 0])) ** 3)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e46])
def test_unusable_coordinate_is_shown_with_its_point(value: float) -> None:
    points = CUBE_POINTS.copy()
    points[5, 1] = value
    with pytest.raises(MeshError, match="point 5 is at"):
        checked_closed(PolygonMesh.from_faces(points, CUBE_FACES))


@pytest.mark.parametrize(
    ("points", "faces", "message"),
    [
        (CUBE_POINTS, [], "no faces, only 8 points"),
        (CUBE_POINTS, [*CUBE_FACES, (0, 1)], "1 face with fewer than 3 corners"),
        (CUBE_POINTS, [*CUBE_FACES, (0, 1, 8)], "points 0 to 8, but the points are numbered 0 to 7"),
        (CUBE_POINTS, [*CUBE_FACES, (0, 1, -1)], "points -1 to 7"),
        (np.vstack([CUBE_POINTS, [9, 9, 9]]), CUBE_FACES, "1 point without any face"),
    ],
)
def test_numbers_that_make_no_mesh_are_caught(points: np.ndarray, faces: list[tuple[int, ...]], message: str) -> None:
    with pytest.raises(MeshError, match=message):
        checked_closed(PolygonMesh.from_faces(points, faces))


def test_messages_are_one_line() -> None:
    for broken in (
        with_faces(cube(), face_lists(cube())[1:]),
        flipped(cube(), {2}),
        voxels({(0, 0, 0), (1, 1, 0)}),
    ):
        with pytest.raises(MeshError) as caught:
            checked_closed(broken)
        assert "\n" not in str(caught.value)


@pytest.mark.skipif(not CORPUS, reason="FABRICATE_CORPUS is not set")
@pytest.mark.parametrize("path", GOOD + BAD, ids=lambda path: path.name)
def test_real_files_are_judged_as_by_the_oracle(path: Path) -> None:
    try:
        mesh = read_mesh(path)
    except FabricateError:
        return
    if len(mesh.offsets) > ORACLE_FACES:
        pytest.skip("too large for the oracle")
    fault = naive_fault(mesh)
    if fault is None:
        assert signed_volume(checked_closed(mesh)) == pytest.approx(abs(naive_volume(mesh)))
    else:
        with pytest.raises(MeshError, match=fault):
            checked_closed(mesh)


@pytest.mark.skipif(not CORPUS, reason="FABRICATE_CORPUS is not set")
@pytest.mark.parametrize("path", GOOD, ids=lambda path: path.name)
def test_good_files_have_the_catalogue_s_genus(path: Path) -> None:
    row = next(row for row in csv.DictReader(CATALOGUE) if row["name"] == path.name)
    try:
        mesh = read_mesh(path)
    except FabricateError:
        assert row["format"].split()[0] not in {"obj", "off", "ply", "stl"}
        return
    if row["components"] != "1":
        with pytest.raises(MeshError, match=f"{row['components']} components"):
            checked_closed(mesh)
    elif len(mesh.points) != int(row["V"]):  # the catalogue counts points after merging those that coincide
        with pytest.raises(MeshError, match="merge such points"):
            checked_closed(mesh)
    else:
        assert genus(checked_closed(mesh)) == int(row["genus"])
