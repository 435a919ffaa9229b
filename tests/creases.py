"""Meshes with creases to test on: any set of edges may be sharp."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import strategies as st
from polyhedra import quad_meshes, seeds, surfaces

from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.mesh.half_edges import half_edges
from fabricate.mesh.polygon_mesh import PolygonMesh

SHARES = st.sampled_from([0.1, 0.3, 0.6, 0.9, 1.0])


def with_random_creases(mesh: PolygonMesh, *, share: float, seed: int) -> PolygonMesh:
    """Return the mesh with about that share of its edges made creases."""
    edge = half_edges(mesh).edge
    return replace(mesh, creases=(np.random.default_rng(seed).random(edge.max() + 1) < share)[edge])


def quads_with_random_creases(quads: QuadMesh, *, share: float, seed: int) -> QuadMesh:
    edge = quads.half_edges.edge
    return replace(quads, creases=(np.random.default_rng(seed).random(edge.max() + 1) < share)[edge])


def creased_surfaces() -> st.SearchStrategy[PolygonMesh]:
    """Draw a closed mesh with creases anywhere: darts, crossings, loops, and edges that lead nowhere."""
    return st.builds(
        lambda mesh, share, seed: with_random_creases(mesh, share=share, seed=seed), surfaces(), SHARES, seeds
    )


def creased_quad_meshes() -> st.SearchStrategy[QuadMesh]:
    """Draw tiles with creases along any of their sides."""
    return st.builds(
        lambda quads, share, seed: quads_with_random_creases(quads, share=share, seed=seed),
        quad_meshes(),
        SHARES,
        seeds,
    )


def prism(sides: int, *, height: float, creased: bool = True) -> PolygonMesh:
    """Return a prism on a regular polygon in the unit circle, its two rims creases."""
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = np.stack([np.cos(angle), np.sin(angle), np.full(sides, height / 2)], axis=1)
    below, ahead = np.arange(sides), (np.arange(sides) + 1) % sides
    caps = [below[::-1].tolist(), (below + sides).tolist()]
    walls = np.stack([below, ahead, ahead + sides, below + sides], axis=1).tolist()
    mesh = PolygonMesh.from_faces(np.concatenate([ring * [1, 1, -1], ring]), caps + walls)
    upper = mesh.corners >= sides
    level = upper == upper[mesh.next_corner]
    return replace(mesh, creases=level & creased)


def bracket() -> PolygonMesh:
    """Return an L, 6 long and 4 wide, in six quads and two faces of six corners: one edge is concave."""
    outline = np.array([[-3, -3], [3, -3], [3, 1], [1, 1], [1, 3], [-3, 3]], dtype=np.float64)
    points = np.concatenate([np.insert(outline, 2, z, axis=1) for z in (-2.0, 2.0)])
    ahead = [(k + 1) % 6 for k in range(6)]
    walls = [[k, ahead[k], ahead[k] + 6, k + 6] for k in range(6)]
    return PolygonMesh.from_faces(points, [list(range(6))[::-1], list(range(6, 12)), *walls])
