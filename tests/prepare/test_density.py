"""The finest tile: its neck is what prints, and the sentence names what bound it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fabricate.errors import PrepareError
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.mesh.torus import torus
from fabricate.prepare.density import FEWEST_TILES, check_room, finest_tile, neck_share, too_fine
from fabricate.process import PROCESSES

arcs = st.floats(0.3, 0.7)
lengths = st.floats(0.1, 3)


def arcs_apart(arc: float) -> tuple[float, float]:
    """Return the smallest distances between the two quarter circles of a unit tile, for both ways to join it."""
    angle = np.linspace(0, np.pi / 2, 2001)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    widths = []
    for radius in (arc, 1 - arc):
        near, far = radius * circle, 1 - radius * circle
        widths.append(min(np.linalg.norm(near - point, axis=1).min() for point in far[::20]))
    return widths[0], widths[1]


@pytest.mark.parametrize("arc", [0.32, 0.45, 0.5, 0.61])
def test_a_neck_is_the_smaller_distance_between_arcs(arc: float) -> None:
    assert neck_share((arc,)) == pytest.approx(min(arcs_apart(arc)), abs=1e-5)


@pytest.mark.parametrize(
    ("rings", "share"), [((0.4, 0.6), 0.2), ((0.37, 0.46, 0.63), 0.09), ((0.35, 0.6), 2**0.5 - 1.3)]
)
def test_several_rings_have_the_narrowest_of_necks_and_bands(rings: tuple[float, ...], share: float) -> None:
    assert neck_share(rings) == pytest.approx(share)


@pytest.mark.parametrize(
    ("rings", "words"),
    [
        ((0.3,), "the necks of yellow"),
        ((0.4, 0.7), "the necks of blue"),
        ((0.4, 0.42, 0.6), r"band-1, 0\.02 of a tile of about 7 mm, where it has to be more than 0\.0306"),
    ],
)
def test_tiles_in_which_the_clearance_leaves_nothing_are_refused(rings: tuple[float, ...], words: str) -> None:
    with pytest.raises(PrepareError, match=words):
        check_room(rings, tile_size=7.0, clearance=0.3)
    check_room(rings, tile_size=30.0, clearance=0.3)
    check_room(rings, tile_size=7.0, clearance=0.05)


def test_rings_that_do_not_increase_leave_no_band() -> None:
    with pytest.raises(PrepareError, match="must increase"):
        neck_share((0.5, 0.5))


@given(lengths, st.floats(0, 2), arcs)
def test_a_tile_without_margin_has_just_the_neck(feature: float, clearance: float, arc: float) -> None:
    made = finest_tile(feature, clearance, extent=1e6, rings=(arc,), margin=1.0)
    assert made.tile_size * neck_share((arc,)) - clearance == pytest.approx(feature)


@given(lengths, lengths, arcs)
def test_both_colours_count_the_same(feature: float, clearance: float, arc: float) -> None:
    there, back = (finest_tile(feature, clearance, extent=1e6, rings=(position,)) for position in (arc, 1 - arc))
    assert there.tile_size == pytest.approx(back.tile_size)
    assert there.tile_size >= finest_tile(feature, clearance, extent=1e6).tile_size * (1 - 1e-12)


def test_filament_needs_tiles_of_three_and_a_half_millimetres() -> None:
    assert finest_tile(1.2, 0.3, extent=100.0, margin=1.0).tile_size == pytest.approx(3.62, abs=0.01)


def test_the_limit_is_named() -> None:
    fdm = PROCESSES["fdm"]
    assert "smallest feature" in finest_tile(fdm.feature_min, 0.3, extent=120.0).limit
    assert "because of the clearance" in finest_tile(0.5, 0.8, extent=120.0).limit
    small = finest_tile(fdm.feature_min, 0.4, extent=10.0)
    assert small.tile_size == 10.0 / FEWEST_TILES
    assert "of the body's 10 mm" in small.limit


@pytest.mark.parametrize("arc", [0.0, 0.29, 0.71, 1.0, float("nan")])
def test_arcs_that_meet_leave_no_neck(arc: float) -> None:
    with pytest.raises(PrepareError, match=r"between 0\.293 and 0\.707"):
        finest_tile(0.8, 0.3, extent=100.0, rings=(arc,))


@pytest.mark.parametrize(("feature", "clearance", "extent"), [(0, 0.3, 100), (0.8, -0.1, 100), (0.8, 0.3, 0)])
def test_lengths_must_make_sense(feature: float, clearance: float, extent: float) -> None:
    with pytest.raises(PrepareError, match="positive feature, extent and margin"):
        finest_tile(feature, clearance, extent=extent)


@pytest.mark.parametrize(("tile_size", "verdict"), [(2.0, False), (20.0, True)])
def test_cells_are_too_fine_for_much_larger_tiles_only(tile_size: float, *, verdict: bool) -> None:
    assert too_fine(geodesic_sphere(frequency=8), size=60.0, tile_size=tile_size) == verdict


def test_quads_that_somebody_laid_out_are_kept() -> None:
    assert not too_fine(torus(around=64, across=32, tube=0.45), size=60.0, tile_size=20.0)
