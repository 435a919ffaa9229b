"""Handles too thin to be made: what is no thicker than two walls and the gap between them is cut away, holes as narrow
are filled, and both are told.

No pattern can be laid round such a handle: its tiles would be so small that the gap would leave nothing of their necks.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components, dijkstra

from fabricate.arrays import Floats, Indices, Mask, Words
from fabricate.mesh.closed import genus
from fabricate.prepare.homology import edge_words
from fabricate.prepare.triangle_mesh import Edges, TriangleMesh, edges
from fabricate.triangles.adjacency import neighbour_means
from fabricate.triangles.normals import vertex_normals
from fabricate.triangles.ray_casting import first_hits

SPACING = 1.0 / 6.0
"""Distance between the places from which loops are looked for, as a share of the longest loop."""

DETOUR = 1.2
"""How much longer a loop along edges may be than the circle that it stands for."""

APART, MOST_DRAWN = 0.25, 0.5
"""How far the rims of a cut are drawn back, as a share of the thinnest handle, and of the way to the points next to
them."""

START = 1e-3
"""How far from the surface a ray begins, mm."""

SOURCES = 64
"""Ways are looked for from so many places at once: each takes a row as long as the surface has points."""


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


class _Loop(NamedTuple):
    length: float
    points: Indices
    word: bytes


def without_thin_handles(surface: TriangleMesh, *, thinnest: float) -> Simplified:
    """Return a surface without handles thinner, and without holes narrower, than `thinnest` mm across.

    That is: no loop round a handle or a hole is about as short as the circumference of a circle of that diameter.
    """
    before = handles = genus(surface.polygons)
    longest, places = DETOUR * np.pi * thinnest, []
    while handles:
        loops = _short_loops(surface, across=thinnest, longest=longest)
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


def _short_loops(surface: TriangleMesh, *, across: float, longest: float) -> list[_Loop]:
    """Return loops that do not part the surface, the shortest one first, at most one from each place tried."""
    joined = edges(surface)
    words, lengths = edge_words(surface), joined.lengths(surface.points)
    shape = (len(surface.points),) * 2
    ways = csr_array(coo_array((lengths, tuple(joined.ends.T)), shape=shape))
    numbers = csr_array(coo_array((np.arange(1, len(lengths) + 1), tuple(joined.ends.T)), shape=shape))
    found = []
    places = _narrow_places(surface, across=across, spacing=SPACING * longest)
    for begin in range(0, len(places), SOURCES):
        sources = places[begin : begin + SOURCES]
        distances, befores = dijkstra(
            ways, directed=False, indices=sources, limit=longest / 2.0, return_predecessors=True
        )
        for source, distance, before in zip(sources, distances, befores, strict=True):
            loop = _loop_through(int(source), distance, before, joined, lengths, words, numbers, longest=longest)
            if loop is not None:
                found.append(loop)
    return sorted(found, key=lambda loop: loop.length)


def _narrow_places(surface: TriangleMesh, *, across: float, spacing: float) -> Indices:
    """Return points where there is no more than `across`, mm, of body or of hole, one for each small cube of space."""
    normals = vertex_normals(surface.points, surface.triangles)
    reach = np.full(len(surface.points), np.inf)
    for way in (normals, -normals):
        hits = first_hits(surface.points, surface.triangles, surface.points + START * way, way)
        reach = np.minimum(reach, hits.distance)
    narrow = np.flatnonzero(reach <= across)
    cubes = np.floor(surface.points[narrow] / spacing).astype(np.int64)
    return narrow[np.unique(cubes, axis=0, return_index=True)[1]]


def _loop_through(
    source: int,
    distance: Floats,
    before: Indices,
    joined: Edges,
    lengths: Floats,
    words: Words,
    numbers: csr_array,
    *,
    longest: float,
) -> _Loop | None:
    """Return the shortest loop through a point that does not part the surface, if it is short enough."""
    first, second = joined.ends.T
    closing = np.flatnonzero(np.isfinite(distance[first]) & np.isfinite(distance[second]))
    first, second = first[closing], second[closing]
    whole = distance[first] + distance[second] + lengths[closing]
    tree = (before[first] == second) | (before[second] == first)
    kept = ~tree & (whole <= longest)
    closing, first, second, whole = closing[kept], first[kept], second[kept], whole[kept]
    if not len(closing):
        return None
    word = words[closing] ^ _path_words(first, before, source, words, numbers) ^ _path_words(
        second, before, source, words, numbers
    )
    around = np.flatnonzero(word.any(axis=1))
    if not len(around):
        return None
    best = around[whole[around].argmin()]
    there, back = (_path(int(end[best]), before, source) for end in (first, second))
    while len(there) > 1 and len(back) > 1 and there[-2] == back[-2]:
        there, back = there[:-1], back[:-1]
    return _Loop(float(whole[best]), np.array(there + back[-2::-1]), word[best].tobytes())


def _path(point: int, before: Indices, source: int) -> list[int]:
    path = [point]
    while path[-1] != source:
        path.append(int(before[path[-1]]))
    return path


def _path_words(ends: Indices, before: Indices, source: int, words: Words, numbers: csr_array) -> Words:
    """Return the words of the ways from some points to the source, (k, w) uint64."""
    sums = np.zeros((len(ends), words.shape[1]), dtype=np.uint64)
    here = ends
    while True:
        on_way = np.flatnonzero(here != source)
        if not len(on_way):
            return sums
        ahead = before[here[on_way]]
        low, high = np.minimum(here[on_way], ahead), np.maximum(here[on_way], ahead)
        sums[on_way] ^= words[np.asarray(numbers[low, high]).ravel() - 1]
        here = here.copy()
        here[on_way] = ahead


def _parted(surface: TriangleMesh, loops: list[_Loop], *, smallest: float, apart: float) -> TriangleMesh:
    """Return the surface cut along loops, and covered with lids, without the pieces between cuts round one handle."""
    pieces = _pieces(_cut(surface, _disjoint(loops, most=len(loops)), apart=apart))
    large = [piece for piece in pieces if piece.area >= smallest]
    if len(large) == 1:
        return large[0]
    pieces = _pieces(_cut(surface, _disjoint(loops, most=1), apart=apart))
    return max(pieces, key=lambda piece: piece.area)


def _disjoint(loops: list[_Loop], *, most: int) -> list[_Loop]:
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


def _cut(surface: TriangleMesh, loops: list[_Loop], *, apart: float) -> TriangleMesh:
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
    opened, rims = fan.reshape(-1, 3), np.stack([fan[_next(rims)], fan[rims]], axis=1)
    return _covered(_drawn_back(points, opened, rims, by=apart), opened, rims)


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
    centres = np.stack([np.bincount(label, values) for values in points[used].T], axis=1)
    centres /= np.bincount(label, minlength=number)[:, None]
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
