"""The finish: nothing changes unless asked for, and what changes adds up."""

from __future__ import annotations

import pytest
from crafted import Crafted, crafted

from fabricate.mesh.torus import torus
from fabricate.solid.booleans import Cylinder, bar, manifold_of
from fabricate.solid.finish import FinishWish, finished
from fabricate.solid.stand import stand_solid


@pytest.fixture(scope="module")
def ring() -> Crafted:
    return crafted(torus(around=8, across=4, tube=0.45), size=80, tile=12, clearance=0.3)


def test_without_a_wish_the_parts_are_those_that_were_made(ring: Crafted) -> None:
    ready = finished(ring.surface, ring.made, FinishWish(clearance=0.3, wall=0.8, tolerance=0.05))
    for one, other in zip(ready.parts, ring.made.parts, strict=True):
        assert one.points.tobytes() == other.points.tobytes()
        assert one.triangles.tobytes() == other.triangles.tobytes()
    assert (ready.openings, ready.stand) == ((), None)


def test_parts_and_gap_add_up_to_the_shell_with_openings_and_stand(ring: Crafted) -> None:
    wish = FinishWish(clearance=0.3, wall=0.8, tolerance=0.05, opening_diameter=3.5, opening_count=2, stand_height=3.0)
    ready = finished(ring.surface, ring.made, wish)
    gap, shell = ready.spaces
    assert ready.stand is not None
    assert len(ready.openings) == 2
    volumes = [manifold_of(part).volume() for part in (*ready.parts, gap)]
    assert sum(volumes) == pytest.approx(manifold_of(shell).volume(), rel=1e-3)
    assert manifold_of(shell).volume() > manifold_of(ring.made.spaces[1]).volume()


def test_openings_are_where_the_stand_leaves_the_way_out_free(ring: Crafted) -> None:
    wish = FinishWish(clearance=0.3, wall=0.8, tolerance=0.05, opening_diameter=3.5, opening_count=4, stand_height=3.0)
    ready = finished(ring.surface, ring.made, wish)
    assert ready.stand is not None
    stand = stand_solid(ready.stand, tolerance=0.05)
    for opening in ready.openings:
        out = Cylinder(opening.at, opening.at - opening.diameter * opening.way, 0.9 * opening.diameter / 2)
        assert (bar(out, tolerance=0.05) ^ stand).volume() == pytest.approx(0.0, abs=1e-9)
