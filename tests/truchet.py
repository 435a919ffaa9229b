"""The pattern, slow and obvious: curves walked tile by tile, graphs of diagonals, states of tiles."""

from __future__ import annotations

import networkx as nx
import numpy as np
from hypothesis import strategies as st
from polyhedra import quad_meshes, seeds

from fabricate.duotone.curve import count_curves
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.duotone.tile_locks import TileLocks

Place = tuple[float, ...]
Gate = frozenset[Place]
"""Where the curve crosses a tile side, named by the coordinates of the side's two ends."""


def gates(quads: QuadMesh) -> list[list[Gate]]:
    """Return the gates of the four sides of each tile."""
    places = [[tuple(place) for place in tile] for tile in quads.points[quads.tiles].tolist()]
    return [[frozenset((tile[k], tile[(k + 1) % 4])) for k in range(4)] for tile in places]


def naive_curves(duotone: Duotone) -> list[list[Gate]]:
    """Return the gates along each closed curve, walking from tile to tile with yellow on the left."""
    ahead: dict[Gate, Gate] = {}
    for sides, joined in zip(gates(duotone.quads), duotone.joined.tolist(), strict=True):
        for enters, leaves in ((0, 1), (2, 3)) if joined else ((0, 3), (2, 1)):
            assert sides[enters] not in ahead
            ahead[sides[enters]] = sides[leaves]
    curves = []
    while ahead:
        curve = [next(iter(ahead))]
        while (beyond := ahead.pop(curve[-1])) != curve[0]:
            curve.append(beyond)
        curves.append(curve)
    return curves


def diagonals(quads: QuadMesh, *, first: int) -> nx.MultiGraph:
    """Return the graph of the diagonals from corner `first` (0: yellow, 1: blue), keyed by tile."""
    graph = nx.MultiGraph()
    colour = quads.yellow if first == 0 else ~quads.yellow
    graph.add_nodes_from(np.flatnonzero(colour).tolist())
    for tile, corners in enumerate(quads.tiles.tolist()):
        graph.add_edge(corners[first], corners[first + 2], key=tile)
    return graph


def joined_graph(duotone: Duotone, *, first: int) -> nx.MultiGraph:
    """Return the graph of one colour's points and of the tiles joined in that colour."""
    graph = diagonals(duotone.quads, first=first)
    mine = duotone.joined if first == 0 else ~duotone.joined
    graph.remove_edges_from([edge for edge in graph.edges(keys=True) if not mine[edge[2]]])
    return graph


@st.composite
def any_states(draw: st.DrawFn) -> Duotone:
    """Draw tiles in states that follow no rule: as a rule, many curves."""
    quads, rng = draw(quad_meshes()), np.random.default_rng(draw(seeds))
    return Duotone(quads, rng.random(len(quads.tiles)) < draw(st.floats(0, 1)))


@st.composite
def quasi_trees(draw: st.DrawFn) -> Duotone:
    """Draw tiles that form one curve but need not be a tree: pairs are flipped as long as it stays one."""
    duotone = random_duotone(draw(quad_meshes()), seed=draw(seeds))
    rng = np.random.default_rng(draw(seeds))
    for _ in range(draw(st.integers(0, 40))):
        joined = duotone.joined.copy()
        joined[rng.choice(len(joined), size=2, replace=False)] ^= True
        flipped = Duotone(duotone.quads, joined)
        duotone = flipped if count_curves(flipped) == 1 else duotone
    return duotone


def locks_of_some_tree(quads: QuadMesh, seed: int) -> TileLocks:
    """Lock about a third of the tiles as some tree joins them, so that there is one that keeps to the locks."""
    joined = random_duotone(quads, seed=seed).joined
    held = np.random.default_rng(seed).random(len(joined)) < 0.35
    return TileLocks(joined & held, ~joined & held)
