from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import networkx as nx
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from polyhedra import HANDLES, bipyramid, directed_edges, named, octahedron, tetrahedron
from scipy.spatial import KDTree
from truchet import quasi_trees

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.curve import traced_arcs
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.errors import PatternError
from fabricate.mesh.crease import creased
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.surface.cut import CutSurface, cut
from fabricate.surface.limit import LimitSurface, limit_vertices
from fabricate.surface.template import ray_steps

RINGS = st.sampled_from([(0.5,), (0.31,), (0.4, 0.6), (0.37, 0.46, 0.63), (0.35, 0.36, 0.5, 0.69)])
NAMED = {name: random_duotone(subdivided(mesh, levels=1), seed=2) for name, mesh in named().items()}
SPHERE = random_duotone(subdivided(geodesic_sphere(frequency=2), levels=1), seed=1)


def cut_up(duotone: Duotone, *rings: float, resolution: int = 3) -> CutSurface:
    return cut(duotone, LimitSurface.of(duotone.quads), rings=rings or (0.5,), resolution=resolution)


def cut_into(duotone: Duotone, rings: tuple[float, ...], resolution: int) -> CutSurface:
    return cut_up(duotone, *rings, resolution=resolution)


CUTS = st.builds(cut_into, quasi_trees(), RINGS, st.integers(2, 3))
law = settings(max_examples=25)


def directed(triangles: np.ndarray) -> set[tuple[int, int]]:
    return set(directed_edges(triangles.tolist()))


def areas(surface: CutSurface) -> np.ndarray:
    a, b, c = np.moveaxis(surface.points[surface.triangles], 1, 0)
    return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2)


def curve_steps(surface: CutSurface) -> np.ndarray:
    places = surface.points[surface.curves[0]]
    return np.asarray(np.roll(places, -1, axis=0) - places)


def enclosed(surface: CutSurface) -> float:
    return float(np.linalg.det(surface.points[surface.triangles]).sum() / 6)


@law
@given(surface=CUTS)
def test_surface_is_closed_and_each_edge_has_two_triangles(surface: CutSurface) -> None:
    edges = directed(surface.triangles)
    assert len(edges) == surface.triangles.size
    assert all(edge[::-1] in edges for edge in edges)
    assert np.unique(surface.triangles).tolist() == list(range(len(surface.points)))


@law
@given(surface=CUTS)
def test_triangles_round_each_point_form_one_fan(surface: CutSurface) -> None:
    beyond = {(a, b): c for t in surface.triangles.tolist() for a, b, c in (t, t[1:] + t[:1], t[2:] + t[:2])}
    fans = np.bincount(surface.triangles.ravel())
    ring = dict(beyond.keys())
    for point, start in ring.items():
        met, other = 1, beyond[point, start]
        while other != start:
            met, other = met + 1, beyond[point, other]
        assert met == fans[point]


@law
@given(duotone=quasi_trees(), resolution=st.integers(2, 4))
def test_euler_characteristic_is_that_of_the_shape(duotone: Duotone, resolution: int) -> None:
    surface = cut_up(duotone, resolution=resolution)
    edges = surface.triangles.size // 2
    assert len(surface.points) - edges + len(surface.triangles) == 2 - 2 * duotone.quads.genus


@law
@given(surface=CUTS)
def test_each_region_is_connected_and_bounded_by_its_curves(surface: CutSurface) -> None:
    forward = [list(zip(curve, np.roll(curve, -1).tolist(), strict=True)) for curve in surface.curves.tolist()]
    backward = [[step[::-1] for step in curve] for curve in forward]
    for region, rims in enumerate(zip([*forward, []], [[], *backward], strict=True)):
        edges = directed(surface.triangles[surface.regions == region])
        assert {edge for edge in edges if edge[::-1] not in edges} == {step for rim in rims for step in rim}
        assert nx.is_connected(nx.Graph(list(edges)))


@law
@given(surface=CUTS)
def test_curves_meet_no_point_twice(surface: CutSurface) -> None:
    assert len(np.unique(surface.curves)) == surface.curves.size


@law
@given(surface=CUTS)
def test_rays_cross_each_curve_once(surface: CutSurface) -> None:
    for arcs, curve, step in zip(surface.arcs, surface.curves, surface.crossings, strict=True):
        assert (arcs == surface.rays[:, :, step]).all()
        assert (surface.curve_rays[:, step] == curve).all()
        assert (arcs[surface.order, :-1].ravel() == curve).all()


@law
@given(surface=CUTS)
def test_half_rays_begin_on_the_curve_and_fill_the_rays(surface: CutSurface) -> None:
    rays = surface.curve_rays
    pieces = []
    for half_rays, curve in zip(surface.half_rays, surface.curves, strict=True):
        assert (half_rays.left[:, 0] == curve).all()
        assert (half_rays.right[:, 0] == curve).all()
        pieces += [half_rays.left[:, ::-1], half_rays.right]
    assert (np.concatenate([pieces[0][:, :1], *(piece[:, 1:] for piece in pieces)], axis=1) == rays[:, ::-1]).all()
    for before, after in zip(surface.half_rays, surface.half_rays[1:], strict=False):
        assert before.right.shape == after.left.shape


@law
@given(surface=CUTS)
def test_the_last_ray_of_an_arc_is_the_first_of_the_next(surface: CutSurface) -> None:
    along = surface.rays[surface.order]
    assert (along[:, -1] == np.roll(along[:, 0], -1, axis=0)).all()


@law
@given(surface=CUTS)
def test_rays_run_along_edges_from_blue_to_yellow(surface: CutSurface) -> None:
    regions = [directed(surface.triangles[surface.regions == k]) for k in range(len(surface.crossings) + 1)]
    for ray in surface.curve_rays.tolist():
        for number, step in enumerate(pairwise(ray)):
            found = [k for k, edges in enumerate(regions) if step in edges]
            assert found == [int((surface.crossings > number).sum())]


@law
@given(duotone=quasi_trees(), rings=RINGS, resolution=st.integers(2, 4))
def test_counts(duotone: Duotone, rings: tuple[float, ...], resolution: int) -> None:
    surface = cut_up(duotone, *rings, resolution=resolution)
    tiles, steps = len(duotone.joined), sum(ray_steps(rings=rings, resolution=resolution))
    assert len(surface.triangles) == tiles * 2 * resolution * (2 * steps - 1)
    assert surface.curves.shape == (len(rings), 2 * tiles * resolution)
    assert surface.rings.tolist() == list(rings)
    assert surface.rays.shape == (2 * tiles, resolution + 1, steps + 1)
    assert surface.order.tolist() == traced_arcs(duotone).tolist()


@pytest.mark.parametrize("name", NAMED)
@pytest.mark.parametrize("arc", [0.31, 0.5, 0.69])
def test_no_two_points_are_in_one_place(name: str, arc: float) -> None:
    surface = cut_up(NAMED[name], arc, resolution=5)
    distance = np.asarray(KDTree(surface.points).query(surface.points, k=2)[0])[:, 1]
    assert distance.min() > 1e-4 * np.ptp(surface.points)


@pytest.mark.parametrize("name", NAMED)
def test_the_same_input_gives_the_same_bytes(name: str) -> None:
    first, second = cut_up(NAMED[name]), cut_up(NAMED[name])
    for array in ("points", "normals", "triangles", "regions", "rays", "crossings", "rings", "order"):
        assert getattr(first, array).tobytes() == getattr(second, array).tobytes()


@pytest.mark.parametrize("name", NAMED)
def test_corners_of_tiles_keep_their_numbers_and_lie_on_the_limit(name: str) -> None:
    surface, quads = cut_up(NAMED[name]), NAMED[name].quads
    np.testing.assert_allclose(surface.points[: len(quads.points)], limit_vertices(quads), atol=1e-13)


@pytest.mark.parametrize("name", NAMED)
def test_a_finer_cut_keeps_the_points_of_the_coarse_curve(name: str) -> None:
    coarse, fine = (cut_up(NAMED[name], 0.4, resolution=resolution) for resolution in (4, 8))
    np.testing.assert_allclose(fine.points[fine.curves[:, ::2]], coarse.points[coarse.curves], atol=1e-12)


@pytest.mark.parametrize("name", ["tetrahedron", "octahedron", "bipyramid 8", "torus", "double torus"])
def test_triangles_face_outward(name: str) -> None:
    surface = cut_up(NAMED[name], resolution=6)
    a, b, c = np.moveaxis(surface.points[surface.triangles], 1, 0)
    facet, seen = np.cross(b - a, c - a), surface.normals[surface.triangles].mean(axis=1)
    assert (np.einsum("ij,ij->i", facet, seen) > 0).all()
    assert enclosed(surface) > 0


def test_volume_and_curve_length_converge_quadratically() -> None:
    found = [cut_up(SPHERE, 0.45, resolution=n) for n in (3, 6, 12, 24)]  # radial() doubles along with these
    volumes = np.array([enclosed(surface) for surface in found])
    lengths = np.array([np.linalg.norm(curve_steps(surface), axis=1).sum() for surface in found])
    for values in (volumes, lengths):
        differences = np.diff(values)
        assert np.log2(differences[-2] / differences[-1]) == pytest.approx(2, abs=0.2)


def test_curve_turns_evenly_also_where_it_enters_the_next_tile() -> None:
    sharpest = []
    for resolution in (8, 16, 32):
        surface = cut_up(SPHERE, 0.5, resolution=resolution)
        steps = curve_steps(surface)
        steps /= np.linalg.norm(steps, axis=1, keepdims=True)
        cosine = np.einsum("ij,ij->i", steps, np.roll(steps, 1, axis=0))
        sharpest.append(np.arccos(np.clip(cosine, -1, 1)).max())
    np.testing.assert_allclose(np.divide(sharpest[:-1], sharpest[1:]), 2, atol=0.2)


def test_yellow_grows_with_the_arc_position() -> None:
    shares = []
    for arc in np.linspace(0.3, 0.7, 9):
        surface = cut_up(SPHERE, float(arc), resolution=8)
        shares.append(areas(surface)[surface.regions == 0].sum() / areas(surface).sum())
    assert (np.diff(shares) > 0).all()
    # the law of square tiles, half of them joined
    np.testing.assert_allclose(shares, 0.5 + np.pi / 4 * (2 * np.linspace(0.3, 0.7, 9) - 1), atol=0.03)


@pytest.mark.parametrize("mesh", [tetrahedron(), octahedron(), bipyramid(5), HANDLES["torus"][0]])
def test_two_curves_are_an_error(mesh: object) -> None:
    quads = subdivided(mesh, levels=1)  # type: ignore[arg-type]
    joined = random_duotone(quads, seed=1).joined.copy()
    joined[np.argmax(joined)] = False
    with pytest.raises(PatternError, match="expected one closed curve, found 2"):
        cut_up(Duotone(quads, joined))


@pytest.mark.parametrize(("arc", "resolution"), [(0.2, 4), (0.8, 4), (0.5, 1)])
def test_what_the_template_refuses_is_refused(arc: float, resolution: int) -> None:
    with pytest.raises(PatternError):
        cut_up(SPHERE, arc, resolution=resolution)


@given(millionths=st.integers(293_000, 707_000), resolution=st.integers(20, 26))
@settings(max_examples=10)
@example(millionths=293_001, resolution=23)
def test_arcs_with_many_digits_leave_no_crack(millionths: int, resolution: int) -> None:
    surface = cut_up(NAMED["tetrahedron"], millionths / 1e6, resolution=resolution)
    assert len(surface.points) - surface.triangles.size // 6 == 2


CREASED = random_duotone(subdivided(creased(HANDLES["even torus"][0], angle=0.0), levels=2), seed=1)


def test_with_creases_only_their_points_have_mitres() -> None:
    surface, quads = cut_up(CREASED), CREASED.quads
    per_side = surface.rays.shape[2] - 2
    # each crease has its own points and shares its ends with others
    on_creases = quads.creases.sum() // 2 * per_side + (quads.crease_counts > 1).sum()
    assert (surface.mitre > 1.0).sum() == on_creases
    assert (surface.mitre >= 1.0).all()
    np.testing.assert_allclose(np.linalg.norm(surface.normals, axis=1), 1, rtol=1e-12)


def test_mitred_normals_lead_out_of_every_triangle_around() -> None:
    surface = cut_up(CREASED, resolution=6)
    a, b, c = np.moveaxis(surface.points[surface.triangles], 1, 0)
    facet = np.cross(b - a, c - a)
    facet /= np.linalg.norm(facet, axis=1, keepdims=True)
    outward = (surface.mitre[:, None] * surface.normals)[surface.triangles]
    depth = np.einsum("tj,tkj->tk", facet, outward)
    np.testing.assert_allclose(depth, 1, atol=1e-6)


def test_a_surface_made_without_mitres_has_none() -> None:
    surface = cut_up(SPHERE)
    needed = ("points", "normals", "triangles", "regions", "rays", "crossings", "rings", "order")
    bare = CutSurface(*(getattr(surface, name) for name in needed))
    assert bare.mitre.tolist() == [1.0] * len(surface.points)
    assert not bare.along.any()
    with pytest.raises(ValueError, match="shape"):
        replace(surface, mitre=np.ones(3))


@pytest.mark.parametrize(
    "name", ["points", "normals", "triangles", "regions", "rays", "crossings", "rings", "order", "mitre", "along"]
)
def test_arrays_are_frozen(name: str) -> None:
    with pytest.raises(ValueError, match="read-only"):
        getattr(cut_up(SPHERE), name)[0] = 0
