from __future__ import annotations

from dataclasses import replace

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from polyhedra import HANDLES, named, polyhedra, quad_meshes, seeds
from truchet import any_states, joined_graph, naive_curves, quasi_trees

from fabricate.duotone.catmull_clark import subdivided
from fabricate.duotone.certificate import Certificate, RegionFacts, certified
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.quad_mesh import QuadMesh, two_coloured
from fabricate.duotone.spanning_tree import random_duotone
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.torus import torus
from fabricate.surface.cut import CutSurface, cut
from fabricate.surface.limit import LimitSurface

SEVERAL = [mesh for mesh, handles in HANDLES.values() if handles <= 3]


def assert_counts_of_the_graph(facts: RegionFacts, graph: nx.MultiGraph, curves: int) -> None:
    """Assert what holds of discs (the points) joined by bands (the tiles): chi is points less bands."""
    assert facts.components == nx.number_connected_components(graph)
    assert facts.euler_characteristic == graph.number_of_nodes() - graph.number_of_edges()
    assert facts.euler_characteristic == 2 * facts.components - 2 * facts.handles - curves


def measured(surface: CutSurface, *, yellow: bool) -> RegionFacts:
    """Count components and Euler characteristic on the triangles of one colour."""
    triangles = surface.triangles[(surface.regions == 0) == yellow].tolist()
    edges = nx.Graph([(t[k], t[k - 1]) for t in triangles for k in range(3)])
    components = nx.number_connected_components(edges)
    euler = edges.number_of_nodes() - edges.number_of_edges() + len(triangles)
    return RegionFacts(components, euler, (2 * components - 1 - euler) // 2)


@given(quads=quad_meshes(), seed=seeds)
def test_trees_are_proved_duotones_and_yellow_is_a_disc(quads: QuadMesh, seed: int) -> None:
    found = certified(random_duotone(quads, seed=seed))
    assert found.holds
    assert found.curves == 1
    assert found.yellow == RegionFacts(components=1, euler_characteristic=1, handles=0)
    assert found.blue == RegionFacts(components=1, euler_characteristic=1 - 2 * quads.genus, handles=quads.genus)


@pytest.mark.parametrize("name", HANDLES)
def test_handles_are_those_of_the_shape(name: str) -> None:
    mesh, handles = HANDLES[name]
    found = certified(random_duotone(subdivided(mesh, levels=2), seed=4))
    assert found.holds
    assert (found.genus, found.yellow.handles, found.blue.handles) == (handles, 0, handles)


@given(duotone=any_states())
def test_any_states_are_counted_as_discs_and_bands(duotone: Duotone) -> None:
    found = certified(duotone)
    assert found.curves == len(naive_curves(duotone))
    assert_counts_of_the_graph(found.yellow, joined_graph(duotone, first=0), found.curves)
    assert_counts_of_the_graph(found.blue, joined_graph(duotone, first=1), found.curves)
    whole = found.yellow.euler_characteristic + found.blue.euler_characteristic
    assert whole == 2 - 2 * duotone.quads.genus
    assert found.holds == (found.curves == 1)


@settings(max_examples=25)
@given(duotone=quasi_trees())
def test_counts_agree_with_the_triangles_of_the_cut(duotone: Duotone) -> None:
    found = certified(duotone)
    surface = cut(duotone, LimitSurface.of(duotone.quads), rings=(0.5,), resolution=2)
    assert found.yellow == measured(surface, yellow=True)
    assert found.blue == measured(surface, yellow=False)
    assert found.holds


def test_a_handle_can_move_from_blue_to_yellow() -> None:
    quads = two_coloured(torus(around=8, across=4, tube=0.4))
    found = set()
    for seed in range(40):
        rng = np.random.default_rng(seed)
        joined = random_duotone(quads, seed=seed).joined.copy()
        joined[rng.choice(np.flatnonzero(~joined), size=2, replace=False)] = True
        certificate = certified(Duotone(quads, joined))
        if certificate.holds:
            found.add((certificate.yellow.handles, certificate.blue.handles))
    assert found == {(1, 0)}


@given(mesh=polyhedra(), seed=seeds)
def test_one_tile_more_or_less_is_no_duotone(mesh: PolygonMesh, seed: int) -> None:
    tree = random_duotone(subdivided(mesh, levels=1), seed=seed)
    for tile in (int(np.argmax(tree.joined)), int(np.argmin(tree.joined))):
        joined = tree.joined.copy()
        joined[tile] ^= True
        found = certified(Duotone(tree.quads, joined))
        assert found.curves == 2
        assert not found.holds
        assert found.yellow.components + found.blue.components == 3


@pytest.mark.parametrize("name", named())
def test_a_curve_round_every_blue_point_is_no_duotone(name: str) -> None:
    quads = subdivided(named()[name], levels=1)
    everything = Duotone(quads, np.ones(len(quads.tiles), dtype=bool))
    found = certified(everything)
    assert not found.holds
    assert found.yellow.components == 1
    assert found.blue.components == found.curves == (~quads.yellow).sum()
    assert found.yellow.handles == quads.genus


DISC, REST = RegionFacts(1, 1, 0), RegionFacts(1, -1, 1)
GOOD = Certificate(1, (DISC, REST), 1)


@pytest.mark.parametrize(
    "wrong",
    [
        replace(GOOD, curves=2),
        replace(GOOD, curves=0),
        replace(GOOD, regions=(RegionFacts(2, 1, 0), REST)),
        replace(GOOD, regions=(DISC, RegionFacts(2, -1, 1))),
        replace(GOOD, regions=(DISC, RegionFacts(1, 1, 0))),
        replace(GOOD, genus=0),
        replace(GOOD, genus=2),
        replace(GOOD, regions=(DISC, RegionFacts(1, 0, 0), REST)),
    ],
)
def test_each_number_can_spoil_it(wrong: Certificate) -> None:
    assert GOOD.holds
    assert not wrong.holds


def test_a_multitone_has_a_curve_less_than_regions() -> None:
    assert Certificate(2, (DISC, RegionFacts(1, 0, 0), REST), 1).holds
