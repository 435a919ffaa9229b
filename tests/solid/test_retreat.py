"""The retreat: paths end right under the outer surface, where nothing crosses and the gap as wide as outside."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from small_ring import CLEARANCE, ring_surface

from fabricate.arrays import Mask
from fabricate.solid.assembly import Assembly, Core, assembly, core_region
from fabricate.solid.faults import crossing_points, near_points
from fabricate.solid.joint import STRAIGHT, Joint
from fabricate.solid.retreat import LAST, RINGS, SAFE_DEPTH, Retreat, receded, stepping
from fabricate.solid.spacing import outer_copies
from fabricate.surface.cut import CutSurface
from fabricate.triangles.adjacency import grown, neighbour_means
from fabricate.triangles.search_tree import SearchTree

THICKNESS = 2.0
CORES: tuple[Core, ...] = ("hollow", "yellow", "blue")


@pytest.fixture(scope="module")
def surface() -> CutSurface:
    return ring_surface()


def retreat_of(
    surface: CutSurface,
    *,
    depth: float = THICKNESS,
    core: Core = "hollow",
    seed: int = 0,
    joint: Joint = STRAIGHT,
) -> Retreat:
    """Return the retreat from inner points that are `depth` deep, with noise of half of that if there is a seed."""
    noise = np.random.default_rng(seed).uniform(-0.5, 0.5, surface.points.shape) if seed else 0.0
    inner = surface.points + depth * (noise - surface.normals)
    made = assembly(surface, inner, clearance=CLEARANCE, core=core, joint=joint)
    copies, keeper = outer_copies(surface, clearance=CLEARANCE), core_region(core, regions=len(made.bodies))
    return Retreat.of(surface, made, copies, thickness=THICKNESS, keeper=keeper)


def everywhere(made: Assembly) -> Mask:
    return np.ones(made.surface_points, dtype=bool)


def faults(made: Assembly, moved: Mask) -> Mask:
    crossing = crossing_points(made, clearance=CLEARANCE, moved=moved)
    return crossing | near_points(made, clearance=CLEARANCE, moved=moved)


@pytest.mark.parametrize("core", CORES)
def test_without_a_step_everything_is_where_it_was(surface: CutSurface, core: Core) -> None:
    retreat = retreat_of(surface, core=core)
    after = retreat.after(np.zeros(len(surface.points)))
    assert after.points == pytest.approx(retreat.proposed.points, abs=1e-5)


@pytest.mark.parametrize("steps", [0, 3, 6, LAST])
@pytest.mark.parametrize("core", CORES)
def test_ridges_go_back_with_their_walls(surface: CutSurface, core: Core, steps: int) -> None:
    """They stay between the outer and the inner edge of their wall, in order, and nothing crosses."""
    tongue = Joint(kind="tongue", height=0.45, width=1.2)
    retreat = retreat_of(surface, core=core, joint=tongue)
    made = retreat.after(np.full(len(surface.points), float(steps)))
    assert not crossing_points(made, clearance=CLEARANCE, moved=everywhere(made)).any()
    walls = made.walls(surface.curves[0], 0)
    down = walls[:, -1:] - walls[:, :1]
    share = ((walls - walls[:, :1]) * down).sum(axis=-1) / np.maximum((down**2).sum(axis=-1), 1e-12)
    assert walls.shape[1] == 7
    assert (np.diff(share, axis=1) > -0.05).all()


@pytest.mark.parametrize("steps", [6, LAST])
def test_at_the_end_of_the_paths_nothing_is_faulty_wherever_they_began(surface: CutSurface, steps: int) -> None:
    """Even with inner points anywhere; a wall is then hardly thicker than nothing."""
    retreat = retreat_of(surface, seed=1)
    assert faults(retreat.proposed, everywhere(retreat.proposed)).mean() > 0.3
    made = retreat.after(np.full(len(surface.points), float(steps)))
    assert not faults(made, everywhere(made)).any()
    depth = SearchTree.of(surface.points, surface.triangles).nearest(made.points).distance
    assert depth.max() <= SAFE_DEPTH * THICKNESS + 1e-5 + np.ptp(surface.points) * 1e-3


@pytest.mark.parametrize("core", CORES)
def test_everything_is_cured_and_what_is_well_stays(surface: CutSurface, core: Core) -> None:
    """One inner point pokes out of the body; where nothing was wrong nothing moves, and walls stay thick."""
    retreat = retreat_of(surface, core=core)
    means = neighbour_means(surface.triangles, count=len(surface.points))
    inlaid = surface.triangles[surface.regions == (1 if core == "yellow" else 0)]
    number = int(inlaid[40, 0])
    points = retreat.proposed.points.copy()
    for block in range(1, 6, 2):
        points[block * len(surface.points) + number] += (THICKNESS + 1.0) * surface.normals[number]
    poking = assembly_with(retreat, points)
    faulty = faults(poking.proposed, everywhere(poking.proposed))
    assert faulty.any()
    made = receded(poking, faults, means, faulty=faulty)
    assert not faults(made, everywhere(made)).any()
    far = ~grown(np.isin(np.arange(len(surface.points)), [number]), means, 2 * RINGS + 4)
    blocks = [points.reshape(-1, len(surface.points), 3)[1:6:2, far] for points in (made.points, points)]
    assert blocks[0] == pytest.approx(blocks[1], abs=1e-5)


def test_far_from_the_origin_safe_places_are_no_nearer_than_numbers_can_tell(surface: CutSurface) -> None:
    far = replace(surface, points=surface.points + 12_000.0, base=surface.base + 12_000.0)
    retreat = retreat_of(far)
    made = retreat.after(np.full(len(far.points), float(LAST)))
    for part in made.parts:
        assert len(np.unique(part.points, axis=0)) == len(part.points)


def assembly_with(retreat: Retreat, points: np.ndarray) -> Retreat:
    made = retreat.proposed
    return replace(retreat, proposed=replace(made, points=points))


def test_what_no_path_cures_is_left_after_a_bounded_number_of_rounds(surface: CutSurface) -> None:
    retreat = retreat_of(surface)
    means = neighbour_means(surface.triangles, count=len(surface.points))
    asked = []
    faulty = np.isin(np.arange(len(surface.points)), [7])

    def hopeless(_made: Assembly, moved: Mask) -> Mask:
        asked.append(int(moved.sum()))
        return faulty

    receded(retreat, hopeless, means, faulty=faulty)
    assert len(asked) == LAST
    assert max(asked) < 200


def test_faulty_points_and_their_neighbours_take_a_whole_step(surface: CutSurface) -> None:
    means = neighbour_means(surface.triangles, count=len(surface.points))
    faulty = np.isin(np.arange(len(surface.points)), [7])
    weight = stepping(faulty, means)
    assert (weight[grown(faulty, means, 1)] == 1.0).all()
    assert (weight[~grown(faulty, means, 1 + RINGS)] == 0.0).all()
    assert ((weight > 0.0) & (weight < 1.0)).any()


@pytest.mark.parametrize("core", ["yellow", "blue"])
def test_a_floor_goes_back_with_what_is_over_it(surface: CutSurface, core: Core) -> None:
    retreat = retreat_of(surface, core=core)
    made = retreat.after(np.full(len(surface.points), 6.0))
    count, keeper = len(surface.points), core_region(core, regions=2)
    assert keeper is not None
    inlaid = np.unique(surface.triangles[surface.regions != keeper])
    floor, ceiling = made.points[-count:], made.points[(2 * keeper + 1) * count :][:count]
    apart = np.linalg.norm(floor - ceiling, axis=1)[inlaid]
    assert apart.min() >= 0.99 * CLEARANCE
    assert np.median(apart) < 1.5 * CLEARANCE
