"""Facts measured of a surface, against counts and formulas known beforehand."""

from __future__ import annotations

import numpy as np
import pytest

from fabricate.checks.measured import expectations, expected_genus, mesh_facts, pattern_facts
from fabricate.design.designed import Design
from fabricate.duotone.certificate import certified
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.duotone.tile_locks import TileLocks
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.torus import torus
from fabricate.prepare.prepared import Prepared
from fabricate.prepare.repaired import Action
from fabricate.prepare.triangle_mesh import TriangleMesh
from fabricate.process import PROCESSES
from fabricate.solid.assembly import Core
from fabricate.solid.settling import fitted_cut
from fabricate.solid.solids import solids
from fabricate.surface.cut import CutSurface
from fabricate.surface.cut_certificate import cut_certificate
from fabricate.surface.neck import tile_necks
from fabricate.surface.sizing import sized, tiled
from fabricate.surface.tiling import Tiling


@pytest.fixture(scope="module")
def mesh() -> PolygonMesh:
    return sized(torus(around=8, across=4, tube=0.45), size=60)


@pytest.fixture(scope="module")
def duotone(mesh: PolygonMesh) -> Duotone:
    return grown_duotone(tiled(mesh, tile_size=12), tree="random", seed=3)


@pytest.fixture(scope="module")
def surface(duotone: Duotone) -> CutSurface:
    return fitted_cut(duotone, tolerance=0.3, clearance=0.3)


def test_a_torus_has_the_counts_of_a_torus(mesh: PolygonMesh, duotone: Duotone, surface: CutSurface) -> None:
    body = Prepared(mesh, (Action("faces flipped", 2),), ("a note",))
    facts = mesh_facts(body, Tiling(duotone.quads, None, ("another",)), surface)
    assert (dict(facts.repairs), facts.notes) == ({"faces flipped": 2}, ("a note", "another"))
    assert facts.distance_mm is None
    assert (facts.vertices, facts.faces, facts.genus) == (32, 32, 1)
    assert max(facts.size_mm) == pytest.approx(60, rel=0.01)
    assert facts.size_mm[2] == pytest.approx(60 * 0.45 / 1.45, rel=0.1)


def test_a_shifted_surface_is_as_far_away_as_the_shift(
    mesh: PolygonMesh, duotone: Duotone, surface: CutSurface
) -> None:
    shifted = TriangleMesh(surface.points + np.array([0.0, 0.0, 0.5]), surface.triangles)
    facts = mesh_facts(Prepared(mesh, (), ()), Tiling(duotone.quads, shifted, ()), surface)
    assert facts.distance_mm is not None
    assert 0.1 < facts.distance_mm.mean < facts.distance_mm.max <= 0.5 + 1e-9


def test_a_pattern_is_counted_and_measured(duotone: Duotone, surface: CutSurface) -> None:
    facts = pattern_facts(Design(duotone), certified(duotone), surface)
    assert (facts.tiles, facts.curves, facts.regions) == (128, 1, 2)
    assert sum(facts.handles.values()) == 1
    assert sum(facts.area_share.values()) == pytest.approx(1)
    assert facts.area_share["yellow"] == pytest.approx(0.5, abs=0.05)
    assert facts.arc == 0.5
    assert facts.neck_mm.min <= facts.neck_mm.median < facts.tile_size_mm


def test_what_the_design_found_is_told(duotone: Duotone, surface: CutSurface) -> None:
    plain = pattern_facts(Design(duotone), certified(duotone), surface)
    assert (plain.alignment, plain.locked) == (None, None)
    yellow = np.arange(len(duotone.joined)) < 3
    design = Design(duotone, locks=TileLocks(yellow, ~yellow), alignment=0.75)
    facts = pattern_facts(design, certified(duotone), surface)
    assert (facts.alignment, facts.locked) == (0.75, {"yellow": 3, "blue": len(duotone.joined) - 3})


def test_the_curve_is_two_quarter_circles_per_tile(duotone: Duotone, surface: CutSurface) -> None:
    """On square tiles of side s that is s pi / 2; tiles here are not quite square."""
    facts = pattern_facts(Design(duotone), certified(duotone), surface)
    assert facts.curve_length_mm == pytest.approx(facts.tiles * facts.tile_size_mm * np.pi / 2, rel=0.25)


def test_a_wider_arc_position_gives_yellow_more(duotone: Duotone) -> None:
    share = [
        pattern_facts(Design(duotone), certified(duotone), fitted_cut(duotone, rings=(arc,), tolerance=0.3)).area_share[
            "yellow"
        ]
        for arc in (0.4, 0.5, 0.6)
    ]
    assert np.diff(share) == pytest.approx([np.pi / 20, np.pi / 20], rel=0.3)


@pytest.mark.parametrize(("core", "genus"), [("hollow", (2, 4)), ("yellow", (3, 4)), ("blue", (2, 3))])
def test_solids_have_the_handles_of_both_of_their_sides(core: Core, genus: tuple[int, int]) -> None:
    assert expected_genus({"yellow": 1, "blue": 2}, core=core) == {"yellow": genus[0], "blue": genus[1]}
    with_band = expected_genus({"yellow": 1, "band-1": 0, "blue": 2}, core=core)
    assert with_band == {"yellow": genus[0], "band-1": 1, "blue": genus[1]}


def test_a_multitone_is_counted_and_measured_by_the_names_of_its_regions(duotone: Duotone) -> None:
    surface = fitted_cut(duotone, rings=(0.4, 0.48, 0.6), tolerance=0.3)
    certificate = cut_certificate(surface)
    facts = pattern_facts(Design(duotone), certificate, surface)
    names = ["yellow", "band-1", "band-2", "blue"]
    assert (facts.curves, facts.regions) == (3, 4)
    assert list(facts.area_share) == list(facts.handles) == names
    assert sum(facts.area_share.values()) == pytest.approx(1)
    assert list(facts.band_mm) == ["band-1", "band-2"]
    assert facts.band_mm["band-1"].median == pytest.approx(0.08 * facts.tile_size_mm, rel=0.2)
    made = solids(surface, thickness=2.0, clearance=0.0)
    band = expectations(surface, made, certificate, clearance=0.0, core="hollow").band
    assert band is not None
    assert (band.name, band.width) == ("band-1", facts.band_mm["band-1"].min)
    assert band.spacing == pytest.approx(0.08)


def test_expectations_say_what_was_asked_and_made(duotone: Duotone, surface: CutSurface) -> None:
    made, process = solids(surface, thickness=2.0, clearance=0.3), PROCESSES["fdm"]
    found = expectations(surface, made, certified(duotone), clearance=0.3, core="hollow", process=process)
    necks, places = tile_necks(surface)
    assert found.clearance == 0.3
    assert found.process == process
    assert sum(found.genus.values()) == 2
    assert found.neck is not None
    assert found.neck.width == necks.min()
    assert found.neck.at == tuple(places[necks.argmin()])
    assert found.band is None
    assert found.spaces is not None
    assert 0.0 < found.spaces.gap < 0.1 * found.spaces.shell
