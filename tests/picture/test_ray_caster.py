"""Rays: Embree against a search through all triangles."""

from __future__ import annotations

import numpy as np

from fabricate.picture.ray_caster import RayCaster

RANDOM = np.random.default_rng(7)
POINTS = RANDOM.uniform(-1, 1, (90, 3))
TRIANGLES = np.arange(90).reshape(30, 3)
ORIGINS = np.tile(np.float32([0.1, -3, 0.2]), (400, 1))
DIRECTIONS = (RANDOM.uniform(-1, 1, (400, 3)) - ORIGINS).astype(np.float32)


def nearest(origin: np.ndarray, direction: np.ndarray) -> tuple[int, float]:
    """First triangle along a ray and its distance, from the barycentric coordinates in every triangle."""
    a, b, c = POINTS[TRIANGLES.T]
    columns = np.stack([b - a, c - a, np.broadcast_to(-direction, a.shape)], axis=-1)
    u, v, t = np.linalg.solve(columns, (origin - a)[:, :, None])[:, :, 0].T
    distance = np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0), t, np.inf)
    return (int(distance.argmin()), float(distance.min())) if np.isfinite(distance).any() else (-1, np.inf)


def test_first_hits_agree_with_a_search_through_all_triangles() -> None:
    hits = RayCaster(POINTS, TRIANGLES).first_hits(ORIGINS, DIRECTIONS)
    expected = [nearest(*ray) for ray in zip(ORIGINS.astype(float), DIRECTIONS.astype(float), strict=True)]
    triangle = np.array([hit for hit, _ in expected])
    assert (triangle >= 0).sum() > 100
    np.testing.assert_array_equal(hits.triangle, triangle)
    met = triangle >= 0
    np.testing.assert_allclose(hits.distance[met], [t for hit, t in expected if hit >= 0], rtol=1e-4)
    there = np.einsum("nc,ncx->nx", hits.weights[met], POINTS[TRIANGLES[triangle[met]]])
    np.testing.assert_allclose(there, (ORIGINS + hits.distance[:, None] * DIRECTIONS)[met], atol=1e-4)


def test_a_ray_is_blocked_exactly_when_it_hits_something() -> None:
    caster = RayCaster(POINTS, TRIANGLES)
    hits = caster.first_hits(ORIGINS, DIRECTIONS)
    np.testing.assert_array_equal(caster.blocked(ORIGINS, DIRECTIONS), hits.triangle >= 0)


def test_no_rays_give_no_hits() -> None:
    nothing = np.zeros((0, 3), dtype=np.float32)
    assert len(RayCaster(POINTS, TRIANGLES).first_hits(nothing, nothing).triangle) == 0
    assert len(RayCaster(POINTS, TRIANGLES).blocked(nothing, nothing)) == 0
