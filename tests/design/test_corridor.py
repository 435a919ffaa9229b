"""The longest corridor: the diameter of yellow's graph."""

from __future__ import annotations

import networkx as nx
from hypothesis import given, settings
from polyhedra import quad_meshes, seeds
from truchet import joined_graph, quasi_trees

from fabricate.design.corridor import CorridorCost, longest_corridor
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh
from fabricate.duotone.spanning_tree import random_duotone


@given(quads=quad_meshes(), seed=seeds)
def test_in_a_tree_it_is_the_longest_path(quads: QuadMesh, seed: int) -> None:
    duotone = random_duotone(quads, seed=seed)
    graph = nx.Graph(joined_graph(duotone, first=0))
    assert longest_corridor(duotone) == nx.diameter(graph)


@settings(max_examples=50)
@given(duotone=quasi_trees())
def test_with_handles_it_is_at_most_the_diameter_and_at_least_half_of_it(duotone: Duotone) -> None:
    diameter = nx.diameter(nx.Graph(joined_graph(duotone, first=0)))
    assert diameter / 2 <= longest_corridor(duotone) <= diameter


@given(duotone=quasi_trees())
def test_longer_corridors_cost_less(duotone: Duotone) -> None:
    assert CorridorCost(duotone.quads, step=0.5).of(duotone.joined) == -0.5 * longest_corridor(duotone)
