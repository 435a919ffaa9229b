"""Judging: every check of a good pair passes, each fault fails its own check, and nothing stops the rest."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from manifold3d import Manifold

from fabricate.arrays import Floats, Indices
from fabricate.checks import judge
from fabricate.checks.expectations import Band, Expectations, Neck
from fabricate.checks.facts import Gap, Spaces
from fabricate.checks.judge import Judgement, judged_parts, read_part
from fabricate.errors import ReadError
from fabricate.output.stl import write_stl
from fabricate.process import PROCESSES
from fabricate.solid.part import Part
from fabricate.triangles.search_tree import SearchTree

GAP = 0.4


def part_of(name: str, manifold: Manifold) -> Part:
    mesh = manifold.to_mesh64()
    return Part(name, np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int64))


def disc(radius: float, below: float, above: float) -> Manifold:
    return Manifold.cylinder(above - below, radius, radius, 64).translate((0, 0, below))


# A peg with a head at either end, in the hole of a plate from which it cannot get out.
PEG = disc(5, -4 - GAP, 4 + GAP) + disc(9, 4 + GAP, 7 + GAP) + disc(9, -7 - GAP, -4 - GAP)
WITH_GAP = PEG + disc(5 + GAP, -4, 4) + disc(9, 4, 4 + GAP) + disc(9, -4 - GAP, -4)
SLAB = Manifold.cube((30, 30, 8), True)
RED, BLUE = part_of("red", PEG), part_of("blue", SLAB - WITH_GAP)
EXPECTED = Expectations(
    clearance=GAP,
    genus={"red": 0, "blue": 1},
    process=PROCESSES["fdm"],
    neck=Neck(2.0, (1.0, 2.0, 3.0)),
    band=Band("band-1", 2.0, (1.0, 2.0, 3.0), 0.2),
    spaces=Spaces((WITH_GAP - PEG).volume(), (SLAB + WITH_GAP).volume()),
    middles={"red-blue": np.array([[5.0 + GAP / 2, 0.0, 0.0], [0.0, 5.0 + GAP / 2, 1.0]])},
)


def failed(found: Judgement) -> set[str]:
    return {check.code for check in found.checks if check.failed}


def skipped(found: Judgement) -> set[str]:
    return {check.code for check in found.checks if check.skipped}


def documented(parts: tuple[str, ...]) -> set[str]:
    codes = re.findall(r"^    (?!shop)(\S+\.\S+) ", judge.__doc__ or "", flags=re.MULTILINE)  # there is no shop
    return {code.replace("PART.", f"{name}.").replace("FIT.", "fit.") for code in codes for name in parts}


def moved(part: Part, shift: tuple[float, float, float]) -> Part:
    return Part(part.name, part.points + np.array(shift), part.triangles)


def with_hole(part: Part) -> Part:
    return Part(part.name, part.points, part.triangles[1:])


def with_a_flip(part: Part) -> Part:
    return Part(part.name, part.points, np.array([part.triangles[0, ::-1], *part.triangles[1:]]))


def inside_out(part: Part) -> Part:
    return Part(part.name, part.points, part.triangles[:, ::-1])


def in_two_pieces(part: Part) -> Part:
    far = part.points + np.array([0, 0, 100])
    return Part(
        part.name,
        np.concatenate([part.points, far]),
        np.concatenate([part.triangles, part.triangles + len(part.points)]),
    )


def with_a_flat_triangle(part: Part) -> Part:
    a, b, _ = part.triangles[0]
    return Part(part.name, part.points, np.array([*part.triangles, [a, b, a]]))


def pierced_by_itself(part: Part) -> Part:
    points = part.points.copy()
    points[points[:, 2].argmax()] = (1.0, 2.0, -20.0)
    return Part(part.name, points, part.triangles)


def pinched(part: Part) -> Part:
    """Return the part with a tetrahedron that stands on one of its points."""
    foot = int(part.points[:, 2].argmax())
    top = part.points[foot] + np.array([[1, 0, 2], [-1, 1, 2], [-1, -1, 2]])
    n = len(part.points)
    added = [[foot, n + 1, n], [foot, n + 2, n + 1], [foot, n, n + 2], [n, n + 1, n + 2]]
    return Part(part.name, np.concatenate([part.points, top]), np.concatenate([part.triangles, added]))


def test_a_good_pair_passes_every_check() -> None:
    found = judged_parts([RED, BLUE], EXPECTED)
    codes = [check.code for check in found.checks]
    assert len(codes) == len(set(codes))
    assert set(codes) == documented(("red", "blue"))
    assert [check.code for check in found.checks if not check.ok] == ["blue.neck"]  # a plate with one hole has none


def test_each_tree_is_built_once(monkeypatch: pytest.MonkeyPatch) -> None:
    built = []
    original = SearchTree.of

    def counted(points: Floats, triangles: Indices) -> SearchTree:
        built.append(len(triangles))
        return original(points, triangles)

    monkeypatch.setattr(SearchTree, "of", counted)
    judged_parts([RED, BLUE], EXPECTED)
    assert built == [len(RED.triangles), len(BLUE.triangles)]


def test_facts_of_a_good_pair() -> None:
    found = judged_parts([RED, BLUE], EXPECTED)
    assert list(found.parts) == ["red", "blue"]
    red = found.parts["red"]
    assert (red.file, red.triangles, red.genus, red.components) == ("red.stl", len(RED.triangles), 0, 1)
    assert red.watertight
    assert red.self_intersections == 0
    assert red.volume_mm3 == pytest.approx(PEG.volume(), rel=1e-6)
    assert red.area_mm2 == pytest.approx(PEG.surface_area(), rel=1e-6)
    assert red.wall_mm is not None
    assert red.wall_mm.min == pytest.approx(3.0, rel=1e-3)
    assert red.neck_mm is not None
    assert red.neck_mm.min == pytest.approx(10.0, rel=0.01)
    assert found.fit is not None
    assert found.fit.clearance_mm == GAP
    assert found.fit.gap_mm is not None
    assert found.fit.gap_mm.min == pytest.approx(GAP, rel=0.01)
    assert found.fit.gap_mm.queried == pytest.approx(GAP, rel=0.02)
    assert found.fit.gap_mm.max == pytest.approx(GAP, rel=0.02)
    assert found.fit.overlap_mm3 == 0.0
    assert found.fit.verdict == "captive"
    assert found.fit.play_mm is not None
    assert found.fit.play_mm.z == pytest.approx(GAP, rel=1e-3)
    assert found.fit.witness is not None


@pytest.mark.parametrize(
    ("fault", "codes"),
    [
        (with_hole, {"red.closed", "red.manifold"}),
        (with_a_flip, {"red.oriented", "red.manifold"}),
        (pinched, {"red.vertex_manifold"}),
        (in_two_pieces, {"red.components"}),
        (with_a_flat_triangle, {"red.nondegenerate"}),
        (inside_out, {"red.volume"}),
        (pierced_by_itself, {"red.self_intersections"}),
    ],
)
def test_a_faulty_part_fails_its_check(fault: Callable[[Part], Part], codes: set[str]) -> None:
    found = judged_parts([fault(RED), BLUE], EXPECTED)
    assert codes <= failed(found)
    assert not any(code.startswith("blue.") for code in failed(found))
    assert {check.code for check in found.checks} == documented(("red", "blue"))
    assert all(
        len(check.where) or check.code in {"red.manifold", "red.volume"}
        for check in found.checks
        if check.code in codes
    )


@pytest.mark.parametrize(
    ("expectations", "code"),
    [
        (replace(EXPECTED, genus={"red": 1, "blue": 1}), "red.genus"),
        (replace(EXPECTED, clearance=1.1 * GAP), "fit.gap"),
        (replace(EXPECTED, spaces=Spaces(EXPECTED.spaces.gap, PEG.volume())), "fit.whole"),  # type: ignore[union-attr]
        (replace(EXPECTED, verdict="separable"), "fit.mobility"),
        (replace(EXPECTED, middles={"red-blue": np.array([[5.2, 0.0, 3.9], [0.0, 0.0, 8.0]])}), "fit.gap_max"),
        (replace(EXPECTED, neck=Neck(1.1, (0.0, 0.0, 0.0))), "pattern.neck"),
        (replace(EXPECTED, band=Band("band-1", 1.1, (0.0, 0.0, 0.0), 0.2)), "pattern.band"),
        (replace(EXPECTED, process=replace(PROCESSES["fdm"], wall_min=3.1)), "red.wall"),
        (replace(EXPECTED, process=replace(PROCESSES["fdm"], crack_closed=0.41)), "fit.process_gap"),
    ],
)
def test_what_is_not_as_expected_fails_alone(expectations: Expectations, code: str) -> None:
    assert failed(judged_parts([RED, BLUE], expectations)) == {code}


def test_overlapping_parts_are_found_where_they_overlap() -> None:
    found = judged_parts([moved(RED, (1.0, 0, 0)), BLUE], EXPECTED)
    assert {"fit.overlap", "fit.gap"} <= failed(found)
    overlap = next(check for check in found.checks if check.code == "fit.overlap")
    assert abs(overlap.where[0, 0] - 6.0) < 1.0
    assert found.fit is not None
    assert found.fit.overlap_mm3 is not None
    assert found.fit.overlap_mm3 > 1.0
    assert found.fit.verdict == "fused"
    assert found.fit.play_mm is None


def test_a_gap_too_small_is_found_where_it_is() -> None:
    found = judged_parts([moved(RED, (0.0, 0.0, 0.15)), BLUE], EXPECTED)
    assert failed(found) == {"fit.gap"}
    assert found.fit is not None
    assert found.fit.gap_mm is not None
    assert found.fit.gap_mm.min == pytest.approx(GAP - 0.15, rel=1e-4)
    assert found.fit.gap_mm.at is not None
    assert found.fit.gap_mm.at[2] == pytest.approx(-4 - (GAP - 0.15) / 2, abs=1e-3)


def test_with_nothing_expected_all_that_needs_it_is_skipped() -> None:
    found = judged_parts([RED, BLUE], Expectations())
    assert failed(found) == set()
    assert skipped(found) == {
        "red.genus", "blue.genus", "red.wall", "blue.wall", "red.neck", "blue.neck", "fit.gap",
        "fit.gap_max", "fit.whole", "fit.mobility",
        "fit.process_gap", "pattern.neck",
    }  # fmt: skip
    assert found.fit is not None
    assert found.fit.gap_mm is not None
    assert found.fit.gap_mm.min == pytest.approx(GAP, rel=0.01)
    assert (found.fit.clearance_mm, found.fit.verdict, found.fit.play_mm) == (None, None, None)


def test_parts_that_touch_on_purpose_are_fused() -> None:
    cube = Manifold.cube((10, 10, 10))
    red, blue = part_of("red", cube), part_of("blue", cube.translate((10, 0, 0)))
    found = judged_parts([red, blue], Expectations(clearance=0.0, spaces=Spaces(0.0, 20 * 10 * 10)))
    assert failed(found) == set()
    assert "fit.process_gap" in skipped(found)
    assert found.fit is not None
    assert (found.fit.verdict, found.fit.gap_mm) == ("fused", Gap(0.0, None))
    overlapping = judged_parts([red, moved(blue, (-1.0, 0, 0))], Expectations(clearance=0.0))
    assert "fit.overlap" in failed(overlapping)


def test_a_part_that_is_no_solid_leaves_the_fit_unmeasured() -> None:
    found = judged_parts([with_hole(RED), BLUE], EXPECTED)
    assert {"fit.overlap", "fit.gap", "fit.mobility", "red.genus"} <= skipped(found)
    assert found.fit is not None
    assert (found.fit.gap_mm, found.fit.overlap_mm3, found.fit.verdict) == (None, None, None)
    assert found.parts["red"].genus is None


def test_three_parts_are_judged_pair_by_pair() -> None:
    green = part_of("green", Manifold.cube((5, 5, 5)).translate((15 + GAP, 0, 0)))
    found = judged_parts([RED, BLUE, green], replace(EXPECTED, spaces=None))
    codes = {check.code for check in found.checks}
    assert {"fit.red-blue.gap", "fit.red-green.gap", "fit.blue-green.overlap"} <= codes
    assert failed(found) == {"fit.blue-green.mobility"}
    assert "fit.joined" in codes
    assert "fit.red-green.mobility" not in {check.code for check in found.checks}
    assert found.fit is not None
    assert found.fit.gap_mm is not None
    assert found.fit.gap_mm.min == pytest.approx(GAP, rel=0.01)
    verdicts = {name: pair.verdict for name, pair in found.fit.pairs.items()}
    assert verdicts == {"red-blue": "captive", "red-green": None, "blue-green": "separable"}
    assert (found.fit.verdict, found.fit.play_mm) == ("separable", None)


def test_parts_in_a_row_of_captive_pairs_are_captive() -> None:
    """The plate is the peg's head's head: a sleeve round the plate, out of which neither gets."""
    outer = Manifold.cube((36, 36, 14), True) - Manifold.cube((30 + 2 * GAP, 30 + 2 * GAP, 8 + 2 * GAP), True)
    sleeve = outer - Manifold.cube((24, 24, 20), True)
    found = judged_parts([RED, BLUE, part_of("green", sleeve)], replace(EXPECTED, spaces=None))
    assert found.fit is not None
    assert {name: pair.verdict for name, pair in found.fit.pairs.items()} == {
        "red-blue": "captive", "red-green": None, "blue-green": "captive",
    }  # fmt: skip
    assert found.fit.verdict == "captive"
    assert failed(found) == set()


def test_a_part_that_no_other_one_faces_leaves_the_verdict_open() -> None:
    far = part_of("green", Manifold.cube((5, 5, 5)).translate((40, 0, 0)))
    found = judged_parts([RED, BLUE, far], replace(EXPECTED, spaces=None))
    assert found.fit is not None
    assert found.fit.verdict is None
    assert failed(found) == {"fit.joined"}


def test_a_single_part_has_no_fit() -> None:
    found = judged_parts([RED], EXPECTED)
    assert found.fit is None
    assert not any(check.code.startswith("fit.") for check in found.checks if check.code != "fit.process_gap")


def test_an_empty_part_is_judged_too() -> None:
    found = judged_parts([Part("red", np.zeros((0, 3)), np.zeros((0, 3), dtype=int)), BLUE], EXPECTED)
    assert {"red.closed", "red.volume", "red.manifold"} <= failed(found)


def test_parts_need_different_names() -> None:
    with pytest.raises(ReadError, match="2 named 'red'"):
        judged_parts([RED, RED], EXPECTED)
    with pytest.raises(ReadError, match="at least one"):
        judged_parts([], EXPECTED)


def test_judging_twice_gives_the_same_facts() -> None:
    first, second = (judged_parts([RED, BLUE], EXPECTED) for _ in range(2))
    assert first.parts == second.parts
    assert first.fit == second.fit
    assert [check.message for check in first.checks] == [check.message for check in second.checks]


def test_a_part_comes_back_from_its_file_as_it_was(tmp_path: Path) -> None:
    write_stl(tmp_path / "red.stl", RED)
    again = read_part(tmp_path / "red.stl")
    assert again.name == "red"
    assert np.array_equal(again.points[again.triangles], RED.points[RED.triangles])
    assert len(again.points) == len(RED.points)


def test_a_part_comes_back_from_a_text_file(tmp_path: Path) -> None:
    facets = "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join(f"vertex {x!r} {y!r} {z!r}\n" for x, y, z in corners.tolist())
        + "endloop\nendfacet\n"
        for corners in BLUE.points[BLUE.triangles]
    )
    (tmp_path / "blue.stl").write_text(f"solid blue\n{facets}endsolid blue\n")
    again = read_part(tmp_path / "blue.stl")
    assert np.array_equal(again.points[again.triangles], BLUE.points[BLUE.triangles])


def test_text_is_rounded_before_corners_are_compared(tmp_path: Path) -> None:
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    tetrahedron = points[np.array([[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]])]
    tetrahedron += np.random.default_rng(3).uniform(-1e-12, 1e-12, tetrahedron.shape) + 7.0
    facets = "".join(
        "facet normal 0 0 0 outer loop "
        + " ".join(f"vertex {x!r} {y!r} {z!r}" for x, y, z in corners.tolist())
        + " endloop endfacet\n"
        for corners in tetrahedron
    )
    (tmp_path / "red.stl").write_text(f"solid red\n{facets}endsolid red\n")
    part = read_part(tmp_path / "red.stl")
    assert len(part.points) == 4
    assert judged_parts([part], Expectations()).parts["red"].watertight


def test_what_is_no_part_is_refused_with_its_path(tmp_path: Path) -> None:
    quads = tmp_path / "quads.obj"
    quads.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
    for path in (quads, tmp_path / "missing.stl"):
        with pytest.raises(ReadError, match=re.escape(str(path))):
            read_part(path)
