from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import assume, example, given
from hypothesis import strategies as st
from polyhedra import directed_edges
from scipy.spatial import KDTree

from fabricate.errors import PatternError
from fabricate.surface.template import (
    ARC_MAX,
    ARC_MIN,
    TileTemplate,
    radial,
    ray_steps,
    side_fractions,
    tile_template,
)

CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
SQUARE = shapely.box(0, 0, 1, 1)

# numbers that people write, and numbers that come out of a search for an exact area
ARCS = st.one_of(
    st.integers(293_000, 707_000).map(lambda millionths: millionths / 1e6),
    st.floats(0.293, 0.707),
)
RESOLUTIONS = st.integers(2, 24)
Rings = tuple[float, ...]


def apart(rings: Sequence[float]) -> bool:
    return all(outer - inner > 1e-4 for inner, outer in pairwise(rings))


RINGS = st.lists(ARCS, min_size=1, max_size=4).map(sorted).filter(apart).map(tuple)


def made(rings: Rings, resolution: int, yellow_joined: bool) -> TileTemplate:
    return tile_template(rings=rings, resolution=resolution, yellow_joined=yellow_joined)


TEMPLATES = st.builds(made, RINGS, RESOLUTIONS, st.booleans())


def areas(template: TileTemplate) -> np.ndarray:
    a, b, c = np.moveaxis(template.uv[template.triangles], 1, 0)
    (u, v), (s, t) = (b - a).T, (c - a).T
    return np.asarray((u * t - v * s) / 2)


def edge_set(triangles: np.ndarray) -> set[tuple[int, int]]:
    return set(directed_edges(triangles.tolist()))


def matched(found: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Return which of the found points each wanted one is; all must be there, each once."""
    distance, place = (np.asarray(column) for column in KDTree(found).query(wanted))
    np.testing.assert_allclose(distance, 0, atol=1e-9)
    assert sorted(place.tolist()) == list(range(len(found)))
    return place


def round_corners(yellow_joined: bool) -> np.ndarray:
    """Return the corners that the two arcs go round, by the side through which each enters."""
    return CORNERS[[1, 3]] if yellow_joined else CORNERS[[0, 2]]


def blue_region(arc: float, yellow_joined: bool) -> shapely.Geometry:
    """Return the blue part of a tile, with circles of a thousand segments."""
    radius = 1 - arc if yellow_joined else arc
    discs = [shapely.Point(corner).buffer(radius, quad_segs=256) for corner in round_corners(yellow_joined)]
    inside = shapely.union_all(discs).intersection(SQUARE)
    return inside if yellow_joined else SQUARE.difference(inside)


def triangulated(template: TileTemplate, own: np.ndarray) -> shapely.Geometry:
    corners = template.uv[template.triangles[own]]
    return shapely.union_all(shapely.polygons(corners))


@given(rings=RINGS, resolution=RESOLUTIONS, yellow_joined=st.booleans())
@example(rings=(0.293001,), resolution=23, yellow_joined=True)
@example(rings=(0.293001,), resolution=23, yellow_joined=False)
@example(rings=(0.29301,), resolution=47, yellow_joined=True)
@example(rings=(ARC_MIN + 1e-9,), resolution=4, yellow_joined=True)
@example(rings=(ARC_MAX - 1e-9,), resolution=4, yellow_joined=False)
@example(rings=(ARC_MIN + 1e-9, ARC_MAX - 1e-9), resolution=4, yellow_joined=False)
def test_counts_follow_from_the_steps_of_a_ray(rings: Rings, resolution: int, yellow_joined: bool) -> None:
    template, n = made(rings, resolution, yellow_joined), resolution
    length = sum(ray_steps(rings=rings, resolution=n))
    assert len(template.uv) == 4 + 4 * (length - 1) + 2 * (n - 1) * (length - 1) + n - 1
    assert len(template.triangles) == 2 * n * (2 * length - 1)
    assert template.rays.shape == (2, n + 1, length + 1)
    assert np.unique(template.triangles).tolist() == list(range(len(template.uv)))


@given(rings=RINGS, resolution=RESOLUTIONS)
def test_bands_have_an_even_number_of_steps_about_as_long_as_the_others(rings: Rings, resolution: int) -> None:
    m = radial(resolution)
    first, *across, last = ray_steps(rings=rings, resolution=resolution)
    assert (first, last) == (m, m)
    for steps, (inner, outer) in zip(across, pairwise(rings), strict=True):
        assert steps % 2 == 0
        assert steps == 2 or abs(steps / (outer - inner) - 2 * m) <= 1 / (outer - inner) + 1e-9


@given(template=TEMPLATES)
def test_triangles_cover_the_square_once_and_turn_left(template: TileTemplate) -> None:
    assert areas(template).min() > 0
    assert areas(template).sum() == pytest.approx(1, abs=1e-12)


@given(template=TEMPLATES)
def test_triangles_form_a_disc_whose_rim_is_the_four_sides(template: TileTemplate) -> None:
    directed = edge_set(template.triangles)
    assert len(directed) == template.triangles.size
    rim = {edge for edge in directed if edge[::-1] not in directed}
    edges = (len(directed) + len(rim)) // 2
    assert len(template.uv) - edges + len(template.triangles) == 1
    begin, end = template.uv[np.array(sorted(rim))].transpose(1, 0, 2)
    u, v = begin.T
    along_u, along_v = (end - begin).T
    sides = [(v == 0, along_u), (u == 1, along_v), (v == 1, -along_u), (u == 0, -along_v)]
    assert np.any([on & (onward > 0) for on, onward in sides], axis=0).all()
    assert len(rim) == 4 * (template.rays.shape[2] - 1)


@given(rings=RINGS, resolution=RESOLUTIONS, yellow_joined=st.booleans())
def test_samples_come_as_corners_sides_interior(rings: Rings, resolution: int, yellow_joined: bool) -> None:
    uv, per_side = made(rings, resolution, yellow_joined).uv, sum(ray_steps(rings=rings, resolution=resolution)) - 1
    assert (uv[:4] == CORNERS).all()
    fractions = side_fractions(rings=rings, resolution=resolution)[1:-1, None]
    for side, (yellow, blue) in enumerate(((0, 1), (2, 1), (2, 3), (0, 3))):
        expected = CORNERS[yellow] + fractions * (CORNERS[blue] - CORNERS[yellow])
        found = uv[4 + side * per_side : 4 + (side + 1) * per_side]
        np.testing.assert_allclose(found, expected, atol=1e-12)
    inside = uv[4 + 4 * per_side :]
    assert (inside > 0).all()
    assert (inside < 1).all()


@given(rings=RINGS, resolution=RESOLUTIONS)
def test_both_kinds_divide_their_sides_and_cross_their_arcs_alike(rings: Rings, resolution: int) -> None:
    rim = 4 + 4 * (sum(ray_steps(rings=rings, resolution=resolution)) - 1)
    joined, other = (made(rings, resolution, kind) for kind in (True, False))
    np.testing.assert_allclose(joined.uv[:rim], other.uv[:rim], atol=1e-12)
    assert len(joined.uv) == len(other.uv)
    assert joined.crossings.tolist() == other.crossings.tolist()


@given(rings=RINGS, resolution=RESOLUTIONS)
def test_side_fractions_rise_from_end_to_end_by_way_of_the_rings(rings: Rings, resolution: int) -> None:
    fractions = side_fractions(rings=rings, resolution=resolution)
    assert fractions[0] == 0
    assert fractions[-1] == pytest.approx(1, abs=1e-15)
    at = np.cumsum(ray_steps(rings=rings, resolution=resolution))[:-1]
    assert fractions[at] == pytest.approx(rings, abs=1e-15)
    assert (np.diff(fractions) > 0).all()


@given(rings=RINGS, resolution=RESOLUTIONS, yellow_joined=st.booleans())
def test_arcs_are_quarter_circles_from_side_to_side(rings: Rings, resolution: int, yellow_joined: bool) -> None:
    template = made(rings, resolution, yellow_joined)
    for ring, arcs in zip(rings, template.arcs, strict=True):
        spokes = template.uv[arcs] - round_corners(yellow_joined)[:, None]
        radius = 1 - ring if yellow_joined else ring
        np.testing.assert_allclose(np.linalg.norm(spokes, axis=2), radius, atol=1e-12)
        turn = np.unwrap(np.arctan2(spokes[..., 1], spokes[..., 0]), axis=1)
        step = np.pi / 2 / resolution
        np.testing.assert_allclose(np.diff(turn, axis=1), -step if yellow_joined else step, atol=1e-12)
        np.testing.assert_allclose(template.uv[arcs[:, 0]], [[ring, 0], [1 - ring, 1]], atol=1e-12)


@given(template=TEMPLATES)
def test_arcs_run_along_edges_with_the_lower_region_on_the_left(template: TileTemplate) -> None:
    regions = [edge_set(template.triangles[template.regions == k]) for k in range(len(template.crossings) + 1)]
    for arcs, left, right in zip(template.arcs, regions, regions[1:], strict=False):
        for arc in arcs.tolist():
            steps = list(pairwise(arc))
            assert left.issuperset(steps)
            assert right.issuperset((b, a) for a, b in steps)
        between = {edge for edge in left if edge[::-1] in right}
        assert len(between) == 2 * (arcs.shape[1] - 1)
    assert all(
        left.isdisjoint(edge[::-1] for edge in far) for k, left in enumerate(regions) for far in regions[k + 2 :]
    )


@given(template=TEMPLATES)
def test_rays_are_straight_edges_from_blue_to_yellow(template: TileTemplate) -> None:
    samples = template.uv[template.rays]
    steps = np.diff(samples, axis=2)
    whole = samples[:, :, -1] - samples[:, :, 0]
    along = np.einsum("arsk,ark->ars", steps, whole)
    across = steps[..., 0] * whole[..., None, 1] - steps[..., 1] * whole[..., None, 0]
    assert (along > 0).all()
    np.testing.assert_allclose(across, 0, atol=1e-12)
    regions = [edge_set(template.triangles[template.regions == k]) for k in range(len(template.crossings) + 1)]
    for ray in template.rays.reshape(-1, template.rays.shape[2]).tolist():
        for step, edge in enumerate(pairwise(ray)):
            found = [k for k, edges in enumerate(regions) if {edge, edge[::-1]} & edges]
            assert found == [int((template.crossings > step).sum())]


@given(rings=RINGS, resolution=RESOLUTIONS, yellow_joined=st.booleans())
def test_first_and_last_rays_run_along_the_sides(rings: Rings, resolution: int, yellow_joined: bool) -> None:
    template = made(rings, resolution, yellow_joined)
    per_side = template.rays.shape[2] - 2
    ends = ((0, 1), (2, 1), (2, 3), (0, 3))
    for side_in, ray in zip((0, 2), template.rays, strict=True):
        side_out = side_in + 1 if yellow_joined else (side_in + 3) % 4
        for side, found in ((side_in, ray[0]), (side_out, ray[-1])):
            yellow, blue = ends[side]
            own = range(4 + side * per_side, 4 + (side + 1) * per_side)
            assert found.tolist() == [blue, *reversed(own), yellow]


@given(rings=RINGS, resolution=RESOLUTIONS)
def test_rays_of_a_joined_tile_meet_in_pairs_on_the_diagonal(rings: Rings, resolution: int) -> None:
    joined, other = made(rings, resolution, True), made(rings, resolution, False)
    assert joined.rays[0, :, -1].tolist() == joined.rays[1, ::-1, -1].tolist()
    u, v = joined.uv[joined.rays[0, :, -1]].T
    np.testing.assert_allclose(u, v, atol=1e-12)
    assert other.rays[0, :, 0].tolist() == other.rays[1, ::-1, 0].tolist()
    np.testing.assert_allclose(other.uv[other.rays[0, :, 0]].sum(axis=1), 1, atol=1e-12)


@given(template=TEMPLATES, share=st.floats(-0.95, 0.95))
def test_curves_can_move_along_their_rays_without_folding(template: TileTemplate, share: float) -> None:
    uv, towards = template.uv.copy(), 1 if share > 0 else -1
    beside = np.moveaxis(template.rays[:, :, template.crossings + towards], 2, 0)
    uv[template.arcs] += abs(share) * (template.uv[beside] - template.uv[template.arcs])
    moved = TileTemplate(uv, template.triangles, template.regions, template.rays, template.crossings)
    assert areas(moved).min() > 0


@given(rings=RINGS, resolution=st.integers(2, 12), yellow_joined=st.booleans())
def test_regions_are_those_that_circles_cut_off(rings: Rings, resolution: int, yellow_joined: bool) -> None:
    template = made(rings, resolution, yellow_joined)
    for number, ring in enumerate(rings):
        beyond = blue_region(ring, yellow_joined)
        for own, exact in (
            (template.regions <= number, SQUARE.difference(beyond)),
            (template.regions > number, beyond),
        ):
            off = triangulated(template, own).symmetric_difference(exact).area
            # what chords cut off two quarter circles
            radius, step = 1 - ring if yellow_joined else ring, np.pi / 2 / resolution
            assert off == pytest.approx(radius**2 * resolution * (step - np.sin(step)), abs=2e-5)


@pytest.mark.parametrize("arc", [0.3, 0.5, 0.62])
def test_yellow_area_converges_quadratically_to_that_of_circles(arc: float) -> None:
    exact = {True: 1 - np.pi / 2 * (1 - arc) ** 2, False: np.pi / 2 * arc**2}
    for kind, limit in exact.items():
        found = [made((arc,), n, kind) for n in (4, 8, 16)]
        errors = [abs(areas(template)[template.regions == 0].sum() - limit) for template in found]
        np.testing.assert_allclose(np.log2(np.divide(errors[:-1], errors[1:])), 2, atol=0.02)


@given(rings=RINGS, resolution=RESOLUTIONS)
def test_blue_joined_is_yellow_joined_a_quarter_turn_on(rings: Rings, resolution: int) -> None:
    blue = made(rings, resolution, False)
    source = made(tuple(1 - ring for ring in reversed(rings)), resolution, True)
    assume(len(source.uv) == len(blue.uv))  # the width of a band can be rounded to another number of steps
    u, v = source.uv.T
    place = matched(blue.uv, np.stack([1 - v, u], axis=1))
    expected = {
        (frozenset(triangle), len(rings) - region)
        for triangle, region in zip(place[source.triangles].tolist(), source.regions.tolist(), strict=True)
    }
    found = zip(map(frozenset, blue.triangles.tolist()), blue.regions.tolist(), strict=True)
    assert set(found) == expected


@given(template=TEMPLATES)
def test_a_tile_looks_the_same_upside_down(template: TileTemplate) -> None:
    place = matched(template.uv, 1 - template.uv)
    assert (template.rays[::-1] == place[template.rays]).all()


@given(resolution=st.integers(2, 500))
def test_rays_have_fewer_points_than_arcs_but_two_steps_at_least(resolution: int) -> None:
    m = radial(resolution)
    assert m >= 2
    assert m <= max(2, resolution)
    assert radial(resolution + 1) >= m


@pytest.mark.parametrize("arc", [0.0, 0.29, ARC_MIN, ARC_MAX, 0.71, 1.0, -0.5, float("nan"), float("inf")])
def test_arcs_that_would_meet_are_an_error(arc: float) -> None:
    with pytest.raises(PatternError, match=rf"between 0\.293 and 0\.707, found {arc:g}"):
        made((arc,), 8, True)


@pytest.mark.parametrize(
    ("rings", "words"),
    [
        ((), "at least one position of an arc"),
        ((0.4, 0.4), "must increase from yellow to blue, found 0.4 after 0.4"),
        ((0.4, 0.6, 0.5), "must increase from yellow to blue, found 0.5 after 0.6"),
        ((0.4, 0.8), r"between 0\.293 and 0\.707, found 0.8"),
    ],
)
def test_rings_that_do_not_increase_within_bounds_are_an_error(rings: Rings, words: str) -> None:
    with pytest.raises(PatternError, match=words):
        made(rings, 8, True)


@pytest.mark.parametrize("resolution", [1, 0, -4])
def test_one_segment_is_no_arc(resolution: int) -> None:
    with pytest.raises(PatternError, match=f"at least 2 segments per arc, found {resolution}"):
        made((0.5,), resolution, False)


@pytest.mark.parametrize("name", ["uv", "triangles", "regions", "rays", "crossings"])
def test_arrays_are_frozen(name: str) -> None:
    with pytest.raises(ValueError, match="read-only"):
        getattr(made((0.4, 0.6), 3, True), name)[0] = 0
