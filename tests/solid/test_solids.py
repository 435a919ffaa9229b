"""Solids: closed, oriented, of the right genus, free of crossings, apart by the clearance, and adding up."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

import igl
import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from manifold3d import Manifold, Mesh
from polyhedra import seeds

from fabricate.arrays import Mask
from fabricate.duotone.certificate import Certificate, certified
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.errors import SolidError
from fabricate.mesh.crease import creased
from fabricate.mesh.cube import cube
from fabricate.mesh.knot import trefoil
from fabricate.mesh.pierced import double_torus, genus_six, triple_torus
from fabricate.mesh.polygon_mesh import PolygonMesh
from fabricate.mesh.sphere import sphere
from fabricate.mesh.torus import torus
from fabricate.solid.assembly import Assembly, Core, assembly
from fabricate.solid.part import Part
from fabricate.solid.settling import fitted_cut
from fabricate.solid.solids import solids
from fabricate.solid.thick_enough import check_thick
from fabricate.surface.cut import CutSurface
from fabricate.surface.cut_certificate import cut_certificate
from fabricate.surface.sizing import sized, tiled
from fabricate.triangles.crossing import crossing_triangles

THICKNESS = 2.0


@dataclass(frozen=True)
class Body:
    mesh: PolygonMesh
    size: float
    genus: int


BODIES = {
    "torus": Body(torus(around=8, across=4, tube=0.45), 60, 1),
    "double torus": Body(double_torus(), 100, 2),
    "sphere": Body(sphere(faces="triangles", frequency=1), 50, 0),
    "cube": Body(cube(divisions=2), 50, 0),
}


@dataclass(frozen=True, eq=False)
class Made:
    surface: CutSurface
    certificate: Certificate
    solids: Assembly

    @property
    def manifolds(self) -> tuple[Manifold, ...]:
        return tuple(as_manifold(part) for part in self.solids.parts)


def cut_body(
    name: str, *, clearance: float, seed: int = 7, arc: float = 0.5, tolerance: float = 0.3
) -> tuple[CutSurface, Certificate]:
    body = BODIES[name]
    duotone = grown_duotone(tiled(sized(body.mesh, size=body.size), tile_size=12), tree="random", seed=seed)
    return fitted_cut(duotone, rings=(arc,), tolerance=tolerance, clearance=clearance), certified(duotone)


@pytest.fixture(scope="module")
def made() -> Callable[..., Made]:
    """Return what makes each pair once."""
    known: dict[tuple[str, float, Core], Made] = {}

    def make(name: str, clearance: float, core: Core = "hollow") -> Made:
        key = (name, clearance, core)
        if key not in known:
            surface, certificate = cut_body(name, clearance=clearance)
            known[key] = Made(
                surface, certificate, solids(surface, thickness=THICKNESS, clearance=clearance, core=core)
            )
        return known[key]

    return make


each_body = pytest.mark.parametrize("name", BODIES)
each_clearance = pytest.mark.parametrize("clearance", [0.2, 0.3, 0.5])


def as_manifold(part: Part) -> Manifold:
    return Manifold(Mesh(part.points.astype(np.float32), part.triangles.astype(np.uint32)))


def genus(part: Part) -> int:
    """Return the genus by Euler's formula, after looking that every edge has one partner."""
    edges = np.concatenate([part.triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    codes = edges @ [len(part.points), 1]
    assert len(np.unique(codes)) == len(codes)
    assert set(codes.tolist()) == set((edges[:, ::-1] @ [len(part.points), 1]).tolist())
    assert len(np.unique(part.points, axis=0)) == len(part.points)
    return 1 - (len(part.points) - len(codes) // 2 + len(part.triangles)) // 2


def volume(part: Part) -> float:
    corners = part.points[part.triangles]
    return float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6)


def crossings(part: Part) -> int:
    return len(crossing_triangles(part.points, part.triangles))


@each_clearance
@each_body
def test_parts_are_apart_by_the_clearance(made: Callable[..., Made], name: str, clearance: float) -> None:
    yellow, blue = made(name, clearance).manifolds
    assert (yellow ^ blue).volume() == 0.0
    assert yellow.min_gap(blue, 2 * clearance) >= 0.95 * clearance


@each_clearance
@each_body
def test_no_triangles_cross(made: Callable[..., Made], name: str, clearance: float) -> None:
    assert [crossings(part) for part in made(name, clearance).solids.parts] == [0, 0]


@each_body
def test_a_solid_has_twice_the_handles_of_its_region(made: Callable[..., Made], name: str) -> None:
    found = made(name, 0.3)
    yellow, blue = found.certificate.yellow.handles, found.certificate.blue.handles
    assert yellow + blue == BODIES[name].genus
    assert [genus(part) for part in found.solids.parts] == [2 * yellow, 2 * blue]


@each_clearance
@each_body
def test_parts_and_gap_add_up_to_the_shell(made: Callable[..., Made], name: str, clearance: float) -> None:
    found = made(name, clearance)
    gap, shell = found.solids.spaces
    assert sum(map(volume, (*found.solids.parts, gap))) == pytest.approx(volume(shell), rel=1e-3)
    corners = found.surface.points[found.surface.triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
    assert volume(shell) == pytest.approx(area * THICKNESS, rel=0.15)


@each_body
def test_without_clearance_walls_are_the_same_triangles_reversed(made: Callable[..., Made], name: str) -> None:
    found = made(name, 0.0)
    yellow, blue = (part.points[part.triangles] for part in found.solids.parts)

    def keys(corners: np.ndarray) -> set[bytes]:
        """Return each triangle's coordinates, from its smallest corner on, as bytes."""
        first = np.array([min(range(3), key=triangle.__getitem__) for triangle in corners.tolist()])
        turned = np.take_along_axis(corners, ((first[:, None] + np.arange(3)) % 3)[:, :, None], axis=1)
        return {triangle.tobytes() for triangle in turned}

    assert len(keys(yellow) & keys(blue[:, ::-1])) == 2 * found.surface.curves.size
    first, second = found.manifolds
    assert (first ^ second).volume() == pytest.approx(0.0, abs=1e-6)
    assert sum(map(volume, found.solids.parts)) == pytest.approx(volume(found.solids.spaces[1]), rel=1e-6)
    assert [crossings(part) for part in found.solids.parts] == [0, 0]


def body_of(surface: CutSurface) -> Manifold:
    return as_manifold(Part("body", surface.points, surface.triangles))


@pytest.mark.parametrize("core", ["yellow", "blue"])
@pytest.mark.parametrize("clearance", [0.0, 0.3])
def test_a_core_is_the_body_minus_the_other_part(made: Callable[..., Made], core: Core, clearance: float) -> None:
    """The boolean of the body, the thin part and its gap says what the part with the core has to be."""
    found = made("sphere", clearance, core)
    yellow, blue = found.manifolds
    solid, thin = (yellow, blue) if core == "yellow" else (blue, yellow)
    gap = found.solids.spaces[0]
    left = body_of(found.surface) - thin - (as_manifold(gap) if len(gap.triangles) else Manifold())
    assert solid.volume() == pytest.approx(left.volume(), rel=1e-2)
    assert (solid - left).volume() < 1e-2 * solid.volume()
    assert (solid ^ thin).volume() == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("name", ["sphere", "torus"])
def test_a_core_has_the_genus_of_the_whole(made: Callable[..., Made], name: str) -> None:
    found = made(name, 0.0, "blue")
    yellow, blue = found.solids.parts
    assert (genus(yellow), genus(blue)) == (2 * found.certificate.yellow.handles, BODIES[name].genus)


def test_a_core_keeps_the_clearance_from_its_pockets(made: Callable[..., Made]) -> None:
    yellow, blue = made("sphere", 0.3, "blue").manifolds
    assert yellow.min_gap(blue, 0.6) >= 0.95 * 0.3
    assert [crossings(part) for part in made("sphere", 0.3, "blue").solids.parts] == [0, 0]


def test_same_input_same_bytes(made: Callable[..., Made]) -> None:
    surface, _ = cut_body("torus", clearance=0.3)
    again, first = solids(surface, thickness=THICKNESS, clearance=0.3), made("torus", 0.3).solids
    for one, other in zip(again.parts, first.parts, strict=True):
        assert one.points.tobytes() == other.points.tobytes()
        assert one.triangles.tobytes() == other.triangles.tobytes()


@pytest.mark.parametrize(
    ("thickness", "clearance", "words"),
    [
        (0.0, 0.3, "thickness must be positive, found 0 mm"),
        (-1.0, 0.3, "thickness must be positive, found -1 mm"),
        (float("nan"), 0.3, "thickness must be positive, found nan mm"),
        (2.0, -0.1, "clearance must not be negative, found -0.1 mm"),
        (2.0, float("nan"), "clearance must not be negative, found nan mm"),
        (2.0, 30.0, "a smaller solid.clearance, a larger pattern.tile_size"),
    ],
)
def test_impossible_sizes_are_refused(thickness: float, clearance: float, words: str) -> None:
    surface, _ = cut_body("sphere", clearance=0.0)
    with pytest.raises(SolidError, match=words) as caught:
        solids(surface, thickness=thickness, clearance=clearance)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("mesh", "size", "tile"), [(cube(divisions=1), 40.0, 10.0), (double_torus(hole=0.8, depth=0.3), 60.0, 8.0)]
)
def test_where_ridges_are_sharp_the_inner_surface_is_mended(mesh: PolygonMesh, size: float, tile: float) -> None:
    duotone = grown_duotone(tiled(sized(mesh, size=size), tile_size=tile), tree="random", seed=1)
    surface = fitted_cut(duotone, tolerance=0.3, clearance=0.0)
    result = solids(surface, thickness=3.0, clearance=0.0)
    assert [crossings(part) for part in result.parts] == [0, 0]
    assert min(map(volume, result.parts)) > 0


@pytest.mark.parametrize("share", [0.05, 0.1])
def test_a_body_far_thinner_than_two_walls_still_has_parts_that_do_not_cross(share: float) -> None:
    mesh = sphere(faces="triangles", frequency=2)
    flat = sized(mesh.moved(mesh.points * [1.0, 1.0, share]), size=60)
    surface = fitted_cut(grown_duotone(tiled(flat, tile_size=6), tree="random", seed=1), tolerance=0.3, clearance=0.15)
    made = solids(surface, thickness=2.0, clearance=0.15)
    assert len(crossing_triangles(made.points, np.concatenate(made.bodies))) == 0


def test_a_body_thinner_than_the_clearance_is_refused() -> None:
    mesh = sphere(faces="triangles", frequency=2)
    flat = sized(mesh.moved(mesh.points * [1.0, 1.0, 0.005]), size=60)
    surface = fitted_cut(grown_duotone(tiled(flat, tile_size=12), tree="random", seed=1), tolerance=1.0)
    with pytest.raises(SolidError, match=r"half of the body is no more than 0\.\d+ mm thick") as caught:
        solids(surface, thickness=2.0, clearance=0.4)
    assert "\n" not in str(caught.value)
    check_thick(surface.points, surface.triangles, clearance=0.05)


def test_plain_offset_would_have_crossed() -> None:
    """The frame of the test above needs mending: straight down by the thickness folds."""
    mesh = sized(double_torus(hole=0.8, depth=0.3), size=60)
    surface = fitted_cut(grown_duotone(tiled(mesh, tile_size=8), tree="random", seed=1), tolerance=0.3)
    assert len(crossing_triangles(surface.points - 3.0 * surface.normals, surface.triangles)) > 0


@given(seed=seeds, arc=st.floats(0.35, 0.65), clearance=st.one_of(st.just(0.0), st.floats(0.1, 0.6)))
@settings(max_examples=8)
def test_every_tree_gives_two_sound_parts(seed: int, arc: float, clearance: float) -> None:
    surface, certificate = cut_body("torus", clearance=clearance, seed=seed, arc=arc)
    found = Made(surface, certificate, solids(surface, thickness=THICKNESS, clearance=clearance))
    yellow, blue = found.manifolds
    assert (yellow ^ blue).volume() == pytest.approx(0.0, abs=1e-6)
    assert [crossings(part) for part in found.solids.parts] == [0, 0]
    handles = certificate.yellow.handles, certificate.blue.handles
    assert tuple(genus(part) for part in found.solids.parts) == (2 * handles[0], 2 * handles[1])
    if clearance > 0.0:
        assert yellow.min_gap(blue, 2 * clearance) >= 0.95 * clearance


@pytest.mark.parametrize(
    ("name", "rings", "clearance", "core"),
    [
        ("torus", (0.4, 0.6), 0.3, "hollow"),
        ("sphere", (0.36, 0.5, 0.615), 0.3, "blue"),
        ("double torus", (0.38, 0.57), 0.0, "hollow"),
    ],
)
def test_a_multitone_is_as_many_sound_parts_as_it_has_regions(
    name: str, rings: tuple[float, ...], clearance: float, core: Core
) -> None:
    body = BODIES[name]
    duotone = grown_duotone(tiled(sized(body.mesh, size=2 * body.size), tile_size=24), tree="random", seed=7)
    surface = fitted_cut(duotone, rings=rings, tolerance=0.5, clearance=clearance)
    made, certificate = solids(surface, thickness=THICKNESS, clearance=clearance, core=core), cut_certificate(surface)
    assert certificate.holds
    bands = len(rings) - 1
    blue = body.genus if core == "blue" else 2 * certificate.blue.handles
    assert [genus(part) for part in made.parts] == [0, *bands * [1], blue]
    assert [crossings(part) for part in made.parts] == (bands + 2) * [0]
    for first, second in combinations(map(as_manifold, made.parts), 2):
        assert (first ^ second).volume() == pytest.approx(0.0, abs=1e-6)
        if clearance > 0.0:
            assert first.min_gap(second, 2 * clearance) >= 0.95 * clearance


def test_a_band_of_which_the_clearance_leaves_nothing_is_refused() -> None:
    duotone = grown_duotone(tiled(sized(BODIES["torus"].mesh, size=60), tile_size=12), tree="random", seed=7)
    with pytest.raises(
        SolidError, match=r"leaves nothing of band-1 .* more than 0\.0\d+ apart there, not 0\.02"
    ) as caught:
        fitted_cut(duotone, rings=(0.49, 0.51, 0.6), tolerance=0.5, clearance=0.3)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("divisions", "clearance", "core"), [(1, 0.3, "hollow"), (3, 0.0, "hollow"), (5, 0.4, "yellow")]
)
def test_a_cube_with_sharp_edges_is_exact_and_its_wall_mitred(divisions: int, clearance: float, core: Core) -> None:
    mesh = sized(creased(cube(divisions=divisions), angle=40.0), size=60)
    duotone = grown_duotone(tiled(mesh, tile_size=9), tree="random", seed=5)
    surface = fitted_cut(duotone, tolerance=0.1, clearance=clearance)
    made = solids(surface, thickness=THICKNESS, clearance=clearance, core=core)
    for part in made.parts:
        away = np.abs(part.points).max(axis=1)
        outer = away > 30 - THICKNESS / 2
        facets = part.triangles[outer[part.triangles].all(axis=1)]
        middles = np.concatenate([part.points[facets[:, [k, (k + 1) % 3]]].mean(axis=1) for k in range(3)])
        for found in (away[outer], np.abs(middles).max(axis=1), np.abs(part.points[facets].mean(axis=1)).max(axis=1)):
            np.testing.assert_allclose(found, 30, rtol=0, atol=1e-5)
        assert away[~outer].max() == pytest.approx(30 - THICKNESS, abs=1e-5)
        assert crossings(part) == 0
    yellow, blue = map(as_manifold, made.parts)
    assert (yellow ^ blue).volume() == pytest.approx(0.0, abs=1e-6)
    if clearance > 0.0:
        assert yellow.min_gap(blue, 2 * clearance) >= 0.95 * clearance
    if core == "hollow":
        assert volume(made.spaces[1]) == pytest.approx(60**3 - 56**3, rel=1e-6)


FRAMES = {
    "triple torus": Body(triple_torus(), 140, 3),
    "genus six": Body(genus_six(), 150, 6),
    "knot": Body(trefoil(around=24, across=3, tube=0.4), 120, 1),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", [*BODIES, *FRAMES])
def test_walls_keep_their_thickness(name: str) -> None:
    body = FRAMES.get(name) or replace(BODIES[name], size=100)
    duotone = grown_duotone(tiled(sized(body.mesh, size=body.size), tile_size=10), tree="random", seed=7)
    surface = fitted_cut(duotone, tolerance=0.2, clearance=0.3)
    shell = solids(surface, thickness=THICKNESS, clearance=0.3).spaces[1]
    whole = trimesh.Trimesh(shell.points, shell.triangles, process=False)
    pieces = whole.split(only_watertight=True)
    inner = min(pieces, key=lambda piece: piece.volume)
    squared = igl.point_mesh_squared_distance(np.asarray(inner.vertices), surface.points, surface.triangles)[0]
    assert np.sqrt(squared.min()) >= 0.8 * THICKNESS


def test_relaxing_that_does_not_help_ends_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Faults that stay whatever is done: parts are put together twice, and the rest is for the retreat."""
    surface, _ = cut_body("torus", clearance=0.3)
    made, proposed = list[Assembly](), assembly

    def counted(*given: Any, **options: Any) -> Assembly:
        made.append(proposed(*given, **options))
        return made[-1]

    def hopeless(found: Assembly, _moved: Mask, **_: float) -> Mask:
        return np.arange(found.surface_points) == 7

    monkeypatch.setattr("fabricate.solid.solids.assembly", counted)
    monkeypatch.setattr("fabricate.solid.solids._faults", hopeless)
    solids(surface, thickness=THICKNESS, clearance=0.3)
    assert len(made) == 2
