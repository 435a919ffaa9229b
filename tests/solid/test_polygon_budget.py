"""A budget of polygons: counts known before parts are made, and the finest division that keeps them."""

from __future__ import annotations

from functools import partial

import pytest

from fabricate.duotone.duotone import Duotone
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.errors import SolidError
from fabricate.mesh.torus import torus
from fabricate.solid.assembly import Core
from fabricate.solid.polygon_budget import affordable, largest_part
from fabricate.solid.settling import fitted_cut, settled
from fabricate.solid.solids import solids
from fabricate.surface.cut import CutSurface
from fabricate.surface.sizing import sized, tiled


@pytest.fixture(scope="module")
def duotone() -> Duotone:
    return grown_duotone(
        tiled(sized(torus(around=8, across=4, tube=0.45), size=60), tile_size=12), tree="random", seed=3
    )


def divided(duotone: Duotone, tolerance: float) -> CutSurface:
    return fitted_cut(duotone, tolerance=tolerance, clearance=0.3)


@pytest.mark.parametrize("core", ["hollow", "yellow", "blue"])
def test_triangles_are_counted_before_the_parts_are_made(duotone: Duotone, core: Core) -> None:
    surface = divided(duotone, 0.5)
    made = solids(surface, thickness=2.0, clearance=0.3, core=core)
    assert largest_part(surface, core=core) == max(len(part.triangles) for part in made.parts)


def test_bands_have_two_walls(duotone: Duotone) -> None:
    surface = fitted_cut(duotone, rings=(0.4, 0.6), tolerance=0.5, clearance=0.3)
    made = solids(surface, thickness=2.0, clearance=0.3)
    assert largest_part(surface, core="hollow") == max(len(part.triangles) for part in made.parts)


def test_without_a_budget_nothing_changes(duotone: Duotone) -> None:
    found = affordable(partial(divided, duotone), tolerance=0.2, core="hollow", budget=None)
    assert found.tolerance == 0.2
    assert len(found.surface.triangles) == len(divided(duotone, 0.2).triangles)


def test_the_surface_is_divided_more_coarsely_until_it_fits(duotone: Duotone) -> None:
    fine = largest_part(divided(duotone, 0.05), core="hollow")
    found = affordable(partial(divided, duotone), tolerance=0.05, core="hollow", budget=fine - 1)
    count = largest_part(found.surface, core="hollow")
    assert fine / 3 < count < fine
    assert found.tolerance > 0.05


@pytest.mark.parametrize("share", [0.8, 0.6, 0.4])
def test_no_finer_resolution_keeps_the_budget(duotone: Duotone, share: float) -> None:
    counts = [
        largest_part(settled(duotone, clearance=0.3, rings=(0.5,), resolution=resolution), core="hollow")
        for resolution in range(3, 13)
    ]
    budget = int(share * largest_part(divided(duotone, 0.05), core="hollow"))
    found = affordable(partial(divided, duotone), tolerance=0.05, core="hollow", budget=budget)
    assert largest_part(found.surface, core="hollow") == max(count for count in counts if count <= budget)


def test_what_never_fits_is_refused(duotone: Duotone) -> None:
    with pytest.raises(SolidError, match=r"however coarsely .* and the shop accepts 1000"):
        affordable(partial(divided, duotone), tolerance=0.5, core="hollow", budget=1000, limit="the shop accepts 1000")
