"""The yellow graph, and what locks leave of it."""

from __future__ import annotations

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from polyhedra import beads, quad_meshes, seeds
from truchet import diagonals, locks_of_some_tree

from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
from fabricate.duotone.tile_locks import TileLocks
from fabricate.duotone.yellow_graph import YellowGraph, components
from fabricate.errors import PatternError

MESHES = quad_meshes()


def multigraph(graph: YellowGraph) -> nx.MultiGraph:
    found = nx.MultiGraph()
    found.add_nodes_from(range(graph.nodes))
    found.add_edges_from((a, b, tile) for (a, b), tile in zip(graph.ends.tolist(), graph.tiles.tolist(), strict=True))
    return found


@given(quads=MESHES)
def test_every_tile_is_an_edge_between_its_yellow_corners(quads: QuadMesh) -> None:
    graph = YellowGraph.of(quads)
    assert (graph.tiles == np.arange(len(quads.tiles))).all()
    assert (graph.ends == np.sort(graph.node_of[quads.tiles[:, [0, 2]]], axis=1)).all()
    assert ((graph.node_of >= 0) == quads.yellow).all()
    assert np.unique(graph.node_of[quads.yellow]).tolist() == list(range(graph.nodes))


@given(quads=MESHES, seed=seeds)
def test_locks_contract_and_delete(quads: QuadMesh, seed: int) -> None:
    locks = locks_of_some_tree(quads, seed)
    whole = diagonals(quads, first=0)
    whole.remove_edges_from([edge for edge in whole.edges(keys=True) if locks.blue[edge[2]]])
    pieces = nx.Graph()
    pieces.add_nodes_from(whole)
    pieces.add_edges_from(edge[:2] for edge in whole.edges(keys=True) if locks.yellow[edge[2]])
    graph = YellowGraph.of(quads, locks)
    assert graph.nodes == nx.number_connected_components(pieces)
    for piece in nx.connected_components(pieces):
        assert len(set(graph.node_of[list(piece)].tolist())) == 1
    left = {
        tile for a, b, tile in whole.edges(keys=True) if not locks.yellow[tile] and graph.node_of[a] != graph.node_of[b]
    }
    assert set(graph.tiles.tolist()) == left
    assert nx.is_connected(multigraph(graph))


def test_parallel_tiles_stay_edges_of_their_own() -> None:
    quads = two_coloured(beads(3))
    graph = multigraph(YellowGraph.of(quads))
    assert graph.number_of_edges() == len(quads.tiles) > nx.Graph(graph).number_of_edges()


def test_a_ring_of_yellow_locks_is_refused() -> None:
    quads = two_coloured(beads(3))
    with pytest.raises(PatternError, match="locked yellow close a ring"):
        YellowGraph.of(quads, TileLocks(np.ones(len(quads.tiles), dtype=bool), np.zeros(len(quads.tiles), dtype=bool)))


def test_blue_locks_that_cut_yellow_apart_are_refused() -> None:
    quads = two_coloured(beads(3))
    with pytest.raises(PatternError, match="locked blue cut yellow apart"):
        YellowGraph.of(quads, TileLocks(np.zeros(len(quads.tiles), dtype=bool), np.ones(len(quads.tiles), dtype=bool)))


def test_components_are_those_of_the_edges() -> None:
    ends = np.array([[0, 1], [1, 0], [3, 3], [4, 2]])
    found = components(ends, 6)
    assert found[0] == found[1]
    assert found[2] == found[4]
    assert len(set(found.tolist())) == 4
