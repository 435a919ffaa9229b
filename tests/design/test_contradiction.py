"""Rings and cuts are found where there are any, and are what they are said to be."""

from __future__ import annotations

import networkx as nx
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from polyhedra import quad_meshes, seeds
from truchet import diagonals, locks_of_some_tree

from fabricate.design.contradiction import blue_cut, yellow_ring
from fabricate.duotone.quad_mesh import QuadMesh

MESHES = quad_meshes()


def some_tiles(quads: QuadMesh, seed: int, share: float) -> np.ndarray:
    return np.random.default_rng(seed).random(len(quads.tiles)) < share


def graph_of(quads: QuadMesh, tiles: np.ndarray) -> nx.MultiGraph:
    whole = diagonals(quads, first=0)
    whole.remove_edges_from([edge for edge in whole.edges(keys=True) if not tiles[edge[2]]])
    return whole


@given(quads=MESHES, seed=seeds, share=st.floats(0, 1))
def test_a_ring_is_found_if_there_is_one(quads: QuadMesh, seed: int, share: float) -> None:
    yellow = some_tiles(quads, seed, share)
    ring = yellow_ring(quads, yellow)
    if not len(ring):
        assert nx.is_forest(graph_of(quads, yellow)) or not yellow.any()
        return
    assert yellow[ring].all()
    assert len(set(ring.tolist())) == len(ring)
    only = np.zeros_like(yellow)
    only[ring] = True
    valences = dict(graph_of(quads, only).degree)
    assert {valence for valence in valences.values() if valence} == {2}
    assert not len(yellow_ring(quads, only & (np.arange(len(only)) != ring[0])))


@given(quads=MESHES, seed=seeds, share=st.floats(0, 1))
def test_a_cut_is_found_if_there_is_one(quads: QuadMesh, seed: int, share: float) -> None:
    blue = some_tiles(quads, seed, share)
    cut = blue_cut(quads, blue)
    if not len(cut):
        assert nx.is_connected(graph_of(quads, ~blue))
        return
    assert blue[cut].all()
    only = np.zeros_like(blue)
    only[cut] = True
    assert not nx.is_connected(graph_of(quads, ~only))


@given(quads=MESHES, seed=seeds)
def test_what_a_tree_joins_contradicts_nothing(quads: QuadMesh, seed: int) -> None:
    locks = locks_of_some_tree(quads, seed)
    assert not len(yellow_ring(quads, locks.yellow))
    assert not len(blue_cut(quads, locks.blue))
