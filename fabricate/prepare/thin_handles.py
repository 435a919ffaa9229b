"""Handles too thin to be made, which are cut away, and holes as narrow, which are filled.

No pattern can be laid round such a handle: its tiles would be so small that the gap would leave nothing of their necks.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fabricate.arrays import Floats, Indices, Mask
from fabricate.mesh.closed import genus
from fabricate.prepare.short_loops import Loop, short_loops
from fabricate.prepare.triangle_mesh import TriangleMesh, edges
from fabricate.triangles.adjacency import neighbour_means

DETOUR = 1.2
"""How much longer a loop along edges may be than the circle that it stands for."""

APART, MOST_DRAWN = 0.25, 0.5
"""How far the rims of a cut are drawn back, as a share of the thinnest handle, and of the way to the points next to
them."""


@dataclass(frozen=True, eq=False)
class Simplified:
    """A surface without thin handles.

    Attributes
    ----------
    surface : TriangleMesh
        One closed surface, mm.
    notes : tuple of str
        What changed, if anything did.
    """

    surface: TriangleMesh
    notes: tuple[str, ...]


def without_thin_handles(surface: TriangleMesh, *, thinnest: float) -> Simplified:
    """Return a surface without handles thinner, and without holes narrower, than `thinnest` mm across.

    That is: no loop round a handle or a hole is about as short as the circumference of a circle of that diameter.
    """
    before = handles = genus(surface.polygons)
    longest, places = DETOUR * np.pi * thinnest, []
    while handles:
        loops = short_loops(surface, across=thinnest, longest=longest)
        if not loops:
            break
        places.append(surface.points[loops[0].points].mean(axis=0))
        surface = _parted(surface, loops, smallest=longest**2, apart=APART * thinnest)
        handles = genus(surface.polygons)
    if handles == before:
        return Simplified(surface, ())
    x, y, z = places[0]
    note = (
        f"the genus became {handles} instead of {before}: handles thinner and holes narrower than {thinnest:.3g} mm, "
        f"one at ({x:.4g}, {y:.4g}, {z:.4g}) mm, have no room for two walls and the gap between, and were cut or filled"
    )
    return Simplified(surface, (note,))


def _parted(surface: TriangleMesh, loops: list[Loop], *, smallest: float, apart: float) -> TriangleMesh:
    """Return the surface cut along loops, and covered with lids, without the pieces between cuts round one handle."""
    pieces = _pieces(_cut(surface, _disjoint(loops, most=len(loops)), apart=apart))
    large = [piece for piece in pieces if piece.area >= smallest]
    if len(large) == 1:
        return large[0]
    pieces = _pieces(_cut(surface, _disjoint(loops, most=1), apart=apart))
    return max(pieces, key=lambda piece: piece.area)


def _disjoint(loops: list[Loop], *, most: int) -> list[Loop]:
    """Return loops without common points, of independent classes, and of each class no more than `most`."""
    used: set[int] = set()
    counts: dict[bytes, int] = {}
    basis: list[int] = []
    chosen = []
    for loop in loops:
        if used.intersection(loop.points.tolist()) or counts.get(loop.word, 0) >= most:
            continue
        if loop.word not in counts and not _independent(int.from_bytes(loop.word), basis):
            continue
        counts[loop.word] = counts.get(loop.word, 0) + 1
        used.update(loop.points.tolist())
        chosen.append(loop)
    return chosen


def _independent(word: int, basis: list[int]) -> bool:
    """Tell whether a word is no sum of those in a basis over Z2, and add it then."""
    for other in basis:
        word = min(word, word ^ other)
    if word:
        basis.append(word)
        basis.sort(reverse=True)
    return word != 0


def _cut(surface: TriangleMesh, loops: list[Loop], *, apart: float) -> TriangleMesh:
    """Return the surface with points on loops doubled, the two rims drawn apart, and a lid on each."""
    joined = edges(surface)
    count = len(surface.points)
    keys = joined.ends @ [count, 1]
    on_loops = [np.sort(np.stack([loop.points, np.roll(loop.points, -1)], axis=1), axis=1) for loop in loops]
    kept: Mask = ~np.isin(keys, np.concatenate(on_loops) @ [count, 1])
    left, right = joined.sides[kept].T
    ahead = _next(left), _next(right)
    corners = 3 * len(surface.triangles)
    links = np.concatenate([np.stack([left, ahead[1]], axis=1), np.stack([ahead[0], right], axis=1)])
    graph = coo_array((np.ones(len(links)), tuple(links.T)), shape=(corners, corners))
    _, fan = connected_components(graph, directed=False)
    points = np.zeros((int(fan.max()) + 1, 3))
    points[fan] = surface.points[surface.triangles.ravel()]
    rims = joined.sides[~kept].ravel()
    opened: Indices = fan.reshape(-1, 3).astype(np.int64)
    ends: Indices = np.stack([opened.ravel()[_next(rims)], opened.ravel()[rims]], axis=1)
    return _covered(_drawn_back(points, opened, ends, by=apart), opened, ends)


def _drawn_back(points: Floats, triangles: Indices, rims: Indices, *, by: float) -> Floats:
    """Return the points, those on rims drawn up to `by` mm to the others next to them, so that rims come apart."""
    inside: Mask = np.ones(len(points), dtype=bool)
    inside[rims] = False
    means = neighbour_means(triangles, count=len(points))
    share = means @ inside.astype(np.float64)
    drawn = np.flatnonzero(~inside & (share > 0.0))
    way = (means[drawn] @ (inside[:, None] * points)) / share[drawn, None] - points[drawn]
    length = np.maximum(np.linalg.norm(way, axis=1, keepdims=True), np.finfo(float).tiny)
    moved = points.copy()
    moved[drawn] += np.minimum(by / length, MOST_DRAWN) * way
    return moved


def _covered(points: Floats, triangles: Indices, rims: Indices) -> TriangleMesh:
    """Return a mesh with a fan of triangles, round its mean, on each closed chain of the edges `rims`, (k, 2) int."""
    used, ends = np.unique(rims, return_inverse=True)
    ends = ends.reshape(-1, 2)
    graph = coo_array((np.ones(len(ends)), tuple(ends.T)), shape=(len(used), len(used)))
    number, label = connected_components(graph, directed=False)
    sums = [np.bincount(label, values, minlength=number) for values in points[used].T]
    centres = np.column_stack(sums) / np.bincount(label, minlength=number)[:, None]
    covers = np.column_stack([rims, len(points) + label[ends[:, 0]]])
    return TriangleMesh(np.concatenate([points, centres]), np.concatenate([triangles, covers]))


def _next(sides: Indices) -> Indices:
    following: Indices = sides - sides % 3 + (sides + 1) % 3
    return following


def _pieces(surface: TriangleMesh) -> list[TriangleMesh]:
    """Return the components of a mesh."""
    joined = edges(surface)
    count = len(surface.points)
    graph = coo_array((np.ones(len(joined.ends)), tuple(joined.ends.T)), shape=(count, count))
    number, label = connected_components(graph, directed=False)
    found = []
    for piece in range(number):
        triangles = surface.triangles[label[surface.triangles[:, 0]] == piece]
        own, corners = np.unique(triangles, return_inverse=True)
        found.append(TriangleMesh(surface.points[own], corners.reshape(-1, 3)))
    return found
