"""Area shares: what is asked for is met on whatever surface is made, and what is out of reach is said exactly."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

from fabricate.design.area_share import WITHIN, shared_cut, square_arc, yellow_share
from fabricate.duotone.duotone import Duotone
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.errors import PatternError
from fabricate.mesh.sphere import geodesic_sphere
from fabricate.solid.settling import fitted_cut, has_room
from fabricate.surface.cut import CutSurface, cut
from fabricate.surface.limit import LimitSurface
from fabricate.surface.sizing import sized, tiled

Make = Callable[[tuple[float]], CutSurface]


@pytest.fixture(scope="module")
def duotone() -> Duotone:
    return grown_duotone(tiled(sized(geodesic_sphere(frequency=1), size=40), tile_size=7), tree="random", seed=2)


@pytest.fixture(scope="module")
def make(duotone: Duotone) -> Make:
    return lambda rings: fitted_cut(duotone, rings=rings, tolerance=0.2, clearance=0.3)


def always(_: CutSurface) -> bool:
    return True


def test_the_share_is_that_of_triangles_counted_one_by_one(make: Make) -> None:
    surface = make((0.45,))
    area = {True: 0.0, False: 0.0}
    for corners, yellow in zip(surface.points[surface.triangles], surface.regions == 0, strict=True):
        area[bool(yellow)] += 0.5 * float(np.linalg.norm(np.cross(corners[1] - corners[0], corners[2] - corners[0])))
    assert yellow_share(surface) == pytest.approx(area[True] / sum(area.values()))


def test_the_share_grows_with_the_arc_position(duotone: Duotone) -> None:
    limit = LimitSurface.of(duotone.quads)
    shares = [yellow_share(cut(duotone, limit, rings=(arc,), resolution=4)) for arc in np.linspace(0.295, 0.705, 12)]
    assert (np.diff(shares) > 0.0).all()


@pytest.mark.parametrize("share", [0.3, 0.5, 0.6, 0.7])
def test_a_share_in_reach_is_met_on_the_finished_surface(duotone: Duotone, make: Make, share: float) -> None:
    found = shared_cut(duotone, share=share, make=make, fits=always)
    assert yellow_share(found) == pytest.approx(share, abs=WITHIN)
    assert found.rings[0] == pytest.approx(square_arc(share), abs=0.03)


def test_what_making_the_surface_changes_is_made_up_for(duotone: Duotone, make: Make) -> None:
    found = shared_cut(duotone, share=0.6, make=lambda rings: make((rings[0] - 0.02,)), fits=always)
    assert yellow_share(found) == pytest.approx(0.6, abs=WITHIN)
    straight = shared_cut(duotone, share=0.6, make=make, fits=always)
    assert found.rings[0] == pytest.approx(straight.rings[0], abs=1e-3)


def test_of_surfaces_that_do_not_follow_the_nearest_is_kept(duotone: Duotone, make: Make) -> None:
    made: list[CutSurface] = []

    def stubborn(_: tuple[float]) -> CutSurface:
        made.append(make((0.51 if len(made) == 1 else 0.5,)))
        return made[-1]

    found = shared_cut(duotone, share=0.6, make=stubborn, fits=always)
    assert found is made[1]
    assert 2 < len(made) < 10


def interval(message: str) -> tuple[float, float]:
    found = re.search(r"yellow can have (\S+) to (\S+),", message)
    assert found is not None, message
    return float(found[1]), float(found[2])


@pytest.mark.parametrize("share", [0.02, 0.98])
def test_a_share_out_of_reach_says_what_is_in_reach(duotone: Duotone, make: Make, share: float) -> None:
    fits = partial(has_room, clearance=0.6)
    with pytest.raises(PatternError, match="out of reach") as caught:
        shared_cut(duotone, share=share, make=make, fits=fits)
    low, high = interval(str(caught.value))
    assert 0.15 < low < 0.4 < 0.6 < high < 0.85
    for end in (low, high):
        assert yellow_share(shared_cut(duotone, share=end, make=make, fits=fits)) == pytest.approx(end, abs=WITHIN)
    for beyond in (low - 0.03, high + 0.03):
        with pytest.raises(PatternError, match="out of reach"):
            shared_cut(duotone, share=beyond, make=make, fits=fits)


def test_without_any_room_the_clearance_is_to_blame(duotone: Duotone, make: Make) -> None:
    with pytest.raises(PatternError, match=r"solid\.clearance"):
        shared_cut(duotone, share=0.6, make=make, fits=partial(has_room, clearance=10.0))


def test_the_first_guess_is_exact_on_square_tiles() -> None:
    assert square_arc(0.5) == 0.5
    for share in np.linspace(0.25, 0.75, 5):
        r = square_arc(float(share))
        blue_corners, yellow_corners = 2 * np.pi * (1 - r) ** 2 / 4, 2 * np.pi * r**2 / 4
        assert 0.5 * (1 - blue_corners) + 0.5 * yellow_corners == pytest.approx(share)


def test_the_first_guess_leaves_necks() -> None:
    assert 0.293 < square_arc(0.01) < square_arc(0.99) < 0.707
